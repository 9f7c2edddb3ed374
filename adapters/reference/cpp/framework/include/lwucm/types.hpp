// UCM data types (9.2.3 to 9.2.5) as data. LONGDOUBLE and native types are not there; no type contains itself.
#ifndef LWUCM_TYPES_HPP
#define LWUCM_TYPES_HPP

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lwucm {

enum class IntegerKind { BYTE, SHORT, LONG, LONGLONG, UBYTE, USHORT, ULONG, ULONGLONG };

/// `value` is in the range of the enumeration's index; that of a ULONGLONG index beyond 2^63-1 has the same 64 bits.
struct Enumerator {
    std::string name;
    std::int64_t value;
};

struct Type;
typedef std::shared_ptr<const Type> TypePtr;

struct Field {
    std::string name;
    TypePtr type;
};

/// A case of a union: for the enumerators in `selectors`, or as default for all that no other case names.
struct Case {
    std::string name;
    TypePtr type;
    std::vector<std::string> selectors;
    bool is_default;
};

/// A data type; the members that count are those of its kind. Made by the functions below.
struct Type {
    enum class Kind {
        integer,      // integer
        single,       // FLOAT
        real,         // DOUBLE
        character8,   // CHAR8
        character32,  // CHAR32
        boolean,
        string8,      // bound
        string32,     // bound
        enumeration,  // name, integer (the index), enumerators
        structure,    // name, fields
        union_type,   // name, of (the enumeration that selects), cases
        array,        // of, sizes
        sequence,     // of, bound
        alias         // name, of
    };

    Kind kind;
    std::string name;
    IntegerKind integer;
    std::int64_t bound;  // the most characters or elements, -1 if there is no bound
    std::vector<std::size_t> sizes;
    std::vector<Enumerator> enumerators;
    std::vector<Field> fields;
    std::vector<Case> cases;
    TypePtr of;
};

const std::int64_t UNBOUNDED = -1;

// Types of each kind. BAD_PARAMETER if it is none: a name twice, an index value out of range, a missing part.
TypePtr integer_type(IntegerKind kind);
TypePtr float_type();
TypePtr double_type();
TypePtr char8_type();
TypePtr char32_type();
TypePtr boolean_type();
TypePtr string8_type(std::int64_t bound = UNBOUNDED);
TypePtr string32_type(std::int64_t bound = UNBOUNDED);
TypePtr enumeration_type(const std::string& name, IntegerKind index, const std::vector<Enumerator>& enumerators);
TypePtr structure_type(const std::string& name, const std::vector<Field>& fields);
TypePtr union_type(const std::string& name, const TypePtr& selector, const std::vector<Case>& cases);
TypePtr array_type(const TypePtr& of, const std::vector<std::size_t>& sizes);
TypePtr sequence_type(const TypePtr& of, std::int64_t bound = UNBOUNDED);
TypePtr alias_type(const std::string& name, const TypePtr& of);

/// How many bits an integer kind has, and whether it has a sign.
int bits_of(IntegerKind kind);
bool is_signed(IntegerKind kind);

/// The type that is meant: what an alias stands for, at any depth.
const Type& resolved(const Type& type);

/// The case of a union that an enumerator selects, or null.
const Case* selected_case(const Type& union_of_cases, const std::string& enumerator);

/// Do both say the same, part by part, names included?
bool same_type(const TypePtr& one, const TypePtr& other);
bool operator==(const Enumerator& one, const Enumerator& other);
bool operator==(const Field& one, const Field& other);
bool operator==(const Case& one, const Case& other);

}  // namespace lwucm

#endif
