// The probes as typed bodies (13.9): written against the abstract classes that are generated from the probe models, as a
// developer of components writes them. What they do in there is up to the SDK's probe.
#ifndef REFERENCE_CPP_TYPED_PROBES_HPP
#define REFERENCE_CPP_TYPED_PROBES_HPP

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../hosting.hpp"

namespace reference_cpp {

typedef ucm_cts::ShapedImplementation<Lwucm> Shaped;
typedef ::probe_api::Abstract_exchange_intf Exchange;
typedef std::shared_ptr<Exchange> ExchangePointer;

/// What a typed body was given, for the SDK. References of interfaces other than the probes' are called by name.
template <class Interface>
struct Given {
    static ucm_cts::Reference wrap(const std::shared_ptr<Interface>& typed) {
        return ucm_cts::ShapedReference<Lwucm>::wrap(lwucm::by_name<Interface>(typed));
    }
};

template <>
struct Given<Exchange> {
    static ucm_cts::Reference wrap(const ExchangePointer& typed) {
        return ucm_cts::ShapedReference<Lwucm>::wrap(typed);
    }
};

/// The SDK's probe in a typed body. Its port elements and attributes have the names that the scenario gives them.
class Core {
  public:
    explicit Core(const Shaped& from) : body(from.create_body()), attributes_(from.attributes) {
        for (const std::string& port : from.provided) {
            const ucm_cts::Reference own = body->get_portElement(port);
            const auto interface = from.interfaces.find(port);
            if (interface != from.interfaces.end()) {
                elements_.push_back(Lwucm::typed(own, interface->second));
            } else {
                elements_.push_back(std::make_shared<ucm_cts::ShapedPort<Lwucm>>(own));
            }
        }
    }

    template <class... Interfaces>
    void start(const ::ucm::PortConnection<Interfaces>&... connections) {
        body->on_startup({ucm_cts::PortConnection{connections.port_name, {Given<Interfaces>::wrap(connections.ref)}}...});
    }

    void configure(std::size_t n, const std::string& value) { body->set_attribute(attributes_.at(n), value); }

    /// The port element in the interface that the model gives to it.
    ExchangePointer element(std::size_t n) const { return std::dynamic_pointer_cast<Exchange>(elements_.at(n)); }

    /// The same of one that links call.
    template <class Interface>
    std::shared_ptr<Interface> called_by_links(std::size_t n) const {
        return lwucm::TypedReference<Interface>::to(elements_.at(n));
    }

    const std::shared_ptr<ucm_cts::Body> body;

  private:
    const std::vector<std::string> attributes_;
    std::vector<std::shared_ptr<lwucm::PortElementObject>> elements_;
};

/// What all typed probes have in common.
template <class Implemented>
class TypedProbe : public Implemented {
  public:
    typedef Implemented Abstract;

    explicit TypedProbe(const Shaped& from) : core(from) {}

    void on_init() override { core.body->on_init(); }
    void on_shutdown() override { core.body->on_shutdown(); }
    void on_remove() override { core.body->on_remove(); }

  protected:
    Core core;
};

/// What all probes with attributes have in common.
template <class Implemented>
class LabelledProbe : public TypedProbe<Implemented> {
  public:
    using TypedProbe<Implemented>::TypedProbe;

    ::probe_api::label_t label() override { return label_; }
    ::probe_api::label_t level() override { return level_; }

    void label(const ::probe_api::label_t& value) override {
        label_ = value;
        this->core.configure(0, value);
    }

    void level(const ::probe_api::label_t& value) override {
        level_ = value;
        this->core.configure(1, value);
    }

  private:
    ::probe_api::label_t label_;
    ::probe_api::label_t level_;
};

/// A probe with eight attributes.
template <class Implemented>
class InscribedProbe : public TypedProbe<Implemented> {
  public:
    using TypedProbe<Implemented>::TypedProbe;

