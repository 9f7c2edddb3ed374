// One component instance and its state machine (11.2.3).
#ifndef LWUCM_SRC_INSTANCE_HPP
#define LWUCM_SRC_INSTANCE_HPP

#include <memory>
#include <string>
#include <vector>

#include "execution.hpp"
#include "lwucm/container.hpp"
#include "lwucm/repository.hpp"

namespace lwucm {

class ContainerImpl;

class Instance {
  public:
    enum class State { initialized, configured, ready };

    /// Makes the body. Throws what the factory throws, UCM_ERROR if it gives none.
    Instance(componentId id, ContainerImpl& container, std::shared_ptr<const Implementation> implementation);

    componentId id() const { return id_; }
    ContainerImpl& container() const { return container_; }
    State state() const;

    bool provides(const std::string& port) const;
    bool requires_port(const std::string& port) const;
    bool is_connected(const std::string& port) const;

    /// Sets attributes, gives a fragment its container, ends with on_init. `configuration` was checked before.
    void initialize(const Properties& configuration, const std::shared_ptr<Container>& container);

    void connect(const std::string& port, const std::shared_ptr<PortElementObject>& to);
    void disconnect(const std::string& port);
    void start();
    void shut_down();
    void remove();

    /// The time in which it executes by itself, if it does: when all members of its container have started.
    void begin_execution() { execution_.begin(); }
    void end_execution() { execution_.end(); }

    /// What the body gives for a provided port element, guarded as its policy has it.
    std::shared_ptr<PortElementObject> ask_port_element(const std::string& port);

    /// Which references have been given out, so that the runtime knows who provides what is connected.
    void remember(const std::shared_ptr<PortElementObject>& element);
    const PortElementObjects& given_out() const { return given_out_; }

  private:
    struct Required {
        std::string port;
        std::shared_ptr<PortElementObject> to;
    };

    Required* find_required(const std::string& port);

    const componentId id_;
    ContainerImpl& container_;
    const std::shared_ptr<const Implementation> implementation_;
    const std::shared_ptr<ComponentObject> body_;
    Connectable* const connectable_;
    Execution execution_;
    std::vector<Required> required_;
    PortElementObjects given_out_;
    bool ready_ = false;
};

}  // namespace lwucm

#endif
