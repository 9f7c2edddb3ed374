"""The lines of a model that are related to a change: a correct diagnostic of the change names one of them."""

from __future__ import annotations

import functools
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field
from xml.parsers import expat

_NAMED_BY_REFERENCE = ("ManagedComponent", "ManagedPort", "TechnicalPolicy")
"""Elements whose name is that of what they refer to."""


@dataclass(eq=False)
class _Element:
    """An element from its first line to its last; ``head`` are the lines of its start tag."""

    tag: str
    name: str
    names: frozenset[str]
    references: frozenset[str]
    around: _Element | None
    first: int
    head: range
    last: int = 0
    inside: list[_Element] = field(default_factory=list)

    @property
    def is_module(self) -> bool:
        """Whether it holds declarations."""
        return self.tag.endswith(("Module", "Model"))

    @property
    def is_declaration(self) -> bool:
        """Whether it stands in a module, and is none."""
        return not self.is_module and (self.around is None or self.around.is_module)

    @property
    def is_member(self) -> bool:
        """Whether it stands in a declaration."""
        return not self.is_module and not self.is_declaration

    def all_inside(self) -> Iterator[_Element]:
        yield self
        for one in self.inside:
            yield from one.all_inside()

    def all_around(self) -> Iterator[_Element]:
        around = self.around
        while around is not None:
            yield around
            around = around.around


@functools.lru_cache(16384)
def related_lines(
    text: str, changed: frozenset[int], before: str = "", left: frozenset[int] = frozenset()
) -> frozenset[int]:
    """The lines of ``text`` on which a diagnostic of the ``changed`` ones may stand; all lines if ``text`` is no XML.

    These are the lines of the changed elements, of the elements around and inside them, and of elements that share a name with
    them or with the declaration around them; then those of everything that refers to the changed declaration, directly or through
    other declarations, because a consequence may show there. Names count that stand in the changed lines, and those that stood
    in ``left``, the lines of the model ``before`` which the change took away.
    """
    try:
        elements = _elements(text)
        old = _elements(before) if before else []
    except expat.ExpatError:
        return frozenset(range(1, text.count("\n") + 2))
    touched = _touched(elements, changed)
    gone = _touched(old, left)
    names = _names(touched | gone)
    related = touched.union(one for one in elements if names & one.names)
    declared = {d.name for one in touched | gone for d in (one, *one.all_around()) if d.is_declaration and d.name}
    related |= _users(elements, declared)
    lines = {line for one in related for e in (one, *one.all_around()) for line in (*e.head, e.last)}
    return frozenset(lines | changed)


def _touched(elements: Sequence[_Element], changed: frozenset[int]) -> set[_Element]:
    """The elements that begin in ``changed`` lines with all inside, and for each other line the innermost one that spans it."""
    begun = [one for one in elements if changed.intersection(one.head)]
    touched = {inner for one in begun for inner in one.all_inside()}
    for line in changed.difference(*(one.head for one in begun)):
        touched.update([one for one in elements if one.first <= line <= one.last][-1:])
    return touched


def _names(touched: Collection[_Element]) -> frozenset[str]:
    """The names in ``touched``, and in what is around them up to a module."""
    around = (outer for one in touched for outer in one.all_around() if not outer.is_module)
    return frozenset(name for one in (*touched, *around) for name in one.names)


def _users(elements: Sequence[_Element], declared: Collection[str]) -> set[_Element]:
    """What refers to one of ``declared``, or to a declaration with such an element; each with the elements that it holds, and
    with those beside it inside a declaration, such as the other ends of a connection.
    """
    users: set[_Element] = set()
    waiting, known = set(declared), set(declared)
    while waiting:
        found = {one for one in elements if waiting & one.references}
        waiting = set()
        for one in found - users:
            holder = one.around if one.around is not None and one.around.is_member else one
            users.update(holder.all_inside())
            waiting.update(d.name for d in (one, *one.all_around()) if d.is_declaration and d.name)
        waiting -= known
        known |= waiting
    return users


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
        name = attributes.get("name", "")
        own = () if tag in _NAMED_BY_REFERENCE else ("name",)
        references = frozenset(_words({a: v for a, v in attributes.items() if a not in own}))
        one = _Element(tag, name, frozenset(_words(attributes)), references, around, first, range(first, end + 1))
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
