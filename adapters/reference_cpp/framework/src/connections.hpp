// All connections of one runtime.
#ifndef LWUCM_SRC_CONNECTIONS_HPP
#define LWUCM_SRC_CONNECTIONS_HPP

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "instance.hpp"

namespace lwucm {

struct Connection {
    connectionId id;
    std::shared_ptr<Instance> client;
    std::string port;
    std::shared_ptr<PortElementObject> to;
};

/// Knows each connection by id, by client and by what it leads to. Ids grow and are never used twice.
class Connections {
  public:
    const Connection& add(std::shared_ptr<Instance> client, const std::string& port,
                          std::shared_ptr<PortElementObject> to);
    void remove(connectionId id);

    /// The connection of that id, or null.
    const Connection* find(connectionId id) const;

    /// Ids of the instance's own connections, and of those that others have to a reference it gave out; latest first.
    std::vector<connectionId> of_client(const Instance& client) const;
    std::vector<connectionId> to_provider(const Instance& provider) const;

    /// Does another instance than `provider` itself have a connection to it?
    bool in_use(const Instance& provider) const;

  private:
    connectionId last_ = 0;
    std::map<connectionId, Connection> by_id_;
    std::unordered_multimap<const Instance*, connectionId> by_client_;
    std::unordered_multimap<const PortElementObject*, connectionId> by_target_;
};

}  // namespace lwucm

#endif
