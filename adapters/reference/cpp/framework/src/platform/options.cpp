#include "lwucm/options.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <sstream>
#include <vector>

#include "lwucm/errors.hpp"

namespace lwucm {

namespace {

typedef std::function<bool(Options&, const std::string& value)> Set;

/// Sets `member` to the one of its values that stands where `value` stands in `names`.
template <class Choice>
Set choice(Choice Options::*member, const std::vector<std::string>& names) {
    return [member, names](Options& options, const std::string& value) {
        const auto found = std::find(names.begin(), names.end(), value);
        options.*member = static_cast<Choice>(found - names.begin());
        return found != names.end();
    };
}

bool set_inbox(Options& options, const std::string& value) {
    const bool digits = !value.empty() && value.find_first_not_of("0123456789") == std::string::npos;
    options.inbox = digits ? static_cast<std::size_t>(std::strtoul(value.c_str(), nullptr, 10)) : 0;
    return digits;
}

const std::map<std::string, Set>& known() {
    static const std::map<std::string, Set> all = {
        {"delivery", choice(&Options::delivery, {"asynchronous", "synchronous"})},
        {"executor", choice(&Options::executor, {"caller", "component", "shared"})},
        {"ids", choice(&Options::ids, {"counting", "random", "reused"})},
        {"removal", choice(&Options::removal, {"refuse", "cascade"})},
        {"repetition", choice(&Options::repetition, {"ignore", "refuse"})},
        {"unconnected", choice(&Options::unconnected, {"refuse", "tolerate"})},
        {"order", choice(&Options::order, {"added", "reversed"})},
        {"service-failure", choice(&Options::service_failure, {"raise", "wait"})},
        {"not-ready", choice(&Options::not_ready, {"hold", "drop", "error"})},
        {"pending", choice(&Options::pending, {"keep", "drop", "deliver"})},
        {"clock", choice(&Options::clock, {"calendar", "uptime"})},
        {"port-trace", choice(&Options::port_trace, {"call", "call-and-return"})},
        {"inbox", set_inbox},
    };
    return all;
}

}  // namespace

Options parse_options(const std::string& text) {
    Options options;
    std::istringstream rest(text);
    std::string one;
    while (std::getline(rest, one, ',')) {
        const std::size_t equals = std::min(one.find('='), one.size());
        const auto option = known().find(one.substr(0, equals));
        if (option == known().end() || equals == one.size() || !option->second(options, one.substr(equals + 1))) {
            throw BAD_PARAMETER("there is no option '" + one + "'");
        }
    }
    return options;
}

}  // namespace lwucm
