"""Connectors that change values on their way by the types of the values, for mutants and variants."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ucm_cts.adapters.contract.data_types import Alias, AnyType, Array, Datum, Structure, Union
from ucm_cts.adapters.contract.data_types import Sequence as SequenceType
from ucm_cts.adapters.contract.data_values import case_of
from ucm_cts.adapters.mutants.python.registry import Row, family
from ucm_cts.adapters.reference.python.connectors import Link

Change = Callable[[Any, Any], Any]
"""Makes another value of a type and a value of it, whose parts have been changed already."""


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


class ChangingLink(Link):
    """A connector that makes ``change`` to all that it carries."""

    change: Change

    def send(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        described = self.interface.methods[method]
        results = super().send(method, self._changed([p.of for p in described.arguments], arguments) or arguments)
        is_message = self.connector == "simple_message_connector"
        return results if is_message else self._changed([p.of for p in described.results], results)

    def _changed(self, types: list[AnyType], values: Sequence[Datum]) -> list[Datum]:
        return [rebuilt(of, value, self.change) for of, value in zip(types, self._copied(values), strict=False)]


def register_carried(table: Mapping[str, Row]) -> None:
    """Make each row of ``table`` a mutant whose connectors change every value as the row says."""
    family(ChangingLink, "change", table, clauses=("10.1.1",))


def carries(requirement: str, kind: type = object, also: tuple[str, ...] = ()) -> Callable[[Change], Change]:
    """Register a change of values of ``kind`` as the mutant that makes it."""

    def register(change: Change) -> Change:
        register_carried({change.__name__: Row(requirement, change.__doc__ or "", made_to(kind, change), also)})
        return change

    return register


def made_to(kind: type, change: Change, *kinds: str) -> Change:
    """``change``, applied only to values of one class of types, and of ``kinds`` if there are any."""

    def only(of: Any, value: Any) -> Any:
        return change(of, value) if isinstance(of, kind) and (not kinds or getattr(of, "kind", "") in kinds) else value

    return only
