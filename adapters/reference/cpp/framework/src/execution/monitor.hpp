// Guard: how a component's code is entered. Monitor: one chain of calls at a time inside a component.
#ifndef LWUCM_SRC_MONITOR_HPP
#define LWUCM_SRC_MONITOR_HPP

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>

#include "execution/chain.hpp"

namespace lwucm {

class Guard {
  public:
    virtual ~Guard() = default;

    /// Has `code` executed and returns when that is done; an exception of `code` leaves here.
    virtual void call(const std::function<void()>& code) = 0;
};

/// Chains enter in the order in which they came, so that each gets its turn; the one inside may enter again.
class Monitor : public Guard {
  public:
    void call(const std::function<void()>& code) override;

    /// Is the calling thread's chain inside?
    virtual bool is_inside();

  protected:
    virtual void enter();
    virtual void leave();

  private:
    class Visit;

    std::mutex mutex_;
    std::condition_variable left_;
    Chain::Id inside_ = nullptr;
    int depth_ = 0;
    std::uint64_t next_ticket_ = 0;
    std::uint64_t admitted_ = 0;
};

}  // namespace lwucm

#endif
