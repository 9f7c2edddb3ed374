#include "lwucm/interfaces.hpp"

#include <algorithm>

namespace lwucm {

Method::Method(std::string name, std::vector<Parameter> parameters, std::vector<TypePtr> raises)
    : name_(std::move(name)), parameters_(std::move(parameters)), raises_(std::move(raises)) {
    for (const Parameter& parameter : parameters_) {
        if (!parameter.type) {
            throw BAD_PARAMETER("parameter " + parameter.name + " of " + name_ + " has no type");
        }
        if (parameter.direction == Direction::in || parameter.direction == Direction::inout) {
            arguments_.push_back(parameter.type);
        }
        if (parameter.direction != Direction::in) {
            results_.push_back(parameter.type);
        }
    }
    for (const TypePtr& exception : raises_) {
        if (!exception || exception->kind != Type::Kind::structure) {
            throw BAD_PARAMETER(name_ + " raises something that is no structure");
        }
    }
}

Interface::Interface(const std::vector<Method>& own, const std::vector<InterfacePtr>& inherited) {
    for (const InterfacePtr& base : inherited) {
        for (const auto& method : base->methods()) {
            add(method.second);
        }
    }
    for (const Method& method : own) {
        add(method);
    }
}

void Interface::add(const Method& method) {
    const auto added = methods_.emplace(method.name(), method);
    if (!added.second && !(added.first->second == method)) {
        throw BAD_PARAMETER("there are two different methods " + method.name());
    }
}

const Method& Interface::method(const std::string& name) const {
    const auto found = methods_.find(name);
    if (found == methods_.end()) {
        throw BAD_PARAMETER("the interface has no method '" + name + "'");
    }
    return found->second;
}

bool operator==(const Parameter& one, const Parameter& other) {
    return one.name == other.name && one.direction == other.direction && same_type(one.type, other.type);
}

bool operator==(const Method& one, const Method& other) {
    return one.name() == other.name() && one.parameters() == other.parameters() &&
           one.raises().size() == other.raises().size() &&
           std::equal(one.raises().begin(), one.raises().end(), other.raises().begin(), same_type);
}

bool same_interface(const Interface& one, const Interface& other) { return one.methods() == other.methods(); }

}  // namespace lwucm
