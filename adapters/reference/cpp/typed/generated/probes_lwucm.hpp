#ifndef PROBES_LWUCM_HPP
#define PROBES_LWUCM_HPP

#include <lwucm/typed.hpp>

#include "probes.hpp"

namespace lwucm {

template <>
struct TypedValue< ::core::return_codes::comm_ecode > {
    static Value to(::core::return_codes::comm_ecode value) {
        if (value == ::core::return_codes::comm_ecode::ok) { return Value::enumerator("ok"); }
        if (value == ::core::return_codes::comm_ecode::internal_error) { return Value::enumerator("internal_error"); }
        if (value == ::core::return_codes::comm_ecode::comm_error) { return Value::enumerator("comm_error"); }
        throw BAD_PARAMETER("the value is no enumerator");
    }
    static ::core::return_codes::comm_ecode from(const Value& value) {
        const ::std::string& name = value.as_enumerator();
        if (name == "ok") { return ::core::return_codes::comm_ecode::ok; }
        if (name == "internal_error") { return ::core::return_codes::comm_ecode::internal_error; }
        if (name == "comm_error") { return ::core::return_codes::comm_ecode::comm_error; }
        throw BAD_PARAMETER("there is no enumerator '" + name + "'");
    }
};

template <>
struct TypedValue< ::core::timer::itt_timer::ucm_itt::timeout_enum_t > {
    static Value to(::core::timer::itt_timer::ucm_itt::timeout_enum_t value) {
        if (value == ::core::timer::itt_timer::ucm_itt::timeout_enum_t::ABSOLUTE_TIME) { return Value::enumerator("ABSOLUTE_TIME"); }
        if (value == ::core::timer::itt_timer::ucm_itt::timeout_enum_t::RELATIVE_TIME) { return Value::enumerator("RELATIVE_TIME"); }
        throw BAD_PARAMETER("the value is no enumerator");
    }
    static ::core::timer::itt_timer::ucm_itt::timeout_enum_t from(const Value& value) {
        const ::std::string& name = value.as_enumerator();
        if (name == "ABSOLUTE_TIME") { return ::core::timer::itt_timer::ucm_itt::timeout_enum_t::ABSOLUTE_TIME; }
        if (name == "RELATIVE_TIME") { return ::core::timer::itt_timer::ucm_itt::timeout_enum_t::RELATIVE_TIME; }
        throw BAD_PARAMETER("there is no enumerator '" + name + "'");
    }
};

template <>
struct TypedValue< ::core::timer::itt_timer::ucm_itt::timeout_t > {
    static Value to(const ::core::timer::itt_timer::ucm_itt::timeout_t& value) { return Value::list({TypedValue< ::core::container_services::clock_service::clock_api::ucm_time_t >::to(value.time_val()), TypedValue< ::core::timer::itt_timer::ucm_itt::timeout_enum_t >::to(value.flag())}); }
    static ::core::timer::itt_timer::ucm_itt::timeout_t from(const Value& value) {
        const Values& items = expect_values(value.as_list(), 2);
        return ::core::timer::itt_timer::ucm_itt::timeout_t(TypedValue< ::core::container_services::clock_service::clock_api::ucm_time_t >::from(items[0]), TypedValue< ::core::timer::itt_timer::ucm_itt::timeout_enum_t >::from(items[1]));
    }
};

template <>
struct TypedCalls< ::probe_api::Abstract_exchange_intf > {
    static InterfacePtr description() {
        return ::std::make_shared<const Interface>(::std::vector<Method>{Method("exchange", {{"value", Direction::in, integer_type(IntegerKind::LONG)}, {"result", Direction::result, integer_type(IntegerKind::LONG)}}, {})});
    }

    static Values call(::probe_api::Abstract_exchange_intf& target, const ::std::string& method, const Values& arguments) {
        if (method == "exchange") {
            expect_values(arguments, 1);
            const ::probe_api::payload_t a0 = TypedValue< ::probe_api::payload_t >::from(arguments[0]);
            const ::probe_api::payload_t result = target.exchange(a0);
            return {TypedValue< ::probe_api::payload_t >::to(result)};
        }
        throw BAD_PARAMETER("there is no method '" + method + "'");
    }
};

template <>
struct TypedReference< ::probe_api::Abstract_exchange_intf > {
    class Called final : public ::probe_api::Abstract_exchange_intf {
      public:
        explicit Called(::std::shared_ptr<DynamicPortElement> target) : target_(::std::move(target)) {}
        ::probe_api::payload_t exchange(::probe_api::payload_t a0) override {
            const Values results = this->target_->call("exchange", {TypedValue< ::probe_api::payload_t >::to(a0)});
            return TypedValue< ::probe_api::payload_t >::from(results.at(0));
        }

      private:
        const ::std::shared_ptr<DynamicPortElement> target_;
    };

    static ::std::shared_ptr< ::probe_api::Abstract_exchange_intf > to(const ::std::shared_ptr<PortElementObject>& element) {
        const auto target = callable< ::probe_api::Abstract_exchange_intf >(element);
        return target ? ::std::make_shared<Called>(target) : nullptr;
    }
};

template <>
struct TypedCalls< ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t > {
    static InterfacePtr description() {
        return ::std::make_shared<const Interface>(::std::vector<Method>{Method("request", {{"request", Direction::in, integer_type(IntegerKind::LONG)}, {"response", Direction::out, integer_type(IntegerKind::LONG)}, {"ecode", Direction::result, enumeration_type("comm_ecode", IntegerKind::BYTE, {{"ok", 0LL}, {"internal_error", 1LL}, {"comm_error", 2LL}})}}, {})});
    }

