"""The parts of a translation unit that probes share, and their names in messages."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ucm_cts.reference_models.mapping.cpp.classes import Class, Connected, Named, Returned


@dataclass(frozen=True)
class Text:
    """``declared`` stands at the outermost level, ``run`` in a function that ``ucts::require`` ends; ``says`` is what must hold.

    ``key`` names the implementation that it needs, ``of_functions`` is whether the claim is about a function, ``judged_last`` that it
    says something only if all functions are as they should be, and ``pure`` that it does so only if the class can be implemented.
    """

    says: str
    declared: str = ""
    run: str = ""
    key: str = ""
    of_functions: bool = False
    judged_last: bool = False
    pure: bool = False


def class_text(owner: Class) -> str:
    """How C++ reaches a class."""
    match owner:
        case Named(name):
            return name
        case Returned(class_name, getter):
            return f"::ucts::target<UCTS_TYPE(::ucts::of_0(&{class_name}::{getter}))>::type"
        case Connected(class_name, connection):
            return f"::ucts::inner<UCTS_TYPE(::ucts::member_of(&{connection_text(class_name, connection)}::ref))>::type"
    raise AssertionError(owner)


def class_words(owner: Class) -> str:
    """What a class is called in messages."""
    match owner:
        case Named(name):
            return name
        case Returned(class_name, getter):
            return f"the class that {class_name}::{getter}() returns a reference to"
        case Connected(_, connection):
            return f"the class that {connection} refers to"
    raise AssertionError(owner)


def connection_text(owner: str, connection: str) -> str:
    """The name that ``connection_declared`` gives to a connection type."""
    return f"{_helper(owner, connection)}::type"


def _helper(owner: str, connection: str) -> str:
    place, _, name = owner.rpartition("::")
    return f"{place}::ucts_{name}_{connection}"


def connection_declared(owner: str, connection: str) -> str:
    """Looks ``connection`` up inside the class ``owner``, so that it is found in the class or around it."""
    place, _, name = _helper(owner, connection).rpartition("::")
    parts = [part for part in place.split("::") if part]
    opened = " ".join(f"namespace {part} {{" for part in parts)
    return f"{opened} struct {name} : {owner} {{ typedef {connection} type; }}; {'}' * len(parts)}"


def connection_missing(owner: str, connection: str) -> str:
    """What ``connection_text`` names where there is no such type, so that texts that name it are understood."""
    place, _, name = _helper(owner, connection).rpartition("::")
    parts = [part for part in place.split("::") if part]
    opened = " ".join(f"namespace {part} {{" for part in parts)
    return f"{opened} struct {name} {{ struct type; }}; {'}' * len(parts)}"


def holds(condition: str) -> str:
    """A declaration that compiles if ``condition`` is true."""
    return f"typedef ::ucts::holds<({condition})>::yes checked;"


def one_of(type_: str, types: Iterable[str]) -> str:
    """A declaration that compiles if ``type_`` is one of ``types``."""
    return f"typedef ::ucts::one_of<{type_}, {', '.join(types)} >::yes checked;"


def words(types: Iterable[str]) -> str:
    """``types`` for people."""
    return " or ".join(type_.replace("< ", "<").replace(" >", ">") for type_ in types)
