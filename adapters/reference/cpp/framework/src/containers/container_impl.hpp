// Containers: membership, connections, start and stop; sub-containers and the end of the runtime.
#ifndef LWUCM_SRC_CONTAINER_IMPL_HPP
#define LWUCM_SRC_CONTAINER_IMPL_HPP

#include <memory>
#include <string>
#include <vector>

#include "containers/shared.hpp"
#include "lwucm/runtime.hpp"

namespace lwucm {

class ContainerImpl : public virtual Container, public std::enable_shared_from_this<ContainerImpl> {
  public:
    explicit ContainerImpl(std::shared_ptr<Shared> shared);

    componentId add_component(const Properties& configValues) override;
    void remove_component(componentId comp_instance) override;
    std::shared_ptr<PortElementObject> get_port_element(componentId comp_instance,
                                                        const std::string& port_name) override;
    connectionId connect(componentId instance, const std::string& port_name,
                         std::shared_ptr<PortElementObject> to_port) override;
    void disconnect(connectionId connection) override;
    void start() override;
    void stop() override;
    componentIds get_components() override;

  protected:
    friend class ManagerImpl;
    friend class LinkImpl;

    // The three steps of taking a container down; the caller holds the operation.
    void shut_down_members(Attempts& attempts);
    void disconnect_members(Attempts& attempts);
    void remove_members(Attempts& attempts);

    void check_in_place() const;

    /// UCM_ERROR unless connections may be made and undone now.
    void check_configuring() const;

    /// NOT_FOUND if the container has no such member.
    std::shared_ptr<Instance> find(componentId id) const;
    bool is_of(const Shared& shared) const { return shared_.get() == &shared; }

    const std::shared_ptr<Shared> shared_;

  private:
    void check_removable(const Instance& member) const;
    void start_members();
    std::vector<connectionId> connections_of(const std::vector<std::shared_ptr<Instance>>& members) const;
    void leave_links(const Instance& member, Attempts& attempts);
    void take_out(const std::shared_ptr<Instance>& member, Attempts& attempts);
    std::shared_ptr<const Implementation> select(const Properties& configValues) const;
    void undo(connectionId id, Attempts& attempts);
    void undo_all(const std::vector<connectionId>& ids, Attempts& attempts);
    void erase(const Instance& member);

    std::vector<std::shared_ptr<Instance>> members_;
    std::vector<std::shared_ptr<Instance>> startup_order_;
    bool started_ = false;
    bool removed_ = false;
};

/// The root container.
class ManagerImpl : public ContainerImpl, public Runtime {
  public:
    explicit ManagerImpl(std::shared_ptr<Shared> shared);

    std::shared_ptr<Container> create_container(const Properties& configValues) override;
    void remove_container(std::shared_ptr<Container> subContainer) override;
    void destroy() override;
    std::shared_ptr<Link> create_link(const std::string& connector, const InterfacePtr& interface) override;
    std::shared_ptr<Link> create_link(const std::string& connector, const BoundTypes& types) override;
    std::vector<LogRecord> trace_records() override { return shared_->platform.trace->records(); }

  private:
    // Takes all steps, each for all containers before the next.
    static void take_down(const std::vector<ContainerImpl*>& containers, Attempts& attempts);

    std::vector<std::shared_ptr<ContainerImpl>> sub_containers_;
};

}  // namespace lwucm

#endif
