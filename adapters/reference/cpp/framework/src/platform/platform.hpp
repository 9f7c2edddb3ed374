// Platform: what a runtime offers all of its components: the clock, the trace, a common executor.
#ifndef LWUCM_SRC_PLATFORM_HPP
#define LWUCM_SRC_PLATFORM_HPP

#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "execution/executor.hpp"
#include "lwucm/container_services.hpp"
#include "lwucm/options.hpp"

namespace lwucm {

/// The whole system is one computer, so that its time is the computer's.
class NodeClock final : public clock_service_intf {
  public:
    explicit NodeClock(Options::Clock clock) : clock_(clock) {}

    void get_local_time(ucm_timeval_t& local_time) override {
        using std::chrono::duration_cast;
        typedef std::chrono::microseconds Microseconds;
        const Microseconds since_begin =
            clock_ == Options::Clock::calendar
                ? duration_cast<Microseconds>(std::chrono::system_clock::now().time_since_epoch())
                : duration_cast<Microseconds>(std::chrono::steady_clock::now().time_since_epoch());
        local_time.utv_sec = static_cast<std::uint32_t>(since_begin.count() / 1000000);
        local_time.utv_usec = static_cast<std::int32_t>(since_begin.count() % 1000000);
    }
    void get_synchronized_time(ucm_timeval_t& synchronized_time) override { get_local_time(synchronized_time); }

  private:
    const Options::Clock clock_;
};

/// The records of a runtime's trace, in memory.
class TraceLog {
  public:
    void add(log_severity_t severity, const std::u32string& message) {
        std::lock_guard<std::mutex> lock(mutex_);
        records_.push_back({severity, message});
    }

    /// All records so far, oldest first.
    std::vector<LogRecord> records() const {
        std::lock_guard<std::mutex> lock(mutex_);
        return records_;
    }

  private:
    mutable std::mutex mutex_;
    std::vector<LogRecord> records_;
};

/// What components write to it with.
class TraceService final : public trace_service_intf {
  public:
    explicit TraceService(std::shared_ptr<TraceLog> trace) : trace_(std::move(trace)) {}

    void log(log_severity_t severity, const std::u32string& message) override { trace_->add(severity, message); }

  private:
    const std::shared_ptr<TraceLog> trace_;
};

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
