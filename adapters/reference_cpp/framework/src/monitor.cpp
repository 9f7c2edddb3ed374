#include "monitor.hpp"

namespace lwucm {

namespace {

thread_local int entered_monitors = 0;

}  // namespace

class Monitor::Visit {
  public:
    explicit Visit(Monitor& monitor) : monitor_(monitor) { monitor_.enter(); }
    ~Visit() { monitor_.leave(); }
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;

  private:
    Monitor& monitor_;
};

void Monitor::call(const std::function<void()>& code) {
    const Visit visit(*this);
    code();
}

bool Monitor::is_inside() {
    std::lock_guard<std::mutex> lock(mutex_);
    return inside_ == std::this_thread::get_id();
}

bool Monitor::is_inside_any() { return entered_monitors > 0; }

void Monitor::enter() {
    std::unique_lock<std::mutex> lock(mutex_);
    if (inside_ != std::this_thread::get_id()) {
        const std::uint64_t ticket = next_ticket_++;
        left_.wait(lock, [this, ticket] { return ticket == admitted_; });
        inside_ = std::this_thread::get_id();
    }
    ++depth_;
    ++entered_monitors;
}

void Monitor::leave() {
    std::lock_guard<std::mutex> lock(mutex_);
    --entered_monitors;
    if (--depth_ == 0) {
        inside_ = std::thread::id();
        ++admitted_;
        left_.notify_all();
    }
}

}  // namespace lwucm
