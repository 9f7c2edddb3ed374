#include "self_execution.hpp"

#include <chrono>
#include <utility>

namespace lwucm {

SelfExecution::SelfExecution(std::shared_ptr<component_execution_intf> component, std::shared_ptr<Monitor> monitor)
    : component_(std::move(component)), monitor_(std::move(monitor)) {}

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

void SelfExecution::work() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (!ending_) {
        lock.unlock();
        try {
            monitor_->call([this] { component_->run(); });
        } catch (...) {  // nobody called it who could be told
        }
        lock.lock();
        changed_.wait_for(lock, std::chrono::milliseconds(2), [this] { return ending_; });
    }
}

}  // namespace lwucm
