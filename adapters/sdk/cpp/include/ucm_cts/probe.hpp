// Probe: the component body that a scenario has the framework host. Records each entry and does what its plan says.
#ifndef UCM_CTS_PROBE_HPP
#define UCM_CTS_PROBE_HPP

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/data_types.hpp"
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
class Probe {
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

    void keep(const std::vector<PortConnection>& connections) {
        std::lock_guard<std::mutex> lock(mutex_);
        connections_ = connections;
    }

    void keep(const std::shared_ptr<ContainerInterface>& container) {
        std::lock_guard<std::mutex> lock(mutex_);
        container_ = container;
    }

    /// Lets go of everything the framework has given, so that no cycle of references survives a scenario.
    void forget() {
        std::vector<PortConnection> connections;
        std::shared_ptr<ContainerInterface> container;
        std::lock_guard<std::mutex> lock(mutex_);
        connections.swap(connections_);
        container.swap(container_);
        sent_.clear();
    }

  private:
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
                    for (const Reference& reference : references(action.port)) {
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
        for (const Reference& reference : references(port)) {
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
        if (memory_.arguments(action, now, given) && (!action.has_from_clock || date(action.from_clock, given))) {
            for (const Reference& reference : references(action.port)) {
                call_method(action.port, action.method, given, *reference);
            }
        }
    }

    // Has the time-out among `arguments` count from what the body's clock shows; false if there is none, or it gives no time.
    bool date(const FromClock& of, Data& arguments) {
        const std::vector<Reference> clocks = references(of.port);
        return !clocks.empty() &&
               date_from(call_method(of.port, of.method, Data(), *clocks[0]), of.argument, arguments);
    }

    // Returns the results as recorded, nothing if it raised.
    Data call_method(const std::string& port, const std::string& method, const Data& given, PortElement& callee) {
        const std::shared_ptr<Data> arguments = buffer(given);
        record(request(port).method(method).arguments(given));
        events::Reply replied = reply(port);
        Data results;
        try {
            results = callee.call(method, *arguments);
            put(replied, results);
        } catch (const DeclaredException& error) {
            put(replied, error.fields);
            replied.exception(error.name);
        } catch (...) {
            replied.raised(true);
        }
        record(replied);
        overwrite(*arguments);
        if (!are_data(results)) {
            results.clear();
        }
        return results;
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
        const std::shared_ptr<Data> buffered = buffer(Data(1));
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

    // What a caller sends is its own, which it overwrites when the call is over. It stays where it is, so that a framework
    // that reads it later reads wrong values and does not crash.
    std::shared_ptr<Data> buffer(const Data& content) {
        const std::shared_ptr<Data> own = std::make_shared<Data>(content);
        std::lock_guard<std::mutex> lock(mutex_);
        sent_.push_back(own);
        return own;
    }

    std::vector<Reference> references(const std::string& port) {
        std::vector<Reference> found;
        std::lock_guard<std::mutex> lock(mutex_);
        for (const PortConnection& connection : connections_) {
            if (connection.from_port == port) {
                std::copy_if(connection.to_port.begin(), connection.to_port.end(), std::back_inserter(found),
                             [](const Reference& reference) { return reference != nullptr; });
            }
        }
        return found;
    }

    void hold(const std::string& gate) {
        stage_->gates.hold(gate, [this, &gate] { record(events::Held(name(), instance_, gate)); });
    }

    void query_siblings() {
        std::shared_ptr<ContainerInterface> container;
        {
            std::lock_guard<std::mutex> lock(mutex_);
            container = container_;
        }
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
    std::mutex mutex_;
    std::vector<PortConnection> connections_;
    std::shared_ptr<ContainerInterface> container_;
    std::vector<std::shared_ptr<Data>> sent_;
};

}  // namespace ucm_cts

#endif
