#include "container_impl.hpp"

#include <algorithm>
#include <set>

namespace lwucm {

namespace {

const char* const IMPLEMENTATION = "implementation";

std::string quoted(const std::string& name) { return "'" + name + "'"; }

}  // namespace

ContainerImpl::ContainerImpl(std::shared_ptr<Shared> shared) : shared_(std::move(shared)) {}

componentId ContainerImpl::add_component(const Properties& configValues) {
    Operation operation(*shared_);
    check_in_place();
    if (started_) {
        throw UCM_ERROR("components are added before start");
    }
    const std::shared_ptr<const Implementation> implementation = select(configValues);
    check_policies(*implementation);
    const componentId id = ++shared_->last_component;
    std::shared_ptr<Instance> instance;
    Attempts attempts;
    attempts.make("initialisation", [&] {
        instance = std::make_shared<Instance>(id, *this, implementation);
        instance->initialize(configValues, shared_from_this());
    });
    attempts.check();
    std::lock_guard<std::mutex> data(shared_->data);
    members_.push_back(std::move(instance));
    return id;
}

void ContainerImpl::remove_component(componentId comp_instance) {
    Operation operation(*shared_);
    const std::shared_ptr<Instance> member = find(comp_instance);
    if (!member) {
        throw NOT_FOUND("no such component");
    }
    if (member->state() == Instance::State::ready) {
        throw UCM_ERROR("stop the container before removing the component");
    }
    {
        std::lock_guard<std::mutex> data(shared_->data);
        if (shared_->connections.in_use(*member)) {
            throw UCM_ERROR("another component is connected to the component");
        }
    }
    Attempts attempts;
    undo_all(shared_->connections.of_client(*member), attempts);
    attempts.make("on_remove", [&] { member->remove(); });
    erase(*member);
    attempts.check();
}

std::shared_ptr<PortElementObject> ContainerImpl::get_port_element(componentId comp_instance,
                                                                   const std::string& port_name) {
    std::shared_ptr<Instance> member;
    {
        std::lock_guard<std::mutex> data(shared_->data);
        if (shared_->destroyed) {
            throw UCM_ERROR("the runtime is destroyed");
        }
        member = find(comp_instance);
    }
    if (!member) {
        throw NOT_FOUND("no such component");
    }
    if (!member->provides(port_name)) {
        throw NOT_FOUND("no provided port element " + quoted(port_name));
    }
    std::shared_ptr<PortElementObject> element;
    Attempts attempts;
    attempts.make("get_portElement", [&] { element = member->ask_port_element(port_name); });
    attempts.check();
    if (!element) {
        throw NOT_FOUND("the component gives no port element " + quoted(port_name));
    }
    std::lock_guard<std::mutex> data(shared_->data);
    member->remember(element);
    return element;
}

connectionId ContainerImpl::connect(componentId instance, const std::string& port_name,
                                    std::shared_ptr<PortElementObject> to_port) {
    Operation operation(*shared_);
    const std::shared_ptr<Instance> client = find(instance);
    if (!client) {
        throw NOT_FOUND("no such component");
    }
    if (!client->requires_port(port_name)) {
        throw BAD_PARAMETER("no required port element " + quoted(port_name));
    }
    if (!to_port) {
        throw BAD_PARAMETER("the reference to connect is null");
    }
    if (started_) {
        throw UCM_ERROR("connections are made before start");
    }
    if (client->is_connected(port_name)) {
        throw UCM_ERROR(quoted(port_name) + " is already connected");
    }
    Attempts attempts;
    attempts.make("on_connect", [&] { client->connect(port_name, to_port); });
    attempts.check();
    std::lock_guard<std::mutex> data(shared_->data);
    return shared_->connections.add(client, port_name, std::move(to_port)).id;
}

void ContainerImpl::disconnect(connectionId connection) {
    Operation operation(*shared_);
    const Connection* const found = shared_->connections.find(connection);
    if (found == nullptr || &found->client->container() != this) {
        throw NOT_FOUND("no such connection");
    }
    if (started_) {
        throw UCM_ERROR("connections are undone before start or after stop");
    }
    Attempts attempts;
    undo(connection, attempts);
    attempts.check();
}

void ContainerImpl::start() {
    Operation operation(*shared_);
    check_in_place();
    if (started_) {
        return;
    }
    for (const std::shared_ptr<Instance>& member : members_) {
        if (member->state() == Instance::State::initialized) {
            throw UCM_ERROR("component " + std::to_string(member->id()) + " is not fully connected");
        }
    }
    Attempts attempts;
    for (const std::shared_ptr<Instance>& member : members_) {
        if (!attempts.make("on_startup", [&] { member->start(); })) {
            shut_down_members(attempts);
            attempts.check();
        }
        startup_order_.push_back(member);
    }
    for (const std::shared_ptr<Instance>& member : members_) {
        if (!attempts.make("execution", [&] { member->begin_execution(); })) {
            shut_down_members(attempts);
            attempts.check();
        }
    }
    started_ = true;
}

void ContainerImpl::stop() {
    Operation operation(*shared_);
    check_in_place();
    Attempts attempts;
    shut_down_members(attempts);
    attempts.check();
}

componentIds ContainerImpl::get_components() {
    std::lock_guard<std::mutex> data(shared_->data);
    if (shared_->destroyed) {
        throw UCM_ERROR("the runtime is destroyed");
    }
    check_in_place();
    componentIds ids;
    ids.reserve(members_.size());
    for (const std::shared_ptr<Instance>& member : members_) {
        ids.push_back(member->id());
    }
    return ids;
}

void ContainerImpl::shut_down_members(Attempts& attempts) {
    for (const std::shared_ptr<Instance>& member : startup_order_) {
        member->end_execution();
    }
    while (!startup_order_.empty()) {
        const std::shared_ptr<Instance> last = startup_order_.back();
        startup_order_.pop_back();
        attempts.make("on_shutdown", [&] { last->shut_down(); });
    }
    started_ = false;
}

void ContainerImpl::disconnect_members(Attempts& attempts) {
    std::set<connectionId, std::greater<connectionId>> ids;
    {
        std::lock_guard<std::mutex> data(shared_->data);
        for (const std::shared_ptr<Instance>& member : members_) {
            const std::vector<connectionId> own = shared_->connections.of_client(*member);
            const std::vector<connectionId> others = shared_->connections.to_provider(*member);
            ids.insert(own.begin(), own.end());
            ids.insert(others.begin(), others.end());
        }
    }
    undo_all(std::vector<connectionId>(ids.begin(), ids.end()), attempts);
}

void ContainerImpl::remove_members(Attempts& attempts) {
    while (!members_.empty()) {
        const std::shared_ptr<Instance> last = members_.back();
        attempts.make("on_remove", [&] { last->remove(); });
        erase(*last);
    }
    std::lock_guard<std::mutex> data(shared_->data);
    removed_ = true;
}

void ContainerImpl::check_in_place() const {
    if (removed_) {
        throw UCM_ERROR("the container has been removed");
    }
}

std::shared_ptr<Instance> ContainerImpl::find(componentId id) const {
    const auto found = std::find_if(members_.begin(), members_.end(),
                                    [id](const std::shared_ptr<Instance>& m) { return m->id() == id; });
    return found == members_.end() ? nullptr : *found;
}

std::shared_ptr<const Implementation> ContainerImpl::select(const Properties& configValues) const {
    std::set<std::string> names;
    std::shared_ptr<const Implementation> implementation;
    for (const Property& property : configValues) {
        if (!names.insert(property.name).second) {
            throw UCM_ERROR("property " + quoted(property.name) + " is given twice");
        }
        if (property.name == IMPLEMENTATION) {
            implementation = shared_->repository.find(property.value);
        }
    }
    if (!implementation) {
        throw UCM_ERROR("the configuration names no known implementation");
    }
    names.erase(IMPLEMENTATION);
    for (const std::string& attribute : implementation->attributes) {
        names.erase(attribute);
    }
    if (!names.empty()) {
        throw UCM_ERROR("unknown property " + quoted(*names.begin()));
    }
    return implementation;
}

void ContainerImpl::undo(connectionId id, Attempts& attempts) {
    const Connection connection = *shared_->connections.find(id);
    {
        std::lock_guard<std::mutex> data(shared_->data);
        shared_->connections.remove(id);
    }
    attempts.make("on_disconnect", [&] { connection.client->disconnect(connection.port); });
}

void ContainerImpl::undo_all(const std::vector<connectionId>& ids, Attempts& attempts) {
    for (const connectionId id : ids) {
        undo(id, attempts);
    }
}

void ContainerImpl::erase(const Instance& member) {
    std::shared_ptr<Instance> last_reference;  // the body is not destroyed while `data` is held
    std::lock_guard<std::mutex> data(shared_->data);
    const auto found = std::find_if(members_.begin(), members_.end(),
                                    [&member](const std::shared_ptr<Instance>& m) { return m.get() == &member; });
    last_reference = std::move(*found);
    members_.erase(found);
}

}  // namespace lwucm
