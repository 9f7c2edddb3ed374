// made by python -m ucm_cts.adapters.contract.generating from protocol.schema.json: do not edit
#ifndef UCM_CTS_GENERATED_MESSAGES_READING_HPP
#define UCM_CTS_GENERATED_MESSAGES_READING_HPP

#include <memory>
#include <string>

#include "ucm_cts/generated/messages.hpp"
#include "ucm_cts/json.hpp"

// Each function reads what the protocol allows; a ProtocolError names the first thing that it does not allow.
namespace ucm_cts {

inline void read(const json::Value& value, Hello& into);
inline void read(const json::Value& value, Remembered& into);
inline void read(const json::Value& value, FromClock& into);
inline void read(const json::Value& value, TimerFrom& into);
inline void read(const json::Value& value, Action& into);
inline void read(const json::Value& value, Policy& into);
inline void read(const json::Value& value, Declaration& into);
inline void read(const json::Value& value, Step& into);
inline void read(const json::Value& value, UnionCase& into);
inline void read(const json::Value& value, DataType& into);
inline void read(const json::Value& value, Parameter& into);
inline void read(const json::Value& value, Method& into);
inline void read(const json::Value& value, Interface& into);
inline void read(const json::Value& value, Scenario& into);
inline void read(const json::Value& value, Run& into);

inline void read(const json::Value& value, Hello& into) {
    json::Fields fields(value);
    std::string tag;
    fields.required("type", tag);
    fields.required("protocol", into.protocol);
    fields.end();
}

inline void read(const json::Value& value, Remembered& into) {
    json::Fields fields(value);
    fields.required("argument", into.argument);
    fields.required("method", into.method);
    fields.required("position", into.position);
    fields.optional("nth", into.nth);
    fields.end();
}

inline void read(const json::Value& value, FromClock& into) {
    json::Fields fields(value);
    fields.required("argument", into.argument);
    fields.required("port", into.port);
    fields.required("method", into.method);
    fields.end();
}

inline void read(const json::Value& value, TimerFrom& into) {
    json::Fields fields(value);
    fields.required("method", into.method);
    fields.optional("nth", into.nth);
    fields.end();
}

inline void read_members(json::Fields& fields, Action& into) {
    switch (into.kind) {
        case Action::Kind::raise:
        case Action::Kind::siblings:
        case Action::Kind::count:
            break;
        case Action::Kind::return_value:
            fields.required("value", into.value);
            break;
        case Action::Kind::call:
            fields.required("port", into.port);
            fields.required("value", into.value);
            break;
        case Action::Kind::hold:
            fields.required("gate", into.gate);
            break;
        case Action::Kind::call_method:
            fields.required("port", into.port);
            fields.required("method", into.method);
            fields.optional("arguments", into.arguments);
            fields.optional("remembered", into.remembered);
            into.has_given = fields.nullable("given", into.given);
            into.has_from_clock = fields.nullable("from_clock", into.from_clock);
            into.has_handler = fields.nullable("handler", into.handler);
            into.has_on = fields.nullable("on", into.on);
            break;
        case Action::Kind::answer:
            fields.required("method", into.method);
            into.has_results = fields.nullable("results", into.results);
            into.has_exception = fields.nullable("exception", into.exception);
            fields.optional("overwrite", into.overwrite);
            break;
        case Action::Kind::burst:
            fields.required("port", into.port);
            fields.required("first", into.first);
            fields.required("count", into.count);
            break;
    }
}

inline void read(const json::Value& value, Action& into) {
    json::Fields fields(value);
    fields.required("do", into.kind, "Invalid value");
    read_members(fields, into);
    fields.end();
}

inline void read(const json::Value& value, Policy& into) {
    json::Fields fields(value);
    fields.required("definition", into.definition);
    fields.nullable("port", into.port);
    fields.optional("parameters", into.parameters);
    fields.nullable("element", into.element);
    fields.optional("settings", into.settings);
    fields.end();
}

inline void read(const json::Value& value, Declaration& into) {
    json::Fields fields(value);
    fields.optional("provides", into.provided);
    fields.optional("requires", into.required);
    fields.optional("attributes", into.attributes);
    fields.optional("connectable", into.connectable);
    fields.optional("fragment", into.fragment);
    fields.optional("plan", into.plan);
    fields.optional("policies", into.policies);
    fields.optional("ports", into.ports);
    fields.optional("defaults", into.defaults);
    fields.optional("handlers", into.handlers);
    fields.end();
}

inline Words words_of_Link_connector() {
    static const char* const words[] = {
        "request-response_connector", "shared-data_connector", "simple_message_connector", "simple_service_connector"
    };
    return Words{words, 4};
}

inline Words words_of_Attach_role() {
    static const char* const words[] = {
        "client", "emitter", "receiver", "rr_asynchronous_client", "rr_asynchronous_server", "rr_synchronous_client",
        "rr_synchronous_server", "sd_reader", "sd_writer", "server"
    };
    return Words{words, 10};
}

inline Words words_of_Break_where() {
    static const char* const words[] = {
        "inside", "transport"
    };
    return Words{words, 2};
}

inline void read_members(json::Fields& fields, Step& into) {
    into.has_thread = fields.nullable("thread", into.thread);
    switch (into.kind) {
        case Step::Kind::add_component:
            fields.required("component", into.component);
            fields.optional("container", into.container);
            fields.optional("bind", into.bind);
            fields.optional("attributes", into.attributes);
            break;
        case Step::Kind::remove_component:
            fields.required("id", into.id);
            fields.optional("container", into.container);
            break;
        case Step::Kind::get_port_element:
            fields.required("id", into.id);
            fields.required("port", into.port);
            fields.required("bind", into.bind);
            fields.optional("container", into.container);
            break;
        case Step::Kind::connect:
            fields.required("id", into.id);
            fields.required("port", into.port);
            fields.required("to", into.to);
            fields.required("bind", into.bind);
            fields.optional("container", into.container);
            break;
        case Step::Kind::disconnect:
            fields.required("connection", into.connection);
            fields.optional("container", into.container);
            break;
        case Step::Kind::start:
        case Step::Kind::stop:
        case Step::Kind::get_components:
            fields.optional("container", into.container);
            break;
        case Step::Kind::create_container:
            fields.required("bind", into.bind);
            break;
        case Step::Kind::remove_container:
            fields.required("container", into.container);
            break;
        case Step::Kind::destroy:
            break;
        case Step::Kind::invoke:
            fields.required("ref", into.ref);
            fields.required("value", into.value);
            break;
        case Step::Kind::open:
            fields.required("gate", into.gate);
            break;
        case Step::Kind::reach:
            fields.required("gate", into.gate);
            fields.optional("more", into.more);
            fields.optional("total", into.total);
            break;
        case Step::Kind::settle:
        case Step::Kind::join:
            fields.required("worker", into.worker);
            break;
        case Step::Kind::link:
            fields.required("connector", into.connector, words_of_Link_connector());
            fields.required("interface", into.interface);
            fields.required("bind", into.bind);
            break;
        case Step::Kind::attach:
            fields.required("link", into.link);
            fields.required("role", into.role, words_of_Attach_role());
            fields.required("id", into.id);
            fields.required("port", into.port);
            fields.optional("container", into.container);
            break;
        case Step::Kind::detach:
            fields.required("link", into.link);
            fields.required("id", into.id);
            fields.required("port", into.port);
            fields.optional("container", into.container);
            break;
        case Step::Kind::break_link:
            fields.required("link", into.link);
            fields.optional("where", into.where, words_of_Break_where());
            break;
        case Step::Kind::mend_link:
            fields.required("link", into.link);
            break;
        case Step::Kind::read_log:
            fields.optional("records", into.records);
            break;
        case Step::Kind::pause:
        case Step::Kind::advance:
            fields.required("milliseconds", into.milliseconds);
            break;
        case Step::Kind::await_messages:
            fields.required("component", into.component);
            fields.required("count", into.count);
            fields.optional("instance", into.instance);
            break;
        case Step::Kind::stress:
            fields.required("refs", into.refs);
            fields.optional("milliseconds", into.milliseconds);
            break;
    }
}

inline void read(const json::Value& value, Step& into) {
    json::Fields fields(value);
    fields.required("op", into.kind, "Invalid value");
    read_members(fields, into);
    fields.end();
}

inline void read(const json::Value& value, UnionCase& into) {
    json::Fields fields(value);
    fields.required("name", into.name);
    fields.required("of", into.of);
    fields.optional("selectors", into.selectors);
    fields.optional("default", into.is_default);
    fields.end();
}

inline Words words_of_Integer_kind() {
    static const char* const words[] = {
        "BYTE", "LONG", "LONGLONG", "SHORT", "UBYTE", "ULONG", "ULONGLONG", "USHORT"
    };
    return Words{words, 8};
}

inline Words words_of_Float_kind() {
    static const char* const words[] = {
        "DOUBLE", "FLOAT"
    };
    return Words{words, 2};
}

inline Words words_of_Char_kind() {
    static const char* const words[] = {
        "CHAR32", "CHAR8"
    };
    return Words{words, 2};
}

inline Words words_of_String_base() {
    static const char* const words[] = {
        "CHAR32", "CHAR8"
    };
    return Words{words, 2};
}

inline Words words_of_Enumeration_index() {
    static const char* const words[] = {
        "BYTE", "LONG", "LONGLONG", "SHORT", "UBYTE", "ULONG", "ULONGLONG", "USHORT"
    };
    return Words{words, 8};
}

inline void read_members(json::Fields& fields, DataType& into);

// Where only one kind of type can stand its tag may be missing.
inline void read_type(const json::Value& value, SharedType& into, DataType::Kind kind) {
    const std::shared_ptr<DataType> type = std::make_shared<DataType>();
    json::Fields fields(value);
    type->kind = kind;
    fields.optional("type", type->kind, "Invalid value");
    if (type->kind != kind) {
        value.fail("Invalid value '" + std::string(word_of(type->kind)) + "'");
    }
    read_members(fields, *type);
    fields.end();
    into = type;
}

inline void read_enumeration(const json::Value& value, SharedType& into) {
    read_type(value, into, DataType::Kind::enumeration);
}

inline void read_structure(const json::Value& value, SharedType& into) {
    read_type(value, into, DataType::Kind::structure);
}

inline void read_members(json::Fields& fields, DataType& into) {
    switch (into.kind) {
        case DataType::Kind::integer:
            fields.required("kind", into.base, words_of_Integer_kind());
            break;
        case DataType::Kind::floating:
            fields.required("kind", into.base, words_of_Float_kind());
            break;
        case DataType::Kind::character:
            fields.required("kind", into.base, words_of_Char_kind());
            break;
        case DataType::Kind::boolean:
            break;
        case DataType::Kind::string:
            fields.required("base", into.base, words_of_String_base());
            fields.optional("size", into.size);
            break;
        case DataType::Kind::enumeration:
            fields.required("name", into.name);
            fields.required("index", into.base, words_of_Enumeration_index());
            fields.required("values", into.enumerators, json::read_integers);
            break;
        case DataType::Kind::structure:
            fields.required("name", into.name);
            fields.required("fields", into.fields);
            break;
        case DataType::Kind::union_type:
            fields.required("name", into.name);
            fields.required("selector", into.of, read_enumeration);
            fields.required("cases", into.cases);
            break;
        case DataType::Kind::array:
            fields.required("of", into.of);
            fields.required("sizes", into.sizes);
            break;
        case DataType::Kind::sequence:
            fields.required("of", into.of);
            fields.optional("size", into.size);
            break;
        case DataType::Kind::alias:
            fields.required("name", into.name);
            fields.required("of", into.of);
            break;
    }
}

inline void read(const json::Value& value, DataType& into) {
    json::Fields fields(value);
    fields.required("type", into.kind, "Invalid value");
    read_members(fields, into);
    fields.end();
}

inline void read(const json::Value& value, Parameter& into) {
    json::Fields fields(value);
    fields.required("name", into.name);
    fields.required("direction", into.direction);
    fields.required("of", into.of);
    fields.end();
}

inline void read(const json::Value& value, Method& into) {
    json::Fields fields(value);
    fields.optional("parameters", into.parameters);
    fields.optional("raises", into.raises, json::read_each<SharedType, read_structure>);
    fields.end();
}

inline void read(const json::Value& value, Interface& into) {
    json::Fields fields(value);
    fields.required("methods", into.methods);
    fields.optional("inherited", into.inherited);
    fields.end();
}

inline void read(const json::Value& value, Scenario& into) {
    json::Fields fields(value);
    fields.required("components", into.components);
    fields.required("steps", into.steps);
    fields.optional("patience", into.patience);
    fields.optional("interfaces", into.interfaces);
    fields.optional("may_stay", into.may_stay);
    fields.optional("types", into.types);
    fields.end();
}

inline void read(const json::Value& value, Run& into) {
    json::Fields fields(value);
    std::string tag;
    fields.required("type", tag);
    fields.required("id", into.id);
    fields.required("scenario", into.scenario);
    fields.optional("stream", into.stream);
    fields.end();
}

}  // namespace ucm_cts

#endif
