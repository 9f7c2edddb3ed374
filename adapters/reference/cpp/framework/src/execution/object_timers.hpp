// Object timers (10.3.1): the scheduler by which a component gets its timers.
#ifndef LWUCM_SRC_OBJECT_TIMERS_HPP
#define LWUCM_SRC_OBJECT_TIMERS_HPP

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "execution/timers.hpp"
#include "lwucm/container.hpp"
#include "lwucm/timers.hpp"

namespace lwucm {

class ObjectTimers final : public ott_scheduler {
  public:
    /// `component` is whose timers they are.
    ObjectTimers(std::shared_ptr<Timers> timers, componentId component);

    std::shared_ptr<ott_timer> scheduler_trigger(const std::shared_ptr<ott_handler>& trigger_handler,
                                                 const ucm_timeval_t& trigger_delay) override;
    std::shared_ptr<ott_timer> schedule_repeated_trigger(const std::shared_ptr<ott_handler>& trigger_handler,
                                                         const ucm_timeval_t& start_delay,
                                                         const ucm_timeval_t& interval,
                                                         ott_round_t max_rounds) override;

  private:
    class Handle;
    class Expiring;

    std::shared_ptr<ott_timer> make(const std::shared_ptr<ott_handler>& handler, const ucm_timeval_t& delay,
                                    std::chrono::microseconds interval, ott_round_t rounds);

    const std::shared_ptr<Timers> timers_;
    const componentId component_;
    std::atomic<std::uint64_t> last_number_;
};

}  // namespace lwucm

#endif
