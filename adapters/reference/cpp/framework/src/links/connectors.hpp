// The connectors of clause 10.1.
#ifndef LWUCM_SRC_CONNECTORS_HPP
#define LWUCM_SRC_CONNECTORS_HPP

#include "links/link_impl.hpp"

namespace lwucm {

/// simple_service_connector (10.1.5): calls of clients are carried out by the server, and the clients wait.
std::shared_ptr<Link> make_service_connector(std::shared_ptr<Shared> shared, InterfacePtr interface);

/// simple_message_connector (10.1.6): each message that an emitter pushes goes to each receiver. BAD_PARAMETER if the
/// interface is not message_intf.
std::shared_ptr<Link> make_message_connector(std::shared_ptr<Shared> shared, InterfacePtr interface);

}  // namespace lwucm

#endif
