// Stage: what all probes of one scenario share.
#ifndef UCM_CTS_STAGE_HPP
#define UCM_CTS_STAGE_HPP

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <utility>

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/counting.hpp"
#include "ucm_cts/gates.hpp"
#include "ucm_cts/generated/events.hpp"
#include "ucm_cts/trace.hpp"

namespace ucm_cts {

/// Probes keep it alive, so that a framework may keep probes.
class Stage {
  public:
    Stage(Recorder::Sink sink, std::int64_t milliseconds)
        : patience(patience_of(milliseconds)), recorder(std::move(sink)), gates(patience) {}

    const std::chrono::milliseconds patience;
    Recorder recorder;
    Gates gates;
    MessageCounts messages;

    /// Under stress probes record and do nothing, and count their `overlaps`.
    std::atomic<Pace> stress{Pace::none};
    std::atomic<std::int64_t> overlaps{0};

    /// The adapter broke the contract, so the trace does not count; the first problem is reported.
    void complain(const std::string& problem) {
        std::lock_guard<std::mutex> lock(mutex_);
        if (complaint_.empty() && !recorder.closed()) {
            complaint_ = problem;
        }
    }

    /// How the adapter broke the contract; empty if it did not.
    std::string complaint() {
        std::lock_guard<std::mutex> lock(mutex_);
        return complaint_;
    }

  private:
    std::mutex mutex_;
    std::string complaint_;
};

}  // namespace ucm_cts

#endif
