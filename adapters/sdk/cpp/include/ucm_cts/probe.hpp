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
#include "ucm_cts/data.hpp"
#include "ucm_cts/scenario.hpp"
#include "ucm_cts/stage.hpp"

namespace ucm_cts {

/// What a probe leaves a hook with when its plan says `raise`: no interface declares it.
class ProbeFailure : public std::runtime_error {
  public:
    explicit ProbeFailure(Hook hook) : std::runtime_error(std::string("the probe fails in ") + name_of(hook)) {}
};

/// What all faces of one body, itself and its port elements, have in common.
class Probe {
  public:
    Probe(std::shared_ptr<Stage> stage, std::shared_ptr<const Scenario> scenario, const Declaration& declaration,
          int instance)
        : stage_(std::move(stage)), scenario_(std::move(scenario)), declaration_(declaration), instance_(instance) {
        json::append_name(whose_, "component");
        json::append_text(whose_, declaration_.name);
        json::append_name(whose_, "instance");
        json::append_integer(whose_, instance_);
        for (const Action& action : plan_of(Hook::method)) {
            if (action.kind == Action::Kind::count) {
                messages_ = stage_->messages.of(declaration_.name, instance_);
            }
        }
        stage_->recorder.record("create", [this](std::string& out) { out += whose_; });
    }

    const Declaration& declaration() const { return declaration_; }
    int instance() const { return instance_; }

    /// Has the scenario ended? Then the probe is silent and has no plan.
    bool over() const { return stage_->recorder.closed(); }

    /// Records the entry with the arguments that `append_arguments(text)` appends, performs the plan, records the exit.
    template <class AppendArguments>
    void visit(Hook hook, AppendArguments append_arguments) {
        if (over()) {
            return;
        }
        enter(hook, append_arguments);
        perform(hook, nullptr);
        leave(hook, [](std::string&) {});
    }

    void run() {
        if (!is_stressed()) {
            visit(Hook::run, [](std::string&) {});
        }
    }

    std::int32_t exchange(const std::string& port, std::int32_t value) {
        std::int32_t result = ~value;
        if (is_stressed() || over()) {
            return result;
        }
        enter(Hook::exchange, [&port, value](std::string& out) {
            json::append_name(out, "port");
            json::append_text(out, port);
            json::append_name(out, "value");
            json::append_integer(out, value);
        });
        perform(Hook::exchange, &result);
        leave(Hook::exchange, [result](std::string& out) {
            json::append_name(out, "value");
            json::append_integer(out, result);
        });
        return result;
    }

