// Virtual time of one process: its clock, and the threads that wait.
//
// Threads really run at once. While one runs, the clock nearly stands still; when all wait, it jumps to the earliest moment
// that one of them waits for. The functions that take this in place of the system's are in clocks.cpp, locks.cpp,
// waits.cpp and threads.cpp.
#ifndef UCM_CTS_VIRTUAL_TIME_HPP
#define UCM_CTS_VIRTUAL_TIME_HPP

#include <pthread.h>
#include <time.h>

#include <atomic>
#include <cerrno>
#include <cstdint>

namespace ucm_cts {
namespace virtual_time {

/// Nanoseconds, as a duration or a moment of the monotonic clock.
typedef std::int64_t Nanoseconds;

const Nanoseconds SECOND = 1000000000;
const Nanoseconds NEVER = INT64_MAX;

/// The clock goes on by so much with each reading, so that a thread that waits by reading it comes to an end, and whenever a
/// thread wakes another one.
const Nanoseconds READING = 10000;

/// The clock goes on by so much with each attempt to get a lock, and when a thread yields.
const Nanoseconds ACQUIRING = 1000;

/// One wait of one thread, on that thread's stack. `key`: the address of what it waits for, null for a mere sleep.
struct Waiter {
    explicit Waiter(const void* what, Nanoseconds until = NEVER) : key(what), moment(until) {}

    const void* const key;
    const Nanoseconds moment;
    bool is_over = false;
    bool is_late = false;  // it is over because its moment came
    Waiter* before = nullptr;
    Waiter* after = nullptr;
    std::atomic<int> awake{0};
};

/// The clock, and the threads that wait. Nothing here allocates memory, throws, or changes errno.
///
/// Those of its functions that say so are called between `lock` and `unlock`. A signal may interrupt a thread anywhere: what its
/// handler calls then does without the lock, and its sleeps are real.
class VirtualTime {
  public:
    /// Sets the clock when it is first needed, which may be before any constructor has run.
    void begin();

    /// The clock now; the reading takes `READING`.
    Nanoseconds read();

    /// So much time passes, unless a thread is about to go on.
    void pass(Nanoseconds duration);

    /// The calling thread waits until `moment`.
    void sleep_until(Nanoseconds moment);

    void lock();
    void unlock();

    /// Locked: the calling thread waits, unless the moment has come already. It is unlocked meanwhile.
    void park(Waiter& waiter);

    /// Locked: lets threads go on that wait for `key`, those first that came first; returns how many.
    int wake(const void* key, int most);

    void begin_thread();
    void end_thread();

    /// In a forked process: only the calling thread is there.
    void forget_threads();

    /// Waits for what `attempt` gets: it returns 0, EBUSY, or another error, which ends the waiting.
    template <class Attempt>
    int obtain(const void* key, Nanoseconds moment, Attempt attempt) {
        pass(ACQUIRING);
        int result = attempt();
        if (result != EBUSY) {
            return result;
        }
        lock();
        ++contenders_;  // before the next attempt, because `given_back` reads it after the thing has been given back
        std::atomic_thread_fence(std::memory_order_seq_cst);
        bool is_late = moment <= now_.load();
        while ((result = attempt()) == EBUSY && !is_late) {
            Waiter waiter(key, moment);
            park(waiter);
            is_late = waiter.is_late;
        }
        --contenders_;
        unlock();
        return result == EBUSY ? ETIMEDOUT : result;
    }

    /// What was got by `obtain` has been given back: at most `most` threads try again.
    void given_back(const void* key, int most);

  private:
    void advance_to(Nanoseconds moment);
    void go_on();
    Waiter* earliest() const;
    void wake_one(Waiter& waiter, bool is_late);
    void note_earliest();

    std::atomic<Nanoseconds> now_{0};
    std::atomic<Nanoseconds> earliest_{NEVER};
    std::atomic<int> waking_{0};  // threads that may go on, and have not yet
    std::atomic<int> contenders_{0};
    std::atomic<bool> has_begun_{false};
    std::atomic<bool> is_given_back_by_handler_{false};
    pthread_mutex_t mutex_ = PTHREAD_MUTEX_INITIALIZER;
    int running_ = 1;
    std::uint64_t changes_ = 0;
    Waiter* first_ = nullptr;
    Waiter* last_ = nullptr;
};

/// The time of this process.
extern VirtualTime process_time;

/// As many as fit: what is later is `NEVER`, and what is earlier as early as can be.
inline Nanoseconds in_nanoseconds(const timespec& time) {
    const Nanoseconds most = NEVER / SECOND - 1;
    return time.tv_sec > most ? NEVER : time.tv_sec < -most ? -most * SECOND : time.tv_sec * SECOND + time.tv_nsec;
}

/// `duration` after `now`, or `NEVER`.
inline Nanoseconds after(Nanoseconds now, Nanoseconds duration) {
    return duration < NEVER - now ? now + duration : NEVER;
}

inline bool is_time(const timespec& time) { return time.tv_nsec >= 0 && time.tv_nsec < SECOND; }

/// `moment` of `clock` on the monotonic clock.
Nanoseconds on_monotonic_clock(clockid_t clock, const timespec& moment);

/// Is `clock` one that goes in virtual time, and by how much is it ahead of the monotonic one?
bool is_virtual(clockid_t clock, Nanoseconds& ahead);

}  // namespace virtual_time
}  // namespace ucm_cts

#endif
