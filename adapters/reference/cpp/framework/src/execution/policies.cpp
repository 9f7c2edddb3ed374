#include "execution/policies.hpp"

#include <algorithm>
#include <sstream>

#include "containers/names.hpp"
#include "lwucm/errors.hpp"

namespace lwucm {

const char* const SELF_EXECUTING = "protected_self-executing_component";

namespace {

const std::string PORT_TRACE = "port_trace";
const std::string METHODS_TO_TRACE = "methods_to_trace";
const std::string LOG_SEVERITY = "log_severity";

const std::int64_t HIGHEST_PRIORITY = 1;
const std::int64_t LOWEST_PRIORITY = 255;
const std::int64_t LONGEST = std::int64_t(1000) * 3600 * 1000 * 1000;  // 1,000 hours

/// A policy of 10.5: what it does, and its parameters.
struct Extension {
    Pacing::Kind kind;
    std::string period;
    std::string offset;
    std::string priority;
};

const std::map<std::string, Extension>& extensions() {
    static const std::map<std::string, Extension> all = {
        {"periodic_self-executing_component", {Pacing::Kind::periodic, "psec_period", "psec_offset", "psec_priority"}},
        {"background_self-executing_component", {Pacing::Kind::background, "", "bsec_offset", "bsec_priority"}},
        {"periodic_protected_active_component", {Pacing::Kind::periodic, "ppac_period", "ppac_offset", "ppac_priority"}},
        {"sporadic_protected_active_component", {Pacing::Kind::sporadic, "spac_min_period", "", "spac_priority"}}};
    return all;
}

const std::map<std::string, Protection>& protections() {
    static const std::map<std::string, Protection> all = {{SELF_EXECUTING, Protection::self_executing},
                                                          {"periodic_self-executing_component",
                                                           Protection::self_executing},
                                                          {"background_self-executing_component",
                                                           Protection::self_executing},
                                                          {"periodic_protected_active_component", Protection::active},
                                                          {"sporadic_protected_active_component", Protection::active},
                                                          {"protected_active_component", Protection::active},
                                                          {"protected_passive_component", Protection::passive},
                                                          {"unprotected_passive_component", Protection::none}};
    return all;
}

/// A policy that makes a component require a port element: which, its name unless the policy has another one, and whether a
/// component has several.
struct ServicePolicy {
    RequiredService::Kind kind;
    std::string name;
    bool several;
};

const std::map<std::string, ServicePolicy>& service_policies() {
    static const std::map<std::string, ServicePolicy> all = {
        {"clock", {RequiredService::Kind::clock, "clock_clock_api", false}},
        {"component_trace", {RequiredService::Kind::trace, "component_trace_trace_api", true}},
        {"itt_timer", {RequiredService::Kind::index_timers, "itt_timer_timer_service", false}},
        {"ott_timer", {RequiredService::Kind::object_timers, "ott_timer_timer_scheduler", false}}};
    return all;
}

/// Reads the policies of one implementation, one by one.
class Reading {
  public:
    explicit Reading(const Implementation& implementation) : implementation_(implementation) {}

    Demands read() {
        for (const Policy& policy : implementation_.policies.applied) {
            const auto protection = protections().find(policy.definition);
            const auto service = service_policies().find(policy.definition);
            if (protection != protections().end()) {
                read_protection(policy, protection->second);
            } else if (service != service_policies().end()) {
                read_service(policy, service->second);
            } else if (policy.definition == PORT_TRACE) {
                read_port_trace(policy);
            } else {
                throw UCM_ERROR("unknown technical policy '" + policy.definition + "'");
            }
        }
        check_generated();
        return demands_;
    }

  private:
    void read_protection(const Policy& policy, Protection protection) {
        need_no_parameters(policy);
        if (protection != Protection::active) {
            need_no_port(policy);
        } else if (!contains(implementation_.provided, policy.port)) {
            throw UCM_ERROR("policy '" + policy.definition + "' needs a provided port element");
        }
        if ((!execution_.empty() && (execution_ != policy.definition || protection != Protection::active)) ||
            (protection == Protection::active && !demands_.active_ports.insert(policy.port).second)) {
            throw UCM_ERROR("a component has one execution policy");
        }
        execution_ = policy.definition;
        demands_.execution = policy.definition;
        demands_.protection = protection;
        read_pacing(policy);
    }

