// Probe: the component body that a scenario has the framework host. Records each entry and does what its plan says.
#ifndef UCM_CTS_PROBE_HPP
#define UCM_CTS_PROBE_HPP

#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/calls.hpp"
#include "ucm_cts/data_types.hpp"
#include "ucm_cts/held.hpp"
#include "ucm_cts/memory.hpp"
#include "ucm_cts/scenario.hpp"
#include "ucm_cts/stage.hpp"
#include "ucm_cts/timers.hpp"

namespace ucm_cts {

/// What a probe leaves a hook with when its plan says `raise`: no interface declares it.
class ProbeFailure : public std::runtime_error {
  public:
    explicit ProbeFailure(Hook hook) : std::runtime_error(std::string("the probe fails in ") + word_of(hook)) {}
};

/// What all faces of one body, itself and its port elements, have in common.
class Probe : public std::enable_shared_from_this<Probe> {
  public:
    Probe(std::shared_ptr<Stage> stage, std::shared_ptr<const Scenario> scenario, const Component& component,
          int instance)
        : stage_(std::move(stage)), scenario_(std::move(scenario)), component_(component), instance_(instance),
          memory_(component.second) {
        for (const Action& action : plan_of(Hook::method)) {
            if (action.kind == Action::Kind::count) {
                messages_ = stage_->messages.of(name(), instance_);
            }
        }
        for (const std::string& handler : declaration().handlers) {
            handlers_.emplace(std::piecewise_construct, std::forward_as_tuple(handler),
                              std::forward_as_tuple(*this, handler));
        }
        record(events::Create(name(), instance_));
    }

    const std::string& name() const { return component_.first; }
    const Declaration& declaration() const { return component_.second; }
    int instance() const { return instance_; }

    /// Has the scenario ended? Then the probe is silent and has no plan.
    bool over() const { return stage_->recorder.closed(); }

    /// The probe is entered at `hook`.
    events::Enter entry(Hook hook) const { return events::Enter(name(), instance_, hook); }

    /// Records `entry`, performs the plan of `hook`, records the exit.
    void visit(Hook hook, const events::Enter& entry) {
        if (over()) {
            return;
        }
        record(entry);
        perform(hook);
        record(exit(hook));
    }

    void visit(Hook hook) { visit(hook, entry(hook)); }

    void run() {
        if (!is_stressed()) {
            visit(Hook::run);
        }
    }

    std::int32_t exchange(const std::string& port, std::int32_t value) {
        std::int32_t result = ~value;
        if (is_stressed() || over()) {
            return result;
        }
        record(entry(Hook::exchange).port(port).value(value));
        perform(Hook::exchange, Entry(value), &result);
        record(exit(Hook::exchange).value(result));
        return result;
    }

    /// Any method of provided port element `port`, which has an interface.
    Data call(const std::string& port, const std::string& method, const Data& arguments) {
        if (over()) {
            return Data();
        }
        const bool sound = are_data(arguments);
        if (sound && messages_ && is_message(arguments)) {
            messages_->add(arguments[0].get<std::uint32_t>());
            return Data{"ok"};
        }
        const Data given = sound ? arguments : Data();
        events::Enter entered = entry(Hook::method).port(port).method(method).arguments(given);
        if (!sound || messages_) {
            entered.wrong(in_words(arguments));
        }
        const Entry now(method, given);
        memory_.enter(now, [this, &entered] { record(entered); });
        perform(Hook::method, now);
        return answer(method, given);
    }

    /// The method of its `handler`.
    void on_trigger(const std::string& handler, const std::shared_ptr<ObjectTimer>& timer, const TimeValue& delta_time,
                    std::int64_t round) {
        if (over()) {
            return;
        }
        Entry now(ON_TRIGGER, Data());
        events::Enter entered = entry(Hook::method).port(handler).method(ON_TRIGGER);
        if (timer) {
            now.arguments = {Datum::array({delta_time.seconds, delta_time.microseconds}), round};
            entered.arguments(now.arguments);
            now.timer = memory_.take({ON_TRIGGER, timer},
                                     [this, &entered](std::int64_t number) { record(entered.timer(number)); });
        } else {
            record(entered.arguments(Data()).wrong("null as the timer"));
        }
        perform(Hook::method, now);
        record(exit(Hook::method).results(Data()));
    }

