#include "links/request_response_interfaces.hpp"

#include <vector>

namespace lwucm {

const char* const REQUEST = "request";
const char* const RESPONSE = "response";

namespace {

TypePtr bound(const BoundTypes& types, const char* parameter) {
    const auto found = types.find(parameter);
    if (found == types.end() || !found->second || types.size() != 2) {
        throw BAD_PARAMETER(std::string("request-response is bound to request_data_t and response_data_t"));
    }
    return found->second;
}

InterfacePtr interface_with(const char* method, std::vector<Parameter> parameters) {
    parameters.push_back({"ecode", Direction::result, comm_ecode_type()});
    return std::make_shared<const Interface>(std::vector<Method>{Method(method, std::move(parameters))});
}

}  // namespace

TypePtr response_type(const BoundTypes& types) { return bound(types, "response_data_t"); }

PortElements port_elements(Role role, const BoundTypes& types) {
    const Parameter request = {"request", Direction::in, bound(types, "request_data_t")};
    const TypePtr id = integer_type(IntegerKind::ULONG);
    const InterfacePtr both =
        interface_with(REQUEST, {request, {"response", Direction::out, response_type(types)}});
    const InterfacePtr responses = interface_with(
        RESPONSE, {{"response", Direction::in, response_type(types)}, {"resp_id", Direction::in, id}});
    switch (role) {
        case Role::rr_synchronous_client:
            return {false, "", "client_p", nullptr, both};
        case Role::rr_synchronous_server:
            return {true, "server_p", "", both, nullptr};
        case Role::rr_asynchronous_client:
            return {false, "client_resp_p", "client_req_p", responses,
                    interface_with(REQUEST, {request, {"req_id", Direction::out, id}})};
        case Role::rr_asynchronous_server:
            return {true, "server_req_p", "server_resp_p",
                    interface_with(REQUEST, {request, {"req_id", Direction::in, id}}), responses};
        default:
            throw BAD_PARAMETER("the connector has no such role");
    }
}

Value any_value(const Type& type) {
    switch (type.kind) {
        case Type::Kind::integer:
            return Value::integer(0);
        case Type::Kind::single:
            return Value::single(0);
        case Type::Kind::real:
            return Value::real(0);
        case Type::Kind::character8:
        case Type::Kind::character32:
            return Value::character(0);
        case Type::Kind::boolean:
            return Value::boolean(false);
        case Type::Kind::string8:
        case Type::Kind::string32:
            return Value::string(std::u32string());
        case Type::Kind::enumeration:
            return Value::enumerator(type.enumerators.front().name);
        case Type::Kind::alias:
            return any_value(*type.of);
        case Type::Kind::union_type: {
            for (const Enumerator& one : resolved(*type.of).enumerators) {
                if (const Case* const selected = selected_case(type, one.name)) {
                    return Value::list({Value::enumerator(one.name), any_value(*selected->type)});
                }
            }
            return Value::list({Value::enumerator(resolved(*type.of).enumerators.front().name)});
        }
        case Type::Kind::structure: {
            Values fields;
            for (const Field& field : type.fields) {
                fields.push_back(any_value(*field.type));
            }
            return Value::list(fields);
        }
        case Type::Kind::array: {
            Value made = any_value(*type.of);
            for (auto size = type.sizes.rbegin(); size != type.sizes.rend(); ++size) {
                made = Value::list(Values(*size, made));
            }
            return made;
        }
        case Type::Kind::sequence:
            break;
    }
    return Value::list();
}

}  // namespace lwucm
