// Variables: what the steps of a scenario bind and later steps use.
#ifndef UCM_CTS_VARIABLES_HPP
#define UCM_CTS_VARIABLES_HPP

#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "ucm_cts/adapter.hpp"

namespace ucm_cts {

/// A name has one value at a time, of one kind.
class Variables {
  public:
    explicit Variables(const ContainerHandle& manager) { containers_["manager"] = manager; }

    void bind_id(const std::string& name, Id id) {
        saw({id});
        bind(ids_, name, id);
    }

    void bind_reference(const std::string& name, const Reference& reference) { bind(references_, name, reference); }
    void bind_container(const std::string& name, const ContainerHandle& container) { bind(containers_, name, container); }
    void bind_link(const std::string& name, const LinkHandle& link) { bind(links_, name, link); }

    /// An id of a component or connection; `unknown` gives one that the framework has not given out.
    bool id(const std::string& name, Id& value) const {
        std::lock_guard<std::mutex> lock(mutex_);
        if (name == "unknown") {
            for (value = INT32_MAX; given_.count(value) != 0;) {
                --value;
            }
            return true;
        }
        return look_up(ids_, name, value);
    }

    /// A reference; `nil` gives the null reference.
    bool reference(const std::string& name, Reference& value) const {
        std::lock_guard<std::mutex> lock(mutex_);
        return name == "nil" || look_up(references_, name, value);
    }

    /// A container; `nil` gives the null container.
    bool container(const std::string& name, ContainerHandle& value) const {
        std::lock_guard<std::mutex> lock(mutex_);
        return name == "nil" || look_up(containers_, name, value);
    }

    /// A connection with a connector.
    bool link(const std::string& name, LinkHandle& value) const {
        std::lock_guard<std::mutex> lock(mutex_);
        return look_up(links_, name, value);
    }

    /// The framework has given these ids out, so that none of them is unknown.
    void saw(const std::vector<Id>& ids) {
        std::lock_guard<std::mutex> lock(mutex_);
        given_.insert(ids.begin(), ids.end());
    }

  private:
    template <class Values, class Value>
    static bool look_up(const Values& values, const std::string& name, Value& value) {
        const auto found = values.find(name);
        if (found == values.end()) {
            return false;
        }
        value = found->second;
        return true;
    }

    template <class Values, class Value>
    void bind(Values& values, const std::string& name, const Value& value) {
        std::lock_guard<std::mutex> lock(mutex_);
        ids_.erase(name);
        references_.erase(name);
        containers_.erase(name);
        links_.erase(name);
        values[name] = value;
    }

    mutable std::mutex mutex_;
    std::unordered_map<std::string, Id> ids_;
    std::unordered_map<std::string, Reference> references_;
    std::unordered_map<std::string, ContainerHandle> containers_;
    std::unordered_map<std::string, LinkHandle> links_;
    std::set<Id> given_;
};

}  // namespace ucm_cts

#endif
