// Values of C++ types that are generated from models (13.2, 13.3) as Values, and back.
#ifndef LWUCM_TYPED_VALUES_HPP
#define LWUCM_TYPED_VALUES_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "lwucm/errors.hpp"
#include "lwucm/value.hpp"

namespace lwucm {

/// For each type that a parameter has: `static Value to(const T&)` and `static T from(const Value&)`, which throws BAD_PARAMETER
/// if the value is none of `T`. Generated for structures and enumerations.
template <class T, class = void>
struct TypedValue;

template <>
struct TypedValue<bool> {
    static Value to(bool value) { return Value::boolean(value); }
    static bool from(const Value& value) { return value.as_boolean(); }
};

template <>
struct TypedValue<float> {
    static Value to(float value) { return Value::single(value); }
    static float from(const Value& value) { return value.as_single(); }
};

template <>
struct TypedValue<double> {
    static Value to(double value) { return Value::real(value); }
    static double from(const Value& value) { return value.as_real(); }
};

/// CHAR8: a code point from 0 to 255.
template <>
struct TypedValue<char> {
    static Value to(char value) { return Value::character(static_cast<unsigned char>(value)); }
    static char from(const Value& value) { return from_point(value.as_character()); }

    static char from_point(char32_t point) {
        if (point > std::numeric_limits<unsigned char>::max()) {
            throw BAD_PARAMETER("a CHAR8 has 8 bits");
        }
        return static_cast<char>(static_cast<unsigned char>(point));
    }
};

/// CHAR32.
template <>
struct TypedValue<wchar_t> {
    static Value to(wchar_t value) { return Value::character(static_cast<char32_t>(value)); }
    static wchar_t from(const Value& value) { return static_cast<wchar_t>(value.as_character()); }
};

template <>
struct TypedValue<std::string> {
    static Value to(const std::string& value) {
        std::u32string points;
        for (const char one : value) {
            points.push_back(static_cast<unsigned char>(one));
        }
        return Value::string(std::move(points));
    }

    static std::string from(const Value& value) {
        std::string text;
        for (const char32_t point : value.as_string()) {
            text.push_back(TypedValue<char>::from_point(point));
        }
        return text;
    }
};

template <>
struct TypedValue<std::wstring> {
    static Value to(const std::wstring& value) { return Value::string(std::u32string(value.begin(), value.end())); }

    static std::wstring from(const Value& value) {
        const std::u32string& points = value.as_string();
        return std::wstring(points.begin(), points.end());
    }
};

/// All other integers.
template <class T>
struct TypedValue<T, typename std::enable_if<std::is_integral<T>::value>::type> {
    static Value to(T value) { return to(value, std::is_signed<T>()); }
    static T from(const Value& value) { return from(value, std::is_signed<T>()); }

  private:
    static Value to(T value, std::true_type) { return Value::integer(value); }
    static Value to(T value, std::false_type) { return Value::natural(value); }

    static T from(const Value& value, std::true_type) {
        const std::int64_t number = value.as_integer();
        return fitting(number, number < std::numeric_limits<T>::min() || number > std::numeric_limits<T>::max());
    }

    static T from(const Value& value, std::false_type) {
        const std::uint64_t number = value.as_natural();
        return fitting(number, number > std::numeric_limits<T>::max());
    }

    template <class Number>
    static T fitting(Number number, bool is_outside) {
        if (is_outside) {
            throw BAD_PARAMETER("the integer is too large for its type");
        }
        return static_cast<T>(number);
    }
};

/// A sequence without a bound.
template <class T>
struct TypedValue<std::vector<T>> {
    static Value to(const std::vector<T>& value) {
        Values items;
        for (const T& item : value) {
            items.push_back(TypedValue<T>::to(item));
        }
        return Value::list(std::move(items));
    }

    static std::vector<T> from(const Value& value) {
        std::vector<T> items;
        for (const Value& item : value.as_list()) {
            items.push_back(TypedValue<T>::from(item));
        }
        return items;
    }
};

template <class T, std::size_t N>
struct TypedValue<std::array<T, N>> {
    static Value to(const std::array<T, N>& value) {
        Values items;
        for (const T& item : value) {
            items.push_back(TypedValue<T>::to(item));
        }
        return Value::list(std::move(items));
    }

    static std::array<T, N> from(const Value& value) {
        const Values& items = value.as_list();
        if (items.size() != N) {
            throw BAD_PARAMETER("another number of elements is due");
        }
        std::array<T, N> all;
        for (std::size_t n = 0; n < N; ++n) {
            all[n] = TypedValue<T>::from(items[n]);
        }
        return all;
    }
};

/// `values` if there are `count` of them, else BAD_PARAMETER. For the fields of a structure and the arguments of a call.
inline const Values& expect_values(const Values& values, std::size_t count) {
    if (values.size() != count) {
        throw BAD_PARAMETER(std::to_string(count) + " values are due");
    }
    return values;
}

}  // namespace lwucm

#endif
