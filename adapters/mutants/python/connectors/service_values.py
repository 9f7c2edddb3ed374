"""Wrong frameworks, clause 10.1.5: service connectors that alter, lose or swallow values and exceptions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import ClassVar, TypeVar

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import DeclaredException, UcmError
from ucm_cts.adapters.mutants.python.connectors.service_calls import Services
from ucm_cts.adapters.mutants.python.registry import Base, breaks
from ucm_cts.adapters.reference.python.framework import Member

T = TypeVar("T")

_CLAUSES = ("10.1.5",)
_DIRECTIONS, _EXCEPTIONS = "R-10.1.5.1-08", "R-10.1.5.1-10"


class _Keeps(Services):
    direction: ClassVar[str]

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        results = list(super()._request(method, arguments))
        sent = {p.name: value for p, value in zip(self.interface.methods[method].arguments, arguments, strict=True)}
        for index, parameter in enumerate(self.parameters(method)):
            if parameter.direction == self.direction and index < len(results):
                results[index] = sent.get(parameter.name, results[index] if index == 0 else results[0])
        return results


@breaks(_DIRECTIONS, clauses=_CLAUSES)
class passes_inout_one_way(_Keeps):
    """INOUT parameters come back as they were sent."""

    direction = "INOUT"


@breaks(_DIRECTIONS, clauses=_CLAUSES)
class passes_one_out_parameter(_Keeps):
    """All OUT parameters have the value of the first result."""

    direction = "OUT"


@breaks(_DIRECTIONS, clauses=_CLAUSES)
class puts_the_result_first(Services):
    """The result comes before the other values, wherever it was declared."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        results = list(super()._request(method, arguments))
        directions = [p.direction for p in self.parameters(method)]
        if "RETURN" in directions and len(results) == len(directions):
            results.insert(0, results.pop(directions.index("RETURN")))
        return results


@breaks(_DIRECTIONS, clauses=_CLAUSES)
class sends_no_inout_values(Services):
    """INOUT parameters have no value when the server gets them."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        sent = [
            value if p.direction == "IN" else 0 if isinstance(value, int) else ""
            for p, value in zip(self.interface.methods[method].arguments, arguments, strict=True)
        ]
        return super()._request(method, sent)


# exceptions


class _Catches(Services):
    """What becomes of an exception that the server raised."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        try:
            return super()._request(method, arguments)
        except DeclaredException as error:
            return self.caught(method, error)

    def caught(self, method: str, error: DeclaredException) -> Sequence[Datum]:
        raise NotImplementedError


@breaks(_EXCEPTIONS, clauses=_CLAUSES)
class loses_exceptions(_Catches):
    """A method that ends with an exception returns nothing in particular."""

    def caught(self, method: str, error: DeclaredException) -> Sequence[Datum]:
        return self.nothing(method)


@breaks(_EXCEPTIONS, clauses=_CLAUSES, also=("R-10.1.1-07",), readings={"exception-transport": "full"})
class loses_the_fields_of_exceptions(_Catches):
    """Exceptions arrive, with nothing in their fields."""

    def caught(self, method: str, error: DeclaredException) -> Sequence[Datum]:
        raise DeclaredException(error.name, ["" if isinstance(f, str) else 0 for f in error.fields])


@breaks(_EXCEPTIONS, clauses=_CLAUSES, readings={"exception-transport": "full"})
class mistakes_exceptions(_Catches):
    """The last exception that a method declares arrives, whichever was raised."""

    def caught(self, method: str, error: DeclaredException) -> Sequence[Datum]:
        last = self.interface.methods[method].raises[-1]
        raise DeclaredException(last.name, error.fields[: len(last.fields)])


@breaks(_EXCEPTIONS, clauses=_CLAUSES, readings={"exception-transport": "full"})
class raises_its_own_exceptions(_Catches):
    """Exceptions arrive as one of the framework's; they were declared to arrive as they are."""

    def caught(self, method: str, error: DeclaredException) -> Sequence[Datum]:
        raise UcmError(error.name)


@breaks(_EXCEPTIONS, clauses=_CLAUSES, readings={"exception-transport": "full"})
class raises_its_own_exceptions_on_threads_of_components(Base):
    """What a method raises on the thread of its active component becomes an exception of the framework's own."""

    def _execute_on_own_thread(self, member: Member, work: Callable[[], T]) -> T:
        try:
            return super()._execute_on_own_thread(member, work)
        except DeclaredException as error:
            raise UcmError(error.name) from None


@breaks(_EXCEPTIONS, clauses=_CLAUSES)
class swallows_what_is_not_declared(Services):
    """A server that fails in its own way seems to have answered."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        try:
            return super()._request(method, arguments)
        except (DeclaredException, UcmError):
            raise
        except Exception:  # noqa: BLE001 - a body may raise anything
            return self.nothing(method)
