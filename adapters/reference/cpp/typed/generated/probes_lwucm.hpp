#ifndef PROBES_LWUCM_HPP
#define PROBES_LWUCM_HPP

#include <lwucm/typed.hpp>

#include "probes.hpp"

namespace lwucm {

template <>
class TypedStandIn< ::probe_api::Abstract_exchange_intf > final : public ::probe_api::Abstract_exchange_intf {
  public:
    TypedStandIn(const ::std::shared_ptr< ::probe_api::Abstract_exchange_intf >& target, const ::std::shared_ptr<Interceptor>& interceptor)
        : target_(target), interceptor_(interceptor) {}
    ::probe_api::payload_t exchange(::probe_api::payload_t value) override {
        ::probe_api::payload_t result = ::probe_api::payload_t();
        this->interceptor_->call("exchange", [&] { result = this->target_->exchange(value); });
        return result;
    }

  private:
    const ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > target_;
    const ::std::shared_ptr<Interceptor> interceptor_;
};

template <>
struct TypedGlue< ::probes::Abstract_hermit_body > {
    typedef ::probes::Abstract_hermit_body Body;

    static TypedNames names() { return {{}, {}, {}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body&, ::std::size_t) { return nullptr; }
    static void on_startup(Body& body, const TypedConnections&) {
        body.on_startup();
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t, const ::std::shared_ptr<PortElementObject>&, const ::std::shared_ptr<Interceptor>&) {
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t, const ::std::shared_ptr<PortElementObject>&, const ::std::shared_ptr<Interceptor>&) {
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_source_body > {
    typedef ::probes::Abstract_source_body Body;

    static TypedNames names() { return {{}, {"out_api"}, {}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body&, ::std::size_t) { return nullptr; }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t, const ::std::shared_ptr<PortElementObject>&, const ::std::shared_ptr<Interceptor>&) {
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_sink_body > {
    typedef ::probes::Abstract_sink_body Body;

    static TypedNames names() { return {{"in_api"}, {}, {}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections&) {
        body.on_startup();
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t, const ::std::shared_ptr<PortElementObject>&, const ::std::shared_ptr<Interceptor>&) {
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_relay_body > {
    typedef ::probes::Abstract_relay_body Body;

    static TypedNames names() { return {{"in_api"}, {"out_api"}, {}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_junction_body > {
    typedef ::probes::Abstract_junction_body Body;

    static TypedNames names() { return {{}, {"left_api", "right_api"}, {}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body&, ::std::size_t) { return nullptr; }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0), connections.required< ::probe_api::Abstract_exchange_intf >(1));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t, const ::std::shared_ptr<PortElementObject>&, const ::std::shared_ptr<Interceptor>&) {
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_twin_body > {
    typedef ::probes::Abstract_twin_body Body;

    static TypedNames names() { return {{"in_api", "aux_api"}, {}, {}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections&) {
        body.on_startup();
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t, const ::std::shared_ptr<PortElementObject>&, const ::std::shared_ptr<Interceptor>&) {
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_labelled_body > {
    typedef ::probes::Abstract_labelled_body Body;

    static TypedNames names() { return {{"in_api"}, {}, {"label", "level"}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections&) {
        body.on_startup();
    }
    static void set_attribute(Body& body, ::std::size_t n, const ::std::string& value) {
        switch (n) {
            case 0: body.label(attribute_value< ::probe_api::label_t >(value)); return;
            case 1: body.level(attribute_value< ::probe_api::label_t >(value)); return;
        }
    }
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t, const ::std::shared_ptr<PortElementObject>&, const ::std::shared_ptr<Interceptor>&) {
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_labelled_relay_body > {
    typedef ::probes::Abstract_labelled_relay_body Body;

    static TypedNames names() { return {{"in_api"}, {"out_api"}, {"label", "level"}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0));
    }
    static void set_attribute(Body& body, ::std::size_t n, const ::std::string& value) {
        switch (n) {
            case 0: body.label(attribute_value< ::probe_api::label_t >(value)); return;
            case 1: body.level(attribute_value< ::probe_api::label_t >(value)); return;
        }
    }
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_fork_body > {
    typedef ::probes::Abstract_fork_body Body;

    static TypedNames names() { return {{"in_api"}, {"left_api", "right_api"}, {"label", "level"}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0), connections.required< ::probe_api::Abstract_exchange_intf >(1));
    }
    static void set_attribute(Body& body, ::std::size_t n, const ::std::string& value) {
        switch (n) {
            case 0: body.label(attribute_value< ::probe_api::label_t >(value)); return;
            case 1: body.level(attribute_value< ::probe_api::label_t >(value)); return;
        }
    }
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_labelled_twin_body > {
    typedef ::probes::Abstract_labelled_twin_body Body;

    static TypedNames names() { return {{"in_api", "aux_api"}, {}, {"label", "level"}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections&) {
        body.on_startup();
    }
    static void set_attribute(Body& body, ::std::size_t n, const ::std::string& value) {
        switch (n) {
            case 0: body.label(attribute_value< ::probe_api::label_t >(value)); return;
            case 1: body.level(attribute_value< ::probe_api::label_t >(value)); return;
        }
    }
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t, const ::std::shared_ptr<PortElementObject>&, const ::std::shared_ptr<Interceptor>&) {
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_merger_body > {
    typedef ::probes::Abstract_merger_body Body;

    static TypedNames names() { return {{"in_api", "aux_api"}, {"out_api"}, {"label", "level"}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0));
    }
    static void set_attribute(Body& body, ::std::size_t n, const ::std::string& value) {
        switch (n) {
            case 0: body.label(attribute_value< ::probe_api::label_t >(value)); return;
            case 1: body.level(attribute_value< ::probe_api::label_t >(value)); return;
        }
    }
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_exchanger_body > {
    typedef ::probes::Abstract_exchanger_body Body;

    static TypedNames names() { return {{"in_api", "aux_api"}, {"left_api", "right_api"}, {"label", "level"}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0), connections.required< ::probe_api::Abstract_exchange_intf >(1));
    }
    static void set_attribute(Body& body, ::std::size_t n, const ::std::string& value) {
        switch (n) {
            case 0: body.label(attribute_value< ::probe_api::label_t >(value)); return;
            case 1: body.level(attribute_value< ::probe_api::label_t >(value)); return;
        }
    }
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_triplet_body > {
    typedef ::probes::Abstract_triplet_body Body;

    static TypedNames names() { return {{"in_api", "aux_api", "extra_api"}, {}, {"label", "level"}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
            case 2: return body.get_extra_api();
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections&) {
        body.on_startup();
    }
    static void set_attribute(Body& body, ::std::size_t n, const ::std::string& value) {
        switch (n) {
            case 0: body.label(attribute_value< ::probe_api::label_t >(value)); return;
            case 1: body.level(attribute_value< ::probe_api::label_t >(value)); return;
        }
    }
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 2: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t, const ::std::shared_ptr<PortElementObject>&, const ::std::shared_ptr<Interceptor>&) {
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_funnel_body > {
    typedef ::probes::Abstract_funnel_body Body;

    static TypedNames names() { return {{"in_api", "aux_api", "extra_api"}, {"out_api"}, {"label", "level"}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
            case 2: return body.get_extra_api();
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0));
    }
    static void set_attribute(Body& body, ::std::size_t n, const ::std::string& value) {
        switch (n) {
            case 0: body.label(attribute_value< ::probe_api::label_t >(value)); return;
            case 1: body.level(attribute_value< ::probe_api::label_t >(value)); return;
        }
    }
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 2: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_hub_body > {
    typedef ::probes::Abstract_hub_body Body;

    static TypedNames names() { return {{"in_api", "aux_api", "extra_api"}, {"left_api", "right_api"}, {"label", "level"}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
            case 2: return body.get_extra_api();
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0), connections.required< ::probe_api::Abstract_exchange_intf >(1));
    }
    static void set_attribute(Body& body, ::std::size_t n, const ::std::string& value) {
        switch (n) {
            case 0: body.label(attribute_value< ::probe_api::label_t >(value)); return;
            case 1: body.level(attribute_value< ::probe_api::label_t >(value)); return;
        }
    }
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 2: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_fan_of_three_body > {
    typedef ::probes::Abstract_fan_of_three_body Body;

    static TypedNames names() { return {{"in_api"}, {"out0_api", "out1_api", "out2_api"}, {}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0), connections.required< ::probe_api::Abstract_exchange_intf >(1), connections.required< ::probe_api::Abstract_exchange_intf >(2));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 2: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_fan_of_eight_body > {
    typedef ::probes::Abstract_fan_of_eight_body Body;

    static TypedNames names() { return {{"in_api"}, {"out0_api", "out1_api", "out2_api", "out3_api", "out4_api", "out5_api", "out6_api", "out7_api"}, {}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0), connections.required< ::probe_api::Abstract_exchange_intf >(1), connections.required< ::probe_api::Abstract_exchange_intf >(2), connections.required< ::probe_api::Abstract_exchange_intf >(3), connections.required< ::probe_api::Abstract_exchange_intf >(4), connections.required< ::probe_api::Abstract_exchange_intf >(5), connections.required< ::probe_api::Abstract_exchange_intf >(6), connections.required< ::probe_api::Abstract_exchange_intf >(7));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 2: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 3: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 4: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 5: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 6: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 7: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_rack_body > {
    typedef ::probes::Abstract_rack_body Body;

    static TypedNames names() { return {{"in0_api", "in1_api", "in2_api", "in3_api", "in4_api", "in5_api", "in6_api", "in7_api"}, {}, {}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in0_api();
            case 1: return body.get_in1_api();
            case 2: return body.get_in2_api();
            case 3: return body.get_in3_api();
            case 4: return body.get_in4_api();
            case 5: return body.get_in5_api();
            case 6: return body.get_in6_api();
            case 7: return body.get_in7_api();
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections&) {
        body.on_startup();
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 2: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 3: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 4: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 5: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 6: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 7: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t, const ::std::shared_ptr<PortElementObject>&, const ::std::shared_ptr<Interceptor>&) {
        return nullptr;
    }
};

template <>
struct TypedGlue< ::probes::Abstract_inscribed_body > {
    typedef ::probes::Abstract_inscribed_body Body;

    static TypedNames names() { return {{}, {}, {"a0", "a1", "a2", "a3", "a4", "a5", "a6", "a7"}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body&, ::std::size_t) { return nullptr; }
    static void on_startup(Body& body, const TypedConnections&) {
        body.on_startup();
    }
    static void set_attribute(Body& body, ::std::size_t n, const ::std::string& value) {
        switch (n) {
            case 0: body.a0(attribute_value< ::probe_api::label_t >(value)); return;
            case 1: body.a1(attribute_value< ::probe_api::label_t >(value)); return;
            case 2: body.a2(attribute_value< ::probe_api::label_t >(value)); return;
            case 3: body.a3(attribute_value< ::probe_api::label_t >(value)); return;
            case 4: body.a4(attribute_value< ::probe_api::label_t >(value)); return;
            case 5: body.a5(attribute_value< ::probe_api::label_t >(value)); return;
            case 6: body.a6(attribute_value< ::probe_api::label_t >(value)); return;
            case 7: body.a7(attribute_value< ::probe_api::label_t >(value)); return;
        }
    }
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t, const ::std::shared_ptr<PortElementObject>&, const ::std::shared_ptr<Interceptor>&) {
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t, const ::std::shared_ptr<PortElementObject>&, const ::std::shared_ptr<Interceptor>&) {
        return nullptr;
    }
};

}

#endif
