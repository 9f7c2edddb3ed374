// One component instance and its state machine (11.2.3).
#ifndef LWUCM_SRC_INSTANCE_HPP
#define LWUCM_SRC_INSTANCE_HPP

#include <memory>
#include <string>
#include <vector>

#include "execution/execution.hpp"
#include "links/ends.hpp"
#include "lwucm/container.hpp"
#include "lwucm/repository.hpp"

namespace lwucm {

class ContainerImpl;
class LinkImpl;

class Instance {
  public:
    enum class State { initialized, configured, ready };

    /// Makes the body. Throws what the factory throws, UCM_ERROR if it gives none.
    Instance(componentId id, ContainerImpl& container, std::shared_ptr<const Implementation> implementation,
             Demands demands, const Platform& platform);

    componentId id() const { return id_; }
    ContainerImpl& container() const { return container_; }
    State state() const;

    bool provides(const std::string& port) const;
    bool requires_port(const std::string& port) const;
    bool is_connected(const std::string& port) const;

    /// Null if the port element cannot be called by name.
    InterfacePtr interface_of(const std::string& port) const;

    /// Sets attributes, gives a fragment its container, ends with on_init. `configuration` was checked before.
    void initialize(const Properties& configuration, const std::shared_ptr<Container>& container);

    void connect(const std::string& port, const std::shared_ptr<PortElementObject>& to);
    void disconnect(const std::string& port);
    void start();
    void shut_down();
    void remove();

    // All members of its container have started, or are about to be shut down; in between others may execute it, and it
    // may execute by itself.
    void open_ends() { notify_ends(&End::started); }
    void begin_execution() { execution_.begin(); }
    void shut_ends() { notify_ends(&End::stopping); }
    void end_execution();

    /// What the body gives for a provided port element, guarded as its policy has it.
    std::shared_ptr<PortElementObject> ask_port_element(const std::string& port);

    /// Which references have been given out, so that the runtime knows who provides what is connected.
    void remember(const std::shared_ptr<PortElementObject>& element);
    const PortElementObjects& given_out() const { return given_out_; }

    /// Which ends of links it has, and of which.
    void join(std::shared_ptr<LinkImpl> link, std::shared_ptr<End> end);
    void part(const End& end);
    std::vector<std::shared_ptr<LinkImpl>> links() const;

  private:
    struct Required {
        std::string port;
        std::shared_ptr<PortElementObject> to;
        std::shared_ptr<PortElementObject> seen;  // what the body gets to see of it
    };

    struct Joined {
        std::shared_ptr<LinkImpl> link;
        std::shared_ptr<End> end;
    };

    // Calls one of the operations of `End` for each of its ends.
    void notify_ends(void (End::*what)()) const;

    Required* find_required(const std::string& port);

    const componentId id_;
    ContainerImpl& container_;
    const std::shared_ptr<const Implementation> implementation_;
    const std::shared_ptr<ComponentObject> body_;
    Connectable* const connectable_;
    Execution execution_;
    std::vector<Required> required_;
    PortElementObjects given_out_;
    std::vector<Joined> joined_;
    bool ready_ = false;
};

}  // namespace lwucm

#endif
