#include "links/link_impl.hpp"

#include <algorithm>
#include <utility>

#include "containers/container_impl.hpp"
#include "containers/names.hpp"

namespace lwucm {

void ElementLink::attach(Role role, const std::shared_ptr<Container>& container, componentId component,
                      const std::string& port) {
    Operation operation(*shared_);
    const ContainerImpl& its_container = own(container);
    const std::shared_ptr<Instance> instance = find(its_container, component);
    if (!has_role(role)) {
        throw BAD_PARAMETER("the connector has no such role");
    }
    check_port(*instance, is_sender(role), port, *interface_);
    check_configuring(its_container);
    if (is_sender(role)) {
        attach_sender(*instance, port);
    } else {
        attach_taker(*instance, port);
    }
}

void ElementLink::detach(const std::shared_ptr<Container>& container, componentId component, const std::string& port) {
    Operation operation(*shared_);
    const ContainerImpl& its_container = own(container);
    const std::shared_ptr<Instance> instance = find(its_container, component);
    const auto found = std::find_if(ends().begin(), ends().end(), [&](const std::shared_ptr<End>& end) {
        return &end->instance() == instance.get() && end->port() == port;
    });
    if (found == ends().end()) {
        throw NOT_FOUND(quoted(port) + " is no end of the link");
    }
    check_configuring(its_container);
    Attempts attempts;
    remove(*found, attempts);
    attempts.check();
}

void LinkImpl::withdraw(const Instance& instance, Attempts& attempts) {
    const bool all = needs(instance);
    const std::vector<std::shared_ptr<End>> before = ends_;
    for (auto end = before.rbegin(); end != before.rend(); ++end) {
        if (&(*end)->instance() == &instance || (all && (*end)->is_sender())) {
            remove(*end, attempts);
        }
    }
}

std::shared_ptr<Instance> LinkImpl::find(const ContainerImpl& container, componentId component) {
    return container.find(component);
}

void LinkImpl::check_configuring(const ContainerImpl& container) { container.check_configuring(); }

ContainerImpl& LinkImpl::own(const std::shared_ptr<Container>& container) const {
    ContainerImpl* const known = dynamic_cast<ContainerImpl*>(container.get());
    if (known == nullptr || !known->is_of(*shared_)) {
        throw BAD_PARAMETER("the container is none of this runtime");
    }
    return *known;
}

void LinkImpl::check_port(const Instance& instance, bool is_required, const std::string& port,
                          const Interface& interface) {
    if (!(is_required ? instance.requires_port(port) : instance.provides(port))) {
        throw BAD_PARAMETER("the component has no such port element " + quoted(port));
    }
    const InterfacePtr its_interface = instance.interface_of(port);
    if (!its_interface || !same_interface(*its_interface, interface)) {
        throw BAD_PARAMETER(quoted(port) + " has another interface than the link");
    }
}

void ElementLink::attach_sender(Instance& instance, const std::string& port) {
    if (instance.is_connected(port)) {
        throw UCM_ERROR(quoted(port) + " is already connected");
    }
    std::shared_ptr<PortElementObject> element;
    const std::shared_ptr<End> end = make_sender(instance, port, element);
    Attempts attempts;
    attempts.make("on_connect", [&] { instance.connect(port, element); });
    attempts.check();
    add(end);
}

void ElementLink::attach_taker(Instance& instance, const std::string& port) {
    for (const std::shared_ptr<End>& end : ends()) {
        if (&end->instance() == &instance && end->port() == port) {
            throw UCM_ERROR(quoted(port) + " is an end of the link already");
        }
    }
    add(make_taker(instance, port, ask(instance, port)));
}

std::shared_ptr<DynamicPortElement> LinkImpl::ask(Instance& instance, const std::string& port) {
    std::shared_ptr<PortElementObject> element;
    Attempts attempts;
    attempts.make("get_portElement", [&] { element = instance.ask_port_element(port); });
    attempts.check();
    const auto dynamic = std::dynamic_pointer_cast<DynamicPortElement>(element);
    if (!dynamic) {
        throw BAD_PARAMETER("the component gives nothing for " + quoted(port) + " that a connector can call");
    }
    return dynamic;
}

void LinkImpl::add(const std::shared_ptr<End>& end) {
    ends_.push_back(end);
    end->instance().join(shared_from_this(), end);
}

void LinkImpl::remove(const std::shared_ptr<End>& end, Attempts& attempts) {
    const std::shared_ptr<End> removed = end;  // `end` may be an element of what changes
    ends_.erase(std::find(ends_.begin(), ends_.end(), removed));
    forget(*removed);
    Instance& instance = removed->instance();
    instance.part(*removed);
    removed->left();
    if (removed->is_sender()) {
        attempts.make("on_disconnect", [&] { instance.disconnect(removed->port()); });
    }
}

}  // namespace lwucm
