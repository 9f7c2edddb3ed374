#include "platform/parts.hpp"

#include <utility>

#include "containers/container_impl.hpp"

namespace lwucm {

const char* product() { return "lwucm reference framework (C++)"; }

std::shared_ptr<Runtime> Parts::runtime(std::shared_ptr<Shared> shared) {
    return std::make_shared<ManagerImpl>(std::move(shared));
}

std::shared_ptr<Monitor> Parts::monitor() { return std::make_shared<Monitor>(); }

std::unique_ptr<SelfExecution> Parts::self_execution(std::shared_ptr<component_execution_intf> component,
                                                     std::shared_ptr<Guard> guard) {
    return std::unique_ptr<SelfExecution>(new SelfExecution(std::move(component), std::move(guard)));
}

std::unique_ptr<SelfExecution> Parts::paced_self_execution(std::shared_ptr<component_execution_intf> component,
                                                           std::shared_ptr<Guard> guard, const Pacing& pacing) {
    return std::unique_ptr<SelfExecution>(new PacedSelfExecution(std::move(component), std::move(guard), pacing));
}

std::shared_ptr<PacedGuard> Parts::paced_guard(std::shared_ptr<Monitor> monitor, std::shared_ptr<Guard> inner,
                                               const Pacing& pacing) {
    return std::make_shared<PacedGuard>(std::move(monitor), std::move(inner), pacing);
}

std::shared_ptr<Timers> Parts::timers(std::shared_ptr<Guard> guard) { return std::make_shared<Timers>(std::move(guard)); }

std::unique_ptr<Inbox> Parts::inbox(std::function<void(const Bytes&)> deliver, const Options& options) {
    return std::unique_ptr<Inbox>(new Inbox(std::move(deliver), options));
}

std::unique_ptr<OpenRequests> Parts::open_requests() { return std::unique_ptr<OpenRequests>(new OpenRequests); }

std::unique_ptr<Draft> Parts::draft() { return std::unique_ptr<Draft>(new Draft); }

std::unique_ptr<View> Parts::view(const Value& at_first) { return std::unique_ptr<View>(new View(at_first)); }

}  // namespace lwucm
