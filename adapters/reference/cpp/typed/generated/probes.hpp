#ifndef PROBES_HPP
#define PROBES_HPP

#include "ucm_support.hpp"

namespace core { namespace services { }}
namespace core { namespace messages { }}
namespace core { namespace return_codes { }}
namespace core { namespace component_execution_policies { }}
namespace core { namespace component_execution_policies { namespace execution_policies_api { }}}
namespace core { namespace container_services { }}
namespace core { namespace container_services { namespace clock_service { }}}
namespace core { namespace container_services { namespace clock_service { namespace clock_api { }}}}
namespace core { namespace container_services { namespace trace_service { }}}
namespace core { namespace container_services { namespace trace_service { namespace trace_api { }}}}
namespace core { namespace services { namespace service_interaction_api { }}}
namespace core { namespace messages { namespace message_interaction_api { }}}
namespace core { namespace request_response { }}
namespace core { namespace request_response { namespace request_response_interaction_api { }}}
namespace core { namespace shared_data { }}
namespace core { namespace shared_data { namespace shared_data_interaction_api { }}}
namespace core { namespace timer { }}
namespace core { namespace timer { namespace itt_timer { }}}
namespace core { namespace timer { namespace itt_timer { namespace ucm_itt { }}}}
namespace core { namespace timer { namespace ott_timer { }}}
namespace core { namespace timer { namespace ott_timer { namespace ucm_ott { }}}}
namespace core { namespace execution_policies { }}
namespace core { namespace execution_policies { namespace execution_contracts { }}}
namespace core { namespace standard_properties { }}
namespace lwucm { namespace platform { }}
namespace lwucm { namespace trace_log { }}
namespace lwucm { namespace link_faults { }}
namespace core { }
namespace core { }
namespace core { }
namespace lwucm { }
namespace core { }
namespace parts { }
namespace probe_api { }
namespace probe_ports { }
namespace probe_languages { }
namespace probes { }
namespace core { namespace component_execution_policies { namespace execution_policies_api {
class Abstract_component_execution_intf;
}}}
namespace core { namespace container_services { namespace clock_service { namespace clock_api {
class Abstract_clock_service_intf;
}}}}
namespace core { namespace container_services { namespace trace_service { namespace trace_api {
class Abstract_trace_service_intf;
}}}}
namespace core { namespace shared_data { namespace shared_data_interaction_api {
class Abstract_data_notification;
}}}
namespace core { namespace timer { namespace itt_timer { namespace ucm_itt {
class Abstract_itt_service_intf;
}}}}
namespace core { namespace timer { namespace itt_timer { namespace ucm_itt {
class Abstract_itt_callback_intf;
}}}}
namespace core { namespace timer { namespace ott_timer { namespace ucm_ott {
class Abstract_ott_timer;
}}}}
namespace core { namespace timer { namespace ott_timer { namespace ucm_ott {
class Abstract_ott_handler;
}}}}
namespace core { namespace timer { namespace ott_timer { namespace ucm_ott {
class Abstract_ott_scheduler;
}}}}
namespace lwucm { namespace link_faults {
class Abstract_link_faults_intf;
}}
namespace probe_api {
class Abstract_exchange_intf;
}
namespace core { namespace request_response { namespace request_response_interaction_api {
class Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t;
}}}
namespace core { namespace request_response { namespace request_response_interaction_api {
class Abstract_rrasync_resp_intf_probe_api_payload_t;
}}}
namespace core { namespace request_response { namespace request_response_interaction_api {
class Abstract_rrasync_req_client_intf_probe_api_payload_t;
}}}
namespace core { namespace request_response { namespace request_response_interaction_api {
class Abstract_rrasync_req_server_intf_probe_api_payload_t;
}}}
namespace core { namespace shared_data { namespace shared_data_interaction_api {
class Abstract_data_writer_probe_api_payload_t;
}}}
namespace core { namespace shared_data { namespace shared_data_interaction_api {
class Abstract_data_reader_probe_api_payload_t;
}}}

