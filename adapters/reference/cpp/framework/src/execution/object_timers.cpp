#include "execution/object_timers.hpp"

#include <utility>

namespace lwucm {

namespace {

const std::int32_t MICROSECONDS = 1000000;

std::chrono::microseconds duration_of(const ucm_timeval_t& time) {
    if (time.utv_usec < 0 || time.utv_usec >= MICROSECONDS) {
        throw BAD_PARAMETER("a time has 0 to 999999 microseconds");
    }
    return std::chrono::seconds(time.utv_sec) + std::chrono::microseconds(time.utv_usec);
}

ucm_timeval_t timeval_of(Timer::Clock::duration time) {
    const auto all = std::chrono::duration_cast<std::chrono::microseconds>(time).count();
    return {static_cast<std::uint32_t>(all / MICROSECONDS), static_cast<std::int32_t>(all % MICROSECONDS)};
}

}  // namespace

/// A timer as its component holds it, perhaps for ever: without the handler, which may be what holds it.
class ObjectTimers::Handle final : public ott_timer {
  public:
    Handle(std::shared_ptr<Timers> timers, std::uint64_t number, std::string id)
        : timers_(std::move(timers)), name_(Timers::Service::object, number), id_(std::move(id)), rounds_(0) {}

    ott_round_t rounds() override { return rounds_; }
    std::string id() override { return id_; }
    void cancel() override { timers_->cancel(name_); }
    bool is_cancelled() override { return !timers_->waits(name_); }

    Timers::Name name() const { return name_; }

    /// Its next round is being done; returns which.
    ott_round_t begin_round() { return ++rounds_; }

  private:
    const std::shared_ptr<Timers> timers_;
    const Timers::Name name_;
    const std::string id_;
    std::atomic<ott_round_t> rounds_;
};

/// The same timer as long as it waits.
class ObjectTimers::Expiring final : public Timer {
  public:
    Expiring(std::shared_ptr<Handle> handle, std::shared_ptr<ott_handler> handler, Clock::time_point asked,
             std::chrono::microseconds delay, std::chrono::microseconds interval, ott_round_t rounds)
        : Timer(asked + delay, interval),
          handle_(std::move(handle)),
          handler_(std::move(handler)),
          asked_(asked),
          left_(rounds) {}

    std::function<void()> expire(Clock::time_point now) override {
        --left_;
        const std::shared_ptr<Handle> handle = handle_;
        const std::shared_ptr<ott_handler> handler = handler_;
        const ucm_timeval_t delta_time = timeval_of(now - asked_);
        return [handle, handler, delta_time] { handler->on_trigger(handle, delta_time, handle->begin_round()); };
    }

    bool is_over() const override { return left_ == 0; }

  private:
    const std::shared_ptr<Handle> handle_;
    const std::shared_ptr<ott_handler> handler_;
    const Clock::time_point asked_;
    ott_round_t left_;
};

ObjectTimers::ObjectTimers(std::shared_ptr<Timers> timers, componentId component)
    : timers_(std::move(timers)), component_(component), last_number_(0) {}

std::shared_ptr<ott_timer> ObjectTimers::scheduler_trigger(const std::shared_ptr<ott_handler>& trigger_handler,
                                                           const ucm_timeval_t& trigger_delay) {
    return make(trigger_handler, trigger_delay, std::chrono::microseconds(0), 1);
}

std::shared_ptr<ott_timer> ObjectTimers::schedule_repeated_trigger(const std::shared_ptr<ott_handler>& trigger_handler,
                                                                   const ucm_timeval_t& start_delay,
                                                                   const ucm_timeval_t& interval,
                                                                   ott_round_t max_rounds) {
    const std::chrono::microseconds rate = duration_of(interval);
    if (rate.count() == 0) {
        throw BAD_PARAMETER("an interval is at least one microsecond");
    }
    return make(trigger_handler, start_delay, rate, max_rounds);
}

std::shared_ptr<ott_timer> ObjectTimers::make(const std::shared_ptr<ott_handler>& handler, const ucm_timeval_t& delay,
                                              std::chrono::microseconds interval, ott_round_t rounds) {
    const Timer::Clock::time_point asked = Timer::Clock::now();
    const std::chrono::microseconds first = duration_of(delay);
    if (!handler) {
        throw BAD_PARAMETER("there is no handler");
    }
    const std::uint64_t number = ++last_number_;
    const auto handle = std::make_shared<Handle>(timers_, number,
                                                 std::to_string(component_) + "." + std::to_string(number));
    const bool accepted =
        rounds == 0 ? timers_->are_set()
                    : timers_->set(handle->name(), std::unique_ptr<Timer>(new Expiring(handle, handler, asked, first,
                                                                                       interval, rounds)));
    if (!accepted) {
        throw UCM_ERROR("the component is not operational");
    }
    return handle;
}

}  // namespace lwucm
