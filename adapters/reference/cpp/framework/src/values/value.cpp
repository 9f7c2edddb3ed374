#include "lwucm/value.hpp"

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

Value Value::single(float value) { return Value(Kind::single, same_bits<std::uint32_t>(value)); }

Value Value::real(double value) { return Value(Kind::real, same_bits<std::uint64_t>(value)); }

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
    return same_bits<float>(static_cast<std::uint32_t>(bits_));
}

double Value::as_real() const {
    expect(Kind::real, "a DOUBLE");
    return same_bits<double>(bits_);
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
    return one.kind_ == other.kind_ && one.bits_ == other.bits_ && one.string_ == other.string_ &&
           one.name_ == other.name_ && one.items_ == other.items_;
}

}  // namespace lwucm