    ::probe_api::label_t a0() override { return values_[0]; }
    ::probe_api::label_t a1() override { return values_[1]; }
    ::probe_api::label_t a2() override { return values_[2]; }
    ::probe_api::label_t a3() override { return values_[3]; }
    ::probe_api::label_t a4() override { return values_[4]; }
    ::probe_api::label_t a5() override { return values_[5]; }
    ::probe_api::label_t a6() override { return values_[6]; }
    ::probe_api::label_t a7() override { return values_[7]; }

    void a0(const ::probe_api::label_t& value) override { set(0, value); }
    void a1(const ::probe_api::label_t& value) override { set(1, value); }
    void a2(const ::probe_api::label_t& value) override { set(2, value); }
    void a3(const ::probe_api::label_t& value) override { set(3, value); }
    void a4(const ::probe_api::label_t& value) override { set(4, value); }
    void a5(const ::probe_api::label_t& value) override { set(5, value); }
    void a6(const ::probe_api::label_t& value) override { set(6, value); }
    void a7(const ::probe_api::label_t& value) override { set(7, value); }

  private:
    void set(std::size_t number, const ::probe_api::label_t& value) {
        values_[number] = value;
        this->core.configure(number, value);
    }

    ::probe_api::label_t values_[8];
};

/// A probe that requires no port element.
template <class Probe>
class RequiresNothing : public Probe {
  public:
    using Probe::Probe;
    void on_startup() override { this->core.start(); }
};

/// A probe that requires `out`.
template <class Probe>
class RequiresOne : public Probe {
  public:
    using Probe::Probe;
    void on_startup(const ::probes::out_api_Connection& out_api) override { this->core.start(out_api); }
};

/// A probe that requires `left` and `right`.
template <class Probe>
class RequiresTwo : public Probe {
  public:
    using Probe::Probe;
    void on_startup(const ::probes::left_api_Connection& left_api,
                    const ::probes::right_api_Connection& right_api) override {
        this->core.start(left_api, right_api);
    }
};

/// A probe that requires `out0`, `out1`, `out2`.
template <class Probe>
class RequiresThree : public Probe {
  public:
    using Probe::Probe;
    void on_startup(const ::probes::out0_api_Connection& out0_api,
                    const ::probes::out1_api_Connection& out1_api,
                    const ::probes::out2_api_Connection& out2_api) override {
        this->core.start(out0_api, out1_api, out2_api);
    }
};

/// A probe that requires `out0` to `out7`.
template <class Probe>
class RequiresEight : public Probe {
  public:
    using Probe::Probe;
    void on_startup(const ::probes::out0_api_Connection& out0_api,
                    const ::probes::out1_api_Connection& out1_api,
                    const ::probes::out2_api_Connection& out2_api,
                    const ::probes::out3_api_Connection& out3_api,
                    const ::probes::out4_api_Connection& out4_api,
                    const ::probes::out5_api_Connection& out5_api,
                    const ::probes::out6_api_Connection& out6_api,
                    const ::probes::out7_api_Connection& out7_api) override {
        this->core.start(out0_api, out1_api, out2_api, out3_api, out4_api, out5_api, out6_api, out7_api);
    }
};

/// A probe that provides `in`.
template <class Probe>
class ProvidesOne : public Probe {
  public:
    using Probe::Probe;
    ExchangePointer get_in_api() override { return this->core.element(0); }
};

/// A probe that provides `in` and `aux`.
template <class Probe>
class ProvidesTwo : public ProvidesOne<Probe> {
  public:
    using ProvidesOne<Probe>::ProvidesOne;
    ExchangePointer get_aux_api() override { return this->core.element(1); }
};

/// A probe that provides `in`, `aux` and `extra`.
template <class Probe>
class ProvidesThree : public ProvidesTwo<Probe> {
  public:
    using ProvidesTwo<Probe>::ProvidesTwo;
    ExchangePointer get_extra_api() override { return this->core.element(2); }
};

/// A probe that provides `in0` to `in7`.
template <class Probe>
class ProvidesEight : public Probe {
  public:
    using Probe::Probe;
    ExchangePointer get_in0_api() override { return this->core.element(0); }
    ExchangePointer get_in1_api() override { return this->core.element(1); }
    ExchangePointer get_in2_api() override { return this->core.element(2); }
    ExchangePointer get_in3_api() override { return this->core.element(3); }
    ExchangePointer get_in4_api() override { return this->core.element(4); }
    ExchangePointer get_in5_api() override { return this->core.element(5); }
    ExchangePointer get_in6_api() override { return this->core.element(6); }
    ExchangePointer get_in7_api() override { return this->core.element(7); }
};

typedef RequiresNothing<TypedProbe< ::probes::Abstract_hermit_body>> Hermit;
typedef RequiresOne<TypedProbe< ::probes::Abstract_source_body>> Source;
typedef ProvidesOne<RequiresNothing<TypedProbe< ::probes::Abstract_sink_body>>> Sink;
typedef ProvidesOne<RequiresOne<TypedProbe< ::probes::Abstract_relay_body>>> Relay;
typedef RequiresTwo<TypedProbe< ::probes::Abstract_junction_body>> Junction;
typedef ProvidesTwo<RequiresNothing<TypedProbe< ::probes::Abstract_twin_body>>> Twin;
typedef ProvidesOne<RequiresNothing<LabelledProbe< ::probes::Abstract_labelled_body>>> Labelled;
typedef ProvidesOne<RequiresOne<LabelledProbe< ::probes::Abstract_labelled_relay_body>>> LabelledRelay;
typedef ProvidesOne<RequiresTwo<LabelledProbe< ::probes::Abstract_fork_body>>> Fork;
typedef ProvidesTwo<RequiresNothing<LabelledProbe< ::probes::Abstract_labelled_twin_body>>> LabelledTwin;
typedef ProvidesTwo<RequiresOne<LabelledProbe< ::probes::Abstract_merger_body>>> Merger;
typedef ProvidesTwo<RequiresTwo<LabelledProbe< ::probes::Abstract_exchanger_body>>> Exchanger;
typedef ProvidesThree<RequiresNothing<LabelledProbe< ::probes::Abstract_triplet_body>>> Triplet;
typedef ProvidesThree<RequiresOne<LabelledProbe< ::probes::Abstract_funnel_body>>> Funnel;
typedef ProvidesThree<RequiresTwo<LabelledProbe< ::probes::Abstract_hub_body>>> Hub;
typedef ProvidesOne<RequiresThree<TypedProbe< ::probes::Abstract_fan_of_three_body>>> FanOfThree;
typedef ProvidesOne<RequiresEight<TypedProbe< ::probes::Abstract_fan_of_eight_body>>> FanOfEight;
typedef ProvidesEight<RequiresNothing<TypedProbe< ::probes::Abstract_rack_body>>> Rack;
typedef RequiresNothing<InscribedProbe< ::probes::Abstract_inscribed_body>> Inscribed;

/// A probe that is called at each connection (11.2.1.3).
template <class Probe>
class ConnectableProbe final : public Probe, public lwucm::Connectable {
  public:
    using Probe::Probe;

    void on_connect(const std::string& port_name, std::shared_ptr<lwucm::PortElementObject> required) override {
        this->core.body->on_connect(port_name, ucm_cts::ShapedReference<Lwucm>::wrap(required));
    }

    void on_disconnect(const std::string& port_name) override { this->core.body->on_disconnect(port_name); }
};

/// A probe that is a fragment (11.2.1.4).
template <class Probe>
class FragmentProbe : public Probe, public lwucm::FragmentObject {
  public:
    using Probe::Probe;

    void set_container_interface(std::shared_ptr<lwucm::Container> container) override {
        this->core.body->set_container_interface(
            ucm_cts::ShapedContainer<std::shared_ptr<lwucm::Container>>::wrap(container));
    }
};

}  // namespace reference_cpp

#endif