    static Values call(::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t& target, const ::std::string& method, const Values& arguments) {
        if (method == "request") {
            expect_values(arguments, 1);
            const ::probe_api::payload_t a0 = TypedValue< ::probe_api::payload_t >::from(arguments[0]);
            ::probe_api::payload_t a1 = ::probe_api::payload_t();
            const ::core::return_codes::comm_ecode result = target.request(a0, a1);
            return {TypedValue< ::probe_api::payload_t >::to(a1), TypedValue< ::core::return_codes::comm_ecode >::to(result)};
        }
        throw BAD_PARAMETER("there is no method '" + method + "'");
    }
};

template <>
struct TypedReference< ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t > {
    class Called final : public ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t {
      public:
        explicit Called(::std::shared_ptr<DynamicPortElement> target) : target_(::std::move(target)) {}
        ::core::return_codes::comm_ecode request(::probe_api::payload_t a0, ::probe_api::payload_t& a1) override {
            const Values results = this->target_->call("request", {TypedValue< ::probe_api::payload_t >::to(a0)});
            a1 = TypedValue< ::probe_api::payload_t >::from(results.at(0));
            return TypedValue< ::core::return_codes::comm_ecode >::from(results.at(1));
        }

      private:
        const ::std::shared_ptr<DynamicPortElement> target_;
    };

    static ::std::shared_ptr< ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t > to(const ::std::shared_ptr<PortElementObject>& element) {
        const auto target = callable< ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t >(element);
        return target ? ::std::make_shared<Called>(target) : nullptr;
    }
};

template <>
struct TypedCalls< ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t > {
    static InterfacePtr description() {
        return ::std::make_shared<const Interface>(::std::vector<Method>{Method("response", {{"response", Direction::in, integer_type(IntegerKind::LONG)}, {"resp_id", Direction::in, integer_type(IntegerKind::ULONG)}, {"ecode", Direction::result, enumeration_type("comm_ecode", IntegerKind::BYTE, {{"ok", 0LL}, {"internal_error", 1LL}, {"comm_error", 2LL}})}}, {})});
    }

    static Values call(::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t& target, const ::std::string& method, const Values& arguments) {
        if (method == "response") {
            expect_values(arguments, 2);
            const ::probe_api::payload_t a0 = TypedValue< ::probe_api::payload_t >::from(arguments[0]);
            const ::core::request_response::request_response_interaction_api::rr_id_t a1 = TypedValue< ::core::request_response::request_response_interaction_api::rr_id_t >::from(arguments[1]);
            const ::core::return_codes::comm_ecode result = target.response(a0, a1);
            return {TypedValue< ::core::return_codes::comm_ecode >::to(result)};
        }
        throw BAD_PARAMETER("there is no method '" + method + "'");
    }
};

template <>
struct TypedReference< ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t > {
    class Called final : public ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t {
      public:
        explicit Called(::std::shared_ptr<DynamicPortElement> target) : target_(::std::move(target)) {}
        ::core::return_codes::comm_ecode response(::probe_api::payload_t a0, ::core::request_response::request_response_interaction_api::rr_id_t a1) override {
            const Values results = this->target_->call("response", {TypedValue< ::probe_api::payload_t >::to(a0), TypedValue< ::core::request_response::request_response_interaction_api::rr_id_t >::to(a1)});
            return TypedValue< ::core::return_codes::comm_ecode >::from(results.at(0));
        }

      private:
        const ::std::shared_ptr<DynamicPortElement> target_;
    };

    static ::std::shared_ptr< ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t > to(const ::std::shared_ptr<PortElementObject>& element) {
        const auto target = callable< ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t >(element);
        return target ? ::std::make_shared<Called>(target) : nullptr;
    }
};

template <>
struct TypedCalls< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_client_intf_probe_api_payload_t > {
    static InterfacePtr description() {
        return ::std::make_shared<const Interface>(::std::vector<Method>{Method("request", {{"request", Direction::in, integer_type(IntegerKind::LONG)}, {"req_id", Direction::out, integer_type(IntegerKind::ULONG)}, {"ecode", Direction::result, enumeration_type("comm_ecode", IntegerKind::BYTE, {{"ok", 0LL}, {"internal_error", 1LL}, {"comm_error", 2LL}})}}, {})});
    }

    static Values call(::core::request_response::request_response_interaction_api::Abstract_rrasync_req_client_intf_probe_api_payload_t& target, const ::std::string& method, const Values& arguments) {
        if (method == "request") {
            expect_values(arguments, 1);
            const ::probe_api::payload_t a0 = TypedValue< ::probe_api::payload_t >::from(arguments[0]);
            ::core::request_response::request_response_interaction_api::rr_id_t a1 = ::core::request_response::request_response_interaction_api::rr_id_t();
            const ::core::return_codes::comm_ecode result = target.request(a0, a1);
            return {TypedValue< ::core::request_response::request_response_interaction_api::rr_id_t >::to(a1), TypedValue< ::core::return_codes::comm_ecode >::to(result)};
        }
        throw BAD_PARAMETER("there is no method '" + method + "'");
    }
};

template <>
struct TypedReference< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_client_intf_probe_api_payload_t > {
    class Called final : public ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_client_intf_probe_api_payload_t {
      public:
        explicit Called(::std::shared_ptr<DynamicPortElement> target) : target_(::std::move(target)) {}
        ::core::return_codes::comm_ecode request(::probe_api::payload_t a0, ::core::request_response::request_response_interaction_api::rr_id_t& a1) override {
            const Values results = this->target_->call("request", {TypedValue< ::probe_api::payload_t >::to(a0)});
            a1 = TypedValue< ::core::request_response::request_response_interaction_api::rr_id_t >::from(results.at(0));
            return TypedValue< ::core::return_codes::comm_ecode >::from(results.at(1));
        }

      private:
        const ::std::shared_ptr<DynamicPortElement> target_;
    };

    static ::std::shared_ptr< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_client_intf_probe_api_payload_t > to(const ::std::shared_ptr<PortElementObject>& element) {
        const auto target = callable< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_client_intf_probe_api_payload_t >(element);
        return target ? ::std::make_shared<Called>(target) : nullptr;
    }
};

template <>
struct TypedCalls< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_server_intf_probe_api_payload_t > {
    static InterfacePtr description() {
        return ::std::make_shared<const Interface>(::std::vector<Method>{Method("request", {{"request", Direction::in, integer_type(IntegerKind::LONG)}, {"req_id", Direction::in, integer_type(IntegerKind::ULONG)}, {"ecode", Direction::result, enumeration_type("comm_ecode", IntegerKind::BYTE, {{"ok", 0LL}, {"internal_error", 1LL}, {"comm_error", 2LL}})}}, {})});
    }

