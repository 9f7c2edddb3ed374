// Waits of many kinds. Each case prints what it got, and how many seconds had passed since the program began.
#include <errno.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace {

using std::chrono::seconds;

const std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();

void say(const std::string& what) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - began;
    std::printf("%s %.1f\n", what.c_str(), passed.count());
    std::fflush(stdout);
}

void say(const char* what) { say(std::string(what)); }

void say(bool what) { say(what ? "true" : "false"); }

void wait(int duration) { std::this_thread::sleep_for(seconds(duration)); }

timespec calendar_in(int duration) {
    timespec moment;
    clock_gettime(CLOCK_REALTIME, &moment);
    moment.tv_sec += duration;
    return moment;
}

void several_clocks() {
    const auto calendar = std::chrono::system_clock::now();
    const time_t second = time(nullptr);
    wait(3600);
    say(std::chrono::system_clock::now() - calendar >= seconds(3600));
    say(time(nullptr) - second >= 3600);
}

void condition() {
    std::mutex mutex;
    std::condition_variable changed;
    bool is_done = false;
    std::thread other([&] {
        wait(3);
        const std::lock_guard<std::mutex> lock(mutex);
        is_done = true;
        changed.notify_all();
    });
    {
        std::unique_lock<std::mutex> lock(mutex);
        say(changed.wait_for(lock, seconds(2), [&] { return is_done; }));
        say(changed.wait_until(lock, std::chrono::system_clock::now() + seconds(9), [&] { return is_done; }));
    }
    other.join();
}

void conditions_of_either_clock() {
    for (const clockid_t clock : {CLOCK_REALTIME, CLOCK_MONOTONIC}) {
        pthread_condattr_t attributes;
        pthread_condattr_init(&attributes);
        pthread_condattr_setclock(&attributes, clock);
        pthread_cond_t condition;
        pthread_cond_init(&condition, &attributes);
        pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
        timespec moment;
        clock_gettime(clock, &moment);
        moment.tv_sec += 4;
        pthread_mutex_lock(&mutex);
        say(pthread_cond_timedwait(&condition, &mutex, &moment) == ETIMEDOUT);
        pthread_mutex_unlock(&mutex);
    }
}

void timed_mutex() {
    std::timed_mutex mutex;
    mutex.lock();
    std::thread patient([&] {
        say(mutex.try_lock_for(seconds(2)));
        say(mutex.try_lock_for(seconds(9)));
        mutex.unlock();
    });
    wait(5);
    mutex.unlock();
    patient.join();
}

void recursive_mutex() {
    std::recursive_mutex mutex;
    mutex.lock();
    mutex.lock();
    std::thread other([&] {
        const std::lock_guard<std::recursive_mutex> lock(mutex);
        say("other");
    });
    wait(1);
    mutex.unlock();
    wait(1);
    mutex.unlock();
    other.join();
}

void read_write_lock() {
    pthread_rwlock_t lock = PTHREAD_RWLOCK_INITIALIZER;
    pthread_rwlock_wrlock(&lock);
    std::vector<std::thread> readers;
    for (int number = 0; number < 3; ++number) {
        readers.emplace_back([&] {
            pthread_rwlock_rdlock(&lock);
            wait(1);
            pthread_rwlock_unlock(&lock);
        });
    }
    wait(2);
    pthread_rwlock_unlock(&lock);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // so that they have it
    const timespec soon = calendar_in(0);
    say(pthread_rwlock_timedwrlock(&lock, &soon) == ETIMEDOUT);
    for (std::thread& reader : readers) {
        reader.join();
    }
    say("all have read");
}

void semaphore() {
    sem_t semaphore;
    sem_init(&semaphore, 0, 0);
    const timespec soon = calendar_in(4);
    say(sem_timedwait(&semaphore, &soon) == 0);
    std::thread other([&] {
        wait(2);
        sem_post(&semaphore);
    });
    sem_wait(&semaphore);
    say("posted");
    other.join();
}

void future() {
    std::future<int> later = std::async(std::launch::async, [] {
        wait(7);
        return 5;
    });
    say(later.wait_for(seconds(2)) == std::future_status::ready);
    say(std::to_string(later.get()));
}

void threads() {
    std::vector<std::thread> all;
    for (const int duration : {3, 1, 2}) {
        all.emplace_back([duration] {
            wait(duration);
            say(std::to_string(duration));
        });
    }
    for (std::thread& one : all) {
        one.join();
    }
}

void detached() {
    std::mutex mutex;
    std::condition_variable changed;
    bool is_done = false;
    std::thread([&] {
        wait(8);
        const std::lock_guard<std::mutex> lock(mutex);
        is_done = true;
        changed.notify_one();
    }).detach();
    std::unique_lock<std::mutex> lock(mutex);
    changed.wait(lock, [&] { return is_done; });
    say("done");
}

