// Mutexes, read-write locks and semaphores, in virtual time. The system's own are held and given back; only the waiting is replaced.
#include <errno.h>
#include <pthread.h>
#include <semaphore.h>
#include <unistd.h>

#include <climits>

#include "real.hpp"
#include "virtual_time.hpp"

namespace time_of = ucm_cts::virtual_time;
using time_of::Nanoseconds;
using time_of::NEVER;
using time_of::on_monotonic_clock;
using time_of::process_time;

namespace {

time_of::Real<int(pthread_mutex_t*)> try_mutex("pthread_mutex_trylock");
time_of::Real<int(pthread_rwlock_t*)> try_to_read("pthread_rwlock_tryrdlock");
time_of::Real<int(pthread_rwlock_t*)> try_to_write("pthread_rwlock_trywrlock");
time_of::Real<int(pthread_rwlock_t*)> unlock_rwlock("pthread_rwlock_unlock");
time_of::Real<int(sem_t*)> try_semaphore("sem_trywait");
time_of::Real<int(sem_t*)> post_semaphore("sem_post");

/// `result`, or EDEADLK where the C library would say so because the calling thread is `owner`.
int or_deadlock(int result, int owner) { return result == EBUSY && owner == gettid() ? EDEADLK : result; }

int get(pthread_mutex_t* mutex, Nanoseconds moment) {
    return process_time.obtain(mutex, moment, [mutex] {
        const int result = try_mutex(mutex);
        const bool is_checked = (mutex->__data.__kind & 3) == PTHREAD_MUTEX_ERRORCHECK;
        return is_checked ? or_deadlock(result, mutex->__data.__owner) : result;
    });
}

int get_to_read(pthread_rwlock_t* lock, Nanoseconds moment) {
    return process_time.obtain(lock, moment,
                               [lock] { return or_deadlock(try_to_read(lock), lock->__data.__cur_writer); });
}

int get_to_write(pthread_rwlock_t* lock, Nanoseconds moment) {
    return process_time.obtain(lock, moment,
                               [lock] { return or_deadlock(try_to_write(lock), lock->__data.__cur_writer); });
}

int get(sem_t* semaphore, Nanoseconds moment) {
    const int result = process_time.obtain(
        semaphore, moment, [semaphore] { return try_semaphore(semaphore) == 0 ? 0 : errno == EAGAIN ? EBUSY : errno; });
    if (result != 0) {
        errno = result;
    }
    return result != 0 ? -1 : 0;
}

/// Calls `wait` with the moment on the monotonic clock, if `moment` is one.
template <class Wait>
int until(clockid_t clock, const timespec* moment, Wait wait) {
    return time_of::is_time(*moment) ? wait(on_monotonic_clock(clock, *moment)) : EINVAL;
}

}  // namespace

extern "C" {

int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept { return get(mutex, NEVER); }

int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock, const timespec* moment) noexcept {
    return until(clock, moment, [mutex](Nanoseconds then) { return get(mutex, then); });
}

int pthread_mutex_timedlock(pthread_mutex_t* mutex, const timespec* moment) noexcept {
    return pthread_mutex_clocklock(mutex, CLOCK_REALTIME, moment);
}

int pthread_mutex_trylock(pthread_mutex_t* mutex) noexcept {
    process_time.pass(time_of::ACQUIRING);
    return try_mutex(mutex);
}

int pthread_mutex_unlock(pthread_mutex_t* mutex) noexcept {
    const int result = time_of::real_unlock(mutex);
    process_time.given_back(mutex, 1);
    return result;
}

int pthread_rwlock_rdlock(pthread_rwlock_t* lock) noexcept { return get_to_read(lock, NEVER); }

int pthread_rwlock_wrlock(pthread_rwlock_t* lock) noexcept { return get_to_write(lock, NEVER); }

int pthread_rwlock_clockrdlock(pthread_rwlock_t* lock, clockid_t clock, const timespec* moment) noexcept {
    return until(clock, moment, [lock](Nanoseconds then) { return get_to_read(lock, then); });
}

int pthread_rwlock_clockwrlock(pthread_rwlock_t* lock, clockid_t clock, const timespec* moment) noexcept {
    return until(clock, moment, [lock](Nanoseconds then) { return get_to_write(lock, then); });
}

int pthread_rwlock_timedrdlock(pthread_rwlock_t* lock, const timespec* moment) noexcept {
    return pthread_rwlock_clockrdlock(lock, CLOCK_REALTIME, moment);
}

int pthread_rwlock_timedwrlock(pthread_rwlock_t* lock, const timespec* moment) noexcept {
    return pthread_rwlock_clockwrlock(lock, CLOCK_REALTIME, moment);
}

int pthread_rwlock_tryrdlock(pthread_rwlock_t* lock) noexcept {
    process_time.pass(time_of::ACQUIRING);
    return try_to_read(lock);
}

int pthread_rwlock_trywrlock(pthread_rwlock_t* lock) noexcept {
    process_time.pass(time_of::ACQUIRING);
    return try_to_write(lock);
}

int pthread_rwlock_unlock(pthread_rwlock_t* lock) noexcept {
    const int result = unlock_rwlock(lock);
    process_time.given_back(lock, INT_MAX);
    return result;
}

int sem_wait(sem_t* semaphore) { return get(semaphore, NEVER); }

int sem_clockwait(sem_t* semaphore, clockid_t clock, const timespec* moment) {
    if (!time_of::is_time(*moment)) {
        errno = EINVAL;
        return -1;
    }
    return get(semaphore, on_monotonic_clock(clock, *moment));
}

int sem_timedwait(sem_t* semaphore, const timespec* moment) { return sem_clockwait(semaphore, CLOCK_REALTIME, moment); }

int sem_trywait(sem_t* semaphore) noexcept {
    process_time.pass(time_of::ACQUIRING);
    return try_semaphore(semaphore);
}

int sem_post(sem_t* semaphore) noexcept {
    const int result = post_semaphore(semaphore);
    process_time.given_back(semaphore, 1);
    return result;
}

}  // extern "C"
