// End: a port element at the end of a link. Admission: which calls through it reach the component.
#ifndef LWUCM_SRC_ENDS_HPP
#define LWUCM_SRC_ENDS_HPP

#include <condition_variable>
#include <mutex>
#include <string>
#include <utility>

#include "execution/chain.hpp"
#include "lwucm/links.hpp"

namespace lwucm {

class Instance;

/// Admits calls of a component in its operational phase, and counts those that are inside.
class Admission {
  public:
    void open() {
        std::lock_guard<std::mutex> lock(mutex_);
        open_ = true;
    }

    /// No call comes in any more; calls that are inside go on.
    void shut() {
        std::lock_guard<std::mutex> lock(mutex_);
        open_ = false;
    }

    /// Waits until no call is inside.
    void await_leaving() {
        std::unique_lock<std::mutex> lock(mutex_);
        left_.wait(lock, [this] { return inside_ == 0; });
    }

    bool is_open() {
        std::lock_guard<std::mutex> lock(mutex_);
        return open_;
    }

    /// Scope of one call, which is inside if it was admitted. `await_leaving` waits for it.
    class Call {
      public:
        explicit Call(Admission& admission) : admission_(admission), admitted_(admission.enter()) {}
        ~Call() {
            if (admitted_) {
                admission_.leave();
            }
        }
        Call(const Call&) = delete;
        Call& operator=(const Call&) = delete;

        bool admitted() const { return admitted_; }

      private:
        Admission& admission_;
        const bool admitted_;
        const Awaited awaited_;
    };

  private:
    bool enter() {
        std::lock_guard<std::mutex> lock(mutex_);
        inside_ += open_ ? 1 : 0;
        return open_;
    }

    void leave() {
        std::lock_guard<std::mutex> lock(mutex_);
        if (--inside_ == 0) {
            left_.notify_all();
        }
    }

    std::mutex mutex_;
    std::condition_variable left_;
    bool open_ = false;
    int inside_ = 0;
};

/// Is it an end that requires its port element?
inline bool is_sender(Role role) { return role == Role::client || role == Role::emitter; }

/// The operations are called one at a time, in this order, and again from the first one on.
class End {
  public:
    End(Instance& instance, Role role, std::string port) : instance_(instance), role_(role), port_(std::move(port)) {}
    virtual ~End() = default;
    End(const End&) = delete;
    End& operator=(const End&) = delete;

    Instance& instance() const { return instance_; }
    Role role() const { return role_; }
    const std::string& port() const { return port_; }
    bool is_sender() const { return lwucm::is_sender(role_); }

    /// Can its component be started, as far as this end is concerned?
    virtual bool is_usable() const { return true; }

    virtual void starting() {}       // on_startup of the component is next
    virtual void started() {}        // all components of the container have started
    virtual void stopping() {}       // the container is being stopped
    virtual void await_calls() {}    // `stopping` of all ends of the container has returned
    virtual void shutting_down() {}  // on_shutdown of the component is next
    virtual void left() {}           // it is no longer an end of the link

  private:
    Instance& instance_;
    const Role role_;
    const std::string port_;
};

}  // namespace lwucm

#endif
