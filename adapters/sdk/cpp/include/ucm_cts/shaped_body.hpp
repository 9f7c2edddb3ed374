// Bodies and references in a framework's own types, for frameworks in the shape of 12.10.
#ifndef UCM_CTS_SHAPED_BODY_HPP
#define UCM_CTS_SHAPED_BODY_HPP

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/binding.hpp"
#include "ucm_cts/timers.hpp"

namespace ucm_cts {
namespace detail {

/// Arguments and result of a member function, so that overriding functions have exactly the framework's signature.
template <class Member>
struct Signature;

template <class Class, class R, class... A>
struct Signature<R (Class::*)(A...)> {
    typedef R Result;
    typedef std::tuple<A...> Arguments;
};

template <class Class, class R, class... A>
struct Signature<R (Class::*)(A...) const> : Signature<R (Class::*)(A...)> {};

#if defined(__cpp_noexcept_function_type)
template <class Class, class R, class... A>
struct Signature<R (Class::*)(A...) noexcept> : Signature<R (Class::*)(A...)> {};

template <class Class, class R, class... A>
struct Signature<R (Class::*)(A...) const noexcept> : Signature<R (Class::*)(A...)> {};
#endif

template <class Member, std::size_t N>
using Argument = typename std::tuple_element<N, typename Signature<Member>::Arguments>::type;

template <class Member>
using Result = typename Signature<Member>::Result;

/// The first of several overloads that fits: a Rank<2> also fits where Rank<1> is wanted.
template <int N>
struct Rank : Rank<N - 1> {};
template <>
struct Rank<0> {};

/// The name in a PortConnection: `from_port` (12.10) or `port_name` (13.7), a field or an accessor (13.2.1).
template <class Connection>
auto port_of(const Connection& connection, Rank<3>) -> decltype(std::string(connection.from_port())) {
    return connection.from_port();
}
template <class Connection>
auto port_of(const Connection& connection, Rank<2>) -> decltype(std::string(connection.port_name())) {
    return connection.port_name();
}
template <class Connection>
auto port_of(const Connection& connection, Rank<1>) -> decltype(std::string(connection.from_port)) {
    return connection.from_port;
}
template <class Connection>
auto port_of(const Connection& connection, Rank<0>) -> decltype(std::string(connection.port_name)) {
    return connection.port_name;
}

/// Calls `visit` for each reference in a PortConnection: `to_port`, a sequence (12.10) or one; or `ref` (13.7).
template <class References, class Visit>
auto for_each_reference(const References& references, Visit visit, int) -> decltype(references.begin(), void()) {
    for (const auto& reference : references) {
        visit(reference);
    }
}
template <class Pointer, class Visit>
void for_each_reference(const Pointer& reference, Visit visit, long) {
    visit(reference);
}
template <class Connection>
auto references_of(const Connection& connection, Rank<3>) -> decltype(connection.to_port()) {
    return connection.to_port();
}
template <class Connection>
auto references_of(const Connection& connection, Rank<2>) -> decltype(connection.ref()) {
    return connection.ref();
}
template <class Connection>
auto references_of(const Connection& connection, Rank<1>) -> decltype((connection.to_port)) {
    return connection.to_port;
}
template <class Connection>
auto references_of(const Connection& connection, Rank<0>) -> decltype((connection.ref)) {
    return connection.ref;
}

/// Traits::typed, if the Traits have it: null makes the port element one without interface.
template <class Traits>
auto typed(const Reference& own, const SharedInterface& interface, int) -> decltype(Traits::typed(own, interface)) {
    return Traits::typed(own, interface);
}
template <class Traits>
std::shared_ptr<typename Traits::PortElementObject> typed(const Reference&, const SharedInterface&, long) {
    return nullptr;
}

/// Traits::call, if the Traits have it.
template <class Traits, class Element>
auto call(Element& element, const std::string& method, const Data& arguments, int)
    -> decltype(Traits::call(element, method, arguments)) {
    return Traits::call(element, method, arguments);
}
template <class Traits, class Element>
Data call(Element&, const std::string& method, const Data&, long) {
    throw std::logic_error("the adapter cannot call by name: " + method);
}

/// Traits::scheduler, if the Traits have it: null for a reference that is no scheduler.
template <class Traits, class Pointer>
auto scheduler(const Pointer& reference, int) -> decltype(std::shared_ptr<TimerScheduler>(Traits::scheduler(reference))) {
    return Traits::scheduler(reference);
}
template <class Traits, class Pointer>
std::shared_ptr<TimerScheduler> scheduler(const Pointer&, long) {
    return nullptr;
}

/// The framework's component_execution_intf (12.11.1) if the Traits name it as ComponentExecution, else the SDK's.
template <class Traits>
typename Traits::ComponentExecution* execution_of(int);
template <class Traits>
ComponentExecution* execution_of(long);

}  // namespace detail

/// The probes' interface as a port element of the framework: what a code generator would have made of the model. Traits that
/// name what their generator did make of it, as Exchange, are served with that.
template <class Traits>
class ShapedExchange : public Traits::PortElementObject {
  public:
    virtual std::int32_t exchange(std::int32_t value) = 0;
};

namespace detail {

/// Traits::Exchange if the Traits name it, else the SDK's.
template <class Traits>
typename Traits::Exchange* exchange_of(int);
template <class Traits>
ShapedExchange<Traits>* exchange_of(long);

template <class Traits>
using ExchangeOf = typename std::remove_pointer<decltype(exchange_of<Traits>(0))>::type;

}  // namespace detail

/// A second base class of the probe's own port elements, by which the SDK recognises them.
class ProbesOwn {
  public:
    explicit ProbesOwn(Reference its_element) : element(std::move(its_element)) {}
    virtual ~ProbesOwn() = default;

