// Mutants with a defect in their own threads: those that call run (10.1.3.2), and those that deliver messages (10.1.6).
#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "registry.hpp"

namespace derived {

namespace {

using lwucm::Bytes;
using lwucm::Guard;
using lwucm::Inbox;
using lwucm::Message;
using lwucm::SelfExecution;

/// Its thread goes on after the end, until the component is removed.
class RunsOnAfterStop final : public SelfExecution {
  public:
    RunsOnAfterStop(std::shared_ptr<lwucm::component_execution_intf> component, std::shared_ptr<Guard> guard)
        : SelfExecution(component, guard), component_(std::move(component)), guard_(std::move(guard)) {}

    void begin() override {
        if (is_running_) {
            return;
        }
        is_running_ = true;
        const std::weak_ptr<int> life = life_;
        const auto component = component_;
        const auto guard = guard_;
        std::thread([life, component, guard] {
            while (!life.expired()) {
                try {
                    guard->call([&component] { component->run(); });
                } catch (...) {
                }
                std::this_thread::sleep_for(std::chrono::milliseconds(2));
            }
        }).detach();
    }

    void end() override {}

  private:
    const std::shared_ptr<lwucm::component_execution_intf> component_;
    const std::shared_ptr<Guard> guard_;
    const std::shared_ptr<int> life_ = std::make_shared<int>(0);
    bool is_running_ = false;
};
const bool a = breaks<RunsOnAfterStop>("thread_runs_on_after_stop", {"R-10.1.3.2-02"},
                                       "The thread that calls run goes on after stop.");

class StopWaitsForEver final : public SelfExecution {
  public:
    using SelfExecution::SelfExecution;

    void begin() override {
        begun_ = true;
        SelfExecution::begin();
    }

    void end() override {
        if (begun_) {
            std::promise<void>().get_future().wait();
        }
    }

  private:
    bool begun_ = false;
};
const bool b = breaks<StopWaitsForEver>("stop_waits_for_the_thread_for_ever", {"R-12.10-10"},
                                        "stop waits for ever for the thread that calls run.");

class LosesMessages final : public Inbox {
  public:
    using Inbox::Inbox;

    bool put(const Message& message) override {
        static std::atomic<long> put_in_all{0};
        return put_in_all.fetch_add(1) % 10000 == 9999 || Inbox::put(message);
    }
};
const bool c = breaks<LosesMessages>("loses_one_message_in_10000", {"R-10.1.2-10"},
                                     "One message in 10,000 is lost on its way, and push returns ok.");

/// A message in transit lies in a buffer that the next message overwrites, even while it is read.
class OneBuffer final : public Inbox {
  public:
    using Inbox::Inbox;

    bool put(const Message& message) override {
        const std::size_t length = std::min(message->size(), buffer_->size());
        std::copy_n(message->begin(), length, buffer_->begin());
        if (length < message->size()) {
            return Inbox::put(message);
        }
        return Inbox::put(buffer_);
    }

  private:
    const std::shared_ptr<Bytes> buffer_ = std::make_shared<Bytes>(static_cast<std::size_t>(SIZE));
    static const std::size_t SIZE = 4;
};
const bool d = breaks<OneBuffer>("messages_share_a_buffer", {"R-10.1.6.1-05"},
                                 "Short messages to one receiver share a buffer, which is written to while it is read.",
                                 {"R-10.1.2-10"});

}  // namespace

}  // namespace derived
