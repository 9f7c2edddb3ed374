"""Edits that break legal models, one a rule, and edits that keep them legal; the engine that applies them.

An operator is a function that changes one element of a model (an lxml element in canonical spelling) in place. It returns False
where it does not apply. Each is registered for the tags of the elements that it changes, and applied at one place at a time.
"""

from __future__ import annotations

import copy
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from lxml import etree

Change = Callable[[etree._Element], object]

PLACES = 3
"""An operator is applied at so many places of one model that differ in their surroundings."""

MOST = 6
"""Questions that one operator adds to the corpus at least if it can, beside one for each kind of place; whole models are
changed before small ones."""

TRIES = 4
"""An operator is tried at so many places of one kind, where it may turn out not to apply."""

Kind = tuple[str, str, bool]
"""A kind of place: its tag, that of what is around it, and whether it comes after others of its tag."""


@dataclass(frozen=True)
class Operator:
    """``change`` at an element of a tag in ``at`` breaks ``requirement``, or keeps the model legal if ``breaks`` is False.

    ``under`` are readings (``option=value``) that must be declared. One place is enough for those of a large ``family``,
    applied ``once``; the family is what one missing check lets through.
    """

    name: str
    requirement: str
    at: tuple[str, ...]
    change: Change
    breaks: bool
    under: tuple[str, ...] = ()
    once: bool = False
    of_family: str = ""

    @property
    def family(self) -> str:
        """That of many operators, or the operator itself."""
        return self.of_family or self.name

    @property
    def because(self) -> str:
        """Why the model is broken then, or still legal: the function's docstring."""
        return " ".join((self.change.__doc__ or self.name.replace("_", " ")).split()).rstrip(".")


OPERATORS: dict[str, Operator] = {}


def breaks(requirement: str, at: str | tuple[str, ...], under: tuple[str, ...] = ()) -> Callable[[Change], Change]:
    """Register a function that breaks ``requirement`` by what it does to one ``at`` element; its docstring says why."""
    return _registering(requirement, at, under, True)


def keeps(requirement: str, at: str | tuple[str, ...], under: tuple[str, ...] = ()) -> Callable[[Change], Change]:
    """Register a function whose change of one ``at`` element is legal by ``requirement``."""
    return _registering(requirement, at, under, False)


def family(requirement: str, at: str, names: tuple[str, str], because: str, change: Change, broken: bool) -> None:
    """Register one of many operators that differ in a value only, to be applied once; ``names`` are its own and the family's."""
    name, of = names
    assert name not in OPERATORS, f"two operators are called {name}"
    change.__doc__ = because
    OPERATORS[name] = Operator(name, requirement, (at,), change, broken, once=True, of_family=of)


def _registering(
    requirement: str, at: str | tuple[str, ...], under: tuple[str, ...], broken: bool
) -> Callable[[Change], Change]:
    def register(change: Change) -> Change:
        name = change.__name__
        assert name not in OPERATORS, f"two operators are called {name}"
        OPERATORS[name] = Operator(name, requirement, (at,) if isinstance(at, str) else at, change, broken, under)
        return change

    return register


class Applications:
    """Where an operator is applied in model after model: at places of every kind, and at ``MOST`` in all if there are so many."""

    def __init__(self, operator: Operator) -> None:
        self._operator = operator
        self._left = 1 if operator.once else MOST
        self._done: set[Kind] = set()
        self._in_vain: Counter[Kind] = Counter()

    def within(self, root: etree._Element) -> Iterator[tuple[str, etree._Element]]:
        """Changed copies of the model at ``root``, each with the place that was changed."""
        seen: set[tuple[str, ...]] = set()
        for element in root.iter(*self._operator.at):
            kind, surroundings = _kind(element), _surroundings(element)
            more = self._left > 0 and len(seen) < PLACES and surroundings not in seen
            if not more and (self._operator.once or kind in self._done or self._in_vain[kind] >= TRIES):
                continue
            copied = copy.deepcopy(root)
            place = root.getroottree().getpath(element)
            if self._operator.change(_at(copied, place)) is False:
                self._in_vain[kind] += 1
                continue
            seen.add(surroundings)
            self._done.add(kind)
            self._left -= 1
            yield f"{element.tag} {element.get('name') or place}", copied


def _kind(element: etree._Element) -> Kind:
    around = element.getparent()
    before = next(element.itersiblings(element.tag, preceding=True), None)
    return str(element.tag), ("" if around is None else str(around.tag)), before is not None


def _at(root: etree._Element, place: str) -> etree._Element:
    found: Any = root.getroottree().xpath(place)
    element: etree._Element = found[0]
    return element


def _surroundings(element: etree._Element) -> tuple[str, ...]:
    """The kinds of elements around and inside an element, by which places differ."""
    around = (str(e.tag) for e in element.iterancestors())
    inside = sorted({str(e.tag) for e in element.iterdescendants()})
    return (*around, "/", *inside)