    void keep(const std::vector<PortConnection>& connections) { held_.keep(connections); }
    void keep(const std::shared_ptr<ContainerInterface>& container) { held_.keep(container); }

    /// Lets go of everything the framework has given, so that no cycle of references survives a scenario.
    void forget() {
        memory_.forget();
        held_.forget();
    }

  private:
    // One of its handlers. The probe owns it, and who holds it holds the probe.
    class Handler final : public TimerHandler {
      public:
        Handler(Probe& probe, const std::string& name) : probe_(probe), name_(name) {}
        void on_trigger(const std::shared_ptr<ObjectTimer>& timer, const TimeValue& delta_time,
                        std::int64_t round) override {
            probe_.on_trigger(name_, timer, delta_time, round);
        }

      private:
        Probe& probe_;
        const std::string name_;
    };

    // Null if there is none.
    std::shared_ptr<TimerHandler> handler(const std::string& name) {
        const auto found = handlers_.find(name);
        return found != handlers_.end() ? std::shared_ptr<TimerHandler>(shared_from_this(), &found->second) : nullptr;
    }

    const std::vector<Action>& plan_of(Hook hook) const {
        static const std::vector<Action> nothing;
        const auto found = declaration().plan.find(hook);
        return found == declaration().plan.end() ? nothing : found->second;
    }

    // Under stress: counts overlaps; true, as the probe does nothing else then.
    bool is_stressed() {
        const Pace pace = stage_->stress.load(std::memory_order_relaxed);
        if (pace == Pace::none) {
            return false;
        }
        occupancy_.visit(pace, stage_->overlaps);
        return true;
    }

    // What came in place of values, for people.
    static std::string in_words(const Data& data) {
        std::string text;
        json::append(text, data);
        return json::shortened(text, 200);
    }

    // Can it be one of the messages that are counted?
    static bool is_message(const Data& arguments) {
        return !arguments.empty() && arguments[0].is_number_integer() && arguments[0] >= 0 &&
               arguments[0] <= UINT32_MAX;
    }

    // Leaves `method` as the plan says.
    Data answer(const std::string& method, const Data& arguments) {
        const Action* planned = nullptr;
        for (const Action& action : plan_of(Hook::method)) {
            if (action.kind == Action::Kind::answer && action.method == method) {
                planned = &action;
            }
        }
        const Data results = planned == nullptr ? Data() : !planned->has_results ? arguments : planned->results;
        const bool is_exception = planned != nullptr && planned->has_exception;
        events::Exit left = exit(Hook::method);
        left.results(results);
        if (is_exception) {
            left.exception(planned->exception);
        }
        record(left);
        if (is_exception) {
            throw DeclaredException(planned->exception, results);
        }
        return results;
    }

    void record(const Event& event) { stage_->recorder.record(event); }

    events::Exit exit(Hook hook) const { return events::Exit(name(), instance_, hook); }
    events::Request request(const std::string& port) const { return events::Request(name(), instance_, port); }
    events::Reply reply(const std::string& port) const { return events::Reply(name(), instance_, port); }

    // `now` is the entry in which the plan is performed, `result` what `exchange` is to return.
    void perform(Hook hook, const Entry& now = Entry(), std::int32_t* result = nullptr) {
        for (const Action& action : plan_of(hook)) {
            switch (action.kind) {
                case Action::Kind::raise:
                    record(exit(hook).raised(true));
                    throw ProbeFailure(hook);
                case Action::Kind::return_value:
                    if (result != nullptr) {
                        *result = action.value;
                    }
                    break;
                case Action::Kind::call:
                    call(action.port, action.value);
                    break;
                case Action::Kind::hold:
                    hold(action.gate);
                    break;
                case Action::Kind::siblings:
                    query_siblings();
                    break;
                case Action::Kind::call_method:
                    call_method(action, now);
                    break;
                case Action::Kind::burst:
                    for (const Reference& reference : held_.references(action.port)) {
                        push(action, *reference);
                    }
                    break;
                case Action::Kind::answer:
                case Action::Kind::count:
                    break;
            }
        }
    }

    void call(const std::string& port, std::int32_t value) {
        for (const Reference& reference : held_.references(port)) {
            record(request(port).value(value));
            try {
                record(reply(port).value(reference->exchange(value)));
            } catch (...) {
                record(reply(port).raised(true));
            }
        }
    }

