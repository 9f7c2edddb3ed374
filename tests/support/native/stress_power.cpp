// How much does stress find, and does it ever cry wolf? Frameworks with small holes, and with none, each stressed many times.
//
//     c++ -std=c++11 -O2 -I adapters/sdk/cpp/include tests/support/native/stress_power.cpp -pthread -o stress_power
//     ./stress_power [TRIALS [MILLISECONDS [SECONDS]]]
//
// TRIALS of MILLISECONDS each for every wrong framework, SECONDS for every right one. One JSON object a line and framework:
// in how many trials it was found out, and the sums of what the trials counted.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "ucm_cts/probe_body.hpp"
#include "ucm_cts/stress.hpp"

namespace {

using ucm_cts::Reference;

// Protects a component: `enter` before a body is called, `leave` after it, with what `enter` returned.
class Guard {
  public:
    virtual ~Guard() = default;
    virtual bool enter() = 0;
    virtual void leave(bool entered) = 0;
};

class SpinLock {
  public:
    void lock() {
        while (taken_.test_and_set(std::memory_order_acquire)) {
        }
    }
    void unlock() { taken_.clear(std::memory_order_release); }

  private:
    std::atomic_flag taken_ = ATOMIC_FLAG_INIT;
};

// first come, first served
class TicketLock {
  public:
    void lock() {
        const unsigned own = next_.fetch_add(1);
        while (serving_.load(std::memory_order_acquire) != own) {
        }
    }
    void unlock() { serving_.store(serving_.load() + 1, std::memory_order_release); }

  private:
    std::atomic<unsigned> next_{0};
    std::atomic<unsigned> serving_{0};
};

// first come, first served, and who waits sleeps
class MonitorLock {
  public:
    void lock() {
        std::unique_lock<std::mutex> lock(mutex_);
        const unsigned own = next_++;
        left_.wait(lock, [this, own] { return own == serving_; });
    }
    void unlock() {
        std::lock_guard<std::mutex> lock(mutex_);
        ++serving_;
        left_.notify_all();
    }

  private:
    std::mutex mutex_;
    std::condition_variable left_;
    unsigned next_ = 0;
    unsigned serving_ = 0;
};

template <class Lock>
class Correct final : public Guard {
  public:
    bool enter() override {
        lock_.lock();
        return true;
    }
    void leave(bool) override { lock_.unlock(); }

  private:
    Lock lock_;
};

// one call of EVERY goes in without
template <class Lock, unsigned EVERY>
class Forgetful final : public Guard {
  public:
    bool enter() override {
        if (calls_.fetch_add(1) % EVERY == EVERY - 1) {
            return false;
        }
        lock_.lock();
        return true;
    }
    void leave(bool entered) override {
        if (entered) {
            lock_.unlock();
        }
    }

  private:
    std::atomic<unsigned> calls_{0};
    Lock lock_;
};

void wait_for(std::chrono::nanoseconds time) {
    const auto until = std::chrono::steady_clock::now() + time;
    while (std::chrono::steady_clock::now() < until) {
    }
}

// looks whether somebody is inside, and then says that it is
template <unsigned NANOSECONDS>
class CheckThenSet final : public Guard {
  public:
    bool enter() override {
        while (taken_.load(std::memory_order_acquire)) {
        }
        if (NANOSECONDS != 0) {
            wait_for(std::chrono::nanoseconds(NANOSECONDS));
        }
        taken_.store(true, std::memory_order_release);
        return true;
    }
    void leave(bool) override { taken_.store(false, std::memory_order_release); }

  private:
    std::atomic<bool> taken_{false};
};

// waits for a while, and then goes in even if another caller is inside
class Impatient final : public Guard {
  public:
    bool enter() override {
        for (int n = 0; n < 10000; ++n) {
            if (lock_.try_lock()) {
                return true;
            }
        }
        return false;
    }
    void leave(bool entered) override {
        if (entered) {
            lock_.unlock();
        }
    }

  private:
    std::mutex lock_;
};

class Guarded final : public ucm_cts::PortElement {
  public:
    Guarded(Reference body, std::shared_ptr<Guard> guard) : body_(std::move(body)), guard_(std::move(guard)) {}

    std::int32_t exchange(std::int32_t value) override {
        const bool entered = guard_->enter();
        const std::int32_t result = body_->exchange(value);
        guard_->leave(entered);
        return result;
    }

