// All connections of one runtime, and the ids of components and connections.
#ifndef LWUCM_SRC_CONNECTIONS_HPP
#define LWUCM_SRC_CONNECTIONS_HPP

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "containers/instance.hpp"
#include "lwucm/options.hpp"

namespace lwucm {

/// Numbers for components or for connections. Counting and random ids are never used twice, reused ones as soon as they are free.
class Ids {
  public:
    explicit Ids(Options::Ids kind) : kind_(kind) {}

    std::int32_t next() {
        std::int32_t id = 0;
        if (kind_ == Options::Ids::counting) {
            return ++last_;
        }
        do {
            id = kind_ == Options::Ids::random ? any() : id + 1;
        } while (!taken_.insert(id).second);
        return id;
    }

    void release(std::int32_t id) {
        if (kind_ == Options::Ids::reused) {
            taken_.erase(id);
        }
    }

  private:
    std::int32_t any() {
        std::uniform_int_distribution<std::int32_t> all(std::numeric_limits<std::int32_t>::min());
        return all(random_);
    }

    const Options::Ids kind_;
    std::int32_t last_ = 0;
    std::set<std::int32_t> taken_;
    std::minstd_rand random_{std::random_device()()};
};

struct Connection {
    connectionId id;
    std::shared_ptr<Instance> client;
    std::string port;
    std::shared_ptr<PortElementObject> to;
    std::uint64_t serial;  // grows from one connection to the next
};

/// Knows each connection by id, by client and by what it leads to.
class Connections {
  public:
    explicit Connections(Options::Ids ids) : ids_(ids) {}

    const Connection& add(std::shared_ptr<Instance> client, const std::string& port,
                          std::shared_ptr<PortElementObject> to);
    void remove(connectionId id);

    /// The connection of that id, or null.
    const Connection* find(connectionId id) const;

    /// Ids of the instance's own connections, and of those that others have to a reference it gave out; latest first.
    std::vector<connectionId> of_client(const Instance& client) const;
    std::vector<connectionId> to_provider(const Instance& provider) const;

    /// The same ids, each once, latest connection first.
    std::vector<connectionId> latest_first(std::vector<connectionId> ids) const;

    /// Does another instance than `provider` itself have a connection to it?
    bool in_use(const Instance& provider) const;

  private:
    Ids ids_;
    std::uint64_t last_serial_ = 0;
    std::map<connectionId, Connection> by_id_;
    std::unordered_multimap<const Instance*, connectionId> by_client_;
    std::unordered_multimap<const PortElementObject*, connectionId> by_target_;
};

}  // namespace lwucm

#endif
