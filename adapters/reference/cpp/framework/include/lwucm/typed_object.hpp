// How lwucm has a typed body in its generic shape: numbers instead of names, one type for all (13.9). Used by typed.hpp.
#ifndef LWUCM_TYPED_OBJECT_HPP
#define LWUCM_TYPED_OBJECT_HPP

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lwucm/errors.hpp"
#include "lwucm/repository.hpp"
#include "lwucm/typed_calls.hpp"

namespace lwucm {

/// What the port elements and attributes of an implementation are called at the Container API, each list in the order of the
/// model. `services` are the port elements that its technical policies require.
struct TypedNames {
    Implementation::Names provided;
    Implementation::Names required;
    Implementation::Names attributes;
    Implementation::Names services;
};

/// What a body is connected to when it starts.
class TypedConnections {
  public:
    TypedConnections(const PortConnections& connections, const TypedNames& names)
        : connections_(connections), names_(names) {}

    /// The connection of a required port element, without reference if there is none. UCM_ERROR if what it is connected to has
    /// another interface.
    template <class Interface>
    ::ucm::PortConnection<Interface> required(std::size_t n) const {
        return of<Interface>(names_.required.at(n));
    }

    /// The same of a port element that a technical policy requires.
    template <class Interface>
    ::ucm::PortConnection<Interface> service(std::size_t n) const {
        return of<Interface>(names_.services.at(n));
    }

  private:
    template <class Interface>
    ::ucm::PortConnection<Interface> of(const std::string& name) const {
        const std::shared_ptr<PortElementObject> element = find(name);
        std::shared_ptr<Interface> typed = std::dynamic_pointer_cast<Interface>(element);
        if (element && !typed) {
            typed = TypedReference<Interface>::to(element);
        }
        if (element && !typed) {
            throw UCM_ERROR("port element '" + name + "' is connected to one with another interface");
        }
        return ::ucm::PortConnection<Interface>(name, typed);
    }

    std::shared_ptr<PortElementObject> find(const std::string& name) const {
        for (const PortConnection& connection : connections_) {
            if (connection.from_port == name && !connection.to_port.empty()) {
                return connection.to_port.front();
            }
        }
        return nullptr;
    }

    const PortConnections& connections_;
    const TypedNames& names_;
};

/// The interfaces of the port elements of a type, in the order of the model; null for one that cannot be called by name.
struct TypedInterfaces {
    std::vector<InterfacePtr> provided;
    std::vector<InterfacePtr> required;
};

/// A typed body of any type.
class TypedBody {
  public:
    virtual ~TypedBody() = default;
    virtual void on_init() = 0;
    virtual void on_startup(const TypedConnections& connections) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual std::shared_ptr<PortElementObject> provided(std::size_t n) = 0;

    /// The same port element as a DynamicPortElement; null if it cannot be called by name.
    virtual std::shared_ptr<PortElementObject> provided_by_name(std::size_t n) = 0;

    virtual void set_attribute(std::size_t n, const std::string& value) = 0;
    virtual std::shared_ptr<component_execution_intf> execution() = 0;
    virtual std::shared_ptr<PortElementObject> policy_port(const std::string& policy, const std::string& element) = 0;

    /// What the body implements beside its abstract class, or null.
    virtual Connectable* connectable() = 0;
    virtual FragmentObject* fragment() = 0;
};

namespace detail {

/// How many names there are if `name` is none of them.
inline std::size_t index_of(const std::string& name, const Implementation::Names& names) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// What is the same for all bodies of an implementation. `by_name` are the provided port elements that are called by name, by
/// number.
struct TypedShape {
    TypedNames names;
    std::vector<bool> by_name;
};

/// A typed body in the generic shape, which asks for names.
class TypedObject : public ComponentObject {
  public:
    TypedObject(std::shared_ptr<TypedBody> its_body, std::shared_ptr<const TypedShape> shape)
        : body(std::move(its_body)), shape_(std::move(shape)) {}

    void on_init() override { body->on_init(); }
    void on_remove() override { body->on_remove(); }
    void on_shutdown() override { body->on_shutdown(); }

    void on_startup(const PortConnections& dependencies) override {
        body->on_startup(TypedConnections(dependencies, shape_->names));
    }

    std::shared_ptr<PortElementObject> get_portElement(const std::string& provided) override {
        const std::size_t n = index_of(provided, shape_->names.provided);
        if (n == shape_->names.provided.size()) {
            return nullptr;
        }
        return shape_->by_name[n] ? body->provided_by_name(n) : body->provided(n);
    }