    void call_method(const Action& action, const Entry& now) {
        Data given;
        if (!memory_.arguments(action, now, given) || (action.has_from_clock && !date(action.from_clock, given))) {
            return;
        }
        if (action.has_on) {
            std::shared_ptr<ObjectTimer> timer;
            if (const std::int64_t number = memory_.find(action.on, now, timer)) {
                call_method(action, given, call_timer(timer, action.method), number);
            }
            return;
        }
        for (const Reference& reference : held_.references(action.port)) {
            call_method(action, given, action.has_handler ? schedule(reference, action.method, handler(action.handler))
                                                          : call_port(reference, action.method));
        }
    }

    // Has the time-out among `arguments` count from what the body's clock shows; false if there is none, or it gives no time.
    bool date(const FromClock& of, Data& arguments) {
        const std::vector<Reference> clocks = held_.references(of.port);
        Action reading;
        reading.kind = Action::Kind::call_method;
        reading.port = of.port;
        reading.method = of.method;
        return !clocks.empty() &&
               date_from(call_method(reading, Data(), call_port(clocks[0], of.method)), of.argument, arguments);
    }

    // Returns the results as recorded, nothing if it raised. `timer` is the number of the object timer that is called.
    Data call_method(const Action& action, const Data& given, const Calling& call, std::int64_t timer = 0) {
        const std::shared_ptr<Data> arguments = held_.buffer(given);
        events::Request asked = request(action.port).method(action.method).arguments(given);
        if (action.has_handler) {
            asked.handler(action.handler);
        }
        record(timer != 0 ? asked.timer(timer) : asked);
        events::Reply replied = reply(action.port);
        CallResult back;
        try {
            back = call(*arguments);
            put(replied, back.results);
            if (!back.wrong.empty()) {
                replied.wrong(back.wrong);
            }
        } catch (const DeclaredException& error) {
            put(replied, error.fields);
            replied.exception(error.name);
        } catch (...) {
            replied.raised(true);
        }
        if (back.timer) {
            memory_.take({action.method, back.timer},
                         [this, &replied](std::int64_t number) { record(replied.timer(number)); });
        } else {
            record(replied);
        }
        overwrite(*arguments);
        return are_data(back.results) ? back.results : Data();
    }

    // `results` if they are values; if not, none, and what they are.
    static void put(events::Reply& replied, const Data& results) {
        if (are_data(results)) {
            replied.results(results);
        } else {
            replied.results(Data()).wrong(in_words(results));
        }
    }

    // One buffer for all messages: an emitter overwrites a message with the next one.
    void push(const Action& action, PortElement& callee) {
        const std::shared_ptr<Data> buffered = held_.buffer(Data(1));
        Data& message = *buffered;
        std::map<std::string, std::int64_t> answers;
        for (std::int64_t n = 0; n < action.count; ++n) {
            message[0] = action.first + n;
            std::string code;
            try {
                const Data results = callee.call(PUSH, message);
                code = results.empty() ? "" : results[0].is_string() ? results[0].get<std::string>()
                                                                     : json::json_of(results[0]);
            } catch (...) {
                code = "raised";
            }
            ++answers[code];
        }
        overwrite(message);
        record(events::Pushed(name(), instance_, action.port, action.first, action.count, answers));
    }

    void hold(const std::string& gate) {
        stage_->gates.hold(gate, [this, &gate] { record(events::Held(name(), instance_, gate)); });
    }

    void query_siblings() {
        const std::shared_ptr<ContainerInterface> container = held_.container();
        try {
            if (!container) {
                throw std::logic_error("no container interface was given");
            }
            const std::vector<Id> ids = container->get_components();
            events::Siblings siblings(name(), instance_);
            record(ids.size() > MOST ? siblings.wrong(too_many("ids")) : siblings.ids(ids));
        } catch (...) {
            record(events::Siblings(name(), instance_).raised(true));
        }
    }

    const std::shared_ptr<Stage> stage_;
    const std::shared_ptr<const Scenario> scenario_;  // keeps component_ alive
    const Component& component_;
    const int instance_;
    Occupancy occupancy_;
    Memory memory_;
    std::shared_ptr<MessageCount> messages_;  // if the plan says so
    Held held_;
    std::map<std::string, Handler> handlers_;
};

}  // namespace ucm_cts

#endif
