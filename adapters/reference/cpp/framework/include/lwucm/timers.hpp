// The timers that containers provide to components by policies itt_timer (10.3.2) and ott_timer (10.3.1).
#ifndef LWUCM_TIMERS_HPP
#define LWUCM_TIMERS_HPP

#include <cstdint>
#include <memory>
#include <string>

#include "lwucm/container_services.hpp"
#include "lwucm/interfaces.hpp"

namespace lwucm {

enum class timeout_enum_t : std::int8_t { ABSOLUTE_TIME, RELATIVE_TIME };

/// Seconds: a date of the component's local clock, or counted from the call.
struct timeout_t {
    std::uint32_t time_val;
    timeout_enum_t flag;
};

typedef std::uint32_t timer_number_t;

/// What a component requires by policy `itt_timer`. May be called at any time from any thread. BAD_PARAMETER if a rate is 0.
class itt_service_intf : public DynamicPortElement {
  public:
    virtual void start_periodic_scheduler(timer_number_t timer_number, const timeout_t& delay_time,
                                          const timeout_t& rate) = 0;
    virtual void start_sporadic_scheduler(timer_number_t timer_number, const timeout_t& time) = 0;
    virtual void cancel_timer(timer_number_t timer_number) = 0;
    virtual bool is_canceled(timer_number_t timer_number) = 0;

    const InterfacePtr& get_interface() const final;
    Values call(const std::string& method, const Values& arguments) final;
};

/// What it provides to its container by the same policy.
class itt_callback_intf : public DynamicPortElement {
  public:
    virtual void on_timeout(const timeout_t& time, timer_number_t timer_number) = 0;

    const InterfacePtr& get_interface() const final;
    Values call(const std::string& method, const Values& arguments) final;
};

/// Calls `on_timeout` of a port element that can be called by name.
void call_on_timeout(DynamicPortElement& callback, const timeout_t& time, timer_number_t timer_number);

typedef std::uint32_t ott_round_t;

/// A timer that an `ott_scheduler` gives out. May be called at any time from any thread, also when nothing but its holder is left.
class ott_timer {
  public:
    virtual ~ott_timer() = default;

    /// How many rounds have been done; one that is being done counts.
    virtual ott_round_t rounds() = 0;

    /// Belongs to this timer alone in the runtime, for ever.
    virtual std::string id() = 0;

    virtual void cancel() = 0;

    /// Does it wait no longer?
    virtual bool is_cancelled() = 0;
};

/// What a timer calls. The scheduler holds it as long as its timer waits, or executes it.
class ott_handler {
  public:
    virtual ~ott_handler() = default;

    /// `delta_time` has passed since the timer was asked for; the first `round` is 1.
    virtual void on_trigger(const std::shared_ptr<ott_timer>& timer, const ucm_timeval_t& delta_time,
                            ott_round_t round) = 0;
};

/// What a component requires by policy `ott_timer`. May be called at any time from any thread. UCM_ERROR if the component is not
/// operational; BAD_PARAMETER if there is no handler, a time has no 0 to 999999 microseconds, or an interval is 0.
class ott_scheduler : public PortElementObject {
  public:
    virtual std::shared_ptr<ott_timer> scheduler_trigger(const std::shared_ptr<ott_handler>& trigger_handler,
                                                         const ucm_timeval_t& trigger_delay) = 0;

    /// The timer never triggers if `max_rounds` is 0.
    virtual std::shared_ptr<ott_timer> schedule_repeated_trigger(const std::shared_ptr<ott_handler>& trigger_handler,
                                                                 const ucm_timeval_t& start_delay,
                                                                 const ucm_timeval_t& interval,
                                                                 ott_round_t max_rounds) = 0;
};

}  // namespace lwucm

#endif
