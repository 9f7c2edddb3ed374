// The Container API (11.2.2, 12.10).
#ifndef LWUCM_CONTAINER_HPP
#define LWUCM_CONTAINER_HPP

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lwucm/component.hpp"

namespace lwucm {

struct Property {
    std::string name;
    std::string value;
};

typedef std::vector<Property> Properties;
typedef std::int32_t componentId;
typedef std::vector<componentId> componentIds;
typedef std::int32_t connectionId;

/// Members of one technical scope, and their common life cycle. All operations may be called from any thread; those
/// that change something are carried out one after the other, and are refused when a callback makes them.
class Container {
  public:
    virtual ~Container() = default;
    virtual componentId add_component(const Properties& configValues) = 0;
    virtual void remove_component(componentId comp_instance) = 0;
    virtual std::shared_ptr<PortElementObject> get_port_element(componentId comp_instance,
                                                                const std::string& port_name) = 0;
    virtual connectionId connect(componentId instance, const std::string& port_name,
                                 std::shared_ptr<PortElementObject> to_port) = 0;
    virtual void disconnect(connectionId connection) = 0;
    virtual void start() = 0;
    virtual void stop() = 0;
    virtual componentIds get_components() = 0;
};

/// The root container, which is the runtime.
class ContainerManager : public virtual Container {
  public:
    virtual std::shared_ptr<Container> create_container(const Properties& configValues) = 0;
    virtual void remove_container(std::shared_ptr<Container> subContainer) = 0;
    virtual void destroy() = 0;
};

}  // namespace lwucm

#endif
