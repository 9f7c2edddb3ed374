// Execution: how the container executes one component instance, as its technical policies have it (10.1.3, 10.1.4).
#ifndef LWUCM_SRC_EXECUTION_HPP
#define LWUCM_SRC_EXECUTION_HPP

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "execution/index_timers.hpp"
#include "execution/interception.hpp"
#include "execution/object_timers.hpp"
#include "execution/self_execution.hpp"
#include "execution/timers.hpp"
#include "lwucm/container.hpp"

namespace lwucm {

/// Without an execution policy, and with that of unprotected components, nothing stands between the component and those
/// who call it, unless its port elements are traced.
class Execution {
  public:
    /// UCM_ERROR if the body does not give what its policy makes it provide.
    Execution(componentId id, std::shared_ptr<const Implementation> implementation, Demands demands,
              ComponentObject& body, const Platform& platform);
    ~Execution();
    Execution(const Execution&) = delete;
    Execution& operator=(const Execution&) = delete;

    /// Carries out a callback of the component's life cycle.
    template <class Callback>
    void enter(Callback callback) {
        if (guard_) {
            guard_->call(callback);
        } else {
            callback();
        }
    }

    /// What others get to see of the component's own `element`; always the same for the same.
    std::shared_ptr<PortElementObject> provided(const std::string& port,
                                                const std::shared_ptr<PortElementObject>& element);

    /// What the component gets to see of what its required port element is connected to.
    std::shared_ptr<PortElementObject> required(const std::string& port,
                                                const std::shared_ptr<PortElementObject>& element) const;

    /// The port elements that the component requires by its policies.
    PortConnections services() const;

    /// The component is about to start.
    void open();

    /// The time in which the component executes by itself, if it does, and its timers call back.
    void begin();
    void end();

    /// Ends all threads for good.
    void close();

  private:
    struct Way {
        std::shared_ptr<PortElementObject> element;
        std::shared_ptr<PortElementObject> seen;
    };

    void make_guards(ComponentObject& body);
    void make_timers(ComponentObject& body);
    std::shared_ptr<DynamicPortElement> timer_callback(ComponentObject& body) const;
    std::shared_ptr<PortElementObject> element_of(RequiredService::Kind service) const;
    std::shared_ptr<const PortTraces> traces_of(const std::string& port) const;

    const componentId id_;
    const std::shared_ptr<const Implementation> implementation_;
    const Platform& platform_;
    const Demands demands_;
    std::shared_ptr<Executor> own_executor_;
    std::shared_ptr<Guard> guard_;         // of the component
    std::shared_ptr<Guard> active_guard_;  // of the port elements that an active policy manages
    std::shared_ptr<PacedGuard> paced_guard_;  // the same, with a policy of 10.5
    std::unique_ptr<SelfExecution> self_execution_;
    std::shared_ptr<Timers> timers_;  // of both services
    std::shared_ptr<IndexTimers> index_timers_;
    std::shared_ptr<ObjectTimers> object_timers_;
    std::mutex mutex_;
    std::map<std::string, Way> ways_in_;
};

}  // namespace lwucm

#endif
