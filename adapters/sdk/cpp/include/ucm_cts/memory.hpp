// Memory: what a body was given before, for the plans that name it.
#ifndef UCM_CTS_MEMORY_HPP
#define UCM_CTS_MEMORY_HPP

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ucm_cts/data_types.hpp"
#include "ucm_cts/scenario.hpp"
#include "ucm_cts/timers.hpp"

namespace ucm_cts {

/// A body was entered at `method` with these `arguments` and the object timer of number `timer` (0: none), at `exchange` with
/// `value`, or at another hook.
struct Entry {
    std::string method;
    Data arguments;
    bool has_value = false;
    std::int32_t value = 0;
    std::int64_t timer = 0;

    Entry() = default;
    explicit Entry(std::int32_t given) : has_value(true), value(given) {}
    Entry(std::string entered, Data given) : method(std::move(entered)), arguments(std::move(given)) {}
};

/// An object timer that came to a body by `method`.
struct GivenTimer {
    std::string method;
    std::shared_ptr<ObjectTimer> timer;
};

/// The arguments of the methods that a plan wants remembered, and all object timers that came to the body.
class Memory {
  public:
    explicit Memory(const Declaration& declaration) {
        for (const auto& plan : declaration.plan) {
            for (const Action& action : plan.second) {
                for (const Remembered& one : action.remembered) {
                    methods_.insert(one.method);
                }
            }
        }
    }

    /// Records and remembers an entry, in one and the same order.
    template <class Record>
    void enter(const Entry& entry, const Record& record) {
        if (methods_.count(entry.method) == 0) {
            record();
            return;
        }
        std::lock_guard<std::mutex> lock(mutex_);
        record();
        seen_.push_back(entry);
    }

    /// Numbers an object timer, from 1, and records that by `record(number)`, in one and the same order; returns its number.
    template <class Record>
    std::int64_t take(GivenTimer given, const Record& record) {
        std::lock_guard<std::mutex> lock(mutex_);
        timers_.push_back(std::move(given));
        const std::int64_t number = static_cast<std::int64_t>(timers_.size());
        record(number);
        return number;
    }

    /// The number of an object timer, and the timer; 0 if the body was not given it yet.
    std::int64_t find(const TimerFrom& of, const Entry& entry, std::shared_ptr<ObjectTimer>& timer) {
        std::lock_guard<std::mutex> lock(mutex_);
        const std::int64_t number = of.nth != 0 ? number_of(of) : entry.method == of.method ? entry.timer : 0;
        if (number == 0 || static_cast<std::size_t>(number) > timers_.size()) {
            return 0;  // or a trigger has outlived the scenario
        }
        timer = timers_[static_cast<std::size_t>(number - 1)].timer;
        return number;
    }

    /// Lets go of all object timers.
    void forget() {
        std::vector<GivenTimer> timers;  // the framework's, so they end when the lock has been given back
        std::lock_guard<std::mutex> lock(mutex_);
        timers.swap(timers_);
    }

    /// The arguments of `call`, made in `entry`; false if it is not to be made: the body was entered with another value, or
    /// was not given one of them yet.
    bool arguments(const Action& call, const Entry& entry, Data& into) {
        if (call.has_given && !(entry.has_value && call.given == entry.value)) {
            return false;
        }
        into = call.arguments;
        for (const Remembered& one : call.remembered) {
            Entry found;
            if (!find(one, entry, found) || !is_in(one.position, found.arguments) || !is_in(one.argument, into)) {
                return false;
            }
            into[static_cast<std::size_t>(one.argument)] = found.arguments[static_cast<std::size_t>(one.position)];
        }
        return true;
    }

  private:
    static bool is_in(std::int32_t index, const Data& data) {
        return index >= 0 && static_cast<std::size_t>(index) < data.size();
    }

    bool find(const Remembered& one, const Entry& entry, Entry& found) {
        if (one.nth == 0) {
            found = entry;
            return entry.method == one.method;
        }
        std::lock_guard<std::mutex> lock(mutex_);
        std::int32_t nth = 0;
        for (const Entry& seen : seen_) {
            if (seen.method == one.method && ++nth == one.nth) {
                found = seen;
                return true;
            }
        }
        return false;
    }

    std::int64_t number_of(const TimerFrom& of) const {
        std::int32_t nth = 0;
        for (std::size_t index = 0; index < timers_.size(); ++index) {
            if (timers_[index].method == of.method && ++nth == of.nth) {
                return static_cast<std::int64_t>(index) + 1;
            }
        }
        return 0;
    }

    std::set<std::string> methods_;
    std::mutex mutex_;
    std::vector<Entry> seen_;
    std::vector<GivenTimer> timers_;
};

}  // namespace ucm_cts

#endif
