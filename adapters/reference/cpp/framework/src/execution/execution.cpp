#include "execution/execution.hpp"

#include <algorithm>
#include <utility>

#include "lwucm/errors.hpp"
#include "platform/parts.hpp"

namespace lwucm {

namespace {

const std::string SELF_EXECUTION_API = "self-execution_api";
const std::string INDEX_TIMERS = "itt_timer";
const std::string TIMER_CALLBACK = "timer_callback";

}  // namespace

Execution::Execution(componentId id, std::shared_ptr<const Implementation> implementation, Demands demands,
                     ComponentObject& body, const Platform& platform)
    : id_(id),
      implementation_(std::move(implementation)),
      platform_(platform),
      demands_(std::move(demands)) {
    if (demands_.protection != Protection::none) {
        make_guards(body);
    }
    make_timers(body);
}

Execution::~Execution() { close(); }

void Execution::make_guards(ComponentObject& body) {
    const std::shared_ptr<Monitor> monitor = Parts::monitor();
    const Options::Executor chosen = platform_.options.executor;
    if (chosen == Options::Executor::component ||
        (chosen == Options::Executor::caller && demands_.protection == Protection::active)) {
        own_executor_ = std::make_shared<Executor>();
    }
    const std::shared_ptr<Executor> executor = own_executor_ ? own_executor_ : platform_.executor;
    if (executor) {
        active_guard_ = std::make_shared<OnExecutor>(monitor, executor);
    }
    guard_ = chosen == Options::Executor::caller ? monitor : active_guard_;
    if (demands_.protection == Protection::active && demands_.pacing.kind != Pacing::Kind::none) {
        active_guard_ = paced_guard_ = Parts::paced_guard(monitor, active_guard_, demands_.pacing);
    }
    if (demands_.protection == Protection::self_executing) {
        std::shared_ptr<component_execution_intf> component;
        if (implementation_->policies.get_policy_element) {
            component = implementation_->policies.get_policy_element(body, demands_.execution, SELF_EXECUTION_API);
        }
        if (!component) {
            throw UCM_ERROR("the component gives no " + SELF_EXECUTION_API);
        }
        if (demands_.pacing.kind == Pacing::Kind::none) {
            self_execution_ = Parts::self_execution(std::move(component), guard_);
        } else {
            self_execution_ = Parts::paced_self_execution(std::move(component), guard_, demands_.pacing);
        }
    }
}

void Execution::make_timers(ComponentObject& body) {
    const auto demands = [this](RequiredService::Kind kind) {
        return std::any_of(demands_.services.begin(), demands_.services.end(),
                           [kind](const RequiredService& one) { return one.kind == kind; });
    };
    const bool by_index = demands(RequiredService::Kind::index_timers);
    const bool as_objects = demands(RequiredService::Kind::object_timers);
    if (by_index || as_objects) {
        timers_ = Parts::timers(guard_);
    }
    if (by_index) {
        index_timers_ = std::make_shared<IndexTimers>(timers_, timer_callback(body), platform_.clock);
    }
    if (as_objects) {
        object_timers_ = std::make_shared<ObjectTimers>(timers_, id_);
    }
}

std::shared_ptr<DynamicPortElement> Execution::timer_callback(ComponentObject& body) const {
    std::shared_ptr<PortElementObject> callback;
    if (implementation_->policies.get_policy_port) {
        callback = implementation_->policies.get_policy_port(body, INDEX_TIMERS, TIMER_CALLBACK);
    }
    const auto dynamic = std::dynamic_pointer_cast<DynamicPortElement>(callback);
    if (!dynamic) {
        throw UCM_ERROR("the component gives no " + TIMER_CALLBACK);
    }
    return dynamic;
}

std::shared_ptr<PortElementObject> Execution::provided(const std::string& port,
                                                       const std::shared_ptr<PortElementObject>& element) {
    if (!element || (!guard_ && demands_.traces.count(port) == 0)) {
        return element;
    }
    std::lock_guard<std::mutex> lock(mutex_);
    Way& way = ways_in_[port];
    if (way.element != element) {
        const std::shared_ptr<Guard>& guard = demands_.active_ports.count(port) != 0 ? active_guard_ : guard_;
        const auto interceptor = std::make_shared<Interception>(traces_of(port), guard);
        way.seen = intercepted(port, element, interceptor, implementation_->policies);
        way.element = element;
    }
    return way.seen;
}

std::shared_ptr<PortElementObject> Execution::required(const std::string& port,
                                                       const std::shared_ptr<PortElementObject>& element) const {
    const std::shared_ptr<const PortTraces> traces = traces_of(port);
    if (!element || !traces) {
        return element;
    }
    return intercepted(port, element, std::make_shared<Interception>(traces, nullptr), implementation_->policies);
}

PortConnections Execution::services() const {
    PortConnections connections;
    for (const RequiredService& service : demands_.services) {
        connections.push_back(PortConnection{service.name, {element_of(service.kind)}});
    }
    return connections;
}

std::shared_ptr<PortElementObject> Execution::element_of(RequiredService::Kind service) const {
    switch (service) {
        case RequiredService::Kind::clock:
            return platform_.clock;
        case RequiredService::Kind::trace:
            return std::make_shared<TraceService>(platform_.trace);
        case RequiredService::Kind::index_timers:
            return index_timers_;
        case RequiredService::Kind::object_timers:
            return object_timers_;
    }
    return nullptr;
}

std::shared_ptr<const PortTraces> Execution::traces_of(const std::string& port) const {
    const auto traces = demands_.traces.find(port);
    if (traces == demands_.traces.end()) {
        return nullptr;
    }
    return std::make_shared<const PortTraces>(traces->second, id_, platform_);
}

void Execution::open() {
    if (timers_) {
        timers_->open();
    }
}

void Execution::begin() {
    if (paced_guard_) {
        paced_guard_->begin();
    }
    if (self_execution_) {
        self_execution_->begin();
    }
    if (timers_) {
        timers_->begin();
    }
}

void Execution::end() {
    if (paced_guard_) {
        paced_guard_->end();
    }
    if (self_execution_) {
        self_execution_->end();
    }
    if (timers_) {
        timers_->end();
    }
}

void Execution::close() {
    end();
    if (index_timers_) {
        index_timers_->close();
    }
    if (own_executor_) {
        own_executor_->end();
    }
}

}  // namespace lwucm
