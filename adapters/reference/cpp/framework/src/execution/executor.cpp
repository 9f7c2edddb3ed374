#include "execution/executor.hpp"

#include <utility>

namespace lwucm {

namespace {

thread_local const Executor* working_for = nullptr;

}  // namespace

Executor::Executor() : thread_([this] { work(); }) {}

Executor::~Executor() { end(); }

void Executor::execute(const std::function<void()>& code) {
    if (working_for == this) {
        code();
        return;
    }
    Task task(code);
    {
        std::unique_lock<std::mutex> lock(mutex_);
        if (!ended_) {
            tasks_.push_back(&task);
            changed_.notify_one();
            task.finished.wait(lock, [&task] { return task.done; });
        }
    }
    if (task.failure) {
        std::rethrow_exception(std::move(task.failure));
    }
    if (!task.done) {
        code();
    }
}

void Executor::end() {
    {
        std::lock_guard<std::mutex> lock(mutex_);
        ended_ = true;
        changed_.notify_one();
    }
    if (thread_.joinable()) {
        thread_.join();
    }
}

void Executor::work() {
    working_for = this;
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return ended_ || !tasks_.empty(); });
        if (tasks_.empty()) {
            return;
        }
        Task& task = *tasks_.front();
        tasks_.pop_front();
        lock.unlock();
        try {
            const Chain::Joined joined(task.chain);
            task.code();
        } catch (...) {
            task.failure = std::current_exception();
        }
        lock.lock();
        task.done = true;
        task.finished.notify_one();
    }
}

OnExecutor::OnExecutor(std::shared_ptr<Monitor> monitor, std::shared_ptr<Executor> executor)
    : monitor_(std::move(monitor)), executor_(std::move(executor)) {}

void OnExecutor::call(const std::function<void()>& code) {
    if (monitor_->is_inside()) {
        monitor_->call(code);
        return;
    }
    executor_->execute([this, &code] { monitor_->call(code); });
}

}  // namespace lwucm
