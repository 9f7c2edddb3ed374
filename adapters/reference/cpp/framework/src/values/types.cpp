#include "lwucm/types.hpp"

#include <algorithm>
#include <set>

#include "lwucm/errors.hpp"

namespace lwucm {

namespace {

Type plain(Type::Kind kind) {
    Type type;
    type.kind = kind;
    type.integer = IntegerKind::LONG;
    type.bound = UNBOUNDED;
    return type;
}

TypePtr shared(const Type& type) { return std::make_shared<const Type>(type); }

Type bounded(Type::Kind kind, std::int64_t bound) {
    if (bound < UNBOUNDED) {
        throw BAD_PARAMETER("a bound is not negative, or -1 if there is none");
    }
    Type type = plain(kind);
    type.bound = bound;
    return type;
}

void need(const TypePtr& type) {
    if (!type) {
        throw BAD_PARAMETER("a type lacks the type of a part");
    }
}

template <class Parts>
void check_names(const std::string& owner, const Parts& parts) {
    std::set<std::string> names;
    for (const auto& part : parts) {
        if (!names.insert(part.name).second) {
            throw BAD_PARAMETER(owner + " has two parts called " + part.name);
        }
    }
}

bool fits(IntegerKind kind, std::int64_t value) {
    const int bits = bits_of(kind);
    if (bits == 64) {
        return true;
    }
    const std::int64_t limit = std::int64_t(1) << (is_signed(kind) ? bits - 1 : bits);
    return value < limit && value >= (is_signed(kind) ? -limit : 0);
}

}  // namespace

TypePtr integer_type(IntegerKind kind) {
    Type type = plain(Type::Kind::integer);
    type.integer = kind;
    return shared(type);
}

TypePtr float_type() { return shared(plain(Type::Kind::single)); }
TypePtr double_type() { return shared(plain(Type::Kind::real)); }
TypePtr char8_type() { return shared(plain(Type::Kind::character8)); }
TypePtr char32_type() { return shared(plain(Type::Kind::character32)); }
TypePtr boolean_type() { return shared(plain(Type::Kind::boolean)); }
TypePtr string8_type(std::int64_t bound) { return shared(bounded(Type::Kind::string8, bound)); }
TypePtr string32_type(std::int64_t bound) { return shared(bounded(Type::Kind::string32, bound)); }

TypePtr enumeration_type(const std::string& name, IntegerKind index, const std::vector<Enumerator>& enumerators) {
    check_names(name, enumerators);
    std::set<std::int64_t> values;
    for (const Enumerator& enumerator : enumerators) {
        if (!fits(index, enumerator.value) || !values.insert(enumerator.value).second) {
            throw BAD_PARAMETER(name + ": no index value for " + enumerator.name);
        }
    }
    Type type = plain(Type::Kind::enumeration);
    type.name = name;
    type.integer = index;
    type.enumerators = enumerators;
    return shared(type);
}

TypePtr structure_type(const std::string& name, const std::vector<Field>& fields) {
    check_names(name, fields);
    for (const Field& field : fields) {
        need(field.type);
    }
    Type type = plain(Type::Kind::structure);
    type.name = name;
    type.fields = fields;
    return shared(type);
}

TypePtr union_type(const std::string& name, const TypePtr& selector, const std::vector<Case>& cases) {
    need(selector);
    if (resolved(*selector).kind != Type::Kind::enumeration) {
        throw BAD_PARAMETER(name + " is not selected by an enumeration");
    }
    check_names(name, cases);
    std::set<std::string> unused;
    for (const Enumerator& enumerator : resolved(*selector).enumerators) {
        unused.insert(enumerator.name);
    }
    int defaults = 0;
    for (const Case& one : cases) {
        need(one.type);
        defaults += one.is_default ? 1 : 0;
        for (const std::string& enumerator : one.selectors) {
            if (unused.erase(enumerator) == 0) {
                throw BAD_PARAMETER(name + ": " + enumerator + " cannot select " + one.name);
            }
        }
    }
    if (defaults > 1) {
        throw BAD_PARAMETER(name + " has two default cases");
    }
    Type type = plain(Type::Kind::union_type);
    type.name = name;
    type.of = selector;
    type.cases = cases;
    return shared(type);
}

TypePtr array_type(const TypePtr& of, const std::vector<std::size_t>& sizes) {
    need(of);
    if (sizes.empty() || std::count(sizes.begin(), sizes.end(), 0U) != 0) {
        throw BAD_PARAMETER("an array has at least one dimension, and elements in each");
    }
    Type type = plain(Type::Kind::array);
    type.of = of;
    type.sizes = sizes;
    return shared(type);
}

TypePtr sequence_type(const TypePtr& of, std::int64_t bound) {
    need(of);
    Type type = bounded(Type::Kind::sequence, bound);
    type.of = of;
    return shared(type);
}

TypePtr alias_type(const std::string& name, const TypePtr& of) {
    need(of);
    Type type = plain(Type::Kind::alias);
    type.name = name;
    type.of = of;
    return shared(type);
}

int bits_of(IntegerKind kind) {
    switch (kind) {
        case IntegerKind::BYTE:
        case IntegerKind::UBYTE:
            return 8;
        case IntegerKind::SHORT:
        case IntegerKind::USHORT:
            return 16;
        case IntegerKind::LONG:
        case IntegerKind::ULONG:
            return 32;
        case IntegerKind::LONGLONG:
        case IntegerKind::ULONGLONG:
            break;
    }
    return 64;
}

bool is_signed(IntegerKind kind) {
    return kind == IntegerKind::BYTE || kind == IntegerKind::SHORT || kind == IntegerKind::LONG ||
           kind == IntegerKind::LONGLONG;
}

const Type& resolved(const Type& type) {
    const Type* meant = &type;
    while (meant->kind == Type::Kind::alias) {
        meant = meant->of.get();
    }
    return *meant;
}

const Case* selected_case(const Type& union_of_cases, const std::string& enumerator) {
    const Case* otherwise = nullptr;
    for (const Case& one : union_of_cases.cases) {
        if (std::find(one.selectors.begin(), one.selectors.end(), enumerator) != one.selectors.end()) {
            return &one;
        }
        if (one.is_default) {
            otherwise = &one;
        }
    }
    return otherwise;
}

bool same_type(const TypePtr& one, const TypePtr& other) {
    if (one == other) {
        return true;
    }
    if (!one || !other) {
        return false;
    }
    return one->kind == other->kind && one->name == other->name && one->integer == other->integer &&
           one->bound == other->bound && one->sizes == other->sizes && one->enumerators == other->enumerators &&
           one->fields == other->fields && one->cases == other->cases && same_type(one->of, other->of);
}

bool operator==(const Enumerator& one, const Enumerator& other) {
    return one.name == other.name && one.value == other.value;
}

bool operator==(const Field& one, const Field& other) {
    return one.name == other.name && same_type(one.type, other.type);
}

bool operator==(const Case& one, const Case& other) {
    return one.name == other.name && one.selectors == other.selectors && one.is_default == other.is_default &&
           same_type(one.type, other.type);
}

}  // namespace lwucm
