// What probes count instead of recording: messages of a burst, and who meets whom while they are stressed.
#ifndef UCM_CTS_COUNTING_HPP
#define UCM_CTS_COUNTING_HPP

#include <algorithm>
#include <atomic>
#include <bitset>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <unordered_map>
#include <utility>

namespace ucm_cts {

/// The messages pushed to one body: ULONGs, of which those of one emitter lie within a block.
class MessageCount {
  public:
    struct Numbers {
        std::int64_t received;
        std::int64_t distinct;
        std::int64_t disordered;  // lower than one of their block before them
        std::int64_t least;
        std::int64_t greatest;
    };

    void add(std::uint32_t value) {
        std::lock_guard<std::mutex> lock(mutex_);
        std::uint32_t& greatest_of_block = greatest_.emplace(value / BLOCK, value).first->second;
        if (value < greatest_of_block) {
            ++numbers_.disordered;
        }
        greatest_of_block = std::max(greatest_of_block, value);
        Page& page = seen_[value / PAGE];
        if (!page[value % PAGE]) {
            page[value % PAGE] = true;
            ++numbers_.distinct;
        }
        numbers_.least = numbers_.received == 0 ? value : std::min<std::int64_t>(numbers_.least, value);
        numbers_.greatest = std::max<std::int64_t>(numbers_.greatest, value);
        if (++numbers_.received >= wanted_) {
            wanted_ = NOBODY_WAITS;
            changed_.notify_all();
        }
    }

    /// Waits until so many have come, or until `deadline`; what has been counted then.
    Numbers wait(std::int64_t messages, std::chrono::steady_clock::time_point deadline) {
        std::unique_lock<std::mutex> lock(mutex_);
        while (numbers_.received < messages) {
            wanted_ = std::min(wanted_, messages);
            if (changed_.wait_until(lock, deadline) == std::cv_status::timeout) {
                break;
            }
        }
        return numbers_;
    }

  private:
    static const std::uint32_t BLOCK = 1u << 20;
    static const std::uint32_t PAGE = 256;
    static const std::int64_t NOBODY_WAITS = INT64_MAX;
    typedef std::bitset<PAGE> Page;

    std::mutex mutex_;
    std::condition_variable changed_;
    std::int64_t wanted_ = NOBODY_WAITS;
    Numbers numbers_ = {0, 0, 0, 0, 0};
    std::unordered_map<std::uint32_t, Page> seen_;
    std::unordered_map<std::uint32_t, std::uint32_t> greatest_;
};

/// The counts of all bodies, by component and instance.
class MessageCounts {
  public:
    std::shared_ptr<MessageCount> of(const std::string& component, std::int64_t instance) {
        std::lock_guard<std::mutex> lock(mutex_);
        std::shared_ptr<MessageCount>& count = counts_[std::make_pair(component, instance)];
        if (!count) {
            count = std::make_shared<MessageCount>();
        }
        return count;
    }

  private:
    std::mutex mutex_;
    std::map<std::pair<std::string, std::int64_t>, std::shared_ptr<MessageCount>> counts_;
};

/// How threads behave that stress a body:
///   - hurried: they come back at once and mostly leave at once, which finds locks that are checked first and taken
///     afterwards, as those change hands often;
///   - strolling: they stay for a time inside and outside, which finds locks that are missing on some calls, as another
///     thread is mostly inside when such a call comes;
///   - lingering: they sleep inside, which finds the same where waiting threads sleep or share a processor.
enum class Pace { none, hurried, strolling, lingering };

/// A pseudo-random number below `most`; cheap.
inline int any_below(int most) {
    static thread_local std::uint32_t random = 1;
    random = random * 1664525u + 1013904223u;
    return static_cast<int>((random >> 16) % static_cast<std::uint32_t>(most));
}

/// About a nanosecond each.
inline void pass_moments(int moments) {
    for (int n = moments; n > 0; --n) {
        std::atomic_signal_fence(std::memory_order_seq_cst);  // a loop that compilers leave alone
    }
}

/// Counts the threads inside one body. A thread that goes in while another is inside is an overlap; every overlap counted
/// has happened.
class Occupancy {
  public:
    /// Goes in, stays for a moment, and leaves.
    void visit(Pace pace, std::atomic<std::int64_t>& overlaps) {
        if (inside_.fetch_add(1, std::memory_order_relaxed) != 0) {
            overlaps.fetch_add(1, std::memory_order_relaxed);
        }
        if (pace == Pace::lingering) {
            std::this_thread::sleep_for(std::chrono::microseconds(20));
        } else {
            pass_moments(pace == Pace::strolling ? 200 : any_below(64) != 0 ? 20 : 2000);
        }
        inside_.fetch_sub(1, std::memory_order_relaxed);
    }

  private:
    std::atomic<int> inside_{0};
};

}  // namespace ucm_cts

#endif
