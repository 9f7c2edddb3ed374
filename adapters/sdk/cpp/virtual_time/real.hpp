// The system's own functions, which this library hides.
#ifndef UCM_CTS_VIRTUAL_TIME_REAL_HPP
#define UCM_CTS_VIRTUAL_TIME_REAL_HPP

#include <dlfcn.h>
#include <pthread.h>
#include <time.h>

#include <atomic>

namespace ucm_cts {
namespace virtual_time {

/// The function `name` of the libraries that come after this one. It is looked up when it is first called, which may be before
/// any constructor has run.
template <class Function>
class Real {
  public:
    constexpr explicit Real(const char* name) : name_(name) {}

    template <class... Given>
    auto operator()(Given... given) {
        Function* function = found_.load(std::memory_order_relaxed);
        if (function == nullptr) {
            function = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name_));
            found_.store(function, std::memory_order_relaxed);
        }
        return function(given...);
    }

  private:
    const char* const name_;
    std::atomic<Function*> found_{nullptr};
};

// those that several files call
inline Real<int(clockid_t, timespec*)> real_clock_gettime("clock_gettime");
inline Real<int(clockid_t, int, const timespec*, timespec*)> real_clock_nanosleep("clock_nanosleep");
inline Real<int(pthread_mutex_t*)> real_unlock("pthread_mutex_unlock");
inline Real<long(long, ...)> real_syscall("syscall");

}  // namespace virtual_time
}  // namespace ucm_cts

#endif
