// Inbox: messages on their way to one receiver, and the thread that delivers them.
#ifndef LWUCM_SRC_INBOX_HPP
#define LWUCM_SRC_INBOX_HPP

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "lwucm/options.hpp"
#include "values/marshalling.hpp"

namespace lwucm {

typedef std::shared_ptr<const Bytes> Message;

/// Delivers one message after the other, in the order in which they were put in, while it is open.
class Inbox {
  public:
    /// Exceptions that `deliver` throws are dropped.
    Inbox(std::function<void(const Bytes&)> deliver, const Options& options);
    virtual ~Inbox();
    Inbox(const Inbox&) = delete;
    Inbox& operator=(const Inbox&) = delete;

    /// False if it is not open and that shall be an error. Waits while the inbox is full, unless a thread may be
    /// waiting for the caller: receivers that send to each other would wait in a circle.
    virtual bool put(const Message& message);

    void open();

    /// Delivers nothing more, but what is to be delivered at the end; what is being delivered goes on.
    virtual void shut();

    /// Waits until nothing is being delivered. The inbox has been shut.
    virtual void await_delivery();

    /// Ends the thread and forgets all messages. Nothing is being delivered.
    virtual void end();

  private:
    void work();

    const std::function<void(const Bytes&)> deliver_;
    const std::size_t capacity_;
    const Options::NotReady not_ready_;
    const Options::Pending pending_;
    std::mutex mutex_;
    std::condition_variable changed_;    // there is something to do
    std::condition_variable delivered_;  // a message has been delivered, or it was shut
    std::deque<Message> messages_;
    std::uint64_t put_ = 0;   // how many messages came in
    std::uint64_t done_ = 0;  // how many of them were delivered
    bool open_ = false;
    bool delivering_ = false;
    bool ended_ = false;
    std::thread thread_;
};

}  // namespace lwucm

#endif