  private:
    const Reference body_;
    const std::shared_ptr<Guard> guard_;
};

struct Subject {
    const char* name;
    bool is_right;
    std::function<std::shared_ptr<Guard>()> make;
};

template <class Kind>
std::shared_ptr<Guard> make() {
    return std::make_shared<Kind>();
}

struct Sums {
    std::int64_t trials, found, calls, overlaps, control_calls, control_overlaps, blind;
};

// One trial: two callers of a component with two ports.
void stress(const Subject& subject, std::chrono::milliseconds duration, Sums& sums) {
    const std::shared_ptr<ucm_cts::Scenario> scenario = std::make_shared<ucm_cts::Scenario>();
    scenario->components.resize(1);
    scenario->components[0].second.provided = {"p", "q"};
    const std::shared_ptr<ucm_cts::Stage> stage = std::make_shared<ucm_cts::Stage>(ucm_cts::Recorder::Sink(), 2000);
    ucm_cts::ProbeBody body(std::make_shared<ucm_cts::Probe>(stage, scenario, scenario->components[0], 1));
    const std::shared_ptr<Guard> guard = subject.make();
    std::vector<Reference> references;
    for (const std::string& port : scenario->components[0].second.provided) {
        references.push_back(std::make_shared<Guarded>(body.get_portElement(port), guard));
    }
    const std::shared_ptr<ucm_cts::Stress> storm = std::make_shared<ucm_cts::Stress>(stage, references);
    std::vector<std::thread> threads;
    for (const std::function<void()>& task : storm->tasks()) {
        threads.emplace_back(task);
    }
    storm->conduct(duration, std::chrono::milliseconds(2000));
    for (std::thread& thread : threads) {
        thread.join();
    }
    const ucm_cts::Stress::Numbers numbers = storm->end();
    ++sums.trials;
    sums.found += numbers.overlaps != 0;
    sums.calls += numbers.calls;
    sums.overlaps += numbers.overlaps;
    sums.control_calls += numbers.control_calls;
    sums.control_overlaps += numbers.control_overlaps;
    sums.blind += numbers.control_overlaps == 0;
}

double argument(int argc, char** argv, int number, double otherwise) {
    return argc > number ? std::atof(argv[number]) : otherwise;
}

}  // namespace

int main(int argc, char** argv) {
    const std::int64_t trials = static_cast<std::int64_t>(argument(argc, argv, 1, 100));
    const std::chrono::milliseconds duration(static_cast<std::int64_t>(argument(argc, argv, 2, 100)));
    const std::int64_t right_trials =
        static_cast<std::int64_t>(argument(argc, argv, 3, 10) * 1000 / static_cast<double>(duration.count()));
    const std::vector<Subject> subjects = {
        {"no lock on 1 of 1,000 calls (mutex)", false, make<Forgetful<std::mutex, 1000>>},
        {"no lock on 1 of 1,000 calls (spin lock)", false, make<Forgetful<SpinLock, 1000>>},
        {"no lock on 1 of 1,000 calls (ticket lock)", false, make<Forgetful<TicketLock, 1000>>},
        {"no lock on 1 of 1,000 calls (monitor)", false, make<Forgetful<MonitorLock, 1000>>},
        {"no lock on 1 of 100,000 calls (mutex)", false, make<Forgetful<std::mutex, 100000>>},
        {"no lock on 1 of 100,000 calls (ticket lock)", false, make<Forgetful<TicketLock, 100000>>},
        {"checked, then set", false, make<CheckThenSet<0>>},
        {"checked, 1 us later set", false, make<CheckThenSet<1000>>},
        {"goes in after 10,000 tries", false, make<Impatient>},
        {"mutex", true, make<Correct<std::mutex>>},
        {"spin lock", true, make<Correct<SpinLock>>},
        {"ticket lock", true, make<Correct<TicketLock>>},
        {"monitor", true, make<Correct<MonitorLock>>},
    };
    for (const Subject& subject : subjects) {
        Sums sums = {0, 0, 0, 0, 0, 0, 0};
        for (std::int64_t n = 0; n < (subject.is_right ? right_trials : trials); ++n) {
            stress(subject, duration, sums);
        }
        std::printf("{\"subject\":\"%s\",\"right\":%s,\"trials\":%lld,\"found\":%lld,\"calls\":%lld,\"overlaps\":%lld,"
                    "\"control_calls\":%lld,\"control_overlaps\":%lld,\"blind\":%lld}\n",
                    subject.name, subject.is_right ? "true" : "false", static_cast<long long>(sums.trials),
                    static_cast<long long>(sums.found), static_cast<long long>(sums.calls),
                    static_cast<long long>(sums.overlaps), static_cast<long long>(sums.control_calls),
                    static_cast<long long>(sums.control_overlaps), static_cast<long long>(sums.blind));
        std::fflush(stdout);
    }
    return 0;
}
