// Index timers (10.3.2): the service by which a component sets its timers by number.
#ifndef LWUCM_SRC_INDEX_TIMERS_HPP
#define LWUCM_SRC_INDEX_TIMERS_HPP

#include <chrono>
#include <memory>

#include "execution/timers.hpp"
#include "lwucm/container_services.hpp"
#include "lwucm/timers.hpp"

namespace lwucm {

class IndexTimers final : public itt_service_intf {
  public:
    /// Dates are those of `clock`.
    IndexTimers(std::shared_ptr<Timers> timers, std::shared_ptr<DynamicPortElement> callback,
                std::shared_ptr<clock_service_intf> clock);

    // A number that is in use stays as it is. While `timers` sets none, nothing happens. The flag of a rate has no meaning.
    void start_periodic_scheduler(timer_number_t timer_number, const timeout_t& delay_time,
                                  const timeout_t& rate) override;
    void start_sporadic_scheduler(timer_number_t timer_number, const timeout_t& time) override;
    void cancel_timer(timer_number_t timer_number) override;

    /// Does no timer of that number wait?
    bool is_canceled(timer_number_t timer_number) override;

    /// Lets go of the component. `timers` has ended for good.
    void close() { callback_ = nullptr; }

  private:
    class Expiring;

    void set(timer_number_t number, const timeout_t& time, std::chrono::seconds rate);

    const std::shared_ptr<Timers> timers_;
    std::shared_ptr<DynamicPortElement> callback_;
    const std::shared_ptr<clock_service_intf> clock_;
};

}  // namespace lwucm

#endif
