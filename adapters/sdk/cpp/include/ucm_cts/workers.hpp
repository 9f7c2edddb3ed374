// Workers: the threads that a scenario names.
#ifndef UCM_CTS_WORKERS_HPP
#define UCM_CTS_WORKERS_HPP

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "ucm_cts/signals.hpp"
#include "ucm_cts/thread_state.hpp"

namespace ucm_cts {

/// Threads by name, each made when its first task is queued, each doing its tasks in order.
class Workers {
  public:
    explicit Workers(std::chrono::milliseconds patience) : patience_(patience) {}

    ~Workers() {
        for (auto& entry : workers_) {
            if (entry.second->thread.joinable()) {  // not finished: something went wrong on the way
                entry.second->abandon();
            }
        }
    }

    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    /// Tasks must not throw, and must keep alive what they use: a stuck thread is left behind.
    void queue(const std::string& name, std::function<void()> task) {
        std::shared_ptr<Worker> worker;
        {
            std::lock_guard<std::mutex> lock(mutex_);
            const auto found = workers_.find(name);
            worker = found != workers_.end() ? found->second : make(name);
        }
        std::lock_guard<std::mutex> lock(worker->mutex);
        worker->tasks.push_back(std::move(task));
        worker->changed.notify_all();
    }

    /// Waits until the worker, if there is one, has done all it was given; false when patience runs out.
    bool join(const std::string& name) {
        const std::shared_ptr<Worker> worker = find(name);
        return !worker || worker->wait_until_idle(std::chrono::steady_clock::now() + patience_);
    }

    /// Waits until it is clear where the worker is: `done` with all it was given, or `held`, as `holds(thread)` says, or
    /// `blocked` by the operating system; `running` when patience runs out.
    template <class Holds>
    const char* settle(const std::string& name, Holds holds) {
        const std::shared_ptr<Worker> worker = find(name);
        if (!worker) {
            return "done";
        }
        const auto deadline = std::chrono::steady_clock::now() + patience_;
        SleepWatch watch;
        while (true) {
            if (holds(worker->id)) {
                return "held";
            }
            if (watch.is_asleep(worker->system_id)) {
                return "blocked";
            }
            const auto now = std::chrono::steady_clock::now();
            if (worker->wait_until_idle(std::min(deadline, now + SleepWatch::pause()))) {
                return "done";
            }
            if (now >= deadline) {
                return "running";
            }
        }
    }

    /// Lets all workers end; returns the names of those that do not in time. Queue nothing afterwards.
    std::vector<std::string> finish() {
        std::vector<std::string> stuck;
        std::map<std::string, std::shared_ptr<Worker>> workers;
        {
            std::lock_guard<std::mutex> lock(mutex_);  // not held below: a worker may yet want to join another
            workers = workers_;
        }
        const auto deadline = std::chrono::steady_clock::now() + std::max(patience_, farewell());
        for (auto& entry : workers) {
            Worker& worker = *entry.second;
            if (worker.wait_until_idle(deadline)) {
                worker.quit();
                worker.thread.join();
            } else {
                worker.abandon();
                stuck.push_back(entry.first);
            }
        }
        return stuck;
    }

  private:
    struct Worker;

    // What workers have at least to end, in all: on a busy machine a thread may need longer than a short patience.
    static std::chrono::milliseconds farewell() { return std::chrono::milliseconds(400); }

    std::shared_ptr<Worker> find(const std::string& name) {
        std::lock_guard<std::mutex> lock(mutex_);
        const auto found = workers_.find(name);
        return found != workers_.end() ? found->second : nullptr;
    }

    std::shared_ptr<Worker> make(const std::string& name) {
        const std::shared_ptr<Worker> worker = std::make_shared<Worker>();
        const std::string label = "worker " + name;
        worker->thread = std::thread([worker, label] { worker->work(label); });
        worker->id = worker->thread.get_id();
        workers_[name] = worker;
        return worker;
    }

    struct Worker {
        void work(const std::string& label) {
            const KnownThread known(label);
            system_id = system_id_of_this_thread();
            std::unique_lock<std::mutex> lock(mutex);
            while (true) {
                changed.wait(lock, [this] { return quitting || !tasks.empty(); });
                if (tasks.empty()) {
                    return;
                }
                const std::function<void()> task = std::move(tasks.front());
                busy = true;
                tasks.pop_front();
                lock.unlock();
                task();
                lock.lock();
                busy = false;
                changed.notify_all();
            }
        }

        bool wait_until_idle(std::chrono::steady_clock::time_point deadline) {
            std::unique_lock<std::mutex> lock(mutex);
            return changed.wait_until(lock, deadline, [this] { return tasks.empty() && !busy; });
        }

        void quit() {
            std::lock_guard<std::mutex> lock(mutex);
            quitting = true;
            changed.notify_all();
        }

        // It ends if it ever comes back from where it is.
        void abandon() {
            std::lock_guard<std::mutex> lock(mutex);
            tasks.clear();
            quitting = true;
            thread.detach();
        }

        std::thread thread;
        std::thread::id id;  // stays when the thread is left behind
        std::atomic<long> system_id{0};
        std::mutex mutex;
        std::condition_variable changed;
        std::deque<std::function<void()>> tasks;
        bool busy = false;
        bool quitting = false;
    };

    const std::chrono::milliseconds patience_;
    std::mutex mutex_;
    std::map<std::string, std::shared_ptr<Worker>> workers_;
};

}  // namespace ucm_cts

#endif
