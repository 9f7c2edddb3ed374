// Guard: how a component's code is entered.
#ifndef LWUCM_SRC_GUARD_HPP
#define LWUCM_SRC_GUARD_HPP

#include <functional>

namespace lwucm {

class Guard {
  public:
    virtual ~Guard() = default;

    /// Has `code` executed and returns when that is done; an exception of `code` leaves here.
    virtual void call(const std::function<void()>& code) = 0;
};

}  // namespace lwucm

#endif
