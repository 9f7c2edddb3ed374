"""Findings about C++ say what the header has, in words that do not speak of probes."""

from __future__ import annotations

import pytest

from ucm_cts.harness.toolchains.cpp.probes.observations import NO_SUCH_FUNCTION, in_words

SAID = {
    "'yes' in 'struct ucts::one_of<long int, int>' does not name a type": "it is long int",
    "no type named 'yes' in 'ucts::one_of<std::array<long, 3>, int>'": "it is std::array<long, 3>",
    "‘yes’ in ‘struct ucts::one_of<std::__cxx11::basic_string<char>, const std::__cxx11::basic_string<char>&>’ does not name a type": "it is std::string",
    "'yes' in 'struct ucts::one_of<void (*)(int, char), int>' does not name a type": "it is void (*)(int, char)",
    "'function' in 'struct ucts_check_9::found<m::Abstract_pump>' does not name a type": NO_SUCH_FUNCTION,
    "invalid use of incomplete type 'struct ucts::pointee<m::Abstract_pump*>'": "it is m::Abstract_pump*, which is no shared pointer",
    "implicit instantiation of undefined template 'ucts::pointee<m::Abstract_pump *>'": "it is m::Abstract_pump *, which is no shared pointer",
    "'struct std::array<int, 5>' has no member named 'push_back'": "it is std::array<int, 5>",
    "no member named 'push_back' in 'std::array<int, 5>'": "it is std::array<int, 5>",
    "invalid use of member function 'void m::broken::where(int&&)' (did you forget the '()' ?)": "it is a function, void m::broken::where(int&&)",
    "no type named 'yes' in 'ucts::holds<false>'": "it is not so",
    "'lamp' is not a member of 'm'": "'lamp' is not a member of 'm'",
}


@pytest.mark.parametrize("message", SAID)
def test_message_of_a_compiler_in_words_about_the_header(message: str) -> None:
    assert in_words(message) == SAID[message]
    assert "ucts" not in in_words(message)
