// Index timers (10.3.2) as an application uses them: by their interfaces, by any thread, and while the container is stopped.
#ifndef UCM_CTS_TESTS_LWUCM_TIMERS_HPP
#define UCM_CTS_TESTS_LWUCM_TIMERS_HPP

#include "lwucm_application.hpp"

#include <chrono>
#include <future>
#include <thread>

namespace {

const timeout_t AT_ONCE = {0, timeout_enum_t::RELATIVE_TIME};
const timeout_t LATER = {3600, timeout_enum_t::RELATIVE_TIME};
const timeout_t A_SECOND = {1, timeout_enum_t::RELATIVE_TIME};

typedef std::function<void(const timeout_t&, timer_number_t)> OnTimeout;

class TimerCallback final : public itt_callback_intf {
  public:
    explicit TimerCallback(OnTimeout code) : code_(std::move(code)) {}
    void on_timeout(const timeout_t& time, timer_number_t timer_number) override { code_(time, timer_number); }

  private:
    const OnTimeout code_;
};

/// A port element that has no interface which can be called by name.
class Opaque final : public PortElementObject {};

/// A runtime with one component that has timers of both kinds, and does at its callback what the test wants.
struct Alarms {
    explicit Alarms(const std::string& execution = "", const std::string& options = "") {
        std::vector<Policy> applied = {{"itt_timer", "", {}, "timers", {}}, {"ott_timer", "", {}, "scheduler", {}}};
        if (!execution.empty()) {
            applied.push_back({execution, execution == "protected_active_component" ? "account" : "", {}, "", {}});
        }
        const auto get_port = [this](ComponentObject&, const std::string& policy, const std::string& element) {
            CHECK(policy == "itt_timer" && element == "timer_callback");
            return callback;
        };
        Repository repository;
        repository.add({"Alarm", {"account"}, {}, {}, [this] { return body; }, nullptr,
                        Policies(applied, nullptr, nullptr, get_port), {{"account", ACCOUNT}}});
        runtime = create_runtime(repository, parse_options(options));
    }
    ~Alarms() { runtime->destroy(); }

    componentId add() { return runtime->add_component({{"implementation", "Alarm"}}); }
    itt_service_intf& timers() { return dynamic_cast<itt_service_intf&>(*body->references.at("timers")); }