    static Values call(::core::request_response::request_response_interaction_api::Abstract_rrasync_req_server_intf_probe_api_payload_t& target, const ::std::string& method, const Values& arguments) {
        if (method == "request") {
            expect_values(arguments, 2);
            const ::probe_api::payload_t a0 = TypedValue< ::probe_api::payload_t >::from(arguments[0]);
            const ::core::request_response::request_response_interaction_api::rr_id_t a1 = TypedValue< ::core::request_response::request_response_interaction_api::rr_id_t >::from(arguments[1]);
            const ::core::return_codes::comm_ecode result = target.request(a0, a1);
            return {TypedValue< ::core::return_codes::comm_ecode >::to(result)};
        }
        throw BAD_PARAMETER("there is no method '" + method + "'");
    }
};

template <>
struct TypedReference< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_server_intf_probe_api_payload_t > {
    class Called final : public ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_server_intf_probe_api_payload_t {
      public:
        explicit Called(::std::shared_ptr<DynamicPortElement> target) : target_(::std::move(target)) {}
        ::core::return_codes::comm_ecode request(::probe_api::payload_t a0, ::core::request_response::request_response_interaction_api::rr_id_t a1) override {
            const Values results = this->target_->call("request", {TypedValue< ::probe_api::payload_t >::to(a0), TypedValue< ::core::request_response::request_response_interaction_api::rr_id_t >::to(a1)});
            return TypedValue< ::core::return_codes::comm_ecode >::from(results.at(0));
        }

      private:
        const ::std::shared_ptr<DynamicPortElement> target_;
    };

    static ::std::shared_ptr< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_server_intf_probe_api_payload_t > to(const ::std::shared_ptr<PortElementObject>& element) {
        const auto target = callable< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_server_intf_probe_api_payload_t >(element);
        return target ? ::std::make_shared<Called>(target) : nullptr;
    }
};

template <>
struct TypedCalls< ::core::shared_data::shared_data_interaction_api::Abstract_data_writer_probe_api_payload_t > {
    static InterfacePtr description() {
        return ::std::make_shared<const Interface>(::std::vector<Method>{Method("write_data", {{"data", Direction::in, integer_type(IntegerKind::LONG)}, {"ecode", Direction::result, enumeration_type("comm_ecode", IntegerKind::BYTE, {{"ok", 0LL}, {"internal_error", 1LL}, {"comm_error", 2LL}})}}, {}), Method("cancel_data", {{"ecode", Direction::result, enumeration_type("comm_ecode", IntegerKind::BYTE, {{"ok", 0LL}, {"internal_error", 1LL}, {"comm_error", 2LL}})}}, {}), Method("publish_data", {{"ecode", Direction::result, enumeration_type("comm_ecode", IntegerKind::BYTE, {{"ok", 0LL}, {"internal_error", 1LL}, {"comm_error", 2LL}})}}, {})});
    }

    static Values call(::core::shared_data::shared_data_interaction_api::Abstract_data_writer_probe_api_payload_t& target, const ::std::string& method, const Values& arguments) {
        if (method == "write_data") {
            expect_values(arguments, 1);
            const ::probe_api::payload_t a0 = TypedValue< ::probe_api::payload_t >::from(arguments[0]);
            const ::core::return_codes::comm_ecode result = target.write_data(a0);
            return {TypedValue< ::core::return_codes::comm_ecode >::to(result)};
        }
        if (method == "cancel_data") {
            expect_values(arguments, 0);
            const ::core::return_codes::comm_ecode result = target.cancel_data();
            return {TypedValue< ::core::return_codes::comm_ecode >::to(result)};
        }
        if (method == "publish_data") {
            expect_values(arguments, 0);
            const ::core::return_codes::comm_ecode result = target.publish_data();
            return {TypedValue< ::core::return_codes::comm_ecode >::to(result)};
        }
        throw BAD_PARAMETER("there is no method '" + method + "'");
    }
};

template <>
struct TypedReference< ::core::shared_data::shared_data_interaction_api::Abstract_data_writer_probe_api_payload_t > {
    class Called final : public ::core::shared_data::shared_data_interaction_api::Abstract_data_writer_probe_api_payload_t {
      public:
        explicit Called(::std::shared_ptr<DynamicPortElement> target) : target_(::std::move(target)) {}
        ::core::return_codes::comm_ecode write_data(::probe_api::payload_t a0) override {
            const Values results = this->target_->call("write_data", {TypedValue< ::probe_api::payload_t >::to(a0)});
            return TypedValue< ::core::return_codes::comm_ecode >::from(results.at(0));
        }
        ::core::return_codes::comm_ecode cancel_data() override {
            const Values results = this->target_->call("cancel_data", {});
            return TypedValue< ::core::return_codes::comm_ecode >::from(results.at(0));
        }
        ::core::return_codes::comm_ecode publish_data() override {
            const Values results = this->target_->call("publish_data", {});
            return TypedValue< ::core::return_codes::comm_ecode >::from(results.at(0));
        }

      private:
        const ::std::shared_ptr<DynamicPortElement> target_;
    };

    static ::std::shared_ptr< ::core::shared_data::shared_data_interaction_api::Abstract_data_writer_probe_api_payload_t > to(const ::std::shared_ptr<PortElementObject>& element) {
        const auto target = callable< ::core::shared_data::shared_data_interaction_api::Abstract_data_writer_probe_api_payload_t >(element);
        return target ? ::std::make_shared<Called>(target) : nullptr;
    }
};

template <>
struct TypedCalls< ::core::shared_data::shared_data_interaction_api::Abstract_data_notification > {
    static InterfacePtr description() {
        return ::std::make_shared<const Interface>(::std::vector<Method>{Method("on_data_update", {}, {})});
    }

    static Values call(::core::shared_data::shared_data_interaction_api::Abstract_data_notification& target, const ::std::string& method, const Values& arguments) {
        if (method == "on_data_update") {
            expect_values(arguments, 0);
            target.on_data_update();
            return Values();
        }
        throw BAD_PARAMETER("there is no method '" + method + "'");
    }
};

template <>
struct TypedReference< ::core::shared_data::shared_data_interaction_api::Abstract_data_notification > {
    class Called final : public ::core::shared_data::shared_data_interaction_api::Abstract_data_notification {
      public:
        explicit Called(::std::shared_ptr<DynamicPortElement> target) : target_(::std::move(target)) {}
        void on_data_update() override {
            this->target_->call("on_data_update", {});
        }

