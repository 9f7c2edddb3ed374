#include "connections.hpp"

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

std::vector<connectionId> latest_first(std::vector<connectionId> ids) {
    std::sort(ids.begin(), ids.end(), std::greater<connectionId>());
    return ids;
}

}  // namespace

const Connection& Connections::add(std::shared_ptr<Instance> client, const std::string& port,
                                   std::shared_ptr<PortElementObject> to) {
    const connectionId id = ++last_;
    by_client_.emplace(client.get(), id);
    by_target_.emplace(to.get(), id);
    return by_id_.emplace(id, Connection{id, std::move(client), port, std::move(to)}).first->second;
}

void Connections::remove(connectionId id) {
    const auto found = by_id_.find(id);
    erase_from(by_client_, found->second.client.get(), id);
    erase_from(by_target_, found->second.to.get(), id);
    by_id_.erase(found);
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

bool Connections::in_use(const Instance& provider) const {
    for (const connectionId id : to_provider(provider)) {
        if (find(id)->client.get() != &provider) {
            return true;
        }
    }
    return false;
}

}  // namespace lwucm
