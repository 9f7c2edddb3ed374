#include "execution/self_execution.hpp"

#include <chrono>
#include <utility>

namespace lwucm {

SelfExecution::SelfExecution(std::shared_ptr<component_execution_intf> component, std::shared_ptr<Guard> guard)
    : component_(std::move(component)), guard_(std::move(guard)) {}

SelfExecution::~SelfExecution() { end(); }

void SelfExecution::begin() {
    ending_ = false;
    thread_ = std::thread([this] { work(); });
}

void SelfExecution::end() {
    {
        std::lock_guard<std::mutex> lock(mutex_);
        ending_ = true;
        changed_.notify_one();
    }
    if (thread_.joinable()) {
        thread_.join();
    }
}

void SelfExecution::run() {
    try {
        guard_->call([this] { component_->run(); });
    } catch (...) {  // there is no caller to pass it to
    }
}

void SelfExecution::work() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (!ending_) {
        lock.unlock();
        run();
        lock.lock();
        changed_.wait_for(lock, std::chrono::milliseconds(2), [this] { return ending_; });
    }
}

}  // namespace lwucm
