// Trace: records what really happens, in one order for all threads.
#ifndef UCM_CTS_TRACE_HPP
#define UCM_CTS_TRACE_HPP

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "ucm_cts/writing.hpp"

namespace ucm_cts {

/// Collects the events of one scenario as JSON text.
///
/// Every thread writes to a lane of its own, so that recording makes no thread wait for another; the order is that of one
/// atomic counter. Drawing a number is an acquire and a release: what a thread did before its event is done when
/// another thread draws a higher number.
class Recorder {
  public:
    typedef std::function<void(const std::string& event)> Sink;

    /// The calling thread becomes thread 0. With `sink` each event is also handed over at once, in order.
    explicit Recorder(Sink sink = Sink()) : sink_(std::move(sink)), serial_(next_serial()) { lane(); }

    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Records one event. Does nothing once the trace has been taken.
    void record(const Event& event) {
        if (closed()) {
            return;
        }
        Lane& own = lane();
        std::unique_lock<std::mutex> in_order(streaming_, std::defer_lock);
        if (sink_) {
            in_order.lock();
        }
        std::lock_guard<std::mutex> lock(own.mutex);
        if (own.closed) {
            return;
        }
        const std::size_t begin = own.text.size();
        const std::int64_t number = counter_.fetch_add(1, std::memory_order_acq_rel) + 1;
        own.marks.push_back(Mark{number, begin});
        std::string& out = own.text;
        out += "{\"kind\":\"";
        out += event.kind();
        out += "\",\"n\":";
        json::append(out, number);
        out += ",\"t\":";
        json::append(out, now());
        out += ",\"thread\":";
        json::append(out, own.thread);
        out += event.text();
        out += '}';
        if (sink_) {
            sink_(out.substr(begin));
        }
    }

    bool closed() const { return closed_.load(std::memory_order_acquire); }

    /// Ends the recording and appends the events to `out` as a JSON array, in order.
    void take(std::string& out) {
        std::lock_guard<std::mutex> lock(lanes_mutex_);
        closed_.store(true, std::memory_order_release);
        for (const std::unique_ptr<Lane>& each : lanes_) {
            std::lock_guard<std::mutex> lane_lock(each->mutex);
            each->closed = true;
        }
        out += '[';
        bool first = true;
        while (const Lane* next = earliest()) {
            if (!first) {
                out += ',';
            }
            first = false;
            next->append_next(out);
        }
        out += ']';
    }

  private:
    struct Mark {
        std::int64_t number;
        std::size_t begin;
    };

    struct Lane {
        explicit Lane(int number) : thread(number) {
            text.reserve(8192);
            marks.reserve(64);
        }

        bool at_end() const { return next == marks.size(); }
        void append_next(std::string& out) const {
            const std::size_t begin = marks[next].begin;
            const std::size_t end = next + 1 == marks.size() ? text.size() : marks[next + 1].begin;
            out.append(text, begin, end - begin);
            ++next;
        }

        const int thread;
        std::mutex mutex;
        bool closed = false;
        std::string text;
        std::vector<Mark> marks;
        mutable std::size_t next = 0;
    };

    const Lane* earliest() const {
        const Lane* found = nullptr;
        for (const std::unique_ptr<Lane>& each : lanes_) {
            if (!each->at_end() &&
                (found == nullptr || each->marks[each->next].number < found->marks[found->next].number)) {
                found = each.get();
            }
        }
        return found;
    }

    // The calling thread's lane; made at its first event, which gives the thread its number.
    Lane& lane() {
        static thread_local std::uint64_t serial = 0;
        static thread_local Lane* own = nullptr;
        if (serial != serial_) {
            std::lock_guard<std::mutex> lock(lanes_mutex_);
            lanes_.emplace_back(new Lane(static_cast<int>(lanes_.size())));
            lanes_.back()->closed = closed_;
            own = lanes_.back().get();
            serial = serial_;
        }
        return *own;
    }

    static std::uint64_t next_serial() {
        static std::atomic<std::uint64_t> last(0);
        return ++last;
    }

    static std::int64_t now() {
        return std::chrono::duration_cast<std::chrono::nanoseconds>(
                   std::chrono::steady_clock::now().time_since_epoch())
            .count();
    }

    const Sink sink_;
    const std::uint64_t serial_;
    std::atomic<std::int64_t> counter_{0};
    std::atomic<bool> closed_{false};
    std::mutex streaming_;
    std::mutex lanes_mutex_;
    std::vector<std::unique_ptr<Lane>> lanes_;
};

}  // namespace ucm_cts

#endif
