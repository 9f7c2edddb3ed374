#include "instance.hpp"

#include <algorithm>

#include "lwucm/errors.hpp"

namespace lwucm {

namespace {

std::shared_ptr<ComponentObject> make_body(const Implementation& implementation) {
    std::shared_ptr<ComponentObject> body = implementation.create();
    if (!body) {
        throw UCM_ERROR("implementation " + implementation.name + " gave no body");
    }
    return body;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

Instance::Instance(componentId id, ContainerImpl& container, std::shared_ptr<const Implementation> implementation)
    : id_(id),
      container_(container),
      implementation_(std::move(implementation)),
      body_(make_body(*implementation_)),
      connectable_(dynamic_cast<Connectable*>(body_.get())),
      execution_(implementation_, *body_) {
    for (const std::string& port : implementation_->required) {
        required_.push_back(Required{port, nullptr});
    }
}

Instance::State Instance::state() const {
    if (ready_) {
        return State::ready;
    }
    const bool complete =
        std::all_of(required_.begin(), required_.end(), [](const Required& r) { return r.to != nullptr; });
    return complete ? State::configured : State::initialized;
}

bool Instance::provides(const std::string& port) const { return contains(implementation_->provided, port); }

bool Instance::requires_port(const std::string& port) const { return contains(implementation_->required, port); }

bool Instance::is_connected(const std::string& port) const {
    return std::any_of(required_.begin(), required_.end(),
                       [&port](const Required& r) { return r.port == port && r.to != nullptr; });
}

void Instance::initialize(const Properties& configuration, const std::shared_ptr<Container>& container) {
    for (const Property& property : configuration) {
        if (contains(implementation_->attributes, property.name)) {
            implementation_->set_attribute(*body_, property.name, property.value);
        }
    }
    if (FragmentObject* fragment = dynamic_cast<FragmentObject*>(body_.get())) {
        fragment->set_container_interface(container);
    }
    execution_.enter([&] { body_->on_init(); });
}

void Instance::connect(const std::string& port, const std::shared_ptr<PortElementObject>& to) {
    find_required(port)->to = to;
    if (connectable_ == nullptr) {
        return;
    }
    try {
        execution_.enter([&] { connectable_->on_connect(port, to); });
    } catch (...) {
        find_required(port)->to = nullptr;
        throw;
    }
}

void Instance::disconnect(const std::string& port) {
    find_required(port)->to = nullptr;
    if (connectable_ != nullptr) {
        execution_.enter([&] { connectable_->on_disconnect(port); });
    }
}

void Instance::start() {
    PortConnections dependencies;
    dependencies.reserve(required_.size());
    for (const Required& required : required_) {
        dependencies.push_back(PortConnection{required.port, {required.to}});
    }
    execution_.enter([&] { body_->on_startup(dependencies); });
    ready_ = true;
}

void Instance::shut_down() {
    ready_ = false;
    execution_.enter([&] { body_->on_shutdown(); });
}

void Instance::remove() {
    try {
        execution_.enter([&] { body_->on_remove(); });
    } catch (...) {
        execution_.close();
        throw;
    }
    execution_.close();
}

std::shared_ptr<PortElementObject> Instance::ask_port_element(const std::string& port) {
    return execution_.guarded(port, body_->get_portElement(port));
}

void Instance::remember(const std::shared_ptr<PortElementObject>& element) {
    if (std::find(given_out_.begin(), given_out_.end(), element) == given_out_.end()) {
        given_out_.push_back(element);
    }
}

Instance::Required* Instance::find_required(const std::string& port) {
    const auto found =
        std::find_if(required_.begin(), required_.end(), [&port](const Required& r) { return r.port == port; });
    return found == required_.end() ? nullptr : &*found;
}

}  // namespace lwucm
