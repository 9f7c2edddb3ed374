// Lane: calls that come to a component without anybody waiting for them, one after the other on a thread of their own.
#ifndef LWUCM_SRC_LANE_HPP
#define LWUCM_SRC_LANE_HPP

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

namespace lwucm {

/// Carries calls out in the order in which they were put in, while it is open. Exceptions that they throw are dropped.
class Lane {
  public:
    Lane() = default;
    ~Lane() { end(); }
    Lane(const Lane&) = delete;
    Lane& operator=(const Lane&) = delete;

    void open() {
        std::lock_guard<std::mutex> lock(mutex_);
        open_ = true;
    }

    /// A call that is put in while it is not open is forgotten.
    void put(std::function<void()> call) {
        std::lock_guard<std::mutex> lock(mutex_);
        if (!open_ || ended_) {
            return;
        }
        calls_.push_back(std::move(call));
        if (!thread_.joinable()) {
            thread_ = std::thread([this] { work(); });
        }
        changed_.notify_one();
    }

    /// Forgets what waits; what is being carried out goes on.
    void shut() {
        std::lock_guard<std::mutex> lock(mutex_);
        open_ = false;
        calls_.clear();
    }

    /// Waits until nothing is being carried out.
    void await_calls() {
        std::unique_lock<std::mutex> lock(mutex_);
        done_.wait(lock, [this] { return !busy_; });
    }

    /// Ends the thread. Nothing is being carried out, or it ends soon.
    void end() {
        {
            std::lock_guard<std::mutex> lock(mutex_);
            ended_ = true;
            calls_.clear();
            changed_.notify_one();
        }
        if (thread_.joinable() && thread_.get_id() != std::this_thread::get_id()) {
            thread_.join();
        }
    }

  private:
    void work() {
        std::unique_lock<std::mutex> lock(mutex_);
        while (true) {
            changed_.wait(lock, [this] { return ended_ || !calls_.empty(); });
            if (ended_) {
                return;
            }
            const std::function<void()> call = std::move(calls_.front());
            calls_.pop_front();
            busy_ = true;
            lock.unlock();
            try {
                call();
            } catch (...) {  // nobody waits for it
            }
            lock.lock();
            busy_ = false;
            done_.notify_all();
        }
    }

    std::mutex mutex_;
    std::condition_variable changed_;  // there is something to do
    std::condition_variable done_;     // a call has been carried out
    std::deque<std::function<void()>> calls_;
    std::thread thread_;
    bool open_ = false;
    bool busy_ = false;
    bool ended_ = false;
};

}  // namespace lwucm

#endif
