// Host: the process around an adapter. Serves the harness on standard input and output, or on a socket.
#ifndef UCM_CTS_HOST_HPP
#define UCM_CTS_HOST_HPP

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "ucm_cts/messages.hpp"
#include "ucm_cts/signals.hpp"

namespace ucm_cts {
namespace detail {

inline std::runtime_error system_error(const std::string& what) {
    return std::runtime_error(what + ": " + std::strerror(errno));
}

/// False when the other side is gone.
inline bool write_all(int fd, const char* data, std::size_t size) {
    while (size > 0) {
        const ssize_t written = write(fd, data, size);
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            return false;
        }
        data += written;
        size -= static_cast<std::size_t>(written);
    }
    return true;
}

/// Lines from a file descriptor.
class LineReader {
  public:
    explicit LineReader(int fd) : fd_(fd), buffer_(CHUNK) {}

    /// The next line without its newline, valid until the next call; false at the end.
    bool next(const char*& line, std::size_t& size) {
        std::size_t searched = begin_;
        while (true) {
            const char* const start = buffer_.data() + begin_;
            const void* const newline = std::memchr(buffer_.data() + searched, '\n', end_ - searched);
            if (newline != nullptr) {
                line = start;
                size = static_cast<std::size_t>(static_cast<const char*>(newline) - start);
                begin_ += size + 1;
                return true;
            }
            std::memmove(buffer_.data(), start, end_ - begin_);
            end_ -= begin_;
            begin_ = 0;
            searched = end_;
            if (!fill()) {
                return false;
            }
        }
    }

  private:
    bool fill() {
        if (buffer_.size() - end_ < CHUNK) {
            buffer_.resize(2 * buffer_.size());
        }
        ssize_t got;
        do {
            got = ::read(fd_, buffer_.data() + end_, CHUNK);
        } while (got < 0 && errno == EINTR);
        end_ += got > 0 ? static_cast<std::size_t>(got) : 0;
        return got > 0;
    }

