// Has lwucm host typed probes wherever the models have a component type for what a scenario declares. Linked into the adapter.
#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "../values.hpp"
#include "parts.hpp"
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

/// The policies by which a component provides or requires port elements. Those of one kind ask the same of a body.
const std::string& kind_of(const std::string& definition) {
    static const std::string self_executing = "self-executing";
    static const std::string none;
    static const std::vector<std::string> others = {ucm_cts::INDEX_TIMERS, ucm_cts::OBJECT_TIMERS, "clock",
                                                    "component_trace"};
    if (ucm_cts::is_self_executing(definition)) {
        return self_executing;
    }
    const auto found = std::find(others.begin(), others.end(), definition);
    return found != others.end() ? *found : none;
}

std::vector<std::string> kinds_of(const Shaped& one) {
    std::vector<std::string> kinds;
    for (const ucm_cts::Policy& policy : one.policies) {
        if (!kind_of(policy.definition).empty()) {
            kinds.push_back(kind_of(policy.definition));
        }
    }
    return kinds;
}

/// Does each port element have the interface of the models: the one that the scenario gives to it, or else that of all probes?
bool fit(const lwucm::Implementation::Names& ports, const std::vector<lwucm::InterfacePtr>& modelled, const Shaped& one) {
    const lwucm::InterfacePtr exchange = lwucm::TypedCalls<Exchange>::description();
    for (std::size_t n = 0; n < ports.size(); ++n) {
        const auto known = one.interfaces.find(ports[n]);
        const lwucm::InterfacePtr wanted = known == one.interfaces.end() ? exchange : lwucm_interface(*known->second);
        if (!modelled[n] || !lwucm::same_interface(*wanted, *modelled[n])) {
            return false;
        }
    }
    return true;
}

/// A component type of the models, and how its probe is hosted.
struct Type {
    lwucm::TypedNames names;
    lwucm::TypedInterfaces interfaces;
    std::vector<std::string> kinds;
    void (*host)(const Shaped&, lwucm::Implementation&);

    bool fits(const Shaped& one) const {
        return names.provided.size() == one.provided.size() && names.required.size() == one.required.size() &&
               names.attributes.size() >= one.attributes.size() && kinds_of(one) == kinds &&
               fit(one.provided, interfaces.provided, one) && fit(one.required, interfaces.required, one);
    }
};

/// `kind` is that of the policy that the probe has, if it has one.
template <class Probe>
Type type(const std::string& kind = "") {
    typedef lwucm::TypedGlue<typename Probe::Abstract> Glue;
    const std::vector<std::string> kinds(kind.empty() ? 0 : 1, kind);
    return {Glue::names(), Glue::interfaces(), kinds, host<Probe>};
}

const std::vector<Type>& types() {
    static const std::vector<Type> all = {
        type<Hermit>(), type<Source>(),   type<Sink>(),          type<Relay>(),   type<Junction>(),
        type<Twin>(),   type<Labelled>(), type<LabelledRelay>(), type<Fork>(),    type<LabelledTwin>(),
        type<Merger>(), type<Exchanger>(), type<Triplet>(),      type<Funnel>(),  type<Hub>(),
        type<FanOfThree>(), type<FanOfEight>(), type<Rack>(), type<Inscribed>(),
        type<Asker>(), type<LaterAsker>(), type<Answerer>(), type<LaterAnswerer>(), type<Setter>(), type<Getter>(),
        type<Counting>(ucm_cts::INDEX_TIMERS), type<Scheduling>(ucm_cts::OBJECT_TIMERS),
        type<Running>("self-executing")};
    return all;
}

/// Which bodies tests ask for: nothing but typed ones, or generic ones as without this file.
bool asked_for(const std::string& bodies) {
    const char* const chosen = std::getenv("UCM_CTS_LWUCM_BODIES");
    return chosen != nullptr && chosen == bodies;
}

void host_where_modelled(const Shaped& one, lwucm::Implementation& implementation) {
    const auto fitting =
        std::find_if(types().begin(), types().end(), [&one](const Type& candidate) { return candidate.fits(one); });
    if (fitting != types().end()) {
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
