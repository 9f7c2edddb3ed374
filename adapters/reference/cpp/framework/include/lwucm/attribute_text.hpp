// Values of attributes as configurations spell them: add_component takes texts, typed bodies take values.
#ifndef LWUCM_ATTRIBUTE_TEXT_HPP
#define LWUCM_ATTRIBUTE_TEXT_HPP

#include <cstdint>
#include <sstream>
#include <string>
#include <type_traits>

#include "lwucm/errors.hpp"

namespace lwucm {
namespace detail {

[[noreturn]] inline void refuse_attribute(const std::string& text) {
    throw UCM_ERROR("'" + text + "' is no value of the attribute");
}

// streams read integers of one byte as characters
template <class T>
using Read = typename std::conditional<sizeof(T) == 1 && !std::is_same<T, char>::value && !std::is_same<T, bool>::value,
                                       int, T>::type;

template <class T>
T attribute_value(const std::string& text, std::true_type /*is_arithmetic*/) {
    std::istringstream stream(text);
    Read<T> value = Read<T>();
    const bool negative = text.find('-') != std::string::npos;
    if (!(stream >> std::boolalpha >> std::noskipws >> value) || stream.peek() != std::istringstream::traits_type::eof() ||
        static_cast<Read<T>>(static_cast<T>(value)) != value || (negative && std::is_unsigned<T>::value)) {
        refuse_attribute(text);
    }
    return static_cast<T>(value);
}

template <class T>
T attribute_value(const std::string&, std::false_type /*is_arithmetic*/) {
    throw UCM_ERROR("no text is a value of the attribute");
}

}  // namespace detail

/// Numbers in decimal notation, `true` and `false`, characters as they are. UCM_ERROR if `text` is none, or no text can be one.
template <class T>
T attribute_value(const std::string& text) {
    return detail::attribute_value<T>(text, std::integral_constant<bool, std::is_arithmetic<T>::value>());
}

/// Strings are as they are.
template <>
inline std::string attribute_value<std::string>(const std::string& text) {
    return text;
}

}  // namespace lwucm

#endif
