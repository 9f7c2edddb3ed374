#include "execution/index_timers.hpp"

#include <utility>

namespace lwucm {

/// A timer that waits; `date` is what the clock shows when it is due first.
class IndexTimers::Expiring final : public Timer {
  public:
    Expiring(const IndexTimers& service, timer_number_t number, Clock::time_point first, std::uint32_t date,
             std::chrono::seconds its_rate)
        : Timer(first, its_rate), service_(service), number_(number), first_(first), date_(date) {}

    std::function<void()> expire(Clock::time_point) override {
        const auto passed = std::chrono::duration_cast<std::chrono::seconds>(due - first_);
        const timeout_t time = {date_ + static_cast<std::uint32_t>(passed.count()), timeout_enum_t::ABSOLUTE_TIME};
        const std::shared_ptr<DynamicPortElement> callback = service_.callback_;
        const timer_number_t number = number_;
        return [callback, time, number] { call_on_timeout(*callback, time, number); };
    }

  private:
    const IndexTimers& service_;
    const timer_number_t number_;
    const Clock::time_point first_;
    const std::uint32_t date_;
};

IndexTimers::IndexTimers(std::shared_ptr<Timers> timers, std::shared_ptr<DynamicPortElement> callback,
                         std::shared_ptr<clock_service_intf> clock)
    : timers_(std::move(timers)), callback_(std::move(callback)), clock_(std::move(clock)) {}

void IndexTimers::start_periodic_scheduler(timer_number_t timer_number, const timeout_t& delay_time,
                                           const timeout_t& rate) {
    if (rate.time_val == 0) {
        throw BAD_PARAMETER("a rate is at least one second");
    }
    set(timer_number, delay_time, std::chrono::seconds(rate.time_val));
}

void IndexTimers::start_sporadic_scheduler(timer_number_t timer_number, const timeout_t& time) {
    set(timer_number, time, std::chrono::seconds(0));
}

void IndexTimers::cancel_timer(timer_number_t timer_number) {
    timers_->cancel({Timers::Service::index, timer_number});
}

bool IndexTimers::is_canceled(timer_number_t timer_number) {
    return !timers_->waits({Timers::Service::index, timer_number});
}

/// The clock is read first, so that no timer is due before the clock shows its date. A date that has passed is now.
void IndexTimers::set(timer_number_t number, const timeout_t& time, std::chrono::seconds rate) {
    ucm_timeval_t now = {0, 0};
    clock_->get_local_time(now);
    Timer::Clock::time_point due = Timer::Clock::now();
    std::uint32_t date = now.utv_sec;
    if (time.flag == timeout_enum_t::RELATIVE_TIME) {
        due += std::chrono::seconds(time.time_val);
        date += time.time_val;
    } else if (time.time_val > now.utv_sec) {
        due += std::chrono::seconds(time.time_val - now.utv_sec) - std::chrono::microseconds(now.utv_usec);
        date = time.time_val;
    }
    timers_->set({Timers::Service::index, number},
                 std::unique_ptr<Timer>(new Expiring(*this, number, due, date, rate)));
}

}  // namespace lwucm
