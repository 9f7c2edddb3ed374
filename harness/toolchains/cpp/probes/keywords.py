"""Keeps macros of headers from changing probes: reports keywords that they redefine, and removes them before the probes."""

from __future__ import annotations

import re
from collections.abc import Iterable

from ucm_cts.reference_models.mapping.cpp.expected import Standard

_OLD = """
asm auto bool break case catch char class const const_cast continue default delete do double dynamic_cast else enum explicit
export extern false float for friend goto if inline int long mutable namespace new operator private protected public register
reinterpret_cast return short signed sizeof static static_cast struct switch template this throw true try typedef typeid typename
union unsigned using virtual void volatile wchar_t while
"""
_NEW = "alignas alignof char16_t char32_t constexpr decltype noexcept nullptr static_assert thread_local"

_OF_STDBOOL = {"bool", "true", "false"}
"""What compilers' stdbool.h defines to itself in C++03."""


def keywords(standard: Standard) -> list[str]:
    """The keywords that can be the name of a macro."""
    return sorted((_OLD + _NEW if standard == "cpp11" else _OLD).split())


def redefined(standard: Standard) -> str:
    """Lines that the compiler refuses, with the keyword's name, if headers before them redefine a keyword."""
    checked = (k for k in keywords(standard) if standard == "cpp11" or k not in _OF_STDBOOL)
    return "".join(f"#ifdef {k}\n#error it redefines the keyword {k}\n#endif\n" for k in checked)


def keyword_of(message: str) -> str:
    """The keyword that a message of the compiler says is redefined; nothing if it speaks of something else."""
    match = re.search(r"it redefines the keyword (\w+)", message)
    return match[1] if match else ""


def without_macros(standard: Standard, names: Iterable[str]) -> str:
    """Lines after which neither keywords nor ``names`` are macros."""
    return "".join(f"#undef {name}\n" for name in [*keywords(standard), *sorted(names)])
