"""Connectors that change values on their way, each place by its type: what wrong and unusual frameworks are made of."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

from ucm_cts.adapters.contract.data_types import Alias, AnyType, Array, Datum, Structure, Union
from ucm_cts.adapters.contract.data_types import Sequence as SequenceType
from ucm_cts.adapters.contract.data_values import case_of
from ucm_cts.adapters.mutants.python.registry import breaks
from ucm_cts.adapters.reference.python.connectors import Link

Change = Callable[[Any, Any], Any]
"""What becomes of a value of a type; what it is made of has been changed already."""


def rebuilt(of: AnyType, value: Any, change: Change) -> Any:
    """``value`` with ``change`` made to everything in it, the innermost first."""
    match of:
        case Alias():
            value = rebuilt(of.of, value, change)
        case Structure():
            value = [rebuilt(field, one, change) for field, one in zip(of.fields.values(), value, strict=True)]
        case Union():
            case = case_of(of, value[0])
            value = [value[0], rebuilt(case.of, value[1], change)] if case is not None else value
        case Array():
            value = _elements(of.of, value, len(of.sizes), change)
        case SequenceType():
            value = _elements(of.of, value, 1, change)
    return change(of, value)


def _elements(of: AnyType, value: Any, dimensions: int, change: Change) -> Any:
    if dimensions == 0:
        return value
    return [
        rebuilt(of, one, change) if dimensions == 1 else _elements(of, one, dimensions - 1, change) for one in value
    ]


def changing(change: Change, only_results: bool = False) -> type[Link]:
    """A connector that makes ``change`` to all that it carries, or to results only."""

    class ChangingLink(Link):
        def send(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
            described = self.interface.methods[method]
            sent = self._changed([p.of for p in described.arguments], [] if only_results else arguments) or arguments
            results = super().send(method, sent)
            is_message = self.connector == "simple_message_connector"
            return results if is_message else self._changed([p.of for p in described.results], results)

        def _changed(self, types: list[AnyType], values: Sequence[Datum]) -> list[Datum]:
            return [rebuilt(of, value, change) for of, value in zip(types, self._copied(values), strict=False)]

    return ChangingLink


class Carried(NamedTuple):
    """A framework whose connectors make ``change`` to every value, and so break ``requirement``."""

    requirement: str
    lie: str
    change: Change
    also: tuple[str, ...] = ()
    readings: Mapping[str, str] = {}


def register_carried(table: Mapping[str, Carried]) -> None:
    """Make each row of ``table`` a mutant."""
    for name, row in table.items():
        link = type(name, (changing(row.change),), {"__doc__": row.lie})
        breaks(row.requirement, clauses=("10.1.1",), also=row.also, readings=row.readings)(link)


def carries(requirement: str, kind: type = object, also: tuple[str, ...] = ()) -> Callable[[Change], Change]:
    """Register a change of values of ``kind`` as the mutant that makes it."""

    def register(change: Change) -> Change:
        row = Carried(requirement, change.__doc__ or "", made_to(kind, change), also)
        register_carried({change.__name__: row})
        return change

    return register


def made_to(kind: type, change: Change, *kinds: str) -> Change:
    """``change``, made to values of one sort of types only."""

    def only(of: Any, value: Any) -> Any:
        return change(of, value) if isinstance(of, kind) and (not kinds or getattr(of, "kind", "") in kinds) else value

    return only
