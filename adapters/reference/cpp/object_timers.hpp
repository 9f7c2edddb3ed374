// Object timers (10.3.1) of lwucm as those of the SDK, and handlers of the SDK as those of lwucm.
#ifndef REFERENCE_CPP_OBJECT_TIMERS_HPP
#define REFERENCE_CPP_OBJECT_TIMERS_HPP

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include <lwucm/timers.hpp>
#include <ucm_cts/timers.hpp>

namespace reference_cpp {

class WrappedTimer final : public ucm_cts::ObjectTimer {
  public:
    explicit WrappedTimer(std::shared_ptr<lwucm::ott_timer> timer) : timer_(std::move(timer)) {}
    std::int64_t rounds() override { return timer_->rounds(); }
    std::string id() override { return timer_->id(); }
    void cancel() override { timer_->cancel(); }
    bool is_cancelled() override { return timer_->is_cancelled(); }

    static std::shared_ptr<ucm_cts::ObjectTimer> wrap(const std::shared_ptr<lwucm::ott_timer>& timer) {
        return timer ? std::make_shared<WrappedTimer>(timer) : nullptr;
    }

  private:
    const std::shared_ptr<lwucm::ott_timer> timer_;
};

class WrappedHandler final : public lwucm::ott_handler {
  public:
    explicit WrappedHandler(std::shared_ptr<ucm_cts::TimerHandler> handler) : handler_(std::move(handler)) {}
    void on_trigger(const std::shared_ptr<lwucm::ott_timer>& timer, const lwucm::ucm_timeval_t& delta_time,
                    lwucm::ott_round_t round) override {
        handler_->on_trigger(WrappedTimer::wrap(timer), {delta_time.utv_sec, delta_time.utv_usec}, round);
    }

  private:
    const std::shared_ptr<ucm_cts::TimerHandler> handler_;
};

class WrappedScheduler final : public ucm_cts::TimerScheduler {
    typedef std::shared_ptr<ucm_cts::TimerHandler> Handler;

  public:
    explicit WrappedScheduler(std::shared_ptr<lwucm::ott_scheduler> scheduler) : scheduler_(std::move(scheduler)) {}

    std::shared_ptr<ucm_cts::ObjectTimer> scheduler_trigger(const Handler& handler,
                                                            const ucm_cts::TimeValue& delay) override {
        return WrappedTimer::wrap(
            scheduler_->scheduler_trigger(std::make_shared<WrappedHandler>(handler), to_timeval(delay)));
    }

    std::shared_ptr<ucm_cts::ObjectTimer> schedule_repeated_trigger(const Handler& handler,
                                                                    const ucm_cts::TimeValue& start_delay,
                                                                    const ucm_cts::TimeValue& interval,
                                                                    std::int64_t max_rounds) override {
        return WrappedTimer::wrap(scheduler_->schedule_repeated_trigger(
            std::make_shared<WrappedHandler>(handler), to_timeval(start_delay), to_timeval(interval),
            narrowed<lwucm::ott_round_t>(max_rounds)));
    }

  private:
    template <class Integer>
    static Integer narrowed(std::int64_t number) {
        if (number < std::numeric_limits<Integer>::min() || number > std::numeric_limits<Integer>::max()) {
            throw lwucm::BAD_PARAMETER("the number does not fit its type");
        }
        return static_cast<Integer>(number);
    }

    static lwucm::ucm_timeval_t to_timeval(const ucm_cts::TimeValue& time) {
        return {narrowed<std::uint32_t>(time.seconds), narrowed<std::int32_t>(time.microseconds)};
    }

    const std::shared_ptr<lwucm::ott_scheduler> scheduler_;
};

}  // namespace reference_cpp

#endif
