#include "lwucm/interfaces.hpp"

#include <algorithm>

namespace lwucm {

namespace {

bool same_types(const std::vector<TypePtr>& one, const std::vector<TypePtr>& other) {
    return one.size() == other.size() && std::equal(one.begin(), one.end(), other.begin(), same_type);
}

bool same_method(const Method& one, const Method& other) {
    return one.name() == other.name() && one.parameters().size() == other.parameters().size() &&
           std::equal(one.parameters().begin(), one.parameters().end(), other.parameters().begin(),
                      [](const Parameter& left, const Parameter& right) {
                          return left.name == right.name && left.direction == right.direction &&
                                 same_type(left.type, right.type);
                      }) &&
           same_types(one.raises(), other.raises());
}

}  // namespace

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
    if (!added.second && !same_method(added.first->second, method)) {
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

bool same_interface(const Interface& one, const Interface& other) {
    return one.methods().size() == other.methods().size() &&
           std::equal(one.methods().begin(), one.methods().end(), other.methods().begin(),
                      [](const std::pair<const std::string, Method>& left,
                         const std::pair<const std::string, Method>& right) {
                          return same_method(left.second, right.second);
                      });
}

}  // namespace lwucm
