// The component implementations a runtime can instantiate.
#ifndef LWUCM_REPOSITORY_HPP
#define LWUCM_REPOSITORY_HPP

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lwucm/component.hpp"
#include "lwucm/interfaces.hpp"
#include "lwucm/policies.hpp"

namespace lwucm {

/// What the runtime must know of an implementation: its model (names of port elements and attributes) and how to make
/// and configure bodies. `set_attribute` is called once for each attribute that add_component configures. `interfaces`
/// are those of the port elements that can be called by name; only they can be ends of links.
struct Implementation {
    typedef std::vector<std::string> Names;
    typedef std::function<std::shared_ptr<ComponentObject>()> Create;
    typedef std::function<void(ComponentObject& body, const std::string& name, const std::string& value)> SetAttribute;

    Implementation(std::string its_name, Names its_provided, Names its_required, Names its_attributes,
                   Create how_to_create, SetAttribute how_to_set_attribute, Policies its_policies = Policies(),
                   std::map<std::string, InterfacePtr> its_interfaces = {})
        : name(std::move(its_name)),
          provided(std::move(its_provided)),
          required(std::move(its_required)),
          attributes(std::move(its_attributes)),
          create(std::move(how_to_create)),
          set_attribute(std::move(how_to_set_attribute)),
          policies(std::move(its_policies)),
          interfaces(std::move(its_interfaces)) {}

    std::string name;
    Names provided;
    Names required;
    Names attributes;
    Create create;
    SetAttribute set_attribute;
    Policies policies;
    std::map<std::string, InterfacePtr> interfaces;
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
