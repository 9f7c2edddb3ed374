// simple_service_connector (10.1.5): calls of clients are carried out by the server, and the clients wait.
#ifndef LWUCM_SRC_SERVICE_CONNECTOR_HPP
#define LWUCM_SRC_SERVICE_CONNECTOR_HPP

#include <memory>
#include <mutex>
#include <string>

#include "link_impl.hpp"

namespace lwucm {

class ServiceConnector final : public LinkImpl {
  public:
    using LinkImpl::LinkImpl;

    bool needs(const Instance& instance) const override;

  protected:
    bool has_role(Role role) const override { return role == Role::client || role == Role::server; }
    std::shared_ptr<End> make_sender(Instance& instance, const std::string& port,
                                     std::shared_ptr<PortElementObject>& element) override;
    std::shared_ptr<End> make_taker(Instance& instance, const std::string& port,
                                    const std::shared_ptr<DynamicPortElement>& element) override;
    void forget(const End& end) override;

  private:
    class Client;
    class ClientElement;
    class Server;

    Values request(Client& client, const std::string& method, const Values& arguments);
    std::shared_ptr<Server> server() const;
    void cross(Client& client, Server& server);

    mutable std::mutex mutex_;
    std::shared_ptr<Server> server_;
};

}  // namespace lwucm

#endif
