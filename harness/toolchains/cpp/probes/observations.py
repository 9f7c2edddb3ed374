"""What a compiler says of a probe that does not compile, in words about the headers instead of the probe."""

from __future__ import annotations

import re
from collections.abc import Callable

_CONDITION = re.compile(r"holds<\(?false")
_ONE_OF = re.compile(r"\bucts::one_of<")
_POINTEE = re.compile(r"\bucts::pointee<")
_FOUND = re.compile(r"\bucts_check_\d+::found<")
_PUSHED = re.compile(
    r"'(?:struct |class |const )*([^']*)'(?: has)? no member named 'push_back'|'push_back' in '([^']*)'"
)
_FUNCTION = re.compile(r"use of (?:non-static )?member function '([^']*)'")
_STRINGS = (
    (re.compile(r"std::(?:__cxx11::|__1::)?basic_string<char>"), "std::string"),
    (re.compile(r"std::(?:__cxx11::|__1::)?basic_string<wchar_t>"), "std::wstring"),
)

NO_SUCH_FUNCTION = (
    "no such function: the name is not there, or it takes something else, or is const where it may not be"
)


def in_words(message: str) -> str:
    """The compiler's ``message`` about a probe, as a statement about the header; ``message`` itself where it speaks of the header already."""
    text = message.replace("‘", "'").replace("’", "'")
    for pattern, name in _STRINGS:
        text = pattern.sub(name, text)
    for pattern, says in _WORDS:
        match = pattern.search(text)
        if match is not None:
            return says(text, match)
    return text


def _argument(text: str, match: re.Match[str]) -> str:
    """The first argument of the template whose ``<`` ends ``match``."""
    depth = 0
    for position, letter in enumerate(text[match.end() :], match.end()):
        depth += (letter in "<([") - (letter in ">)]")
        if depth < 0 or (letter == "," and depth == 0):
            return text[match.end() : position].strip()
    return text[match.end() :].strip()


_WORDS: tuple[tuple[re.Pattern[str], Callable[[str, re.Match[str]], str]], ...] = (
    (_CONDITION, lambda text, match: "it is not so"),
    (_ONE_OF, lambda text, match: f"it is {_argument(text, match)}"),
    (_POINTEE, lambda text, match: f"it is {_argument(text, match)}, which is no shared pointer"),
    (_FOUND, lambda text, match: NO_SUCH_FUNCTION),
    (_PUSHED, lambda text, match: f"it is {match[1] or match[2]}"),
    (_FUNCTION, lambda text, match: f"it is a function, {match[1]}"),
)
"""A part of a message, and what stands for the whole message then."""
