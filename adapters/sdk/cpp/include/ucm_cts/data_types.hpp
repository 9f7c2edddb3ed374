// UCM data types (9.2.3 to 9.2.5) and interfaces (9.2.7) as data, and how their values travel.
//
// A value says nothing of its type; the interface does. Integers and characters (code points) are integers, booleans
// booleans, strings UTF-8 strings, enumerators their names; a structure is the list of its fields, a union
// `[enumerator, value]`, arrays (dimension by dimension) and sequences are lists. A float is the hexadecimal digits of its
// IEEE 754 bits, most significant first, so that two values are the same exactly when they are written the same.
//
// Types are trees without cycles. In a DataType, `base` is the kind of an integer, float or character, the characters of a
// string, or the kind of the integers of an enumeration; a `size` of -1 is unbounded; `of` of a union is the enumeration that
// selects.
#ifndef UCM_CTS_DATA_TYPES_HPP
#define UCM_CTS_DATA_TYPES_HPP

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "ucm_cts/generated/messages.hpp"

namespace ucm_cts {

inline std::vector<Parameter> Method::arguments() const {
    std::vector<Parameter> found;
    std::copy_if(parameters.begin(), parameters.end(), std::back_inserter(found), [](const Parameter& parameter) {
        return parameter.direction == Direction::in || parameter.direction == Direction::inout;
    });
    return found;
}

inline std::vector<Parameter> Method::results() const {
    std::vector<Parameter> found;
    std::copy_if(parameters.begin(), parameters.end(), std::back_inserter(found),
                 [](const Parameter& parameter) { return parameter.direction != Direction::in; });
    return found;
}

/// The interfaces of those port elements that have one, by the port element's name.
typedef std::map<std::string, SharedInterface> Interfaces;

/// How many ids, records, connections or references a framework may hand over: far more than any scenario makes.
constexpr std::size_t MOST = 10000;

/// What is said of more than `MOST` of `what`.
inline std::string too_many(const std::string& what) { return "more than " + std::to_string(MOST) + " " + what; }

/// Can it stand for a value of a UCM type?
inline bool is_datum(const Datum& value) {
    if (value.is_array()) {
        return std::all_of(value.begin(), value.end(), is_datum);
    }
    return value.is_boolean() || value.is_number_integer() || value.is_string();
}

inline bool are_data(const Data& values) { return std::all_of(values.begin(), values.end(), is_datum); }

/// Changes every part of the value, as the owner of a buffer may.
inline void overwrite(Datum& value) {
    if (value.is_array()) {
        for (Datum& one : value) {
            overwrite(one);
        }
        value.push_back(0);
    } else if (value.is_boolean()) {
        value = !value.get<bool>();
    } else if (value.is_number_integer()) {
        value = value == 0 ? 1 : 0;
    } else {
        value = "?";
    }
}

inline void overwrite(Data& values) {
    for (Datum& value : values) {
        overwrite(value);
    }
}

}  // namespace ucm_cts

#endif
