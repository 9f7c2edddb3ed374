// What a runtime does where the specification leaves a choice, and its user may choose, too.
#ifndef LWUCM_OPTIONS_HPP
#define LWUCM_OPTIONS_HPP

#include <cstddef>
#include <string>

namespace lwucm {

/// The first value of each is the default. README.md says what they mean and how they are written in a text.
struct Options {
    enum class Delivery { asynchronous, synchronous };
    enum class Executor { caller, component, shared };
    enum class Ids { counting, random, reused };
    enum class Removal { refuse, cascade };
    enum class Repetition { ignore, refuse };
    enum class Unconnected { refuse, tolerate };
    enum class Order { added, reversed };
    enum class ServiceFailure { raise, wait };
    enum class NotReady { hold, drop, error };
    enum class Pending { keep, drop, deliver };
    enum class Clock { calendar, uptime };
    enum class PortTrace { call, call_and_return };

    Delivery delivery = Delivery::asynchronous;
    Executor executor = Executor::caller;
    Ids ids = Ids::counting;
    Removal removal = Removal::refuse;
    Repetition repetition = Repetition::ignore;
    Unconnected unconnected = Unconnected::refuse;
    Order order = Order::added;
    ServiceFailure service_failure = ServiceFailure::raise;
    NotReady not_ready = NotReady::hold;
    Pending pending = Pending::keep;
    Clock clock = Clock::calendar;
    PortTrace port_trace = PortTrace::call;
    std::size_t inbox = 0;  // how many messages wait for a receiver before an emitter waits, 0 if any number
};

/// Reads `option=value,option=value`, as in `delivery=synchronous,ids=random`. BAD_PARAMETER if it is anything else.
Options parse_options(const std::string& text);

}  // namespace lwucm

#endif
