#include "containers/container_impl.hpp"

#include <algorithm>

#include "links/connectors.hpp"
#include "platform/parts.hpp"

namespace lwucm {

const char* const SIMPLE_SERVICE_CONNECTOR = "simple_service_connector";
const char* const SIMPLE_MESSAGE_CONNECTOR = "simple_message_connector";
const char* const REQUEST_RESPONSE_CONNECTOR = "request-response_connector";
const char* const SHARED_DATA_CONNECTOR = "shared-data_connector";

std::shared_ptr<Runtime> create_runtime(const Repository& repository, const Options& options) {
    return Parts::runtime(std::make_shared<Shared>(repository, options));
}

ManagerImpl::ManagerImpl(std::shared_ptr<Shared> shared) : ContainerImpl(std::move(shared)) {}

std::shared_ptr<Container> ManagerImpl::create_container(const Properties& configValues) {
    Operation operation(*shared_);
    if (!configValues.empty()) {
        throw UCM_ERROR("containers have no property '" + configValues.front().name + "'");
    }
    sub_containers_.push_back(std::make_shared<ContainerImpl>(shared_));
    return sub_containers_.back();
}

void ManagerImpl::remove_container(std::shared_ptr<Container> subContainer) {
    Operation operation(*shared_);
    const auto found = std::find(sub_containers_.begin(), sub_containers_.end(), subContainer);
    if (found == sub_containers_.end()) {
        throw NOT_FOUND("no such container");
    }
    Attempts attempts;
    take_down({found->get()}, attempts);
    sub_containers_.erase(found);
    attempts.check();
}

void ManagerImpl::destroy() {
    Operation operation(*shared_);
    std::vector<ContainerImpl*> all;
    for (const std::shared_ptr<ContainerImpl>& container : sub_containers_) {
        all.push_back(container.get());
    }
    all.push_back(this);
    Attempts attempts;
    take_down(all, attempts);
    sub_containers_.clear();
    {
        std::lock_guard<std::mutex> data(shared_->data);
        shared_->destroyed = true;
    }
    if (shared_->platform.executor) {
        shared_->platform.executor->end();
    }
    attempts.check();
}

void ManagerImpl::take_down(const std::vector<ContainerImpl*>& containers, Attempts& attempts) {
    for (const auto step :
         {&ContainerImpl::shut_down_members, &ContainerImpl::disconnect_members, &ContainerImpl::remove_members}) {
        for (ContainerImpl* const container : containers) {
            (container->*step)(attempts);
        }
    }
}

std::shared_ptr<Link> ManagerImpl::create_link(const std::string& connector, const InterfacePtr& interface) {
    Operation operation(*shared_);
    if (interface && connector == SIMPLE_SERVICE_CONNECTOR) {
        return make_service_connector(shared_, interface);
    }
    if (interface && connector == SIMPLE_MESSAGE_CONNECTOR) {
        return make_message_connector(shared_, interface);
    }
    throw BAD_PARAMETER("there is no connector '" + connector + "' for such an interface");
}

std::shared_ptr<Link> ManagerImpl::create_link(const std::string& connector, const BoundTypes& types) {
    Operation operation(*shared_);
    if (connector == REQUEST_RESPONSE_CONNECTOR) {
        return make_request_response_connector(shared_, types);
    }
    if (connector == SHARED_DATA_CONNECTOR) {
        return make_shared_data_connector(shared_, types);
    }
    throw BAD_PARAMETER("there is no connector '" + connector + "' for such types");
}

}  // namespace lwucm
