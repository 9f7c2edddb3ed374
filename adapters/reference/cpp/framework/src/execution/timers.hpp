// Timers: those of one component (10.3.2), which it sets and cancels by number.
#ifndef LWUCM_SRC_TIMERS_HPP
#define LWUCM_SRC_TIMERS_HPP

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "execution/monitor.hpp"
#include "lwucm/container_services.hpp"
#include "lwucm/timers.hpp"

namespace lwucm {

/// What the component sets its timers with. They live from one start of the container to the next stop. A thread, which the first
/// timer brings, calls back, one timer after the other.
class Timers final : public itt_service_intf {
  public:
    /// `guard` is null if nothing stands between the component and those who call it. Dates are those of `clock`.
    Timers(std::shared_ptr<DynamicPortElement> callback, std::shared_ptr<Guard> guard,
           std::shared_ptr<clock_service_intf> clock);
    ~Timers() override;

    // A number that is in use stays as it is; outside of `open` and `end` nothing is set. The flag of a rate has no meaning.
    void start_periodic_scheduler(timer_number_t timer_number, const timeout_t& delay_time,
                                  const timeout_t& rate) override;
    void start_sporadic_scheduler(timer_number_t timer_number, const timeout_t& time) override;
    void cancel_timer(timer_number_t timer_number) override;

    /// Does no timer of that number wait?
    bool is_canceled(timer_number_t timer_number) override;

    /// The component is about to start: it may set timers.
    void open();

    /// The component is operational: timers call back.
    void begin();

    /// Drops all timers and waits for the callback that is under way.
    void end();

    /// The same for good: lets go of the component.
    void close();

  private:
    typedef std::chrono::steady_clock Clock;
    typedef std::chrono::duration<std::uint32_t> Seconds;

    enum class Phase { closed, open, operational };

    /// `date` is what the clock shows when it is due. `rate` is 0 if it is due once.
    struct Timer {
        Clock::time_point due;
        std::uint32_t date;
        Seconds rate;
    };

    void set(timer_number_t number, const timeout_t& time, Seconds rate);
    Timer timer_for(const timeout_t& time, Seconds rate) const;
    std::map<timer_number_t, Timer>::iterator first();
    void begin_thread();
    void work();
    void call_back(timer_number_t number);
    bool take(timer_number_t number, std::uint32_t& date);

    std::shared_ptr<DynamicPortElement> callback_;
    const std::shared_ptr<Guard> guard_;
    const std::shared_ptr<clock_service_intf> clock_;
    std::mutex mutex_;
    std::condition_variable changed_;
    Phase phase_ = Phase::closed;
    std::map<timer_number_t, Timer> waiting_;
    std::thread thread_;
};

}  // namespace lwucm

#endif
