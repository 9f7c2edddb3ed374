// The component implementations a runtime can instantiate.
#ifndef LWUCM_REPOSITORY_HPP
#define LWUCM_REPOSITORY_HPP

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lwucm/component.hpp"

namespace lwucm {

/// What the runtime must know of an implementation: its model (names of port elements and attributes) and how to make
/// and configure bodies. `set_attribute` is called once for each attribute that add_component configures.
struct Implementation {
    std::string name;
    std::vector<std::string> provided;
    std::vector<std::string> required;
    std::vector<std::string> attributes;
    std::function<std::shared_ptr<ComponentObject>()> create;
    std::function<void(ComponentObject& body, const std::string& name, const std::string& value)> set_attribute;
};

class Repository {
  public:
    /// Adds an implementation. A second one of the same name, or a port element declared twice, is BAD_PARAMETER.
    void add(Implementation implementation);

    /// The implementation of that name, or null.
    std::shared_ptr<const Implementation> find(const std::string& name) const;

  private:
    std::map<std::string, std::shared_ptr<const Implementation>> implementations_;
};

}  // namespace lwucm

#endif