namespace core { namespace return_codes {

enum comm_ecode : uint8_t {
        ok = 0,
        internal_error = 1,
        comm_error = 2
};

typedef uint8_t comm_ecode_enumerator_t;

}}
namespace core { namespace container_services { namespace clock_service { namespace clock_api {

typedef uint32_t ucm_time_t;

typedef int32_t ucm_usecond_t;

class ucm_timeval_t {
  public:
    ucm_timeval_t() : stored_utv_sec(), stored_utv_usec() {}
    explicit ucm_timeval_t(::core::container_services::clock_service::clock_api::ucm_time_t utv_sec_value, ::core::container_services::clock_service::clock_api::ucm_usecond_t utv_usec_value) : stored_utv_sec(utv_sec_value), stored_utv_usec(utv_usec_value) {}
    ::core::container_services::clock_service::clock_api::ucm_time_t utv_sec() const { return stored_utv_sec; }
    ::core::container_services::clock_service::clock_api::ucm_time_t& utv_sec() { return stored_utv_sec; }
    void utv_sec(::core::container_services::clock_service::clock_api::ucm_time_t value) { stored_utv_sec = value; }
    ::core::container_services::clock_service::clock_api::ucm_usecond_t utv_usec() const { return stored_utv_usec; }
    ::core::container_services::clock_service::clock_api::ucm_usecond_t& utv_usec() { return stored_utv_usec; }
    void utv_usec(::core::container_services::clock_service::clock_api::ucm_usecond_t value) { stored_utv_usec = value; }
    bool operator==(const ucm_timeval_t& other) const { return stored_utv_sec == other.stored_utv_sec && stored_utv_usec == other.stored_utv_usec; }
    bool operator!=(const ucm_timeval_t& other) const { return !(*this == other); }

  private:
    ::core::container_services::clock_service::clock_api::ucm_time_t stored_utv_sec;
    ::core::container_services::clock_service::clock_api::ucm_usecond_t stored_utv_usec;
};

}}}}
namespace core { namespace container_services { namespace trace_service { namespace trace_api {

enum log_severity_t : uint32_t {
        trace = 0,
        debug = 1,
        info = 2,
        warning = 3,
        error = 4,
        critical = 5
};

typedef uint8_t log_severity_enumerator_t;

typedef ::std::wstring log_message_t;

typedef ::std::string method_name_t;

}}}}
namespace core { namespace request_response { namespace request_response_interaction_api {

typedef uint32_t rr_id_t;

}}}
namespace core { namespace timer { namespace itt_timer { namespace ucm_itt {

typedef bool timer_bool_t;

typedef uint32_t timer_number_t;

typedef uint8_t timer_enum_index_t;

enum timeout_enum_t : uint8_t {
        ABSOLUTE_TIME = 0,
        RELATIVE_TIME = 1
};

class timeout_t {
  public:
    timeout_t() : stored_time_val(), stored_flag(::core::timer::itt_timer::ucm_itt::timeout_enum_t::ABSOLUTE_TIME) {}
    explicit timeout_t(::core::container_services::clock_service::clock_api::ucm_time_t time_val_value, ::core::timer::itt_timer::ucm_itt::timeout_enum_t flag_value) : stored_time_val(time_val_value), stored_flag(flag_value) {}
    ::core::container_services::clock_service::clock_api::ucm_time_t time_val() const { return stored_time_val; }
    ::core::container_services::clock_service::clock_api::ucm_time_t& time_val() { return stored_time_val; }
    void time_val(::core::container_services::clock_service::clock_api::ucm_time_t value) { stored_time_val = value; }
    ::core::timer::itt_timer::ucm_itt::timeout_enum_t flag() const { return stored_flag; }
    ::core::timer::itt_timer::ucm_itt::timeout_enum_t& flag() { return stored_flag; }
    void flag(::core::timer::itt_timer::ucm_itt::timeout_enum_t value) { stored_flag = value; }
    bool operator==(const timeout_t& other) const { return stored_time_val == other.stored_time_val && stored_flag == other.stored_flag; }
    bool operator!=(const timeout_t& other) const { return !(*this == other); }

