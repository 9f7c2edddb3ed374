// Data types, interfaces and values of the SDK as those of lwucm, and back.
#ifndef UCM_CTS_REFERENCE_CPP_VALUES_HPP
#define UCM_CTS_REFERENCE_CPP_VALUES_HPP

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <lwucm/interfaces.hpp>
#include <ucm_cts/values.hpp>

namespace reference_cpp {

// types

inline lwucm::IntegerKind integer_kind(const std::string& name) {
    typedef lwucm::IntegerKind Kind;
    static const std::map<std::string, Kind> kinds = {{"BYTE", Kind::BYTE},     {"SHORT", Kind::SHORT},
                                                      {"LONG", Kind::LONG},     {"LONGLONG", Kind::LONGLONG},
                                                      {"UBYTE", Kind::UBYTE},   {"USHORT", Kind::USHORT},
                                                      {"ULONG", Kind::ULONG},   {"ULONGLONG", Kind::ULONGLONG}};
    return kinds.at(name);
}

inline lwucm::TypePtr lwucm_type(const ucm_cts::DataType& type);

inline std::vector<lwucm::Field> lwucm_fields(const ucm_cts::DataType& type) {
    std::vector<lwucm::Field> fields;
    for (const auto& field : type.fields) {
        fields.push_back({field.first, lwucm_type(*field.second)});
    }
    return fields;
}

inline std::vector<lwucm::Enumerator> lwucm_enumerators(const ucm_cts::DataType& type) {
    std::vector<lwucm::Enumerator> enumerators;
    for (const auto& enumerator : type.enumerators) {
        const ucm_cts::Datum& value = enumerator.second;
        enumerators.push_back({enumerator.first, value.is_number_unsigned()
                                                     ? static_cast<std::int64_t>(value.get<std::uint64_t>())
                                                     : value.get<std::int64_t>()});
    }
    return enumerators;
}

inline std::vector<lwucm::Case> lwucm_cases(const ucm_cts::DataType& type) {
    std::vector<lwucm::Case> cases;
    for (const ucm_cts::UnionCase& one : type.cases) {
        cases.push_back({one.name, lwucm_type(*one.of), one.selectors, one.is_default});
    }
    return cases;
}

inline lwucm::TypePtr lwucm_type(const ucm_cts::DataType& type) {
    typedef ucm_cts::DataType::Kind Kind;
    const bool wide = type.base == "CHAR32" || type.base == "DOUBLE";
    switch (type.kind) {
        case Kind::integer:
            return lwucm::integer_type(integer_kind(type.base));
        case Kind::floating:
            return wide ? lwucm::double_type() : lwucm::float_type();
        case Kind::character:
            return wide ? lwucm::char32_type() : lwucm::char8_type();
        case Kind::boolean:
            return lwucm::boolean_type();
        case Kind::string:
            return wide ? lwucm::string32_type(type.size) : lwucm::string8_type(type.size);
        case Kind::enumeration:
            return lwucm::enumeration_type(type.name, integer_kind(type.base), lwucm_enumerators(type));
        case Kind::structure:
            return lwucm::structure_type(type.name, lwucm_fields(type));
        case Kind::union_type:
            return lwucm::union_type(type.name, lwucm_type(*type.of), lwucm_cases(type));
        case Kind::array:
            return lwucm::array_type(lwucm_type(*type.of),
                                     std::vector<std::size_t>(type.sizes.begin(), type.sizes.end()));
        case Kind::sequence:
            return lwucm::sequence_type(lwucm_type(*type.of), type.size);
        case Kind::alias:
            return lwucm::alias_type(type.name, lwucm_type(*type.of));
    }
    return nullptr;
}

inline lwucm::Method lwucm_method(const std::string& name, const ucm_cts::Method& method) {
    std::vector<lwucm::Parameter> parameters;
    for (const ucm_cts::Parameter& parameter : method.parameters) {
        parameters.push_back(
            {parameter.name, static_cast<lwucm::Direction>(parameter.direction), lwucm_type(*parameter.of)});
    }
    std::vector<lwucm::TypePtr> raises;
    for (const ucm_cts::SharedType& exception : method.raises) {
        raises.push_back(lwucm_type(*exception));
    }
    return lwucm::Method(name, std::move(parameters), std::move(raises));
}

inline lwucm::InterfacePtr lwucm_interface(const ucm_cts::Interface& interface) {
    const std::vector<std::string>& names = interface.inherited;
    std::vector<lwucm::Method> own;
    std::vector<lwucm::Method> inherited;
    for (const auto& method : interface.methods) {
        const bool is_inherited = std::find(names.begin(), names.end(), method.first) != names.end();
        (is_inherited ? inherited : own).push_back(lwucm_method(method.first, method.second));
    }
    const auto base = std::make_shared<const lwucm::Interface>(inherited);
    return std::make_shared<const lwucm::Interface>(own, std::vector<lwucm::InterfacePtr>{base});
}

// values

inline ucm_cts::Datum to_datum(const lwucm::Value& value) {
    typedef lwucm::Value::Kind Kind;
    switch (value.kind()) {
        case Kind::boolean:
            return value.as_boolean();
        case Kind::integer:
            return value.as_integer();
        case Kind::natural:
            return value.as_natural();
        case Kind::single:
            return ucm_cts::from_float(value.as_single());
        case Kind::real:
            return ucm_cts::from_float(value.as_real());
        case Kind::character:
            return static_cast<std::uint32_t>(value.as_character());
        case Kind::string:
            return ucm_cts::to_utf8(value.as_string());
        case Kind::enumerator:
            return value.as_enumerator();
        case Kind::list:
            break;
    }
    ucm_cts::Datum list = ucm_cts::Datum::array();
    for (const lwucm::Value& item : value.as_list()) {
        list.push_back(to_datum(item));
    }
    return list;
}

inline ucm_cts::Data to_data(const lwucm::Values& values) {
    ucm_cts::Data data;
    data.reserve(values.size());
    for (const lwucm::Value& value : values) {
        data.push_back(to_datum(value));
    }
    return data;
}

inline lwucm::Value to_value(const lwucm::Type& type, const ucm_cts::Datum& datum);

inline lwucm::Value to_list(const lwucm::Type& of, std::size_t dimensions, const ucm_cts::Datum& datum) {
    lwucm::Values items;
    items.reserve(datum.size());
    for (const ucm_cts::Datum& item : datum) {
        items.push_back(dimensions > 1 ? to_list(of, dimensions - 1, item) : to_value(of, item));
    }
    return lwucm::Value::list(std::move(items));
}

inline lwucm::Value to_structure(const lwucm::Type& type, const ucm_cts::Datum& datum) {
    lwucm::Values fields;
    for (std::size_t index = 0; index < type.fields.size(); ++index) {
        fields.push_back(to_value(*type.fields[index].type, datum.at(index)));
    }
    return lwucm::Value::list(std::move(fields));
}

inline lwucm::Value to_union(const lwucm::Type& type, const ucm_cts::Datum& datum) {
    lwucm::Values parts(1, to_value(*type.of, datum.at(0)));
    if (const lwucm::Case* const active = lwucm::selected_case(type, parts[0].as_enumerator())) {
        parts.push_back(to_value(*active->type, datum.at(1)));
    }
    return lwucm::Value::list(std::move(parts));
}

/// Throws what nlohmann::json throws if `datum` cannot be a value of `type`; whether it is one, lwucm finds out.
inline lwucm::Value to_value(const lwucm::Type& type, const ucm_cts::Datum& datum) {
    typedef lwucm::Type::Kind Kind;
    const lwucm::Type& meant = lwucm::resolved(type);
    switch (meant.kind) {
        case Kind::integer:
            return datum.is_number_unsigned() ? lwucm::Value::natural(datum.get<std::uint64_t>())
                                              : lwucm::Value::integer(datum.get<std::int64_t>());
        case Kind::single:
            return lwucm::Value::single(ucm_cts::to_float<float>(datum));
        case Kind::real:
            return lwucm::Value::real(ucm_cts::to_float<double>(datum));
        case Kind::character8:
        case Kind::character32:
            return lwucm::Value::character(static_cast<char32_t>(datum.get<std::uint32_t>()));
        case Kind::boolean:
            return lwucm::Value::boolean(datum.get<bool>());
        case Kind::string8:
        case Kind::string32:
            return lwucm::Value::string(ucm_cts::from_utf8<std::u32string>(datum.get<std::string>()));
        case Kind::enumeration:
            return lwucm::Value::enumerator(datum.get<std::string>());
        case Kind::structure:
            return to_structure(meant, datum);
        case Kind::union_type:
            return to_union(meant, datum);
        case Kind::array:
            return to_list(*meant.of, meant.sizes.size(), datum);
        case Kind::sequence:
            return to_list(*meant.of, 1, datum);
        case Kind::alias:
            break;  // is resolved
    }
    throw lwucm::BAD_PARAMETER("there are no values of such a type");
}

/// One value of each type. BAD_PARAMETER if there are more or fewer.
inline lwucm::Values to_values(const std::vector<lwucm::TypePtr>& types, const ucm_cts::Data& data) {
    if (types.size() != data.size()) {
        throw lwucm::BAD_PARAMETER("another number of values is due");
    }
    lwucm::Values values;
    values.reserve(data.size());
    for (std::size_t index = 0; index < data.size(); ++index) {
        values.push_back(to_value(*types[index], data[index]));
    }
    return values;
}

}  // namespace reference_cpp

#endif
