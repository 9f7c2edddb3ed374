// What the SDK must know of lwucm, and which bodies lwucm hosts: generic ones, or typed ones if they are linked (13.9).
#ifndef REFERENCE_CPP_HOSTING_HPP
#define REFERENCE_CPP_HOSTING_HPP

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <lwucm/runtime.hpp>
#include <ucm_cts/shaped.hpp>

#include "typed/generated/probes_lwucm.hpp"

namespace reference_cpp {

struct Lwucm {
    typedef lwucm::PortElementObject PortElementObject;
    typedef lwucm::ComponentObject ComponentObject;
    typedef lwucm::FragmentObject FragmentObject;
    typedef lwucm::Connectable Connectable;
    typedef lwucm::Container Container;
    typedef lwucm::Runtime ContainerManager;
    typedef lwucm::component_execution_intf ComponentExecution;
    typedef lwucm::NOT_FOUND NOT_FOUND;
    typedef lwucm::BAD_PARAMETER BAD_PARAMETER;
    typedef lwucm::UCM_ERROR UCM_ERROR;
    typedef probe_api::Abstract_exchange_intf Exchange;

    static std::shared_ptr<ContainerManager> create_runtime(
        const std::vector<ucm_cts::ShapedImplementation<Lwucm>>& implementations);

    static lwucm::Properties configuration(const std::string& implementation, const ucm_cts::Attributes& attributes) {
        return ucm_cts::properties<lwucm::Properties>("implementation", implementation, attributes);
    }

    static std::shared_ptr<PortElementObject> typed(const ucm_cts::Reference& own,
                                                    const ucm_cts::SharedInterface& interface);
    static std::shared_ptr<ucm_cts::TimerScheduler> scheduler(const std::shared_ptr<PortElementObject>& element);
    static ucm_cts::Data call(PortElementObject& element, const std::string& method, const ucm_cts::Data& arguments);
};

/// Has an implementation make typed bodies instead of generic ones.
typedef std::function<void(const ucm_cts::ShapedImplementation<Lwucm>& from, lwucm::Implementation& implementation)>
    TypedBodies;

/// Empty in an executable that is not linked with typed bodies.
TypedBodies& typed_bodies();

}  // namespace reference_cpp

#endif