    const Reference element;
};

/// A probe's port element as the framework sees it.
template <class Traits>
class ShapedPort final : public detail::ExchangeOf<Traits>, public ProbesOwn {
  public:
    explicit ShapedPort(Reference port) : ProbesOwn(std::move(port)) {}
    std::int32_t exchange(std::int32_t value) override { return element->exchange(value); }
};

/// A reference of the framework as the SDK sees it.
template <class Traits>
class ShapedReference final : public PortElement {
  public:
    typedef std::shared_ptr<typename Traits::PortElementObject> Pointer;

    explicit ShapedReference(Pointer pointer)
        : pointer_(std::move(pointer)), exchange_(dynamic_cast<detail::ExchangeOf<Traits>*>(pointer_.get())) {}

    static Reference wrap(const Pointer& pointer) {
        return pointer ? std::make_shared<ShapedReference>(pointer) : nullptr;
    }

    /// The same for one that a component is given by on_startup, which may be a scheduler of object timers.
    static Reference wrap_dependency(const Pointer& pointer) {
        const std::shared_ptr<TimerScheduler> scheduler = detail::scheduler<Traits>(pointer, 0);
        return scheduler ? Reference(scheduler) : wrap(pointer);
    }

    static Pointer unwrap(const Reference& reference) {
        const ShapedReference* const own = dynamic_cast<const ShapedReference*>(reference.get());
        return own != nullptr ? own->pointer_ : nullptr;
    }

    std::int32_t exchange(std::int32_t value) override {
        if (exchange_ == nullptr) {
            throw std::logic_error("the reference does not have the interface of the port element");
        }
        return exchange_->exchange(value);
    }

    Data call(const std::string& method, const Data& arguments) override {
        return detail::call<Traits>(*pointer_, method, arguments, 0);
    }

    const Identity* identity() const override {
        const ProbesOwn* const own = dynamic_cast<const ProbesOwn*>(pointer_.get());
        return own != nullptr ? own->element->identity() : nullptr;
    }

  private:
    const Pointer pointer_;
    detail::ExchangeOf<Traits>* const exchange_;
};

/// What a self-executing probe provides, in the framework's own interface.
template <class Interface>
class ShapedExecution final : public Interface {
  public:
    explicit ShapedExecution(std::shared_ptr<ComponentExecution> execution) : execution_(std::move(execution)) {}
    void run() override { execution_->run(); }

  private:
    const std::shared_ptr<ComponentExecution> execution_;
};

/// What generated bodies have operations for by name: their attributes (13.5) and what their policies make them provide
/// (12.8.5). Every body in the framework's shape is one.
class NamedFeatures {
  public:
    virtual ~NamedFeatures() = default;
    virtual void set_attribute(const std::string& name, const std::string& value) = 0;
    virtual std::shared_ptr<ComponentExecution> get_policy_element(const std::string& policy,
                                                                   const std::string& element) = 0;
    virtual Reference get_policy_port(const std::string& policy, const std::string& element) = 0;
};

/// A body in the framework's shape: a ComponentObject (`Base` is it, or derives from it).
template <class Traits, class Base>
class ShapedBody : public Base, public NamedFeatures {
    typedef typename Traits::ComponentObject Object;

