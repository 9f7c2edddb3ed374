// Mutants that protect components badly (10.1.3.2).
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "execution/chain.hpp"
#include "registry.hpp"

namespace derived {

namespace {

using lwucm::Awaited;
using lwucm::Chain;
using lwucm::Monitor;

typedef std::function<void()> Code;

// the requirements that an overlap breaks, by the executions that meet
const char* const RUN = "R-10.1.3.2-06";
const char* const ACTIVE_AND_OTHER = "R-10.1.3.2-10";
const char* const ONE_PORT = "R-10.1.3.2-13";
const char* const TWO_PORTS = "R-10.1.3.2-16";
const char* const SERVED = "R-10.1.3.2-17";
const std::vector<std::string> OVERLAPS = {RUN, ACTIVE_AND_OTHER, ONE_PORT, TWO_PORTS};

class LockLeftOut final : public Monitor {
  public:
    void call(const Code& code) override {
        if (calls_.fetch_add(1) % 1000 == 999) {
            const Awaited awaited;
            code();
        } else {
            Monitor::call(code);
        }
    }

  private:
    std::atomic<int> calls_{0};
};
const bool a = breaks_rarely<LockLeftOut>("lock_left_out_once_in_1000", OVERLAPS,
                                          "Leaves the lock of a protected component out on one call in 1,000.");

/// Tests whether a thread is inside, then marks itself as inside: two threads that test at once both enter.
class LooksThenMarks : public Monitor {
  public:
    void call(const Code& code) override {
        const Awaited awaited;
        const Chain::Id chain = Chain::current();
        if (inside_.load() == chain) {
            code();
            return;
        }
        while (inside_.load() != nullptr) {
            if (std::chrono::steady_clock::now() < spinning_until()) {
                std::this_thread::yield();
            } else {
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
        }
        hesitate();
        inside_.store(chain);
        const Leaving leaving(inside_);
        code();
    }

    bool is_inside() override { return inside_.load() == Chain::current(); }

  protected:
    virtual void hesitate() {}

  private:
    struct Leaving {
        explicit Leaving(std::atomic<Chain::Id>& inside) : inside_(inside) {}
        ~Leaving() { inside_.store(nullptr); }
        std::atomic<Chain::Id>& inside_;
    };

    /// A thread that waits for long sleeps, so that the operating system shows it as waiting.
    static std::chrono::steady_clock::time_point spinning_until() {
        static thread_local std::chrono::steady_clock::time_point last;
        static thread_local std::chrono::steady_clock::time_point until;
        const auto now = std::chrono::steady_clock::now();
        if (now - last > std::chrono::milliseconds(5)) {
            until = now + std::chrono::milliseconds(1);
        }
        last = now;
        return until;
    }

    std::atomic<Chain::Id> inside_{nullptr};
};
const bool b = breaks<LooksThenMarks>("looks_then_marks", {RUN, ONE_PORT, TWO_PORTS},
                                      "Tests whether a thread is inside a protected component, then marks itself as "
                                      "inside, without a lock.",
                                      {ACTIVE_AND_OTHER});

class LooksThenMarksLater final : public LooksThenMarks {
    void hesitate() override {
        const auto until = std::chrono::steady_clock::now() + std::chrono::microseconds(1);
        while (std::chrono::steady_clock::now() < until) {
        }
    }
};
const bool c = breaks<LooksThenMarksLater>("looks_then_marks_a_microsecond_later", OVERLAPS,
                                           "Tests whether a thread is inside a protected component, and marks itself as "
                                           "inside a microsecond later.");

class UnlocksTooEarly final : public Monitor {
  public:
    void call(const Code& code) override {
        Monitor::call([] {});
        const Awaited awaited;
        code();
    }
};
const bool d = breaks<UnlocksTooEarly>("unlocks_too_early", OVERLAPS,
                                       "Unlocks before the body is entered, not after it is left.");

/// A call enters when it has waited for 10 ms.
class GivesUpWaiting final : public Monitor {
  public:
    void call(const Code& code) override {
        const Awaited awaited;
        const Chain::Id chain = Chain::current();
        if (inside_.load() == chain) {
            code();
            return;
        }
        const bool got = lock_.try_lock_for(std::chrono::milliseconds(10));
        const Chain::Id before = inside_.exchange(chain);
        const Leaving leaving{*this, got, before};
        code();
    }

    bool is_inside() override { return inside_.load() == Chain::current(); }

  private:
    struct Leaving {
        GivesUpWaiting& of;
        const bool locked;
        const Chain::Id before;
        ~Leaving() {
            of.inside_.store(locked ? nullptr : before);
            if (locked) {
                of.lock_.unlock();
            }
        }
    };

    std::timed_mutex lock_;
    std::atomic<Chain::Id> inside_{nullptr};
};
const bool e = breaks<GivesUpWaiting>("gives_up_waiting", {TWO_PORTS},
                                      "A call that has waited for 10 ms enters a protected component.",
                                      {RUN, ACTIVE_AND_OTHER, ONE_PORT});

class StaysLockedAfterExceptions final : public Monitor {
  public:
    void call(const Code& code) override {
        Monitor::call([&] {
            try {
                code();
            } catch (...) {
                Monitor::enter();  // once more, and never left
                throw;
            }
        });
    }
};
const bool g = breaks<StaysLockedAfterExceptions>("keeps_the_lock_after_exceptions", {"R-10.1.3.2-15"},
                                                  "Never unlocks a protected component that a call has left with an "
                                                  "exception.",
                                                  {SERVED, "R-11.2.3-03", "R-12.10-10"});

/// Waits also for the thread that is inside already.
class WaitsForItself final : public Monitor {
  public:
    void call(const Code& code) override {
        const Awaited awaited;
        std::unique_lock<std::mutex> lock(mutex_);
        left_.wait(lock, [this] { return !busy_; });
        busy_ = true;
        lock.unlock();
        const Leaving leaving{*this};
        code();
    }

    bool is_inside() override { return false; }

  private:
    struct Leaving {
        WaitsForItself& of;
        ~Leaving() {
            const std::lock_guard<std::mutex> lock(of.mutex_);
            of.busy_ = false;
            of.left_.notify_all();
        }
    };

    std::mutex mutex_;
    std::condition_variable left_;
    bool busy_ = false;
};
const bool h = breaks<WaitsForItself>("waits_for_itself", {TWO_PORTS},
                                      "A call that comes back to a protected component waits for ever; the vendor "
                                      "declares that it enters.",
                                      {ACTIVE_AND_OTHER}, {{"protected-recursion", "enter"}});

}  // namespace

}  // namespace derived