    void set_attribute(const std::string& name, const std::string& value) {
        body->set_attribute(index_of(name, shape_->names.attributes), value);
    }

    const std::shared_ptr<TypedBody> body;

  private:
    const std::shared_ptr<const TypedShape> shape_;
};

template <class Base>
class ConnectableObject final : public Base, public Connectable {
  public:
    using Base::Base;

    void on_connect(const std::string& port_name, std::shared_ptr<PortElementObject> required) override {
        this->body->connectable()->on_connect(port_name, std::move(required));
    }

    void on_disconnect(const std::string& port_name) override { this->body->connectable()->on_disconnect(port_name); }
};

class TypedFragment : public TypedObject, public FragmentObject {
  public:
    using TypedObject::TypedObject;

    void set_container_interface(std::shared_ptr<Container> container) override {
        body->fragment()->set_container_interface(std::move(container));
    }
};

typedef std::shared_ptr<ComponentObject> (*MakeObject)(const std::shared_ptr<TypedBody>&,
                                                       const std::shared_ptr<const TypedShape>&);

template <class Object>
std::shared_ptr<ComponentObject> make_object(const std::shared_ptr<TypedBody>& body,
                                             const std::shared_ptr<const TypedShape>& shape) {
    return std::make_shared<Object>(body, shape);
}

/// What makes an object that is a Connectable or a FragmentObject if the body is one.
inline MakeObject maker_for(TypedBody& body) {
    if (body.fragment() != nullptr) {
        return body.connectable() != nullptr ? make_object<ConnectableObject<TypedFragment>>
                                             : make_object<TypedFragment>;
    }
    return body.connectable() != nullptr ? make_object<ConnectableObject<TypedObject>> : make_object<TypedObject>;
}

}  // namespace detail

/// What puts a stand-in before a port element, by number.
typedef std::shared_ptr<PortElementObject> (*TypedIntercept)(std::size_t,
                                                             const std::shared_ptr<PortElementObject>& target,
                                                             const std::shared_ptr<Interceptor>& interceptor);

/// Has `implementation`, under the names that it has, make these bodies instead of what it made before; null is no body. Its port
/// elements with `interfaces` are called by name. `services` are the names that the model gives to those that policies require;
/// where policies of the implementation have names for them, these count.
inline void host_typed(Implementation& implementation, const std::function<std::shared_ptr<TypedBody>()>& create,
                       const Implementation::Names& services, TypedIntercept provided, TypedIntercept required) {
    detail::TypedShape made = {{implementation.provided, implementation.required, implementation.attributes, {}}, {}};
    for (const Policy& policy : implementation.policies.applied) {
        if (!policy.element.empty()) {
            made.names.services.push_back(policy.element);
        }
    }
    if (made.names.services.empty()) {
        made.names.services = services;
    }
    for (const std::string& port : implementation.provided) {
        made.by_name.push_back(implementation.interfaces.count(port) != 0);
    }
    const auto shape = std::make_shared<const detail::TypedShape>(std::move(made));
    implementation.create = [create, shape]() -> std::shared_ptr<ComponentObject> {
        const std::shared_ptr<TypedBody> body = create();
        return body ? detail::maker_for(*body)(body, shape) : nullptr;
    };
    implementation.set_attribute = [](ComponentObject& body, const std::string& name, const std::string& value) {
        dynamic_cast<detail::TypedObject&>(body).set_attribute(name, value);
    };
    implementation.policies.get_policy_element = [](ComponentObject& body, const std::string&, const std::string&) {
        return dynamic_cast<detail::TypedObject&>(body).body->execution();
    };
    implementation.policies.get_policy_port = [](ComponentObject& body, const std::string& policy,
                                                 const std::string& element) {
        return dynamic_cast<detail::TypedObject&>(body).body->policy_port(policy, element);
    };
    implementation.policies.intercept = [shape, provided, required](
                                            const std::string& port, const std::shared_ptr<PortElementObject>& target,
                                            const std::shared_ptr<Interceptor>& interceptor) {
        const TypedNames& names = shape->names;
        const std::size_t n = detail::index_of(port, names.provided);
        return n < names.provided.size() ? provided(n, target, interceptor)
                                         : required(detail::index_of(port, names.required), target, interceptor);
    };
}

}  // namespace lwucm

#endif