  private:
    ::core::container_services::clock_service::clock_api::ucm_time_t stored_time_val;
    ::core::timer::itt_timer::ucm_itt::timeout_enum_t stored_flag;
};

}}}}
namespace core { namespace timer { namespace ott_timer { namespace ucm_ott {

typedef ::std::string ott_str_id;

typedef uint32_t ott_round_t;

}}}}
namespace core { namespace execution_policies { namespace execution_contracts {

typedef uint8_t priority_t;

}}}
namespace core { namespace standard_properties {

typedef ::std::string property_string_t;

}}
namespace lwucm { namespace trace_log {

class log_record_t {
  public:
    log_record_t() : stored_severity(::core::container_services::trace_service::trace_api::log_severity_t::trace), stored_message() {}
    explicit log_record_t(::core::container_services::trace_service::trace_api::log_severity_t severity_value, const ::core::container_services::trace_service::trace_api::log_message_t& message_value) : stored_severity(severity_value), stored_message(message_value) {}
    ::core::container_services::trace_service::trace_api::log_severity_t severity() const { return stored_severity; }
    ::core::container_services::trace_service::trace_api::log_severity_t& severity() { return stored_severity; }
    void severity(::core::container_services::trace_service::trace_api::log_severity_t value) { stored_severity = value; }
    const ::core::container_services::trace_service::trace_api::log_message_t& message() const { return stored_message; }
    ::core::container_services::trace_service::trace_api::log_message_t& message() { return stored_message; }
    void message(const ::core::container_services::trace_service::trace_api::log_message_t& value) { stored_message = value; }
    void message(::core::container_services::trace_service::trace_api::log_message_t&& value) { stored_message = ::std::move(value); }
    bool operator==(const log_record_t& other) const { return stored_severity == other.stored_severity && stored_message == other.stored_message; }
    bool operator!=(const log_record_t& other) const { return !(*this == other); }

