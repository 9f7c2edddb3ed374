// Binds the C++ reference framework: the only place that knows both it and the SDK (with values.hpp).
#include <cstdlib>

#include <lwucm/runtime.hpp>
#include <ucm_cts/main.hpp>
#include <ucm_cts/shaped.hpp>

#include "values.hpp"

namespace {

using reference_cpp::lwucm_interface;
using reference_cpp::to_data;
using reference_cpp::to_values;

struct Lwucm {
    typedef lwucm::PortElementObject PortElementObject;
    typedef lwucm::ComponentObject ComponentObject;
    typedef lwucm::FragmentObject FragmentObject;
    typedef lwucm::Connectable Connectable;
    typedef lwucm::Container Container;
    typedef lwucm::Runtime ContainerManager;
    typedef lwucm::component_execution_intf ComponentExecution;
    typedef lwucm::NOT_FOUND NOT_FOUND;
    typedef lwucm::BAD_PARAMETER BAD_PARAMETER;
    typedef lwucm::UCM_ERROR UCM_ERROR;

    static std::shared_ptr<ContainerManager> create_runtime(
        const std::vector<ucm_cts::ShapedImplementation<Lwucm>>& implementations);

    static lwucm::Properties configuration(const std::string& implementation, const ucm_cts::Attributes& attributes) {
        return ucm_cts::properties<lwucm::Properties>("implementation", implementation, attributes);
    }

    static std::shared_ptr<PortElementObject> typed(const ucm_cts::Reference& own,
                                                    const ucm_cts::SharedInterface& interface);
    static ucm_cts::Data call(PortElementObject& element, const std::string& method, const ucm_cts::Data& arguments);
};

// What a code generator would make of the probes' interface, to stand before port elements of protected components.
class InterceptedExchange final : public ucm_cts::ShapedExchange<Lwucm> {
    typedef ucm_cts::ShapedExchange<Lwucm> Exchange;

  public:
    InterceptedExchange(const std::shared_ptr<lwucm::PortElementObject>& target,
                        std::shared_ptr<lwucm::Interceptor> interceptor)
        : target_(std::dynamic_pointer_cast<Exchange>(target)), interceptor_(std::move(interceptor)) {}

    std::int32_t exchange(std::int32_t value) override {
        std::int32_t result = 0;
        interceptor_->call("exchange", [&] { result = target_->exchange(value); });
        return result;
    }

    static std::shared_ptr<lwucm::PortElementObject> make(const std::shared_ptr<lwucm::PortElementObject>& target,
                                                          const std::shared_ptr<lwucm::Interceptor>& interceptor) {
        return std::make_shared<InterceptedExchange>(target, interceptor);
    }

  private:
    const std::shared_ptr<Exchange> target_;
    const std::shared_ptr<lwucm::Interceptor> interceptor_;
};

const lwucm::Type* find_exception(const lwucm::Method& method, const std::string& name) {
    for (const lwucm::TypePtr& exception : method.raises()) {
        if (exception->name == name) {
            return exception.get();
        }
    }
    return nullptr;
}

// A probe's own port element that has an interface.
class ProbeElement final : public lwucm::DynamicPortElement, public ucm_cts::ProbesOwn {
  public:
    ProbeElement(const ucm_cts::Reference& own, lwucm::InterfacePtr interface)
        : ProbesOwn(own), interface_(std::move(interface)) {}

    const lwucm::InterfacePtr& get_interface() const override { return interface_; }

    lwucm::Values call(const std::string& name, const lwucm::Values& arguments) override {
        const lwucm::Method& method = interface_->method(name);
        try {
            return to_values(method.results(), element->call(name, to_data(arguments)));
        } catch (const ucm_cts::DeclaredException& exception) {
            lwucm::Values fields;
            if (const lwucm::Type* const type = find_exception(method, exception.name)) {
                fields = reference_cpp::to_value(*type, exception.fields).as_list();
            }
            throw lwucm::DeclaredException(exception.name, fields);
        }
    }

