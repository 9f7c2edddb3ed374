// ContainerManager: sub-containers and the end of the runtime.
#ifndef LWUCM_SRC_MANAGER_IMPL_HPP
#define LWUCM_SRC_MANAGER_IMPL_HPP

#include <memory>
#include <vector>

#include "container_impl.hpp"
#include "lwucm/runtime.hpp"

namespace lwucm {

class ManagerImpl : public ContainerImpl, public Runtime {
  public:
    explicit ManagerImpl(std::shared_ptr<Shared> shared);

    std::shared_ptr<Container> create_container(const Properties& configValues) override;
    void remove_container(std::shared_ptr<Container> subContainer) override;
    void destroy() override;
    std::shared_ptr<Link> create_link(const std::string& connector, const InterfacePtr& interface) override;
    std::vector<LogRecord> trace_records() override { return shared_->platform.trace->records(); }

  private:
    std::vector<std::shared_ptr<ContainerImpl>> sub_containers_;
};

}  // namespace lwucm

#endif
