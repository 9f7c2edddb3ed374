// Object timers (10.3.1) as an application uses them: who holds what, for how long, and by which threads.
#ifndef UCM_CTS_TESTS_LWUCM_OBJECT_TIMERS_HPP
#define UCM_CTS_TESTS_LWUCM_OBJECT_TIMERS_HPP

#include "lwucm_timers.hpp"

namespace {

const ucm_timeval_t NO_TIME = {0, 0};
const ucm_timeval_t AN_HOUR = {3600, 0};
const ucm_timeval_t A_MILLISECOND = {0, 1000};

typedef std::function<void(const std::shared_ptr<ott_timer>&, ott_round_t)> OnTrigger;

class Handler final : public ott_handler {
  public:
    explicit Handler(OnTrigger code) : code_(std::move(code)) {}
    void on_trigger(const std::shared_ptr<ott_timer>& timer, const ucm_timeval_t&, ott_round_t round) override {
        code_(timer, round);
    }

  private:
    const OnTrigger code_;
};

ott_scheduler& scheduler_of(Alarms& alarms) {
    return dynamic_cast<ott_scheduler&>(*alarms.body->references.at("scheduler"));
}

void handlers_are_let_go_and_timers_stay() {
    std::vector<std::shared_ptr<ott_timer>> timers;
    {
        Alarms alarms;
        Gate gate;
        gate.open();
        alarms.add();
        alarms.runtime->start();
        ott_scheduler& scheduler = scheduler_of(alarms);
        std::vector<std::weak_ptr<ott_handler>> handlers;
        // it calls a service when it ends, as code of the component may
        const auto handler = [&] {
            const std::shared_ptr<int> ends(new int(0), [&alarms](const int* nothing) {
                delete nothing;
                alarms.timers().cancel_timer(1);
            });
            const auto made = std::make_shared<Handler>([ends, &gate](const std::shared_ptr<ott_timer>& timer, ott_round_t) {
                CHECK(timer->is_cancelled());
                gate.pass();
            });
            handlers.push_back(made);
            return made;
        };
        CHECK(raises<BAD_PARAMETER>([&] { scheduler.scheduler_trigger(nullptr, NO_TIME); }));
        timers.push_back(scheduler.scheduler_trigger(handler(), NO_TIME));
        gate.await(1);
        timers.push_back(scheduler.scheduler_trigger(handler(), AN_HOUR));
        CHECK(!handlers[1].expired() && !timers[1]->is_cancelled());
        timers[1]->cancel();
        timers[1]->cancel();
        CHECK(handlers[1].expired() && timers[1]->is_cancelled());
        timers.push_back(scheduler.schedule_repeated_trigger(handler(), AN_HOUR, AN_HOUR, 4000000000));
        timers.push_back(scheduler.schedule_repeated_trigger(handler(), NO_TIME, AN_HOUR, 0));
        CHECK(handlers[3].expired() && timers[3]->is_cancelled());
        alarms.runtime->stop();
        CHECK(handlers[0].expired() && handlers[2].expired());
    }
    for (const auto& timer : timers) {
        timer->cancel();
        CHECK(timer->is_cancelled() && !timer->id().empty());
        CHECK(timer->rounds() == (timer == timers[0] ? 1 : 0));
    }
}

void none_triggers_after_stop(const std::string& execution, const std::string& options) {
    Alarms alarms(execution, options);
    std::atomic<bool> operational(false);
    std::atomic<int> calls(0);
    std::atomic<ott_scheduler*> scheduler(nullptr);
    std::shared_ptr<ott_handler> handler;
    handler = std::make_shared<Handler>([&](const std::shared_ptr<ott_timer>& timer, ott_round_t round) {
        ++calls;
        CHECK(operational && timer->rounds() == round);
        CHECK(raises<UCM_ERROR>([&] { alarms.runtime->stop(); }));
        if (calls % 2 == 0) {
            timer->cancel();
        }
    });
    const componentId alarm = alarms.add();
    for (int phase = 0; phase < 25; ++phase) {
        operational = true;
        alarms.runtime->start();
        const std::shared_ptr<PortElementObject> kept = alarms.body->references.at("scheduler");
        scheduler = &scheduler_of(alarms);
        alarms.timers().start_periodic_scheduler(1, AT_ONCE, A_SECOND);
        scheduler.load()->schedule_repeated_trigger(handler, NO_TIME, A_MILLISECOND, 100);
        auto other = std::async(std::launch::async, [&] {
            for (int number = 0; number < 40; ++number) {
                try {
                    const auto timer = scheduler.load()->schedule_repeated_trigger(handler, NO_TIME, A_MILLISECOND, 3);
                    if (number % 3 == 0) {
                        timer->cancel();
                        CHECK(timer->is_cancelled());
                    }
                } catch (const UCM_ERROR&) {  // the container has been stopped
                }
            }
        });
        let_pass(phase, calls);
        alarms.runtime->stop();
        operational = false;
        other.get();
        CHECK(raises<UCM_ERROR>([&] { scheduler.load()->scheduler_trigger(handler, NO_TIME); }));
        CHECK(raises<UCM_ERROR>([&] {
            scheduler.load()->schedule_repeated_trigger(handler, NO_TIME, A_MILLISECOND, 0);
        }));
    }
    CHECK(calls > 25);
    alarms.runtime->remove_component(alarm);
}

void object_timers_do_what_they_are_made_for() {
    handlers_are_let_go_and_timers_stay();
    none_triggers_after_stop("", "");
    for (const char* const execution : {"protected_passive_component", "protected_active_component"}) {
        for (const char* const options : {"", "executor=shared", "executor=component"}) {
            none_triggers_after_stop(execution, options);
        }
    }
}

}  // namespace

#endif
