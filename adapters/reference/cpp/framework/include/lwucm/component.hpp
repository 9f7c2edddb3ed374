// What component bodies implement: clause 11.2.1 in the generic shape of 13.9.
#ifndef LWUCM_COMPONENT_HPP
#define LWUCM_COMPONENT_HPP

#include <memory>
#include <string>
#include <vector>

#include <ucm_support.hpp>

namespace lwucm {

class Container;

/// A provided port element; the interface of the port element derives from it (13.8). Generated ones do, too.
typedef ::ucm::PortElementObject PortElementObject;

typedef std::vector<std::shared_ptr<PortElementObject>> PortElementObjects;

/// A required port element and what it is connected to.
struct PortConnection {
    std::string from_port;
    PortElementObjects to_port;
};

typedef std::vector<PortConnection> PortConnections;

class ComponentObject {
  public:
    virtual ~ComponentObject() = default;
    virtual void on_init() = 0;
    virtual void on_remove() = 0;
    virtual void on_startup(const PortConnections& dependencies) = 0;
    virtual void on_shutdown() = 0;
    virtual std::shared_ptr<PortElementObject> get_portElement(const std::string& provided) = 0;
};

/// Implemented beside ComponentObject by fragments. The runtime never lets go of a fragment that still holds its
/// container, so a fragment forgets the reference in on_remove at the latest.
class FragmentObject {
  public:
    virtual ~FragmentObject() = default;
    virtual void set_container_interface(std::shared_ptr<Container> container) = 0;
};

/// Implemented beside ComponentObject by bodies that are called at each connection.
class Connectable {
  public:
    virtual ~Connectable() = default;
    virtual void on_connect(const std::string& port_name, std::shared_ptr<PortElementObject> required) = 0;
    virtual void on_disconnect(const std::string& port_name) = 0;
};

}  // namespace lwucm

#endif
