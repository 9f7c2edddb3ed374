// Mutants whose containers crash, hang, or use what has been freed (11.2.2, 12.10).
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <future>
#include <new>

#include "registry.hpp"

namespace {

/// Whether freed memory is overwritten, as some allocators do: its use is detected sooner then.
std::atomic<bool> overwriting{false};

}  // namespace

__attribute__((noinline)) void operator delete(void* freed) noexcept {
    if (overwriting && freed != nullptr) {
        volatile unsigned char* const bytes = static_cast<unsigned char*>(freed);
        for (std::size_t n = malloc_usable_size(freed); n > 0; --n) {
            bytes[n - 1] = 0x5a;  // volatile: compilers leave out writes to memory that is freed next
        }
    }
    std::free(freed);
}

void operator delete(void* freed, std::size_t) noexcept { operator delete(freed); }

namespace derived {

namespace {

using lwucm::ManagerImpl;

class CrashesInRemove final : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    void start() override {
        ManagerImpl::start();
        started_before_ = true;
    }

    void remove_component(lwucm::componentId id) override {
        if (started_before_) {
            static_cast<volatile int*>(nullptr)[0] = id;
        }
        ManagerImpl::remove_component(id);
    }

  private:
    bool started_before_ = false;
};
const bool a = breaks<CrashesInRemove>("crashes_in_remove", {"R-12.10-05"},
                                       "remove_component writes through a null pointer once the container has been "
                                       "started.");

class HangsInStop final : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    void stop() override {
        if (++stops_ == 2) {
            std::promise<void>().get_future().wait();
        }
        ManagerImpl::stop();
    }

  private:
    std::atomic<int> stops_{0};
};
const bool b = breaks<HangsInStop>("hangs_in_second_stop", {"R-12.10-10"}, "The second stop never returns.");

class UsesFreedMember final : public ManagerImpl {
  public:
    explicit UsesFreedMember(std::shared_ptr<lwucm::Shared> shared) : ManagerImpl(std::move(shared)) {
        overwriting = true;
    }

    void remove_component(lwucm::componentId id) override {
        const auto member = find(id).get();
        ManagerImpl::remove_component(id);
        member->ask_port_element("gone");
    }
};
const bool c = breaks<UsesFreedMember>("uses_freed_member", {"R-12.10-05"},
                                       "remove_component calls the body of the removed component after it has been freed.");

class UsesFreedConnection final : public ManagerImpl {
  public:
    explicit UsesFreedConnection(std::shared_ptr<lwucm::Shared> shared) : ManagerImpl(std::move(shared)) {
        overwriting = true;
    }

    void disconnect(lwucm::connectionId connection) override {
        const lwucm::Connection* const freed = shared_->connections.find(connection);
        ManagerImpl::disconnect(connection);
        freed->client->is_connected(freed->port);
    }
};
const bool d = breaks<UsesFreedConnection>("uses_freed_connection", {"R-12.10-08"},
                                           "disconnect reads the connection after it has freed it.");

}  // namespace

}  // namespace derived
