// Probe: the component body that a scenario has the framework host. Records each entry and does what its plan says.
#ifndef UCM_CTS_PROBE_HPP
#define UCM_CTS_PROBE_HPP

#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/gates.hpp"
#include "ucm_cts/scenario.hpp"
#include "ucm_cts/trace.hpp"

namespace ucm_cts {

/// What all probes of one scenario share. Probes keep it alive, so that a framework may keep probes.
struct Stage {
    Stage(Recorder::Sink sink, std::int64_t patience) : recorder(std::move(sink)), gates(patience_of(patience)) {}

    Recorder recorder;
    Gates gates;
};

/// What a probe leaves a hook with when its plan says `raise`: no interface declares it.
class ProbeFailure : public std::runtime_error {
  public:
    explicit ProbeFailure(Hook hook) : std::runtime_error(std::string("the probe fails in ") + name_of(hook)) {}
};

/// Appends a reference as it stands in a trace: whose it is, `"opaque"`, or null.
inline void append_reference(std::string& out, const Reference& reference) {
    const Identity* const identity = reference ? reference->identity() : nullptr;
    if (identity == nullptr) {
        out += reference ? "\"opaque\"" : "null";
        return;
    }
    out += "{\"component\":";
    json::append_text(out, identity->component);
    json::append_name(out, "instance");
    json::append_integer(out, identity->instance);
    json::append_name(out, "port");
    json::append_text(out, identity->port);
    out += '}';
}

/// What all faces of one body, itself and its port elements, have in common.
class Probe {
  public:
    Probe(std::shared_ptr<Stage> stage, std::shared_ptr<const Scenario> scenario, const Declaration& declaration,
          int instance)
        : stage_(std::move(stage)), scenario_(std::move(scenario)), declaration_(declaration), instance_(instance) {
        json::append_name(whose_, "component");
        json::append_text(whose_, declaration_.name);
        json::append_name(whose_, "instance");
        json::append_integer(whose_, instance_);
        stage_->recorder.record("create", [this](std::string& out) { out += whose_; });
    }

    const Declaration& declaration() const { return declaration_; }
    int instance() const { return instance_; }

    /// Has the scenario ended? Then the probe is silent and has no plan.
    bool over() const { return stage_->recorder.closed(); }

    /// Records the entry with the arguments that `append_arguments(text)` appends, performs the plan, records the exit.
    template <class AppendArguments>
    void visit(Hook hook, AppendArguments append_arguments) {
        if (over()) {
            return;
        }
        enter(hook, append_arguments);
        perform(hook, nullptr);
        leave(hook, [](std::string&) {});
    }

    std::int32_t exchange(const std::string& port, std::int32_t value) {
        std::int32_t result = ~value;
        if (over()) {
            return result;
        }
        enter(Hook::exchange, [&port, value](std::string& out) {
            json::append_name(out, "port");
            json::append_text(out, port);
            json::append_name(out, "value");
            json::append_integer(out, value);
        });
        perform(Hook::exchange, &result);
        leave(Hook::exchange, [result](std::string& out) {
            json::append_name(out, "value");
            json::append_integer(out, result);
        });
        return result;
    }

    void keep(const std::vector<PortConnection>& connections) {
        std::lock_guard<std::mutex> lock(mutex_);
        connections_ = connections;
    }

    void keep(const std::shared_ptr<ContainerInterface>& container) {
        std::lock_guard<std::mutex> lock(mutex_);
        container_ = container;
    }

    /// Lets go of everything the framework has given, so that no cycle of references survives a scenario.
    void forget() {
        std::vector<PortConnection> connections;
        std::shared_ptr<ContainerInterface> container;
        std::lock_guard<std::mutex> lock(mutex_);
        connections.swap(connections_);
        container.swap(container_);
    }

  private:
    template <class AppendArguments>
    void enter(Hook hook, AppendArguments append_arguments) {
        event("enter", [hook, &append_arguments](std::string& out) {
            append_hook(out, hook);
            append_arguments(out);
        });
    }

    template <class AppendResult>
    void leave(Hook hook, AppendResult append_result) {
        event("exit", [hook, &append_result](std::string& out) {
            append_hook(out, hook);
            append_result(out);
        });
    }

    template <class AppendFields>
    void event(const char* kind, AppendFields append_fields) {
        stage_->recorder.record(kind, [this, &append_fields](std::string& out) {
            out += whose_;
            append_fields(out);
        });
    }

    void perform(Hook hook, std::int32_t* result) {
        for (const Action& action : declaration_.plan[static_cast<std::size_t>(hook)]) {
            switch (action.kind) {
                case Action::Kind::raise:
                    leave(hook, append_raised);
                    throw ProbeFailure(hook);
                case Action::Kind::return_value:
                    if (result != nullptr) {
                        *result = action.value;
                    }
                    break;
                case Action::Kind::call:
                    call(action.name, action.value);
                    break;
                case Action::Kind::hold:
                    hold(action.name);
                    break;
                case Action::Kind::siblings:
                    query_siblings();
                    break;
            }
        }
    }

