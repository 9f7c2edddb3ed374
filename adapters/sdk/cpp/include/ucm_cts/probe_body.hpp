// The faces that a probe shows to frameworks: the body, its port elements, its self-execution.
#ifndef UCM_CTS_PROBE_BODY_HPP
#define UCM_CTS_PROBE_BODY_HPP

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ucm_cts/probe.hpp"

namespace ucm_cts {

/// A port element that a probe provides.
class ProbePort final : public PortElement {
  public:
    ProbePort(std::shared_ptr<Probe> probe, const std::string& port)
        : probe_(std::move(probe)), identity_(Identity{probe_->name(), probe_->instance(), port}) {}

    std::int32_t exchange(std::int32_t value) override { return probe_->exchange(identity_.port, value); }
    Data call(const std::string& method, const Data& arguments) override {
        return probe_->call(identity_.port, method, arguments);
    }

    const std::string& port() const { return identity_.port; }

    /// A port element of an earlier scenario is a stranger in this one.
    const Identity* identity() const override { return probe_->over() ? nullptr : &identity_; }

  private:
    const std::shared_ptr<Probe> probe_;
    const Identity identity_;
};

/// What a self-executing probe provides to its container.
class ProbeExecution final : public ComponentExecution {
  public:
    explicit ProbeExecution(std::shared_ptr<Probe> probe) : probe_(std::move(probe)) {}
    void run() override { probe_->run(); }

  private:
    const std::shared_ptr<Probe> probe_;
};

/// The probe as a component body.
class ProbeBody final : public Body {
  public:
    explicit ProbeBody(std::shared_ptr<Probe> probe) : probe_(std::move(probe)) {
        for (const std::string& port : probe_->declaration().provided) {
            ports_.push_back(std::make_shared<ProbePort>(probe_, port));
        }
        const std::vector<Policy>& policies = probe_->declaration().policies;
        if (std::any_of(policies.begin(), policies.end(),
                        [](const Policy& policy) { return policy.definition == INDEX_TIMERS; })) {
            timer_callback_ = std::make_shared<ProbePort>(probe_, TIMER_CALLBACK);
        }
    }

    void set_attribute(const std::string& name, const std::string& value) override { attributes_[name] = value; }

    void on_init() override {
        probe_->visit(Hook::on_init, probe_->entry(Hook::on_init).attributes(attributes_));
    }

    void on_startup(const std::vector<PortConnection>& dependencies) override {
        const std::string wrong = excess(dependencies);
        if (wrong.empty()) {
            probe_->keep(dependencies);
            probe_->visit(Hook::on_startup, probe_->entry(Hook::on_startup).dependencies(dependencies));
        } else {
            probe_->keep(std::vector<PortConnection>());
            probe_->visit(Hook::on_startup, probe_->entry(Hook::on_startup).dependencies({}).wrong(wrong));
        }
    }

    void on_shutdown() override {
        const Forgetting forgetting = {*probe_};
        probe_->visit(Hook::on_shutdown);
    }

    void on_remove() override {
        probe_->visit(Hook::on_remove);
        probe_->keep(std::shared_ptr<ContainerInterface>());
    }

    void on_connect(const std::string& port_name, const Reference& required) override {
        probe_->visit(Hook::on_connect, probe_->entry(Hook::on_connect).port(port_name).reference(required));
    }

    void on_disconnect(const std::string& port_name) override {
        probe_->visit(Hook::on_disconnect, probe_->entry(Hook::on_disconnect).port(port_name));
    }

    void set_container_interface(const std::shared_ptr<ContainerInterface>& container) override {
        probe_->keep(container);
        probe_->visit(Hook::set_container_interface);
    }

    Reference get_portElement(const std::string& provided) override {
        for (const std::shared_ptr<ProbePort>& port : ports_) {
            if (port->port() == provided) {
                return port;
            }
        }
        return nullptr;
    }

    std::shared_ptr<ComponentExecution> get_policy_element(const std::string& policy,
                                                           const std::string& element) override {
        for (const Policy& own : probe_->declaration().policies) {
            if (own.definition == policy && is_self_executing(policy) && element == SELF_EXECUTION_API) {
                return std::make_shared<ProbeExecution>(probe_);
            }
        }
        return nullptr;
    }

    Reference get_policy_port(const std::string& policy, const std::string& element) override {
        return policy == INDEX_TIMERS && element == TIMER_CALLBACK ? timer_callback_ : nullptr;
    }

  private:
    // What is too much of it, empty if nothing is.
    static std::string excess(const std::vector<PortConnection>& dependencies) {
        if (dependencies.size() > MOST) {
            return too_many("connections");
        }
        for (const PortConnection& connection : dependencies) {
            if (connection.to_port.size() > MOST) {
                return too_many("references of ") + connection.from_port;
            }
        }
        return "";
    }

    // references given at on_startup are dropped when on_shutdown is over, however it ends
    struct Forgetting {
        Probe& probe;
        ~Forgetting() { probe.keep(std::vector<PortConnection>()); }
    };

    const std::shared_ptr<Probe> probe_;
    std::vector<std::shared_ptr<ProbePort>> ports_;
    std::shared_ptr<ProbePort> timer_callback_;  // if it has index timers
    Attributes attributes_;
};

}  // namespace ucm_cts

#endif
