// Link: a connection with a connector, its ends and its transport.
#ifndef LWUCM_SRC_LINK_IMPL_HPP
#define LWUCM_SRC_LINK_IMPL_HPP

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "containers/shared.hpp"
#include "links/ends.hpp"

namespace lwucm {

enum class Condition { sound, transport_broken, connector_broken };

/// What the two sides of a connector have between them. Bytes cross it in memory, so it fails only when it is broken on
/// purpose.
class Transport {
  public:
    void become(Condition condition) {
        std::lock_guard<std::mutex> lock(mutex_);
        condition_ = condition;
        changed_.notify_all();
    }

    Condition condition() {
        std::lock_guard<std::mutex> lock(mutex_);
        return condition_;
    }

    /// Waits until it is sound, or `given_up` has become true, which is asked again at each `reconsider`. Is it sound?
    bool await_sound(const std::function<bool()>& given_up) {
        std::unique_lock<std::mutex> lock(mutex_);
        changed_.wait(lock, [this, &given_up] { return condition_ == Condition::sound || given_up(); });
        return condition_ == Condition::sound;
    }

    void reconsider() {
        std::lock_guard<std::mutex> lock(mutex_);
        changed_.notify_all();
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    Condition condition_ = Condition::sound;
};

class ContainerImpl;

/// The ends change within an Operation only. What its connector needs when it is used it keeps for itself.
class LinkImpl : public Link, public std::enable_shared_from_this<LinkImpl> {
  public:
    explicit LinkImpl(std::shared_ptr<Shared> shared) : shared_(std::move(shared)) {}

    void break_transport() override { transport_.become(Condition::transport_broken); }
    void break_connector() override { transport_.become(Condition::connector_broken); }
    void mend() override { transport_.become(Condition::sound); }

    /// Would other instances lose their only counterpart without this one?
    virtual bool needs(const Instance& instance) const = 0;

    /// All ends of the instance leave, and so do those that have no counterpart without it.
    void withdraw(const Instance& instance, Attempts& attempts);

  protected:
    /// An end has been taken from `ends`.
    virtual void forget(const End& end) = 0;

    const std::vector<std::shared_ptr<End>>& ends() const { return ends_; }

    /// BAD_PARAMETER if it is no container of this runtime.
    ContainerImpl& own(const std::shared_ptr<Container>& container) const;

    /// NOT_FOUND if the container has no such component.
    static std::shared_ptr<Instance> find(const ContainerImpl& container, componentId component);

    /// UCM_ERROR unless connections may be made and undone now.
    static void check_configuring(const ContainerImpl& container);

    /// BAD_PARAMETER if the component has no such port element with that interface.
    static void check_port(const Instance& instance, bool is_required, const std::string& port,
                           const Interface& interface);

    /// What the component gives for a provided port element. BAD_PARAMETER if a connector cannot call it.
    static std::shared_ptr<DynamicPortElement> ask(Instance& instance, const std::string& port);

    void add(const std::shared_ptr<End>& end);
    void remove(const std::shared_ptr<End>& end, Attempts& attempts);

    const std::shared_ptr<Shared> shared_;
    Transport transport_;

  private:
    std::vector<std::shared_ptr<End>> ends_;
};

/// A link that is bound to one interface, which each of its ends is a port element of (10.1).
class ElementLink : public LinkImpl {
  public:
    ElementLink(std::shared_ptr<Shared> shared, InterfacePtr interface)
        : LinkImpl(std::move(shared)), interface_(std::move(interface)) {}

    void attach(Role role, const std::shared_ptr<Container>& container, componentId component,
                const std::string& port) override;
    void detach(const std::shared_ptr<Container>& container, componentId component, const std::string& port) override;

    const InterfacePtr& get_interface() const { return interface_; }

  protected:
    virtual bool has_role(Role role) const = 0;

    /// A new end for a port element that is required, and what it is connected to.
    virtual std::shared_ptr<End> make_sender(Instance& instance, const std::string& port,
                                             std::shared_ptr<PortElementObject>& element) = 0;

    /// A new end for a port element that is provided. UCM_ERROR if there is no room for it.
    virtual std::shared_ptr<End> make_taker(Instance& instance, const std::string& port,
                                            const std::shared_ptr<DynamicPortElement>& element) = 0;

  private:
    void attach_sender(Instance& instance, const std::string& port);
    void attach_taker(Instance& instance, const std::string& port);

    const InterfacePtr interface_;
};

}  // namespace lwucm

#endif
