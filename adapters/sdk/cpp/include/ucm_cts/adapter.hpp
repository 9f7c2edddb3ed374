// The C++ interface of adapters: derive from Adapter to bind a framework.
//
// An adapter forwards each operation of the Container API (12.10) one to one and translates errors. It adds no state
// checks of its own: they would hide what is being measured. A framework whose C++ API already has the shape of 12.10
// needs none of this but ShapedAdapter (shaped.hpp).
#ifndef UCM_CTS_ADAPTER_HPP
#define UCM_CTS_ADAPTER_HPP

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ucm_cts/data_types.hpp"
#include "ucm_cts/scenario.hpp"

namespace ucm_cts {

/// The three exceptions of 12.10. Any other exception is reported as an undeclared one, so let the framework's other
/// exceptions pass.
class NotFound : public std::runtime_error {
  public:
    explicit NotFound(const std::string& why) : std::runtime_error(why) {}
};

class BadParameter : public std::runtime_error {
  public:
    explicit BadParameter(const std::string& why) : std::runtime_error(why) {}
};

class UcmError : public std::runtime_error {
  public:
    explicit UcmError(const std::string& why) : std::runtime_error(why) {}
};

/// An exception that the called method declares: its name and the values of its fields.
class DeclaredException : public std::runtime_error {
  public:
    explicit DeclaredException(const std::string& its_name, Data its_fields = Data())
        : std::runtime_error(its_name), name(its_name), fields(std::move(its_fields)) {}

    std::string name;
    Data fields;
};

/// The adapter does not offer this optional operation.
class NotOffered : public std::logic_error {
  public:
    NotOffered() : std::logic_error("the adapter does not offer this operation") {}
};

/// Component and connection ids. 12.10 has 32 bits; that they fit is judged, so wider ones must come through.
typedef std::int64_t Id;

/// The port element that a reference leads to, where the SDK recognises it.
struct Identity {
    std::string component;
    int instance;
    std::string port;
};

/// A provided port element (11.2.1.1), independent of any framework. One without interface has one business method,
/// `exchange`: a signed 32-bit value in, one out.
class PortElement {
  public:
    virtual ~PortElement() = default;
    virtual std::int32_t exchange(std::int32_t value) = 0;

    /// Any method of an interface, by name: takes IN and INOUT values, returns those of OUT, INOUT and RETURN, each in the
    /// order of declaration; may throw DeclaredException. What stands between caller and body (connectors, proxies of
    /// protected components) offers it, too: it is what generated code would be. `arguments` are the caller's own, who
    /// may overwrite them as soon as the call is over.
    virtual Data call(const std::string& method, const Data& /*arguments*/) {
        throw std::logic_error("the port element cannot be called by name: " + method);
    }

    /// Null unless this is a probe's own port element.
    virtual const Identity* identity() const { return nullptr; }
};

typedef std::shared_ptr<PortElement> Reference;

struct PortConnection {
    std::string from_port;
    std::vector<Reference> to_port;
};

/// The part of the Container API that every fragment has (11.2.1.4).
class ContainerInterface {
  public:
    virtual ~ContainerInterface() = default;
    virtual std::vector<Id> get_components() = 0;
};

/// What a self-executing component provides to its container (10.1.3): `self-execution_api`.
class ComponentExecution {
  public:
    virtual ~ComponentExecution() = default;

    /// Executes the component once.
    virtual void run() = 0;
};

/// A component body (11.2.1), independent of any framework: the adapter passes on what the framework does to it.
/// `on_connect` and `on_disconnect` are for bodies whose implementation is connectable, `set_container_interface` is
/// for fragments.
class Body {
  public:
    virtual ~Body() = default;
    virtual void set_attribute(const std::string& name, const std::string& value) = 0;
    virtual void on_init() = 0;
    virtual void on_startup(const std::vector<PortConnection>& dependencies) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual void on_connect(const std::string& port_name, const Reference& required) = 0;
    virtual void on_disconnect(const std::string& port_name) = 0;
    virtual void set_container_interface(const std::shared_ptr<ContainerInterface>& container) = 0;

    /// The body's own object for the provided port element of that name, or null if it has none.
    virtual Reference get_portElement(const std::string& provided) = 0;

    /// The body's own object for the port element that its technical policy makes it provide, or null (12.8.5).
    virtual std::shared_ptr<ComponentExecution> get_policy_element(const std::string& /*policy*/,
                                                                   const std::string& /*element*/) {
        return nullptr;
    }

