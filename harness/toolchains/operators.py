"""Edits that break legal models, one a rule, and edits that keep them legal; the engine that applies them.

An operator is a function that changes one element of a model (an lxml element in canonical spelling) in place. It returns False
where it does not apply. Each is registered for the tag of the elements that it changes, and applied at one place at a time.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from lxml import etree

Change = Callable[[etree._Element], object]

PLACES = 3
"""An operator is tried at so many places of one model, those with the most different surroundings first."""


@dataclass(frozen=True)
class Operator:
    """``change`` at an element of tag ``at`` breaks ``requirement``, or keeps the model legal if ``breaks`` is False.

    ``under`` are readings (``option=value``) that must be declared.
    """

    name: str
    requirement: str
    at: str
    change: Change
    breaks: bool
    under: tuple[str, ...] = ()

    @property
    def because(self) -> str:
        """Why the model is broken then, or still legal: the function's docstring."""
        return " ".join((self.change.__doc__ or self.name.replace("_", " ")).split()).rstrip(".")


OPERATORS: dict[str, Operator] = {}


def breaks(requirement: str, at: str, under: tuple[str, ...] = ()) -> Callable[[Change], Change]:
    """Register a function that breaks ``requirement`` by what it does to one ``at`` element; its docstring says why."""
    return _registering(requirement, at, under, True)


def keeps(requirement: str, at: str, under: tuple[str, ...] = ()) -> Callable[[Change], Change]:
    """Register a function whose change of one ``at`` element is legal by ``requirement``."""
    return _registering(requirement, at, under, False)


def _registering(requirement: str, at: str, under: tuple[str, ...], broken: bool) -> Callable[[Change], Change]:
    def register(change: Change) -> Change:
        name = change.__name__
        assert name not in OPERATORS, f"two operators are called {name}"
        OPERATORS[name] = Operator(name, requirement, at, change, broken, under)
        return change

    return register


def applications(operator: Operator, root: etree._Element, most: int = PLACES) -> Iterator[tuple[str, etree._Element]]:
    """Changed copies of the model at ``root``, each with the place that was changed, at most ``most`` of them."""
    seen: set[tuple[str, ...]] = set()
    found = 0
    for element in root.iter(operator.at):
        surroundings = _surroundings(element)
        if found == most:
            return
        if surroundings in seen:
            continue
        copied = copy.deepcopy(root)
        place = root.getroottree().getpath(element)
        target = _at(copied, place)
        if operator.change(target) is not False:
            seen.add(surroundings)
            found += 1
            yield f"{operator.at} {element.get('name') or place}", copied


def _at(root: etree._Element, place: str) -> etree._Element:
    found: Any = root.getroottree().xpath(place)
    element: etree._Element = found[0]
    return element


def _surroundings(element: etree._Element) -> tuple[str, ...]:
    """What tells places apart: the kinds of what is around and inside an element."""
    around = (str(e.tag) for e in element.iterancestors())
    inside = sorted({str(e.tag) for e in element.iterdescendants()})
    return (*around, "/", *inside)