  private:
    ::core::container_services::trace_service::trace_api::log_severity_t stored_severity;
    ::core::container_services::trace_service::trace_api::log_message_t stored_message;
};

typedef ::std::vector< ::lwucm::trace_log::log_record_t > log_records_t;

}}
namespace probe_api {

typedef int32_t payload_t;

typedef ::std::string label_t;

}
namespace core { namespace component_execution_policies { namespace execution_policies_api {

class Abstract_component_execution_intf : public virtual ::ucm::PortElementObject {
  public:
    virtual ~Abstract_component_execution_intf() {}
    virtual void run() = 0;
};

}}}
namespace core { namespace container_services { namespace clock_service { namespace clock_api {

class Abstract_clock_service_intf : public virtual ::ucm::PortElementObject {
  public:
    virtual ~Abstract_clock_service_intf() {}
    virtual void get_local_time(::core::container_services::clock_service::clock_api::ucm_timeval_t& local_time) = 0;
    virtual void get_synchronized_time(::core::container_services::clock_service::clock_api::ucm_timeval_t& synchronized_time) = 0;
};

}}}}
namespace core { namespace container_services { namespace trace_service { namespace trace_api {

class Abstract_trace_service_intf : public virtual ::ucm::PortElementObject {
  public:
    virtual ~Abstract_trace_service_intf() {}
    virtual void log(::core::container_services::trace_service::trace_api::log_severity_t severity, const ::core::container_services::trace_service::trace_api::log_message_t& message) = 0;
};

}}}}
namespace core { namespace shared_data { namespace shared_data_interaction_api {

class Abstract_data_notification : public virtual ::ucm::PortElementObject {
  public:
    virtual ~Abstract_data_notification() {}
    virtual void on_data_update() = 0;
};

}}}
namespace core { namespace timer { namespace itt_timer { namespace ucm_itt {

class Abstract_itt_service_intf : public virtual ::ucm::PortElementObject {
  public:
    virtual ~Abstract_itt_service_intf() {}
    virtual void start_sporadic_scheduler(::core::timer::itt_timer::ucm_itt::timer_number_t timer_number, const ::core::timer::itt_timer::ucm_itt::timeout_t& time) = 0;
    virtual void start_periodic_scheduler(::core::timer::itt_timer::ucm_itt::timer_number_t timer_number, const ::core::timer::itt_timer::ucm_itt::timeout_t& delay_time, const ::core::timer::itt_timer::ucm_itt::timeout_t& rate) = 0;
    virtual ::core::timer::itt_timer::ucm_itt::timer_bool_t is_canceled(::core::timer::itt_timer::ucm_itt::timer_number_t timer_number) = 0;
    virtual void cancel_timer(::core::timer::itt_timer::ucm_itt::timer_number_t timer_number) = 0;
};

class Abstract_itt_callback_intf : public virtual ::ucm::PortElementObject {
  public:
    virtual ~Abstract_itt_callback_intf() {}
    virtual void on_timeout(const ::core::timer::itt_timer::ucm_itt::timeout_t& time, ::core::timer::itt_timer::ucm_itt::timer_number_t timer_number) = 0;
};

}}}}
namespace core { namespace timer { namespace ott_timer { namespace ucm_ott {

class Abstract_ott_timer {
  public:
    virtual ~Abstract_ott_timer() {}
    virtual ::core::timer::ott_timer::ucm_ott::ott_str_id id() = 0;
    virtual ::core::timer::ott_timer::ucm_ott::ott_round_t rounds() = 0;
    virtual ::core::timer::itt_timer::ucm_itt::timer_bool_t is_cancelled() = 0;
    virtual void cancel() = 0;
};

class Abstract_ott_handler {
  public:
    virtual ~Abstract_ott_handler() {}
    virtual void on_trigger(::std::shared_ptr< ::core::timer::ott_timer::ucm_ott::Abstract_ott_timer > timer, const ::core::container_services::clock_service::clock_api::ucm_timeval_t& delta_time, ::core::timer::ott_timer::ucm_ott::ott_round_t round) = 0;
};

class Abstract_ott_scheduler : public virtual ::ucm::PortElementObject {
  public:
    virtual ~Abstract_ott_scheduler() {}
    virtual ::std::shared_ptr< ::core::timer::ott_timer::ucm_ott::Abstract_ott_timer > schedule_repeated_trigger(::std::shared_ptr< ::core::timer::ott_timer::ucm_ott::Abstract_ott_handler > trigger_handler, const ::core::container_services::clock_service::clock_api::ucm_timeval_t& start_delay, const ::core::container_services::clock_service::clock_api::ucm_timeval_t& interval, ::core::timer::ott_timer::ucm_ott::ott_round_t max_rounds) = 0;
    virtual ::std::shared_ptr< ::core::timer::ott_timer::ucm_ott::Abstract_ott_timer > scheduler_trigger(::std::shared_ptr< ::core::timer::ott_timer::ucm_ott::Abstract_ott_handler > trigger_handler, const ::core::container_services::clock_service::clock_api::ucm_timeval_t& trigger_delay) = 0;
};

}}}}
namespace lwucm { namespace link_faults {

class Abstract_link_faults_intf {
  public:
    virtual ~Abstract_link_faults_intf() {}
    virtual void break_transport() = 0;
    virtual void break_connector() = 0;
    virtual void mend() = 0;
};

}}
namespace probe_api {

class Abstract_exchange_intf : public virtual ::ucm::PortElementObject {
  public:
    virtual ~Abstract_exchange_intf() {}
    virtual ::probe_api::payload_t exchange(::probe_api::payload_t value) = 0;
};

}
namespace core { namespace request_response { namespace request_response_interaction_api {

class Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t : public virtual ::ucm::PortElementObject {
  public:
    virtual ~Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t() {}
    virtual ::core::return_codes::comm_ecode request(::probe_api::payload_t request, ::probe_api::payload_t& response) = 0;
};

class Abstract_rrasync_resp_intf_probe_api_payload_t : public virtual ::ucm::PortElementObject {
  public:
    virtual ~Abstract_rrasync_resp_intf_probe_api_payload_t() {}
    virtual ::core::return_codes::comm_ecode response(::probe_api::payload_t response, ::core::request_response::request_response_interaction_api::rr_id_t resp_id) = 0;
};

class Abstract_rrasync_req_client_intf_probe_api_payload_t : public virtual ::ucm::PortElementObject {
  public:
    virtual ~Abstract_rrasync_req_client_intf_probe_api_payload_t() {}
    virtual ::core::return_codes::comm_ecode request(::probe_api::payload_t request, ::core::request_response::request_response_interaction_api::rr_id_t& req_id) = 0;
};

class Abstract_rrasync_req_server_intf_probe_api_payload_t : public virtual ::ucm::PortElementObject {
  public:
    virtual ~Abstract_rrasync_req_server_intf_probe_api_payload_t() {}
    virtual ::core::return_codes::comm_ecode request(::probe_api::payload_t request, ::core::request_response::request_response_interaction_api::rr_id_t req_id) = 0;
};

}}}
namespace core { namespace shared_data { namespace shared_data_interaction_api {

class Abstract_data_writer_probe_api_payload_t : public virtual ::ucm::PortElementObject {
  public:
    virtual ~Abstract_data_writer_probe_api_payload_t() {}
    virtual ::core::return_codes::comm_ecode write_data(::probe_api::payload_t data) = 0;
    virtual ::core::return_codes::comm_ecode cancel_data() = 0;
    virtual ::core::return_codes::comm_ecode publish_data() = 0;
};

class Abstract_data_reader_probe_api_payload_t : public virtual ::ucm::PortElementObject {
  public:
    virtual ~Abstract_data_reader_probe_api_payload_t() {}
    virtual ::core::return_codes::comm_ecode read_data(::probe_api::payload_t& data) = 0;
    virtual ::core::return_codes::comm_ecode freeze_data() = 0;
    virtual ::core::return_codes::comm_ecode release_data() = 0;
};

}}}
namespace parts {

typedef ::ucm::PortConnection< ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t > ask_client_p_Connection;
class Abstract_asker_body {
  public:
    virtual ~Abstract_asker_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const ask_client_p_Connection& ask_client_p) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
};

