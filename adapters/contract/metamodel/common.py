"""What all classes of the meta-model have in common (9.1.4)."""

from __future__ import annotations

import functools
from collections.abc import Iterator
from typing import Any, TypeVar

import msgspec


class Element(msgspec.Struct, frozen=True, kw_only=True, gc=False):
    """Anything that a model holds. Elements do not know their container, and equal elements at different places are equal.

    ``line``: where it begins in the model's file, counted from 1; 0 if unknown.
    """

    line: int = 0


T = TypeVar("T", bound=Element)


class SimpleComment(Element, frozen=True, kw_only=True):
    """A comment that belongs to the model, not to its file (9.1.4.3)."""

    text: str = ""


class Named(Element, frozen=True, kw_only=True):
    """Anything with a name, which the text calls identifier (9.1.4.1).

    ``name``: the identifier; an empty one is an error that a check reports, not the reader.
    ``comments``: its comments, in the model's order.
    """

    name: str = ""
    comments: tuple[SimpleComment, ...] = ()


@functools.cache
def child_fields(kind: type[Element]) -> tuple[str, ...]:
    """The fields of ``kind`` that hold elements."""
    return tuple(field.name for field in msgspec.structs.fields(kind) if field.default == ())


def children(element: Element) -> Iterator[Element]:
    """What ``element`` contains directly, field by field, each field in the model's order."""
    for field in child_fields(type(element)):
        yield from getattr(element, field)


def without_lines(element: T) -> T:
    """``element`` with all lines 0, its own and those inside: equal for files with the same contents."""
    changed: dict[str, Any] = {"line": 0}
    for field in child_fields(type(element)):
        changed[field] = tuple(without_lines(child) for child in getattr(element, field))
    return msgspec.structs.replace(element, **changed)


def walk(element: Element) -> Iterator[Element]:
    """``element`` and all that it contains, parents first, however deep."""
    waiting = [element]
    while waiting:
        current = waiting.pop()
        yield current
        waiting.extend(reversed(tuple(children(current))))
