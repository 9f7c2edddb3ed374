// FragmentConnectors: links for frameworks whose connectors are fragments (11.1.2.1).
//
// Each end of a link is a fragment, which the framework instantiates like a component. It gets a container of its own, so that
// get_components of other containers does not show it, and is operational before the component is connected.
#ifndef UCM_CTS_FRAGMENTS_HPP
#define UCM_CTS_FRAGMENTS_HPP

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "ucm_cts/adapter.hpp"

namespace ucm_cts {

/// The fragment for one role of a connector: the name of its implementation, and its port element that the component is
/// connected to, which it provides where the component requires one.
struct EndFragment {
    std::string implementation;
    std::string port;
};

/// A link. `number` tells its fragments that they belong together.
struct FragmentLink {
    int number;
    ContainerHandle manager;
    std::string connector;
    SharedInterface interface;

    /// An end: the fragment's container, and the connection in `holder` that leads to or from the component.
    struct End {
        ContainerHandle box;
        ContainerHandle holder;
        Id connection;
    };
    std::map<std::pair<Id, std::string>, End> ends;
};

/// Makes `link`, `attach` and `detach` of the other operations of `Base`, an adapter. Derive from it and say by
/// `end_fragment` which fragments there are.
template <class Base>
class FragmentConnectors : public Base {
  public:
    LinkHandle link(const ContainerHandle& manager, const std::string& connector,
                    const SharedInterface& interface) override {
        if (!offers(connector)) {
            throw NotOffered();
        }
        std::lock_guard<std::mutex> lock(mutex_);
        return std::make_shared<FragmentLink>(FragmentLink{++last_, manager, connector, interface, {}});
    }

    void attach(const LinkHandle& handle, const std::string& role, const ContainerHandle& container, Id comp_instance,
                const std::string& port_name) override {
        FragmentLink& link = *static_cast<FragmentLink*>(handle.get());
        if (find(link, comp_instance, port_name)) {
            throw UcmError("the port element is an end of this link already");
        }
        const EndFragment fragment = end_fragment(link, role);
        const bool provides = role == "server" || role == "receiver";
        const Reference element = provides ? this->get_port_element(container, comp_instance, port_name) : nullptr;
        const ContainerHandle box = this->create_container(link.manager);
        try {
            const Id added = this->add_component(box, fragment.implementation, fragment_attributes(link, role));
            Id connection = 0;
            if (provides) {
                connection = this->connect(box, added, fragment.port, element);
                this->start(box);
            } else {
                this->start(box);
                connection = this->connect(container, comp_instance, port_name,
                                           this->get_port_element(box, added, fragment.port));
            }
            std::lock_guard<std::mutex> lock(mutex_);
            link.ends[std::make_pair(comp_instance, port_name)] = {box, provides ? box : container, connection};
        } catch (...) {
            this->remove_container(link.manager, box);
            throw;
        }
    }

    void detach(const LinkHandle& handle, const ContainerHandle&, Id comp_instance,
                const std::string& port_name) override {
        FragmentLink& link = *static_cast<FragmentLink*>(handle.get());
        const std::unique_ptr<FragmentLink::End> end = find(link, comp_instance, port_name);
        if (!end) {
            throw NotFound("the port element is no end of this link");
        }
        if (end->holder != end->box) {
            this->disconnect(end->holder, end->connection);
        }
        this->remove_container(link.manager, end->box);
        std::lock_guard<std::mutex> lock(mutex_);
        link.ends.erase(std::make_pair(comp_instance, port_name));
    }

  protected:
    /// The fragment for an end of `link` in `role`.
    virtual EndFragment end_fragment(const FragmentLink& link, const std::string& role) = 0;

    /// Whether the framework has `connector`.
    virtual bool offers(const std::string& /*connector*/) { return true; }

    /// Configuration values of the fragment for an end of `link`; by default `link`, the link's number.
    virtual Attributes fragment_attributes(const FragmentLink& link, const std::string& /*role*/) {
        return Attributes{{"link", std::to_string(link.number)}};
    }

  private:
    std::unique_ptr<FragmentLink::End> find(const FragmentLink& link, Id comp_instance, const std::string& port_name) {
        std::lock_guard<std::mutex> lock(mutex_);
        const auto found = link.ends.find(std::make_pair(comp_instance, port_name));
        return std::unique_ptr<FragmentLink::End>(found != link.ends.end() ? new FragmentLink::End(found->second)
                                                                           : nullptr);
    }

    std::mutex mutex_;
    int last_ = 0;
};

}  // namespace ucm_cts

#endif
