// Timers: object timers (10.3.1), the callback of index timers (10.3.2), and time-outs that count from what a clock shows.
#ifndef UCM_CTS_TIMERS_HPP
#define UCM_CTS_TIMERS_HPP

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ucm_cts/adapter.hpp"

namespace ucm_cts {

/// A time of 10.3.1, as ucm_timeval_t. All numbers of object timers are wider than in the text: that they fit is judged, so wider
/// ones must come through.
struct TimeValue {
    std::int64_t seconds;
    std::int64_t microseconds;
};

/// A timer, which a scheduler gives out. `rounds` and `id` are the getters of its attributes. Bodies keep timers until the
/// scenario is over, and may call them when the framework has dropped them.
class ObjectTimer {
  public:
    virtual ~ObjectTimer() = default;
    virtual std::int64_t rounds() = 0;
    virtual std::string id() = 0;
    virtual void cancel() = 0;
    virtual bool is_cancelled() = 0;
};

/// What a body passes to a scheduler, and the timer calls. The same object whenever the body passes the same handler.
class TimerHandler {
  public:
    virtual ~TimerHandler() = default;

    /// `timer` triggers. May throw anything.
    virtual void on_trigger(const std::shared_ptr<ObjectTimer>& timer, const TimeValue& delta_time,
                            std::int64_t round) = 0;
};

/// The port element `timer_scheduler` that a component requires by policy `ott_timer`. An adapter hands it over in `on_startup`,
/// like any other. The methods throw what the framework throws where it refuses a call.
class TimerScheduler : public PortElement {
  public:
    /// Makes a timer that triggers `handler` once, after `delay`.
    virtual std::shared_ptr<ObjectTimer> scheduler_trigger(const std::shared_ptr<TimerHandler>& handler,
                                                           const TimeValue& delay) = 0;

    /// Makes a timer that triggers `handler` `max_rounds` times, and returns it if `repeated-result=timer` is declared.
    virtual std::shared_ptr<ObjectTimer> schedule_repeated_trigger(const std::shared_ptr<TimerHandler>& handler,
                                                                   const TimeValue& start_delay,
                                                                   const TimeValue& interval,
                                                                   std::int64_t max_rounds) = 0;

    std::int32_t exchange(std::int32_t) final { throw std::logic_error("a scheduler has no exchange"); }
};

namespace detail {

inline SharedType timeout_type() {
    DataType seconds;
    seconds.base = "ULONG";
    DataType flag;
    flag.kind = DataType::Kind::enumeration;
    flag.base = "BYTE";
    flag.name = "timeout_enum_t";
    flag.enumerators = {{"ABSOLUTE_TIME", 0}, {"RELATIVE_TIME", 1}};
    DataType timeout;
    timeout.kind = DataType::Kind::structure;
    timeout.name = "timeout_t";
    timeout.fields = {{"time_val", std::make_shared<const DataType>(seconds)},
                      {"flag", std::make_shared<const DataType>(flag)}};
    return std::make_shared<const DataType>(timeout);
}

inline SharedInterface make_timer_callback_interface() {
    DataType number;
    number.base = "ULONG";
    Method on_timeout;
    on_timeout.parameters.resize(2);
    on_timeout.parameters[0].name = "time";
    on_timeout.parameters[0].of = timeout_type();
    on_timeout.parameters[1].name = "timer_number";
    on_timeout.parameters[1].of = std::make_shared<const DataType>(number);
    Interface callback;
    callback.methods.emplace("on_timeout", on_timeout);
    return std::make_shared<const Interface>(callback);
}

/// The number, if it is an integer of 64 bits with sign.
inline bool find_number(const Datum& value, std::int64_t& number) {
    const bool fits = value.is_number_integer() &&
                      !(value.is_number_unsigned() && value.get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX));
    number = fits ? value.get<std::int64_t>() : 0;
    return fits;
}

}  // namespace detail

/// The latest date.
constexpr std::int64_t LARGEST_SECONDS = 0xFFFFFFFF;

/// The interface of `timer_callback`: method `on_timeout` with a time-out, which is seconds and a flag, and a number.
inline const SharedInterface& timer_callback_interface() {
    static const SharedInterface interface = detail::make_timer_callback_interface();
    return interface;
}

/// Has the time-out among `arguments` at `position` count from the seconds of `time`, what a method of the clock gave. False if
/// it gave no time, no time-out is there, or the date is none of 32 bits without sign.
inline bool date_from(const Data& time, std::int32_t position, Data& arguments) {
    const std::size_t at = static_cast<std::size_t>(position);
    if (time.size() != 1 || position < 0 || at >= arguments.size()) {
        return false;
    }
    const Datum& clock = time[0];
    const Datum& timeout = arguments[at];
    std::int64_t now = 0;
    std::int64_t micros = 0;
    std::int64_t seconds = 0;
    if (!clock.is_array() || clock.size() != 2 || !timeout.is_array() || timeout.size() != 2 ||
        !detail::find_number(clock[0], now) || !detail::find_number(clock[1], micros) ||
        !detail::find_number(timeout[0], seconds) || now < 0 || now > LARGEST_SECONDS || seconds < -now ||
        seconds > LARGEST_SECONDS - now) {
        return false;
    }
    arguments[at] = Datum::array({now + seconds, timeout[1]});
    return true;
}

}  // namespace ucm_cts

#endif
