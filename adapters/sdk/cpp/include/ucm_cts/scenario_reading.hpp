// The strict reading of a scenario.
#ifndef UCM_CTS_SCENARIO_READING_HPP
#define UCM_CTS_SCENARIO_READING_HPP

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "ucm_cts/data_types_reading.hpp"
#include "ucm_cts/json.hpp"
#include "ucm_cts/scenario.hpp"

namespace ucm_cts {

namespace detail {

inline std::map<std::string, std::string> read_texts(const json::Value& value) {
    std::map<std::string, std::string> texts;
    value.for_each_member([&texts](const json::Value& member) { texts[member.key()] = member.text(); });
    return texts;
}

inline SharedInterface find_interface(const Interfaces& interfaces, const json::Value& name) {
    const auto found = interfaces.find(name.text());
    if (found == interfaces.end()) {
        name.fail("there is no interface '" + name.text() + "'");
    }
    return found->second;
}

inline void read_answer(json::Fields& fields, Action& action) {
    fields.text("method", action.method);
    action.echoes = true;
    fields.optional("results", [&action](const json::Value& results) {
        action.echoes = results.kind() == json::Kind::null;
        action.data = action.echoes ? Data() : read_data(results);
    });
    fields.optional("exception", [&action](const json::Value& name) {
        action.is_exception = name.kind() != json::Kind::null;
        action.exception = action.is_exception ? name.text() : std::string();
    });
    // what a probe is given it cannot change
    fields.optional("overwrite", [](const json::Value& flag) { flag.boolean(); });
}

inline void read_details(json::Fields& fields, Action& action) {
    switch (action.kind) {
        case Action::Kind::return_value:
            fields.integer32("value", action.value);
            break;
        case Action::Kind::call:
            fields.text("port", action.name);
            fields.integer32("value", action.value);
            break;
        case Action::Kind::hold:
            fields.text("gate", action.name);
            break;
        case Action::Kind::call_method:
            fields.text("port", action.name);
            fields.text("method", action.method);
            fields.optional("arguments", [&action](const json::Value& data) { action.data = read_data(data); });
            break;
        case Action::Kind::answer:
            read_answer(fields, action);
            break;
        case Action::Kind::burst:
            fields.text("port", action.name);
            fields.integer("first", action.first);
            fields.integer("count", action.count);
            break;
        case Action::Kind::raise:
        case Action::Kind::siblings:
        case Action::Kind::count:
            break;
    }
}

inline Action read_action(const json::Value& value) {
    Action action;
    json::Fields fields(value);
    fields.required("do", [&action](const json::Value& tag) {
        static const struct {
            const char* name;
            Action::Kind kind;
        } kinds[] = {{"raise", Action::Kind::raise},
                     {"return", Action::Kind::return_value},
                     {"call", Action::Kind::call},
                     {"hold", Action::Kind::hold},
                     {"siblings", Action::Kind::siblings},
                     {"call_method", Action::Kind::call_method},
                     {"answer", Action::Kind::answer},
                     {"burst", Action::Kind::burst},
                     {"count", Action::Kind::count}};
        const std::string name = tag.text();
        for (const auto& known : kinds) {
            if (name == known.name) {
                action.kind = known.kind;
                return;
            }
        }
        tag.fail("Invalid value '" + name + "'");
    });
    read_details(fields, action);
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
    fields.optional_nullable_text("port", policy.port);
    fields.optional("parameters", [&policy](const json::Value& values) { policy.parameters = read_texts(values); });
    fields.optional_nullable_text("element", policy.element);
    fields.end();
    return policy;
}

inline Declaration read_declaration(const json::Value& value, const Interfaces& interfaces) {
    Declaration declaration;
    declaration.name = value.key();
    json::Fields fields(value);
    fields.optional("provides", [&](const json::Value& names) { declaration.provided = read_names(names); });
    fields.optional("requires", [&](const json::Value& names) { declaration.required = read_names(names); });
    fields.optional("attributes",
                    [&](const json::Value& attributes) { declaration.attributes = read_texts(attributes); });
    fields.optional_boolean("connectable", declaration.connectable);
    fields.optional_boolean("fragment", declaration.fragment);
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
    fields.optional("ports", [&](const json::Value& ports) {
        ports.for_each_member([&](const json::Value& name) {
            declaration.interfaces[name.key()] = find_interface(interfaces, name);
        });
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
    for (std::size_t n = 0; n < OPERATIONS; ++n) {
        if (tag.is(name_of(static_cast<Operation>(n)))) {
            return static_cast<Operation>(n);
        }
    }
    tag.fail("Invalid value '" + tag.text() + "'");
}

inline void read_end(json::Fields& fields, Step& step) {
    fields.text("link", step.to);
    fields.text("id", step.subject);
    fields.text("port", step.port);
    fields.optional_text("container", step.container);
}

inline Step read_step(const json::Value& value, const Interfaces& interfaces) {
    static const char* const connectors[] = {"simple_service_connector", "simple_message_connector"};
    static const char* const roles[] = {"client", "server", "emitter", "receiver"};
    static const char* const places[] = {"transport", "inside"};
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
            fields.optional_integer32("more", step.value);
            fields.optional("total", [&step](const json::Value& total) { step.count = total.integer32(); });
            fields.text("gate", step.subject);
            break;
        case Operation::open:
            fields.text("gate", step.subject);
            break;
        case Operation::settle:
        case Operation::join:
            fields.text("worker", step.subject);
            break;
        case Operation::link:
            fields.choice("connector", connectors, step.word);
            fields.required("interface",
                            [&](const json::Value& name) { step.interface = find_interface(interfaces, name); });
            fields.text("bind", step.bind);
            break;
        case Operation::attach:
            fields.choice("role", roles, step.word);
            read_end(fields, step);
            break;
        case Operation::detach:
            read_end(fields, step);
            break;
        case Operation::break_link:
            fields.text("link", step.to);
            step.word = "transport";
            fields.optional("where", [&step](const json::Value& where) { step.word = where.choice(places); });
            break;
        case Operation::mend_link:
            fields.text("link", step.to);
            break;
        case Operation::read_log:
            fields.optional_integer32("records", step.value);
            break;
        case Operation::pause:
            fields.integer32("milliseconds", step.value);
            break;
        case Operation::await_messages:
            fields.text("component", step.component);
            fields.integer("count", step.count);
            fields.optional_integer("instance", step.instance);
            break;
        case Operation::stress:
            fields.required("refs", [&step](const json::Value& names) { step.refs = read_names(names); });
            step.value = 100;
            fields.optional_integer32("milliseconds", step.value);
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
    Interfaces interfaces;
    fields.optional("interfaces", [&](const json::Value& all) {
        all.for_each_member([&](const json::Value& one) { interfaces[one.key()] = detail::read_interface(one); });
    });
    fields.required("components", [&](const json::Value& components) {
        components.for_each_member([&](const json::Value& component) {
            scenario.components.push_back(detail::read_declaration(component, interfaces));
        });
    });
    fields.required("steps", [&](const json::Value& steps) {
        steps.for_each_element(
            [&](const json::Value& step) { scenario.steps.push_back(detail::read_step(step, interfaces)); });
    });
    fields.optional_integer("patience", scenario.patience);
    fields.optional("may_stay", [](const json::Value& workers) { detail::read_names(workers); });  // the judge's matter
    fields.end();
    return scenario;
}

}  // namespace ucm_cts

#endif
