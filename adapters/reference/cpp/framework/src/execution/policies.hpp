// What the technical policies of an implementation ask for, sorted by who applies it.
#ifndef LWUCM_SRC_POLICIES_HPP
#define LWUCM_SRC_POLICIES_HPP

#include <map>
#include <set>
#include <string>
#include <vector>

#include "execution/pacing.hpp"
#include "lwucm/container_services.hpp"
#include "lwucm/repository.hpp"

namespace lwucm {

enum class Protection { none, passive, active, self_executing };

/// Calls of `methods` leave a record of `severity`.
struct PortTrace {
    std::set<std::string> methods;
    log_severity_t severity;
};

/// A port element that a component requires by a policy, and the name under which it gets it.
struct RequiredService {
    enum class Kind { clock, trace, index_timers, object_timers };

    Kind kind;
    std::string name;
};

struct Demands {
    std::string execution;  // definition of the execution policy
    Protection protection = Protection::none;
    Pacing pacing;
    std::set<std::string> active_ports;
    std::vector<RequiredService> services;
    std::map<std::string, std::vector<PortTrace>> traces;  // by port element
};

extern const char* const SELF_EXECUTING;

/// UCM_ERROR if the policies of the implementation are not what can be applied to it.
Demands demands_of(const Implementation& implementation);

}  // namespace lwucm

#endif
