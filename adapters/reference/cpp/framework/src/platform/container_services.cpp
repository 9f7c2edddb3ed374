#include "lwucm/container_services.hpp"

#include <algorithm>
#include <vector>

namespace lwucm {

namespace {

const std::vector<std::string>& severities() {
    static const std::vector<std::string> names = {"trace", "debug", "info", "warning", "error", "critical"};
    return names;
}

InterfacePtr clock_interface() {
    const TypePtr timeval =
        structure_type("ucm_timeval_t", {{"utv_sec", alias_type("ucm_time_t", integer_type(IntegerKind::ULONG))},
                                         {"utv_usec", alias_type("ucm_usecond_t", integer_type(IntegerKind::LONG))}});
    return std::make_shared<const Interface>(std::vector<Method>{
        Method("get_local_time", {{"local_time", Direction::out, timeval}}),
        Method("get_synchronized_time", {{"synchronized_time", Direction::out, timeval}})});
}

InterfacePtr trace_interface() {
    std::vector<Enumerator> enumerators;
    for (const std::string& name : severities()) {
        enumerators.push_back({name, static_cast<std::int64_t>(enumerators.size())});
    }
    const TypePtr severity = enumeration_type("log_severity_t", IntegerKind::ULONG, enumerators);
    const TypePtr message = alias_type("log_message_t", string32_type());
    return std::make_shared<const Interface>(std::vector<Method>{
        Method("log", {{"severity", Direction::in, severity}, {"message", Direction::in, message}})});
}

Value value_of(const ucm_timeval_t& time) {
    return Value::list({Value::natural(time.utv_sec), Value::integer(time.utv_usec)});
}

void expect(const Values& arguments, std::size_t count) {
    if (arguments.size() != count) {
        throw BAD_PARAMETER(std::to_string(count) + " arguments are due");
    }
}

}  // namespace

const InterfacePtr& clock_service_intf::get_interface() const {
    static const InterfacePtr interface = clock_interface();
    return interface;
}

Values clock_service_intf::call(const std::string& method, const Values& arguments) {
    get_interface()->method(method);
    expect(arguments, 0);
    ucm_timeval_t time = {0, 0};
    if (method == "get_local_time") {
        get_local_time(time);
    } else {
        get_synchronized_time(time);
    }
    return {value_of(time)};
}

const std::string& name_of(log_severity_t severity) { return severities()[static_cast<std::size_t>(severity)]; }

bool find_severity(const std::string& name, log_severity_t& severity) {
    const auto found = std::find(severities().begin(), severities().end(), name);
    if (found == severities().end()) {
        return false;
    }
    severity = static_cast<log_severity_t>(found - severities().begin());
    return true;
}

const InterfacePtr& trace_service_intf::get_interface() const {
    static const InterfacePtr interface = trace_interface();
    return interface;
}

Values trace_service_intf::call(const std::string& method, const Values& arguments) {
    get_interface()->method(method);
    expect(arguments, 2);
    log_severity_t severity = log_severity_t::trace;
    if (!find_severity(arguments[0].as_enumerator(), severity)) {
        throw BAD_PARAMETER("there is no severity '" + arguments[0].as_enumerator() + "'");
    }
    log(severity, arguments[1].as_string());
    return {};
}

}  // namespace lwucm
