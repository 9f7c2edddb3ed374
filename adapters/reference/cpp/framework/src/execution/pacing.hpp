// Pacing: when components with an execution policy of 10.5 are executed.
#ifndef LWUCM_SRC_PACING_HPP
#define LWUCM_SRC_PACING_HPP

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>

#include "execution/monitor.hpp"
#include "execution/self_execution.hpp"

namespace lwucm {

/// What such a policy is configured with. `period` is the least distance of a sporadic component.
struct Pacing {
    enum class Kind { none, periodic, background, sporadic };

    Kind kind = Kind::none;
    std::chrono::microseconds period{0};
    std::chrono::microseconds offset{0};
};

/// Calls run() when the offset has passed, and again each period if it is periodic. Instants that pass during a run are left
/// out.
class PacedSelfExecution final : public SelfExecution {
  public:
    PacedSelfExecution(std::shared_ptr<component_execution_intf> component, std::shared_ptr<Guard> guard,
                       const Pacing& pacing);
    ~PacedSelfExecution() override;

  protected:
    void work() override;

  private:
    const Pacing pacing_;
};

/// Lets callers of managed port elements wait until the component may be executed. A periodic component serves all who wait
/// at an instant; between two executions of a sporadic one passes its least distance, from end to start.
class PacedGuard final : public Guard {
  public:
    PacedGuard(std::shared_ptr<Monitor> monitor, std::shared_ptr<Guard> inner, const Pacing& pacing);

    /// UCM_ERROR while the component is not operational, and if it is stopped while the caller waits.
    void call(const std::function<void()>& code) override;

    void begin();
    void end();

  private:
    typedef std::chrono::steady_clock Clock;

    bool is_over(std::uint64_t phase) const;
    void enter(std::uint64_t phase, const std::function<void()>& code);
    void await_instant(std::unique_lock<std::mutex>& lock);
    void execute_in_turn(std::unique_lock<std::mutex>& lock, const std::function<void()>& code);
    void await(std::unique_lock<std::mutex>& lock, Clock::time_point moment);

    const std::shared_ptr<Monitor> monitor_;
    const std::shared_ptr<Guard> inner_;
    const Pacing pacing_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool operational_ = false;
    std::uint64_t phase_ = 0;  // counts the times that it became operational
    Clock::time_point first_;
    Clock::time_point free_from_;
    std::uint64_t next_ticket_ = 0;
    std::uint64_t admitted_ = 0;
};

}  // namespace lwucm

#endif
