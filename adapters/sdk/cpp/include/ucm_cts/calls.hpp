// Calls of methods that a probe makes by name: of references of its port elements, of schedulers and of object timers (10.3.1).
#ifndef UCM_CTS_CALLS_HPP
#define UCM_CTS_CALLS_HPP

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/timers.hpp"

namespace ucm_cts {

/// The methods of schedulers, handlers and object timers, and the getters of their attributes.
const char* const SCHEDULE_ONCE = "scheduler_trigger";
const char* const SCHEDULE_REPEATED = "schedule_repeated_trigger";
const char* const ON_TRIGGER = "on_trigger";
const char* const CANCEL = "cancel";
const char* const IS_CANCELLED = "is_cancelled";
const char* const TIMER_ROUNDS = "rounds";
const char* const TIMER_ID = "id";

/// What came back from a call: results, and from a scheduler a timer, or why there is none, for people.
struct CallResult {
    Data results;
    std::shared_ptr<ObjectTimer> timer;
    std::string wrong;
};

/// Carries out a call with these arguments. Throws what the callee throws.
typedef std::function<CallResult(const Data&)> Calling;

/// A call of a method of `reference`.
inline Calling call_port(const Reference& reference, const std::string& method) {
    return [reference, method](const Data& arguments) {
        CallResult result;
        result.results = reference->call(method, arguments);
        return result;
    };
}

namespace detail {

inline void expect_arguments(const Data& arguments, std::size_t due) {
    if (arguments.size() != due) {
        throw std::invalid_argument(std::to_string(due) + " arguments are due");
    }
}

inline std::int64_t number_of(const Datum& value) {
    std::int64_t number = 0;
    if (!find_number(value, number)) {
        throw std::invalid_argument("an argument is no number");
    }
    return number;
}

inline TimeValue time_of(const Datum& value) {
    if (!value.is_array() || value.size() != 2) {
        throw std::invalid_argument("an argument is no time");
    }
    return {number_of(value[0]), number_of(value[1])};
}

}  // namespace detail

/// A call of a method of the scheduler that `reference` is, with `handler` before the other arguments.
inline Calling schedule(const Reference& reference, const std::string& method,
                        const std::shared_ptr<TimerHandler>& handler) {
    return [reference, method, handler](const Data& arguments) {
        TimerScheduler* const scheduler = dynamic_cast<TimerScheduler*>(reference.get());
        if (scheduler == nullptr || !handler) {
            throw std::logic_error("no scheduler, or no such handler");
        }
        CallResult result;
        if (method == SCHEDULE_ONCE) {
            detail::expect_arguments(arguments, 1);
            result.timer = scheduler->scheduler_trigger(handler, detail::time_of(arguments[0]));
            result.wrong = result.timer ? "" : "null as the timer";
        } else if (method == SCHEDULE_REPEATED) {
            detail::expect_arguments(arguments, 3);
            result.timer = scheduler->schedule_repeated_trigger(handler, detail::time_of(arguments[0]),
                                                                detail::time_of(arguments[1]),
                                                                detail::number_of(arguments[2]));
        } else {
            throw std::logic_error("a scheduler has no " + method);
        }
        return result;
    };
}

/// A call of a method of `timer`.
inline Calling call_timer(const std::shared_ptr<ObjectTimer>& timer, const std::string& method) {
    return [timer, method](const Data& arguments) {
        detail::expect_arguments(arguments, 0);
        CallResult result;
        if (method == CANCEL) {
            timer->cancel();
        } else if (method == IS_CANCELLED) {
            result.results.push_back(timer->is_cancelled());
        } else if (method == TIMER_ROUNDS) {
            result.results.push_back(timer->rounds());
        } else if (method == TIMER_ID) {
            result.results.push_back(timer->id());
        } else {
            throw std::logic_error("a timer has no " + method);
        }
        return result;
    };
}

}  // namespace ucm_cts

#endif