      private:
        const ::std::shared_ptr<DynamicPortElement> target_;
    };

    static ::std::shared_ptr< ::core::shared_data::shared_data_interaction_api::Abstract_data_notification > to(const ::std::shared_ptr<PortElementObject>& element) {
        const auto target = callable< ::core::shared_data::shared_data_interaction_api::Abstract_data_notification >(element);
        return target ? ::std::make_shared<Called>(target) : nullptr;
    }
};

template <>
struct TypedCalls< ::core::shared_data::shared_data_interaction_api::Abstract_data_reader_probe_api_payload_t > {
    static InterfacePtr description() {
        return ::std::make_shared<const Interface>(::std::vector<Method>{Method("read_data", {{"data", Direction::out, integer_type(IntegerKind::LONG)}, {"ecode", Direction::result, enumeration_type("comm_ecode", IntegerKind::BYTE, {{"ok", 0LL}, {"internal_error", 1LL}, {"comm_error", 2LL}})}}, {}), Method("freeze_data", {{"ecode", Direction::result, enumeration_type("comm_ecode", IntegerKind::BYTE, {{"ok", 0LL}, {"internal_error", 1LL}, {"comm_error", 2LL}})}}, {}), Method("release_data", {{"ecode", Direction::result, enumeration_type("comm_ecode", IntegerKind::BYTE, {{"ok", 0LL}, {"internal_error", 1LL}, {"comm_error", 2LL}})}}, {})});
    }

    static Values call(::core::shared_data::shared_data_interaction_api::Abstract_data_reader_probe_api_payload_t& target, const ::std::string& method, const Values& arguments) {
        if (method == "read_data") {
            expect_values(arguments, 0);
            ::probe_api::payload_t a0 = ::probe_api::payload_t();
            const ::core::return_codes::comm_ecode result = target.read_data(a0);
            return {TypedValue< ::probe_api::payload_t >::to(a0), TypedValue< ::core::return_codes::comm_ecode >::to(result)};
        }
        if (method == "freeze_data") {
            expect_values(arguments, 0);
            const ::core::return_codes::comm_ecode result = target.freeze_data();
            return {TypedValue< ::core::return_codes::comm_ecode >::to(result)};
        }
        if (method == "release_data") {
            expect_values(arguments, 0);
            const ::core::return_codes::comm_ecode result = target.release_data();
            return {TypedValue< ::core::return_codes::comm_ecode >::to(result)};
        }
        throw BAD_PARAMETER("there is no method '" + method + "'");
    }
};

template <>
struct TypedReference< ::core::shared_data::shared_data_interaction_api::Abstract_data_reader_probe_api_payload_t > {
    class Called final : public ::core::shared_data::shared_data_interaction_api::Abstract_data_reader_probe_api_payload_t {
      public:
        explicit Called(::std::shared_ptr<DynamicPortElement> target) : target_(::std::move(target)) {}
        ::core::return_codes::comm_ecode read_data(::probe_api::payload_t& a0) override {
            const Values results = this->target_->call("read_data", {});
            a0 = TypedValue< ::probe_api::payload_t >::from(results.at(0));
            return TypedValue< ::core::return_codes::comm_ecode >::from(results.at(1));
        }
        ::core::return_codes::comm_ecode freeze_data() override {
            const Values results = this->target_->call("freeze_data", {});
            return TypedValue< ::core::return_codes::comm_ecode >::from(results.at(0));
        }
        ::core::return_codes::comm_ecode release_data() override {
            const Values results = this->target_->call("release_data", {});
            return TypedValue< ::core::return_codes::comm_ecode >::from(results.at(0));
        }

      private:
        const ::std::shared_ptr<DynamicPortElement> target_;
    };

    static ::std::shared_ptr< ::core::shared_data::shared_data_interaction_api::Abstract_data_reader_probe_api_payload_t > to(const ::std::shared_ptr<PortElementObject>& element) {
        const auto target = callable< ::core::shared_data::shared_data_interaction_api::Abstract_data_reader_probe_api_payload_t >(element);
        return target ? ::std::make_shared<Called>(target) : nullptr;
    }
};

template <>
struct TypedCalls< ::core::timer::itt_timer::ucm_itt::Abstract_itt_service_intf > {
    static InterfacePtr description() {
        return ::std::make_shared<const Interface>(::std::vector<Method>{Method("start_sporadic_scheduler", {{"timer_number", Direction::in, integer_type(IntegerKind::ULONG)}, {"time", Direction::in, structure_type("timeout_t", {{"time_val", integer_type(IntegerKind::ULONG)}, {"flag", enumeration_type("timeout_enum_t", IntegerKind::BYTE, {{"ABSOLUTE_TIME", 0LL}, {"RELATIVE_TIME", 1LL}})}})}}, {}), Method("start_periodic_scheduler", {{"timer_number", Direction::in, integer_type(IntegerKind::ULONG)}, {"delay_time", Direction::in, structure_type("timeout_t", {{"time_val", integer_type(IntegerKind::ULONG)}, {"flag", enumeration_type("timeout_enum_t", IntegerKind::BYTE, {{"ABSOLUTE_TIME", 0LL}, {"RELATIVE_TIME", 1LL}})}})}, {"rate", Direction::in, structure_type("timeout_t", {{"time_val", integer_type(IntegerKind::ULONG)}, {"flag", enumeration_type("timeout_enum_t", IntegerKind::BYTE, {{"ABSOLUTE_TIME", 0LL}, {"RELATIVE_TIME", 1LL}})}})}}, {}), Method("is_canceled", {{"timer_number", Direction::in, integer_type(IntegerKind::ULONG)}, {"returns", Direction::result, boolean_type()}}, {}), Method("cancel_timer", {{"timer_number", Direction::in, integer_type(IntegerKind::ULONG)}}, {})});
    }

