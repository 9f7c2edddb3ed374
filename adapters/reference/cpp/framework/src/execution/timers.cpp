#include "execution/timers.hpp"

#include <algorithm>

#include "execution/chain.hpp"

namespace lwucm {

Timers::Timers(std::shared_ptr<Guard> guard) : guard_(std::move(guard)) {}

Timers::~Timers() { end(); }

bool Timers::set(Name name, std::unique_ptr<Timer> timer) {
    std::lock_guard<std::mutex> lock(mutex_);
    if (phase_ == Phase::closed) {
        return false;
    }
    if (phase_ == Phase::operational) {
        begin_thread();
    }
    if (waiting_.count(name) == 0) {
        waiting_.emplace(name, std::move(timer));
        changed_.notify_one();
    }
    return true;
}

bool Timers::are_set() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return phase_ != Phase::closed;
}

void Timers::cancel(Name name) {
    std::unique_ptr<Timer> cancelled;  // may hold the component's own objects, which end when the lock has been given back
    std::lock_guard<std::mutex> lock(mutex_);
    const auto found = waiting_.find(name);
    if (found != waiting_.end()) {
        cancelled = std::move(found->second);
        waiting_.erase(found);
    }
}

bool Timers::waits(Name name) const {
    std::lock_guard<std::mutex> lock(mutex_);
    return waiting_.count(name) != 0;
}

void Timers::open() {
    std::lock_guard<std::mutex> lock(mutex_);
    phase_ = Phase::open;
}

void Timers::begin() {
    std::lock_guard<std::mutex> lock(mutex_);
    phase_ = Phase::operational;
    if (!waiting_.empty()) {
        begin_thread();
    }
}

void Timers::end() {
    Waiting dropped;
    {
        std::lock_guard<std::mutex> lock(mutex_);
        phase_ = Phase::closed;
        dropped.swap(waiting_);
        changed_.notify_one();
    }
    if (thread_.joinable()) {
        thread_.join();
    }
}

/// The timer that is due first, if there is one.
Timers::Waiting::iterator Timers::first() {
    return std::min_element(waiting_.begin(), waiting_.end(),
                            [](const Waiting::value_type& one, const Waiting::value_type& other) {
                                return one.second->due < other.second->due;
                            });
}

void Timers::begin_thread() {
    if (!thread_.joinable()) {
        thread_ = std::thread([this] { work(); });
    }
}

void Timers::work() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (phase_ == Phase::operational) {
        const auto next = first();
        if (next == waiting_.end()) {
            changed_.wait(lock);
            continue;
        }
        const Name name = next->first;
        const Clock::time_point due = next->second->due;
        if (due > Clock::now()) {
            changed_.wait_until(lock, due);
            continue;
        }
        lock.unlock();
        call_back(name);
        lock.lock();
    }
}

void Timers::call_back(Name name) {
    const Awaited awaited;  // stop waits for it
    const auto enter = [this, name] {
        if (const std::function<void()> code = take(name)) {
            code();
        }
    };
    try {
        if (guard_) {
            guard_->call(enter);
        } else {
            enter();
        }
    } catch (...) {  // there is no caller to pass it to
    }
}

/// The component is free for the timer: is it still due? If so, it expires. A periodic one is due again at the next instant of
/// its grid that is to come: this expiry stands for those that were missed.
std::function<void()> Timers::take(Name name) {
    std::unique_ptr<Timer> over;  // ends when the lock has been given back
    std::lock_guard<std::mutex> lock(mutex_);
    const auto found = waiting_.find(name);
    const Clock::time_point now = Clock::now();
    if (found == waiting_.end() || found->second->due > now) {
        return nullptr;
    }
    Timer& timer = *found->second;
    std::function<void()> code = timer.expire(now);
    if (timer.is_over()) {
        over = std::move(found->second);
        waiting_.erase(found);
    } else {
        timer.due += ((now - timer.due) / timer.rate + 1) * timer.rate;
    }
    return code;
}

}  // namespace lwucm
