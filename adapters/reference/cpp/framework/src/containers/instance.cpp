#include "containers/instance.hpp"

#include <algorithm>

#include "containers/names.hpp"
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

}  // namespace

Instance::Instance(componentId id, ContainerImpl& container, std::shared_ptr<const Implementation> implementation,
                   Demands demands, const Platform& platform)
    : id_(id),
      container_(container),
      implementation_(std::move(implementation)),
      body_(make_body(*implementation_)),
      connectable_(dynamic_cast<Connectable*>(body_.get())),
      execution_(id, implementation_, std::move(demands), *body_, platform) {
    for (const std::string& port : implementation_->required) {
        required_.push_back(Required{port, nullptr, nullptr});
    }
}

Instance::State Instance::state() const {
    if (ready_) {
        return State::ready;
    }
    const bool complete =
        std::all_of(required_.begin(), required_.end(), [](const Required& r) { return r.to != nullptr; });
    const bool usable =
        std::all_of(joined_.begin(), joined_.end(), [](const Joined& one) { return one.end->is_usable(); });
    return complete && usable ? State::configured : State::initialized;
}

bool Instance::provides(const std::string& port) const { return contains(implementation_->provided, port); }

bool Instance::requires_port(const std::string& port) const { return contains(implementation_->required, port); }

bool Instance::is_connected(const std::string& port) const {
    return std::any_of(required_.begin(), required_.end(),
                       [&port](const Required& r) { return r.port == port && r.to != nullptr; });
}

InterfacePtr Instance::interface_of(const std::string& port) const {
    const auto found = implementation_->interfaces.find(port);
    return found == implementation_->interfaces.end() ? nullptr : found->second;
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
    Required& required = *find_required(port);
    required.seen = execution_.required(port, to);
    required.to = to;
    if (connectable_ == nullptr) {
        return;
    }
    try {
        execution_.enter([&] { connectable_->on_connect(port, required.seen); });
    } catch (...) {
        required.to = required.seen = nullptr;
        throw;
    }
}

void Instance::disconnect(const std::string& port) {
    Required& required = *find_required(port);
    required.to = required.seen = nullptr;
    if (connectable_ != nullptr) {
        execution_.enter([&] { connectable_->on_disconnect(port); });
    }
}

void Instance::start() {
    PortConnections dependencies;
    dependencies.reserve(required_.size());
    for (const Required& required : required_) {
        dependencies.push_back(PortConnection{required.port, {required.seen}});
    }
    for (PortConnection& service : execution_.services()) {
        dependencies.push_back(std::move(service));
    }
    notify_ends(&End::starting);
    execution_.open();
    try {
        execution_.enter([&] { body_->on_startup(dependencies); });
    } catch (...) {
        execution_.end();
        shut_ends();
        notify_ends(&End::shutting_down);
        throw;
    }
    ready_ = true;
}

void Instance::notify_ends(void (End::*what)()) const {
    for (const Joined& one : joined_) {
        ((*one.end).*what)();
    }
}

void Instance::end_execution() {
    notify_ends(&End::await_calls);
    execution_.end();
}

void Instance::shut_down() {
    notify_ends(&End::shutting_down);
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
    return execution_.provided(port, body_->get_portElement(port));
}

void Instance::remember(const std::shared_ptr<PortElementObject>& element) {
    if (std::find(given_out_.begin(), given_out_.end(), element) == given_out_.end()) {
        given_out_.push_back(element);
    }
}

void Instance::join(std::shared_ptr<LinkImpl> link, std::shared_ptr<End> end) {
    joined_.push_back(Joined{std::move(link), std::move(end)});
}

void Instance::part(const End& end) {
    const auto is_it = [&end](const Joined& one) { return one.end.get() == &end; };
    joined_.erase(std::find_if(joined_.begin(), joined_.end(), is_it));
}

std::vector<std::shared_ptr<LinkImpl>> Instance::links() const {
    std::vector<std::shared_ptr<LinkImpl>> links;
    for (auto one = joined_.rbegin(); one != joined_.rend(); ++one) {
        if (std::find(links.begin(), links.end(), one->link) == links.end()) {
            links.push_back(one->link);
        }
    }
    return links;
}

Instance::Required* Instance::find_required(const std::string& port) {
    const auto found =
        std::find_if(required_.begin(), required_.end(), [&port](const Required& r) { return r.port == port; });
    return found == required_.end() ? nullptr : &*found;
}

}  // namespace lwucm
