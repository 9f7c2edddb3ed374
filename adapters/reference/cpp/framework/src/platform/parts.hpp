// Parts: what makes the parts of a runtime that others may want to be different.
#ifndef LWUCM_SRC_PARTS_HPP
#define LWUCM_SRC_PARTS_HPP

#include <functional>
#include <memory>

#include "containers/shared.hpp"
#include "execution/monitor.hpp"
#include "execution/pacing.hpp"
#include "execution/self_execution.hpp"
#include "execution/timers.hpp"
#include "links/inbox.hpp"
#include "links/open_requests.hpp"
#include "links/shared_values.hpp"
#include "lwucm/runtime.hpp"

namespace lwucm {

/// A framework that derives from classes of this one is linked with other definitions of these; nothing else is to be
/// changed for it. parts.cpp has the framework's own.
struct Parts {
    static std::shared_ptr<Runtime> runtime(std::shared_ptr<Shared> shared);
    static std::shared_ptr<Monitor> monitor();
    static std::unique_ptr<SelfExecution> self_execution(std::shared_ptr<component_execution_intf> component,
                                                         std::shared_ptr<Guard> guard);
    static std::unique_ptr<SelfExecution> paced_self_execution(std::shared_ptr<component_execution_intf> component,
                                                               std::shared_ptr<Guard> guard, const Pacing& pacing);
    static std::shared_ptr<PacedGuard> paced_guard(std::shared_ptr<Monitor> monitor, std::shared_ptr<Guard> inner,
                                                   const Pacing& pacing);
    static std::shared_ptr<Timers> timers(std::shared_ptr<Guard> guard);
    static std::unique_ptr<Inbox> inbox(std::function<void(const Bytes&)> deliver, const Options& options);
    static std::unique_ptr<OpenRequests> open_requests();
    static std::unique_ptr<Draft> draft();
    static std::unique_ptr<View> view(const Value& at_first);
};

}  // namespace lwucm

#endif