  public:
    ShapedBody(std::shared_ptr<Body> body, Interfaces interfaces)
        : body_(std::move(body)), interfaces_(std::move(interfaces)) {}

    void set_attribute(const std::string& name, const std::string& value) override {
        body_->set_attribute(name, value);
    }

    std::shared_ptr<ComponentExecution> get_policy_element(const std::string& policy,
                                                           const std::string& element) override {
        return body_->get_policy_element(policy, element);
    }

    Reference get_policy_port(const std::string& policy, const std::string& element) override {
        return body_->get_policy_port(policy, element);
    }

    void on_init() override { body_->on_init(); }
    void on_remove() override { body_->on_remove(); }
    void on_shutdown() override { body_->on_shutdown(); }

    void on_startup(detail::Argument<decltype(&Object::on_startup), 0> dependencies) override {
        std::vector<PortConnection> connections;
        for (const auto& dependency : dependencies) {
            PortConnection connection;
            connection.from_port = detail::port_of(dependency, detail::Rank<3>());
            detail::for_each_reference(
                detail::references_of(dependency, detail::Rank<3>()),
                [&connection](const typename ShapedReference<Traits>::Pointer& reference) {
                    connection.to_port.push_back(ShapedReference<Traits>::wrap_dependency(reference));
                },
                0);
            connections.push_back(std::move(connection));
        }
        body_->on_startup(connections);
    }

    detail::Result<decltype(&Object::get_portElement)> get_portElement(
        detail::Argument<decltype(&Object::get_portElement), 0> provided) override {
        std::lock_guard<std::mutex> lock(mutex_);
        for (const auto& port : ports_) {
            if (port.first == provided) {
                return port.second;
            }
        }
        const Reference reference = body_->get_portElement(provided);
        if (!reference) {
            return nullptr;
        }
        ports_.emplace_back(provided, shaped(provided, reference));
        return ports_.back().second;
    }

  protected:
    const std::shared_ptr<Body> body_;

  private:
    typedef std::shared_ptr<typename Traits::PortElementObject> Pointer;

    Pointer shaped(const std::string& provided, const Reference& reference) const {
        const auto interface = interfaces_.find(provided);
        Pointer typed;
        if (interface != interfaces_.end()) {
            typed = detail::typed<Traits>(reference, interface->second, 0);
        }
        return typed ? typed : std::make_shared<ShapedPort<Traits>>(reference);
    }

    const Interfaces interfaces_;
    std::mutex mutex_;
    std::vector<std::pair<std::string, Pointer>> ports_;
};

/// ComponentObject and FragmentObject in one, whether FragmentObject extends ComponentObject (11.2.1.4) or not (12.10).
template <class Traits, bool extends = std::is_base_of<typename Traits::ComponentObject,
                                                       typename Traits::FragmentObject>::value>
class FragmentBase : public Traits::FragmentObject {};

template <class Traits>
class FragmentBase<Traits, false> : public Traits::ComponentObject, public Traits::FragmentObject {};

/// What a fragment does with its container, for any kind of pointer.
template <class Pointer>
class ShapedContainer final : public ContainerInterface {
  public:
    explicit ShapedContainer(Pointer container) : container_(std::move(container)) {}

    static std::shared_ptr<ContainerInterface> wrap(const Pointer& container) {
        return container ? std::make_shared<ShapedContainer>(container) : nullptr;
    }

    std::vector<Id> get_components() override {
        const auto ids = container_->get_components();
        return std::vector<Id>(ids.begin(), ids.end());
    }

  private:
    const Pointer container_;
};

template <class Traits>
class ShapedFragment : public ShapedBody<Traits, FragmentBase<Traits>> {
    typedef detail::Argument<decltype(&Traits::FragmentObject::set_container_interface), 0> ContainerArgument;

  public:
    ShapedFragment(std::shared_ptr<Body> body, Interfaces interfaces)
        : ShapedBody<Traits, FragmentBase<Traits>>(std::move(body), std::move(interfaces)) {}

