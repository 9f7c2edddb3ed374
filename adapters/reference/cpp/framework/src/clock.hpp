// NodeClock: the clock of the computer that the runtime runs on.
#ifndef LWUCM_SRC_CLOCK_HPP
#define LWUCM_SRC_CLOCK_HPP

#include "lwucm/container_services.hpp"
#include "lwucm/options.hpp"

namespace lwucm {

/// The whole system is one computer, so that its time is the computer's.
class NodeClock final : public clock_service_intf {
  public:
    explicit NodeClock(Options::Clock clock) : clock_(clock) {}

    void get_local_time(ucm_timeval_t& local_time) override;
    void get_synchronized_time(ucm_timeval_t& synchronized_time) override { get_local_time(synchronized_time); }

  private:
    const Options::Clock clock_;
};

}  // namespace lwucm

#endif
