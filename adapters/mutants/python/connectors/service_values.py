"""Wrong frameworks, clause 10.1.5: service connectors that alter, lose or swallow values and exceptions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import ClassVar, TypeVar

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import DeclaredException, UcmError
from ucm_cts.adapters.mutants.python.connectors.service_calls import Services
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import Base, Row, breaks, family
from ucm_cts.adapters.reference.python.members import Member

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


_KEPT = {
    "passes_inout_one_way": Row(_DIRECTIONS, "INOUT parameters come back as they were sent.", "INOUT"),
    "passes_one_out_parameter": Row(_DIRECTIONS, "All OUT parameters have the value of the first result.", "OUT"),
}
family(_Keeps, "direction", _KEPT, clauses=_CLAUSES)


@replaces("_request", _DIRECTIONS, clauses=_CLAUSES)
def puts_the_result_first(self: Services, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """The result comes before the other values even if it was declared later."""
    results = list(Services._request(self, method, arguments))
    directions = [p.direction for p in self.parameters(method)]
    if "RETURN" in directions and len(results) == len(directions):
        results.insert(0, results.pop(directions.index("RETURN")))
    return results


@replaces("_request", _DIRECTIONS, clauses=_CLAUSES)
def sends_no_inout_values(self: Services, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """INOUT parameters have no value when the server gets them."""
    sent = [
        value if p.direction == "IN" else 0 if isinstance(value, int) else ""
        for p, value in zip(self.interface.methods[method].arguments, arguments, strict=True)
    ]
    return Services._request(self, method, sent)


# exceptions


class _Catches(Services):
    """A client gets what ``caught`` makes of an exception of the server."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        try:
            return super()._request(method, arguments)
        except DeclaredException as error:
            return self.caught(method, error)

    def caught(self, method: str, error: DeclaredException) -> Sequence[Datum]:
        raise NotImplementedError


@replaces("caught", _EXCEPTIONS, clauses=_CLAUSES)
def loses_exceptions(self: _Catches, method: str, *_: object) -> Sequence[Datum]:
    """A method that ends with an exception returns empty results instead."""
    return self.nothing(method)


@replaces("caught", _EXCEPTIONS, clauses=_CLAUSES, also=("R-10.1.1-07",), readings={"exception-transport": "full"})
def loses_the_fields_of_exceptions(_self: _Catches, _method: str, error: DeclaredException) -> Sequence[Datum]:
    """Exceptions arrive, with nothing in their fields."""
    raise DeclaredException(error.name, ["" if isinstance(f, str) else 0 for f in error.fields])


@replaces("caught", _EXCEPTIONS, clauses=_CLAUSES, readings={"exception-transport": "full"})
def mistakes_exceptions(self: _Catches, method: str, error: DeclaredException) -> Sequence[Datum]:
    """Every exception arrives as the last one that the method declares."""
    last = self.interface.methods[method].raises[-1]
    raise DeclaredException(last.name, error.fields[: len(last.fields)])


@replaces("caught", _EXCEPTIONS, clauses=_CLAUSES, readings={"exception-transport": "full"})
def knows_one_exception(self: _Catches, method: str, error: DeclaredException) -> Sequence[Datum]:
    """Every exception arrives as the first one that the method declares."""
    first = self.interface.methods[method].raises[0]
    raise DeclaredException(first.name if len(first.fields) == len(error.fields) else error.name, error.fields)


@replaces("caught", _EXCEPTIONS, clauses=_CLAUSES, readings={"exception-transport": "full"})
def raises_its_own_exceptions(_self: _Catches, _method: str, error: DeclaredException) -> Sequence[Datum]:
    """The vendor declares that exceptions arrive unchanged; they arrive as errors of the framework."""
    raise UcmError(error.name)


@replaces("_execute_on_own_thread", _EXCEPTIONS, clauses=_CLAUSES, readings={"exception-transport": "full"})
def raises_its_own_exceptions_on_threads_of_components(self: Base, member: Member, work: Callable[[], T]) -> T:
    """An exception raised on the thread of an active component arrives as an error of the framework."""
    try:
        return Base._execute_on_own_thread(self, member, work)
    except DeclaredException as error:
        raise UcmError(error.name) from None


@replaces("_request", _EXCEPTIONS, clauses=_CLAUSES)
def swallows_what_is_not_declared(self: Services, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """An undeclared exception of a server is dropped, and the client gets empty results."""
    try:
        return Services._request(self, method, arguments)
    except (DeclaredException, UcmError):
        raise
    except Exception:  # noqa: BLE001 - a body may raise anything
        return self.nothing(method)


class _Meets(Services):
    """Knows how many calls are on their way, and what the last one that failed beside another ended with."""

    inside = 0
    failed: DeclaredException | None = None

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        self.inside += 1
        try:
            result = super()._request(method, arguments)
        except DeclaredException as error:
            if self.inside > 1:
                self.failed = error
            raise
        finally:
            self.inside -= 1
        failed, self.failed = self.failed, None
        return result if failed is None else self.beside(failed)

    def beside(self, failed: DeclaredException) -> Sequence[Datum]:
        """The end of a call during which another one failed."""
        raise failed


@breaks("R-10.1.5.1-04", clauses=_CLAUSES)
class hands_exceptions_to_other_clients(_Meets):
    """A call during which another client's call ended with an exception ends with that exception, too."""


@breaks("R-10.1.5.1-04", clauses=_CLAUSES)
class gives_up_other_calls_after_exceptions(_Meets):
    """A call during which another client's call ended with an exception ends with an error of the framework."""

    def beside(self, failed: DeclaredException) -> Sequence[Datum]:
        raise UcmError("the connection has failed")
