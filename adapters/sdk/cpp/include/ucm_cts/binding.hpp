// What adapters are made of whose framework has ids, references or policies of its own kind. All of it is optional.
//
// Nothing here checks a state or mends a result: ids and references are translated one to one.
#ifndef UCM_CTS_BINDING_HPP
#define UCM_CTS_BINDING_HPP

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "ucm_cts/adapter.hpp"

namespace ucm_cts {

/// An adapter whose framework lacks every operation: each fails with UcmError, and so do the requirements that need it.
/// Derive from it and override what there is.
class BareAdapter : public Adapter {
  public:
    Id add_component(const ContainerHandle&, const std::string&, const Attributes&) override { lacks("add_component"); }
    void remove_component(const ContainerHandle&, Id) override { lacks("remove_component"); }
    Reference get_port_element(const ContainerHandle&, Id, const std::string&) override { lacks("get_port_element"); }
    Id connect(const ContainerHandle&, Id, const std::string&, const Reference&) override { lacks("connect"); }
    void disconnect(const ContainerHandle&, Id) override { lacks("disconnect"); }
    void start(const ContainerHandle&) override { lacks("start"); }
    void stop(const ContainerHandle&) override { lacks("stop"); }
    std::vector<Id> get_components(const ContainerHandle&) override { lacks("get_components"); }
    ContainerHandle create_container(const ContainerHandle&) override { lacks("create_container"); }
    void remove_container(const ContainerHandle&, const ContainerHandle&) override { lacks("remove_container"); }
    void destroy(const ContainerHandle&) override { lacks("destroy"); }

  protected:
    [[noreturn]] static void lacks(const std::string& operation) {
        throw UcmError("the framework has no " + operation);
    }
};

namespace detail {

inline std::string text_of(const std::exception& error) { return error.what(); }

template <class Error>
typename std::enable_if<!std::is_base_of<std::exception, Error>::value, std::string>::type text_of(const Error&) {
    return std::string();  // exceptions of 12.10 have no members
}

}  // namespace detail

/// Calls `operation`; the framework's exceptions become those of 12.10, all others pass.
template <class FrameworksNotFound, class FrameworksBadParameter, class FrameworksError, class Operation>
auto translated(Operation operation) -> decltype(operation()) {
    try {
        return operation();
    } catch (const FrameworksNotFound& error) {
        throw NotFound(detail::text_of(error));
    } catch (const FrameworksBadParameter& error) {
        throw BadParameter(detail::text_of(error));
    } catch (const FrameworksError& error) {
        throw UcmError(detail::text_of(error));
    }
}

/// Integers (12.10) for ids of a framework that are names or objects; `Own` has `operator<`. Equal ids have one number,
/// for ever: so a framework that gives out an id twice is seen to do so, and an id that is out of date reaches it.
template <class Own>
class Ids {
  public:
    /// `unknown`: what the framework gets for a number that stands for none of its ids.
    explicit Ids(Own unknown = Own()) : unknown_(std::move(unknown)) {}

    /// The number of the framework's id; a new one if it has none yet.
    Id number(const Own& own) {
        std::lock_guard<std::mutex> lock(mutex_);
        const auto found = numbers_.emplace(own, static_cast<Id>(ids_.size() + 1));
        if (found.second) {
            ids_.push_back(own);
        }
        return found.first->second;
    }

    /// The numbers of several ids, in order.
    template <class Sequence>
    std::vector<Id> numbers(const Sequence& all) {
        std::vector<Id> found;
        for (const auto& own : all) {
            found.push_back(number(own));
        }
        return found;
    }

    /// The framework's id behind `number`, or `unknown`.
    Own own(Id number) const {
        std::lock_guard<std::mutex> lock(mutex_);
        return number >= 1 && static_cast<std::size_t>(number) <= ids_.size() ? ids_[static_cast<std::size_t>(number) - 1]
                                                                              : unknown_;
    }

  private:
    mutable std::mutex mutex_;
    const Own unknown_;
    std::map<Own, Id> numbers_;
    std::vector<Own> ids_;
};

/// A framework's own reference as one of the SDK: derive from it, and write `exchange` and `call` in terms of `own`.
template <class Own>
class Wrapped : public PortElement {
  public:
    explicit Wrapped(Own its_own) : own(std::move(its_own)) {}

    /// The framework's reference behind `reference`, or `null` if that is null or was not made by the adapter.
    static Own unwrap(const Reference& reference, Own null = Own()) {
        const Wrapped* const wrapped = dynamic_cast<const Wrapped*>(reference.get());
        return wrapped != nullptr ? wrapped->own : null;
    }

