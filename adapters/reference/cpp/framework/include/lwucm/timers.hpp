// The timers that containers provide to components by policy itt_timer (10.3.2).
#ifndef LWUCM_TIMERS_HPP
#define LWUCM_TIMERS_HPP

#include <cstdint>

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

}  // namespace lwucm

#endif
