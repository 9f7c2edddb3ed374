#include "execution/timers.hpp"

#include <algorithm>
#include <utility>

namespace lwucm {

Timers::Timers(std::shared_ptr<DynamicPortElement> callback, std::shared_ptr<Guard> guard,
               std::shared_ptr<clock_service_intf> clock)
    : callback_(std::move(callback)), guard_(std::move(guard)), clock_(std::move(clock)) {}

Timers::~Timers() { end(); }

void Timers::start_periodic_scheduler(timer_number_t timer_number, const timeout_t& delay_time, const timeout_t& rate) {
    if (rate.time_val == 0) {
        throw BAD_PARAMETER("a rate is at least one second");
    }
    set(timer_number, delay_time, Seconds(rate.time_val));
}

void Timers::start_sporadic_scheduler(timer_number_t timer_number, const timeout_t& time) {
    set(timer_number, time, Seconds(0));
}

void Timers::cancel_timer(timer_number_t timer_number) {
    std::lock_guard<std::mutex> lock(mutex_);
    waiting_.erase(timer_number);
}

bool Timers::is_canceled(timer_number_t timer_number) {
    std::lock_guard<std::mutex> lock(mutex_);
    return waiting_.count(timer_number) == 0;
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
    {
        std::lock_guard<std::mutex> lock(mutex_);
        phase_ = Phase::closed;
        waiting_.clear();
        changed_.notify_one();
    }
    if (thread_.joinable()) {
        thread_.join();
    }
}

void Timers::close() {
    end();
    callback_ = nullptr;
}

void Timers::set(timer_number_t number, const timeout_t& time, Seconds rate) {
    const Timer timer = timer_for(time, rate);
    std::lock_guard<std::mutex> lock(mutex_);
    if (phase_ == Phase::closed || waiting_.count(number) != 0) {
        return;
    }
    if (phase_ == Phase::operational) {
        begin_thread();
    }
    waiting_.emplace(number, timer);
    changed_.notify_one();
}

/// The clock is read first, so that no timer is due before the clock shows its date. A date that has passed is now.
Timers::Timer Timers::timer_for(const timeout_t& time, Seconds rate) const {
    ucm_timeval_t now = {0, 0};
    clock_->get_local_time(now);
    const Clock::time_point asked = Clock::now();
    if (time.flag == timeout_enum_t::RELATIVE_TIME) {
        return {asked + std::chrono::seconds(time.time_val), now.utv_sec + time.time_val, rate};
    }
    if (time.time_val <= now.utv_sec) {
        return {asked, now.utv_sec, rate};
    }
    const std::chrono::seconds ahead(time.time_val - now.utv_sec);
    return {asked + ahead - std::chrono::microseconds(now.utv_usec), time.time_val, rate};
}

/// The timer that is due first, if there is one.
std::map<timer_number_t, Timers::Timer>::iterator Timers::first() {
    typedef std::pair<const timer_number_t, Timer> Entry;
    return std::min_element(waiting_.begin(), waiting_.end(), [](const Entry& one, const Entry& other) {
        return one.second.due < other.second.due;
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
        const timer_number_t number = next->first;
        const Clock::time_point due = next->second.due;
        if (due > Clock::now()) {
            changed_.wait_until(lock, due);
            continue;
        }
        lock.unlock();
        call_back(number);
        lock.lock();
    }
}

void Timers::call_back(timer_number_t number) {
    const Awaited awaited;  // stop waits for it
    const auto enter = [this, number] {
        timeout_t time = {0, timeout_enum_t::ABSOLUTE_TIME};
        if (take(number, time.time_val)) {
            call_on_timeout(*callback_, time, number);
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
bool Timers::take(timer_number_t number, std::uint32_t& date) {
    std::lock_guard<std::mutex> lock(mutex_);
    const auto found = waiting_.find(number);
    const Clock::time_point now = Clock::now();
    if (found == waiting_.end() || found->second.due > now) {
        return false;
    }
    Timer& timer = found->second;
    date = timer.date;
    if (timer.rate.count() == 0) {
        waiting_.erase(found);
        return true;
    }
    const std::chrono::seconds rate = timer.rate;
    const std::chrono::seconds step = ((now - timer.due) / rate + 1) * rate;
    timer.due += step;
    timer.date += static_cast<std::uint32_t>(step.count());
    return true;
}

}  // namespace lwucm
