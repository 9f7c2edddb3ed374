// Technical policies of component implementations (10.1.3), and what generated code adds so that they can be applied.
#ifndef LWUCM_POLICIES_HPP
#define LWUCM_POLICIES_HPP

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lwucm/component.hpp"

namespace lwucm {

/// What a self-executing component provides to its container (12.11.1).
class component_execution_intf : public PortElementObject {
  public:
    virtual void run() = 0;
};

/// `port` is the provided port element that the policy manages, empty if it is a policy of the component.
struct Policy {
    std::string definition;
    std::string port;
    std::map<std::string, std::string> parameters;
};

/// Stands between callers and a protected component.
class Guard {
  public:
    virtual ~Guard() = default;

    /// Has `code` executed and returns when that is done; an exception of `code` leaves here.
    virtual void call(const std::function<void()>& code) = 0;
};

/// The technical policies of an implementation and the code that is generated for them.
struct Policies {
    std::vector<Policy> applied;

    /// Calls the body's operation get_tp_<policy>_<element> (12.8.5).
    std::function<std::shared_ptr<component_execution_intf>(ComponentObject& body, const std::string& policy,
                                                            const std::string& element)>
        get_policy_element;

    /// A port element with the interface of `target`, each operation of which is a `guard->call` of that of `target`.
    std::function<std::shared_ptr<PortElementObject>(const std::shared_ptr<PortElementObject>& target,
                                                     const std::shared_ptr<Guard>& guard)>
        intercept;
};

}  // namespace lwucm

#endif
