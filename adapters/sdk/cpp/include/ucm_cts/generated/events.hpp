// made by python -m ucm_cts.adapters.contract.generating from protocol.schema.json: do not edit
#ifndef UCM_CTS_GENERATED_EVENTS_HPP
#define UCM_CTS_GENERATED_EVENTS_HPP

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/writing.hpp"

// The events of a trace and a host's answers. What must be there is given to the constructor, the rest by member functions.
namespace ucm_cts {
namespace events {

/// Scenario step number `step` (from 0) is handed to the framework.
class Call : public Event {
  public:
    explicit Call(std::int64_t step)
        : Event("call") {
        field("step", step);
    }
};

/// The step's operation came back; `value` is an id, a list of ids, a reference, or a business result, `records` what
/// was read from the trace.
class Return : public Event {
  public:
    explicit Return(std::int64_t step)
        : Event("return") {
        field("step", step);
    }
    Return& value(std::int64_t its_value) {
        field("value", its_value);
        return *this;
    }
    Return& value(const std::vector<std::int64_t>& its_value) {
        field("value", its_value);
        return *this;
    }
    Return& value(const Reference& its_value) {
        field("value", its_value);
        return *this;
    }
    Return& records(const std::vector<LogRecord>& its_records) {
        field("records", its_records);
        return *this;
    }
};

/// The step's operation ended with an exception; `detail` is its text, for people.
class Raise : public Event {
  public:
    Raise(std::int64_t step, const std::string& error)
        : Event("raise") {
        field("step", step);
        field("error", error);
    }
    Raise& detail(const std::string& its_detail) {
        field("detail", its_detail);
        return *this;
    }
};

/// The step was not tried, because `variable` was never bound, or the adapter does not offer the operation of that
/// name.
class Skip : public Event {
  public:
    Skip(std::int64_t step, const std::string& variable)
        : Event("skip") {
        field("step", step);
        field("variable", variable);
    }
};

/// A wait step ran out of patience.
class Timeout : public Event {
  public:
    explicit Timeout(std::int64_t step)
        : Event("timeout") {
        field("step", step);
    }
};

/// The framework instantiated the body.
class Create : public Event {
  public:
    Create(const std::string& component, std::int64_t instance)
        : Event("create") {
        field("component", component);
        field("instance", instance);
    }
};

/// The framework entered the body at `hook`.
///
/// `port` and `reference` are the arguments of the Connectable callbacks, `port` and `value` those of `exchange`,
/// `dependencies` that of `on_startup`; `attributes` are the values the body holds at `on_init`; `port`, `method` and
/// `arguments` belong to `method`.
class Enter : public Event {
  public:
    Enter(const std::string& component, std::int64_t instance, Hook hook)
        : Event("enter") {
        field("component", component);
        field("instance", instance);
        field("hook", hook);
    }
    Enter& port(const std::string& its_port) {
        field("port", its_port);
        return *this;
    }
    Enter& value(std::int64_t its_value) {
        field("value", its_value);
        return *this;
    }
    Enter& reference(const Reference& its_reference) {
        field("reference", its_reference);
        return *this;
    }
    Enter& dependencies(const std::vector<PortConnection>& its_dependencies) {
        field("dependencies", its_dependencies);
        return *this;
    }
    Enter& attributes(const std::map<std::string, std::string>& its_attributes) {
        field("attributes", its_attributes);
        return *this;
    }
    Enter& method(const std::string& its_method) {
        field("method", its_method);
        return *this;
    }
    Enter& arguments(const std::vector<Datum>& its_arguments) {
        field("arguments", its_arguments);
        return *this;
    }
};

/// The body left `hook`: with `value`, or with an exception when `raised`.
///
/// `method` is left with `results`; `exception` names a declared exception, whose fields are `results`.
class Exit : public Event {
  public:
    Exit(const std::string& component, std::int64_t instance, Hook hook)
        : Event("exit") {
        field("component", component);
        field("instance", instance);
        field("hook", hook);
    }
    Exit& value(std::int64_t its_value) {
        field("value", its_value);
        return *this;
    }
    Exit& raised(bool its_raised) {
        field("raised", its_raised);
        return *this;
    }
    Exit& results(const std::vector<Datum>& its_results) {
        field("results", its_results);
        return *this;
    }
    Exit& exception(const std::string& its_exception) {
        field("exception", its_exception);
        return *this;
    }
};

/// The body is about to call `exchange(value)`, or `method` with `arguments`, through its required port element `port`.
class Request : public Event {
  public:
    Request(const std::string& component, std::int64_t instance, const std::string& port)
        : Event("request") {
        field("component", component);
        field("instance", instance);
        field("port", port);
    }
    Request& value(std::int64_t its_value) {
        field("value", its_value);
        return *this;
    }
    Request& method(const std::string& its_method) {
        field("method", its_method);
        return *this;
    }
    Request& arguments(const std::vector<Datum>& its_arguments) {
        field("arguments", its_arguments);
        return *this;
    }
};

/// That call came back with `value`, or with an exception when `raised`.
///
/// A method comes back with `results`; `exception` names a declared exception, whose fields are `results`.
class Reply : public Event {
  public:
    Reply(const std::string& component, std::int64_t instance, const std::string& port)
        : Event("reply") {
        field("component", component);
        field("instance", instance);
        field("port", port);
    }
    Reply& value(std::int64_t its_value) {
        field("value", its_value);
        return *this;
    }
    Reply& raised(bool its_raised) {
        field("raised", its_raised);
        return *this;
    }
    Reply& results(const std::vector<Datum>& its_results) {
        field("results", its_results);
        return *this;
    }
    Reply& exception(const std::string& its_exception) {
        field("exception", its_exception);
        return *this;
    }
};

/// A fragment asked its container interface for `get_components`: the ids, or an exception when `raised`.
class Siblings : public Event {
  public:
    Siblings(const std::string& component, std::int64_t instance)
        : Event("siblings") {
        field("component", component);
        field("instance", instance);
    }
    Siblings& ids(const std::vector<std::int64_t>& its_ids) {
        field("ids", its_ids);
        return *this;
    }
    Siblings& raised(bool its_raised) {
        field("raised", its_raised);
        return *this;
    }
};

/// The body waits at `gate`.
class Held : public Event {
  public:
    Held(const std::string& component, std::int64_t instance, const std::string& gate)
        : Event("held") {
        field("component", component);
        field("instance", instance);
        field("gate", gate);
    }
};

/// The scenario opened `gate`.
class Opened : public Event {
  public:
    explicit Opened(const std::string& gate)
        : Event("opened") {
        field("gate", gate);
    }
};

/// Where a worker was found: its steps `done`, its body `held` at a gate, the thread `blocked` by the operating system,
/// or still `running` when patience ran out.
class Settled : public Event {
  public:
    Settled(const std::string& worker, const std::string& where)
        : Event("settled") {
        field("worker", worker);
        field("where", where);
    }
};

/// The body has pushed a burst of `count` messages, from `first` on; `answers` says how often it got which return code,
/// and under `raised` how many pushes ended with an exception.
class Pushed : public Event {
  public:
    Pushed(const std::string& component, std::int64_t instance, const std::string& port, std::int64_t first, std::int64_t count, const std::map<std::string, std::int64_t>& answers)
        : Event("pushed") {
        field("component", component);
        field("instance", instance);
        field("port", port);
        field("first", first);
        field("count", count);
        field("answers", answers);
    }
};

/// What `instance` of `component` had counted when step `step` was done: how many messages it `received`, how many of
/// them for the first time (`distinct`), how many after a greater one (`disordered`), and the least and the greatest.
class Counted : public Event {
  public:
    Counted(std::int64_t step, const std::string& component, std::int64_t instance, std::int64_t received, std::int64_t distinct, std::int64_t disordered)
        : Event("counted") {
        field("step", step);
        field("component", component);
        field("instance", instance);
        field("received", received);
        field("distinct", distinct);
        field("disordered", disordered);
    }
    Counted& least(std::int64_t its_least) {
        field("least", its_least);
        return *this;
    }
    Counted& greatest(std::int64_t its_greatest) {
        field("greatest", its_greatest);
        return *this;
    }
};

/// Time has passed. `calendar` is the host's calendar clock in nanoseconds, read together with `t`.
class Paused : public Event {
  public:
    Paused(std::int64_t step, std::int64_t calendar)
        : Event("paused") {
        field("step", step);
        field("calendar", calendar);
    }
};

/// What a stress found: `calls` made through the framework, how many `failed`, how many `overlaps` bodies counted, and
/// the same for the body that nobody protects.
class Stressed : public Event {
  public:
    Stressed(std::int64_t step, std::int64_t calls, std::int64_t overlaps, std::int64_t control_calls, std::int64_t control_overlaps)
        : Event("stressed") {
        field("step", step);
        field("calls", calls);
        field("overlaps", overlaps);
        field("control_calls", control_calls);
        field("control_overlaps", control_overlaps);
    }
    Stressed& failed(std::int64_t its_failed) {
        field("failed", its_failed);
        return *this;
    }
};

/// Host to harness, answering hello: who is there.
///
/// `port_element_name` says how the framework spells port element names from `{port}` and `{element}`.
class Welcome : public Answer {
  public:
    Welcome(std::int64_t protocol, const std::string& product, const std::string& version)
        : Answer("welcome") {
        field("protocol", protocol);
        field("product", product);
        field("version", version);
    }
    Welcome& port_element_name(const std::string& its_port_element_name) {
        field("port_element_name", its_port_element_name);
        return *this;
    }
};

/// Host to harness: what happened. `stuck` names the threads that never came back.
class Traced : public Answer {
  public:
    Traced(std::int64_t id, const json::Written& events)
        : Answer("trace") {
        field("id", id);
        field("events", events);
    }
    Traced& stuck(const std::vector<std::string>& its_stuck) {
        field("stuck", its_stuck);
        return *this;
    }
};

/// Host to harness, streaming only: one event, as soon as it happened.
class Happened : public Answer {
  public:
    Happened(std::int64_t id, const json::Written& event)
        : Answer("event") {
        field("id", id);
        field("event", event);
    }
};

/// Host to harness: the message just received breaks the protocol, or the adapter could not set up its framework.
class Refused : public Answer {
  public:
    explicit Refused(const std::string& reason)
        : Answer("refused") {
        field("reason", reason);
    }
    Refused& id(std::int64_t its_id) {
        field("id", its_id);
        return *this;
    }
};

}  // namespace events
}  // namespace ucm_cts

#endif
