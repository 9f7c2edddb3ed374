#include "virtual_time.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>

#include <algorithm>

#include "real.hpp"

namespace ucm_cts {
namespace virtual_time {

namespace {

/// So long a thread that waits for a moment waits while another one runs: that one may wait for something that is not known here,
/// or in a loop.
const timespec PATIENCE = {1, 0};

Real<int(clockid_t, timespec*)> real_clock_gettime("clock_gettime");
Real<int(pthread_mutex_t*)> real_lock("pthread_mutex_lock");
Real<int(pthread_mutex_t*)> real_unlock("pthread_mutex_unlock");
Real<long(long, ...)> real_syscall("syscall");

Nanoseconds real_time(clockid_t clock) {
    timespec time;
    real_clock_gettime(clock, &time);
    return in_nanoseconds(time);
}

/// By how much the calendar's clock is ahead of the monotonic one.
Nanoseconds calendar_ahead() {
    static std::atomic<Nanoseconds> known{0};
    if (known.load() == 0) {
        Nanoseconds none = 0;
        known.compare_exchange_strong(none, real_time(CLOCK_REALTIME) - real_time(CLOCK_MONOTONIC));
    }
    return known.load();
}

}  // namespace

VirtualTime process_time;

void VirtualTime::begin() {
    now_ += real_time(CLOCK_MONOTONIC);
    calendar_ahead();
}

Nanoseconds VirtualTime::read() {
    pass(READING);
    return now_.load();
}

void VirtualTime::pass(Nanoseconds duration) {
    if (waking_.load() > 0) {
        return;
    }
    if (now_.fetch_add(duration) + duration < earliest_.load()) {
        return;
    }
    lock();
    Waiter* const waiter = earliest();
    if (waking_.load() == 0 && waiter != nullptr && waiter->moment <= now_.load()) {
        wake_one(*waiter, true);
    }
    unlock();
}

void VirtualTime::sleep_until(Nanoseconds moment) {
    lock();
    Waiter waiter(nullptr, moment);
    park(waiter);
    unlock();
}

void VirtualTime::lock() { real_lock(&mutex_); }

void VirtualTime::unlock() { real_unlock(&mutex_); }

void VirtualTime::park(Waiter& waiter) {
    waiter.before = last_;
    (last_ != nullptr ? last_->after : first_) = &waiter;
    last_ = &waiter;
    note_earliest();
    --running_;
    go_on();
    std::uint64_t seen = ++changes_;
    unlock();
    while (waiter.awake.load() == 0) {
        const bool is_timed = waiter.moment != NEVER;
        const long result = real_syscall(SYS_futex, &waiter.awake, FUTEX_WAIT_PRIVATE, 0, is_timed ? &PATIENCE : nullptr, nullptr, 0);
        if (is_timed && result < 0 && errno == ETIMEDOUT) {
            lock();
            if (seen == changes_ && !waiter.is_over && earliest() == &waiter) {
                now_ = std::max(now_.load(), waiter.moment);
                wake_one(waiter, true);
            }
            seen = changes_;
            unlock();
        }
    }
    lock();
    --waking_;
}

int VirtualTime::wake(const void* key, int most) {
    const bool is_calm = waking_.load() == 0;
    int woken = 0;
    for (Waiter* waiter = first_; waiter != nullptr && woken < most;) {
        Waiter* const next = waiter->after;
        if (waiter->key == key) {
            wake_one(*waiter, false);
            ++woken;
        }
        waiter = next;
    }
    if (woken > 0 && is_calm) {
        now_ += READING;
    }
    return woken;
}

void VirtualTime::begin_thread() {
    lock();
    ++running_;
    unlock();
}

void VirtualTime::end_thread() {
    lock();
    --running_;
    go_on();
    unlock();
}

void VirtualTime::forget_threads() {
    const pthread_mutex_t fresh = PTHREAD_MUTEX_INITIALIZER;
    mutex_ = fresh;
    running_ = 1;
    waking_ = 0;
    contenders_ = 0;
    earliest_ = NEVER;
    first_ = last_ = nullptr;
}

void VirtualTime::go_on() {
    while (running_ <= 0 && earliest_.load() != NEVER) {  // less than none: a thread that has ended still cleans up
        Waiter* const waiter = earliest();
        now_ = std::max(now_.load(), waiter->moment);
        wake_one(*waiter, true);
    }
}

Waiter* VirtualTime::earliest() const {
    Waiter* found = nullptr;
    for (Waiter* waiter = first_; waiter != nullptr; waiter = waiter->after) {
        if (waiter->moment != NEVER && (found == nullptr || waiter->moment < found->moment)) {
            found = waiter;
        }
    }
    return found;
}

void VirtualTime::wake_one(Waiter& waiter, bool is_late) {
    (waiter.before != nullptr ? waiter.before->after : first_) = waiter.after;
    (waiter.after != nullptr ? waiter.after->before : last_) = waiter.before;
    waiter.is_over = true;
    waiter.is_late = is_late;
    ++running_;
    ++waking_;
    ++changes_;
    note_earliest();
    waiter.awake.store(1);  // from here on it may be gone
    real_syscall(SYS_futex, &waiter.awake, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0);
}

void VirtualTime::note_earliest() {
    const Waiter* const waiter = earliest();
    earliest_ = waiter != nullptr ? waiter->moment : NEVER;
}

bool is_virtual(clockid_t clock, Nanoseconds& ahead) {
    switch (clock) {
        case CLOCK_MONOTONIC:
        case CLOCK_MONOTONIC_RAW:
        case CLOCK_MONOTONIC_COARSE:
        case CLOCK_BOOTTIME:
            ahead = 0;
            return true;
        case CLOCK_REALTIME:
        case CLOCK_REALTIME_COARSE:
        case CLOCK_TAI:
            ahead = calendar_ahead();
            return true;
        default:  // the processor time of a process or thread
            return false;
    }
}

Nanoseconds on_monotonic_clock(clockid_t clock, const timespec& moment) {
    Nanoseconds ahead = 0;
    is_virtual(clock, ahead);
    const Nanoseconds there = in_nanoseconds(moment);
    return there == NEVER ? NEVER : there - ahead;
}

}  // namespace virtual_time
}  // namespace ucm_cts
