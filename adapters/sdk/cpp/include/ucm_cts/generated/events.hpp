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

/// The step is passed to the framework.
class Call : public Event {
  public:
    explicit Call(std::int64_t step)
        : Event("call") {
        field("step", step);
    }
};

/// The operation of the step returned.
///
/// `value`: an id, a list of ids, a reference or a business result.
/// `records`: the records that were read from the log.
/// `wrong`: what a business call gave instead of an integer, for people.
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
    Return& wrong(const std::string& its_wrong) {
        field("wrong", its_wrong);
        return *this;
    }
};

/// The operation of the step ended with an exception.
///
/// `error`: which one.
/// `detail`: its text, for people.
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

/// The step was not run.
///
/// `variable`: the variable that was not bound, or the operation that the adapter does not offer.
class Skip : public Event {
  public:
    Skip(std::int64_t step, const std::string& variable)
        : Event("skip") {
        field("step", step);
        field("variable", variable);
    }
};

/// Patience ended before what the step waits for happened.
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

/// The framework entered the body.
///
/// `hook`: where.
/// `port`: argument of Connectable callbacks; the port element of `exchange` and `method`.
/// `value`: argument of `exchange`.
/// `reference`: argument of `on_connect`.
/// `dependencies`: argument of `on_startup`.
/// `attributes`: the values that the body has at `on_init`.
/// `method`: name of the method.
/// `arguments`: IN and INOUT values of the method.
/// `wrong`: what the framework handed over that is not of the type of the interface, for people; its field is empty.
/// `timer`: the object timer that `on_trigger` was given: its number among those that came to the body, from 1. One
/// that comes     again has another number, because the body cannot tell whether it is the same.
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
    Enter& wrong(const std::string& its_wrong) {
        field("wrong", its_wrong);
        return *this;
    }
    Enter& timer(std::int64_t its_timer) {
        field("timer", its_timer);
        return *this;
    }
};

/// The body left a hook.
///
/// `hook`: where.
/// `value`: result of `exchange`.
/// `raised`: it left with an exception.
/// `results`: OUT, INOUT and RETURN values of a method, or fields of `exception`.
/// `exception`: name of the declared exception.
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

/// The body is about to call `exchange` or a method.
///
/// `port`: the required port element.
/// `value`: argument of `exchange`.
/// `method`: name of the method; none for `exchange`.
/// `arguments`: IN and INOUT values of the method.
/// `handler`: the handler that is passed before them.
/// `timer`: the object timer that is called, by its number.
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
    Request& handler(const std::string& its_handler) {
        field("handler", its_handler);
        return *this;
    }
    Request& timer(std::int64_t its_timer) {
        field("timer", its_timer);
        return *this;
    }
};

/// The call of the last `Request` of this body and thread came back.
///
/// `port`: the required port element.
/// `value`: result of `exchange`.
/// `raised`: it came back with an exception.
/// `results`: OUT, INOUT and RETURN values of a method, or fields of `exception`.
/// `exception`: name of the declared exception.
/// `wrong`: what came back that is not of the type of the interface, for people.
/// `timer`: the object timer that came back: its number, as that of `Enter`.
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
    Reply& wrong(const std::string& its_wrong) {
        field("wrong", its_wrong);
        return *this;
    }
    Reply& timer(std::int64_t its_timer) {
        field("timer", its_timer);
        return *this;
    }
};

/// A fragment called `get_components` of its container interface.
///
/// `ids`: the result.
/// `raised`: it ended with an exception.
/// `wrong`: the result, if it is no list of integers, for people.
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
    Siblings& wrong(const std::string& its_wrong) {
        field("wrong", its_wrong);
        return *this;
    }
};

/// The body waits at a gate.
///
/// `gate`: name of the gate.
class Held : public Event {
  public:
    Held(const std::string& component, std::int64_t instance, const std::string& gate)
        : Event("held") {
        field("component", component);
        field("instance", instance);
        field("gate", gate);
    }
};

/// The scenario opened a gate.
///
/// `gate`: name of the gate.
class Opened : public Event {
  public:
    explicit Opened(const std::string& gate)
        : Event("opened") {
        field("gate", gate);
    }
};

/// The state of a worker.
///
/// `worker`: its name.
/// `where`: `done` with its steps, `held` by a body at a gate, `blocked` by the operating system, or still `running`
/// when patience ended.
class Settled : public Event {
  public:
    Settled(const std::string& worker, const std::string& where)
        : Event("settled") {
        field("worker", worker);
        field("where", where);
    }
};

/// The body has pushed a burst of messages.
///
/// `port`: the required port element.
/// `first`: the first number.
/// `count`: how many messages.
/// `answers`: how many pushes got each return code; `raised`: how many ended with an exception.
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

/// The messages that a body has counted.
///
/// `component`: name of the declaration.
/// `instance`: number of the body, from 1.
/// `received`: how many messages.
/// `distinct`: how many different ones.
/// `disordered`: how many came after a greater one.
/// `least`: the least number.
/// `greatest`: the greatest number.
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

/// Time has passed.
///
/// `calendar`: the host's calendar clock in nanoseconds, read together with `t`.
class Paused : public Event {
  public:
    Paused(std::int64_t step, std::int64_t calendar)
        : Event("paused") {
        field("step", step);
        field("calendar", calendar);
    }
};

/// The result of a stress.
///
/// `calls`: calls through the framework.
/// `overlaps`: overlaps that the bodies counted.
/// `control_calls`: calls of a body without protection, for comparison.
/// `control_overlaps`: overlaps in that body.
/// `failed`: calls that failed.
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

/// Host to harness, the answer to `hello`.
///
/// `protocol`: the version of the protocol that the host speaks.
/// `product`: the framework's name.
/// `version`: the framework's version.
/// `port_element_name`: how the framework spells port element names, from `{port}` and `{element}`.
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

/// Host to harness, the answer to `run`: the trace.
///
/// `id`: number of the run.
/// `events`: all events, in order.
/// `stuck`: the threads that did not return.
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

/// Host to harness, in a streamed run: one event, as soon as it happens.
///
/// `id`: number of the run.
/// `event`: the event.
class Happened : public Answer {
  public:
    Happened(std::int64_t id, const json::Written& event)
        : Answer("event") {
        field("id", id);
        field("event", event);
    }
};

/// Host to harness: the last message breaks the protocol, or the adapter could not set up its framework.
///
/// `reason`: what is wrong, for people.
/// `id`: number of the run, if the message had one.
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
