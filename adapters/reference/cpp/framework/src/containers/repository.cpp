#include "lwucm/repository.hpp"

#include <set>
#include <utility>

#include "lwucm/errors.hpp"

namespace lwucm {

void Repository::add(Implementation implementation) {
    std::set<std::string> names(implementation.provided.begin(), implementation.provided.end());
    names.insert(implementation.required.begin(), implementation.required.end());
    if (names.size() != implementation.provided.size() + implementation.required.size()) {
        throw BAD_PARAMETER("implementation " + implementation.name + " declares a port element twice");
    }
    std::shared_ptr<const Implementation>& slot = implementations_[implementation.name];
    if (slot) {
        throw BAD_PARAMETER("implementation " + implementation.name + " is already registered");
    }
    slot = std::make_shared<const Implementation>(std::move(implementation));
}

std::shared_ptr<const Implementation> Repository::find(const std::string& name) const {
    const auto found = implementations_.find(name);
    return found == implementations_.end() ? nullptr : found->second;
}

}  // namespace lwucm
