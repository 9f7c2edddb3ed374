// Monitor: one thread at a time inside a component.
#ifndef LWUCM_SRC_MONITOR_HPP
#define LWUCM_SRC_MONITOR_HPP

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

#include "lwucm/policies.hpp"

namespace lwucm {

/// Threads enter in the order in which they came, so that each gets its turn; the thread inside may enter again.
class Monitor final : public Guard {
  public:
    void call(const std::function<void()>& code) override;

    /// Is the calling thread inside?
    bool is_inside();

    /// Is the calling thread inside any component that has a monitor?
    static bool is_inside_any();

  private:
    class Visit;

    void enter();
    void leave();

    std::mutex mutex_;
    std::condition_variable left_;
    std::thread::id inside_;
    int depth_ = 0;
    std::uint64_t next_ticket_ = 0;
    std::uint64_t admitted_ = 0;
};

}  // namespace lwucm

#endif
