// Calls by name of typed port elements, and typed references to port elements that are called by name. Links (10.1.5, 10.1.6,
// 10.4) and the services of containers (10.1.4, 10.3) work by name; typed bodies (13.9) do not.
#ifndef LWUCM_TYPED_CALLS_HPP
#define LWUCM_TYPED_CALLS_HPP

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lwucm/errors.hpp"
#include "lwucm/interfaces.hpp"
#include "lwucm/typed_values.hpp"

namespace lwucm {

/// Generated for each interface that can be called by name, one without attributes and references in its signatures, whose types
/// all have TypedValues:
///   - `static InterfacePtr description()`;
///   - `static Values call(Interface&, const std::string& method, const Values& arguments)`.
/// For all others the description is null.
template <class Interface>
struct TypedCalls {
    static InterfacePtr description() { return nullptr; }

    static Values call(Interface&, const std::string& method, const Values&) {
        throw BAD_PARAMETER("'" + method + "' cannot be called by name");
    }
};

/// What a typed body is given in place of a reference that does not have `Interface`; null if nothing can be made of it.
/// Generated where there are TypedCalls, and for the schedulers of object timers.
template <class Interface>
struct TypedReference {
    static std::shared_ptr<Interface> to(const std::shared_ptr<PortElementObject>&) { return nullptr; }
};

/// A typed port element as one that is called by name.
template <class Interface>
class TypedByName final : public DynamicPortElement {
  public:
    explicit TypedByName(std::shared_ptr<Interface> target)
        : target_(std::move(target)), interface_(TypedCalls<Interface>::description()) {}

    const InterfacePtr& get_interface() const override { return interface_; }

    Values call(const std::string& method, const Values& arguments) override {
        return TypedCalls<Interface>::call(*target_, method, arguments);
    }

  private:
    const std::shared_ptr<Interface> target_;
    const InterfacePtr interface_;
};

/// A TypedByName of `element`, or null if it is null or cannot be called by name. UCM_ERROR if it does not have `Interface`.
template <class Interface>
std::shared_ptr<DynamicPortElement> by_name(const std::shared_ptr<PortElementObject>& element) {
    if (!element || !TypedCalls<Interface>::description()) {
        return nullptr;
    }
    std::shared_ptr<Interface> typed = std::dynamic_pointer_cast<Interface>(element);
    if (!typed) {
        throw UCM_ERROR("a port element does not have its interface");
    }
    return std::make_shared<TypedByName<Interface>>(std::move(typed));
}

/// Do both have the same parameters in the same order, whatever their types are called?
inline bool same_parameters(const Method& one, const Method& other) {
    const std::vector<Parameter>& theirs = other.parameters();
    return one.parameters().size() == theirs.size() &&
           std::equal(theirs.begin(), theirs.end(), one.parameters().begin(), [](const Parameter& a, const Parameter& b) {
               return a.name == b.name && a.direction == b.direction;
           });
}

/// `element` as the target of calls that TypedCalls<Interface> describes; null if it has another interface. lwucm's own interfaces
/// name types that models leave unnamed.
template <class Interface>
std::shared_ptr<DynamicPortElement> callable(const std::shared_ptr<PortElementObject>& element) {
    const auto dynamic = std::dynamic_pointer_cast<DynamicPortElement>(element);
    if (!dynamic) {
        return nullptr;
    }
    const InterfacePtr due = TypedCalls<Interface>::description();
    const std::map<std::string, Method>& theirs = dynamic->get_interface()->methods();
    for (const auto& method : due->methods()) {
        const auto found = theirs.find(method.first);
        if (found == theirs.end() || !same_parameters(method.second, found->second)) {
            return nullptr;
        }
    }
    return dynamic;
}

}  // namespace lwucm

#endif
