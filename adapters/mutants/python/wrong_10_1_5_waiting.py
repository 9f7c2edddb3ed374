"""Wrong frameworks, clause 10.1.5: service connectors that leave clients waiting, or do not let them wait."""

from __future__ import annotations

import threading
from collections.abc import Sequence

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.registry import Base, breaks
from ucm_cts.adapters.mutants.python.wrong_10_1_5 import Services
from ucm_cts.adapters.reference.python.connectors import Link, Taker
from ucm_cts.adapters.reference.python.framework import Container, Member

_CLAUSES = ("10.1.5",)
_CALLS, _CLIENTS, _OWN, _BLOCKING = "R-10.1.5.1-01", "R-10.1.5.1-03", "R-10.1.5.1-04", "R-10.1.5.1-11"
_IN_FLIGHT = "R-10.1.5.1-12"


@breaks(_BLOCKING, clauses=_CLAUSES, also=(_IN_FLIGHT, _OWN, _CALLS, "R-10.1.3.2-17"))
class does_not_wait_long(Services):
    """Who waits too long for a server gets zeros."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        outcome: list[Sequence[Datum]] = []
        raised: list[Exception] = []

        def ask() -> None:
            try:
                outcome.append(Link._request(self, method, arguments))
            except Exception as error:  # noqa: BLE001 - whatever it is, the caller gets it
                raised.append(error)

        asking = threading.Thread(target=ask, daemon=True)
        asking.start()
        asking.join(0.005)
        if raised:
            raise raised[0]
        return outcome[0] if outcome else self.nothing(method)


@breaks(_IN_FLIGHT, clauses=_CLAUSES)
class forgets_clients_of_stopped_servers(Services):
    """When a server is being stopped, the results it still gives reach nobody."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        server = self.server if self.takers else None
        results = super()._request(method, arguments)
        if server is not None and not server.entrance.is_open and self.is_crowded(server):
            threading.Event().wait()
        return results

    def is_crowded(self, server: Taker) -> bool:
        """In some of the scenarios only: waiting in vain takes time."""
        return len(self.manager.connections) > 1 and not server.member.execution.definition


@breaks(_IN_FLIGHT, clauses=_CLAUSES)
class invents_results_of_stopped_servers(Services):
    """When a server is being stopped, clients get zeros."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        server = self.server if self.takers else None
        results = super()._request(method, arguments)
        return results if server is None or server.entrance.is_open else self.nothing(method)


@breaks(_IN_FLIGHT, clauses=_CLAUSES, also=("R-12.10-10",))
class never_stops_what_was_called(Base):
    """stop does not end if a server was executing several calls when it came."""

    def _close_entrances(self, member: Member) -> None:
        for _, taker in self._takers_of(member):
            several = taker.entrance._inside > 1
            taker.entrance.close()
            if several and not member.execution.definition:
                threading.Event().wait()


class _Undone(Services):
    """May be undone while everything is started."""

    undone = False

    def detach(self, container: Container, comp_instance: int, port: str) -> None:
        if not container.is_started:
            super().detach(container, comp_instance, port)
            return
        self.undone = True

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        results = super()._request(method, arguments)
        if self.undone:
            self.answer_undone()
        return results

    def answer_undone(self) -> None:
        raise NotImplementedError


@breaks(_IN_FLIGHT, clauses=_CLAUSES, also=(_CALLS, _CLIENTS))
class forgets_clients_of_undone_connections(_Undone):
    """A connection may be undone at any time, and who is just calling waits for ever."""

    def answer_undone(self) -> None:
        if not self.server.member.execution.definition and len(self.manager.connections) > 1:
            threading.Event().wait()


@breaks(_IN_FLIGHT, clauses=_CLAUSES, also=(_CALLS, _CLIENTS), readings={"call-in-flight": "finishes"})
class aborts_calls_of_undone_connections(_Undone):
    """Calls whose connection is undone end with an exception; they were declared to finish."""

    def answer_undone(self) -> None:
        raise UcmError("the connection has been undone")
