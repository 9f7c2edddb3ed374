"""Traits: the meaning of a step's fields, declared with the step and read by everything that handles steps.

    id: Annotated[str, Uses("component")]
    bind: Annotated[str, Binds("connection")]

Traits of a whole step (how often it waits, which event ends it, its wording) are class variables of ``StepBase``.
"""

from __future__ import annotations

import functools
import typing
from dataclasses import dataclass
from typing import Literal

from ucm_cts.adapters.contract.value import Value

Kind = Literal["link", "container", "component", "reference", "connection"]
"""The kinds of things that variables hold."""

Subject = Literal[
    "implementation", "component", "port element", "interface", "gate", "worker", "method", "payload", "attribute"
]
"""What a field may refer to beside variables. An ``implementation`` need not be declared, a ``component`` must be; for
``attribute`` the field holds values by name.
"""


@dataclass(frozen=True)
class Uses:
    """The field names a variable that must hold a thing of this ``kind``, or one of ``stand_ins`` (``unknown``, ``nil``)."""

    kind: Kind
    stand_ins: tuple[str, ...] = ()


@dataclass(frozen=True)
class Binds:
    """The field names the variable that the step binds to a thing of this ``kind``.

    If it is empty, the field ``otherwise`` names the variable.
    """

    kind: Kind
    otherwise: str = ""


@dataclass(frozen=True)
class Names:
    """The field refers to a ``subject`` that is no variable."""

    subject: Subject


@dataclass(frozen=True)
class Lasts:
    """The field is a number of milliseconds; the step takes at least ``at_least`` times and at most ``times`` times as long."""

    times: int = 1
    at_least: int = 1


Trait = Uses | Binds | Names | Lasts


@functools.cache
def fields(step: type[Value]) -> tuple[tuple[str, Trait], ...]:
    """The fields of a type of step that have a trait, each with its trait.

    Used variables come in the order in which a host looks them up: link, container, component, reference, connection.
    """
    hints = typing.get_type_hints(step, include_extras=True)
    found = [
        (name, trait)
        for name, hint in hints.items()
        for trait in getattr(hint, "__metadata__", ())
        if isinstance(trait, Trait)
    ]
    order = typing.get_args(Kind)
    return tuple(sorted(found, key=lambda one: order.index(one[1].kind) if isinstance(one[1], Uses) else -1))


@functools.cache
def _using(step: type[Value]) -> tuple[tuple[str, Uses], ...]:
    return tuple((field, trait) for field, trait in fields(step) if isinstance(trait, Uses))


@functools.cache
def _binding(step: type[Value]) -> tuple[tuple[str, Binds], ...]:
    return tuple((field, trait) for field, trait in fields(step) if isinstance(trait, Binds))


@functools.cache
def _lasting(step: type[Value]) -> tuple[tuple[str, Lasts], ...]:
    return tuple((field, trait) for field, trait in fields(step) if isinstance(trait, Lasts))


def uses(step: Value) -> tuple[tuple[str, Uses], ...]:
    """The variables that ``step`` reads, each with the trait of its field."""
    found: list[tuple[str, Uses]] = []
    for field, trait in _using(type(step)):
        value = getattr(step, field)
        found += [(variable, trait) for variable in ((value,) if isinstance(value, str) else value)]
    return tuple(found)


def used_by(step: Value) -> tuple[str, ...]:
    """The variables that ``step`` reads."""
    found: list[str] = []
    for field, _ in _using(type(step)):
        value = getattr(step, field)
        found += (value,) if isinstance(value, str) else value
    return tuple(found)


def bindings(step: Value) -> tuple[tuple[str, Kind], ...]:
    """The variables that ``step`` binds, each with the kind of thing that it then holds."""
    return tuple(
        [(getattr(step, field) or getattr(step, trait.otherwise), trait.kind) for field, trait in _binding(type(step))]
    )


def bound_by(step: Value) -> tuple[str, ...]:
    """The variables that ``step`` binds."""
    bound = _binding(type(step))
    return tuple([getattr(step, field) or getattr(step, trait.otherwise) for field, trait in bound]) if bound else ()


def named(step: Value, subject: Subject) -> tuple[str, ...]:
    """The things of this sort that ``step`` refers to."""
    return tuple(
        getattr(step, field)
        for field, trait in fields(type(step))
        if isinstance(trait, Names) and trait.subject == subject
    )


def duration(step: Value) -> tuple[int, int]:
    """How many milliseconds ``step`` takes at least, and at most; waits are not counted."""
    found = _lasting(type(step))
    if not found:
        return 0, 0
    lasting = [(getattr(step, field), trait) for field, trait in found]
    return sum(time * trait.at_least for time, trait in lasting), sum(time * trait.times for time, trait in lasting)
