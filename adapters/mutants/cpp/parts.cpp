// Makes the parts of the mutant that the environment variable UCM_CTS_MUTANT names; with "list" it lists all and runs none.
#include "platform/parts.hpp"

#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

#include "registry.hpp"

namespace derived {

namespace {

const char* const VARIABLE = "UCM_CTS_MUTANT";

void list() {
    for (const auto& one : mutants()) {
        const nlohmann::json line = {{"name", one.first},
                                     {"requirements", one.second.requirements},
                                     {"also", one.second.also},
                                     {"is_rare", one.second.is_rare},
                                     {"clauses", one.second.clauses},
                                     {"lie", one.second.lie},
                                     {"readings", one.second.readings}};
        std::cout << line.dump() << "\n";
    }
}

const std::string& chosen_name() {
    static const std::string name = [] {
        const char* const chosen = std::getenv(VARIABLE);
        return std::string(chosen != nullptr ? chosen : "");
    }();
    return name;
}

const Mutant& chosen() {
    static const Mutant& mutant = [&]() -> const Mutant& {
        if (chosen_name() == "list") {
            list();
            std::exit(0);
        }
        const auto found = mutants().find(chosen_name());
        if (found == mutants().end()) {
            std::cerr << "there is no mutant '" << chosen_name() << "'; " << VARIABLE << "=list names them all\n";
            std::exit(2);
        }
        return found->second;
    }();
    return mutant;
}

/// A guard that keeps nobody out.
class OpenGuard final : public lwucm::Guard {
  public:
    void call(const std::function<void()>& code) override { code(); }
};

}  // namespace

std::map<std::string, Mutant>& mutants() {
    static std::map<std::string, Mutant> all;
    return all;
}

}  // namespace derived

namespace lwucm {

const char* product() {
    derived::chosen();
    return derived::chosen_name().c_str();
}

std::shared_ptr<Runtime> Parts::runtime(std::shared_ptr<Shared> shared) {
    const derived::Mutant& own = derived::chosen();
    return own.runtime ? own.runtime(std::move(shared)) : std::make_shared<ManagerImpl>(std::move(shared));
}

std::shared_ptr<Monitor> Parts::monitor() {
    const derived::Mutant& own = derived::chosen();
    return own.monitor ? own.monitor() : std::make_shared<Monitor>();
}

std::unique_ptr<SelfExecution> Parts::self_execution(std::shared_ptr<component_execution_intf> component,
                                                     std::shared_ptr<Guard> guard) {
    const derived::Mutant& own = derived::chosen();
    if (own.self_execution) {
        return own.self_execution(std::move(component), std::move(guard));
    }
    return std::unique_ptr<SelfExecution>(new SelfExecution(std::move(component), std::move(guard)));
}

std::unique_ptr<SelfExecution> Parts::paced_self_execution(std::shared_ptr<component_execution_intf> component,
                                                           std::shared_ptr<Guard> guard, const Pacing& pacing) {
    const derived::Mutant& own = derived::chosen();
    return std::unique_ptr<SelfExecution>(new PacedSelfExecution(
        std::move(component), own.keeps_runs_apart ? std::move(guard) : std::make_shared<derived::OpenGuard>(),
        own.pacing_of_runs ? own.pacing_of_runs(pacing) : pacing));
}

std::shared_ptr<PacedGuard> Parts::paced_guard(std::shared_ptr<Monitor> monitor, std::shared_ptr<Guard> inner,
                                               const Pacing& pacing) {
    const derived::Mutant& own = derived::chosen();
    return std::make_shared<PacedGuard>(
        std::move(monitor), own.keeps_calls_apart ? std::move(inner) : std::make_shared<derived::OpenGuard>(),
        own.pacing_of_calls ? own.pacing_of_calls(pacing) : pacing);
}

std::shared_ptr<Timers> Parts::timers(std::shared_ptr<Guard> guard) {
    const derived::Mutant& own = derived::chosen();
    return own.timers ? own.timers(std::move(guard)) : std::make_shared<Timers>(std::move(guard));
}

std::unique_ptr<Inbox> Parts::inbox(std::function<void(const Bytes&)> deliver, const Options& options) {
    const derived::Mutant& own = derived::chosen();
    if (own.inbox) {
        return own.inbox(std::move(deliver), options);
    }
    return std::unique_ptr<Inbox>(new Inbox(std::move(deliver), options));
}

std::unique_ptr<OpenRequests> Parts::open_requests() {
    const derived::Mutant& own = derived::chosen();
    return own.open_requests ? own.open_requests() : std::unique_ptr<OpenRequests>(new OpenRequests);
}

std::unique_ptr<Draft> Parts::draft() {
    const derived::Mutant& own = derived::chosen();
    return own.draft ? own.draft() : std::unique_ptr<Draft>(new Draft);
}

std::unique_ptr<View> Parts::view(const Value& at_first) {
    const derived::Mutant& own = derived::chosen();
    return own.view ? own.view(at_first) : std::unique_ptr<View>(new View(at_first));
}

}  // namespace lwucm
