#include "execution.hpp"

#include <algorithm>
#include <utility>

#include "lwucm/errors.hpp"

namespace lwucm {

namespace {

const std::string SELF_EXECUTING = "protected_self-executing_component";
const std::string SELF_EXECUTION_API = "self-execution_api";
const std::string ACTIVE = "protected_active_component";
const std::string PROTECTED_PASSIVE = "protected_passive_component";
const std::string UNPROTECTED_PASSIVE = "unprotected_passive_component";

void check_policy(const Policy& policy, const Implementation& implementation) {
    const std::set<std::string> known = {SELF_EXECUTING, ACTIVE, PROTECTED_PASSIVE, UNPROTECTED_PASSIVE};
    if (known.count(policy.definition) == 0) {
        throw UCM_ERROR("unknown technical policy '" + policy.definition + "'");
    }
    if (!policy.parameters.empty()) {
        throw UCM_ERROR("policy '" + policy.definition + "' has no parameters");
    }
    const std::vector<std::string>& ports = implementation.provided;
    if (policy.definition == ACTIVE && std::find(ports.begin(), ports.end(), policy.port) == ports.end()) {
        throw UCM_ERROR("policy '" + policy.definition + "' needs a provided port element");
    }
    if (policy.definition != ACTIVE && !policy.port.empty()) {
        throw UCM_ERROR("policy '" + policy.definition + "' is not one of port elements");
    }
}

}  // namespace

void check_policies(const Implementation& implementation) {
    const std::vector<Policy>& policies = implementation.policies.applied;
    std::set<std::string> ports;
    for (const Policy& policy : policies) {
        check_policy(policy, implementation);
        if (policy.definition != policies.front().definition || !ports.insert(policy.port).second) {
            throw UCM_ERROR("a component has one execution policy");
        }
    }
    if (!policies.empty() && policies.front().definition != UNPROTECTED_PASSIVE && !implementation.provided.empty() &&
        !implementation.policies.intercept) {
        throw UCM_ERROR("nothing was generated to protect the port elements of " + implementation.name);
    }
}

Execution::Execution(std::shared_ptr<const Implementation> implementation, ComponentObject& body)
    : implementation_(std::move(implementation)) {
    const Policies& policies = implementation_->policies;
    if (policies.applied.empty() || policies.applied.front().definition == UNPROTECTED_PASSIVE) {
        return;
    }
    const std::string& definition = policies.applied.front().definition;
    monitor_ = std::make_shared<Monitor>();
    if (definition == ACTIVE) {
        for (const Policy& policy : policies.applied) {
            active_ports_.insert(policy.port);
        }
        own_thread_ = std::make_shared<OwnThread>(monitor_);
    }
    if (definition == SELF_EXECUTING) {
        std::shared_ptr<component_execution_intf> component;
        if (policies.get_policy_element) {
            component = policies.get_policy_element(body, SELF_EXECUTING, SELF_EXECUTION_API);
        }
        if (!component) {
            throw UCM_ERROR("the component gives no " + SELF_EXECUTION_API);
        }
        self_execution_.reset(new SelfExecution(std::move(component), monitor_));
    }
}

Execution::~Execution() { close(); }

std::shared_ptr<PortElementObject> Execution::guarded(const std::string& port,
                                                      const std::shared_ptr<PortElementObject>& element) {
    if (!monitor_ || !element) {
        return element;
    }
    std::lock_guard<std::mutex> lock(mutex_);
    Entrance& entrance = entrances_[port];
    if (entrance.element != element) {
        std::shared_ptr<Guard> guard = monitor_;
        if (active_ports_.count(port) != 0) {
            guard = own_thread_;
        }
        entrance.guarded = implementation_->policies.intercept(element, guard);
        entrance.element = element;
    }
    return entrance.guarded;
}

void Execution::begin() {
    if (self_execution_) {
        self_execution_->begin();
    }
}

void Execution::end() {
    if (self_execution_) {
        self_execution_->end();
    }
}

void Execution::close() {
    end();
    if (own_thread_) {
        own_thread_->end();
    }
}

}  // namespace lwucm