    void call(const std::string& port, std::int32_t value) {
        for (const Reference& reference : references(port)) {
            event("request", [&port, value](std::string& out) {
                append_port(out, port);
                json::append_name(out, "value");
                json::append_integer(out, value);
            });
            try {
                const std::int32_t answer = reference->exchange(value);
                event("reply", [&port, answer](std::string& out) {
                    append_port(out, port);
                    json::append_name(out, "value");
                    json::append_integer(out, answer);
                });
            } catch (...) {
                event("reply", [&port](std::string& out) {
                    append_port(out, port);
                    append_raised(out);
                });
            }
        }
    }

    std::vector<Reference> references(const std::string& port) {
        std::vector<Reference> found;
        std::lock_guard<std::mutex> lock(mutex_);
        for (const PortConnection& connection : connections_) {
            if (connection.from_port == port) {
                std::copy_if(connection.to_port.begin(), connection.to_port.end(), std::back_inserter(found),
                             [](const Reference& reference) { return reference != nullptr; });
            }
        }
        return found;
    }

    void hold(const std::string& gate) {
        stage_->gates.hold(gate, [this, &gate] {
            event("held", [&gate](std::string& out) {
                json::append_name(out, "gate");
                json::append_text(out, gate);
            });
        });
    }

    void query_siblings() {
        std::shared_ptr<ContainerInterface> container;
        {
            std::lock_guard<std::mutex> lock(mutex_);
            container = container_;
        }
        try {
            if (!container) {
                throw std::logic_error("no container interface was given");
            }
            const std::vector<Id> ids = container->get_components();
            event("siblings", [&ids](std::string& out) {
                json::append_name(out, "ids");
                json::append_array(out, ids, json::append_integer);
            });
        } catch (...) {
            event("siblings", append_raised);
        }
    }

    static void append_hook(std::string& out, Hook hook) {
        json::append_name(out, "hook");
        out += '"';
        out += name_of(hook);
        out += '"';
    }

    static void append_port(std::string& out, const std::string& port) {
        json::append_name(out, "port");
        json::append_text(out, port);
    }

    static void append_raised(std::string& out) { out += ",\"raised\":true"; }

    const std::shared_ptr<Stage> stage_;
    const std::shared_ptr<const Scenario> scenario_;  // keeps declaration_ alive
    const Declaration& declaration_;
    const int instance_;
    std::string whose_;
    std::mutex mutex_;
    std::vector<PortConnection> connections_;
    std::shared_ptr<ContainerInterface> container_;
};

/// A port element that a probe provides.
class ProbePort final : public PortElement {
  public:
    ProbePort(std::shared_ptr<Probe> probe, const std::string& port)
        : probe_(std::move(probe)), identity_(Identity{probe_->declaration().name, probe_->instance(), port}) {}

    std::int32_t exchange(std::int32_t value) override { return probe_->exchange(identity_.port, value); }
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
    void run() override {
        probe_->visit(Hook::run, [](std::string&) {});
    }

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
    }

    void set_attribute(const std::string& name, const std::string& value) override { attributes_[name] = value; }

    void on_init() override {
        probe_->visit(Hook::on_init, [this](std::string& out) {
            json::append_name(out, "attributes");
            char separator = '{';
            for (const auto& attribute : attributes_) {
                out += separator;
                json::append_text(out, attribute.first);
                out += ':';
                json::append_text(out, attribute.second);
                separator = ',';
            }
            out += attributes_.empty() ? "{}" : "}";
        });
    }

    void on_startup(const std::vector<PortConnection>& dependencies) override {
        probe_->keep(dependencies);
        probe_->visit(Hook::on_startup, [&dependencies](std::string& out) {
            json::append_name(out, "dependencies");
            json::append_array(out, dependencies, [](std::string& text, const PortConnection& connection) {
                text += "{\"port\":";
                json::append_text(text, connection.from_port);
                json::append_name(text, "references");
                json::append_array(text, connection.to_port, append_reference);
                text += '}';
            });
        });
    }

    void on_shutdown() override {
        const Forgetting forgetting = {*probe_};
        probe_->visit(Hook::on_shutdown, [](std::string&) {});
    }

    void on_remove() override {
        probe_->visit(Hook::on_remove, [](std::string&) {});
        probe_->keep(std::shared_ptr<ContainerInterface>());
    }

    void on_connect(const std::string& port_name, const Reference& required) override {
        probe_->visit(Hook::on_connect, [&port_name, &required](std::string& out) {
            json::append_name(out, "port");
            json::append_text(out, port_name);
            json::append_name(out, "reference");
            append_reference(out, required);
        });
    }

    void on_disconnect(const std::string& port_name) override {
        probe_->visit(Hook::on_disconnect, [&port_name](std::string& out) {
            json::append_name(out, "port");
            json::append_text(out, port_name);
        });
    }

    void set_container_interface(const std::shared_ptr<ContainerInterface>& container) override {
        probe_->keep(container);
        probe_->visit(Hook::set_container_interface, [](std::string&) {});
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
            if (own.definition == policy && policy == SELF_EXECUTING && element == SELF_EXECUTION_API) {
                return std::make_shared<ProbeExecution>(probe_);
            }
        }
        return nullptr;
    }

  private:
    // references given at on_startup are dropped when on_shutdown is over, however it ends
    struct Forgetting {
        Probe& probe;
        ~Forgetting() { probe.keep(std::vector<PortConnection>()); }
    };

    const std::shared_ptr<Probe> probe_;
    std::vector<std::shared_ptr<ProbePort>> ports_;
    Attributes attributes_;
};

}  // namespace ucm_cts

#endif
