#include "virtual_time.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>

#include <algorithm>

#include "real.hpp"

namespace ucm_cts {
namespace virtual_time {

namespace {

/// After so much real time in which no thread began or ended to wait, the earliest moment comes although a thread runs. That
/// thread may wait for something that is not known here, or in a loop.
const timespec PATIENCE = {1, 0};

Real<int(pthread_mutex_t*)> real_lock("pthread_mutex_lock");

/// What the calling thread does: a signal handler sees it.
__attribute__((tls_model("initial-exec"))) thread_local bool holds_lock = false;
__attribute__((tls_model("initial-exec"))) thread_local bool is_parked = false;

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
    if (!has_begun_.exchange(true)) {
        now_ += real_time(CLOCK_MONOTONIC);
        calendar_ahead();
        real_syscall(SYS_gettid);  // is looked up now, and not while threads are locked out
    }
}

Nanoseconds VirtualTime::read() {
    pass(READING);
    return now_.load();
}

void VirtualTime::pass(Nanoseconds duration) {
    if (!has_begun_.load()) {
        begin();
    }
    if (waking_.load() > 0) {
        return;
    }
    if (now_.fetch_add(duration) + duration < earliest_.load() || holds_lock) {
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
    if (holds_lock || is_parked) {  // in a signal handler
        const Nanoseconds left = std::max(moment - now_.load(), Nanoseconds(0));
        const timespec duration = {left / SECOND, left % SECOND};
        real_clock_nanosleep(CLOCK_MONOTONIC, 0, &duration, nullptr);
        return;
    }
    lock();
    Waiter waiter(nullptr, moment);
    park(waiter);
    unlock();
}

void VirtualTime::lock() {
    holds_lock = true;  // a little before it does, and a little longer
    real_lock(&mutex_);
}

void VirtualTime::unlock() {
    if (is_given_back_by_handler_.exchange(false)) {
        for (Waiter* waiter = first_; waiter != nullptr;) {
            Waiter* const next = waiter->after;
            if (waiter->key != nullptr) {
                wake_one(*waiter, false);
            }
            waiter = next;
        }
    }
    real_unlock(&mutex_);
    holds_lock = false;
}

void VirtualTime::given_back(const void* key, int most) {
    std::atomic_thread_fence(std::memory_order_seq_cst);
    if (contenders_.load() == 0) {
        return;
    }
    if (holds_lock) {  // in a signal handler
        is_given_back_by_handler_ = true;
        return;
    }
    lock();
    wake(key, most);
    unlock();
}

void VirtualTime::park(Waiter& waiter) {
    if (waiter.moment <= now_.load()) {
        waiter.is_over = waiter.is_late = true;
        if (waking_.load() == 0) {
            now_ += READING;  // so that who asks again and again comes to an end
        }
        return;
    }
    const int error = errno;
    waiter.before = last_;
    (last_ != nullptr ? last_->after : first_) = &waiter;
    last_ = &waiter;
    note_earliest();
    --running_;
    go_on();
    std::uint64_t seen = ++changes_;
    is_parked = true;
    unlock();
    while (waiter.awake.load() == 0) {
        const bool is_timed = waiter.moment != NEVER;
        const long result = real_syscall(SYS_futex, &waiter.awake, FUTEX_WAIT_PRIVATE, 0, is_timed ? &PATIENCE : nullptr, nullptr, 0);
        if (is_timed && result < 0 && errno == ETIMEDOUT) {
            lock();
            if (seen == changes_ && !waiter.is_over && earliest() == &waiter) {
                advance_to(waiter.moment);
                wake_one(waiter, true);
            }
            seen = changes_;
            unlock();
        }
    }
    lock();
    is_parked = false;
    --waking_;
    errno = error;
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
    holds_lock = is_parked = false;
}

void VirtualTime::advance_to(Nanoseconds moment) {
    Nanoseconds now = now_.load();
    while (now < moment && !now_.compare_exchange_weak(now, moment)) {
    }
}

void VirtualTime::go_on() {
    // running_ is negative while a thread that no longer counts, since its work has ended, waits in a destructor
    while (running_ <= 0 && earliest_.load() != NEVER) {
        Waiter* const waiter = earliest();
        advance_to(waiter->moment);
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
