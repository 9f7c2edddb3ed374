#ifndef PROBES_HPP
#define PROBES_HPP

#include "ucm_support.hpp"

namespace probe_api { }
namespace probe_ports { }
namespace probe_languages { }
namespace probes { }
namespace probe_api {
class Abstract_exchange_intf;
}

namespace probe_api {

typedef int32_t payload_t;

typedef ::std::string label_t;

class Abstract_exchange_intf : public virtual ::ucm::PortElementObject {
  public:
    virtual ~Abstract_exchange_intf() {}
    virtual ::probe_api::payload_t exchange(::probe_api::payload_t value) = 0;
};

}
namespace probes {

class Abstract_hermit_body {
  public:
    virtual ~Abstract_hermit_body() {}
    virtual void on_init() = 0;
    virtual void on_startup() = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
};

typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out_api_Connection;
class Abstract_source_body {
  public:
    virtual ~Abstract_source_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const out_api_Connection& out_api) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
};

class Abstract_sink_body {
  public:
    virtual ~Abstract_sink_body() {}
    virtual void on_init() = 0;
    virtual void on_startup() = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
};

typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out_api_Connection;
class Abstract_relay_body {
  public:
    virtual ~Abstract_relay_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const out_api_Connection& out_api) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
};

typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > left_api_Connection;
typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > right_api_Connection;
class Abstract_junction_body {
  public:
    virtual ~Abstract_junction_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const left_api_Connection& left_api, const right_api_Connection& right_api) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
};

class Abstract_twin_body {
  public:
    virtual ~Abstract_twin_body() {}
    virtual void on_init() = 0;
    virtual void on_startup() = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_aux_api() = 0;
};

class Abstract_labelled_body {
  public:
    virtual ~Abstract_labelled_body() {}
    virtual void on_init() = 0;
    virtual void on_startup() = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::probe_api::label_t label() = 0;
    virtual void label(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t level() = 0;
    virtual void level(const ::probe_api::label_t& value) = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
};

typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out_api_Connection;
class Abstract_labelled_relay_body {
  public:
    virtual ~Abstract_labelled_relay_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const out_api_Connection& out_api) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::probe_api::label_t label() = 0;
    virtual void label(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t level() = 0;
    virtual void level(const ::probe_api::label_t& value) = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
};

typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > left_api_Connection;
typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > right_api_Connection;
class Abstract_fork_body {
  public:
    virtual ~Abstract_fork_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const left_api_Connection& left_api, const right_api_Connection& right_api) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::probe_api::label_t label() = 0;
    virtual void label(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t level() = 0;
    virtual void level(const ::probe_api::label_t& value) = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
};

class Abstract_labelled_twin_body {
  public:
    virtual ~Abstract_labelled_twin_body() {}
    virtual void on_init() = 0;
    virtual void on_startup() = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::probe_api::label_t label() = 0;
    virtual void label(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t level() = 0;
    virtual void level(const ::probe_api::label_t& value) = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_aux_api() = 0;
};

typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out_api_Connection;
class Abstract_merger_body {
  public:
    virtual ~Abstract_merger_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const out_api_Connection& out_api) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::probe_api::label_t label() = 0;
    virtual void label(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t level() = 0;
    virtual void level(const ::probe_api::label_t& value) = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_aux_api() = 0;
};

typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > left_api_Connection;
typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > right_api_Connection;
class Abstract_exchanger_body {
  public:
    virtual ~Abstract_exchanger_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const left_api_Connection& left_api, const right_api_Connection& right_api) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::probe_api::label_t label() = 0;
    virtual void label(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t level() = 0;
    virtual void level(const ::probe_api::label_t& value) = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_aux_api() = 0;
};

class Abstract_triplet_body {
  public:
    virtual ~Abstract_triplet_body() {}
    virtual void on_init() = 0;
    virtual void on_startup() = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::probe_api::label_t label() = 0;
    virtual void label(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t level() = 0;
    virtual void level(const ::probe_api::label_t& value) = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_aux_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_extra_api() = 0;
};

typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out_api_Connection;
class Abstract_funnel_body {
  public:
    virtual ~Abstract_funnel_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const out_api_Connection& out_api) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::probe_api::label_t label() = 0;
    virtual void label(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t level() = 0;
    virtual void level(const ::probe_api::label_t& value) = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_aux_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_extra_api() = 0;
};

typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > left_api_Connection;
typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > right_api_Connection;
class Abstract_hub_body {
  public:
    virtual ~Abstract_hub_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const left_api_Connection& left_api, const right_api_Connection& right_api) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::probe_api::label_t label() = 0;
    virtual void label(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t level() = 0;
    virtual void level(const ::probe_api::label_t& value) = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_aux_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_extra_api() = 0;
};

typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out0_api_Connection;
typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out1_api_Connection;
typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out2_api_Connection;
class Abstract_fan_of_three_body {
  public:
    virtual ~Abstract_fan_of_three_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const out0_api_Connection& out0_api, const out1_api_Connection& out1_api, const out2_api_Connection& out2_api) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
};

typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out0_api_Connection;
typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out1_api_Connection;
typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out2_api_Connection;
typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out3_api_Connection;
typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out4_api_Connection;
typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out5_api_Connection;
typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out6_api_Connection;
typedef ::ucm::PortConnection< ::probe_api::Abstract_exchange_intf > out7_api_Connection;
class Abstract_fan_of_eight_body {
  public:
    virtual ~Abstract_fan_of_eight_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const out0_api_Connection& out0_api, const out1_api_Connection& out1_api, const out2_api_Connection& out2_api, const out3_api_Connection& out3_api, const out4_api_Connection& out4_api, const out5_api_Connection& out5_api, const out6_api_Connection& out6_api, const out7_api_Connection& out7_api) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
};

class Abstract_rack_body {
  public:
    virtual ~Abstract_rack_body() {}
    virtual void on_init() = 0;
    virtual void on_startup() = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in0_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in1_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in2_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in3_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in4_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in5_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in6_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in7_api() = 0;
};

class Abstract_inscribed_body {
  public:
    virtual ~Abstract_inscribed_body() {}
    virtual void on_init() = 0;
    virtual void on_startup() = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::probe_api::label_t a0() = 0;
    virtual void a0(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t a1() = 0;
    virtual void a1(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t a2() = 0;
    virtual void a2(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t a3() = 0;
    virtual void a3(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t a4() = 0;
    virtual void a4(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t a5() = 0;
    virtual void a5(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t a6() = 0;
    virtual void a6(const ::probe_api::label_t& value) = 0;
    virtual ::probe_api::label_t a7() = 0;
    virtual void a7(const ::probe_api::label_t& value) = 0;
};

}

#endif
