// Typed component bodies (13.9): lwucm hosts what implements a generated abstract class (13.7). What stands between the two,
// the specialisations of TypedGlue and TypedStandIn, is generated as well.
#ifndef LWUCM_TYPED_HPP
#define LWUCM_TYPED_HPP

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "lwucm/attribute_text.hpp"
#include "lwucm/typed_calls.hpp"
#include "lwucm/typed_object.hpp"
#include "lwucm/typed_timers.hpp"

namespace lwucm {

/// Generated for each abstract class of component bodies:
///   - `static TypedNames names()`, those of the model;
///   - `static TypedInterfaces interfaces()`;
///   - `static std::shared_ptr<PortElementObject> provided(Body&, std::size_t)`, what the getter of that provided port element
///     gives;
///   - `static std::shared_ptr<PortElementObject> by_name(std::size_t, const std::shared_ptr<PortElementObject>&)`, what `lwucm::by_name`
///     makes of that provided port element;
///   - `static void on_startup(Body&, const TypedConnections&)`;
///   - `static void set_attribute(Body&, std::size_t, const std::string& value)`;
///   - `static std::shared_ptr<component_execution_intf> execution(Body&)`, what the getter of a self-executing component gives,
///     null for all others;
///   - `static std::shared_ptr<PortElementObject> policy_port(Body&, const std::string& policy, const std::string& element)`, what
///     `lwucm::by_name` makes of what the getter of another port element gives that a technical policy makes it provide;
///   - `static std::shared_ptr<PortElementObject> intercept_provided(std::size_t, const std::shared_ptr<PortElementObject>&,
///     const std::shared_ptr<Interceptor>&)`, a TypedStandIn for that provided port element; `intercept_required` likewise.
template <class Body>
struct TypedGlue;

/// Generated for each interface of port elements: a class with that interface, each operation of which has an Interceptor carry
/// out that of the target. Made of target and interceptor.
template <class Interface>
class TypedStandIn;

template <class Body>
class TypedBodyOf final : public TypedBody {
    typedef TypedGlue<Body> Glue;

  public:
    explicit TypedBodyOf(std::shared_ptr<Body> body) : body_(std::move(body)) {}
    void on_init() override { body_->on_init(); }
    void on_startup(const TypedConnections& connections) override { Glue::on_startup(*body_, connections); }
    void on_shutdown() override { body_->on_shutdown(); }
    void on_remove() override { body_->on_remove(); }
    std::shared_ptr<PortElementObject> provided(std::size_t n) override { return Glue::provided(*body_, n); }

    /// The same object as long as the getter gives the same.
    std::shared_ptr<PortElementObject> provided_by_name(std::size_t n) override {
        const std::shared_ptr<PortElementObject> element = provided(n);
        std::lock_guard<std::mutex> lock(mutex_);
        auto& known = by_name_[n];
        if (known.first != element) {
            known = {element, Glue::by_name(n, element)};
        }
        return known.second;
    }

    void set_attribute(std::size_t n, const std::string& value) override { Glue::set_attribute(*body_, n, value); }
    std::shared_ptr<component_execution_intf> execution() override { return Glue::execution(*body_); }
    std::shared_ptr<PortElementObject> policy_port(const std::string& policy, const std::string& element) override {
        return Glue::policy_port(*body_, policy, element);
    }
    Connectable* connectable() override { return dynamic_cast<Connectable*>(body_.get()); }
    FragmentObject* fragment() override { return dynamic_cast<FragmentObject*>(body_.get()); }

  private:
    typedef std::shared_ptr<PortElementObject> Element;

    const std::shared_ptr<Body> body_;
    std::mutex mutex_;
    std::map<std::size_t, std::pair<Element, Element>> by_name_;
};

/// What a self-executing body provides, whose interface was generated from a model of the execution policies, as lwucm's own.
template <class Execution>
std::shared_ptr<component_execution_intf> as_execution(const std::shared_ptr<Execution>& typed) {
    class Running final : public component_execution_intf {
      public:
        explicit Running(std::shared_ptr<Execution> execution) : execution_(std::move(execution)) {}
        void run() override { execution_->run(); }

      private:
        const std::shared_ptr<Execution> execution_;
    };
    return typed ? std::make_shared<Running>(typed) : nullptr;
}

/// A TypedStandIn. UCM_ERROR if `target` does not have `Interface`.
template <class Interface>
std::shared_ptr<PortElementObject> stand_in(const std::shared_ptr<PortElementObject>& target,
                                            const std::shared_ptr<Interceptor>& interceptor) {
    const std::shared_ptr<Interface> typed = std::dynamic_pointer_cast<Interface>(target);
    if (!typed) {
        throw UCM_ERROR("a port element does not have its interface");
    }
    return std::make_shared<TypedStandIn<Interface>>(typed, interceptor);
}

/// Has `implementation`, under the names that it has, make bodies of one type instead of what it made before. What `create`
/// makes may be a Connectable or a FragmentObject, too.
template <class Body>
void host(Implementation& implementation, const std::function<std::shared_ptr<Body>()>& create) {
    const auto erased = [create]() -> std::shared_ptr<TypedBody> {
        std::shared_ptr<Body> body = create();
        return body ? std::make_shared<TypedBodyOf<Body>>(std::move(body)) : nullptr;
    };
    typedef TypedGlue<Body> Glue;
    host_typed(implementation, erased, Glue::names().services, Glue::intercept_provided, Glue::intercept_required);
}

/// The interfaces of an implementation's port elements by their names in the model, without those that cannot be called by name.
template <class Body>
std::map<std::string, InterfacePtr> interfaces_of() {
    const TypedNames names = TypedGlue<Body>::names();
    const TypedInterfaces interfaces = TypedGlue<Body>::interfaces();
    std::map<std::string, InterfacePtr> all;
    const auto add = [&all](const Implementation::Names& called, const std::vector<InterfacePtr>& theirs) {
        for (std::size_t n = 0; n < called.size(); ++n) {
            if (theirs[n]) {
                all.emplace(called[n], theirs[n]);
            }
        }
    };
    add(names.provided, interfaces.provided);
    add(names.required, interfaces.required);
    return all;
}

/// An implementation with typed bodies, under the names of its model. The port elements `of_links` can be ends of links;
/// BAD_PARAMETER if one of them cannot be called by name.
template <class Body>
Implementation typed_implementation(const std::string& name, const std::function<std::shared_ptr<Body>()>& create,
                                    const Policies& policies = Policies(),
                                    const Implementation::Names& of_links = Implementation::Names()) {
    const TypedNames names = TypedGlue<Body>::names();
    const std::map<std::string, InterfacePtr> known = interfaces_of<Body>();
    std::map<std::string, InterfacePtr> interfaces;
    for (const std::string& port : of_links) {
        const auto found = known.find(port);
        if (found == known.end()) {
            throw BAD_PARAMETER("'" + port + "' cannot be called by name");
        }
        interfaces.insert(*found);
    }
    Implementation implementation(name, names.provided, names.required, names.attributes, nullptr, nullptr, policies,
                                  interfaces);
    host<Body>(implementation, create);
    return implementation;
}

}  // namespace lwucm

#endif
