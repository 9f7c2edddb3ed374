// Threads and forked processes, counted in virtual time.
#include <errno.h>
#include <pthread.h>

#include <climits>
#include <new>

#include "real.hpp"
#include "virtual_time.hpp"

namespace time_of = ucm_cts::virtual_time;
using time_of::Nanoseconds;
using time_of::NEVER;
using time_of::process_time;

namespace {

typedef void* Work(void*);

time_of::Real<int(pthread_t*, const pthread_attr_t*, Work*, void*)> real_create("pthread_create");
time_of::Real<int(pthread_t, void**)> real_join("pthread_join");
time_of::Real<int(pthread_t)> real_detach("pthread_detach");

/// A thread that somebody may yet join, or that has not ended.
struct Thread {
    Work* work;
    void* given;
    pthread_t id;
    int holders;  // its creator, the thread itself, and who may join it
    bool may_be_joined;
    bool has_begun;
    bool has_ended;
    Thread* next;
};

Thread* all = nullptr;

/// Locked: the thread that may be joined as `id`; null if none is known.
Thread* find(pthread_t id) {
    Thread* one = all;
    while (one != nullptr && (!one->may_be_joined || pthread_equal(one->id, id) == 0)) {
        one = one->next;
    }
    return one;
}

/// Locked: one holder less. Returns what is to be deleted when it is unlocked.
Thread* let_go(Thread* thread) {
    if (--thread->holders > 0) {
        return nullptr;
    }
    Thread** place = &all;
    while (*place != nullptr && *place != thread) {
        place = &(*place)->next;
    }
    if (*place == nullptr) {  // made before this process was forked
        return nullptr;
    }
    *place = thread->next;
    return thread;
}

/// Locked: nobody will join it any more. Returns what is to be deleted when it is unlocked.
Thread* give_up(Thread* thread) {
    thread->may_be_joined = false;
    return let_go(thread);
}

/// Counts the thread while its work is done, also if that ends by `pthread_exit`.
class Running {
  public:
    explicit Running(Thread* thread) : thread_(thread) {}
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    ~Running() {
        process_time.lock();
        thread_->has_ended = true;
        process_time.wake(thread_, INT_MAX);
        Thread* const unused = let_go(thread_);
        process_time.unlock();
        process_time.end_thread();
        delete unused;
    }

  private:
    Thread* const thread_;
};

void* run(void* given) {
    Thread* const thread = static_cast<Thread*>(given);
    process_time.lock();
    thread->id = pthread_self();
    thread->has_begun = true;
    process_time.unlock();
    const Running running(thread);
    return thread->work(thread->given);
}

int join(pthread_t id, void** result, Nanoseconds moment) {
    process_time.lock();
    Thread* const thread = pthread_equal(id, pthread_self()) == 0 ? find(id) : nullptr;
    while (thread != nullptr && !thread->has_ended) {
        time_of::Waiter waiter(thread, moment);
        process_time.park(waiter);
        if (waiter.is_late) {
            process_time.unlock();
            return ETIMEDOUT;
        }
    }
    Thread* const unused = thread != nullptr ? give_up(thread) : nullptr;
    process_time.unlock();
    delete unused;
    return real_join(id, result);
}

void lock_before_fork() { process_time.lock(); }

void unlock_after_fork() { process_time.unlock(); }

void forget_after_fork() {
    all = nullptr;
    process_time.forget_threads();
}

__attribute__((constructor)) void watch_forks() {
    pthread_atfork(lock_before_fork, unlock_after_fork, forget_after_fork);
    process_time.begin();
}

}  // namespace

extern "C" {

int pthread_create(pthread_t* id, const pthread_attr_t* attributes, Work* work, void* given) noexcept {
    int state = PTHREAD_CREATE_JOINABLE;
    if (attributes != nullptr) {
        pthread_attr_getdetachstate(attributes, &state);
    }
    Thread* const thread = new (std::nothrow) Thread{work, given, pthread_t(), 2, false, false, false, nullptr};
    if (thread == nullptr) {
        return EAGAIN;
    }
    process_time.begin_thread();
    process_time.lock();
    thread->may_be_joined = state == PTHREAD_CREATE_JOINABLE;
    thread->holders += thread->may_be_joined ? 1 : 0;
    thread->next = all;
    all = thread;
    process_time.unlock();
    const int problem = real_create(id, attributes, &run, thread);
    process_time.lock();
    if (problem != 0) {
        thread->holders = 1;
    } else if (!thread->has_begun) {  // one that has may have ended, and *id with it
        thread->id = *id;
    }
    Thread* const unused = let_go(thread);
    process_time.unlock();
    delete unused;
    if (problem != 0) {
        process_time.end_thread();
    }
    return problem;
}

int pthread_join(pthread_t id, void** result) { return join(id, result, NEVER); }

int pthread_clockjoin_np(pthread_t id, void** result, clockid_t clock, const timespec* moment) {
    return time_of::is_time(*moment) ? join(id, result, time_of::on_monotonic_clock(clock, *moment)) : EINVAL;
}

int pthread_timedjoin_np(pthread_t id, void** result, const timespec* moment) {
    return pthread_clockjoin_np(id, result, CLOCK_REALTIME, moment);
}

int pthread_detach(pthread_t id) noexcept {
    process_time.lock();
    Thread* const thread = find(id);
    Thread* const unused = thread != nullptr ? give_up(thread) : nullptr;
    process_time.unlock();
    delete unused;
    return real_detach(id);
}

}  // extern "C"
