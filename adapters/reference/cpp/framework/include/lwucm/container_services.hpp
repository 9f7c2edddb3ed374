// The clock and the trace that containers provide to components (10.1.4, 12.11.2).
#ifndef LWUCM_CONTAINER_SERVICES_HPP
#define LWUCM_CONTAINER_SERVICES_HPP

#include <cstdint>
#include <string>

#include "lwucm/interfaces.hpp"

namespace lwucm {

/// Seconds and microseconds; the seconds begin anew after 2^32.
struct ucm_timeval_t {
    std::uint32_t utv_sec;
    std::int32_t utv_usec;
};

/// What a component requires by policy `clock`. May be called at any time from any thread.
class clock_service_intf : public DynamicPortElement {
  public:
    virtual void get_local_time(ucm_timeval_t& local_time) = 0;
    virtual void get_synchronized_time(ucm_timeval_t& synchronized_time) = 0;

    const InterfacePtr& get_interface() const final;
    Values call(const std::string& method, const Values& arguments) final;
};

enum class log_severity_t : std::uint32_t { trace, debug, info, warning, error, critical };

/// The enumerator's name, and the other way round: false if there is none of that name.
const std::string& name_of(log_severity_t severity);
bool find_severity(const std::string& name, log_severity_t& severity);

/// What a component requires by policy `component_trace`. May be called at any time from any thread.
class trace_service_intf : public DynamicPortElement {
  public:
    virtual void log(log_severity_t severity, const std::u32string& message) = 0;

    const InterfacePtr& get_interface() const final;
    Values call(const std::string& method, const Values& arguments) final;
};

/// What has been logged, by a component or by policy `port_trace`.
struct LogRecord {
    log_severity_t severity;
    std::u32string message;
};

}  // namespace lwucm

#endif
