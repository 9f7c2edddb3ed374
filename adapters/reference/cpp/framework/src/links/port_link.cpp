#include "links/port_link.hpp"

#include <utility>
#include <vector>

#include "containers/container_impl.hpp"
#include "containers/names.hpp"

namespace lwucm {

void PortEnd::stopping() { connector_.abandon(instance()); }

void PortEnd::left() { connector_.abandon(instance()); }

void CalledEnd::started() {
    admission_.open();
    lane_.open();
}

void CalledEnd::stopping() {
    PortEnd::stopping();
    lane_.shut();
    admission_.shut();
}

void CalledEnd::await_calls() {
    lane_.await_calls();
    admission_.await_leaving();
}

void CalledEnd::left() {
    PortEnd::left();
    admission_.shut();
    lane_.shut();
    lane_.end();
}

Values CalledEnd::call(const char* method, const Values& arguments) {
    const Admission::Call call(admission_);
    if (!call.admitted()) {
        throw UCM_ERROR("the component is not operational");
    }
    return called_->call(method, arguments);
}

/// What a required port element is connected to.
class PortLink::Element final : public DynamicPortElement {
  public:
    Element(std::shared_ptr<PortLink> connector, InterfacePtr interface, AttachedPort port)
        : connector_(std::move(connector)), interface_(std::move(interface)), port_(std::move(port)) {}

    const InterfacePtr& get_interface() const override { return interface_; }

    Values call(const std::string& method, const Values& arguments) override {
        interface_->method(method);
        return connector_->carry_out(port_, method, arguments);
    }

  private:
    const std::shared_ptr<PortLink> connector_;
    const InterfacePtr interface_;
    const AttachedPort port_;
};

void PortLink::attach(Role role, const std::shared_ptr<Container>& container, componentId component,
                      const std::string& port) {
    Operation operation(*shared_);
    const ContainerImpl& its_container = own(container);
    const std::shared_ptr<Instance> instance = find(its_container, component);
    const PortElements elements = elements_of(role);
    const std::string provided = elements.provided.empty() ? "" : port + "_" + elements.provided;
    const std::string required = elements.required.empty() ? "" : port + "_" + elements.required;
    if (!provided.empty()) {
        check_port(*instance, false, provided, *elements.provided_interface);
    }
    if (!required.empty()) {
        check_port(*instance, true, required, *elements.required_interface);
    }
    check_configuring(its_container);
    if (!required.empty() && instance->is_connected(required)) {
        throw UCM_ERROR(quoted(required) + " is already connected");
    }
    AttachedPort attached = {instance.get(), role, port, nullptr};
    if (!provided.empty()) {
        attached.called =
            std::make_shared<CalledEnd>(*instance, provided, port, *this, ask(*instance, provided));
    }
    join(attached);
    if (!required.empty()) {
        connect(*instance, elements, port, required, attached);
    }
    if (attached.called) {
        add(attached.called);
    }
}

void PortLink::detach(const std::shared_ptr<Container>& container, componentId component, const std::string& port) {
    Operation operation(*shared_);
    const ContainerImpl& its_container = own(container);
    const std::shared_ptr<Instance> instance = find(its_container, component);
    std::vector<std::shared_ptr<End>> leaving;
    for (const std::shared_ptr<End>& end : ends()) {
        if (&end->instance() == instance.get() && static_cast<const PortEnd&>(*end).of == port) {
            leaving.push_back(end);
        }
    }
    if (leaving.empty()) {
        throw NOT_FOUND(quoted(port) + " is no end of the link");
    }
    check_configuring(its_container);
    Attempts attempts;
    for (const std::shared_ptr<End>& end : leaving) {
        remove(end, attempts);
    }
    attempts.check();
}

void PortLink::connect(Instance& instance, const PortElements& elements, const std::string& port,
                       const std::string& required, const AttachedPort& attached) {
    const auto element = std::make_shared<Element>(std::static_pointer_cast<PortLink>(shared_from_this()),
                                                   elements.required_interface, attached);
    Attempts attempts;
    attempts.make("on_connect", [&] { instance.connect(required, element); });
    try {
        attempts.check();
    } catch (...) {
        if (attached.called) {
            forget(*attached.called);
        }
        throw;
    }
    add(std::make_shared<PortEnd>(instance, true, required, port, *this));
}

const char* PortLink::fault() {
    const Condition condition = transport_.condition();
    return condition == Condition::sound              ? nullptr
           : condition == Condition::transport_broken ? "comm_error"
                                                      : "internal_error";
}

Value code(const char* name) { return Value::enumerator(name); }

Value any_value(const Type& type) {
    switch (type.kind) {
        case Type::Kind::integer:
            return Value::integer(0);
        case Type::Kind::single:
            return Value::single(0);
        case Type::Kind::real:
            return Value::real(0);
        case Type::Kind::character8:
        case Type::Kind::character32:
            return Value::character(0);
        case Type::Kind::boolean:
            return Value::boolean(false);
        case Type::Kind::string8:
        case Type::Kind::string32:
            return Value::string(std::u32string());
        case Type::Kind::enumeration:
            return Value::enumerator(type.enumerators.front().name);
        case Type::Kind::alias:
            return any_value(*type.of);
        case Type::Kind::union_type: {
            for (const Enumerator& one : resolved(*type.of).enumerators) {
                if (const Case* const selected = selected_case(type, one.name)) {
                    return Value::list({Value::enumerator(one.name), any_value(*selected->type)});
                }
            }
            return Value::list({Value::enumerator(resolved(*type.of).enumerators.front().name)});
        }
        case Type::Kind::structure: {
            Values fields;
            for (const Field& field : type.fields) {
                fields.push_back(any_value(*field.type));
            }
            return Value::list(fields);
        }
        case Type::Kind::array: {
            Value made = any_value(*type.of);
            for (auto size = type.sizes.rbegin(); size != type.sizes.rend(); ++size) {
                made = Value::list(Values(*size, made));
            }
            return made;
        }
        case Type::Kind::sequence:
            break;
    }
    return Value::list();
}

}  // namespace lwucm
