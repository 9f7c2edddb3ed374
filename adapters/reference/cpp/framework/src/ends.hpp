// End: a port element at the end of a link, as its component's life goes on.
#ifndef LWUCM_SRC_ENDS_HPP
#define LWUCM_SRC_ENDS_HPP

#include <string>
#include <utility>

#include "lwucm/links.hpp"

namespace lwucm {

class Instance;

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
    bool is_sender() const { return role_ == Role::client || role_ == Role::emitter; }

    /// Can its component be started, as far as this end is concerned?
    virtual bool is_usable() const { return true; }

    virtual void starting() {}       // on_startup of the component is next
    virtual void started() {}        // all components of the container have started
    virtual void stopping() {}       // the container is being stopped
    virtual void await_calls() {}    // all ends of the container have been told so
    virtual void shutting_down() {}  // on_shutdown of the component is next
    virtual void left() {}           // it is an end no more

  private:
    Instance& instance_;
    const Role role_;
    const std::string port_;
};

}  // namespace lwucm

#endif