void exits_early() {
    pthread_t thread;
    pthread_create(
        &thread, nullptr,
        [](void*) -> void* {
            wait(6);
            pthread_exit(nullptr);
        },
        nullptr);
    pthread_join(thread, nullptr);
    wait(1);
    say("joined");
}

void contention() {
    std::mutex mutex;
    long count = 0;
    std::vector<std::thread> all;
    for (int number = 0; number < 8; ++number) {
        all.emplace_back([&] {
            for (int turn = 0; turn < 5000; ++turn) {
                const std::lock_guard<std::mutex> lock(mutex);
                ++count;
            }
        });
    }
    for (std::thread& one : all) {
        one.join();
    }
    std::printf("%ld\n", count);
}

void polling() {
    std::atomic<bool> is_done{false};
    std::thread other([&] {
        wait(1);
        is_done = true;
    });
    while (!is_done) {
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    say("seen");
    other.join();
}

void own_locks() {
    pthread_mutexattr_t attributes;
    pthread_mutexattr_init(&attributes);
    pthread_mutexattr_settype(&attributes, PTHREAD_MUTEX_ERRORCHECK);
    pthread_mutex_t mutex;
    pthread_mutex_init(&mutex, &attributes);
    pthread_mutex_lock(&mutex);
    say(pthread_mutex_lock(&mutex) == EDEADLK);
    pthread_rwlock_t lock = PTHREAD_RWLOCK_INITIALIZER;
    pthread_rwlock_wrlock(&lock);
    say(pthread_rwlock_rdlock(&lock) == EDEADLK);
}

void error_number() {
    std::mutex mutex;
    mutex.lock();
    std::thread other([&] {
        errno = 0;
        mutex.lock();
        say(errno == 0);
        mutex.unlock();
    });
    wait(1);
    mutex.unlock();
    other.join();
}

/// A signal may come while the thread changes the clock. Its handler calls what a handler may call.
void signals() {
    static sem_t semaphore;
    sem_init(&semaphore, 0, 0);
    static std::atomic<int> came;
    std::atomic<bool> is_done{false};
    struct sigaction action = {};
    action.sa_handler = [](int) {
        timespec time;
        clock_gettime(CLOCK_MONOTONIC, &time);
        sem_post(&semaphore);
        ++came;
    };
    action.sa_flags = SA_RESTART;
    sigaction(SIGUSR1, &action, nullptr);
    std::thread interrupted([&] {
        std::condition_variable changed;
        while (!is_done) {
            changed.notify_all();
        }
    });
    std::thread waiting([] {
        for (int number = 0; number < 200; ++number) {
            sem_wait(&semaphore);
        }
    });
    while (came < 200) {
        const int before = came;
        pthread_kill(interrupted.native_handle(), SIGUSR1);
        while (came == before) {
        }
    }
    waiting.join();
    is_done = true;
    interrupted.join();
    std::printf("served\n");
}

void detaches_itself() {
    static std::atomic<int> over;
    for (int number = 0; number < 500; ++number) {
        pthread_t* const thread = new pthread_t;
        pthread_create(
            thread, nullptr,
            [](void*) -> void* {
                pthread_detach(pthread_self());
                ++over;
                return nullptr;
            },
            nullptr);
        delete thread;
    }
    while (over < 500) {
        wait(1);
    }
    std::printf("over\n");
}

void looping() {
    std::atomic<bool> is_done{false};
    std::thread other([&] {
        while (!is_done) {
        }
    });
    wait(60);
    is_done = true;
    other.join();
    say("done");
}

void forked() {
    std::thread other([] { wait(1000); });
    const pid_t child = fork();
    if (child == 0) {
        wait(20);
        say("child");
        _exit(0);
    }
    waitpid(child, nullptr, 0);
    other.join();
    say("parent");
}

}  // namespace

int main(int argc, char** argv) {
    const std::map<std::string, std::function<void()>> cases = {
        {"sleep", [] { wait(3600); say("slept"); }},
        {"several clocks", several_clocks},
        {"condition", condition},
        {"conditions of either clock", conditions_of_either_clock},
        {"timed mutex", timed_mutex},
        {"recursive mutex", recursive_mutex},
        {"read-write lock", read_write_lock},
        {"semaphore", semaphore},
        {"future", future},
        {"threads", threads},
        {"detached", detached},
        {"exits early", exits_early},
        {"contention", contention},
        {"polling", polling},
        {"own locks", own_locks},
        {"error number", error_number},
        {"signals", signals},
        {"detaches itself", detaches_itself},
        {"looping", looping},
        {"forked", forked},
    };
    cases.at(argc > 1 ? argv[1] : "")();
}
