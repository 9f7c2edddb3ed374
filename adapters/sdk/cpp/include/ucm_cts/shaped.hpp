// ShapedAdapter: for a framework whose C++ API already has the shape of 12.10. All types are derived from those that
// the Traits name; see docs/adapter-cpp.md.
#ifndef UCM_CTS_SHAPED_HPP
#define UCM_CTS_SHAPED_HPP

#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/shaped_body.hpp"

namespace ucm_cts {

namespace detail {

/// A name and value pair: by a constructor of all fields, by accessors (both 13.2.1), or by its fields.
template <class Property>
typename std::enable_if<std::is_constructible<Property, const std::string&, const std::string&>::value, Property>::type
property(const std::string& name, const std::string& value, Rank<3>) {
    return Property(name, value);
}
template <class Property>
auto property(const std::string& name, const std::string& value, Rank<2>)
    -> decltype(std::declval<Property&>().name(name), std::declval<Property&>().value(value), Property()) {
    Property made;
    made.name(name);
    made.value(value);
    return made;
}
template <class Property>
auto property(const std::string& name, const std::string& value, Rank<1>)
    -> decltype(std::declval<Property&>().name() = name, std::declval<Property&>().value() = value, Property()) {
    Property made;
    made.name() = name;
    made.value() = value;
    return made;
}
template <class Property>
auto property(const std::string& name, const std::string& value, Rank<0>)
    -> decltype(std::declval<Property&>().name = name, std::declval<Property&>().value = value, Property()) {
    Property made;
    made.name = name;
    made.value = value;
    return made;
}

/// Traits::port_element_name(), if the Traits have it.
template <class Traits>
auto port_element_name(int) -> decltype(std::string(Traits::port_element_name())) {
    return Traits::port_element_name();
}
template <class Traits>
std::string port_element_name(long) {
    return "{port}_{element}";
}

}  // namespace detail

/// Name and value pairs as a framework's Properties: `name` = `implementation`, then the attributes.
template <class Properties>
Properties properties(const std::string& name, const std::string& implementation, const Attributes& attributes) {
    typedef typename Properties::value_type Property;
    Properties all;
    all.push_back(detail::property<Property>(name, implementation, detail::Rank<3>()));
    for (const auto& attribute : attributes) {
        all.push_back(detail::property<Property>(attribute.first, attribute.second, detail::Rank<3>()));
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
///     for once a port element, and for that of a policy whenever the framework asks the body. The null pointer stands for a
///     port element without interface.
///   - `static Data call(PortElementObject&, const std::string& method, const Data& arguments)`: calls a method of
///     any object that the framework handed over: what `typed` made, what stands before it, or the framework's own port element
///     for a policy. A declared exception leaves it as DeclaredException, any other as it is.
/// `static std::shared_ptr<TimerScheduler> scheduler(const std::shared_ptr<PortElementObject>&)`, if it is there, makes the SDK's
/// scheduler (timers.hpp) of the framework's, by which a component gets object timers (10.3.1); null for any other port element.
/// `static std::string port_element_name()`, if it is there, says how port elements are named at the API: `{port}_{element}` or
/// another text with both in it.
///
/// Structures of the framework may have fields, or the constructors and accessors of IDL to C++11 (13.2.1).
///
/// Connectors and the rest of profile core are operations of Adapter: derive from ShapedAdapter and override `link`,
/// `attach`, ..., with `of`, `shared`, `manager_` and `translate` at hand. For connectors made of fragments derive from
/// FragmentConnectors<ShapedAdapter<Traits>> (fragments.hpp).
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
        translate([&] { manager_->remove_container(shared(sub_container)); });
    }

    void destroy(const ContainerHandle&) override {
        translate([&] { manager_->destroy(); });
    }

    std::string port_element_name() const override { return detail::port_element_name<Traits>(0); }

  protected:
    /// The framework's own container behind a handle.
    static Container& of(const ContainerHandle& container) {
        if (!container) {
            throw std::logic_error("an operation of a null container cannot be called");
        }
        return *static_cast<Container*>(container.get());
    }

    /// The same as a shared pointer; null for a null container.
    static std::shared_ptr<Container> shared(const ContainerHandle& container) {
        return std::static_pointer_cast<Container>(container);
    }

    /// Calls `operation`; the framework's three exceptions become those of the SDK, all others pass.
    template <class Operation>
    static auto translate(Operation operation) -> decltype(operation()) {
        return translated<typename Traits::NOT_FOUND, typename Traits::BAD_PARAMETER, typename Traits::UCM_ERROR>(
            operation);
    }

    std::shared_ptr<ContainerManager> manager_;
};

}  // namespace ucm_cts

#endif
