// Where native mutants are registered: frameworks derived from the C++ reference framework, each with one defect.
#ifndef DERIVED_CPP_REGISTRY_HPP
#define DERIVED_CPP_REGISTRY_HPP

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "containers/container_impl.hpp"
#include "platform/parts.hpp"

namespace derived {

/// The parts of a mutant; a part that it does not name is the framework's own.
struct Mutant {
    std::vector<std::string> requirements;  // each must fail; of a rare defect, one of them
    std::vector<std::string> also;          // broken by the same defect, but perhaps not seen in each run
    bool is_rare = false;                   // so rare that a run shows it in one place or another
    std::vector<std::string> clauses;       // whose test purposes must detect it
    std::string lie;                        // what it does wrong
    std::map<std::string, std::string> readings;  // options that its vendor declares beside those of the framework
    std::function<std::shared_ptr<lwucm::Runtime>(std::shared_ptr<lwucm::Shared>)> runtime;
    std::function<std::shared_ptr<lwucm::Monitor>()> monitor;
    std::function<std::unique_ptr<lwucm::SelfExecution>(std::shared_ptr<lwucm::component_execution_intf>,
                                                        std::shared_ptr<lwucm::Guard>)>
        self_execution;
    std::function<lwucm::Pacing(lwucm::Pacing)> pacing_of_runs;   // of self-executing components with a policy of 10.5
    std::function<lwucm::Pacing(lwucm::Pacing)> pacing_of_calls;  // of active components with a policy of 10.5
    bool keeps_runs_apart = true;   // the runs of the former from calls
    bool keeps_calls_apart = true;  // calls of the latter from each other
    std::function<std::shared_ptr<lwucm::Timers>(std::shared_ptr<lwucm::Guard>)> timers;
    std::function<std::unique_ptr<lwucm::Inbox>(std::function<void(const lwucm::Bytes&)>, const lwucm::Options&)> inbox;
    std::function<std::unique_ptr<lwucm::OpenRequests>()> open_requests;
    std::function<std::unique_ptr<lwucm::Draft>()> draft;
    std::function<std::unique_ptr<lwucm::View>(const lwucm::Value&)> view;
};

/// All mutants by name.
std::map<std::string, Mutant>& mutants();

template <class Own>
void set_part(Mutant& mutant, const lwucm::Monitor*) {
    mutant.clauses = {"10.1.3"};
    mutant.monitor = [] { return std::make_shared<Own>(); };
}

template <class Own>
void set_part(Mutant& mutant, const lwucm::SelfExecution*) {
    mutant.clauses = {"10.1.3"};
    mutant.self_execution = [](std::shared_ptr<lwucm::component_execution_intf> component,
                               std::shared_ptr<lwucm::Guard> guard) {
        return std::unique_ptr<lwucm::SelfExecution>(new Own(std::move(component), std::move(guard)));
    };
}

template <class Own>
void set_part(Mutant& mutant, const lwucm::Inbox*) {
    mutant.clauses = {"10.1.2", "10.1.6"};
    mutant.inbox = [](std::function<void(const lwucm::Bytes&)> deliver, const lwucm::Options& options) {
        return std::unique_ptr<lwucm::Inbox>(new Own(std::move(deliver), options));
    };
}

template <class Own>
void set_part(Mutant& mutant, const lwucm::Timers*) {
    mutant.clauses = {"10.3"};
    mutant.timers = [](std::shared_ptr<lwucm::Guard> guard) { return std::make_shared<Own>(std::move(guard)); };
}

template <class Own>
void set_part(Mutant& mutant, const lwucm::OpenRequests*) {
    mutant.clauses = {"10.4.1"};
    mutant.open_requests = [] { return std::unique_ptr<lwucm::OpenRequests>(new Own); };
}

template <class Own>
void set_part(Mutant& mutant, const lwucm::Draft*) {
    mutant.clauses = {"10.4.2"};
    mutant.draft = [] { return std::unique_ptr<lwucm::Draft>(new Own); };
}

template <class Own>
void set_part(Mutant& mutant, const lwucm::View*) {
    mutant.clauses = {"10.4.2"};
    mutant.view = [](const lwucm::Value& at_first) { return std::unique_ptr<lwucm::View>(new Own(at_first)); };
}

template <class Own>
void set_part(Mutant& mutant, const lwucm::ManagerImpl*) {
    mutant.clauses = {"11", "12.10"};
    mutant.runtime = [](std::shared_ptr<lwucm::Shared> shared) { return std::make_shared<Own>(std::move(shared)); };
}

/// Registers a mutant; returns it, so that its parts can be set.
inline Mutant& registered(const std::string& name, std::vector<std::string> requirements, const std::string& lie,
                          std::vector<std::string> also) {
    Mutant& mutant = mutants()[name];
    mutant.requirements = std::move(requirements);
    mutant.also = std::move(also);
    mutant.lie = lie;
    return mutant;
}

/// Registers a mutant whose part `Own`, a class derived from the framework's, is wrong.
template <class Own>
bool breaks(const std::string& name, std::vector<std::string> requirements, const std::string& lie,
            std::vector<std::string> also = {}, std::map<std::string, std::string> readings = {}) {
    Mutant& mutant = registered(name, std::move(requirements), lie, std::move(also));
    mutant.readings = std::move(readings);
    set_part<Own>(mutant, static_cast<const Own*>(nullptr));
    return true;
}

/// The same for a rare defect, which a run shows in one of several places.
template <class Own>
bool breaks_rarely(const std::string& name, std::vector<std::string> requirements, const std::string& lie) {
    mutants()[name].is_rare = true;
    return breaks<Own>(name, std::move(requirements), lie);
}

/// Registers a mutant that is wrong in what it does with policies of 10.5; returns it, so that this can be set.
inline Mutant& breaks_pacing(const std::string& name, std::vector<std::string> requirements, const std::string& lie,
                             std::vector<std::string> also = {}) {
    Mutant& mutant = registered(name, std::move(requirements), lie, std::move(also));
    mutant.clauses = {"10.5"};
    return mutant;
}

}  // namespace derived

#endif
