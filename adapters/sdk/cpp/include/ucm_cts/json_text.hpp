// JSON out: functions that append to a string. Answers are built this way, without a tree of values.
#ifndef UCM_CTS_JSON_TEXT_HPP
#define UCM_CTS_JSON_TEXT_HPP

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ucm_cts {
namespace json {

inline void append(std::string& out, std::int64_t value) {
    char digits[20];
    char* const end = digits + sizeof digits;
    char* begin = end;
    // the remainder's sign follows the dividend's: no negation that could overflow
    const bool negative = value < 0;
    do {
        const int digit = static_cast<int>(value % 10);
        *--begin = static_cast<char>('0' + (negative ? -digit : digit));
        value /= 10;
    } while (value != 0);
    if (negative) {
        out += '-';
    }
    out.append(begin, static_cast<std::size_t>(end - begin));
}

/// Bytes in strings that are not UTF-8 become U+FFFD.
inline std::string json_of(const nlohmann::json& value) {
    return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Appends `text` as a JSON string. Bytes that are not UTF-8 become U+FFFD.
inline void append_text(std::string& out, const char* text, std::size_t size) {
    for (std::size_t n = 0; n < size; ++n) {
        const unsigned char byte = static_cast<unsigned char>(text[n]);
        if (byte < 0x20 || byte >= 0x7f || byte == '"' || byte == '\\') {
            out += json_of(std::string(text, size));
            return;
        }
    }
    out += '"';
    out.append(text, size);
    out += '"';
}

inline void append(std::string& out, std::int32_t value) { append(out, static_cast<std::int64_t>(value)); }
inline void append(std::string& out, bool value) { out += value ? "true" : "false"; }
inline void append(std::string& out, const char* text) { append_text(out, text, std::strlen(text)); }
inline void append(std::string& out, const std::string& text) { append_text(out, text.data(), text.size()); }

inline void append(std::string& out, const nlohmann::json& value) { out += json_of(value); }

/// Appends `,"name":` after which the value follows.
inline void append_name(std::string& out, const char* name) {
    out += ",\"";
    out += name;
    out += "\":";
}

/// Appends `[one,other]`, or with other brackets; `append_one(part)` appends one part.
template <class Parts, class AppendOne>
void append_all(std::string& out, const char* brackets, const Parts& parts, AppendOne append_one) {
    out += brackets[0];
    bool first = true;
    for (const auto& part : parts) {
        if (!first) {
            out += ',';
        }
        first = false;
        append_one(part);
    }
    out += brackets[1];
}

template <class T>
void append(std::string& out, const std::vector<T>& elements) {
    append_all(out, "[]", elements, [&out](const T& element) { append(out, element); });
}

template <class T>
void append(std::string& out, const std::map<std::string, T>& members) {
    append_all(out, "{}", members, [&out](const std::pair<const std::string, T>& member) {
        append(out, member.first);
        out += ':';
        append(out, member.second);
    });
}

/// The first `most` characters of `text`, counted as Unicode characters.
inline std::string shortened(const std::string& text, std::size_t most) {
    std::size_t characters = 0;
    for (std::size_t n = 0; n < text.size(); ++n) {
        const bool continues = (static_cast<unsigned char>(text[n]) & 0xc0) == 0x80;
        if (!continues && characters++ == most) {
            return text.substr(0, n);
        }
    }
    return text;
}

}  // namespace json
}  // namespace ucm_cts

#endif
