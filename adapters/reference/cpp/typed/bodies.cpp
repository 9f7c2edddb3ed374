// Has lwucm host typed probes wherever the models have a component type for what a scenario declares. Linked into the adapter.
#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "probes.hpp"

namespace reference_cpp {

namespace {

template <class Body>
std::shared_ptr<typename Body::Abstract> make(const Shaped& from) {
    return std::shared_ptr<typename Body::Abstract>(new Body(from));
}

template <class Probe>
void host(const Shaped& from, lwucm::Implementation& implementation) {
    typedef typename Probe::Abstract Abstract;
    std::shared_ptr<Abstract> (*maker)(const Shaped&) = make<Probe>;
    if (from.connectable) {
        maker = from.fragment ? make<ConnectableProbe<FragmentProbe<Probe>>> : make<ConnectableProbe<Probe>>;
    } else if (from.fragment) {
        maker = make<FragmentProbe<Probe>>;
    }
    const auto shared = std::make_shared<const Shaped>(from);
    lwucm::host<Abstract>(implementation, [maker, shared] { return maker(*shared); });
}

/// A component type of the models, and how its probe is hosted.
struct Type {
    lwucm::TypedNames names;
    void (*host)(const Shaped&, lwucm::Implementation&);

    bool fits(const Shaped& one) const {
        return names.provided.size() == one.provided.size() && names.required.size() == one.required.size() &&
               names.attributes.size() >= one.attributes.size();
    }
};

template <class Probe>
Type type() {
    return {lwucm::TypedGlue<typename Probe::Abstract>::names(), host<Probe>};
}

const std::vector<Type>& types() {
    static const std::vector<Type> all = {
        type<Hermit>(), type<Source>(),   type<Sink>(),          type<Relay>(),   type<Junction>(),
        type<Twin>(),   type<Labelled>(), type<LabelledRelay>(), type<Fork>(),    type<LabelledTwin>(),
        type<Merger>(), type<Exchanger>(), type<Triplet>(),      type<Funnel>(),  type<Hub>(),
        type<FanOfThree>(), type<FanOfEight>(), type<Rack>(), type<Inscribed>()};
    return all;
}

/// Which bodies tests ask for: nothing but typed ones, or generic ones as without this file.
bool asked_for(const std::string& bodies) {
    const char* const chosen = std::getenv("UCM_CTS_LWUCM_BODIES");
    return chosen != nullptr && chosen == bodies;
}

/// Interfaces that only a scenario knows are in no model, and neither are the policies by which a component provides or requires
/// port elements.
bool is_modelled(const Shaped& one) {
    static const std::vector<std::string> with_port_elements = {ucm_cts::SELF_EXECUTING, ucm_cts::PERIODIC_SELF_EXECUTING,
                                                                ucm_cts::BACKGROUND, ucm_cts::INDEX_TIMERS,
                                                                ucm_cts::OBJECT_TIMERS, "clock", "component_trace"};
    return one.interfaces.empty() &&
           std::none_of(one.policies.begin(), one.policies.end(), [](const ucm_cts::Policy& policy) {
               return std::count(with_port_elements.begin(), with_port_elements.end(), policy.definition) != 0;
           });
}

void host_where_modelled(const Shaped& one, lwucm::Implementation& implementation) {
    const auto fitting =
        std::find_if(types().begin(), types().end(), [&one](const Type& candidate) { return candidate.fits(one); });
    if (is_modelled(one) && fitting != types().end()) {
        fitting->host(one, implementation);
    } else if (asked_for("typed")) {
        throw std::invalid_argument("no component type of the models has what " + one.name + " has");
    }
}

const bool linked = [] {
    if (!asked_for("generic")) {
        typed_bodies() = host_where_modelled;
    }
    return true;
}();

}  // namespace

}  // namespace reference_cpp
