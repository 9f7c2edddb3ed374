// Life cycles without engine, trace and probes: how fast a framework is, and a way to step through it in a debugger.
#ifndef UCM_CTS_NATIVE_HPP
#define UCM_CTS_NATIVE_HPP

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ucm_cts/adapter.hpp"

namespace ucm_cts {

/// A port element that computes what a probe's does, and records nothing.
class NativePort final : public PortElement {
  public:
    std::int32_t exchange(std::int32_t value) override { return ~value; }
};

/// A body that does nothing but provide its port elements.
class NativeBody final : public Body {
  public:
    explicit NativeBody(std::vector<std::string> provided) : provided_(std::move(provided)) {}

    void set_attribute(const std::string&, const std::string&) override {}
    void on_init() override {}
    void on_startup(const std::vector<PortConnection>&) override {}
    void on_shutdown() override {}
    void on_remove() override {}
    void on_connect(const std::string&, const Reference&) override {}
    void on_disconnect(const std::string&) override {}
    void set_container_interface(const std::shared_ptr<ContainerInterface>&) override {}
    Reference get_portElement(const std::string& provided) override {
        for (const std::string& name : provided_) {
            if (name == provided) {
                return std::make_shared<NativePort>();
            }
        }
        return nullptr;
    }

  private:
    const std::vector<std::string> provided_;
};

inline Implementation native_implementation(const std::string& name, const std::vector<std::string>& provided,
                                            const std::vector<std::string>& required) {
    return Implementation{name,  provided, required, std::vector<std::string>(), false, false,
                          [provided] { return std::make_shared<NativeBody>(provided); }, std::vector<Policy>(),
                          Interfaces(), Attributes()};
}

/// The Container API of a runtime's root container, call by call.
class Runtime {
  public:
    Runtime(std::shared_ptr<Adapter> adapter, const std::vector<Implementation>& implementations)
        : adapter_(std::move(adapter)), manager_(adapter_->create_runtime(implementations)) {}

    Id add_component(const std::string& implementation) {
        return adapter_->add_component(manager_, implementation, Attributes());
    }
    void remove_component(Id id) { adapter_->remove_component(manager_, id); }
    Reference get_port_element(Id id, const std::string& port) {
        return adapter_->get_port_element(manager_, id, port);
    }
    Id connect(Id id, const std::string& port, const Reference& to) {
        return adapter_->connect(manager_, id, port, to);
    }
    void disconnect(Id connection) { adapter_->disconnect(manager_, connection); }
    void start() { adapter_->start(manager_); }
    void stop() { adapter_->stop(manager_); }
    std::vector<Id> get_components() { return adapter_->get_components(manager_); }
    void destroy() { adapter_->destroy(manager_); }

  private:
    const std::shared_ptr<Adapter> adapter_;
    const ContainerHandle manager_;
};

/// The name of a port element at the framework's API: `name`, which holds {port} and {element}, filled in.
inline std::string spelled(std::string name, const std::string& port, const std::string& element) {
    for (const auto& filled : {std::make_pair(std::string("{port}"), port), std::make_pair(std::string("{element}"), element)}) {
        const std::size_t at = name.find(filled.first);
        if (at != std::string::npos) {
            name.replace(at, filled.first.size(), filled.second);
        }
    }
    return name;
}

/// Mean duration in nanoseconds of one life cycle of a provider and a client, from creation to removal.
inline double life_cycles(const std::shared_ptr<Adapter>& adapter, std::int64_t count) {
    const std::string port = spelled(adapter->port_element_name(), "port", "element");
    Runtime runtime(adapter,
                    {native_implementation("provider", {port}, {}), native_implementation("client", {}, {port})});
    const auto begin = std::chrono::steady_clock::now();
    for (std::int64_t n = 0; n < count; ++n) {
        const Id provider = runtime.add_component("provider");
        const Id client = runtime.add_component("client");
        const Reference reference = runtime.get_port_element(provider, port);
        const Id connection = runtime.connect(client, port, reference);
        runtime.start();
        if (reference->exchange(1) != ~1) {
            throw std::logic_error("exchange came back with a wrong value");
        }
        runtime.stop();
        runtime.disconnect(connection);
        runtime.remove_component(client);
        runtime.remove_component(provider);
    }
    const auto end = std::chrono::steady_clock::now();
    runtime.destroy();
    return count == 0 ? 0.0
                      : static_cast<double>(
                            std::chrono::duration_cast<std::chrono::nanoseconds>(end - begin).count()) /
                            static_cast<double>(count);
}

}  // namespace ucm_cts

#endif
