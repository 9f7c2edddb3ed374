// ShapedAdapter: for a framework whose C++ API already has the shape of 12.10. All types are derived from those that
// the Traits name; see docs/adapter-cpp.md.
#ifndef UCM_CTS_SHAPED_HPP
#define UCM_CTS_SHAPED_HPP

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/shaped_body.hpp"

namespace ucm_cts {

/// Name and value pairs as a framework's Properties: `name` = `implementation`, then the attributes.
template <class Properties>
Properties properties(const std::string& name, const std::string& implementation, const Attributes& attributes) {
    Properties all;
    all.resize(1 + attributes.size());
    auto property = all.begin();
    property->name = name;
    property->value = implementation;
    for (const auto& attribute : attributes) {
        ++property;
        property->name = attribute.first;
        property->value = attribute.second;
    }
    return all;
}

/// `Traits` has
///   - types PortElementObject, ComponentObject, FragmentObject, Connectable, Container, ContainerManager, and the
///     exceptions NOT_FOUND, BAD_PARAMETER, UCM_ERROR;
///   - `static std::shared_ptr<ContainerManager> create_runtime(const std::vector<ShapedImplementation<Traits>>&)`;
///   - `static Properties configuration(const std::string& implementation, const Attributes&)`, what add_component takes.
///
/// Where port elements are typed (13.8), `typedef ... Exchange` is the abstract class that was generated from the probe models
/// for exchange_intf; it derives from PortElementObject.
///
/// For port elements with interfaces (profile core) it also has
///   - `static std::shared_ptr<PortElementObject> typed(const Reference& own, const SharedInterface&)`: a port element of
///     the framework, each method of which is `own->call(method, arguments)`; what that throws as DeclaredException, it
///     throws in the framework's way. Its class also derives from `ProbesOwn(own)`, so that the SDK recognises it. Asked
///     for once a port element. The null pointer stands for a port element without interface.
///   - `static Data call(PortElementObject&, const std::string& method, const Data& arguments)`: calls a method of
///     any object that the framework handed over: what `typed` made, what stands before it, or the framework's own port element
///     for a policy. A declared exception leaves it as DeclaredException, any other as it is.
/// Connectors and the rest of profile core are operations of Adapter: derive from ShapedAdapter and override `link`,
/// `attach`, ..., with `of`, `manager_` and `translate` at hand.
template <class Traits>
class ShapedAdapter : public Adapter {
  public:
    typedef typename Traits::Container Container;
    typedef typename Traits::ContainerManager ContainerManager;

    ContainerHandle create_runtime(const std::vector<Implementation>& implementations) override {
        std::vector<ShapedImplementation<Traits>> shaped;
        shaped.reserve(implementations.size());
        for (const Implementation& implementation : implementations) {
            shaped.push_back(ShapedImplementation<Traits>(implementation));
        }
        manager_ = Traits::create_runtime(shaped);
        return std::shared_ptr<Container>(manager_);
    }

    Id add_component(const ContainerHandle& container, const std::string& implementation,
                               const Attributes& attributes) override {
        return translate([&]() -> Id {
            return of(container).add_component(Traits::configuration(implementation, attributes));
        });
    }

    void remove_component(const ContainerHandle& container, Id comp_instance) override {
        typedef detail::Argument<decltype(&Container::remove_component), 0> Given;
        translate([&] { of(container).remove_component(static_cast<Given>(comp_instance)); });
    }

    Reference get_port_element(const ContainerHandle& container, Id comp_instance,
                               const std::string& port_name) override {
        typedef detail::Argument<decltype(&Container::get_port_element), 0> Given;
        return translate([&] {
            return ShapedReference<Traits>::wrap(
                of(container).get_port_element(static_cast<Given>(comp_instance), port_name));
        });
    }

    Id connect(const ContainerHandle& container, Id instance, const std::string& port_name,
               const Reference& to_port) override {
        typedef detail::Argument<decltype(&Container::connect), 0> Given;
        return translate([&]() -> Id {
            return of(container).connect(static_cast<Given>(instance), port_name,
                                         ShapedReference<Traits>::unwrap(to_port));
        });
    }

    void disconnect(const ContainerHandle& container, Id connection) override {
        typedef detail::Argument<decltype(&Container::disconnect), 0> Given;
        translate([&] { of(container).disconnect(static_cast<Given>(connection)); });
    }

    void start(const ContainerHandle& container) override {
        translate([&] { of(container).start(); });
    }

    void stop(const ContainerHandle& container) override {
        translate([&] { of(container).stop(); });
    }

    std::vector<Id> get_components(const ContainerHandle& container) override {
        return translate([&] {
            const auto ids = of(container).get_components();
            return std::vector<Id>(ids.begin(), ids.end());
        });
    }

    ContainerHandle create_container(const ContainerHandle&) override {
        typedef typename std::decay<detail::Argument<decltype(&ContainerManager::create_container), 0>>::type Properties;
        return translate([&]() -> ContainerHandle {
            return std::shared_ptr<Container>(manager_->create_container(Properties()));
        });
    }

    void remove_container(const ContainerHandle&, const ContainerHandle& sub_container) override {
        translate([&] { manager_->remove_container(std::static_pointer_cast<Container>(sub_container)); });
    }

    void destroy(const ContainerHandle&) override {
        translate([&] { manager_->destroy(); });
    }

  protected:
    /// The framework's own container behind a handle.
    static Container& of(const ContainerHandle& container) {
        if (!container) {
            throw std::logic_error("an operation of a null container cannot be called");
        }
        return *static_cast<Container*>(container.get());
    }

    /// Calls `operation`; the framework's three exceptions become those of the SDK, all others pass.
    template <class Operation>
    static auto translate(Operation operation) -> decltype(operation()) {
        try {
            return operation();
        } catch (const typename Traits::NOT_FOUND& error) {
            throw NotFound(detail::text_of(error));
        } catch (const typename Traits::BAD_PARAMETER& error) {
            throw BadParameter(detail::text_of(error));
        } catch (const typename Traits::UCM_ERROR& error) {
            throw UcmError(detail::text_of(error));
        }
    }

    std::shared_ptr<ContainerManager> manager_;
};

}  // namespace ucm_cts

#endif
