// Texts and floats as they travel (data_types.hpp), and as C++ has them: for adapters whose framework has values of its own.
#ifndef UCM_CTS_VALUES_HPP
#define UCM_CTS_VALUES_HPP

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

#include "ucm_cts/data_types.hpp"

namespace ucm_cts {

/// The characters of a text in UTF-8, as std::u32string or, where wchar_t has 32 bits, as std::wstring (13.2.6).
template <class Characters>
Characters from_utf8(const std::string& text) {
    typedef typename Characters::value_type Character;
    static_assert(sizeof(Character) >= 4, "a character has 32 bits");
    Characters characters;
    std::size_t at = 0;
    while (at < text.size()) {
        const unsigned char first = static_cast<unsigned char>(text[at++]);
        const int more = first < 0x80 ? 0 : first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
        char32_t character = more == 0 ? first : first & (0x3FU >> more);
        for (int count = 0; count < more && at < text.size(); ++count) {
            character = (character << 6) | (static_cast<unsigned char>(text[at++]) & 0x3FU);
        }
        characters.push_back(static_cast<Character>(character));
    }
    return characters;
}

template <class Characters>
std::string to_utf8(const Characters& characters) {
    std::string text;
    for (const auto each : characters) {
        const char32_t character = static_cast<char32_t>(each);
        const int more = character < 0x80 ? 0 : character < 0x800 ? 1 : character < 0x10000 ? 2 : 3;
        const unsigned lead = more == 0 ? 0 : 0xFF00U >> (more + 1);
        text.push_back(static_cast<char>((lead & 0xFFU) | (character >> (6 * more))));
        for (int left = more; left > 0; --left) {
            text.push_back(static_cast<char>(0x80U | ((character >> (6 * (left - 1))) & 0x3FU)));
        }
    }
    return text;
}

namespace detail {

/// The unsigned integer as large as a float or double.
template <class Float>
using Bits = typename std::conditional<sizeof(Float) == 4, std::uint32_t, std::uint64_t>::type;

}  // namespace detail

/// A float or double as the hexadecimal digits of its bits.
template <class Float>
Datum from_float(Float value) {
    detail::Bits<Float> bits;
    static_assert(sizeof bits == sizeof value, "a float has 32 or 64 bits");
    std::memcpy(&bits, &value, sizeof bits);
    std::string digits;
    for (int shift = static_cast<int>(sizeof bits) * 8 - 4; shift >= 0; shift -= 4) {
        digits.push_back("0123456789abcdef"[(bits >> shift) & 0xF]);
    }
    return digits;
}

/// Back again. Throws what nlohmann::json and std::stoull throw if `datum` is none.
template <class Float>
Float to_float(const Datum& datum) {
    const detail::Bits<Float> bits =
        static_cast<detail::Bits<Float>>(std::stoull(datum.get<std::string>(), nullptr, 16));
    Float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

}  // namespace ucm_cts

#endif
