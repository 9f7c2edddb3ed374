// Words: how the values of an enumeration are spelled on the wire.
#ifndef UCM_CTS_WORDS_HPP
#define UCM_CTS_WORDS_HPP

#include <cstddef>

namespace ucm_cts {

/// What a string may be, in the order of the enumeration if there is one.
struct Words {
    const char* const* begin;
    std::size_t size;
};

template <class Enumeration>
const char* word_of(Enumeration value) {
    return words_of(value).begin[static_cast<std::size_t>(value)];
}

}  // namespace ucm_cts

#endif