    static Values call(::core::timer::itt_timer::ucm_itt::Abstract_itt_service_intf& target, const ::std::string& method, const Values& arguments) {
        if (method == "start_sporadic_scheduler") {
            expect_values(arguments, 2);
            const ::core::timer::itt_timer::ucm_itt::timer_number_t a0 = TypedValue< ::core::timer::itt_timer::ucm_itt::timer_number_t >::from(arguments[0]);
            const ::core::timer::itt_timer::ucm_itt::timeout_t a1 = TypedValue< ::core::timer::itt_timer::ucm_itt::timeout_t >::from(arguments[1]);
            target.start_sporadic_scheduler(a0, a1);
            return Values();
        }
        if (method == "start_periodic_scheduler") {
            expect_values(arguments, 3);
            const ::core::timer::itt_timer::ucm_itt::timer_number_t a0 = TypedValue< ::core::timer::itt_timer::ucm_itt::timer_number_t >::from(arguments[0]);
            const ::core::timer::itt_timer::ucm_itt::timeout_t a1 = TypedValue< ::core::timer::itt_timer::ucm_itt::timeout_t >::from(arguments[1]);
            const ::core::timer::itt_timer::ucm_itt::timeout_t a2 = TypedValue< ::core::timer::itt_timer::ucm_itt::timeout_t >::from(arguments[2]);
            target.start_periodic_scheduler(a0, a1, a2);
            return Values();
        }
        if (method == "is_canceled") {
            expect_values(arguments, 1);
            const ::core::timer::itt_timer::ucm_itt::timer_number_t a0 = TypedValue< ::core::timer::itt_timer::ucm_itt::timer_number_t >::from(arguments[0]);
            const ::core::timer::itt_timer::ucm_itt::timer_bool_t result = target.is_canceled(a0);
            return {TypedValue< ::core::timer::itt_timer::ucm_itt::timer_bool_t >::to(result)};
        }
        if (method == "cancel_timer") {
            expect_values(arguments, 1);
            const ::core::timer::itt_timer::ucm_itt::timer_number_t a0 = TypedValue< ::core::timer::itt_timer::ucm_itt::timer_number_t >::from(arguments[0]);
            target.cancel_timer(a0);
            return Values();
        }
        throw BAD_PARAMETER("there is no method '" + method + "'");
    }
};

template <>
struct TypedReference< ::core::timer::itt_timer::ucm_itt::Abstract_itt_service_intf > {
    class Called final : public ::core::timer::itt_timer::ucm_itt::Abstract_itt_service_intf {
      public:
        explicit Called(::std::shared_ptr<DynamicPortElement> target) : target_(::std::move(target)) {}
        void start_sporadic_scheduler(::core::timer::itt_timer::ucm_itt::timer_number_t a0, const ::core::timer::itt_timer::ucm_itt::timeout_t& a1) override {
            this->target_->call("start_sporadic_scheduler", {TypedValue< ::core::timer::itt_timer::ucm_itt::timer_number_t >::to(a0), TypedValue< ::core::timer::itt_timer::ucm_itt::timeout_t >::to(a1)});
        }
        void start_periodic_scheduler(::core::timer::itt_timer::ucm_itt::timer_number_t a0, const ::core::timer::itt_timer::ucm_itt::timeout_t& a1, const ::core::timer::itt_timer::ucm_itt::timeout_t& a2) override {
            this->target_->call("start_periodic_scheduler", {TypedValue< ::core::timer::itt_timer::ucm_itt::timer_number_t >::to(a0), TypedValue< ::core::timer::itt_timer::ucm_itt::timeout_t >::to(a1), TypedValue< ::core::timer::itt_timer::ucm_itt::timeout_t >::to(a2)});
        }
        ::core::timer::itt_timer::ucm_itt::timer_bool_t is_canceled(::core::timer::itt_timer::ucm_itt::timer_number_t a0) override {
            const Values results = this->target_->call("is_canceled", {TypedValue< ::core::timer::itt_timer::ucm_itt::timer_number_t >::to(a0)});
            return TypedValue< ::core::timer::itt_timer::ucm_itt::timer_bool_t >::from(results.at(0));
        }
        void cancel_timer(::core::timer::itt_timer::ucm_itt::timer_number_t a0) override {
            this->target_->call("cancel_timer", {TypedValue< ::core::timer::itt_timer::ucm_itt::timer_number_t >::to(a0)});
        }

      private:
        const ::std::shared_ptr<DynamicPortElement> target_;
    };

    static ::std::shared_ptr< ::core::timer::itt_timer::ucm_itt::Abstract_itt_service_intf > to(const ::std::shared_ptr<PortElementObject>& element) {
        const auto target = callable< ::core::timer::itt_timer::ucm_itt::Abstract_itt_service_intf >(element);
        return target ? ::std::make_shared<Called>(target) : nullptr;
    }
};

template <>
struct TypedCalls< ::core::timer::itt_timer::ucm_itt::Abstract_itt_callback_intf > {
    static InterfacePtr description() {
        return ::std::make_shared<const Interface>(::std::vector<Method>{Method("on_timeout", {{"time", Direction::in, structure_type("timeout_t", {{"time_val", integer_type(IntegerKind::ULONG)}, {"flag", enumeration_type("timeout_enum_t", IntegerKind::BYTE, {{"ABSOLUTE_TIME", 0LL}, {"RELATIVE_TIME", 1LL}})}})}, {"timer_number", Direction::in, integer_type(IntegerKind::ULONG)}}, {})});
    }

    static Values call(::core::timer::itt_timer::ucm_itt::Abstract_itt_callback_intf& target, const ::std::string& method, const Values& arguments) {
        if (method == "on_timeout") {
            expect_values(arguments, 2);
            const ::core::timer::itt_timer::ucm_itt::timeout_t a0 = TypedValue< ::core::timer::itt_timer::ucm_itt::timeout_t >::from(arguments[0]);
            const ::core::timer::itt_timer::ucm_itt::timer_number_t a1 = TypedValue< ::core::timer::itt_timer::ucm_itt::timer_number_t >::from(arguments[1]);
            target.on_timeout(a0, a1);
            return Values();
        }
        throw BAD_PARAMETER("there is no method '" + method + "'");
    }
};

template <>
struct TypedReference< ::core::timer::itt_timer::ucm_itt::Abstract_itt_callback_intf > {
    class Called final : public ::core::timer::itt_timer::ucm_itt::Abstract_itt_callback_intf {
      public:
        explicit Called(::std::shared_ptr<DynamicPortElement> target) : target_(::std::move(target)) {}
        void on_timeout(const ::core::timer::itt_timer::ucm_itt::timeout_t& a0, ::core::timer::itt_timer::ucm_itt::timer_number_t a1) override {
            this->target_->call("on_timeout", {TypedValue< ::core::timer::itt_timer::ucm_itt::timeout_t >::to(a0), TypedValue< ::core::timer::itt_timer::ucm_itt::timer_number_t >::to(a1)});
        }

