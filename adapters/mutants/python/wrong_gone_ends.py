"""Wrong frameworks, clauses 10.1.5 and 10.1.6: ends that are gone go on."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.scenario import SERVICE_CONNECTOR
from ucm_cts.adapters.mutants.python.registry import breaks
from ucm_cts.adapters.reference.python.connectors import Link, Taker

_CALLS, _ORIGIN = "R-10.1.5.1-01", "R-10.1.6.1-06"


class _Haunted(Link):
    """Whom it has lost it does not forget."""

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)  # type: ignore[arg-type]
        self.ghosts: list[Taker] = []

    def remove(self, taker: Taker) -> None:
        super().remove(taker)
        self.ghosts.append(taker)

    def _haunt(self, method: str, arguments: Sequence[Datum]) -> None:
        for taker in self.ghosts:
            element = taker.member.body.get_portElement(taker.port)
            with suppress(Exception):
                element.call(method, self._copied(arguments))  # type: ignore[union-attr]


@breaks(_ORIGIN, clauses=("10.1.6",))
class delivers_to_those_who_are_gone(_Haunted):
    """Receivers go on getting messages when they have been detached, or removed."""

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        code = super()._emit(method, arguments)
        self._haunt(method, arguments)
        return code


@breaks(_CALLS, clauses=("10.1.5",))
class is_served_by_those_who_are_gone(_Haunted):
    """A server goes on serving when it has been detached, unless there is another one."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if self.connector == SERVICE_CONNECTOR and not self.takers and self.ghosts:
            element = self.ghosts[-1].member.body.get_portElement(self.ghosts[-1].port)
            return self._copied(element.call(method, self._copied(arguments)))  # type: ignore[union-attr]
        return super()._request(method, arguments)
