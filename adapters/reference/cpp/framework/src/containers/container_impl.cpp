#include "containers/container_impl.hpp"

#include <algorithm>
#include <set>

#include "containers/names.hpp"
#include "links/link_impl.hpp"

namespace lwucm {

namespace {

const char* const IMPLEMENTATION = "implementation";

}  // namespace

ContainerImpl::ContainerImpl(std::shared_ptr<Shared> shared) : shared_(std::move(shared)) {}

componentId ContainerImpl::add_component(const Properties& configValues) {
    Operation operation(*shared_);
    check_in_place();
    if (started_) {
        throw UCM_ERROR("components are added before start");
    }
    const std::shared_ptr<const Implementation> implementation = select(configValues);
    Demands demands = demands_of(*implementation);
    const componentId id = shared_->component_ids.next();
    std::shared_ptr<Instance> instance;
    Attempts attempts;
    const bool initialized = attempts.make("initialisation", [&] {
        instance = std::make_shared<Instance>(id, *this, implementation, std::move(demands), shared_->platform);
        instance->initialize(configValues, shared_from_this());
    });
    if (!initialized) {
        shared_->component_ids.release(id);
        attempts.check();
    }
    std::lock_guard<std::mutex> data(shared_->data);
    members_.push_back(std::move(instance));
    return id;
}

void ContainerImpl::remove_component(componentId comp_instance) {
    Operation operation(*shared_);
    const std::shared_ptr<Instance> member = find(comp_instance);
    if (shared_->platform.options.removal == Options::Removal::refuse) {
        check_removable(*member);
    }
    Attempts attempts;
    take_out(member, attempts);
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
    if (!client->requires_port(port_name)) {
        throw BAD_PARAMETER("no required port element " + quoted(port_name));
    }
    if (!to_port) {
        throw BAD_PARAMETER("the reference to connect is null");
    }
    check_configuring();
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
    check_configuring();
    Attempts attempts;
    undo(connection, attempts);
    attempts.check();
}

void ContainerImpl::start() {
    Operation operation(*shared_);
    check_in_place();
    const Options& options = shared_->platform.options;
    if (started_) {
        if (options.repetition == Options::Repetition::refuse) {
            throw UCM_ERROR("the container is started already");
        }
        return;
    }
    for (const std::shared_ptr<Instance>& member : members_) {
        if (member->state() == Instance::State::initialized && options.unconnected == Options::Unconnected::refuse) {
            throw UCM_ERROR("component " + std::to_string(member->id()) + " is not fully connected");
        }
    }
    start_members();
}

void ContainerImpl::stop() {
    Operation operation(*shared_);
    check_in_place();
    if (!started_ && shared_->platform.options.repetition == Options::Repetition::refuse) {
        throw UCM_ERROR("the container is not started");
    }
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

void ContainerImpl::start_members() {
    std::vector<std::shared_ptr<Instance>> order = members_;
    if (shared_->platform.options.order == Options::Order::reversed) {
        std::reverse(order.begin(), order.end());
    }
    Attempts attempts;
    for (const std::shared_ptr<Instance>& member : order) {
        if (!attempts.make("on_startup", [&] { member->start(); })) {
            shut_down_members(attempts);
            attempts.check();
        }
        startup_order_.push_back(member);
    }
    started_ = true;
    const bool begun = attempts.make("execution", [&] {
        for (const std::shared_ptr<Instance>& member : order) {
            member->open_ends();
        }
        for (const std::shared_ptr<Instance>& member : order) {
            member->begin_execution();
        }
    });
    if (!begun) {
        shut_down_members(attempts);
        attempts.check();
    }
}

void ContainerImpl::shut_down_members(Attempts& attempts) {
    for (const std::shared_ptr<Instance>& member : startup_order_) {
        member->shut_ends();
    }
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
    for (auto member = members_.rbegin(); member != members_.rend(); ++member) {
        leave_links(**member, attempts);
    }
    undo_all(connections_of(members_), attempts);
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

void ContainerImpl::check_configuring() const {
    if (started_) {
        throw UCM_ERROR("connections are made and undone before start or after stop");
    }
}

void ContainerImpl::check_removable(const Instance& member) const {
    if (member.state() == Instance::State::ready) {
        throw UCM_ERROR("stop the container before removing the component");
    }
    bool in_use = false;
    {
        std::lock_guard<std::mutex> data(shared_->data);
        in_use = shared_->connections.in_use(member);
    }
    for (const std::shared_ptr<LinkImpl>& link : member.links()) {
        in_use = in_use || link->needs(member);
    }
    if (in_use) {
        throw UCM_ERROR("another component is connected to the component");
    }
}

/// Removes it after all that must come first.
void ContainerImpl::take_out(const std::shared_ptr<Instance>& member, Attempts& attempts) {
    const auto started = std::find(startup_order_.begin(), startup_order_.end(), member);
    if (started != startup_order_.end()) {
        startup_order_.erase(started);
        member->shut_ends();
        member->end_execution();
        attempts.make("on_shutdown", [&] { member->shut_down(); });
    }
    leave_links(*member, attempts);
    undo_all(connections_of({member}), attempts);
    attempts.make("on_remove", [&] { member->remove(); });
    erase(*member);
}

/// Their own connections, and those of others to them; latest first.
std::vector<connectionId> ContainerImpl::connections_of(const std::vector<std::shared_ptr<Instance>>& members) const {
    std::lock_guard<std::mutex> data(shared_->data);
    std::vector<connectionId> ids;
    for (const std::shared_ptr<Instance>& member : members) {
        const std::vector<connectionId> own = shared_->connections.of_client(*member);
        const std::vector<connectionId> others = shared_->connections.to_provider(*member);
        ids.insert(ids.end(), own.begin(), own.end());
        ids.insert(ids.end(), others.begin(), others.end());
    }
    return shared_->connections.latest_first(std::move(ids));
}

void ContainerImpl::leave_links(const Instance& member, Attempts& attempts) {
    for (const std::shared_ptr<LinkImpl>& link : member.links()) {
        link->withdraw(member, attempts);
    }
}

std::shared_ptr<Instance> ContainerImpl::find(componentId id) const {
    const auto found = std::find_if(members_.begin(), members_.end(),
                                    [id](const std::shared_ptr<Instance>& m) { return m->id() == id; });
    if (found == members_.end()) {
        throw NOT_FOUND("no such component");
    }
    return *found;
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
    shared_->component_ids.release(member.id());
}

}  // namespace lwucm