    static const std::size_t CHUNK = 1 << 16;
    const int fd_;
    std::vector<char> buffer_;  // never cleared: that would cost more than a message
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
};

/// Answers until the harness closes its end, or until threads are stuck.
inline void serve(int in, int out, const Product& product, const AdapterFactory& make_adapter) {
    Answerer answerer(product, make_adapter, [out](const std::string& line) { write_all(out, line.data(), line.size()); });
    LineReader lines(in);
    const char* line = nullptr;
    std::size_t size = 0;
    std::string text;
    while (lines.next(line, size)) {
        if (size == 0) {
            continue;
        }
        text = answerer.answer(line, size);
        text += '\n';
        std::fflush(stdout);  // what the framework has printed comes before the answer
        const bool sent = write_all(out, text.data(), text.size());
        if (answerer.stuck()) {
            _exit(0);  // not exit: what the stuck threads use must not be torn down
        }
        if (!sent) {
            return;
        }
    }
}

/// Keeps the protocol's stream for the host alone: the framework's output goes to standard error.
inline int private_stdout() {
    std::fflush(stdout);
    const int fd = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    if (fd < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
        throw system_error("cannot set standard output aside");
    }
    return fd;
}

struct Listener {
    int fd;
    std::string address;
};

inline Listener listen_unix(const std::string& path) {
    sockaddr_un address;
    std::memset(&address, 0, sizeof address);
    address.sun_family = AF_UNIX;
    if (path.empty() || path.size() >= sizeof address.sun_path) {
        throw std::runtime_error("not a usable socket path: '" + path + "'");
    }
    path.copy(address.sun_path, path.size());
    struct stat there;
    if (lstat(path.c_str(), &there) == 0 && S_ISSOCK(there.st_mode)) {
        unlink(path.c_str());  // left behind by an earlier host
    }
    const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
    if (fd < 0 || bind(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 || listen(fd, 64) != 0) {
        throw system_error("cannot listen on " + path);
    }
    return Listener{fd, "unix:" + path};
}

inline Listener listen_tcp(const std::string& where) {
    const std::size_t colon = where.rfind(':');
    if (colon == std::string::npos) {
        throw std::runtime_error("expected tcp://host:port, got tcp://" + where);
    }
    std::string host = where.substr(0, colon);
    if (host.size() > 1 && host[0] == '[' && host[host.size() - 1] == ']') {
        host = host.substr(1, host.size() - 2);
    }
    addrinfo hints;
    std::memset(&hints, 0, sizeof hints);
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = AI_PASSIVE;
    addrinfo* found = nullptr;
    const int problem = getaddrinfo(host.c_str(), where.c_str() + colon + 1, &hints, &found);
    if (problem != 0) {
        throw std::runtime_error("cannot resolve " + where + ": " + gai_strerror(problem));
    }
    const int fd = socket(found->ai_family, found->ai_socktype, found->ai_protocol);
    const int yes = 1;
    setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    const bool bound = fd >= 0 && bind(fd, found->ai_addr, found->ai_addrlen) == 0 && listen(fd, 64) == 0;
    freeaddrinfo(found);
    if (!bound) {
        throw system_error("cannot listen on " + where);
    }
    sockaddr_storage actual;
    socklen_t size = sizeof actual;
    char port[16] = "";
    getsockname(fd, reinterpret_cast<sockaddr*>(&actual), &size);
    getnameinfo(reinterpret_cast<sockaddr*>(&actual), size, nullptr, 0, port, sizeof port, NI_NUMERICSERV);
    return Listener{fd, "tcp://" + where.substr(0, colon) + ":" + port};
}

/// Accepts for ever; each connection gets a process of its own, so that a crash ends one connection only.
inline void accept_all(const Listener& listener, const Product& product, const AdapterFactory& make_adapter) {
    std::printf("listening on %s\n", listener.address.c_str());
    std::fflush(stdout);
    signal(SIGCHLD, SIG_IGN);  // no zombies
    while (true) {
        const int connection = accept(listener.fd, nullptr, nullptr);
        if (connection < 0) {
            if (errno == EINTR || errno == ECONNABORTED) {
                continue;
            }
            throw system_error("cannot accept");
        }
        const pid_t child = fork();
        if (child < 0) {
            throw system_error("cannot fork");
        }
        if (child == 0) {
            close(listener.fd);
            signal(SIGCHLD, SIG_DFL);
            const int yes = 1;
            setsockopt(connection, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);  // no effect on other sockets
            serve(connection, connection, product, make_adapter);
            _exit(0);
        }
        close(connection);
    }
}

inline Listener listen_on(const std::string& address) {
    const std::string tcp = "tcp://";
    const std::string local = "unix:";
    if (address.compare(0, tcp.size(), tcp) == 0) {
        return listen_tcp(address.substr(tcp.size()));
    }
    if (address.compare(0, local.size(), local) == 0) {
        return listen_unix(address.substr(local.size()));
    }
    throw std::runtime_error("expected tcp://host:port or unix:/path, got " + address);
}

}  // namespace detail

/// The `main` of a stand-alone adapter.
inline int host_main(int argc, char** argv, const Product& product, const AdapterFactory& make_adapter) {
    const KnownThread known("main");
    install_signal_handlers();
    try {
        if (argc == 1) {
            detail::serve(STDIN_FILENO, detail::private_stdout(), product, make_adapter);
            return 0;
        }
        if (argc == 3 && std::string(argv[1]) == "--listen") {
            detail::accept_all(detail::listen_on(argv[2]), product, make_adapter);
        }
        const bool asked = argc == 2 && std::string(argv[1]) == "--help";
        std::fprintf(asked ? stdout : stderr,
                     "%s %s, an adapter for the UCM conformance test suite\n"
                     "usage: %s                                  serve on standard input and output\n"
                     "       %s --listen tcp://HOST:PORT         serve connections; port 0 takes a free one\n"
                     "       %s --listen unix:PATH\n",
                     product.name.c_str(), product.version.c_str(), argv[0], argv[0], argv[0]);
        return asked ? 0 : 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
        return 1;
    }
}

}  // namespace ucm_cts

#endif