    OnTimeout on_timeout = [](const timeout_t&, timer_number_t) {};
    const std::shared_ptr<Body> body = std::make_shared<Body>();
    std::shared_ptr<PortElementObject> callback = std::make_shared<TimerCallback>(
        [this](const timeout_t& time, timer_number_t number) { on_timeout(time, number); });
    std::shared_ptr<Runtime> runtime;
};

void timers_are_set_and_cancelled_by_number() {
    Alarms alarms;
    Gate gate;
    gate.open();
    std::vector<timer_number_t> numbers;
    alarms.on_timeout = [&](const timeout_t& time, timer_number_t number) {
        CHECK(time.flag == timeout_enum_t::ABSOLUTE_TIME && time.time_val > 0);
        numbers.push_back(number);
        gate.pass();
    };
    alarms.add();
    alarms.runtime->start();
    itt_service_intf& timers = alarms.timers();
    CHECK(timers.is_canceled(1));
    timers.start_sporadic_scheduler(1, LATER);
    timers.start_sporadic_scheduler(1, AT_ONCE);
    CHECK(!timers.is_canceled(1));
    timers.start_sporadic_scheduler(4000000000, AT_ONCE);
    gate.await(1);
    timers.cancel_timer(1);
    CHECK(timers.is_canceled(1));
    timers.start_periodic_scheduler(1, AT_ONCE, LATER);
    gate.await(2);
    CHECK(!timers.is_canceled(1));
    CHECK(raises<BAD_PARAMETER>([&] { timers.start_periodic_scheduler(2, AT_ONCE, AT_ONCE); }));
    CHECK(timers.is_canceled(2));
    CHECK(raises<BAD_PARAMETER>([&] { timers.call("start_sporadic_scheduler", {Value::integer(2)}); }));
    CHECK(raises<BAD_PARAMETER>([&] { timers.call("on_timeout", {}); }));
    alarms.runtime->stop();
    CHECK((numbers == std::vector<timer_number_t>{4000000000, 1}));
}

/// Lets `phase` last for a moment that is longer each time, and every second one until so many calls have come that there are enough in the end.
inline void let_pass(int phase, const std::atomic<int>& calls) {
    std::this_thread::sleep_for(std::chrono::microseconds(100 * phase));
    while (phase % 2 == 1 && calls <= phase + 2) {
        std::this_thread::yield();
    }
}

void none_calls_back_after_stop(const std::string& execution, const std::string& options) {
    Alarms alarms(execution, options);
    std::atomic<bool> operational(false);
    std::atomic<int> inside(0), calls(0);
    std::atomic<itt_service_intf*> service(nullptr);
    alarms.on_timeout = [&](const timeout_t&, timer_number_t number) {
        ++inside;
        ++calls;
        CHECK(operational);
        CHECK(raises<UCM_ERROR>([&] { alarms.runtime->stop(); }));
        if (number < 4) {
            service.load()->start_sporadic_scheduler(number, AT_ONCE);
        }
        --inside;
    };
    const componentId alarm = alarms.add();
    for (int phase = 0; phase < 25; ++phase) {
        operational = true;
        alarms.runtime->start();
        service = &alarms.timers();
        const std::shared_ptr<PortElementObject> kept = alarms.body->references.at("timers");
        auto other = std::async(std::launch::async, [&] {
            for (timer_number_t number = 0; number < 40; ++number) {
                service.load()->start_sporadic_scheduler(number % 8, AT_ONCE);
                service.load()->cancel_timer(number % 5);
            }
        });
        service.load()->start_periodic_scheduler(100, AT_ONCE, A_SECOND);
        let_pass(phase, calls);
        alarms.runtime->stop();
        CHECK(inside == 0);
        operational = false;
        other.get();
        service.load()->start_sporadic_scheduler(7, AT_ONCE);
        CHECK(service.load()->is_canceled(7));
    }
    CHECK(calls > 25);
    alarms.runtime->remove_component(alarm);
}

void stop_waits_for_a_callback_and_nobody_else_does() {
    Alarms alarms;
    Gate gate;
    std::atomic<bool> left(false);
    alarms.on_timeout = [&](const timeout_t&, timer_number_t) {
        gate.pass();
        left = true;
        throw 42;
    };
    alarms.add();
    alarms.runtime->start();
    itt_service_intf& timers = alarms.timers();
    timers.start_sporadic_scheduler(1, AT_ONCE);
    gate.await(1);
    timers.start_sporadic_scheduler(1, LATER);
    timers.cancel_timer(1);
    CHECK(alarms.runtime->get_components().size() == 1);
    auto stop = std::async(std::launch::async, [&] {
        alarms.runtime->stop();
        return left.load();
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(stop.wait_for(std::chrono::seconds(0)) == std::future_status::timeout);
    gate.open();
    CHECK(stop.get());
}

void a_component_without_callback_is_refused() {
    for (const std::shared_ptr<PortElementObject>& wrong :
         {std::shared_ptr<PortElementObject>(), std::shared_ptr<PortElementObject>(std::make_shared<Opaque>())}) {
        Alarms alarms;
        alarms.callback = wrong;
        CHECK(raises<UCM_ERROR>([&] { alarms.add(); }));
    }
    Application nothing_generated("", {{"itt_timer", "", {}, "", {}}});
    CHECK(raises<UCM_ERROR>([&] { nothing_generated.add("Bank"); }));
}

void timers_do_what_they_are_set_to() {
    timers_are_set_and_cancelled_by_number();
    none_calls_back_after_stop("", "");
    for (const char* const execution : {"protected_passive_component", "protected_active_component"}) {
        for (const char* const options : {"", "executor=shared", "executor=component"}) {
            none_calls_back_after_stop(execution, options);
        }
    }
    stop_waits_for_a_callback_and_nobody_else_does();
    a_component_without_callback_is_refused();
}

}  // namespace

#endif