    void set_container_interface(ContainerArgument container) override {
        this->body_->set_container_interface(
            ShapedContainer<typename std::decay<ContainerArgument>::type>::wrap(container));
    }
};

/// `Base` made Connectable.
template <class Traits, class Base>
class ShapedConnectable final : public Base, public Traits::Connectable {
    typedef typename Traits::Connectable Callbacks;

  public:
    ShapedConnectable(std::shared_ptr<Body> body, Interfaces interfaces)
        : Base(std::move(body), std::move(interfaces)) {}

    void on_connect(detail::Argument<decltype(&Callbacks::on_connect), 0> port_name,
                    detail::Argument<decltype(&Callbacks::on_connect), 1> required) override {
        this->body_->on_connect(port_name, ShapedReference<Traits>::wrap(required));
    }

    void on_disconnect(detail::Argument<decltype(&Callbacks::on_disconnect), 0> port_name) override {
        this->body_->on_disconnect(port_name);
    }
};

/// A component implementation in the framework's types, to be registered the way the framework has it.
template <class Traits>
struct ShapedImplementation {
    typedef typename Traits::ComponentObject ComponentObject;
    typedef typename Traits::PortElementObject PortElementObject;
    typedef typename std::remove_pointer<decltype(detail::execution_of<Traits>(0))>::type Execution;

    std::string name;
    std::vector<std::string> provided;
    std::vector<std::string> required;
    std::vector<std::string> attributes;
    bool connectable;
    bool fragment;
    std::function<std::shared_ptr<ComponentObject>()> create;
    std::function<void(ComponentObject&, const std::string&, const std::string&)> set_attribute;

    /// For bodies in classes of the adapter's own, such as typed ones (13.9): what these hand their callbacks on to.
    std::function<std::shared_ptr<Body>()> create_body;

    /// For frameworks that apply technical policies: those of the implementation, and what stands for the operation
    /// get_tp_<policy>_<element> of a body (12.8.5), which gives null if the body has no such port element.
    std::vector<Policy> policies;
    std::function<std::shared_ptr<Execution>(ComponentObject&, const std::string&, const std::string&)>
        get_policy_element;

    /// The same for a port element with an interface, which Traits::typed makes: `timer_callback` of the index timers (10.3.2),
    /// whose method is `on_timeout`.
    std::function<std::shared_ptr<PortElementObject>(ComponentObject&, const std::string&, const std::string&)>
        get_policy_port;

    /// For frameworks with typed interfaces: those of the port elements that have one.
    Interfaces interfaces;

    explicit ShapedImplementation(const Implementation& from)
        : name(from.name),
          provided(from.provided),
          required(from.required),
          attributes(from.attributes),
          connectable(from.connectable),
          fragment(from.fragment),
          create(maker(from)),
          set_attribute([](ComponentObject& body, const std::string& attribute, const std::string& value) {
              dynamic_cast<NamedFeatures&>(body).set_attribute(attribute, value);
          }),
          create_body(from.create),
          policies(from.policies),
          get_policy_element([](ComponentObject& body, const std::string& policy, const std::string& element) {
              const auto execution = dynamic_cast<NamedFeatures&>(body).get_policy_element(policy, element);
              return execution ? std::make_shared<ShapedExecution<Execution>>(execution) : nullptr;
          }),
          get_policy_port([](ComponentObject& body, const std::string& policy, const std::string& element) {
              const Reference own = dynamic_cast<NamedFeatures&>(body).get_policy_port(policy, element);
              return own ? detail::typed<Traits>(own, timer_callback_interface(), 0) : nullptr;
          }),
          interfaces(from.interfaces) {}

  private:
    static std::function<std::shared_ptr<ComponentObject>()> maker(const Implementation& from) {
        typedef ShapedBody<Traits, ComponentObject> Plain;
        typedef ShapedFragment<Traits> Fragment;
        if (from.connectable) {
            return from.fragment ? make<ShapedConnectable<Traits, Fragment>>(from)
                                 : make<ShapedConnectable<Traits, Plain>>(from);
        }
        return from.fragment ? make<Fragment>(from) : make<Plain>(from);
    }

    template <class Shaped>
    static std::function<std::shared_ptr<ComponentObject>()> make(const Implementation& from) {
        const std::function<std::shared_ptr<Body>()> create = from.create;
        const Interfaces its_interfaces = from.interfaces;
        return [create, its_interfaces] {
            return std::shared_ptr<ComponentObject>(std::make_shared<Shaped>(create(), its_interfaces));
        };
    }
};

}  // namespace ucm_cts

#endif
