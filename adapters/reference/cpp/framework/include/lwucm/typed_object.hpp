// How lwucm has a typed body in its generic shape: numbers instead of names, one type for all (13.9). Used by typed.hpp.
#ifndef LWUCM_TYPED_OBJECT_HPP
#define LWUCM_TYPED_OBJECT_HPP

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "lwucm/errors.hpp"
#include "lwucm/repository.hpp"

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
        const std::shared_ptr<Interface> typed = std::dynamic_pointer_cast<Interface>(element);
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

/// A typed body of any type.
class TypedBody {
  public:
    virtual ~TypedBody() = default;
    virtual void on_init() = 0;
    virtual void on_startup(const TypedConnections& connections) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual std::shared_ptr<PortElementObject> provided(std::size_t n) = 0;
    virtual void set_attribute(std::size_t n, const std::string& value) = 0;
    virtual std::shared_ptr<component_execution_intf> execution() = 0;

    /// What the body implements beside its abstract class, or null.
    virtual Connectable* connectable() = 0;
    virtual FragmentObject* fragment() = 0;
};

namespace detail {

/// How many names there are if `name` is none of them.
inline std::size_t index_of(const std::string& name, const Implementation::Names& names) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// A typed body in the generic shape, which asks for names.
class TypedObject : public ComponentObject {
  public:
    TypedObject(std::shared_ptr<TypedBody> its_body, std::shared_ptr<const TypedNames> names)
        : body(std::move(its_body)), names_(std::move(names)) {}

    void on_init() override { body->on_init(); }
    void on_remove() override { body->on_remove(); }
    void on_shutdown() override { body->on_shutdown(); }

    void on_startup(const PortConnections& dependencies) override {
        body->on_startup(TypedConnections(dependencies, *names_));
    }

    std::shared_ptr<PortElementObject> get_portElement(const std::string& provided) override {
        const std::size_t n = index_of(provided, names_->provided);
        return n < names_->provided.size() ? body->provided(n) : nullptr;
    }

    void set_attribute(const std::string& name, const std::string& value) {
        body->set_attribute(index_of(name, names_->attributes), value);
    }

    const std::shared_ptr<TypedBody> body;

  private:
    const std::shared_ptr<const TypedNames> names_;
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
                                                       const std::shared_ptr<const TypedNames>&);

template <class Object>
std::shared_ptr<ComponentObject> make_object(const std::shared_ptr<TypedBody>& body,
                                             const std::shared_ptr<const TypedNames>& names) {
    return std::make_shared<Object>(body, names);
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

/// Has `implementation`, under the names that it has, make these bodies instead of what it made before; null is no body.
inline void host_typed(Implementation& implementation, const std::function<std::shared_ptr<TypedBody>()>& create,
                       const Implementation::Names& services, TypedIntercept provided, TypedIntercept required) {
    const auto names = std::make_shared<const TypedNames>(
        TypedNames{implementation.provided, implementation.required, implementation.attributes, services});
    implementation.create = [create, names]() -> std::shared_ptr<ComponentObject> {
        const std::shared_ptr<TypedBody> body = create();
        return body ? detail::maker_for(*body)(body, names) : nullptr;
    };
    implementation.set_attribute = [](ComponentObject& body, const std::string& name, const std::string& value) {
        dynamic_cast<detail::TypedObject&>(body).set_attribute(name, value);
    };
    implementation.policies.get_policy_element = [](ComponentObject& body, const std::string&, const std::string&) {
        return dynamic_cast<detail::TypedObject&>(body).body->execution();
    };
    implementation.policies.get_policy_port = nullptr;  // no typed port element can be called by name
    implementation.policies.intercept = [names, provided, required](
                                            const std::string& port, const std::shared_ptr<PortElementObject>& target,
                                            const std::shared_ptr<Interceptor>& interceptor) {
        const std::size_t n = detail::index_of(port, names->provided);
        return n < names->provided.size() ? provided(n, target, interceptor)
                                          : required(detail::index_of(port, names->required), target, interceptor);
    };
}

}  // namespace lwucm

#endif