    const Own own;
};

/// A port element made of functions, by method name: a clock, a trace, the end of a connector. A function takes the values
/// of the IN and INOUT parameters and returns those of OUT, INOUT and RETURN.
class Methods final : public PortElement {
  public:
    typedef std::map<std::string, std::function<Data(const Data&)>> Functions;

    explicit Methods(Functions functions) : functions_(std::move(functions)) {}

    std::int32_t exchange(std::int32_t) override { throw UcmError("the port element has another interface"); }

    Data call(const std::string& method, const Data& arguments) override {
        const auto found = functions_.find(method);
        return found != functions_.end() ? found->second(arguments) : PortElement::call(method, arguments);
    }

  private:
    const Functions functions_;
};

/// The container interface of fragments (11.2.1.4), for a framework that has none in the shape of 12.10.
class ContainerMembers final : public ContainerInterface {
  public:
    ContainerMembers(Adapter& adapter, ContainerHandle container) : adapter_(adapter), container_(std::move(container)) {}
    std::vector<Id> get_components() override { return adapter_.get_components(container_); }

  private:
    Adapter& adapter_;
    const ContainerHandle container_;
};

/// What comes first for a body of `implementation`, in this order: its attributes, its container if it is a fragment, on_init.
inline void initialise(Body& body, const Implementation& implementation, const Attributes& attributes,
                       const std::shared_ptr<ContainerInterface>& container) {
    for (const auto& attribute : attributes) {
        body.set_attribute(attribute.first, attribute.second);
    }
    if (implementation.fragment) {
        body.set_container_interface(container);
    }
    body.on_init();
}

/// The dependencies of on_startup from pairs of a required port element and a reference: one for each name.
inline std::vector<PortConnection> port_connections(const std::vector<std::pair<std::string, Reference>>& pairs) {
    std::vector<PortConnection> connections;
    for (const auto& pair : pairs) {
        const auto found = std::find_if(connections.begin(), connections.end(), [&pair](const PortConnection& one) {
            return one.from_port == pair.first;
        });
        if (found != connections.end()) {
            found->to_port.push_back(pair.second);
        } else {
            connections.push_back({pair.first, {pair.second}});
        }
    }
    return connections;
}

/// A policy port_trace: the framework leaves a record of `severity` of each call of one of `methods` through `port`, provided
/// or required; an empty `port` is all port elements of the component.
struct PortTrace {
    std::string port;
    std::set<std::string> methods;
    std::string severity;
};

/// The technical policies of an implementation, sorted by what a framework does with them (10.1.3, 10.1.4).
struct Policies {
    explicit Policies(const std::vector<Policy>& all) {
        static const std::set<std::string> of_execution = {"protected_self-executing_component",
                                                           "protected_active_component", "protected_passive_component",
                                                           "unprotected_passive_component"};
        for (const Policy& policy : all) {
            if (of_execution.count(policy.definition) != 0) {
                executions.insert(policy.definition);
                if (policy.definition == "protected_active_component") {
                    managed.push_back(policy.port);
                }
            } else if (policy.definition == "port_trace") {
                traces.push_back(port_trace(policy));
            } else if (!policy.element.empty()) {
                elements[policy.element] = policy.definition;
            } else {
                others.push_back(policy);
            }
        }
    }

    /// The one execution policy; `unprotected_passive_component` if there is none. Throws UcmError for several, which cannot be
    /// told to a framework that takes one.
    std::string execution() const {
        if (executions.size() > 1) {
            throw UcmError("several execution policies");
        }
        return executions.empty() ? "unprotected_passive_component" : *executions.begin();
    }

    /// Definitions of the execution policies.
    std::set<std::string> executions;

    /// The port elements that the thread of an active component serves.
    std::vector<std::string> managed;

    /// The definitions of policies that make the component require a port element (clock, trace, timers), by that port element's name.
    std::map<std::string, std::string> elements;

    std::vector<PortTrace> traces;

    /// Policies that 10.1 does not have, those of 10.5 among them.
    std::vector<Policy> others;

  private:
    static PortTrace port_trace(const Policy& policy) {
        PortTrace trace = {policy.port, {}, value(policy, "log_severity")};
        std::istringstream names(value(policy, "methods_to_trace"));
        for (std::string name; std::getline(names, name, ',');) {
            name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
            trace.methods.insert(name);
        }
        return trace;
    }

    static std::string value(const Policy& policy, const std::string& parameter) {
        const auto found = policy.parameters.find(parameter);
        return found != policy.parameters.end() ? found->second : std::string();
    }
};

}  // namespace ucm_cts

#endif
