// Held: what a body holds of others, and what it has sent them.
#ifndef UCM_CTS_HELD_HPP
#define UCM_CTS_HELD_HPP

#include <algorithm>
#include <iterator>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/data_types.hpp"

namespace ucm_cts {

/// The references and the container interface that the framework has given to a body, and the body's own buffers.
class Held {
  public:
    void keep(const std::vector<PortConnection>& connections) {
        std::lock_guard<std::mutex> lock(mutex_);
        connections_ = connections;
    }

    void keep(const std::shared_ptr<ContainerInterface>& container) {
        std::lock_guard<std::mutex> lock(mutex_);
        container_ = container;
    }

    /// Those that were given for required port element `port`.
    std::vector<Reference> references(const std::string& port) {
        std::vector<Reference> found;
        std::lock_guard<std::mutex> lock(mutex_);
        for (const PortConnection& connection : connections_) {
            if (connection.from_port == port) {
                std::copy_if(connection.to_port.begin(), connection.to_port.end(), std::back_inserter(found),
                             [](const Reference& reference) { return reference != nullptr; });
            }
        }
        return found;
    }

    /// Null if none was given.
    std::shared_ptr<ContainerInterface> container() {
        std::lock_guard<std::mutex> lock(mutex_);
        return container_;
    }

    /// What a caller sends is its own, which it overwrites when the call is over. It stays where it is, so that a framework
    /// that reads it later reads wrong values and does not crash.
    std::shared_ptr<Data> buffer(const Data& content) {
        const std::shared_ptr<Data> own = std::make_shared<Data>(content);
        std::lock_guard<std::mutex> lock(mutex_);
        sent_.push_back(own);
        return own;
    }

    /// Lets go of everything.
    void forget() {
        std::vector<PortConnection> connections;
        std::shared_ptr<ContainerInterface> container;
        std::lock_guard<std::mutex> lock(mutex_);
        connections.swap(connections_);
        container.swap(container_);
        sent_.clear();
    }

  private:
    std::mutex mutex_;
    std::vector<PortConnection> connections_;
    std::shared_ptr<ContainerInterface> container_;
    std::vector<std::shared_ptr<Data>> sent_;
};

}  // namespace ucm_cts

#endif