    /// The same, for a port element with an interface, as `timer_callback` of the index timers (10.3.2).
    virtual Reference get_policy_port(const std::string& /*policy*/, const std::string& /*element*/) { return nullptr; }
};

/// A component implementation the framework shall be able to instantiate. Its bodies may outlive the scenario.
/// `policies` are the technical policies that the container has to apply (10.1.3, 10.1.4). `interfaces` are those of the
/// port elements that have one; the others have `exchange`. `defaults` are those of the attributes that have one (9.2.7.4).
///
/// The port element that a component requires by a policy is handed over in `on_startup` like any other, under the name
/// `policy.element`, and takes `call`; that of `ott_timer` (10.3.1) is a TimerScheduler (timers.hpp).
struct Implementation {
    std::string name;
    std::vector<std::string> provided;
    std::vector<std::string> required;
    std::vector<std::string> attributes;
    bool connectable;
    bool fragment;
    std::function<std::shared_ptr<Body>()> create;
    std::vector<Policy> policies;
    Interfaces interfaces;
    Attributes defaults;
};

/// The object that the adapter uses for a container.
typedef std::shared_ptr<void> ContainerHandle;

/// The object that the adapter uses for a connection with a connector.
typedef std::shared_ptr<void> LinkHandle;

/// A record of the trace (10.1.4.2): `severity` is an enumerator of log_severity_t.
struct LogRecord {
    std::string severity;
    std::string message;
};

/// Binds one framework. One instance is made for each scenario and serves one runtime. Scenarios with threads call
/// operations from several threads at once.
class Adapter {
  public:
    virtual ~Adapter() = default;

    /// Makes an empty runtime that can instantiate `implementations`; returns its root container (11.2.2.2).
    virtual ContainerHandle create_runtime(const std::vector<Implementation>& implementations) = 0;

    /// `add_component` with the configuration values that select `implementation` and set `attributes`.
    virtual Id add_component(const ContainerHandle& container, const std::string& implementation,
                             const Attributes& attributes) = 0;
    virtual void remove_component(const ContainerHandle& container, Id comp_instance) = 0;
    virtual Reference get_port_element(const ContainerHandle& container, Id comp_instance,
                                       const std::string& port_name) = 0;
    virtual Id connect(const ContainerHandle& container, Id instance, const std::string& port_name,
                       const Reference& to_port) = 0;
    virtual void disconnect(const ContainerHandle& container, Id connection) = 0;
    virtual void start(const ContainerHandle& container) = 0;
    virtual void stop(const ContainerHandle& container) = 0;
    virtual std::vector<Id> get_components(const ContainerHandle& container) = 0;
    virtual ContainerHandle create_container(const ContainerHandle& manager) = 0;
    virtual void remove_container(const ContainerHandle& manager, const ContainerHandle& sub_container) = 0;

    /// `destroy` the runtime. Also called after a scenario that has not done so, with any outcome ignored.
    virtual void destroy(const ContainerHandle& manager) = 0;

    /// How the framework spells the name of a port element at its API.
    virtual std::string port_element_name() const { return "{port}_{element}"; }

    // What profiles core and extensions need beside; what an adapter does not override stays untested.

    /// Makes a connection without ends (9.5.5.4) with a `connector` of 10.1, `simple_service_connector` or
    /// `simple_message_connector`, bound to `interface`.
    virtual LinkHandle link(const ContainerHandle& /*manager*/, const std::string& /*connector*/,
                            const SharedInterface& /*interface*/) {
        throw NotOffered();
    }

    /// Makes a connection without ends with a `connector` of 10.4, bound to data `types` by template parameter.
    virtual LinkHandle link_with_types(const ContainerHandle& /*manager*/, const std::string& /*connector*/,
                                       const std::map<std::string, SharedType>& /*types*/) {
        throw NotOffered();
    }

    /// Makes the port element an end of `link`, in the `role` of `client`, `server`, `emitter` or `receiver`. If `role`
    /// is a connector port of 10.4, `port_name` is the name of a port, with all its port elements.
    virtual void attach(const LinkHandle& /*link*/, const std::string& /*role*/, const ContainerHandle& /*container*/,
                        Id /*comp_instance*/, const std::string& /*port_name*/) {
        throw NotOffered();
    }

    /// The port element, or the port, is no longer an end of `link`.
    virtual void detach(const LinkHandle& /*link*/, const ContainerHandle& /*container*/, Id /*comp_instance*/,
                        const std::string& /*port_name*/) {
        throw NotOffered();
    }

    /// Breaks the `transport` of `link`, or its connector `inside`, until it is mended (10.1.2).
    virtual void break_link(const LinkHandle& /*link*/, const std::string& /*where*/) { throw NotOffered(); }

    /// Mends what was broken.
    virtual void mend_link(const LinkHandle& /*link*/) { throw NotOffered(); }

    /// All records of the trace (10.1.4.2) so far, oldest first.
    virtual std::vector<LogRecord> read_log(const ContainerHandle& /*manager*/) { throw NotOffered(); }

    /// Lets so much virtual time pass for all components at once.
    virtual void advance(const ContainerHandle& /*manager*/, std::int32_t /*milliseconds*/) { throw NotOffered(); }
};

typedef std::function<std::shared_ptr<Adapter>()> AdapterFactory;

}  // namespace ucm_cts

#endif
