// What stands before a port element: its traces, and the guard of its component.
#ifndef LWUCM_SRC_INTERCEPTION_HPP
#define LWUCM_SRC_INTERCEPTION_HPP

#include <memory>
#include <string>
#include <vector>

#include "execution/monitor.hpp"
#include "execution/policies.hpp"
#include "lwucm/container.hpp"
#include "platform/platform.hpp"

namespace lwucm {

/// Records the calls of one port element, as policy port_trace asks.
class PortTraces {
  public:
    PortTraces(std::vector<PortTrace> traces, componentId component, const Platform& platform);

    void called(const std::string& method) const { record("call of ", method); }
    void returned(const std::string& method) const;

  private:
    void record(const char* what, const std::string& method) const;

    const std::vector<PortTrace> traces_;
    const std::string component_;
    const std::shared_ptr<TraceLog> log_;
    const Options::PortTrace records_;
};

/// Either of the two may be null.
class Interception final : public Interceptor {
  public:
    Interception(std::shared_ptr<const PortTraces> traces, std::shared_ptr<Guard> guard);

    void call(const std::string& method, const std::function<void()>& code) override;

  private:
    const std::shared_ptr<const PortTraces> traces_;
    const std::shared_ptr<Guard> guard_;
};

/// What others get to see instead of `target`, the port element of that name.
std::shared_ptr<PortElementObject> intercepted(const std::string& port,
                                               const std::shared_ptr<PortElementObject>& target,
                                               const std::shared_ptr<Interceptor>& interceptor,
                                               const Policies& generated);

}  // namespace lwucm

#endif
