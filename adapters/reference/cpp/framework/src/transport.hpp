// Transport: what the two sides of a connector have between them. Bytes get through in memory, so all that can happen
// to them is what somebody does to the transport on purpose.
#ifndef LWUCM_SRC_TRANSPORT_HPP
#define LWUCM_SRC_TRANSPORT_HPP

#include <condition_variable>
#include <functional>
#include <mutex>

namespace lwucm {

enum class Condition { sound, transport_broken, connector_broken };

class Transport {
  public:
    void become(Condition condition) {
        std::lock_guard<std::mutex> lock(mutex_);
        condition_ = condition;
        changed_.notify_all();
    }

    Condition condition() {
        std::lock_guard<std::mutex> lock(mutex_);
        return condition_;
    }

    /// Waits until it is sound, or `given_up` has become true, which is looked at after each `reconsider`. Is it sound?
    bool await_sound(const std::function<bool()>& given_up) {
        std::unique_lock<std::mutex> lock(mutex_);
        changed_.wait(lock, [this, &given_up] { return condition_ == Condition::sound || given_up(); });
        return condition_ == Condition::sound;
    }

    void reconsider() {
        std::lock_guard<std::mutex> lock(mutex_);
        changed_.notify_all();
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    Condition condition_ = Condition::sound;
};

}  // namespace lwucm

#endif