typedef ::ucm::PortConnection< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_client_intf_probe_api_payload_t > ask_client_req_p_Connection;
class Abstract_later_asker_body {
  public:
    virtual ~Abstract_later_asker_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const ask_client_req_p_Connection& ask_client_req_p) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
    virtual ::std::shared_ptr< ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t > get_ask_client_resp_p() = 0;
};

class Abstract_answerer_body {
  public:
    virtual ~Abstract_answerer_body() {}
    virtual void on_init() = 0;
    virtual void on_startup() = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
    virtual ::std::shared_ptr< ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t > get_ask_server_p() = 0;
};

typedef ::ucm::PortConnection< ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t > ask_server_resp_p_Connection;
class Abstract_later_answerer_body {
  public:
    virtual ~Abstract_later_answerer_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const ask_server_resp_p_Connection& ask_server_resp_p) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
    virtual ::std::shared_ptr< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_server_intf_probe_api_payload_t > get_ask_server_req_p() = 0;
};

typedef ::ucm::PortConnection< ::core::shared_data::shared_data_interaction_api::Abstract_data_writer_probe_api_payload_t > set_writer_p_Connection;
class Abstract_setter_body {
  public:
    virtual ~Abstract_setter_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const set_writer_p_Connection& set_writer_p) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
};

typedef ::ucm::PortConnection< ::core::shared_data::shared_data_interaction_api::Abstract_data_reader_probe_api_payload_t > get_reader_p_Connection;
class Abstract_getter_body {
  public:
    virtual ~Abstract_getter_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const get_reader_p_Connection& get_reader_p) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
    virtual ::std::shared_ptr< ::core::shared_data::shared_data_interaction_api::Abstract_data_notification > get_get_notification_p() = 0;
};

typedef ::ucm::PortConnection< ::core::timer::itt_timer::ucm_itt::Abstract_itt_service_intf > itt_timer_timer_service_Connection;
class Abstract_counting_body {
  public:
    virtual ~Abstract_counting_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const itt_timer_timer_service_Connection& itt_timer_timer_service) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_aux_api() = 0;
    virtual ::std::shared_ptr< ::core::timer::itt_timer::ucm_itt::Abstract_itt_callback_intf > get_tp_itt_timer_timer_callback() = 0;
};

typedef ::ucm::PortConnection< ::core::timer::ott_timer::ucm_ott::Abstract_ott_scheduler > ott_timer_timer_scheduler_Connection;
class Abstract_scheduling_body {
  public:
    virtual ~Abstract_scheduling_body() {}
    virtual void on_init() = 0;
    virtual void on_startup(const ott_timer_timer_scheduler_Connection& ott_timer_timer_scheduler) = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_aux_api() = 0;
};

class Abstract_running_body {
  public:
    virtual ~Abstract_running_body() {}
    virtual void on_init() = 0;
    virtual void on_startup() = 0;
    virtual void on_shutdown() = 0;
    virtual void on_remove() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_in_api() = 0;
    virtual ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > get_aux_api() = 0;
    virtual ::std::shared_ptr< ::core::component_execution_policies::execution_policies_api::Abstract_component_execution_intf > get_tp_self_executing_self_execution_api() = 0;
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
