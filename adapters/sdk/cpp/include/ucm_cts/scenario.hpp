// Scenario: what is asked of a framework, as it travels on the wire.
#ifndef UCM_CTS_SCENARIO_HPP
#define UCM_CTS_SCENARIO_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "ucm_cts/data_types.hpp"

namespace ucm_cts {

/// Where a probe is entered: the callbacks of 11.2.1, `exchange`, `run` of a self-executing component (10.1.3), and
/// `method`, any method of a port element with interface.
enum class Hook : std::size_t {
    on_init,
    on_startup,
    on_shutdown,
    on_remove,
    on_connect,
    on_disconnect,
    set_container_interface,
    exchange,
    run,
    method
};

const std::size_t HOOKS = 10;

inline const char* name_of(Hook hook) {
    static const char* const names[HOOKS] = {"on_init",    "on_startup",    "on_shutdown",             "on_remove",
                                             "on_connect", "on_disconnect", "set_container_interface", "exchange",
                                             "run",        "method"};
    return names[static_cast<std::size_t>(hook)];
}

/// One thing a probe does inside a hook; which of the members count depends on its kind.
struct Action {
    enum class Kind { raise, return_value, call, hold, siblings, call_method, answer, burst, count };
    Kind kind;
    std::string name;              // the port of a call or burst, the gate of a hold
    std::int32_t value = 0;        // what is returned or sent
    std::string method;            // that is called or answered
    Data data;                     // arguments of a call, or results of an answer
    bool echoes = false;           // an answer without results of its own gives back its arguments
    bool is_exception = false;     // an answer is the declared `exception`, whose fields are `data`
    std::string exception;
    std::int64_t first = 0;        // of a burst
    std::int64_t count = 0;
};

typedef std::map<std::string, std::string> Attributes;

/// A technical policy of a component implementation (9.5.4.3). `port` is empty unless the policy is that of a port element.
/// `element` is the name under which the component gets the port element that it requires by the policy (10.1.4), empty if
/// it requires none.
struct Policy {
    std::string definition;
    std::string port;
    std::map<std::string, std::string> parameters;
    std::string element;
};

/// The execution policy (10.1.3) that makes a component provide a port element to its container, and that port element.
const char* const SELF_EXECUTING = "protected_self-executing_component";
const char* const SELF_EXECUTION_API = "self-execution_api";

/// The method of messages (10.1.6).
const char* const PUSH = "push";

/// One component implementation: a probe body and its plan.
struct Declaration {
    std::string name;
    std::vector<std::string> provided;
    std::vector<std::string> required;
    Attributes attributes;
    bool connectable = false;
    bool fragment = false;
    std::array<std::vector<Action>, HOOKS> plan;
    std::vector<Policy> policies;
    Interfaces interfaces;
};

enum class Operation {
    add_component,
    remove_component,
    get_port_element,
    connect,
    disconnect,
    start,
    stop,
    get_components,
    create_container,
    remove_container,
    destroy,
    invoke,
    open,
    reach,
    settle,
    join,
    link,
    attach,
    detach,
    break_link,
    mend_link,
    read_log,
    pause,
    await_messages,
    stress
};

/// The operation as it is spelled on the wire.
inline const char* name_of(Operation operation) {
    static const char* const names[] = {
        "add_component", "remove_component", "get_port_element", "connect", "disconnect", "start", "stop",
        "get_components", "create_container", "remove_container", "destroy", "invoke", "open", "reach", "settle", "join",
        "link", "attach", "detach", "break", "mend", "read_log", "pause", "await_messages", "stress"};
    return names[static_cast<std::size_t>(operation)];
}

const std::size_t OPERATIONS = static_cast<std::size_t>(Operation::stress) + 1;

/// One step. Of the members below `thread` those are set that the operation has; the variable names of ids, references,
/// connections, gates and workers all stand in `subject`, those of links in `to`.
struct Step {
    Operation operation;
    bool has_thread = false;
    std::string thread;
    std::string container = "manager";
    std::string subject;
    std::string component;
    std::string port;
    std::string to;
    std::string bind;
    std::int32_t value = 0;         // sent by invoke; `more` of reach, `records` of read_log, milliseconds
    std::int64_t count = 0;         // of messages; `total` of reach
    std::int64_t instance = 1;
    std::string word;               // the connector of a link, the role of an end, where it is broken
    SharedInterface interface;
    std::vector<std::string> refs;
};

struct Scenario {
    std::vector<Declaration> components;
    std::vector<Step> steps;
    std::int64_t patience = 2000;

    const Declaration* find(const std::string& component) const {
        for (const Declaration& declaration : components) {
            if (declaration.name == component) {
                return &declaration;
            }
        }
        return nullptr;
    }
};

}  // namespace ucm_cts

#endif
