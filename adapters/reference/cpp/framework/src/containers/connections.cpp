#include "containers/connections.hpp"

#include <algorithm>

namespace lwucm {

namespace {

template <class Index, class Key>
void erase_from(Index& index, const Key& key, connectionId id) {
    const auto range = index.equal_range(key);
    for (auto entry = range.first; entry != range.second; ++entry) {
        if (entry->second == id) {
            index.erase(entry);
            return;
        }
    }
}

template <class Index, class Key>
void append(std::vector<connectionId>& ids, const Index& index, const Key& key) {
    const auto range = index.equal_range(key);
    for (auto entry = range.first; entry != range.second; ++entry) {
        ids.push_back(entry->second);
    }
}

}  // namespace

const Connection& Connections::add(std::shared_ptr<Instance> client, const std::string& port,
                                   std::shared_ptr<PortElementObject> to) {
    const connectionId id = ids_.next();
    by_client_.emplace(client.get(), id);
    by_target_.emplace(to.get(), id);
    return by_id_.emplace(id, Connection{id, std::move(client), port, std::move(to), ++last_serial_}).first->second;
}

void Connections::remove(connectionId id) {
    const auto found = by_id_.find(id);
    erase_from(by_client_, found->second.client.get(), id);
    erase_from(by_target_, found->second.to.get(), id);
    by_id_.erase(found);
    ids_.release(id);
}

const Connection* Connections::find(connectionId id) const {
    const auto found = by_id_.find(id);
    return found == by_id_.end() ? nullptr : &found->second;
}

std::vector<connectionId> Connections::of_client(const Instance& client) const {
    std::vector<connectionId> ids;
    append(ids, by_client_, &client);
    return latest_first(std::move(ids));
}

std::vector<connectionId> Connections::to_provider(const Instance& provider) const {
    std::vector<connectionId> ids;
    for (const std::shared_ptr<PortElementObject>& element : provider.given_out()) {
        append(ids, by_target_, element.get());
    }
    return latest_first(std::move(ids));
}

std::vector<connectionId> Connections::latest_first(std::vector<connectionId> ids) const {
    std::sort(ids.begin(), ids.end(), [this](connectionId one, connectionId other) {
        return by_id_.at(one).serial > by_id_.at(other).serial;
    });
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

bool Connections::in_use(const Instance& provider) const {
    for (const connectionId id : to_provider(provider)) {
        if (find(id)->client.get() != &provider) {
            return true;
        }
    }
    return false;
}

}  // namespace lwucm
