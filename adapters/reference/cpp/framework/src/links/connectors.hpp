// The connectors of clauses 10.1 and 10.4.
#ifndef LWUCM_SRC_CONNECTORS_HPP
#define LWUCM_SRC_CONNECTORS_HPP

#include "links/link_impl.hpp"

namespace lwucm {

/// simple_service_connector (10.1.5): calls of clients are carried out by the server, and the clients wait.
std::shared_ptr<Link> make_service_connector(std::shared_ptr<Shared> shared, InterfacePtr interface);

/// simple_message_connector (10.1.6): each message that an emitter pushes goes to each receiver. BAD_PARAMETER if the
/// interface is not message_intf.
std::shared_ptr<Link> make_message_connector(std::shared_ptr<Shared> shared, InterfacePtr interface);

/// request-response_connector (10.4.1): clients ask a server, and wait or get the response later. BAD_PARAMETER if the
/// types are not those of request and response.
std::shared_ptr<Link> make_request_response_connector(std::shared_ptr<Shared> shared, const BoundTypes& types);

/// shared-data_connector (10.4.2): writers set and publish a value, readers are notified and read it. BAD_PARAMETER if the
/// type is not that of shared data.
std::shared_ptr<Link> make_shared_data_connector(std::shared_ptr<Shared> shared, const BoundTypes& types);

}  // namespace lwucm

#endif
