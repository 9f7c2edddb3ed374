// Executor: a thread that carries out calls, whose callers wait for the result.
#ifndef LWUCM_SRC_EXECUTOR_HPP
#define LWUCM_SRC_EXECUTOR_HPP

#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "execution/monitor.hpp"

namespace lwucm {

class Executor {
  public:
    Executor();
    ~Executor();
    Executor(const Executor&) = delete;
    Executor& operator=(const Executor&) = delete;

    /// Has `code` executed, in the caller's chain. An exception of `code` leaves here.
    void execute(const std::function<void()>& code);

    /// Ends the thread when it has done what it was given; later calls are executed on their callers' threads.
    void end();

  private:
    struct Task {
        const std::function<void()>& code;
        const Chain::Id chain;
        std::exception_ptr failure;
        bool done;
        std::condition_variable finished;

        explicit Task(const std::function<void()>& to_do) : code(to_do), chain(Chain::current()), done(false) {}
    };

    void work();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Task*> tasks_;
    bool ended_ = false;
    std::thread thread_;
};

/// Enters a component on the thread of an executor. A chain that is inside already, and the executor's own thread, go
/// on where they are.
class OnExecutor final : public Guard {
  public:
    OnExecutor(std::shared_ptr<Monitor> monitor, std::shared_ptr<Executor> executor);

    void call(const std::function<void()>& code) override;

  private:
    const std::shared_ptr<Monitor> monitor_;
    const std::shared_ptr<Executor> executor_;
};

}  // namespace lwucm

#endif
