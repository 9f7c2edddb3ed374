// Scenario: what is asked of a framework.
#ifndef UCM_CTS_SCENARIO_HPP
#define UCM_CTS_SCENARIO_HPP

#include <map>
#include <set>
#include <string>
#include <utility>

#include "ucm_cts/data_types.hpp"
#include "ucm_cts/generated/messages_reading.hpp"

namespace ucm_cts {

typedef std::map<std::string, std::string> Attributes;
typedef StepKind Operation;

/// A declaration and its name.
typedef std::pair<std::string, Declaration> Component;

/// The execution policies (10.1.3, 10.5) that make a component provide a port element to its container, and that port element.
const char* const SELF_EXECUTING = "protected_self-executing_component";
const char* const PERIODIC_SELF_EXECUTING = "periodic_self-executing_component";
const char* const BACKGROUND = "background_self-executing_component";
const char* const SELF_EXECUTION_API = "self-execution_api";

inline bool is_self_executing(const std::string& policy) {
    return policy == SELF_EXECUTING || policy == PERIODIC_SELF_EXECUTING || policy == BACKGROUND;
}

/// The policy that gives a component index timers (10.3.2), and the port element that it makes it provide.
const char* const INDEX_TIMERS = "itt_timer";
const char* const TIMER_CALLBACK = "timer_callback";

/// The policy that gives a component object timers (10.3.1).
const char* const OBJECT_TIMERS = "ott_timer";

/// The method of messages (10.1.6).
const char* const PUSH = "push";

namespace detail {

inline void check_interface(const Scenario& scenario, const std::string& name, const std::string& where) {
    if (scenario.interfaces.count(name) == 0) {
        throw ProtocolError("there is no interface '" + name + "' - at `$.scenario." + where + "`");
    }
}

/// Checks what the types cannot say. Throws ProtocolError.
inline void check(const Scenario& scenario) {
    for (const auto& component : scenario.components) {
        const Declaration& declaration = component.second;
        const std::string where = "components." + component.first;
        std::set<std::string> names(declaration.provided.begin(), declaration.provided.end());
        names.insert(declaration.required.begin(), declaration.required.end());
        if (names.size() != declaration.provided.size() + declaration.required.size()) {
            throw ProtocolError("a port element is declared twice - at `$.scenario." + where + "`");
        }
        for (const auto& port : declaration.ports) {
            check_interface(scenario, port.second, where + ".ports." + port.first);
        }
    }
    for (std::size_t number = 0; number < scenario.steps.size(); ++number) {
        const Step& step = scenario.steps[number];
        if (step.kind == Operation::link && scenario.types.count(step.interface) == 0) {
            check_interface(scenario, step.interface, "steps[" + std::to_string(number) + "].interface");
        }
    }
}

}  // namespace detail
}  // namespace ucm_cts

#endif