      private:
        const ::std::shared_ptr<DynamicPortElement> target_;
    };

    static ::std::shared_ptr< ::core::timer::itt_timer::ucm_itt::Abstract_itt_callback_intf > to(const ::std::shared_ptr<PortElementObject>& element) {
        const auto target = callable< ::core::timer::itt_timer::ucm_itt::Abstract_itt_callback_intf >(element);
        return target ? ::std::make_shared<Called>(target) : nullptr;
    }
};

template <>
struct TypedCalls< ::core::component_execution_policies::execution_policies_api::Abstract_component_execution_intf > {
    static InterfacePtr description() {
        return ::std::make_shared<const Interface>(::std::vector<Method>{Method("run", {}, {})});
    }

    static Values call(::core::component_execution_policies::execution_policies_api::Abstract_component_execution_intf& target, const ::std::string& method, const Values& arguments) {
        if (method == "run") {
            expect_values(arguments, 0);
            target.run();
            return Values();
        }
        throw BAD_PARAMETER("there is no method '" + method + "'");
    }
};

template <>
struct TypedReference< ::core::component_execution_policies::execution_policies_api::Abstract_component_execution_intf > {
    class Called final : public ::core::component_execution_policies::execution_policies_api::Abstract_component_execution_intf {
      public:
        explicit Called(::std::shared_ptr<DynamicPortElement> target) : target_(::std::move(target)) {}
        void run() override {
            this->target_->call("run", {});
        }

      private:
        const ::std::shared_ptr<DynamicPortElement> target_;
    };

    static ::std::shared_ptr< ::core::component_execution_policies::execution_policies_api::Abstract_component_execution_intf > to(const ::std::shared_ptr<PortElementObject>& element) {
        const auto target = callable< ::core::component_execution_policies::execution_policies_api::Abstract_component_execution_intf >(element);
        return target ? ::std::make_shared<Called>(target) : nullptr;
    }
};

template <>
struct TypedReference< ::core::timer::ott_timer::ucm_ott::Abstract_ott_scheduler > {
    static ::std::shared_ptr< ::core::timer::ott_timer::ucm_ott::Abstract_ott_scheduler > to(const ::std::shared_ptr<PortElementObject>& element) {
        return TypedScheduler< ::core::timer::ott_timer::ucm_ott::Abstract_ott_scheduler, ::core::timer::ott_timer::ucm_ott::Abstract_ott_timer, ::core::timer::ott_timer::ucm_ott::Abstract_ott_handler, ::core::container_services::clock_service::clock_api::ucm_timeval_t >::to(element);
    }
};

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
class TypedStandIn< ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t > final : public ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t {
  public:
    TypedStandIn(const ::std::shared_ptr< ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t >& target, const ::std::shared_ptr<Interceptor>& interceptor)
        : target_(target), interceptor_(interceptor) {}
    ::core::return_codes::comm_ecode request(::probe_api::payload_t request, ::probe_api::payload_t& response) override {
        ::core::return_codes::comm_ecode result = ::core::return_codes::comm_ecode();
        this->interceptor_->call("request", [&] { result = this->target_->request(request, response); });
        return result;
    }

  private:
    const ::std::shared_ptr< ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t > target_;
    const ::std::shared_ptr<Interceptor> interceptor_;
};

template <>
class TypedStandIn< ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t > final : public ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t {
  public:
    TypedStandIn(const ::std::shared_ptr< ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t >& target, const ::std::shared_ptr<Interceptor>& interceptor)
        : target_(target), interceptor_(interceptor) {}
    ::core::return_codes::comm_ecode response(::probe_api::payload_t response, ::core::request_response::request_response_interaction_api::rr_id_t resp_id) override {
        ::core::return_codes::comm_ecode result = ::core::return_codes::comm_ecode();
        this->interceptor_->call("response", [&] { result = this->target_->response(response, resp_id); });
        return result;
    }

  private:
    const ::std::shared_ptr< ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t > target_;
    const ::std::shared_ptr<Interceptor> interceptor_;
};

template <>
class TypedStandIn< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_client_intf_probe_api_payload_t > final : public ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_client_intf_probe_api_payload_t {
  public:
    TypedStandIn(const ::std::shared_ptr< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_client_intf_probe_api_payload_t >& target, const ::std::shared_ptr<Interceptor>& interceptor)
        : target_(target), interceptor_(interceptor) {}
    ::core::return_codes::comm_ecode request(::probe_api::payload_t request, ::core::request_response::request_response_interaction_api::rr_id_t& req_id) override {
        ::core::return_codes::comm_ecode result = ::core::return_codes::comm_ecode();
        this->interceptor_->call("request", [&] { result = this->target_->request(request, req_id); });
        return result;
    }

  private:
    const ::std::shared_ptr< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_client_intf_probe_api_payload_t > target_;
    const ::std::shared_ptr<Interceptor> interceptor_;
};

template <>
class TypedStandIn< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_server_intf_probe_api_payload_t > final : public ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_server_intf_probe_api_payload_t {
  public:
    TypedStandIn(const ::std::shared_ptr< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_server_intf_probe_api_payload_t >& target, const ::std::shared_ptr<Interceptor>& interceptor)
        : target_(target), interceptor_(interceptor) {}
    ::core::return_codes::comm_ecode request(::probe_api::payload_t request, ::core::request_response::request_response_interaction_api::rr_id_t req_id) override {
        ::core::return_codes::comm_ecode result = ::core::return_codes::comm_ecode();
        this->interceptor_->call("request", [&] { result = this->target_->request(request, req_id); });
        return result;
    }

