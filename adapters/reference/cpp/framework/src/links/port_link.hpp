// PortLink: a connection of 10.4, which joins whole ports. PortEnd, CalledEnd: the port elements at its ends.
#ifndef LWUCM_SRC_PORT_LINK_HPP
#define LWUCM_SRC_PORT_LINK_HPP

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "links/lane.hpp"
#include "links/link_impl.hpp"

namespace lwucm {

/// The port elements of a connector port: the names of the one that the component provides and of the one that it
/// requires, empty if there is none, each with its interface.
struct PortElements {
    std::string provided;
    std::string required;
    InterfacePtr provided_interface;
    InterfacePtr required_interface;
};

class PortLink;

/// A port element of a port that is attached. `of` is the port.
class PortEnd : public End {
  public:
    PortEnd(Instance& instance, bool is_required, const std::string& element, std::string port, PortLink& link)
        : End(instance, is_required ? Role::client : Role::server, element), of(std::move(port)), connector_(link) {}

    void stopping() override;
    void left() override;

    const std::string of;

  private:
    PortLink& connector_;
};

/// A port element that the connector calls.
class CalledEnd final : public PortEnd {
  public:
    CalledEnd(Instance& instance, const std::string& element, const std::string& port, PortLink& link,
              std::shared_ptr<DynamicPortElement> called)
        : PortEnd(instance, false, element, port, link), called_(std::move(called)) {}

    void started() override;
    void stopping() override;
    void await_calls() override;
    void left() override;

    bool is_open() { return admission_.is_open(); }

    /// UCM_ERROR if the component is not operational.
    Values call(const char* method, const Values& arguments);

    /// On the thread of the end, after what came before; forgotten if the component is not operational then.
    void call_later(std::function<void()> call) { lane_.put(std::move(call)); }

  private:
    const std::shared_ptr<DynamicPortElement> called_;
    Admission admission_;
    Lane lane_;
};

/// A port of a component at the end of a connection. `called` is null if the component provides nothing there.
struct AttachedPort {
    const Instance* instance;
    Role role;
    std::string name;
    std::shared_ptr<CalledEnd> called;
};

/// A connection that joins ports.
class PortLink : public LinkImpl {
  public:
    using LinkImpl::LinkImpl;

    void attach(Role role, const std::shared_ptr<Container>& container, componentId component,
                const std::string& port) override;
    void detach(const std::shared_ptr<Container>& container, componentId component, const std::string& port) override;
    bool needs(const Instance&) const override { return false; }

    /// The component is being stopped, or leaves.
    virtual void abandon(const Instance& instance) = 0;

  protected:
    /// BAD_PARAMETER if the connector has no such port.
    virtual PortElements elements_of(Role role) const = 0;

    /// A new port. UCM_ERROR if there is no room for it.
    virtual void join(const AttachedPort& port) = 0;

    /// The component of that port calls a method of the port element that it requires.
    virtual Values carry_out(const AttachedPort& port, const std::string& method, const Values& arguments) = 0;

    /// The code of a call while the connection is broken; null if it is sound.
    const char* fault();

  private:
    class Element;

    void connect(Instance& instance, const PortElements& elements, const std::string& port,
                 const std::string& required, const AttachedPort& attached);
};

/// A code of comm_ecode.
Value code(const char* name);

/// A value of the type, for results that mean nothing.
Value any_value(const Type& type);

}  // namespace lwucm

#endif
