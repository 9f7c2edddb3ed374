// Platform: what a runtime offers all of its components.
#ifndef LWUCM_SRC_PLATFORM_HPP
#define LWUCM_SRC_PLATFORM_HPP

#include <memory>

#include "clock.hpp"
#include "executor.hpp"
#include "lwucm/options.hpp"
#include "trace_log.hpp"

namespace lwucm {

/// `executor` is null unless all protected components share one.
struct Platform {
    explicit Platform(const Options& chosen)
        : options(chosen),
          trace(std::make_shared<TraceLog>()),
          clock(std::make_shared<NodeClock>(chosen.clock)),
          executor(chosen.executor == Options::Executor::shared ? std::make_shared<Executor>() : nullptr) {}

    const Options options;
    const std::shared_ptr<TraceLog> trace;
    const std::shared_ptr<NodeClock> clock;
    const std::shared_ptr<Executor> executor;
};

}  // namespace lwucm

#endif
