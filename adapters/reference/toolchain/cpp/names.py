"""Names of a model as C++ spells them."""

from __future__ import annotations

import functools

from ucm_cts.adapters.contract.metamodel.names import SEPARATOR, Declared

_KEYWORDS = """alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t class compl const
    const_cast constexpr continue decltype default delete do double dynamic_cast else enum explicit export extern false
    float for friend goto if inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private
    protected public register reinterpret_cast return short signed sizeof static static_assert static_cast struct switch
    template this thread_local throw true try typedef typeid typename union unsigned using virtual void volatile wchar_t
    while xor xor_eq"""
KEYWORDS = frozenset(_KEYWORDS.split())
"""Words that no name can be in C++11 or C++03."""

REMEMBERED = 10_000
"""The number of names whose spelling is remembered."""


@functools.lru_cache(maxsize=REMEMBERED)
def identifier(name: str) -> str:
    """``name`` with underscores for what C++ does not allow in it; keywords are kept apart as in the IDL mapping."""
    plain = name.replace("-", "_")
    return f"_cxx_{plain}" if plain in KEYWORDS else plain


@functools.lru_cache(maxsize=REMEMBERED)
def namespace(path: str) -> tuple[str, ...]:
    """The C++ namespace of a module's ``path``."""
    return tuple(identifier(part) for part in path.split(SEPARATOR) if part)


def qualified(declared: Declared, prefix: str = "") -> str:
    """The name of ``declared`` from the root, with ``prefix`` before its last part."""
    return f"{_around(declared.scope.path)}::{prefix}{identifier(declared.element.name)}"


@functools.lru_cache(maxsize=REMEMBERED)
def _around(path: str) -> str:
    """The C++ namespace of a module's ``path`` as it stands before names."""
    return "".join(f"::{part}" for part in namespace(path))


def instance(template: str, *arguments: object) -> str:
    """``template<arguments>``, spaced so that C++03 reads neither ``<:`` nor ``>>``."""
    return f"{template}< {', '.join(map(str, arguments))} >"
