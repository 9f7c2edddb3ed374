// Stress: many calls at once, to find the holes that no schedule hits (10.1.3.2).
#ifndef UCM_CTS_STRESS_HPP
#define UCM_CTS_STRESS_HPP

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <pthread.h>
#include <sched.h>
#endif

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/counting.hpp"
#include "ucm_cts/stage.hpp"

namespace ucm_cts {
namespace detail {

/// The cores that this process may use; empty where that is not known.
inline const std::vector<int>& cores() {
    static const std::vector<int> found = [] {
        std::vector<int> all;
#if defined(__linux__)
        cpu_set_t allowed;
        CPU_ZERO(&allowed);
        if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) {
            for (int core = 0; core < CPU_SETSIZE; ++core) {
                if (CPU_ISSET(core, &allowed)) {
                    all.push_back(core);
                }
            }
        }
#endif
        return all;
    }();
    return found;
}

/// Keeps the calling thread on one core. Threads that wander meet only now and then.
inline void stay_on_core(std::size_t number) {
#if defined(__linux__)
    if (!cores().empty()) {
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(cores()[number % cores().size()], &one);
        pthread_setaffinity_np(pthread_self(), sizeof one, &one);  // where that is forbidden it wanders
    }
#else
    static_cast<void>(number);
#endif
}

}  // namespace detail

/// Threads that call again and again: by turns `exchange` of their references, and an unprotected body, which
/// proves that on this machine, at this moment, threads do meet. Tasks keep it alive.
class Stress : public std::enable_shared_from_this<Stress> {
  public:
    struct Numbers {
        std::int64_t calls;
        std::int64_t failed;
        std::int64_t overlaps;
        std::int64_t control_calls;
        std::int64_t control_overlaps;
    };

    Stress(std::shared_ptr<Stage> stage, std::vector<Reference> references)
        : stage_(std::move(stage)), references_(std::move(references)), tallies_(new Tally[references_.size()]) {
        detail::cores();  // asked for here, since the tasks' threads have one core each
    }

    /// What each thread is to do, until `conduct` is over.
    std::vector<std::function<void()>> tasks() {
        std::vector<std::function<void()>> all;
        const std::shared_ptr<Stress> self = shared_from_this();
        for (std::size_t number = 0; number < references_.size(); ++number) {
            all.push_back([self, number] { self->keep_calling(number); });
        }
        return all;
    }

    /// Has the references called for `duration` in all, once every thread is there, or `patience` has run out. From then on
    /// the bodies of the stage are under stress.
    void conduct(std::chrono::milliseconds duration, std::chrono::milliseconds patience) {
        const auto deadline = std::chrono::steady_clock::now() + patience;
        while (arrived_.load() < references_.size() && std::chrono::steady_clock::now() < deadline) {
            std::this_thread::sleep_for(std::chrono::microseconds(50));
        }
        stage_->overlaps = 0;
        auto left = std::chrono::duration_cast<std::chrono::microseconds>(duration);
        static const Pace paces[] = {Pace::hurried, Pace::lingering, Pace::strolling, Pace::lingering};
        for (std::size_t number = 0; left.count() > 0 && !references_.empty(); ++number) {
            const auto turn = std::min(left, std::chrono::microseconds(2000));
            stage_->stress = paces[number % 4];
            take_turn(Turn::references, turn);
            take_turn(Turn::control, turn / 4);
            left -= turn;
        }
        turn_.store(Turn::over);
    }

    /// To be called when the tasks are done, or are no longer waited for: ends the stress, and returns what was counted.
    Numbers end() {
        stage_->stress = Pace::none;
        Numbers all = {0, 0, stage_->overlaps, 0, control_overlaps_};
        for (std::size_t number = 0; number < references_.size(); ++number) {
            all.calls += tallies_[number].calls.load();
            all.failed += tallies_[number].failed.load();
            all.control_calls += tallies_[number].control_calls.load();
        }
        return all;
    }

  private:
    enum class Turn { none, references, control, over };

    // of one thread, which alone writes it
    struct Tally {
        std::atomic<std::int64_t> calls{0};
        std::atomic<std::int64_t> failed{0};
        std::atomic<std::int64_t> control_calls{0};
        char apart[64];  // from that of the next thread, in another cache line
    };

    void take_turn(Turn turn, std::chrono::microseconds duration) {
        turn_.store(turn);
        std::this_thread::sleep_for(duration);
    }

    void keep_calling(std::size_t number) {
        detail::stay_on_core(number);
        Tally& tally = tallies_[number];
        ++arrived_;
        while (true) {
            std::chrono::steady_clock::now();  // lets virtual time pass
            const Pace pace = stage_->stress.load(std::memory_order_relaxed);
            if (pace == Pace::strolling) {
                pass_moments(any_below(400));
            }
            switch (turn_.load(std::memory_order_relaxed)) {
                case Turn::none:
                    std::this_thread::yield();
                    break;
                case Turn::references:
                    call(*references_[number], tally);
                    break;
                case Turn::control:
                    control_.visit(pace, control_overlaps_);
                    count(tally.control_calls);
                    break;
                case Turn::over:
                    return;
            }
        }
    }

    static void call(PortElement& reference, Tally& tally) {
        try {
            reference.exchange(1);
            count(tally.calls);
        } catch (...) {
            count(tally.failed);
        }
    }

    static void count(std::atomic<std::int64_t>& counter) {
        counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    }

    const std::shared_ptr<Stage> stage_;
    const std::vector<Reference> references_;
    const std::unique_ptr<Tally[]> tallies_;
    std::atomic<std::size_t> arrived_{0};
    std::atomic<Turn> turn_{Turn::none};
    Occupancy control_;
    std::atomic<std::int64_t> control_overlaps_{0};
};

}  // namespace ucm_cts

#endif
