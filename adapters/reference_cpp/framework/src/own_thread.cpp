#include "own_thread.hpp"

#include <utility>

namespace lwucm {

OwnThread::OwnThread(std::shared_ptr<Monitor> monitor)
    : monitor_(std::move(monitor)), thread_([this] { work(); }) {}

OwnThread::~OwnThread() { end(); }

void OwnThread::call(const std::function<void()>& code) {
    if (monitor_->is_inside()) {
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
        monitor_->call(code);
    }
}

void OwnThread::end() {
    {
        std::lock_guard<std::mutex> lock(mutex_);
        ended_ = true;
        changed_.notify_one();
    }
    if (thread_.joinable()) {
        thread_.join();
    }
}

void OwnThread::work() {
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
            monitor_->call(task.code);
        } catch (...) {
            task.failure = std::current_exception();
        }
        lock.lock();
        task.done = true;
        task.finished.notify_one();
    }
}

}  // namespace lwucm
