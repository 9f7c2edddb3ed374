// The connector ports of request-response, and the interfaces of their port elements (10.4.1.1).
#ifndef LWUCM_SRC_REQUEST_RESPONSE_INTERFACES_HPP
#define LWUCM_SRC_REQUEST_RESPONSE_INTERFACES_HPP

#include <string>

#include "lwucm/links.hpp"

namespace lwucm {

extern const char* const REQUEST;
extern const char* const RESPONSE;

/// The port elements of a connector port: the names of the one that the component provides and of the one that it
/// requires, empty if there is none, each with its interface.
struct PortElements {
    bool is_server;
    std::string provided;
    std::string required;
    InterfacePtr provided_interface;
    InterfacePtr required_interface;
};

/// BAD_PARAMETER if `role` is no connector port of request-response, or a type is missing or none of the connector's.
PortElements port_elements(Role role, const BoundTypes& types);

/// The type of the responses. BAD_PARAMETER if there is none.
TypePtr response_type(const BoundTypes& types);

/// A value of the type, for results that mean nothing.
Value any_value(const Type& type);

}  // namespace lwucm

#endif
