// made by python -m ucm_cts.adapters.contract.generating from protocol.schema.json: do not edit
#ifndef UCM_CTS_GENERATED_MESSAGES_HPP
#define UCM_CTS_GENERATED_MESSAGES_HPP

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "ucm_cts/words.hpp"

namespace ucm_cts {

/// A value as it travels.
typedef nlohmann::json Datum;
typedef std::vector<Datum> Data;

struct DataType;
typedef std::shared_ptr<const DataType> SharedType;

struct Interface;
typedef std::shared_ptr<const Interface> SharedInterface;

/// Harness to host, first.
///
/// `protocol`: the version of the protocol that the harness speaks.
struct Hello {
    std::int64_t protocol = 0;
};

/// An argument that a body was given before, in place of one that a plan spells.
///
/// `argument`: the argument in whose place it stands, from 0.
/// `method`: the method that the body was entered at.
/// `position`: its argument there, from 0.
/// `nth`: the number of that entry among those at `method`, from 1; 0 is the entry in which the body acts.
struct Remembered {
    std::int32_t argument = 0;
    std::string method;
    std::int32_t position = 0;
    std::int32_t nth = 0;
};

/// A time-out of 10.3.2 whose seconds count from what a clock of the body shows. The body reads the clock just before
/// its call, and adds the seconds that the clock gave to those of the time-out.
///
/// `argument`: the time-out among the arguments, from 0.
/// `port`: the port element of the clock.
/// `method`: the method of the clock.
struct FromClock {
    std::int32_t argument = 0;
    std::string port;
    std::string method;
};

/// An object timer of 10.3.1 that a body was given before.
///
/// `method`: a method of the scheduler that returned it to the body, or `on_trigger`, which handed it over.
/// `nth`: its number among the timers that came so, from 1; 0 is that of the entry in which the body acts.
struct TimerFrom {
    std::string method;
    std::int32_t nth = 0;
};

enum class ActionKind {
    raise, return_value, call, hold, siblings, call_method, answer, burst, count
};

inline Words words_of(ActionKind) {
    static const char* const words[] = {
        "raise", "return", "call", "hold", "siblings", "call_method", "answer", "burst", "count"
    };
    return Words{words, 9};
}

/// One of 9 kinds of objects; each member says which kinds have it.
struct Action {
    typedef ActionKind Kind;
    Kind kind = Kind::raise;

    /// Of return, call.
    std::int32_t value = 0;

    /// Of call, call_method, burst.
    std::string port;

    /// Of hold.
    std::string gate;

    /// Of call_method, answer.
    std::string method;

    /// Of call_method.
    std::vector<Datum> arguments;

    /// Of call_method.
    std::vector<Remembered> remembered;

    /// Of call_method.
    std::int32_t given = 0;
    bool has_given = false;

    /// Of call_method.
    FromClock from_clock;
    bool has_from_clock = false;

    /// Of call_method.
    std::string handler;
    bool has_handler = false;

    /// Of call_method.
    TimerFrom on;
    bool has_on = false;

    /// Of answer.
    std::vector<Datum> results;
    bool has_results = false;

    /// Of answer.
    std::string exception;
    bool has_exception = false;

    /// Of answer.
    bool overwrite = false;

    /// Of burst.
    std::int64_t first = 0;

    /// Of burst.
    std::int64_t count = 0;
};

enum class Hook {
    on_init, on_startup, on_shutdown, on_remove, on_connect, on_disconnect, set_container_interface, exchange, run,
    method
};

inline Words words_of(Hook) {
    static const char* const words[] = {
        "on_init", "on_startup", "on_shutdown", "on_remove", "on_connect", "on_disconnect", "set_container_interface",
        "exchange", "run", "method"
    };
    return Words{words, 10};
}

/// A technical policy of a component implementation (9.5.4.3).
///
/// `definition`: name of the policy definition.
/// `port`: the port element that it applies to; none if it applies to the component.
/// `parameters`: values by parameter name.
/// `element`: name of the port element that the component requires by the policy (`REQUIRED_ELEMENTS`):
/// `policy.element`.
/// `settings`: the parameters of a policy of 10.5 (`PERIOD`, `OFFSET`, `PRIORITY`), times in microseconds.
struct Policy {
    std::string definition;
    std::string port;
    std::map<std::string, std::string> parameters;
    std::string element;
    std::map<std::string, std::int64_t> settings;
};

/// A component implementation that the framework must be able to instantiate: a probe body and its plan.
///
/// `provides`: provided port elements.
/// `requires`: required port elements; none may be provided too.
/// `attributes`: configured values by attribute name.
/// `connectable`: the body implements Connectable (11.2.1.3).
/// `fragment`: the body implements FragmentObject (11.2.1.4).
/// `plan`: the actions of the probe in each hook, each time it is entered there.
/// `policies`: technical policies.
/// `ports`: the interface of each port element that has one, by name.
/// `defaults`: default values (9.2.7.4) by attribute name; they hold for attributes that are not configured.
/// `handlers`: the body's own handlers of object timers (10.3.1). Each is entered at `method`, with its name as the
/// port element.
struct Declaration {
    std::vector<std::string> provided;
    std::vector<std::string> required;
    std::map<std::string, std::string> attributes;
    bool connectable = false;
    bool fragment = false;
    std::map<Hook, std::vector<Action>> plan;
    std::vector<Policy> policies;
    std::map<std::string, std::string> ports;
    std::map<std::string, std::string> defaults;
    std::vector<std::string> handlers;
};

enum class StepKind {
    add_component, remove_component, get_port_element, connect, disconnect, start, stop, get_components,
    create_container, remove_container, destroy, invoke, open, reach, settle, join, link, attach, detach, break_link,
    mend_link, read_log, pause, await_messages, stress, advance
};

inline Words words_of(StepKind) {
    static const char* const words[] = {
        "add_component", "remove_component", "get_port_element", "connect", "disconnect", "start", "stop",
        "get_components", "create_container", "remove_container", "destroy", "invoke", "open", "reach", "settle",
        "join", "link", "attach", "detach", "break", "mend", "read_log", "pause", "await_messages", "stress", "advance"
    };
    return Words{words, 26};
}

/// One of 26 kinds of objects; each member says which kinds have it.
struct Step {
    typedef StepKind Kind;
    Kind kind = Kind::add_component;

