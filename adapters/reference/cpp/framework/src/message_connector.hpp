// simple_message_connector (10.1.6): each message that an emitter pushes goes to each receiver.
#ifndef LWUCM_SRC_MESSAGE_CONNECTOR_HPP
#define LWUCM_SRC_MESSAGE_CONNECTOR_HPP

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "inbox.hpp"
#include "link_impl.hpp"

namespace lwucm {

class MessageConnector final : public LinkImpl {
  public:
    /// BAD_PARAMETER if the interface is not message_intf.
    MessageConnector(std::shared_ptr<Shared> shared, InterfacePtr interface);

    bool needs(const Instance&) const override { return false; }

  protected:
    bool has_role(Role role) const override { return role == Role::emitter || role == Role::receiver; }
    std::shared_ptr<End> make_sender(Instance& instance, const std::string& port,
                                     std::shared_ptr<PortElementObject>& element) override;
    std::shared_ptr<End> make_taker(Instance& instance, const std::string& port,
                                    const std::shared_ptr<DynamicPortElement>& element) override;
    void forget(const End& end) override;

  private:
    class EmitterElement;
    class Receiver;
    class LaterReceiver;
    class ImmediateReceiver;
    typedef std::vector<std::shared_ptr<Receiver>> Receivers;

    const char* push(const Values& arguments);
    std::shared_ptr<const Receivers> receivers() const;

    mutable std::mutex mutex_;
    std::shared_ptr<const Receivers> receivers_;
};

}  // namespace lwucm

#endif
