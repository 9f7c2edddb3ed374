// UCM data types (9.2.3 to 9.2.5) and interfaces (9.2.7) as data, and how their values travel.
//
// A value says nothing of its type; the interface does. Integers and characters (code points) are integers, booleans
// booleans, strings UTF-8 strings, enumerators their names; a structure is the list of its fields, a union
// `[enumerator, value]`, arrays (dimension by dimension) and sequences are lists. A float is the hexadecimal digits of its
// IEEE 754 bits, most significant first, so that two values are the same exactly when they are written the same.
#ifndef UCM_CTS_DATA_TYPES_HPP
#define UCM_CTS_DATA_TYPES_HPP

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace ucm_cts {

/// A value as it travels.
typedef nlohmann::json Datum;
typedef std::vector<Datum> Data;

struct DataType;
typedef std::shared_ptr<const DataType> SharedType;

/// One alternative of a union: active for the `selectors`, or as default for every enumerator that no other case names.
struct UnionCase {
    std::string name;
    SharedType of;
    std::vector<std::string> selectors;
    bool is_default;
};

/// A data type; which of the members count depends on its kind. Types are trees without cycles.
struct DataType {
    enum class Kind {
        integer,      // PrimitiveInteger: `base` is BYTE SHORT LONG LONGLONG UBYTE USHORT ULONG or ULONGLONG
        floating,     // PrimitiveFloat: `base` is FLOAT or DOUBLE
        character,    // PrimitiveChar: `base` is CHAR8 or CHAR32
        boolean,      // PrimitiveBoolean
        string,       // StringType: `base` is CHAR8 or CHAR32; `size`
        enumeration,  // `name`, `enumerators`; `base` is the integer kind of their values
        structure,    // `name`, `fields`
        union_type,   // `name`, `cases`; `of` is the enumeration that selects
        array,        // `of`, `sizes`
        sequence,     // `of`, `size`
        alias         // `name` is another name of `of`
    };

    Kind kind;
    std::string name;
    std::string base;
    std::int64_t size = -1;                                   // the most characters or elements; -1 is unbounded
    std::vector<std::int64_t> sizes;                          // dimension by dimension
    std::vector<std::pair<std::string, Datum>> enumerators;   // in order, with their integers
    std::vector<std::pair<std::string, SharedType>> fields;   // in order
    std::vector<UnionCase> cases;                             // in order
    SharedType of;
};

enum class Direction { in, out, inout, result };

/// A parameter of a method; that of direction `result` (RETURN) is what it returns.
struct Parameter {
    std::string name;
    Direction direction;
    SharedType of;
};

/// Parameters in order, and the exceptions, which are structures, that the method may raise.
struct Method {
    std::vector<Parameter> parameters;
    std::vector<SharedType> raises;

    /// What the caller sends: IN and INOUT.
    std::vector<Parameter> arguments() const {
        return those([](Direction direction) { return direction == Direction::in || direction == Direction::inout; });
    }

    /// What comes back: OUT, INOUT and RETURN, in the order of declaration.
    std::vector<Parameter> results() const {
        return those([](Direction direction) { return direction != Direction::in; });
    }

  private:
    template <class Belongs>
    std::vector<Parameter> those(Belongs belongs) const {
        std::vector<Parameter> found;
        for (const Parameter& parameter : parameters) {
            if (belongs(parameter.direction)) {
                found.push_back(parameter);
            }
        }
        return found;
    }
};

/// Methods by name, its own and those of the interfaces it inherits (9.2.7.2), whose names are `inherited`.
struct Interface {
    std::map<std::string, Method> methods;
    std::vector<std::string> inherited;
};

typedef std::shared_ptr<const Interface> SharedInterface;

/// The interfaces of those port elements that have one, by the port element's name.
typedef std::map<std::string, SharedInterface> Interfaces;

}  // namespace ucm_cts

#endif