    void read_pacing(const Policy& policy) {
        const auto found = extensions().find(policy.definition);
        std::size_t read = 0;
        if (found != extensions().end()) {
            const Extension& extension = found->second;
            demands_.pacing.kind = extension.kind;
            demands_.pacing.period = std::chrono::microseconds(setting(policy, extension.period, 1, LONGEST, read));
            demands_.pacing.offset = std::chrono::microseconds(setting(policy, extension.offset, 0, LONGEST, read));
            setting(policy, extension.priority, HIGHEST_PRIORITY, LOWEST_PRIORITY, read);
        }
        if (read != policy.settings.size()) {
            throw UCM_ERROR("policy '" + policy.definition + "' has other parameters");
        }
    }

    /// The value of a parameter, 0 if the policy has none of that kind; counts those that were `read`.
    static std::int64_t setting(const Policy& policy, const std::string& name, std::int64_t least, std::int64_t most,
                                std::size_t& read) {
        if (name.empty()) {
            return 0;
        }
        const auto found = policy.settings.find(name);
        if (found == policy.settings.end() || found->second < least || found->second > most) {
            throw UCM_ERROR("policy '" + policy.definition + "' needs a value for " + name);
        }
        ++read;
        return found->second;
    }

    void read_service(const Policy& policy, const ServicePolicy& service) {
        need_no_parameters(policy);
        need_no_port(policy);
        const auto same = [&service](const RequiredService& one) { return one.kind == service.kind; };
        if (!service.several && std::any_of(demands_.services.begin(), demands_.services.end(), same)) {
            throw UCM_ERROR("a component has policy '" + policy.definition + "' once at most");
        }
        demands_.services.push_back({service.kind, policy.element.empty() ? service.name : policy.element});
    }

    void read_port_trace(const Policy& policy) {
        if (!contains(implementation_.provided, policy.port) && !contains(implementation_.required, policy.port)) {
            throw UCM_ERROR("policy '" + PORT_TRACE + "' needs a port element");
        }
        const std::map<std::string, std::string>& parameters = policy.parameters;
        const auto methods = parameters.find(METHODS_TO_TRACE);
        const auto severity = parameters.find(LOG_SEVERITY);
        if (parameters.size() != 2 || methods == parameters.end() || severity == parameters.end()) {
            throw UCM_ERROR("policy '" + PORT_TRACE + "' has parameters " + METHODS_TO_TRACE + " and " + LOG_SEVERITY);
        }
        PortTrace trace = {{}, log_severity_t::trace};
        if (!find_severity(severity->second, trace.severity)) {
            throw UCM_ERROR("there is no severity '" + severity->second + "'");
        }
        std::istringstream names(methods->second);
        std::string name;
        while (std::getline(names, name, ',')) {
            const std::size_t begin = name.find_first_not_of(' ');
            if (begin != std::string::npos) {
                trace.methods.insert(name.substr(begin, name.find_last_not_of(' ') + 1 - begin));
            }
        }
        demands_.traces[policy.port].push_back(std::move(trace));
    }

    static void need_no_parameters(const Policy& policy) {
        if (!policy.parameters.empty()) {
            throw UCM_ERROR("policy '" + policy.definition + "' has no parameters");
        }
    }

    static void need_no_port(const Policy& policy) {
        if (!policy.port.empty()) {
            throw UCM_ERROR("policy '" + policy.definition + "' is not one of port elements");
        }
    }

    /// What stands between must be generated where it cannot call by name.
    void check_generated() const {
        if (implementation_.policies.intercept) {
            return;
        }
        std::vector<std::string> intercepted;
        if (demands_.protection != Protection::none) {
            intercepted = implementation_.provided;
        }
        for (const auto& trace : demands_.traces) {
            intercepted.push_back(trace.first);
        }
        for (const std::string& port : intercepted) {
            if (implementation_.interfaces.count(port) == 0) {
                throw UCM_ERROR("nothing was generated to stand before port element '" + port + "'");
            }
        }
    }

    const Implementation& implementation_;
    std::string execution_;
    Demands demands_;
};

}  // namespace

Demands demands_of(const Implementation& implementation) { return Reading(implementation).read(); }

}  // namespace lwucm
