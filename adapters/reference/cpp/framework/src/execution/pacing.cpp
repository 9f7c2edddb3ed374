#include "execution/pacing.hpp"

#include <utility>

#include "lwucm/errors.hpp"

namespace lwucm {

PacedSelfExecution::PacedSelfExecution(std::shared_ptr<component_execution_intf> component,
                                       std::shared_ptr<Guard> guard, const Pacing& pacing)
    : SelfExecution(std::move(component), std::move(guard)), pacing_(pacing) {}

PacedSelfExecution::~PacedSelfExecution() { end(); }

void PacedSelfExecution::work() {
    auto due = std::chrono::steady_clock::now() + pacing_.offset;
    std::unique_lock<std::mutex> lock(mutex_);
    while (!changed_.wait_until(lock, due, [this] { return ending_; })) {
        lock.unlock();
        run();
        lock.lock();
        if (pacing_.kind == Pacing::Kind::background) {
            return;
        }
        const auto now = std::chrono::steady_clock::now();
        do {
            due += pacing_.period;
        } while (due < now);
    }
}

PacedGuard::PacedGuard(std::shared_ptr<Monitor> monitor, std::shared_ptr<Guard> inner, const Pacing& pacing)
    : monitor_(std::move(monitor)), inner_(std::move(inner)), pacing_(pacing) {}

void PacedGuard::call(const std::function<void()>& code) {
    if (monitor_->is_inside()) {
        monitor_->call(code);
        return;
    }
    std::unique_lock<std::mutex> lock(mutex_);
    if (pacing_.kind == Pacing::Kind::sporadic) {
        execute_in_turn(lock, code);
        return;
    }
    const std::uint64_t phase = phase_;
    await_instant(lock);
    lock.unlock();
    enter(phase, code);
}

void PacedGuard::enter(std::uint64_t phase, const std::function<void()>& code) {
    inner_->call([&] {
        {
            std::lock_guard<std::mutex> lock(mutex_);
            if (is_over(phase)) {  // it was stopped before the component was free
                throw UCM_ERROR("the component is not operational");
            }
        }
        code();
    });
}

bool PacedGuard::is_over(std::uint64_t phase) const { return !operational_ || phase_ != phase; }

void PacedGuard::begin() {
    std::lock_guard<std::mutex> lock(mutex_);
    operational_ = true;
    ++phase_;
    first_ = Clock::now() + pacing_.offset;
    free_from_ = Clock::time_point();
    admitted_ = next_ticket_;
}

void PacedGuard::end() {
    std::lock_guard<std::mutex> lock(mutex_);
    operational_ = false;
    changed_.notify_all();
}

void PacedGuard::await(std::unique_lock<std::mutex>& lock, Clock::time_point moment) {
    const std::uint64_t phase = phase_;
    if (is_over(phase) || changed_.wait_until(lock, moment, [&] { return is_over(phase); })) {
        throw UCM_ERROR("the component is not operational");
    }
}

void PacedGuard::await_instant(std::unique_lock<std::mutex>& lock) {
    const Clock::time_point asked = Clock::now();
    Clock::time_point instant = first_;
    if (asked > first_) {
        instant += (asked - first_ + pacing_.period - Clock::duration(1)) / pacing_.period * pacing_.period;
    }
    await(lock, instant);
}

void PacedGuard::execute_in_turn(std::unique_lock<std::mutex>& lock, const std::function<void()>& code) {
    const std::uint64_t phase = phase_;
    const std::uint64_t ticket = next_ticket_++;
    changed_.wait(lock, [&] { return is_over(phase) || ticket == admitted_; });
    if (is_over(phase)) {
        throw UCM_ERROR("the component is not operational");
    }
    await(lock, free_from_);
    lock.unlock();
    const auto leave = [&] {
        lock.lock();
        if (phase_ == phase) {
            free_from_ = Clock::now() + pacing_.period;
            ++admitted_;
        }
        changed_.notify_all();
    };
    try {
        enter(phase, code);
    } catch (...) {
        leave();
        throw;
    }
    leave();
}

}  // namespace lwucm
