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

PortElements request_response_elements(Role role, const BoundTypes& types) {
    const Parameter request = {"request", Direction::in, bound(types, "request_data_t")};
    const TypePtr id = integer_type(IntegerKind::ULONG);
    const InterfacePtr both =
        interface_with(REQUEST, {request, {"response", Direction::out, response_type(types)}});
    const InterfacePtr responses = interface_with(
        RESPONSE, {{"response", Direction::in, response_type(types)}, {"resp_id", Direction::in, id}});
    switch (role) {
        case Role::rr_synchronous_client:
            return {"", "client_p", nullptr, both};
        case Role::rr_synchronous_server:
            return {"server_p", "", both, nullptr};
        case Role::rr_asynchronous_client:
            return {"client_resp_p", "client_req_p", responses,
                    interface_with(REQUEST, {request, {"req_id", Direction::out, id}})};
        case Role::rr_asynchronous_server:
            return {"server_req_p", "server_resp_p",
                    interface_with(REQUEST, {request, {"req_id", Direction::in, id}}), responses};
        default:
            throw BAD_PARAMETER("the connector has no such role");
    }
}

}  // namespace lwucm
