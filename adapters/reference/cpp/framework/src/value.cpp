#include "lwucm/value.hpp"

#include <cstring>
#include <limits>
#include <utility>

#include "lwucm/errors.hpp"

namespace lwucm {

Value Value::boolean(bool value) { return Value(Kind::boolean, value ? 1 : 0); }

Value Value::integer(std::int64_t value) { return Value(Kind::integer, static_cast<std::uint64_t>(value)); }

Value Value::natural(std::uint64_t value) {
    const bool small = value <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    return Value(small ? Kind::integer : Kind::natural, value);
}

Value Value::single(float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return Value(Kind::single, bits);
}

Value Value::real(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return Value(Kind::real, bits);
}

Value Value::character(char32_t value) { return Value(Kind::character, value); }

Value Value::string(std::u32string value) {
    Value result(Kind::string, 0);
    result.string_ = std::move(value);
    return result;
}

Value Value::enumerator(std::string name) {
    Value result(Kind::enumerator, 0);
    result.name_ = std::move(name);
    return result;
}

Value Value::list(Values items) {
    Value result(Kind::list, 0);
    result.items_ = std::move(items);
    return result;
}

bool Value::as_boolean() const {
    expect(Kind::boolean, "a boolean");
    return bits_ != 0;
}

std::int64_t Value::as_integer() const {
    expect(Kind::integer, "an integer");
    return static_cast<std::int64_t>(bits_);
}

std::uint64_t Value::as_natural() const {
    if (kind_ != Kind::natural && as_integer() < 0) {
        throw BAD_PARAMETER("the value is negative");
    }
    return bits_;
}

float Value::as_single() const {
    expect(Kind::single, "a FLOAT");
    const std::uint32_t bits = static_cast<std::uint32_t>(bits_);
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

double Value::as_real() const {
    expect(Kind::real, "a DOUBLE");
    double value = 0;
    std::memcpy(&value, &bits_, sizeof value);
    return value;
}

char32_t Value::as_character() const {
    expect(Kind::character, "a character");
    return static_cast<char32_t>(bits_);
}

const std::u32string& Value::as_string() const {
    expect(Kind::string, "a string");
    return string_;
}

const std::string& Value::as_enumerator() const {
    expect(Kind::enumerator, "an enumerator");
    return name_;
}

const Values& Value::as_list() const {
    expect(Kind::list, "a structure, union, array or sequence");
    return items_;
}

void Value::expect(Kind kind, const char* what) const {
    if (kind_ != kind) {
        throw BAD_PARAMETER(std::string("the value is not ") + what);
    }
}

bool operator==(const Value& one, const Value& other) {
    if (one.kind() != other.kind()) {
        return false;
    }
    switch (one.kind()) {
        case Value::Kind::boolean:
            return one.as_boolean() == other.as_boolean();
        case Value::Kind::integer:
            return one.as_integer() == other.as_integer();
        case Value::Kind::natural:
            return one.as_natural() == other.as_natural();
        case Value::Kind::single: {
            const float left = one.as_single();
            const float right = other.as_single();
            return std::memcmp(&left, &right, sizeof left) == 0;
        }
        case Value::Kind::real: {
            const double left = one.as_real();
            const double right = other.as_real();
            return std::memcmp(&left, &right, sizeof left) == 0;
        }
        case Value::Kind::character:
            return one.as_character() == other.as_character();
        case Value::Kind::string:
            return one.as_string() == other.as_string();
        case Value::Kind::enumerator:
            return one.as_enumerator() == other.as_enumerator();
        case Value::Kind::list:
            return one.as_list() == other.as_list();
    }
    return false;
}

}  // namespace lwucm
