// Binds the C++ reference framework: the only place that knows both it and the SDK (with hosting.hpp, object_timers.hpp and
// values.hpp).
#include <cstdlib>

#include <ucm_cts/main.hpp>

#include "hosting.hpp"
#include "object_timers.hpp"
#include "values.hpp"

namespace {

using reference_cpp::Lwucm;
using reference_cpp::lwucm_interface;
using reference_cpp::to_data;
using reference_cpp::to_values;

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

std::string product() {
    return lwucm::product() + std::string(reference_cpp::typed_bodies() ? ", typed bodies" : "");
}

// How conformant variants are asked for, see framework/README.md.
lwucm::Options options() {
    const char* const chosen = std::getenv("UCM_CTS_LWUCM_OPTIONS");
    return lwucm::parse_options(chosen != nullptr ? chosen : "");
}

std::shared_ptr<lwucm::PortElementObject> stand_in(const std::string&,
                                                   const std::shared_ptr<lwucm::PortElementObject>& target,
                                                   const std::shared_ptr<lwucm::Interceptor>& interceptor) {
    return lwucm::stand_in<Lwucm::Exchange>(target, interceptor);
}

lwucm::Implementation implementation(const ucm_cts::ShapedImplementation<Lwucm>& one) {
    lwucm::Policies policies = {{}, one.get_policy_element, stand_in, one.get_policy_port};
    for (const ucm_cts::Policy& policy : one.policies) {
        policies.applied.push_back(
            {policy.definition, policy.port, policy.parameters, policy.element, policy.settings});
    }
    std::map<std::string, lwucm::InterfacePtr> interfaces;
    for (const auto& interface : one.interfaces) {
        interfaces.emplace(interface.first, lwucm_interface(*interface.second));
    }
    return {one.name, one.provided, one.required, one.attributes, one.create, one.set_attribute, policies, interfaces};
}

}  // namespace

namespace reference_cpp {

std::shared_ptr<lwucm::PortElementObject> Lwucm::typed(const ucm_cts::Reference& own,
                                                       const ucm_cts::SharedInterface& interface) {
    return std::make_shared<ProbeElement>(own, lwucm_interface(*interface));
}

std::shared_ptr<ucm_cts::TimerScheduler> Lwucm::scheduler(const std::shared_ptr<PortElementObject>& element) {
    const auto scheduler = std::dynamic_pointer_cast<lwucm::ott_scheduler>(element);
    return scheduler ? std::make_shared<WrappedScheduler<LwucmTimers>>(scheduler) : nullptr;
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

std::shared_ptr<lwucm::Runtime> Lwucm::create_runtime(
    const std::vector<ucm_cts::ShapedImplementation<Lwucm>>& implementations) {
    lwucm::Repository repository;
    for (const auto& one : implementations) {
        lwucm::Implementation made = implementation(one);
        if (typed_bodies()) {
            typed_bodies()(one, made);
        }
        repository.add(std::move(made));
    }
    return lwucm::create_runtime(repository, options());
}

TypedBodies& typed_bodies() {
    static TypedBodies linked;
    return linked;
}

}  // namespace reference_cpp

namespace {

class LwucmAdapter final : public ucm_cts::ShapedAdapter<Lwucm> {
    typedef ucm_cts::ContainerHandle Handle;

  public:
    ucm_cts::LinkHandle link(const Handle&, const std::string& connector,
                             const ucm_cts::SharedInterface& interface) override {
        return translate([&]() -> ucm_cts::LinkHandle {
            return manager_->create_link(connector, lwucm_interface(*interface));
        });
    }

    ucm_cts::LinkHandle link_with_types(const Handle&, const std::string& connector,
                                        const std::map<std::string, ucm_cts::SharedType>& types) override {
        lwucm::BoundTypes bound;
        for (const auto& type : types) {
            bound.emplace(type.first, reference_cpp::lwucm_type(*type.second));
        }
        return translate([&]() -> ucm_cts::LinkHandle { return manager_->create_link(connector, bound); });
    }

    void attach(const ucm_cts::LinkHandle& link, const std::string& role, const Handle& container, ucm_cts::Id id,
                const std::string& port) override {
        static const std::map<std::string, lwucm::Role> roles = {{"client", lwucm::Role::client},
                                                                 {"server", lwucm::Role::server},
                                                                 {"emitter", lwucm::Role::emitter},
                                                                 {"receiver", lwucm::Role::receiver},
                                                                 {"rr_synchronous_client",
                                                                  lwucm::Role::rr_synchronous_client},
                                                                 {"rr_synchronous_server",
                                                                  lwucm::Role::rr_synchronous_server},
                                                                 {"rr_asynchronous_client",
                                                                  lwucm::Role::rr_asynchronous_client},
                                                                 {"rr_asynchronous_server",
                                                                  lwucm::Role::rr_asynchronous_server},
                                                                 {"sd_reader", lwucm::Role::sd_reader},
                                                                 {"sd_writer", lwucm::Role::sd_writer}};
        translate([&] {
            of_link(link).attach(roles.at(role), shared(container), static_cast<lwucm::componentId>(id), port);
        });
    }

    void detach(const ucm_cts::LinkHandle& link, const Handle& container, ucm_cts::Id id,
                const std::string& port) override {
        translate([&] { of_link(link).detach(shared(container), static_cast<lwucm::componentId>(id), port); });
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
            records.push_back({lwucm::name_of(record.severity), ucm_cts::to_utf8(record.message)});
        }
        return records;
    }

  private:
    static lwucm::Link& of_link(const ucm_cts::LinkHandle& link) { return *static_cast<lwucm::Link*>(link.get()); }
};

}  // namespace

UCM_CTS_ADAPTER(LwucmAdapter, product(), "0.1.0");
