// Connections with connectors (9.5.5.4, 10.1.5, 10.1.6, 10.4).
#ifndef LWUCM_LINKS_HPP
#define LWUCM_LINKS_HPP

#include <map>
#include <memory>
#include <string>

#include "lwucm/container.hpp"
#include "lwucm/interfaces.hpp"

namespace lwucm {

/// The connectors that a runtime has.
extern const char* const SIMPLE_SERVICE_CONNECTOR;
extern const char* const SIMPLE_MESSAGE_CONNECTOR;
extern const char* const REQUEST_RESPONSE_CONNECTOR;
extern const char* const SHARED_DATA_CONNECTOR;

/// What a port element is attached as; the last six are the connector ports of 10.4, for a port with all its elements.
enum class Role {
    client,
    server,
    emitter,
    receiver,
    rr_synchronous_client,
    rr_synchronous_server,
    rr_asynchronous_client,
    rr_asynchronous_server,
    sd_reader,
    sd_writer
};

/// The data types that a connector is bound to, by template parameter.
typedef std::map<std::string, TypePtr> BoundTypes;

/// comm_ecode (10.1.2), what push returns.
TypePtr comm_ecode_type();

/// message_intf (10.1.6), bound to a type of messages.
InterfacePtr message_interface(const TypePtr& message_type);

/// A connection with a connector. Its ends are port elements of components in any containers of the runtime; clients
/// and emitters require them, servers and receivers provide them.
class Link {
  public:
    virtual ~Link() = default;

    /// Makes a port element, or a port of 10.4, an end. NOT_FOUND if the container has no such component; BAD_PARAMETER if
    /// the connector has no such role, or the component no such port element with the interface of the link; UCM_ERROR
    /// if the container is started, the required port element is connected already, or the service has its server.
    virtual void attach(Role role, const std::shared_ptr<Container>& container, componentId component,
                        const std::string& port) = 0;

    /// The port element is no longer an end. NOT_FOUND if it is none; UCM_ERROR if the container is started.
    virtual void detach(const std::shared_ptr<Container>& container, componentId component,
                        const std::string& port) = 0;

    // To see what an application does when communication fails: from now on nothing can be transmitted, or the
    // connector itself does not work, until it is mended. These operations may be called at any time from any thread.
    virtual void break_transport() = 0;
    virtual void break_connector() = 0;
    virtual void mend() = 0;
};

}  // namespace lwucm

#endif
