// Condition variables, and the futexes of C++'s atomics, futures, latches and semaphores, in virtual time.
#include <errno.h>
#include <linux/futex.h>
#include <pthread.h>
#include <stdarg.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <climits>

#include "real.hpp"
#include "virtual_time.hpp"

namespace time_of = ucm_cts::virtual_time;
using time_of::Nanoseconds;
using time_of::NEVER;
using time_of::process_time;

namespace {

int wait(pthread_cond_t* condition, pthread_mutex_t* mutex, Nanoseconds moment) {
    process_time.lock();
    const int problem = time_of::real_unlock(mutex);
    if (problem != 0) {
        process_time.unlock();
        return problem;
    }
    process_time.wake(mutex, 1);
    time_of::Waiter waiter(condition, moment);
    process_time.park(waiter);
    process_time.unlock();
    const int result = pthread_mutex_lock(mutex);
    return result == 0 && waiter.is_late ? ETIMEDOUT : result;
}

int signal(pthread_cond_t* condition, int most) {
    process_time.lock();
    process_time.wake(condition, most);
    process_time.unlock();
    return 0;
}

/// The clock of the condition's moments, as the C library noted it when the condition was made.
clockid_t clock_of(const pthread_cond_t* condition) {
    return (condition->__data.__wrefs & 2) != 0 ? CLOCK_MONOTONIC : CLOCK_REALTIME;
}

long fail(int error) {
    errno = error;
    return -1;
}

long wait(const int* address, int operation, int expected, const timespec* timeout) {
    Nanoseconds moment = NEVER;
    if (timeout != nullptr) {
        if (!time_of::is_time(*timeout)) {
            return fail(EINVAL);
        }
        const bool is_calendar = (operation & FUTEX_CLOCK_REALTIME) != 0;
        moment = (operation & FUTEX_CMD_MASK) == FUTEX_WAIT
                     ? time_of::after(process_time.read(), time_of::in_nanoseconds(*timeout))
                     : time_of::on_monotonic_clock(is_calendar ? CLOCK_REALTIME : CLOCK_MONOTONIC, *timeout);
    }
    process_time.lock();
    if (__atomic_load_n(address, __ATOMIC_SEQ_CST) != expected) {
        process_time.unlock();
        return fail(EAGAIN);
    }
    time_of::Waiter waiter(address, moment);
    process_time.park(waiter);
    process_time.unlock();
    return waiter.is_late ? fail(ETIMEDOUT) : 0;
}

long wake(const int* address, int operation, int most, long set) {
    process_time.lock();
    const int woken = process_time.wake(address, most);
    process_time.unlock();
    return woken + time_of::real_syscall(SYS_futex, address, operation, most - woken, nullptr, nullptr, set);  // who waits there
}

}  // namespace

extern "C" {

int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) { return wait(condition, mutex, NEVER); }

int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock, const timespec* moment) {
    return time_of::is_time(*moment) ? wait(condition, mutex, time_of::on_monotonic_clock(clock, *moment)) : EINVAL;
}

int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex, const timespec* moment) {
    return pthread_cond_clockwait(condition, mutex, clock_of(condition), moment);
}

int pthread_cond_signal(pthread_cond_t* condition) noexcept { return signal(condition, 1); }

int pthread_cond_broadcast(pthread_cond_t* condition) noexcept { return signal(condition, INT_MAX); }

long syscall(long number, ...) noexcept {
    va_list arguments;
    va_start(arguments, number);
    long given[6];
    for (long& one : given) {
        one = va_arg(arguments, long);
    }
    va_end(arguments);
    if (number == SYS_futex) {
        const int* const address = reinterpret_cast<const int*>(given[0]);
        const int operation = static_cast<int>(given[1]);
        switch (operation & FUTEX_CMD_MASK) {
            case FUTEX_WAIT:
            case FUTEX_WAIT_BITSET:
                return wait(address, operation, static_cast<int>(given[2]), reinterpret_cast<const timespec*>(given[3]));
            case FUTEX_WAKE:
            case FUTEX_WAKE_BITSET:
                return wake(address, operation, static_cast<int>(given[2]), given[5]);
            default:
                break;
        }
    }
    return time_of::real_syscall(number, given[0], given[1], given[2], given[3], given[4], given[5]);
}

}  // extern "C"
