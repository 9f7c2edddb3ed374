// Memory: what a body was given before, for the plans that name it.
#ifndef UCM_CTS_MEMORY_HPP
#define UCM_CTS_MEMORY_HPP

#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ucm_cts/data_types.hpp"
#include "ucm_cts/scenario.hpp"

namespace ucm_cts {

/// A body was entered at `method` with these `arguments`, at `exchange` with `value`, or at another hook.
struct Entry {
    std::string method;
    Data arguments;
    bool has_value = false;
    std::int32_t value = 0;

    Entry() = default;
    explicit Entry(std::int32_t given) : has_value(true), value(given) {}
    Entry(std::string entered, Data given) : method(std::move(entered)), arguments(std::move(given)) {}
};

/// The arguments of the methods that a plan wants remembered.
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

    std::set<std::string> methods_;
    std::mutex mutex_;
    std::vector<Entry> seen_;
};

}  // namespace ucm_cts

#endif
