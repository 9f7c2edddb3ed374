// Scenario: what is asked of a framework, as it travels on the wire, and its strict reading.
#ifndef UCM_CTS_SCENARIO_HPP
#define UCM_CTS_SCENARIO_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "ucm_cts/json.hpp"

namespace ucm_cts {

/// Where a probe is entered: the callbacks of 11.2.1, the probes' one business method, and `run` of a self-executing
/// component (10.1.3).
enum class Hook : std::size_t {
    on_init,
    on_startup,
    on_shutdown,
    on_remove,
    on_connect,
    on_disconnect,
    set_container_interface,
    exchange,
    run
};

const std::size_t HOOKS = 9;

inline const char* name_of(Hook hook) {
    static const char* const names[HOOKS] = {"on_init",    "on_startup",    "on_shutdown",             "on_remove",
                                             "on_connect", "on_disconnect", "set_container_interface", "exchange",
                                             "run"};
    return names[static_cast<std::size_t>(hook)];
}

/// One thing a probe does inside a hook. `name` is the port of a call or the gate of a hold.
struct Action {
    enum class Kind { raise, return_value, call, hold, siblings };
    Kind kind;
    std::string name;
    std::int32_t value;
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
    join
};

/// One step. Of the fields below `thread` those are set that the operation has; the variable names of ids, references,
/// connections, gates and workers all stand in `subject`.
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
    std::int32_t value = 0;
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

namespace detail {

inline std::map<std::string, std::string> read_texts(const json::Value& value) {
    std::map<std::string, std::string> texts;
    value.for_each_member([&texts](const json::Value& member) { texts[member.key()] = member.text(); });
    return texts;
}

inline std::vector<std::string> read_names(const json::Value& value) {
    std::vector<std::string> names;
    value.for_each_element([&names](const json::Value& name) { names.push_back(name.text()); });
    return names;
}

inline Action read_action(const json::Value& value) {
    Action action = {Action::Kind::raise, "", 0};
    json::Fields fields(value);
    fields.required("do", [&action](const json::Value& tag) {
        static const struct {
            const char* name;
            Action::Kind kind;
        } kinds[] = {{"raise", Action::Kind::raise},
                     {"return", Action::Kind::return_value},
                     {"call", Action::Kind::call},
                     {"hold", Action::Kind::hold},
                     {"siblings", Action::Kind::siblings}};
        const std::string name = tag.text();
        for (const auto& known : kinds) {
            if (name == known.name) {
                action.kind = known.kind;
                return;
            }
        }
        tag.fail("Invalid value '" + name + "'");
    });
    if (action.kind == Action::Kind::call) {
        fields.text("port", action.name);
    }
    if (action.kind == Action::Kind::hold) {
        fields.text("gate", action.name);
    }
    if (action.kind == Action::Kind::call || action.kind == Action::Kind::return_value) {
        fields.integer32("value", action.value);
    }
    fields.end();
    return action;
}

inline Hook read_hook(const json::Value& member) {
    for (std::size_t n = 0; n < HOOKS; ++n) {
        if (member.has_key(name_of(static_cast<Hook>(n)))) {
            return static_cast<Hook>(n);
        }
    }
    member.fail("Invalid enum value '" + member.key() + "'");
}

inline Policy read_policy(const json::Value& value) {
    Policy policy;
    json::Fields fields(value);
    fields.text("definition", policy.definition);
    fields.optional("port", [&policy](const json::Value& port) {
        if (port.kind() != json::Kind::null) {
            policy.port = port.text();
        }
    });
    fields.optional("parameters", [&policy](const json::Value& values) { policy.parameters = read_texts(values); });
    fields.optional("element", [&policy](const json::Value& element) {
        if (element.kind() != json::Kind::null) {
            policy.element = element.text();
        }
    });
    fields.end();
    return policy;
}

inline Declaration read_declaration(const json::Value& value) {
    Declaration declaration;
    declaration.name = value.key();
    json::Fields fields(value);
    fields.optional("provides", [&](const json::Value& names) { declaration.provided = read_names(names); });
    fields.optional("requires", [&](const json::Value& names) { declaration.required = read_names(names); });
    fields.optional("attributes",
                    [&](const json::Value& attributes) { declaration.attributes = read_texts(attributes); });
    fields.optional("connectable", [&](const json::Value& flag) { declaration.connectable = flag.boolean(); });
    fields.optional("fragment", [&](const json::Value& flag) { declaration.fragment = flag.boolean(); });
    fields.optional("plan", [&](const json::Value& plan) {
        plan.for_each_member([&](const json::Value& actions) {
            std::vector<Action>& planned = declaration.plan[static_cast<std::size_t>(read_hook(actions))];
            planned.clear();
            actions.for_each_element([&](const json::Value& action) { planned.push_back(read_action(action)); });
        });
    });
    fields.optional("policies", [&](const json::Value& policies) {
        policies.for_each_element([&](const json::Value& p) { declaration.policies.push_back(read_policy(p)); });
    });
    fields.end();
    std::set<std::string> names(declaration.provided.begin(), declaration.provided.end());
    names.insert(declaration.required.begin(), declaration.required.end());
    if (names.size() != declaration.provided.size() + declaration.required.size()) {
        value.fail("a port element is declared twice");
    }
    return declaration;
}

inline Operation read_operation(const json::Value& tag) {
    static const struct {
        const char* name;
        Operation operation;
    } operations[] = {{"add_component", Operation::add_component},
                      {"remove_component", Operation::remove_component},
                      {"get_port_element", Operation::get_port_element},
                      {"connect", Operation::connect},
                      {"disconnect", Operation::disconnect},
                      {"start", Operation::start},
                      {"stop", Operation::stop},
                      {"get_components", Operation::get_components},
                      {"create_container", Operation::create_container},
                      {"remove_container", Operation::remove_container},
                      {"destroy", Operation::destroy},
                      {"invoke", Operation::invoke},
                      {"open", Operation::open},
                      {"reach", Operation::reach},
                      {"settle", Operation::settle},
                      {"join", Operation::join}};
    for (const auto& known : operations) {
        if (tag.is(known.name)) {
            return known.operation;
        }
    }
    tag.fail("Invalid value '" + tag.text() + "'");
}

inline Step read_step(const json::Value& value) {
    Step step;
    json::Fields fields(value);
    fields.required("op", [&step](const json::Value& tag) { step.operation = read_operation(tag); });
    fields.optional("thread", [&step](const json::Value& thread) {
        step.has_thread = thread.kind() != json::Kind::null;
        if (step.has_thread) {
            step.thread = thread.text();
        }
    });
    switch (step.operation) {
        case Operation::add_component:
            fields.text("component", step.component);
            fields.optional_text("container", step.container);
            fields.optional_text("bind", step.bind);
            if (step.bind.empty()) {
                step.bind = step.component;
            }
            break;
        case Operation::remove_component:
            fields.text("id", step.subject);
            fields.optional_text("container", step.container);
            break;
        case Operation::get_port_element:
            fields.text("id", step.subject);
            fields.text("port", step.port);
            fields.text("bind", step.bind);
            fields.optional_text("container", step.container);
            break;
        case Operation::connect:
            fields.text("id", step.subject);
            fields.text("port", step.port);
            fields.text("to", step.to);
            fields.text("bind", step.bind);
            fields.optional_text("container", step.container);
            break;
        case Operation::disconnect:
            fields.text("connection", step.subject);
            fields.optional_text("container", step.container);
            break;
        case Operation::start:
        case Operation::stop:
        case Operation::get_components:
            fields.optional_text("container", step.container);
            break;
        case Operation::create_container:
            fields.text("bind", step.bind);
            break;
        case Operation::remove_container:
            fields.text("container", step.subject);
            break;
        case Operation::destroy:
            break;
        case Operation::invoke:
            fields.text("ref", step.subject);
            fields.integer32("value", step.value);
            break;
        case Operation::reach:
            fields.optional("more", [&step](const json::Value& more) { step.value = more.integer32(); });
            fields.text("gate", step.subject);
            break;
        case Operation::open:
            fields.text("gate", step.subject);
            break;
        case Operation::settle:
        case Operation::join:
            fields.text("worker", step.subject);
            break;
    }
    fields.end();
    return step;
}

}  // namespace detail

/// Reads a scenario; a ProtocolError names the first thing that is not as the protocol has it.
inline Scenario read_scenario(const json::Value& value) {
    Scenario scenario;
    json::Fields fields(value);
    fields.required("components", [&](const json::Value& components) {
        components.for_each_member([&](const json::Value& component) {
            scenario.components.push_back(detail::read_declaration(component));
        });
    });
    fields.required("steps", [&](const json::Value& steps) {
        steps.for_each_element([&](const json::Value& step) { scenario.steps.push_back(detail::read_step(step)); });
    });
    fields.optional("patience", [&](const json::Value& patience) { scenario.patience = patience.integer(); });
    fields.end();
    return scenario;
}

}  // namespace ucm_cts

#endif
