// Object timers (10.3.1) for typed bodies: lwucm's scheduler in the interfaces that are generated from a model.
#ifndef LWUCM_TYPED_TIMERS_HPP
#define LWUCM_TYPED_TIMERS_HPP

#include <memory>
#include <string>
#include <utility>

#include "lwucm/timers.hpp"

namespace lwucm {

/// A `Scheduler` whose timers are those of lwucm's. `Timer`, `Handler` and `Time` are what its signatures name. A timer that comes
/// again is another object; its `id` is the same.
template <class Scheduler, class Timer, class Handler, class Time>
class TypedScheduler final : public Scheduler {
    class Triggered final : public Timer {
      public:
        explicit Triggered(std::shared_ptr<ott_timer> timer) : timer_(std::move(timer)) {}
        std::string id() override { return timer_->id(); }
        ott_round_t rounds() override { return timer_->rounds(); }
        bool is_cancelled() override { return timer_->is_cancelled(); }
        void cancel() override { timer_->cancel(); }

        static std::shared_ptr<Timer> of(std::shared_ptr<ott_timer> timer) {
            return timer ? std::make_shared<Triggered>(std::move(timer)) : nullptr;
        }

      private:
        const std::shared_ptr<ott_timer> timer_;
    };

    class Handling final : public ott_handler {
      public:
        explicit Handling(std::shared_ptr<Handler> handler) : handler_(std::move(handler)) {}

        void on_trigger(const std::shared_ptr<ott_timer>& timer, const ucm_timeval_t& delta_time,
                        ott_round_t round) override {
            handler_->on_trigger(Triggered::of(timer), Time(delta_time.utv_sec, delta_time.utv_usec), round);
        }

        static std::shared_ptr<ott_handler> of(std::shared_ptr<Handler> handler) {
            return handler ? std::make_shared<Handling>(std::move(handler)) : nullptr;
        }

      private:
        const std::shared_ptr<Handler> handler_;
    };

  public:
    explicit TypedScheduler(std::shared_ptr<ott_scheduler> scheduler) : scheduler_(std::move(scheduler)) {}

    std::shared_ptr<Timer> scheduler_trigger(std::shared_ptr<Handler> trigger_handler,
                                             const Time& trigger_delay) override {
        return Triggered::of(scheduler_->scheduler_trigger(Handling::of(trigger_handler), plain(trigger_delay)));
    }

    std::shared_ptr<Timer> schedule_repeated_trigger(std::shared_ptr<Handler> trigger_handler, const Time& start_delay,
                                                     const Time& interval, ott_round_t max_rounds) override {
        return Triggered::of(scheduler_->schedule_repeated_trigger(Handling::of(trigger_handler), plain(start_delay),
                                                                   plain(interval), max_rounds));
    }

    /// What a component is given for lwucm's scheduler; null for anything else.
    static std::shared_ptr<Scheduler> to(const std::shared_ptr<PortElementObject>& element) {
        const auto scheduler = std::dynamic_pointer_cast<ott_scheduler>(element);
        return scheduler ? std::make_shared<TypedScheduler>(scheduler) : nullptr;
    }

  private:
    static ucm_timeval_t plain(const Time& time) { return {time.utv_sec(), time.utv_usec()}; }

    const std::shared_ptr<ott_scheduler> scheduler_;
};

}  // namespace lwucm

#endif