  private:
    const ::std::shared_ptr< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_server_intf_probe_api_payload_t > target_;
    const ::std::shared_ptr<Interceptor> interceptor_;
};

template <>
class TypedStandIn< ::core::shared_data::shared_data_interaction_api::Abstract_data_writer_probe_api_payload_t > final : public ::core::shared_data::shared_data_interaction_api::Abstract_data_writer_probe_api_payload_t {
  public:
    TypedStandIn(const ::std::shared_ptr< ::core::shared_data::shared_data_interaction_api::Abstract_data_writer_probe_api_payload_t >& target, const ::std::shared_ptr<Interceptor>& interceptor)
        : target_(target), interceptor_(interceptor) {}
    ::core::return_codes::comm_ecode write_data(::probe_api::payload_t data) override {
        ::core::return_codes::comm_ecode result = ::core::return_codes::comm_ecode();
        this->interceptor_->call("write_data", [&] { result = this->target_->write_data(data); });
        return result;
    }
    ::core::return_codes::comm_ecode cancel_data() override {
        ::core::return_codes::comm_ecode result = ::core::return_codes::comm_ecode();
        this->interceptor_->call("cancel_data", [&] { result = this->target_->cancel_data(); });
        return result;
    }
    ::core::return_codes::comm_ecode publish_data() override {
        ::core::return_codes::comm_ecode result = ::core::return_codes::comm_ecode();
        this->interceptor_->call("publish_data", [&] { result = this->target_->publish_data(); });
        return result;
    }

  private:
    const ::std::shared_ptr< ::core::shared_data::shared_data_interaction_api::Abstract_data_writer_probe_api_payload_t > target_;
    const ::std::shared_ptr<Interceptor> interceptor_;
};

template <>
class TypedStandIn< ::core::shared_data::shared_data_interaction_api::Abstract_data_notification > final : public ::core::shared_data::shared_data_interaction_api::Abstract_data_notification {
  public:
    TypedStandIn(const ::std::shared_ptr< ::core::shared_data::shared_data_interaction_api::Abstract_data_notification >& target, const ::std::shared_ptr<Interceptor>& interceptor)
        : target_(target), interceptor_(interceptor) {}
    void on_data_update() override {
        this->interceptor_->call("on_data_update", [&] { this->target_->on_data_update(); });
    }

  private:
    const ::std::shared_ptr< ::core::shared_data::shared_data_interaction_api::Abstract_data_notification > target_;
    const ::std::shared_ptr<Interceptor> interceptor_;
};

template <>
class TypedStandIn< ::core::shared_data::shared_data_interaction_api::Abstract_data_reader_probe_api_payload_t > final : public ::core::shared_data::shared_data_interaction_api::Abstract_data_reader_probe_api_payload_t {
  public:
    TypedStandIn(const ::std::shared_ptr< ::core::shared_data::shared_data_interaction_api::Abstract_data_reader_probe_api_payload_t >& target, const ::std::shared_ptr<Interceptor>& interceptor)
        : target_(target), interceptor_(interceptor) {}
    ::core::return_codes::comm_ecode read_data(::probe_api::payload_t& data) override {
        ::core::return_codes::comm_ecode result = ::core::return_codes::comm_ecode();
        this->interceptor_->call("read_data", [&] { result = this->target_->read_data(data); });
        return result;
    }
    ::core::return_codes::comm_ecode freeze_data() override {
        ::core::return_codes::comm_ecode result = ::core::return_codes::comm_ecode();
        this->interceptor_->call("freeze_data", [&] { result = this->target_->freeze_data(); });
        return result;
    }
    ::core::return_codes::comm_ecode release_data() override {
        ::core::return_codes::comm_ecode result = ::core::return_codes::comm_ecode();
        this->interceptor_->call("release_data", [&] { result = this->target_->release_data(); });
        return result;
    }

  private:
    const ::std::shared_ptr< ::core::shared_data::shared_data_interaction_api::Abstract_data_reader_probe_api_payload_t > target_;
    const ::std::shared_ptr<Interceptor> interceptor_;
};

template <>
struct TypedGlue< ::parts::Abstract_asker_body > {
    typedef ::parts::Abstract_asker_body Body;

    static TypedNames names() { return {{"in_api"}, {"ask_client_p"}, {}, {}}; }
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {TypedCalls< ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t >(0));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::parts::Abstract_later_asker_body > {
    typedef ::parts::Abstract_later_asker_body Body;

    static TypedNames names() { return {{"in_api", "ask_client_resp_p"}, {"ask_client_req_p"}, {}, {}}; }
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t >::description()}, {TypedCalls< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_client_intf_probe_api_payload_t >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_ask_client_resp_p();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 1: return lwucm::by_name< ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t >(element);
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_client_intf_probe_api_payload_t >(0));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_client_intf_probe_api_payload_t >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::parts::Abstract_answerer_body > {
    typedef ::parts::Abstract_answerer_body Body;

    static TypedNames names() { return {{"in_api", "ask_server_p"}, {}, {}, {}}; }
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t >::description()}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_ask_server_p();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 1: return lwucm::by_name< ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t >(element);
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections&) {
        body.on_startup();
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::core::request_response::request_response_interaction_api::Abstract_rrsync_intf_probe_api_payload_t_probe_api_payload_t >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t, const ::std::shared_ptr<PortElementObject>&, const ::std::shared_ptr<Interceptor>&) {
        return nullptr;
    }
};

template <>
struct TypedGlue< ::parts::Abstract_later_answerer_body > {
    typedef ::parts::Abstract_later_answerer_body Body;

