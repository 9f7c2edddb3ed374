// Reading interfaces, their types and values, as the protocol has them.
#ifndef UCM_CTS_DATA_TYPES_READING_HPP
#define UCM_CTS_DATA_TYPES_READING_HPP

#include <memory>
#include <string>
#include <vector>

#include "ucm_cts/data_types.hpp"
#include "ucm_cts/json.hpp"

namespace ucm_cts {
namespace detail {

const char* const INTEGER_KINDS[] = {"BYTE", "SHORT", "LONG", "LONGLONG", "UBYTE", "USHORT", "ULONG", "ULONGLONG"};
const char* const FLOAT_KINDS[] = {"FLOAT", "DOUBLE"};
const char* const CHAR_KINDS[] = {"CHAR8", "CHAR32"};

inline SharedType read_type(const json::Value& value);

inline std::vector<std::string> read_names(const json::Value& value) {
    std::vector<std::string> names;
    value.for_each_element([&names](const json::Value& name) { names.push_back(name.text()); });
    return names;
}

inline Datum read_datum(const json::Value& value) {
    switch (value.kind()) {
        case json::Kind::null:
        case json::Kind::floating:
        case json::Kind::object:
            value.fail(std::string("Expected `bool | int | str | array`, got `") + name_of(value.kind()) + "`");
        default:
            return value.tree();
    }
}

inline Data read_data(const json::Value& value) {
    Data data;
    value.for_each_element([&data](const json::Value& one) { data.push_back(read_datum(one)); });
    return data;
}

inline Datum read_any_integer(const json::Value& value) {
    return value.kind() == json::Kind::too_large ? value.tree() : Datum(value.integer());
}

inline void read_of(json::Fields& fields, SharedType& of) {
    fields.required("of", [&of](const json::Value& value) { of = read_type(value); });
}

inline UnionCase read_case(const json::Value& value) {
    UnionCase one = {"", nullptr, {}, false};
    json::Fields fields(value);
    fields.text("name", one.name);
    read_of(fields, one.of);
    fields.optional("selectors", [&one](const json::Value& names) { one.selectors = read_names(names); });
    fields.optional_boolean("default", one.is_default);
    fields.end();
    return one;
}

inline DataType::Kind read_type_kind(const json::Value& tag) {
    static const struct {
        const char* name;
        DataType::Kind kind;
    } kinds[] = {{"integer", DataType::Kind::integer},         {"float", DataType::Kind::floating},
                 {"char", DataType::Kind::character},          {"boolean", DataType::Kind::boolean},
                 {"string", DataType::Kind::string},           {"enumeration", DataType::Kind::enumeration},
                 {"structure", DataType::Kind::structure},     {"union", DataType::Kind::union_type},
                 {"array", DataType::Kind::array},             {"sequence", DataType::Kind::sequence},
                 {"alias", DataType::Kind::alias}};
    const std::string name = tag.text();
    for (const auto& known : kinds) {
        if (name == known.name) {
            return known.kind;
        }
    }
    tag.fail("Invalid value '" + name + "'");
}

inline SharedType read_enumeration(const json::Value& value);

inline void read_details(json::Fields& fields, DataType& type) {
    switch (type.kind) {
        case DataType::Kind::integer:
            fields.choice("kind", INTEGER_KINDS, type.base);
            break;
        case DataType::Kind::floating:
            fields.choice("kind", FLOAT_KINDS, type.base);
            break;
        case DataType::Kind::character:
            fields.choice("kind", CHAR_KINDS, type.base);
            break;
        case DataType::Kind::boolean:
            break;
        case DataType::Kind::string:
            fields.choice("base", CHAR_KINDS, type.base);
            fields.optional_integer("size", type.size);
            break;
        case DataType::Kind::enumeration:
            fields.text("name", type.name);
            fields.choice("index", INTEGER_KINDS, type.base);
            fields.required("values", [&type](const json::Value& values) {
                values.for_each_member([&type](const json::Value& one) {
                    type.enumerators.emplace_back(one.key(), read_any_integer(one));
                });
            });
            break;
        case DataType::Kind::structure:
            fields.text("name", type.name);
            fields.required("fields", [&type](const json::Value& members) {
                members.for_each_member(
                    [&type](const json::Value& one) { type.fields.emplace_back(one.key(), read_type(one)); });
            });
            break;
        case DataType::Kind::union_type:
            fields.text("name", type.name);
            fields.required("selector", [&type](const json::Value& one) { type.of = read_enumeration(one); });
            fields.required("cases", [&type](const json::Value& cases) {
                cases.for_each_element([&type](const json::Value& one) { type.cases.push_back(read_case(one)); });
            });
            break;
        case DataType::Kind::array:
            read_of(fields, type.of);
            fields.required("sizes", [&type](const json::Value& sizes) {
                sizes.for_each_element([&type](const json::Value& size) { type.sizes.push_back(size.integer()); });
            });
            break;
        case DataType::Kind::sequence:
            read_of(fields, type.of);
            fields.optional_integer("size", type.size);
            break;
        case DataType::Kind::alias:
            fields.text("name", type.name);
            read_of(fields, type.of);
            break;
    }
}

inline SharedType read_type(const json::Value& value) {
    const std::shared_ptr<DataType> type = std::make_shared<DataType>();
    json::Fields fields(value);
    fields.required("type", [&type](const json::Value& tag) { type->kind = read_type_kind(tag); });
    read_details(fields, *type);
    fields.end();
    return type;
}

// Where only one kind of type can stand its tag may be missing.
inline SharedType read_type_of_kind(const json::Value& value, DataType::Kind kind) {
    const std::shared_ptr<DataType> type = std::make_shared<DataType>();
    type->kind = kind;
    json::Fields fields(value);
    fields.optional("type", [kind](const json::Value& tag) {
        if (read_type_kind(tag) != kind) {
            tag.fail("Invalid value '" + tag.text() + "'");
        }
    });
    read_details(fields, *type);
    fields.end();
    return type;
}

inline SharedType read_enumeration(const json::Value& value) {
    return read_type_of_kind(value, DataType::Kind::enumeration);
}

inline Parameter read_parameter(const json::Value& value) {
    static const char* const directions[] = {"IN", "OUT", "INOUT", "RETURN"};
    Parameter parameter = {"", Direction::in, nullptr};
    std::string direction;
    json::Fields fields(value);
    fields.text("name", parameter.name);
    fields.choice("direction", directions, direction);
    parameter.direction = direction == "IN"      ? Direction::in
                          : direction == "OUT"   ? Direction::out
                          : direction == "INOUT" ? Direction::inout
                                                 : Direction::result;
    read_of(fields, parameter.of);
    fields.end();
    return parameter;
}

inline Method read_method(const json::Value& value) {
    Method method;
    json::Fields fields(value);
    fields.optional("parameters", [&method](const json::Value& parameters) {
        parameters.for_each_element(
            [&method](const json::Value& one) { method.parameters.push_back(read_parameter(one)); });
    });
    fields.optional("raises", [&method](const json::Value& exceptions) {
        exceptions.for_each_element([&method](const json::Value& one) {
            method.raises.push_back(read_type_of_kind(one, DataType::Kind::structure));
        });
    });
    fields.end();
    return method;
}

inline SharedInterface read_interface(const json::Value& value) {
    const std::shared_ptr<Interface> interface = std::make_shared<Interface>();
    json::Fields fields(value);
    fields.required("methods", [&interface](const json::Value& methods) {
        methods.for_each_member(
            [&interface](const json::Value& one) { interface->methods[one.key()] = read_method(one); });
    });
    fields.optional("inherited", [&interface](const json::Value& names) { interface->inherited = read_names(names); });
    fields.end();
    return interface;
}

}  // namespace detail
}  // namespace ucm_cts

#endif
