#include "execution/monitor.hpp"

namespace lwucm {

class Monitor::Visit {
  public:
    explicit Visit(Monitor& monitor) : monitor_(monitor) { monitor_.enter(); }
    ~Visit() { monitor_.leave(); }
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;

  private:
    Monitor& monitor_;
    const Awaited awaited_;
};

void Monitor::call(const std::function<void()>& code) {
    const Visit visit(*this);
    code();
}

bool Monitor::is_inside() {
    std::lock_guard<std::mutex> lock(mutex_);
    return inside_ == Chain::current();
}

void Monitor::enter() {
    const Chain::Id chain = Chain::current();
    std::unique_lock<std::mutex> lock(mutex_);
    if (inside_ != chain) {
        const std::uint64_t ticket = next_ticket_++;
        left_.wait(lock, [this, ticket] { return ticket == admitted_; });
        inside_ = chain;
    }
    ++depth_;
}

void Monitor::leave() {
    std::lock_guard<std::mutex> lock(mutex_);
    if (--depth_ == 0) {
        inside_ = nullptr;
        ++admitted_;
        left_.notify_all();
    }
}

}  // namespace lwucm
