"""The lines of a model that are related to a change: a correct diagnostic of the change names one of them."""

from __future__ import annotations

import functools
from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.parsers import expat


@dataclass(eq=False)
class _Element:
    """An element from its first line to its last; ``head`` are the lines of its start tag."""

    tag: str
    names: frozenset[str]
    around: _Element | None
    first: int
    head: range
    last: int = 0
    inside: list[_Element] = field(default_factory=list)

    def all_inside(self) -> Iterator[_Element]:
        yield self
        for one in self.inside:
            yield from one.all_inside()

    def all_around(self) -> Iterator[_Element]:
        around = self.around
        while around is not None:
            yield around
            around = around.around


@functools.lru_cache(8192)
def related_lines(text: str, changed: frozenset[int]) -> frozenset[int]:
    """The ``changed`` lines, those of the elements around and inside, and those of elements that share a name with them or with
    the declaration around them. All lines if ``text`` is no XML.
    """
    try:
        elements = _elements(text)
    except expat.ExpatError:
        return frozenset(range(1, text.count("\n") + 2))
    begun = [one for one in elements if changed.intersection(one.head)]
    touched = {inner for one in begun for inner in one.all_inside()}
    for line in changed.difference(*(one.head for one in begun)):
        touched.update([one for one in elements if one.first <= line <= one.last][-1:])
    named: set[str] = set()
    for one in touched:
        named |= one.names
        named.update(name for outer in one.all_around() if not outer.tag.endswith("Module") for name in outer.names)
    related = touched.union(one for one in elements if named & one.names)
    lines = {line for one in related for e in (one, *one.all_around()) for line in (*e.head, e.last)}
    return frozenset(lines | changed)


def _elements(text: str) -> list[_Element]:
    """All elements, parents first. Raises ``ExpatError``."""
    lines = text.splitlines()
    found: list[_Element] = []
    open_ones: list[_Element] = []
    parser = expat.ParserCreate()

    def begin(tag: str, attributes: dict[str, str]) -> None:
        first = end = parser.CurrentLineNumber
        column = parser.CurrentColumnNumber
        while end <= len(lines) and ">" not in lines[end - 1][column:]:
            end, column = end + 1, 0
        around = open_ones[-1] if open_ones else None
        one = _Element(tag, frozenset(_words(attributes)), around, first, range(first, end + 1))
        if around is not None:
            around.inside.append(one)
        open_ones.append(one)
        found.append(one)

    def end(_: str) -> None:
        open_ones.pop().last = parser.CurrentLineNumber

    parser.StartElementHandler = begin
    parser.EndElementHandler = end
    parser.Parse(text.encode(), True)
    return found


def _words(attributes: dict[str, str]) -> Iterator[str]:
    """The last parts of all names in attributes."""
    for value in attributes.values():
        last = value.replace(".", "::").rpartition("::")[2]
        if last:
            yield last
