"""Differences between a value as sent and as arrived, and the type that is the reason (10.1.1).

The innermost type that differs is the reason, unless the same value of it was carried well elsewhere with no more around it:
then what is around it is. Pure comparison of data; clause_10_1_1.py says what is compared.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import msgspec

from ucm_cts.adapters.contract import data_types as d
from ucm_cts.adapters.contract.data_values import components_of, flat, is_nan, misfit

_REQUIREMENTS: dict[type, str] = {
    d.Integer: "R-10.1.1-07",
    d.Float: "R-10.1.1-08",
    d.Char: "R-10.1.1-09",
    d.Boolean: "R-10.1.1-10",
    d.String: "R-10.1.1-11",
    d.Enumeration: "R-10.1.1-12",
    d.Structure: "R-10.1.1-13",
    d.Union: "R-10.1.1-14",
    d.Array: "R-10.1.1-15",
    d.Sequence: "R-10.1.1-16",
    d.Alias: "R-10.1.1-17",
}
AT_ANY_DEPTH = "R-10.1.1-18"

REQUIREMENTS = (*_REQUIREMENTS.values(), AT_ANY_DEPTH)
"""The requirements on types, each that a type is carried."""

_COMPOSITE = (d.Structure, d.Union, d.Array, d.Sequence)
_WITH_PARTS = (*_COMPOSITE, d.Alias)


class Part(msgspec.Struct, frozen=True):
    """A value inside another one: its type, and what of other types it is in."""

    of: d.AnyType
    value: d.Datum
    around: tuple[Part, ...] = ()
    place: str = ""

    @property
    def key(self) -> bytes:
        """The same for equal values of equal types."""
        return msgspec.json.encode((self.of, self.value))


class Difference(msgspec.Struct, frozen=True):
    """``part`` was sent, and ``got`` arrived in its place."""

    part: Part
    got: object

    @property
    def is_nan(self) -> bool:
        """Are both NaN, with other bits?"""
        of, sent = self.part.of, self.part.value
        if not isinstance(of, d.Float) or not isinstance(sent, str) or not isinstance(self.got, str):
            return False
        return len(sent) == len(self.got) and is_nan(of, sent) and not misfit(of, self.got) and is_nan(of, self.got)


@dataclass
class Evidence:
    """The values that were carried well in one trace: how little was around each."""

    least: dict[bytes, int] = field(default_factory=dict)

    def add(self, of: d.AnyType, value: d.Datum) -> None:
        """``value`` has arrived as it was sent."""
        for part in inside(Part(of, value)):
            key, depth = part.key, len(part.around)
            self.least[key] = min(depth, self.least.get(key, depth))

    def broken_by(self, part: Part) -> str:
        """The requirement that was broken when ``part`` was not carried well."""
        chain = (*part.around, part)
        unseen = [index for index, one in enumerate(chain) if self.least.get(one.key, index + 1) > index]
        reason = unseen[-1] if unseen else len(chain) - 1
        return requirement_of(chain[reason].of, is_innermost=reason == len(chain) - 1)


def requirement_of(of: d.AnyType, is_innermost: bool = False) -> str:
    """The requirement that asks for values of ``of``: as such, if it is the innermost that matters, else at any depth."""
    if not is_innermost and isinstance(of, _COMPOSITE) and any(isinstance(o, _COMPOSITE) for o in _made_of(of)):
        return AT_ANY_DEPTH
    return _REQUIREMENTS[type(of)]


def requirements_of(of: d.AnyType, value: d.Datum) -> set[str]:
    """All requirements that a value exercises when it is carried well."""
    if not isinstance(of, _WITH_PARTS):
        return {_REQUIREMENTS[type(of)]}
    return set(_exercised(of, value, False))


def _exercised(of: d.AnyType, value: d.Datum, is_inside: bool) -> Iterator[str]:
    yield _REQUIREMENTS[type(of)]
    is_composite = isinstance(of, _COMPOSITE)
    if is_inside and is_composite:
        yield AT_ANY_DEPTH
    for _, part, one in components_of(of, value):
        yield from _exercised(part, one, is_inside or is_composite)


def _made_of(of: d.AnyType) -> Iterator[d.AnyType]:
    """The types that ``of`` directly contains; of an alias, the one that it names."""
    match of:
        case d.Structure():
            contained = list(of.fields.values())
        case d.Union():
            contained = [case.of for case in of.cases]
        case d.Array() | d.Sequence():
            contained = [of.of]
        case _:
            contained = []
    return map(plain, contained)


def plain(of: d.AnyType) -> d.AnyType:
    """``of`` without the aliases around it."""
    while isinstance(of, d.Alias):
        of = of.of
    return of


def inside(part: Part) -> Iterator[Part]:
    """``part`` and all parts of it."""
    yield part
    for place, of, value in components_of(part.of, part.value):
        yield from inside(Part(of, value, (*part.around, part), place))


def differences(part: Part, got: object) -> Iterator[Difference]:
    """Where ``got`` differs from ``part``, which was sent: the innermost types that do."""
    of, sent = part.of, part.value
    arrived: list[Any] | None
    if isinstance(of, _COMPOSITE):
        arrived = _arrived(of, sent, got)
        if arrived is None:
            yield Difference(part, got)
            return
    elif isinstance(of, d.Alias):
        arrived = [got]
    else:
        if type(got) is not type(sent) or got != sent:
            yield Difference(part, got)
        return
    pairs = zip(components_of(of, sent), arrived, strict=True)
    for (place, inner, value), one in pairs:
        yield from differences(Part(inner, value, (*part.around, part), place), one)


def distance(one: object, other: object) -> float:
    """The distance of two data of any types, from 0 to 1; each part of a list has the same weight."""
    if one == other:
        return 0
    if isinstance(one, list | tuple) and isinstance(other, list | tuple):
        longer = max(len(one), len(other))
        return (longer - min(len(one), len(other)) + sum(map(distance, one, other))) / longer
    return 1


def _arrived(of: d.AnyType, sent: d.Datum, got: object) -> list[d.Datum] | None:
    """What arrived for each direct part of ``sent``; None if the whole is of another shape, or in another order."""
    assert isinstance(sent, list)
    if not isinstance(got, list) or len(got) != len(sent):
        return None
    if isinstance(of, d.Union):
        of_another_case = misfit(of, got) and not all(misfit(case.of, got[1]) for case in of.cases)
        return None if got[0] != sent[0] or of_another_case else [got[1]]
    dimensions = len(of.sizes) if isinstance(of, d.Array) else 1
    if dimensions > 1 and _shape(got, dimensions) != _shape(sent, dimensions):
        return None
    arrived, wanted = flat(got, dimensions), flat(sent, dimensions)
    return None if _is_another_order(wanted, arrived) else arrived


def _shape(value: object, dimensions: int) -> object:
    if dimensions == 0:
        return None
    return [_shape(one, dimensions - 1) for one in value] if isinstance(value, list) else ()


def _is_another_order(sent: list[d.Datum], got: list[d.Datum]) -> bool:
    """Are the same values at other places, in any order?"""
    if got == sent:
        return False
    before, after = list(map(_unordered, sent)), list(map(_unordered, got))
    return before != after and Counter(before) == Counter(after)


def _unordered(value: object) -> str:
    return f"[{', '.join(sorted(map(_unordered, value)))}]" if isinstance(value, list) else repr(value)
