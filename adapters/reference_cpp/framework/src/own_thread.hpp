// OwnThread: calls that are executed on a thread of the component (protected_active_component).
#ifndef LWUCM_SRC_OWN_THREAD_HPP
#define LWUCM_SRC_OWN_THREAD_HPP

#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "monitor.hpp"

namespace lwucm {

/// Callers wait for the result. A caller that is inside the component already goes on inside, on the thread it has.
class OwnThread final : public Guard {
  public:
    explicit OwnThread(std::shared_ptr<Monitor> monitor);
    ~OwnThread() override;
    OwnThread(const OwnThread&) = delete;
    OwnThread& operator=(const OwnThread&) = delete;

    void call(const std::function<void()>& code) override;

    /// Ends the thread when it has done what it was given; later calls are executed on their callers' threads.
    void end();

  private:
    struct Task {
        const std::function<void()>& code;
        std::exception_ptr failure;
        bool done;
        std::condition_variable finished;

        explicit Task(const std::function<void()>& to_do) : code(to_do), done(false) {}
    };

    void work();

    const std::shared_ptr<Monitor> monitor_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Task*> tasks_;
    bool ended_ = false;
    std::thread thread_;
};

}  // namespace lwucm

#endif
