// Technical policies of component implementations (10.1.3, 10.1.4, 10.5), and what generated code adds so that they can be
// applied.
#ifndef LWUCM_POLICIES_HPP
#define LWUCM_POLICIES_HPP

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lwucm/component.hpp"

namespace lwucm {

/// What a self-executing component provides to its container (12.11.1).
class component_execution_intf : public PortElementObject {
  public:
    virtual void run() = 0;
};

/// `port` is the port element that the policy manages, empty if it is a policy of the component. `element` is the name
/// under which the component gets the port element that it requires by the policy; if it is empty, that of the policy
/// and that of its port element, as in `clock_clock_api`. `settings` are the parameters of policies of 10.5, times in
/// microseconds.
struct Policy {
    std::string definition;
    std::string port;
    std::map<std::string, std::string> parameters;
    std::string element;
    std::map<std::string, std::int64_t> settings;
};

/// Stands between callers and a port element.
class Interceptor {
  public:
    virtual ~Interceptor() = default;

    /// A caller calls `method`. Has `code` executed, which carries it out, and returns when that is done; an exception
    /// of `code` leaves here.
    virtual void call(const std::string& method, const std::function<void()>& code) = 0;
};

/// The technical policies of an implementation and the code that is generated for them.
struct Policies {
    typedef std::function<std::shared_ptr<component_execution_intf>(ComponentObject& body, const std::string& policy,
                                                                    const std::string& element)>
        GetPolicyElement;
    typedef std::function<std::shared_ptr<PortElementObject>(const std::string& port,
                                                             const std::shared_ptr<PortElementObject>& target,
                                                             const std::shared_ptr<Interceptor>& interceptor)>
        Intercept;
    typedef std::function<std::shared_ptr<PortElementObject>(ComponentObject& body, const std::string& policy,
                                                             const std::string& element)>
        GetPolicyPort;

    Policies() = default;
    Policies(std::vector<Policy> all, GetPolicyElement how_to_get_element, Intercept how_to_intercept,
             GetPolicyPort how_to_get_port = GetPolicyPort())
        : applied(std::move(all)),
          get_policy_element(std::move(how_to_get_element)),
          intercept(std::move(how_to_intercept)),
          get_policy_port(std::move(how_to_get_port)) {}

    std::vector<Policy> applied;

    /// Calls the body's operation get_tp_<policy>_<element> (12.8.5).
    GetPolicyElement get_policy_element;

    /// A port element with the interface of port element `port`, each operation of which is an `interceptor->call` of that
    /// of `target`. Not needed for port elements that are DynamicPortElements.
    Intercept intercept;

    /// As `get_policy_element`, for port elements other than self-execution_api: the timer_callback of policy itt_timer, which is
    /// a DynamicPortElement.
    GetPolicyPort get_policy_port;
};

}  // namespace lwucm

#endif