    /// Of add_component, await_messages.
    std::string component;

    /// Of add_component, remove_component, get_port_element, connect, disconnect, start, stop, get_components,
    /// remove_container, attach, detach.
    std::string container = "manager";

    /// Of add_component, get_port_element, connect, create_container, link.
    std::string bind;

    /// Of add_component.
    std::map<std::string, std::string> attributes;

    /// Of all.
    std::string thread;
    bool has_thread = false;

    /// Of remove_component, get_port_element, connect, attach, detach.
    std::string id;

    /// Of get_port_element, connect, attach, detach.
    std::string port;

    /// Of connect.
    std::string to;

    /// Of disconnect.
    std::string connection;

    /// Of invoke.
    std::string ref;

    /// Of invoke.
    std::int32_t value = 0;

    /// Of open, reach.
    std::string gate;

    /// Of reach.
    std::int32_t more = 0;

    /// Of reach.
    std::int32_t total = 0;

    /// Of settle, join.
    std::string worker;

    /// Of link.
    std::string connector;

    /// Of link.
    std::string interface;

    /// Of attach, detach, break, mend.
    std::string link;

    /// Of attach.
    std::string role;

    /// Of break.
    std::string where = "transport";

    /// Of read_log.
    std::int32_t records = 0;

    /// Of pause, stress, advance.
    std::int32_t milliseconds = 100;

    /// Of await_messages.
    std::int64_t count = 0;

    /// Of await_messages.
    std::int64_t instance = 1;

    /// Of stress.
    std::vector<std::string> refs;
};

enum class Direction {
    in, out, inout, result
};

inline Words words_of(Direction) {
    static const char* const words[] = {
        "IN", "OUT", "INOUT", "RETURN"
    };
    return Words{words, 4};
}

/// An alternative of a union.
///
/// `name`: its name.
/// `of`: type of its value.
/// `selectors`: the enumerators that select it.
/// `default`: it is selected by every enumerator that no other case names.
struct UnionCase {
    std::string name;
    SharedType of;
    std::vector<std::string> selectors;
    bool is_default = false;
};

enum class DataTypeKind {
    integer, floating, character, boolean, string, enumeration, structure, union_type, array, sequence, alias
};

inline Words words_of(DataTypeKind) {
    static const char* const words[] = {
        "integer", "float", "char", "boolean", "string", "enumeration", "structure", "union", "array", "sequence",
        "alias"
    };
    return Words{words, 11};
}

/// One of 11 kinds of objects; each member says which kinds have it.
struct DataType {
    typedef DataTypeKind Kind;
    Kind kind = Kind::integer;

    /// Of integer, float, char, string, enumeration.
    std::string base;

    /// Of string, sequence.
    std::int64_t size = -1;

    /// Of enumeration, structure, union, alias.
    std::string name;

    /// Of enumeration.
    std::vector<std::pair<std::string, Datum>> enumerators;

    /// Of structure.
    std::vector<std::pair<std::string, SharedType>> fields;

    /// Of union, array, sequence, alias.
    SharedType of;

    /// Of union.
    std::vector<UnionCase> cases;

    /// Of array.
    std::vector<std::int64_t> sizes;
};

/// A parameter of a method.
///
/// `name`: its name.
/// `direction`: which way its value goes.
/// `of`: its type.
struct Parameter {
    std::string name;
    Direction direction = Direction();
    SharedType of;
};

/// A method of an interface.
///
/// `parameters`: in order.
/// `raises`: the exceptions that it may raise.
struct Method {
    std::vector<Parameter> parameters;
    std::vector<SharedType> raises;

    /// What the caller sends: IN and INOUT.
    std::vector<Parameter> arguments() const;

    /// What comes back: OUT, INOUT and RETURN, in the order of declaration.
    std::vector<Parameter> results() const;
};

/// An interface (9.2.7).
///
/// `methods`: its own and inherited methods, by name.
/// `inherited`: names of the interfaces that it inherits (9.2.7.2).
struct Interface {
    std::map<std::string, Method> methods;
    std::vector<std::string> inherited;
};

/// A scenario.
///
/// `components`: declarations by name.
/// `steps`: in order.
/// `patience`: how long a wait step may wait, in milliseconds.
/// `interfaces`: by name.
/// `may_stay`: workers that need not return; hosts ignore it.
/// `types`: by name, what a connector of 10.4 is bound to: data types by template parameter. The interfaces that follow
/// from it are among `interfaces`, as `platform_interfaces.named_interfaces` has them.
struct Scenario {
    std::vector<std::pair<std::string, Declaration>> components;
    std::vector<Step> steps;
    std::int64_t patience = 2000;
    std::map<std::string, SharedInterface> interfaces;
    std::vector<std::string> may_stay;
    std::map<std::string, std::map<std::string, SharedType>> types;
};

/// Harness to host: run a scenario on a new runtime.
///
/// `id`: number of the run; the answer has it too.
/// `scenario`: what to run.
/// `stream`: send each event as it happens.
struct Run {
    std::int64_t id = 0;
    Scenario scenario;
    bool stream = false;
};

}  // namespace ucm_cts

#endif
