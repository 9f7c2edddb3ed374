// TraceLog: the records of a runtime's trace, in memory.
#ifndef LWUCM_SRC_TRACE_LOG_HPP
#define LWUCM_SRC_TRACE_LOG_HPP

#include <mutex>
#include <string>
#include <vector>

#include "lwucm/container_services.hpp"

namespace lwucm {

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

}  // namespace lwucm

#endif
