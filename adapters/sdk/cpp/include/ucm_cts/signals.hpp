// Backtraces for people: of a crash, and of all threads when the harness sends SIGUSR1 to a host that hangs.
#ifndef UCM_CTS_SIGNALS_HPP
#define UCM_CTS_SIGNALS_HPP

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string>

#if defined(__GLIBC__)
#include <execinfo.h>
#endif

namespace ucm_cts {
namespace detail {

/// The threads the SDK knows, in a form that a signal handler may read.
struct ThreadTable {
    static const std::size_t SIZE = 64;
    static const std::size_t LABEL = 48;

    struct Slot {
        std::atomic<int> state;  // 0 free, 1 being filled or emptied, 2 in use
        pthread_t thread;
        char label[LABEL];
    };

    Slot slots[SIZE];
};

inline ThreadTable& thread_table() {
    static ThreadTable table;  // zero-initialised: needs no guard that a signal handler could wait for
    return table;
}

inline void write_text(const char* text) {
    // nothing can be done about a stderr that is gone
    const ssize_t ignored = write(STDERR_FILENO, text, std::strlen(text));
    static_cast<void>(ignored);
}

inline void write_backtrace() {
#if defined(__GLIBC__)
    void* frames[64];
    backtrace_symbols_fd(frames, backtrace(frames, 64), STDERR_FILENO);
#else
    write_text("(no backtrace on this platform)\n");
#endif
}

/// Writes the calling thread's label and backtrace, one thread at a time.
inline void write_own_backtrace(const char* why) {
    static std::atomic_flag writing = ATOMIC_FLAG_INIT;
    for (int tries = 0; writing.test_and_set(std::memory_order_acquire) && tries < 500; ++tries) {
        usleep(1000);
    }
    const char* label = "unknown to the SDK";
    for (ThreadTable::Slot& slot : thread_table().slots) {
        if (slot.state.load(std::memory_order_acquire) == 2 && pthread_equal(slot.thread, pthread_self()) != 0) {
            label = slot.label;
        }
    }
    write_text("ucm_cts: ");
    write_text(why);
    write_text(", thread: ");
    write_text(label);
    write_text("\n");
    write_backtrace();
    writing.clear(std::memory_order_release);
}

inline void on_crash(int number) {
    const int saved = number;
    write_own_backtrace(saved == SIGSEGV   ? "SIGSEGV"
                        : saved == SIGABRT ? "SIGABRT"
                        : saved == SIGBUS  ? "SIGBUS"
                        : saved == SIGFPE  ? "SIGFPE"
                                           : "SIGILL");
    signal(number, SIG_DFL);
    raise(number);  // delivered when this handler returns, so that the parent sees the true signal
}

inline void on_dump_request(int, siginfo_t* info, void*) {
    const int saved_errno = errno;
#if defined(SI_TKILL)
    const bool forwarded = info->si_code == SI_TKILL;
#else
    const bool forwarded = true;  // one thread must do
    static_cast<void>(info);
#endif
    if (!forwarded) {
        for (ThreadTable::Slot& slot : thread_table().slots) {
            if (slot.state.load(std::memory_order_acquire) == 2 && pthread_equal(slot.thread, pthread_self()) == 0) {
                pthread_kill(slot.thread, SIGUSR1);
            }
        }
    }
    write_own_backtrace("where it is");
    errno = saved_errno;
}

}  // namespace detail

/// Makes the calling thread known, for the life of the object.
class KnownThread {
  public:
    explicit KnownThread(const std::string& label) {
        for (detail::ThreadTable::Slot& slot : detail::thread_table().slots) {
            int expected = 0;
            if (slot.state.compare_exchange_strong(expected, 1)) {
                slot.thread = pthread_self();
                const std::size_t size = label.copy(slot.label, detail::ThreadTable::LABEL - 1);
                slot.label[size] = '\0';
                slot.state.store(2, std::memory_order_release);
                slot_ = &slot;
                break;
            }
        }
    }

    ~KnownThread() {
        if (slot_ != nullptr) {
            slot_->state.store(1, std::memory_order_release);
            slot_->state.store(0, std::memory_order_release);
        }
    }

    KnownThread(const KnownThread&) = delete;
    KnownThread& operator=(const KnownThread&) = delete;

  private:
    detail::ThreadTable::Slot* slot_ = nullptr;
};

/// For a stand-alone host. SIGPIPE is ignored: a write to a harness that is gone fails, and the host ends.
inline void install_signal_handlers() {
    signal(SIGPIPE, SIG_IGN);
#if defined(__GLIBC__)
    void* frame = nullptr;
    backtrace(&frame, 1);  // the first call allocates, which a handler must not
#endif
    struct sigaction dump;
    std::memset(&dump, 0, sizeof dump);
    dump.sa_sigaction = detail::on_dump_request;
    dump.sa_flags = SA_SIGINFO | SA_RESTART;
    sigaction(SIGUSR1, &dump, nullptr);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // sanitizers report crashes themselves
    static char stack[1 << 16];  // a stack that has overflown cannot hold a handler
    stack_t alternate;
    std::memset(&alternate, 0, sizeof alternate);
    alternate.ss_sp = stack;
    alternate.ss_size = sizeof stack;
    sigaltstack(&alternate, nullptr);
    struct sigaction crash;
    std::memset(&crash, 0, sizeof crash);
    crash.sa_handler = detail::on_crash;
    crash.sa_flags = SA_ONSTACK;
    for (const int number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL}) {
        sigaction(number, &crash, nullptr);
    }
#endif
}

}  // namespace ucm_cts

#endif
