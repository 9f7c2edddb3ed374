// Values of UCM types on their way through a probe.
#ifndef UCM_CTS_DATA_HPP
#define UCM_CTS_DATA_HPP

#include <cstdint>
#include <string>

#include "ucm_cts/data_types.hpp"

namespace ucm_cts {

/// Can it stand for a value of a UCM type?
inline bool is_datum(const Datum& value) {
    if (value.is_array()) {
        for (const Datum& one : value) {
            if (!is_datum(one)) {
                return false;
            }
        }
        return true;
    }
    return value.is_boolean() || value.is_number_integer() || value.is_string();
}

inline bool are_data(const Data& values) {
    for (const Datum& value : values) {
        if (!is_datum(value)) {
            return false;
        }
    }
    return true;
}

/// Puts something else in every place of `values`, as the owner of a buffer may.
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
