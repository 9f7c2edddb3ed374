// SelfExecution: triggers a component that executes by itself (protected_self-executing_component).
#ifndef LWUCM_SRC_SELF_EXECUTION_HPP
#define LWUCM_SRC_SELF_EXECUTION_HPP

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "execution/monitor.hpp"
#include "lwucm/policies.hpp"

namespace lwucm {

/// Between `begin` and `end` a thread calls run(), at once and again 2 ms after it came back, however it came back.
class SelfExecution {
  public:
    SelfExecution(std::shared_ptr<component_execution_intf> component, std::shared_ptr<Guard> guard);
    virtual ~SelfExecution();
    SelfExecution(const SelfExecution&) = delete;
    SelfExecution& operator=(const SelfExecution&) = delete;

    virtual void begin();

    /// Waits for the run() that is under way.
    virtual void end();

  protected:
    /// What the thread does.
    virtual void work();

    /// Once, however it comes back.
    void run();

    const std::shared_ptr<component_execution_intf> component_;
    const std::shared_ptr<Guard> guard_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool ending_ = false;
    std::thread thread_;
};

}  // namespace lwucm

#endif
