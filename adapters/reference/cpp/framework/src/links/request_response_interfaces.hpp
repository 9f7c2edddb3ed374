// The connector ports of request-response, and the interfaces of their port elements (10.4.1.1).
#ifndef LWUCM_SRC_REQUEST_RESPONSE_INTERFACES_HPP
#define LWUCM_SRC_REQUEST_RESPONSE_INTERFACES_HPP

#include "links/port_link.hpp"

namespace lwucm {

extern const char* const REQUEST;
extern const char* const RESPONSE;

/// BAD_PARAMETER if `role` is no connector port of request-response, or a type is missing or none of the connector's.
PortElements request_response_elements(Role role, const BoundTypes& types);

/// The type of the responses. BAD_PARAMETER if there is none.
TypePtr response_type(const BoundTypes& types);

}  // namespace lwucm

#endif
