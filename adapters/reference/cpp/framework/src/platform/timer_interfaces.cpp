#include "lwucm/timers.hpp"

#include <limits>

namespace lwucm {

namespace {

const std::string ON_TIMEOUT = "on_timeout";
const std::string START_PERIODIC = "start_periodic_scheduler";
const std::string START_SPORADIC = "start_sporadic_scheduler";
const std::string CANCEL_TIMER = "cancel_timer";
const std::string IS_CANCELED = "is_canceled";
const std::string ABSOLUTE_TIME = "ABSOLUTE_TIME";
const std::string RELATIVE_TIME = "RELATIVE_TIME";

TypePtr timer_number_type() { return alias_type("timer_number_t", integer_type(IntegerKind::ULONG)); }

TypePtr timeout_type() {
    const TypePtr flag = enumeration_type("timeout_enum_t", IntegerKind::BYTE, {{ABSOLUTE_TIME, 0}, {RELATIVE_TIME, 1}});
    const TypePtr seconds = alias_type("ucm_time_t", integer_type(IntegerKind::ULONG));
    return structure_type("timeout_t", {{"time_val", seconds}, {"flag", flag}});
}

InterfacePtr timer_service_interface() {
    const TypePtr timeout = timeout_type();
    const Parameter number = {"timer_number", Direction::in, timer_number_type()};
    const Parameter returns = {"returns", Direction::result, alias_type("timer_bool_t", boolean_type())};
    return std::make_shared<const Interface>(std::vector<Method>{
        Method(START_PERIODIC, {number, {"delay_time", Direction::in, timeout}, {"rate", Direction::in, timeout}}),
        Method(START_SPORADIC, {number, {"time", Direction::in, timeout}}), Method(CANCEL_TIMER, {number}),
        Method(IS_CANCELED, {number, returns})});
}

InterfacePtr timer_callback_interface() {
    return std::make_shared<const Interface>(std::vector<Method>{Method(
        ON_TIMEOUT,
        {{"time", Direction::in, timeout_type()}, {"timer_number", Direction::in, timer_number_type()}})});
}

std::uint32_t as_ulong(const Value& value) {
    const std::uint64_t natural = value.as_natural();
    if (natural > std::numeric_limits<std::uint32_t>::max()) {
        throw BAD_PARAMETER("the value has more than 32 bits");
    }
    return static_cast<std::uint32_t>(natural);
}

timeout_t as_timeout(const Value& value) {
    const Values& fields = value.as_list();
    if (fields.size() != 2) {
        throw BAD_PARAMETER("a time-out has two fields");
    }
    const std::string& flag = fields[1].as_enumerator();
    if (flag != ABSOLUTE_TIME && flag != RELATIVE_TIME) {
        throw BAD_PARAMETER("there is no flag '" + flag + "'");
    }
    return {as_ulong(fields[0]), flag == ABSOLUTE_TIME ? timeout_enum_t::ABSOLUTE_TIME : timeout_enum_t::RELATIVE_TIME};
}

/// BAD_PARAMETER if the interface has no such method, or it has another number of arguments.
void expect_call(const Interface& interface, const std::string& method, const Values& arguments) {
    const std::size_t due = interface.method(method).arguments().size();
    if (arguments.size() != due) {
        throw BAD_PARAMETER(std::to_string(due) + " arguments are due");
    }
}

}  // namespace

const InterfacePtr& itt_service_intf::get_interface() const {
    static const InterfacePtr interface = timer_service_interface();
    return interface;
}

Values itt_service_intf::call(const std::string& method, const Values& arguments) {
    expect_call(*get_interface(), method, arguments);
    const timer_number_t number = as_ulong(arguments[0]);
    if (method == IS_CANCELED) {
        return {Value::boolean(is_canceled(number))};
    }
    if (method == START_PERIODIC) {
        start_periodic_scheduler(number, as_timeout(arguments[1]), as_timeout(arguments[2]));
    } else if (method == START_SPORADIC) {
        start_sporadic_scheduler(number, as_timeout(arguments[1]));
    } else {
        cancel_timer(number);
    }
    return {};
}

const InterfacePtr& itt_callback_intf::get_interface() const {
    static const InterfacePtr interface = timer_callback_interface();
    return interface;
}

Values itt_callback_intf::call(const std::string& method, const Values& arguments) {
    expect_call(*get_interface(), method, arguments);
    on_timeout(as_timeout(arguments[0]), as_ulong(arguments[1]));
    return {};
}

void call_on_timeout(DynamicPortElement& callback, const timeout_t& time, timer_number_t timer_number) {
    const std::string& flag = time.flag == timeout_enum_t::ABSOLUTE_TIME ? ABSOLUTE_TIME : RELATIVE_TIME;
    callback.call(ON_TIMEOUT, {Value::list({Value::natural(time.time_val), Value::enumerator(flag)}),
                               Value::natural(timer_number)});
}

}  // namespace lwucm
