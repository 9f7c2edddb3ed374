// Door: the way into a component, open in its operational phase.
#ifndef LWUCM_SRC_DOOR_HPP
#define LWUCM_SRC_DOOR_HPP

#include <condition_variable>
#include <mutex>

#include "chain.hpp"

namespace lwucm {

class Door {
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

    /// Scope inside, if the door is open. stop waits for who is inside.
    class Visit {
      public:
        explicit Visit(Door& door) : door_(door), admitted_(door.enter()) {}
        ~Visit() {
            if (admitted_) {
                door_.leave();
            }
        }
        Visit(const Visit&) = delete;
        Visit& operator=(const Visit&) = delete;

        bool admitted() const { return admitted_; }

      private:
        Door& door_;
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

}  // namespace lwucm

#endif
