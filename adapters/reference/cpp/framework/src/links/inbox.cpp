#include "links/inbox.hpp"

#include <utility>

#include "execution/chain.hpp"

namespace lwucm {

Inbox::Inbox(std::function<void(const Bytes&)> deliver, const Options& options)
    : deliver_(std::move(deliver)),
      capacity_(options.inbox),
      not_ready_(options.not_ready),
      pending_(options.pending) {}

Inbox::~Inbox() { end(); }

bool Inbox::put(const Message& message) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (capacity_ != 0 && !Awaited::now()) {
        delivered_.wait(lock, [this] { return messages_.size() < capacity_ || !open_; });
    }
    if (!open_ && not_ready_ != Options::NotReady::hold) {
        return not_ready_ == Options::NotReady::drop;
    }
    if (!ended_) {
        messages_.push_back(message);
        ++put_;
        changed_.notify_one();
    }
    return true;
}

void Inbox::open() {
    std::lock_guard<std::mutex> lock(mutex_);
    open_ = true;
    if (!thread_.joinable()) {
        thread_ = std::thread([this] { work(); });
    }
    changed_.notify_one();
}

void Inbox::shut() {
    std::unique_lock<std::mutex> lock(mutex_);
    if (open_ && pending_ == Options::Pending::deliver) {
        const std::uint64_t all = put_;
        delivered_.wait(lock, [this, all] { return done_ >= all; });
    }
    if (open_ && pending_ == Options::Pending::drop) {
        done_ += messages_.size();
        messages_.clear();
    }
    open_ = false;
    delivered_.notify_all();
}

void Inbox::await_delivery() {
    std::unique_lock<std::mutex> lock(mutex_);
    delivered_.wait(lock, [this] { return !delivering_; });
}

void Inbox::end() {
    {
        std::lock_guard<std::mutex> lock(mutex_);
        open_ = false;
        ended_ = true;
        messages_.clear();
        changed_.notify_one();
        delivered_.notify_all();
    }
    if (thread_.joinable()) {
        thread_.join();
    }
}

void Inbox::work() {
    const Awaited awaited;
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return ended_ || (open_ && !messages_.empty()); });
        if (ended_) {
            return;
        }
        const Message message = std::move(messages_.front());
        messages_.pop_front();
        delivering_ = true;
        lock.unlock();
        try {
            deliver_(*message);
        } catch (...) {  // the emitter has gone on
        }
        lock.lock();
        delivering_ = false;
        ++done_;
        delivered_.notify_all();
    }
}

}  // namespace lwucm
