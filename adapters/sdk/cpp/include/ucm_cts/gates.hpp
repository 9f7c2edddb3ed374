// Gates: where probes wait until the scenario lets them go on.
#ifndef UCM_CTS_GATES_HPP
#define UCM_CTS_GATES_HPP

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <thread>

namespace ucm_cts {

/// A scenario's patience as a duration; out of range values are clamped to what a clock can add.
inline std::chrono::milliseconds patience_of(std::int64_t milliseconds) {
    const std::int64_t longest = std::int64_t(1000) * 60 * 60 * 24;
    return std::chrono::milliseconds(milliseconds < 0 ? 0 : milliseconds > longest ? longest : milliseconds);
}

class Gates {
  public:
    explicit Gates(std::chrono::milliseconds patience) : patience_(patience) {}

    /// A probe arrives. `record_held` is called before any thread can learn of the arrival.
    template <class Record>
    void hold(const std::string& name, Record record_held) {
        std::unique_lock<std::mutex> lock(mutex_);
        Gate& gate = gates_[name];
        record_held();
        ++gate.arrivals;
        held_[std::this_thread::get_id()] = &gate;
        changed_.notify_all();
        changed_.wait_for(lock, patience_, [this, &gate] { return gate.open || all_open_; });
        held_.erase(std::this_thread::get_id());
    }

    /// Is the thread itself held at a gate that is still shut?
    bool holds(std::thread::id thread) {
        std::lock_guard<std::mutex> lock(mutex_);
        const auto found = held_.find(thread);
        return found != held_.end() && !found->second->open && !all_open_;
    }

    /// Waits until a probe has arrived at the gate, or `more` have from now on, or `total` in all; false when patience
    /// runs out.
    bool reach(const std::string& name, std::int64_t more, std::int64_t total) {
        std::unique_lock<std::mutex> lock(mutex_);
        Gate& gate = gates_[name];
        const std::int64_t enough = std::max(more > 0 ? gate.arrivals + more : 1, total);
        return changed_.wait_for(lock, patience_, [&gate, enough] { return gate.arrivals >= enough; });
    }

    /// Opens the gate for good. `record_opened` is called before any probe goes on.
    template <class Record>
    void open(const std::string& name, Record record_opened) {
        std::lock_guard<std::mutex> lock(mutex_);
        record_opened();
        gates_[name].open = true;
        changed_.notify_all();
    }

    void open_all() {
        std::lock_guard<std::mutex> lock(mutex_);
        all_open_ = true;
        changed_.notify_all();
    }

  private:
    struct Gate {
        bool open = false;
        std::int64_t arrivals = 0;
    };

    const std::chrono::milliseconds patience_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::string, Gate> gates_;
    std::map<std::thread::id, const Gate*> held_;
    bool all_open_ = false;
};

}  // namespace ucm_cts

#endif