  private:
    const lwucm::InterfacePtr interface_;
};

std::shared_ptr<lwucm::PortElementObject> Lwucm::typed(const ucm_cts::Reference& own,
                                                       const ucm_cts::SharedInterface& interface) {
    return std::make_shared<ProbeElement>(own, lwucm_interface(*interface));
}

ucm_cts::Data Lwucm::call(PortElementObject& element, const std::string& name, const ucm_cts::Data& arguments) {
    lwucm::DynamicPortElement& dynamic = dynamic_cast<lwucm::DynamicPortElement&>(element);
    const lwucm::Method& method = dynamic.get_interface()->method(name);
    try {
        return to_data(dynamic.call(name, to_values(method.arguments(), arguments)));
    } catch (const lwucm::DeclaredException& exception) {
        throw ucm_cts::DeclaredException(exception.name, to_data(exception.fields));
    }
}

// How conformant variants are asked for, see framework/README.md.
lwucm::Options options() {
    const char* const chosen = std::getenv("UCM_CTS_LWUCM_OPTIONS");
    return lwucm::parse_options(chosen != nullptr ? chosen : "");
}

std::shared_ptr<lwucm::Runtime> Lwucm::create_runtime(
    const std::vector<ucm_cts::ShapedImplementation<Lwucm>>& implementations) {
    lwucm::Repository repository;
    for (const auto& one : implementations) {
        lwucm::Policies policies = {{}, one.get_policy_element, InterceptedExchange::make};
        for (const ucm_cts::Policy& policy : one.policies) {
            policies.applied.push_back({policy.definition, policy.port, policy.parameters, policy.element});
        }
        std::map<std::string, lwucm::InterfacePtr> interfaces;
        for (const auto& interface : one.interfaces) {
            interfaces.emplace(interface.first, lwucm_interface(*interface.second));
        }
        repository.add({one.name, one.provided, one.required, one.attributes, one.create, one.set_attribute, policies,
                        interfaces});
    }
    return lwucm::create_runtime(repository, options());
}

class LwucmAdapter final : public ucm_cts::ShapedAdapter<Lwucm> {
    typedef ucm_cts::ContainerHandle Handle;

  public:
    ucm_cts::LinkHandle link(const Handle&, const std::string& connector,
                             const ucm_cts::SharedInterface& interface) override {
        return translate([&]() -> ucm_cts::LinkHandle {
            return manager_->create_link(connector, lwucm_interface(*interface));
        });
    }

    void attach(const ucm_cts::LinkHandle& link, const std::string& role, const Handle& container, ucm_cts::Id id,
                const std::string& port) override {
        static const std::map<std::string, lwucm::Role> roles = {{"client", lwucm::Role::client},
                                                                 {"server", lwucm::Role::server},
                                                                 {"emitter", lwucm::Role::emitter},
                                                                 {"receiver", lwucm::Role::receiver}};
        translate([&] {
            of_link(link).attach(roles.at(role), own(container), static_cast<lwucm::componentId>(id), port);
        });
    }

    void detach(const ucm_cts::LinkHandle& link, const Handle& container, ucm_cts::Id id,
                const std::string& port) override {
        translate([&] { of_link(link).detach(own(container), static_cast<lwucm::componentId>(id), port); });
    }

    void break_link(const ucm_cts::LinkHandle& link, const std::string& where) override {
        if (where == "transport") {
            of_link(link).break_transport();
        } else {
            of_link(link).break_connector();
        }
    }

    void mend_link(const ucm_cts::LinkHandle& link) override { of_link(link).mend(); }

    std::vector<ucm_cts::LogRecord> read_log(const Handle&) override {
        std::vector<ucm_cts::LogRecord> records;
        for (const lwucm::LogRecord& record : manager_->trace_records()) {
            records.push_back({lwucm::name_of(record.severity), reference_cpp::to_utf8(record.message)});
        }
        return records;
    }

  private:
    static lwucm::Link& of_link(const ucm_cts::LinkHandle& link) { return *static_cast<lwucm::Link*>(link.get()); }

    static std::shared_ptr<lwucm::Container> own(const Handle& container) {
        return std::static_pointer_cast<lwucm::Container>(container);
    }
};

}  // namespace

UCM_CTS_ADAPTER(LwucmAdapter, lwucm::product(), "0.1.0");
