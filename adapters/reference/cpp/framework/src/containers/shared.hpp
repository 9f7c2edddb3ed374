// What all containers of one runtime share.
#ifndef LWUCM_SRC_SHARED_HPP
#define LWUCM_SRC_SHARED_HPP

#include <atomic>
#include <mutex>

#include "containers/connections.hpp"
#include "execution/chain.hpp"
#include "lwucm/errors.hpp"
#include "lwucm/repository.hpp"
#include "platform/platform.hpp"

namespace lwucm {

/// One operation that changes the runtime is under way at a time; `operations` is held during its callbacks too.
/// `data` guards what the reading operations see, and is never held during a callback: a reader never waits for one.
struct Shared {
    Shared(const Repository& implementations, const Options& options)
        : repository(implementations), platform(options), connections(options.ids), component_ids(options.ids) {}

    const Repository repository;
    const Platform platform;
    std::mutex operations;
    std::atomic<Chain::Id> operating{nullptr};
    std::mutex data;
    Connections connections;
    Ids component_ids;
    bool destroyed = false;
};

/// Scope of one changing operation. UCM_ERROR if a callback of another one makes it, or a component which the operation
/// might have to wait for, as it is protected or called by a connector; or if the runtime is destroyed.
class Operation {
  public:
    explicit Operation(Shared& shared) : shared_(shared) {
        if (shared.operating.load() == Chain::current()) {
            throw UCM_ERROR("a callback may not change the runtime that makes it");
        }
        if (Awaited::now()) {
            throw UCM_ERROR("a component that is protected, or called by a connector, may not change the runtime");
        }
        shared.operations.lock();
        if (shared.destroyed) {
            shared.operations.unlock();
            throw UCM_ERROR("the runtime is destroyed");
        }
        shared.operating.store(Chain::current());
    }
    ~Operation() {
        shared_.operating.store(nullptr);
        shared_.operations.unlock();
    }
    Operation(const Operation&) = delete;
    Operation& operator=(const Operation&) = delete;

  private:
    Shared& shared_;
};

/// Carries out callbacks that must all be tried, and remembers the first failure.
class Attempts {
  public:
    template <class Callback>
    bool make(const char* what, Callback callback) {
        try {
            callback();
            return true;
        } catch (const std::exception& error) {
            fail(std::string(what) + " failed: " + error.what());
        } catch (...) {
            fail(std::string(what) + " failed");
        }
        return false;
    }

    /// UCM_ERROR if anything failed.
    void check() const {
        if (!failure_.empty()) {
            throw UCM_ERROR(failure_);
        }
    }

  private:
    void fail(const std::string& text) {
        if (failure_.empty()) {
            failure_ = text;
        }
    }

    std::string failure_;
};

}  // namespace lwucm

#endif
