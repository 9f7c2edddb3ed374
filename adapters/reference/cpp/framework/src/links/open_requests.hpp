// OpenRequests: the requests of a connection (10.4.1) that have no response yet, by number.
#ifndef LWUCM_SRC_OPEN_REQUESTS_HPP
#define LWUCM_SRC_OPEN_REQUESTS_HPP

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>

#include "links/port_link.hpp"

namespace lwucm {

/// A request that waits for its response. `callback` is null if its client waits.
struct OpenRequest {
    OpenRequest(const Instance* its_client, std::shared_ptr<CalledEnd> its_callback)
        : client(its_client), callback(std::move(its_callback)) {}

    const Instance* client;
    std::shared_ptr<CalledEnd> callback;
    bool is_over = false;
    bool is_answered = false;
    Value response;
};

class OpenRequests {
  public:
    OpenRequests() = default;
    virtual ~OpenRequests() = default;
    OpenRequests(const OpenRequests&) = delete;
    OpenRequests& operator=(const OpenRequests&) = delete;

    /// The number of the request, which no other open one has.
    virtual std::uint32_t open(const std::shared_ptr<OpenRequest>& request);

    /// The request that the response is for, which is open no more; null if there is none of that number.
    virtual std::shared_ptr<OpenRequest> answer(std::uint32_t number, const Value& response);

    /// Requests of the client are dropped; all if it is null.
    virtual void abandon(const Instance* client);

    void drop(std::uint32_t number);

    /// Waits until the request is answered or dropped; was it answered?
    bool await(const OpenRequest& request);

  protected:
    std::mutex mutex_;
    std::map<std::uint32_t, std::shared_ptr<OpenRequest>> open_;

  private:
    std::condition_variable over_;  // a request was answered or dropped
    std::uint32_t last_ = 0;
};

}  // namespace lwucm

#endif
