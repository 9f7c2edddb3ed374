// Object timers (10.3.1) of lwucm as those of the SDK, and handlers of the SDK as those of lwucm: in lwucm's own interfaces, or in those
// that are generated from its models.
#ifndef REFERENCE_CPP_OBJECT_TIMERS_HPP
#define REFERENCE_CPP_OBJECT_TIMERS_HPP

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include <lwucm/timers.hpp>
#include <ucm_cts/shaped_body.hpp>

namespace reference_cpp {

/// lwucm's own interfaces, which have the names of the text.
struct LwucmTimers {
    typedef lwucm::ott_scheduler Scheduler;
    typedef lwucm::ott_timer Timer;
    typedef lwucm::ott_handler Handler;
    typedef lwucm::ucm_timeval_t Time;
    static ucm_cts::TimeValue value(const Time& time) { return {time.utv_sec, time.utv_usec}; }
};

template <class Interfaces>
class WrappedTimer final : public ucm_cts::ObjectTimer {
    typedef std::shared_ptr<typename Interfaces::Timer> Pointer;

  public:
    explicit WrappedTimer(Pointer timer) : timer_(std::move(timer)) {}
    std::int64_t rounds() override { return timer_->rounds(); }
    std::string id() override { return timer_->id(); }
    void cancel() override { timer_->cancel(); }
    bool is_cancelled() override { return timer_->is_cancelled(); }

    static std::shared_ptr<ucm_cts::ObjectTimer> wrap(const Pointer& timer) {
        return timer ? std::make_shared<WrappedTimer>(timer) : nullptr;
    }

  private:
    const Pointer timer_;
};

template <class Interfaces>
class WrappedHandler final : public Interfaces::Handler {
    typedef decltype(&Interfaces::Handler::on_trigger) Trigger;

  public:
    explicit WrappedHandler(std::shared_ptr<ucm_cts::TimerHandler> handler) : handler_(std::move(handler)) {}
    void on_trigger(ucm_cts::detail::Argument<Trigger, 0> timer, const typename Interfaces::Time& delta_time,
                    lwucm::ott_round_t round) override {
        handler_->on_trigger(WrappedTimer<Interfaces>::wrap(timer), Interfaces::value(delta_time), round);
    }

  private:
    const std::shared_ptr<ucm_cts::TimerHandler> handler_;
};

template <class Interfaces>
class WrappedScheduler final : public ucm_cts::TimerScheduler {
    typedef std::shared_ptr<ucm_cts::TimerHandler> Handler;
    typedef typename Interfaces::Time Time;

  public:
    explicit WrappedScheduler(std::shared_ptr<typename Interfaces::Scheduler> scheduler) : scheduler_(std::move(scheduler)) {}

    std::shared_ptr<ucm_cts::ObjectTimer> scheduler_trigger(const Handler& handler,
                                                            const ucm_cts::TimeValue& delay) override {
        return WrappedTimer<Interfaces>::wrap(
            scheduler_->scheduler_trigger(std::make_shared<WrappedHandler<Interfaces>>(handler), to_timeval(delay)));
    }

    std::shared_ptr<ucm_cts::ObjectTimer> schedule_repeated_trigger(const Handler& handler,
                                                                    const ucm_cts::TimeValue& start_delay,
                                                                    const ucm_cts::TimeValue& interval,
                                                                    std::int64_t max_rounds) override {
        return WrappedTimer<Interfaces>::wrap(scheduler_->schedule_repeated_trigger(
            std::make_shared<WrappedHandler<Interfaces>>(handler), to_timeval(start_delay), to_timeval(interval),
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

    static Time to_timeval(const ucm_cts::TimeValue& time) {
        return Time{narrowed<std::uint32_t>(time.seconds), narrowed<std::int32_t>(time.microseconds)};
    }

    const std::shared_ptr<typename Interfaces::Scheduler> scheduler_;
};

}  // namespace reference_cpp

#endif