    static TypedNames names() { return {{"in_api", "ask_server_req_p"}, {"ask_server_resp_p"}, {}, {}}; }
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_server_intf_probe_api_payload_t >::description()}, {TypedCalls< ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_ask_server_req_p();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 1: return lwucm::by_name< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_server_intf_probe_api_payload_t >(element);
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t >(0));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::core::request_response::request_response_interaction_api::Abstract_rrasync_req_server_intf_probe_api_payload_t >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::core::request_response::request_response_interaction_api::Abstract_rrasync_resp_intf_probe_api_payload_t >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::parts::Abstract_setter_body > {
    typedef ::parts::Abstract_setter_body Body;

    static TypedNames names() { return {{"in_api"}, {"set_writer_p"}, {}, {}}; }
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {TypedCalls< ::core::shared_data::shared_data_interaction_api::Abstract_data_writer_probe_api_payload_t >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::core::shared_data::shared_data_interaction_api::Abstract_data_writer_probe_api_payload_t >(0));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::core::shared_data::shared_data_interaction_api::Abstract_data_writer_probe_api_payload_t >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::parts::Abstract_getter_body > {
    typedef ::parts::Abstract_getter_body Body;

    static TypedNames names() { return {{"in_api", "get_notification_p"}, {"get_reader_p"}, {}, {}}; }
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::core::shared_data::shared_data_interaction_api::Abstract_data_notification >::description()}, {TypedCalls< ::core::shared_data::shared_data_interaction_api::Abstract_data_reader_probe_api_payload_t >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_get_notification_p();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 1: return lwucm::by_name< ::core::shared_data::shared_data_interaction_api::Abstract_data_notification >(element);
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::core::shared_data::shared_data_interaction_api::Abstract_data_reader_probe_api_payload_t >(0));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::probe_api::Abstract_exchange_intf >(target, interceptor);
            case 1: return stand_in< ::core::shared_data::shared_data_interaction_api::Abstract_data_notification >(target, interceptor);
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t n, const ::std::shared_ptr<PortElementObject>& target, const ::std::shared_ptr<Interceptor>& interceptor) {
        switch (n) {
            case 0: return stand_in< ::core::shared_data::shared_data_interaction_api::Abstract_data_reader_probe_api_payload_t >(target, interceptor);
        }
        return nullptr;
    }
};

template <>
struct TypedGlue< ::parts::Abstract_counting_body > {
    typedef ::parts::Abstract_counting_body Body;

    static TypedNames names() { return {{"in_api", "aux_api"}, {}, {}, {"itt_timer_timer_service"}}; }
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 1: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.service< ::core::timer::itt_timer::ucm_itt::Abstract_itt_service_intf >(0));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body& body, const ::std::string& policy, const ::std::string& element) {
        if ((policy == "itt_timer") && element == "timer_callback") { return lwucm::by_name< ::core::timer::itt_timer::ucm_itt::Abstract_itt_callback_intf >(body.get_tp_itt_timer_timer_callback()); }
        return nullptr;
    }
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
struct TypedGlue< ::parts::Abstract_scheduling_body > {
    typedef ::parts::Abstract_scheduling_body Body;

    static TypedNames names() { return {{"in_api", "aux_api"}, {}, {}, {"ott_timer_timer_scheduler"}}; }
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 1: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.service< ::core::timer::ott_timer::ucm_ott::Abstract_ott_scheduler >(0));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
struct TypedGlue< ::parts::Abstract_running_body > {
    typedef ::parts::Abstract_running_body Body;

    static TypedNames names() { return {{"in_api", "aux_api"}, {}, {}, {}}; }
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 1: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections&) {
        body.on_startup();
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body& body) { return as_execution(body.get_tp_self_executing_self_execution_api()); }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
struct TypedGlue< ::probes::Abstract_hermit_body > {
    typedef ::probes::Abstract_hermit_body Body;

    static TypedNames names() { return {{}, {}, {}, {}}; }
    static TypedInterfaces interfaces() { return {{}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body&, ::std::size_t) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t, const ::std::shared_ptr<PortElementObject>&) {
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections&) {
        body.on_startup();
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{}, {TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body&, ::std::size_t) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t, const ::std::shared_ptr<PortElementObject>&) {
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections&) {
        body.on_startup();
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{}, {TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body&, ::std::size_t) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t, const ::std::shared_ptr<PortElementObject>&) {
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0), connections.required< ::probe_api::Abstract_exchange_intf >(1));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 1: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections&) {
        body.on_startup();
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
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
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
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
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
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
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 1: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
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
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 1: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
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
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 1: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
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
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
            case 2: return body.get_extra_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 1: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 2: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
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
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
            case 2: return body.get_extra_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 1: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 2: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
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
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
            case 1: return body.get_aux_api();
            case 2: return body.get_extra_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 1: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 2: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
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
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0), connections.required< ::probe_api::Abstract_exchange_intf >(1), connections.required< ::probe_api::Abstract_exchange_intf >(2));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body& body, ::std::size_t n) {
        switch (n) {
            case 0: return body.get_in_api();
        }
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections& connections) {
        body.on_startup(connections.required< ::probe_api::Abstract_exchange_intf >(0), connections.required< ::probe_api::Abstract_exchange_intf >(1), connections.required< ::probe_api::Abstract_exchange_intf >(2), connections.required< ::probe_api::Abstract_exchange_intf >(3), connections.required< ::probe_api::Abstract_exchange_intf >(4), connections.required< ::probe_api::Abstract_exchange_intf >(5), connections.required< ::probe_api::Abstract_exchange_intf >(6), connections.required< ::probe_api::Abstract_exchange_intf >(7));
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description(), TypedCalls< ::probe_api::Abstract_exchange_intf >::description()}, {}}; }
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
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t n, const ::std::shared_ptr<PortElementObject>& element) {
        switch (n) {
            case 0: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 1: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 2: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 3: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 4: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 5: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 6: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
            case 7: return lwucm::by_name< ::probe_api::Abstract_exchange_intf >(element);
        }
        return nullptr;
    }
    static void on_startup(Body& body, const TypedConnections&) {
        body.on_startup();
    }
    static void set_attribute(Body&, ::std::size_t, const ::std::string&) {}
    static ::std::shared_ptr<component_execution_intf> execution(Body&) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
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
    static TypedInterfaces interfaces() { return {{}, {}}; }
    static ::std::shared_ptr<PortElementObject> provided(Body&, ::std::size_t) { return nullptr; }
    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t, const ::std::shared_ptr<PortElementObject>&) {
        return nullptr;
    }
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
    static ::std::shared_ptr<PortElementObject> policy_port(Body&, const ::std::string&, const ::std::string&) {
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_provided(::std::size_t, const ::std::shared_ptr<PortElementObject>&, const ::std::shared_ptr<Interceptor>&) {
        return nullptr;
    }
    static ::std::shared_ptr<PortElementObject> intercept_required(::std::size_t, const ::std::shared_ptr<PortElementObject>&, const ::std::shared_ptr<Interceptor>&) {
        return nullptr;
    }
};

}

#endif
