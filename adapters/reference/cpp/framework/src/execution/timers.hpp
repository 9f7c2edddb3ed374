// Timers: those of one component (10.3), by which its container calls it back.
#ifndef LWUCM_SRC_TIMERS_HPP
#define LWUCM_SRC_TIMERS_HPP

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "execution/monitor.hpp"

namespace lwucm {

/// A timer that waits: when it is due, again after each `rate`, or once if that is 0.
class Timer {
  public:
    typedef std::chrono::steady_clock Clock;

    Timer(Clock::time_point first, std::chrono::microseconds its_rate) : due(first), rate(its_rate) {}
    virtual ~Timer() = default;

    /// It expires `now`; `due` is still the instant that has come. Returns what calls the component back. The timers are locked
    /// meanwhile.
    virtual std::function<void()> expire(Clock::time_point now) = 0;

    /// Has it expired for the last time? Asked after each expiry.
    virtual bool is_over() const { return rate.count() == 0; }

    Clock::time_point due;
    const std::chrono::microseconds rate;
};

/// The timers of one component. They live from one start of the container to the next stop. A thread, which the first timer brings,
/// calls back, one timer after the other. May be called at any time from any thread.
class Timers {
  public:
    /// The services that set timers. Each has numbers of its own for them.
    enum class Service { index, object };
    typedef std::pair<Service, std::uint64_t> Name;

    /// `guard` is null if nothing stands between the component and those who call it.
    explicit Timers(std::shared_ptr<Guard> guard);
    virtual ~Timers();

    /// Has a timer wait. If one of that name waits already, that one stays as it is. Returns false, and nothing is set, outside
    /// of `open` and `end`.
    virtual bool set(Name name, std::unique_ptr<Timer> timer);

    /// Does `set` set timers now?
    bool are_set() const;

    virtual void cancel(Name name);
    bool waits(Name name) const;

    /// The component is about to start: it may set timers.
    void open();

    /// The component is operational: timers call back.
    void begin();

    /// Drops all timers and waits for the callback that is under way.
    void end();

  private:
    typedef Timer::Clock Clock;
    typedef std::map<Name, std::unique_ptr<Timer>> Waiting;

    enum class Phase { closed, open, operational };

    Waiting::iterator first();
    void begin_thread();
    void work();
    void call_back(Name name);
    std::function<void()> take(Name name);

    const std::shared_ptr<Guard> guard_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    Phase phase_ = Phase::closed;
    Waiting waiting_;
    std::thread thread_;
};

}  // namespace lwucm

#endif