    /// Any method of provided port element `port`, which has an interface.
    Data call(const std::string& port, const std::string& method, const Data& arguments) {
        if (over()) {
            return Data();
        }
        if (!are_data(arguments)) {
            complain(method + " was called with what are no values: ", arguments);
            return Data();
        }
        if (messages_) {
            count(method, arguments);
            return Data{"ok"};
        }
        enter(Hook::method, [&port, &method, &arguments](std::string& out) {
            append_port(out, port);
            append_method(out, method, arguments);
        });
        perform(Hook::method, nullptr);
        return answer(method, arguments);
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
    const std::vector<Action>& plan_of(Hook hook) const { return declaration_.plan[static_cast<std::size_t>(hook)]; }

    // Under stress: counts who is met here, and tells that there is nothing else to do.
    bool is_stressed() {
        const Pace pace = stage_->stress.load(std::memory_order_relaxed);
        if (pace == Pace::none) {
            return false;
        }
        occupancy_.visit(pace, stage_->overlaps);
        return true;
    }

    void complain(const std::string& problem, const Data& data) {
        std::string text = problem;
        append_data(text, data);
        stage_->complain(json::shortened(text, 200));
    }

    void count(const std::string& method, const Data& arguments) {
        if (arguments.empty() || !arguments[0].is_number_integer() || arguments[0] < 0 || arguments[0] > UINT32_MAX) {
            complain(method + " was called with what is no ULONG: ", arguments);
            return;
        }
        messages_->add(arguments[0].get<std::uint32_t>());
    }

    // Leaves `method` as the plan says.
    Data answer(const std::string& method, const Data& arguments) {
        const Action* planned = nullptr;
        for (const Action& action : plan_of(Hook::method)) {
            if (action.kind == Action::Kind::answer && action.method == method) {
                planned = &action;
            }
        }
        const Data results = planned == nullptr ? Data() : planned->echoes ? arguments : planned->data;
        const bool is_exception = planned != nullptr && planned->is_exception;
        leave(Hook::method, [&results, planned, is_exception](std::string& out) {
            append_results(out, results);
            if (is_exception) {
                append_exception(out, planned->exception);
            }
        });
        if (is_exception) {
            throw DeclaredException(planned->exception, results);
        }
        return results;
    }

    template <class AppendArguments>
    void enter(Hook hook, AppendArguments append_arguments) {
        event("enter", [hook, &append_arguments](std::string& out) {
            append_hook(out, hook);
            append_arguments(out);
        });
    }

    template <class AppendResult>
    void leave(Hook hook, AppendResult append_result) {
        event("exit", [hook, &append_result](std::string& out) {
            append_hook(out, hook);
            append_result(out);
        });
    }

    template <class AppendFields>
    void event(const char* kind, AppendFields append_fields) {
        stage_->recorder.record(kind, [this, &append_fields](std::string& out) {
            out += whose_;
            append_fields(out);
        });
    }

    void perform(Hook hook, std::int32_t* result) {
        for (const Action& action : plan_of(hook)) {
            switch (action.kind) {
                case Action::Kind::raise:
                    leave(hook, append_raised);
                    throw ProbeFailure(hook);
                case Action::Kind::return_value:
                    if (result != nullptr) {
                        *result = action.value;
                    }
                    break;
                case Action::Kind::call:
                    call(action.name, action.value);
                    break;
                case Action::Kind::hold:
                    hold(action.name);
                    break;
                case Action::Kind::siblings:
                    query_siblings();
                    break;
                case Action::Kind::call_method:
                    for (const Reference& reference : references(action.name)) {
                        call_method(action, *reference);
                    }
                    break;
                case Action::Kind::burst:
                    for (const Reference& reference : references(action.name)) {
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
            event("request", [&port, value](std::string& out) {
                append_port(out, port);
                json::append_name(out, "value");
                json::append_integer(out, value);
            });
            try {
                const std::int32_t answer = reference->exchange(value);
                event("reply", [&port, answer](std::string& out) {
                    append_port(out, port);
                    json::append_name(out, "value");
                    json::append_integer(out, answer);
                });
            } catch (...) {
                event("reply", [&port](std::string& out) {
                    append_port(out, port);
                    append_raised(out);
                });
            }
        }
    }

    void call_method(const Action& action, PortElement& callee) {
        const std::shared_ptr<Data> arguments = buffer(action.data);
        event("request", [&action](std::string& out) {
            append_port(out, action.name);
            append_method(out, action.method, action.data);
        });
        try {
            const Data results = callee.call(action.method, *arguments);
            reply(action, results, [](std::string&) {});
        } catch (const DeclaredException& error) {
            reply(action, error.fields, [&error](std::string& out) { append_exception(out, error.name); });
        } catch (...) {
            event("reply", [&action](std::string& out) {
                append_port(out, action.name);
                append_raised(out);
            });
        }
        overwrite(*arguments);
    }

    template <class AppendException>
    void reply(const Action& action, const Data& results, AppendException append) {
        const bool sound = are_data(results);
        if (!sound) {
            complain(action.method + " gave to a probe what are no values: ", results);
        }
        event("reply", [&action, &results, &append, sound](std::string& out) {
            append_port(out, action.name);
            append_results(out, sound ? results : Data());
            append(out);
        });
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
                code = results.empty() ? "" : results[0].is_string() ? results[0].get<std::string>() : json_of(results[0]);
            } catch (...) {
                code = "raised";
            }
            ++answers[code];
        }
        overwrite(message);
        event("pushed", [&action, &answers](std::string& out) {
            append_port(out, action.name);
            json::append_name(out, "first");
            json::append_integer(out, action.first);
            json::append_name(out, "count");
            json::append_integer(out, action.count);
            json::append_name(out, "answers");
            out += json_of(answers);
        });
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
        stage_->gates.hold(gate, [this, &gate] {
            event("held", [&gate](std::string& out) {
                json::append_name(out, "gate");
                json::append_text(out, gate);
            });
        });
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
            event("siblings", [&ids](std::string& out) {
                json::append_name(out, "ids");
                json::append_array(out, ids, json::append_integer);
            });
        } catch (...) {
            event("siblings", append_raised);
        }
    }

    static void append_hook(std::string& out, Hook hook) {
        json::append_name(out, "hook");
        out += '"';
        out += name_of(hook);
        out += '"';
    }

    static void append_port(std::string& out, const std::string& port) {
        json::append_name(out, "port");
        json::append_text(out, port);
    }

    static void append_method(std::string& out, const std::string& method, const Data& arguments) {
        json::append_name(out, "method");
        json::append_text(out, method);
        json::append_name(out, "arguments");
        append_data(out, arguments);
    }

    static void append_results(std::string& out, const Data& results) {
        json::append_name(out, "results");
        append_data(out, results);
    }

    static void append_exception(std::string& out, const std::string& name) {
        json::append_name(out, "exception");
        json::append_text(out, name);
    }

    static void append_raised(std::string& out) { out += ",\"raised\":true"; }

    const std::shared_ptr<Stage> stage_;
    const std::shared_ptr<const Scenario> scenario_;  // keeps declaration_ alive
    const Declaration& declaration_;
    const int instance_;
    std::string whose_;
    Occupancy occupancy_;
    std::shared_ptr<MessageCount> messages_;  // if the plan says so
    std::mutex mutex_;
    std::vector<PortConnection> connections_;
    std::shared_ptr<ContainerInterface> container_;
    std::vector<std::shared_ptr<Data>> sent_;
};

}  // namespace ucm_cts

#endif
