// Execution: how the container executes one component instance, as its execution policy has it (10.1.3).
#ifndef LWUCM_SRC_EXECUTION_HPP
#define LWUCM_SRC_EXECUTION_HPP

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "lwucm/repository.hpp"
#include "monitor.hpp"
#include "own_thread.hpp"
#include "self_execution.hpp"

namespace lwucm {

/// UCM_ERROR if the policies of the implementation are not what can be applied to it.
void check_policies(const Implementation& implementation);

/// `implementation` has been checked. Without a policy, and with that of unprotected components, nothing stands between
/// the component and those who call it.
class Execution {
  public:
    Execution(std::shared_ptr<const Implementation> implementation, ComponentObject& body);
    ~Execution();
    Execution(const Execution&) = delete;
    Execution& operator=(const Execution&) = delete;

    /// Carries out a callback of the component's life cycle.
    template <class Callback>
    void enter(Callback callback) {
        if (monitor_) {
            monitor_->call(callback);
        } else {
            callback();
        }
    }

    /// What others get to see of the component's own `element`; always the same for the same.
    std::shared_ptr<PortElementObject> guarded(const std::string& port,
                                               const std::shared_ptr<PortElementObject>& element);

    /// The time in which the component executes by itself, if it does.
    void begin();
    void end();

    /// Ends all threads for good.
    void close();

  private:
    struct Entrance {
        std::shared_ptr<PortElementObject> element;
        std::shared_ptr<PortElementObject> guarded;
    };

    const std::shared_ptr<const Implementation> implementation_;
    std::set<std::string> active_ports_;
    std::shared_ptr<Monitor> monitor_;
    std::shared_ptr<OwnThread> own_thread_;
    std::unique_ptr<SelfExecution> self_execution_;
    std::mutex mutex_;
    std::map<std::string, Entrance> entrances_;
};

}  // namespace lwucm

#endif
