// Thread state: does the operating system have a thread asleep?
#ifndef UCM_CTS_THREAD_STATE_HPP
#define UCM_CTS_THREAD_STATE_HPP

#include <chrono>
#include <string>

#if defined(__linux__)
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#endif

namespace ucm_cts {

/// The number under which the operating system knows the calling thread; 0 where that is not known.
inline long system_id_of_this_thread() {
#if defined(__linux__)
    return syscall(SYS_gettid);
#else
    return 0;
#endif
}

/// Watches one thread. It is asleep when several checks in a row, `pause` apart, find it sleeping and find that it has
/// not run in between: it waits for something that does not come. Elsewhere than on Linux no thread is found asleep.
class SleepWatch {
  public:
    static std::chrono::microseconds pause() { return std::chrono::microseconds(200); }

    /// Checks once more: is the thread asleep?
    bool is_asleep(long system_id) {
        std::string waits;
        if (!is_sleeping(system_id, waits) || waits != waits_) {
            waits_ = waits;
            checks_ = 0;
        }
        return !waits.empty() && ++checks_ >= CHECKS;
    }

  private:
    static const int CHECKS = 4;

#if defined(__linux__)
    // `waits` becomes how often the thread has gone to sleep, as text
    static bool is_sleeping(long system_id, std::string& waits) {
        if (system_id == 0) {  // not yet begun
            return false;
        }
        const std::string path = "/proc/self/task/" + std::to_string(system_id) + "/status";
        std::FILE* const file = std::fopen(path.c_str(), "re");
        if (file == nullptr) {
            return false;
        }
        char line[256];
        bool sleeping = false;
        const char* const count = "voluntary_ctxt_switches:";
        while (std::fgets(line, sizeof line, file) != nullptr) {
            if (std::strncmp(line, "State:\tS", 8) == 0) {
                sleeping = true;
            } else if (sleeping && std::strncmp(line, count, std::strlen(count)) == 0) {
                waits = line;
            }
        }
        std::fclose(file);
        return sleeping;
    }
#else
    static bool is_sleeping(long, std::string&) { return false; }
#endif

    std::string waits_;
    int checks_ = 0;
};

}  // namespace ucm_cts

#endif
