#include "links/open_requests.hpp"

#include <iterator>

namespace lwucm {

std::uint32_t OpenRequests::open(const std::shared_ptr<OpenRequest>& request) {
    std::lock_guard<std::mutex> lock(mutex_);
    while (open_.count(++last_) != 0) {
    }
    open_[last_] = request;
    return last_;
}

std::shared_ptr<OpenRequest> OpenRequests::answer(std::uint32_t number, const Value& response) {
    std::lock_guard<std::mutex> lock(mutex_);
    const auto found = open_.find(number);
    if (found == open_.end()) {
        return nullptr;
    }
    const std::shared_ptr<OpenRequest> answered = found->second;
    open_.erase(found);
    answered->response = response;
    answered->is_answered = answered->is_over = true;
    over_.notify_all();
    return answered;
}

void OpenRequests::abandon(const Instance* client) {
    std::lock_guard<std::mutex> lock(mutex_);
    for (auto one = open_.begin(); one != open_.end();) {
        const bool is_dropped = client == nullptr || one->second->client == client;
        one->second->is_over = one->second->is_over || is_dropped;
        one = is_dropped ? open_.erase(one) : std::next(one);
    }
    over_.notify_all();
}

void OpenRequests::drop(std::uint32_t number) {
    std::lock_guard<std::mutex> lock(mutex_);
    open_.erase(number);
}

bool OpenRequests::await(const OpenRequest& request) {
    std::unique_lock<std::mutex> lock(mutex_);
    over_.wait(lock, [&request] { return request.is_over; });
    return request.is_answered;
}

}  // namespace lwucm
