"""Frameworks whose receivers are slow or fail, start and stop (10.1.6), and a connector that delivers synchronously."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.contract.scenario import MESSAGE_CONNECTOR
from ucm_cts.adapters.mutants.python.methods import does_only_if, replaces
from ucm_cts.adapters.mutants.python.registry import Base, breaks
from ucm_cts.adapters.mutants.python.variants.messages import Holding, ReleasesHeld
from ucm_cts.adapters.reference.python.connectors import INTERNAL_ERROR, OK, Entrance, Link, Taker
from ucm_cts.adapters.reference.python.members import Failures, Member


class Synchronous(Link):
    """Messages are delivered by the emitter's thread."""

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        if self.broken:
            return super()._emit(method, arguments)
        for taker in self.takers:
            if taker.entrance.is_open:
                self._hand_over(taker, method, self._copied(arguments))
        return OK

    def _hand_over(self, taker: Taker, method: str, arguments: list[Datum]) -> None:
        with suppress(Exception):
            taker.enter(method, arguments)


_MESSAGES = ("10.1.6",)

# slow and failing receivers


@breaks("R-10.1.6.1-08", clauses=_MESSAGES)
class stops_at_receivers_that_fail(Synchronous):
    """When a receiver raises, those after it do not get the message; the emitter is answered ok."""

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        with suppress(Exception):
            return super()._emit(method, arguments)
        return OK

    def _hand_over(self, taker: Taker, method: str, arguments: list[Datum]) -> None:
        taker.enter(method, arguments)


@breaks("R-10.1.6.1-04", clauses=_MESSAGES)
class stops_and_tells_of_receivers_that_fail(Synchronous):
    """When a receiver raises, those after it do not get the message, and the emitter is answered internal_error."""

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        try:
            return super()._emit(method, arguments)
        except Exception:  # noqa: BLE001 - a body may raise anything
            return INTERNAL_ERROR

    def _hand_over(self, taker: Taker, method: str, arguments: list[Datum]) -> None:
        taker.enter(method, arguments)


class _SharedThread(Link):
    """One thread for all receivers of a connection."""

    def _post(self, taker: Taker, method: str, arguments: list[Datum]) -> None:
        first: Taker = self.__dict__.setdefault("first", Taker(taker.member, taker.port))
        first.messages.put([taker, arguments])
        if first.thread is None:
            first.thread = threading.Thread(target=self._deliver, args=(first, method), daemon=True)
            first.thread.start()

    def _deliver(self, taker: Taker, method: str) -> None:
        while (posted := taker.messages.get()) is not None:
            assert isinstance(posted, list)
            self._hand_over(method, *posted)

    def _hand_over(self, method: str, taker: Any, arguments: Any) -> None:
        with suppress(Exception):
            taker.enter(method, arguments)


@breaks("R-10.1.6.1-08", clauses=_MESSAGES)
class gives_up_when_a_receiver_fails(_SharedThread):
    """The thread that delivers ends when a receiver raises."""

    def _deliver(self, taker: Taker, method: str) -> None:
        with suppress(Exception):
            super()._deliver(taker, method)

    def _hand_over(self, method: str, taker: Any, arguments: Any) -> None:
        with suppress(UcmError):
            taker.enter(method, arguments)


@replaces("_post", "R-10.1.6.1-08", clauses=_MESSAGES)
def does_not_wait_for_slow_receivers(self: Link, taker: Taker, method: str, arguments: list[Datum]) -> None:
    """A message pushed while its receiver is busy is lost."""
    time.sleep(0.001)
    if not taker.entrance._inside:
        Link._post(self, taker, method, arguments)


@breaks("R-10.1.6.1-08", clauses=_MESSAGES, readings={"slow-receiver": "independent"})
class has_all_wait_for_slow_receivers(_SharedThread):
    """The vendor declares that receivers are independent; each waits for the others."""


# phases


class _AlwaysOpen(Entrance):
    @property
    def is_open(self) -> bool:
        return True

    def visit(self, work: Any) -> Sequence[Datum]:
        self._is_open = True
        return super().visit(work)


@replaces("_attach_taker", "R-10.1.6.1-09", clauses=_MESSAGES)
def delivers_in_every_phase(self: Link, member: Member, port: str) -> None:
    """Receivers get messages before they are started and after they are stopped."""
    Link._attach_taker(self, member, port)
    if self.connector == MESSAGE_CONNECTOR:
        self.takers[-1].entrance = _AlwaysOpen()


@breaks("R-10.1.6.1-09", clauses=_MESSAGES)
class delivers_after_stop(Base):
    """Messages that wait for a receiver are delivered after it has been stopped."""

    def _close_entrances(self, member: Member) -> None:
        pass

    def _shut_down(self, member: Member, failures: Failures) -> None:
        super()._shut_down(member, failures)
        for link, taker in self._takers_of(member):
            if link.connector != MESSAGE_CONNECTOR:
                taker.entrance.close()


@does_only_if("_close_entrances", "R-10.1.6.1-09", clauses=_MESSAGES)
def stop_closes_the_first_member_only(self: Base, member: Member) -> bool:
    """All stopped components but the first member still get messages."""
    return member is self.started[0]


@replaces("_close_entrances", "R-10.1.6.1-09", clauses=_MESSAGES)
def stop_closes_the_first_end_only(self: Base, member: Member) -> None:
    """A stopped component still gets messages of all its connections but the first."""
    for _, taker in self._takers_of(member)[:1]:
        taker.close()


@breaks("R-10.1.6.1-09", clauses=_MESSAGES, readings={"receiver-not-ready": "hold"})
class forgets_what_it_said_it_holds(Base):
    """The vendor declares that messages to receivers that are not operational are held; they are dropped."""


@breaks("R-10.1.6.1-09", clauses=_MESSAGES, readings={"receiver-not-ready": "error"})
class does_not_tell_of_unready_receivers(Base):
    """The vendor declares an error for receivers that are not operational; push returns ok."""


@breaks("R-10.1.6.1-09", clauses=_MESSAGES, readings={"pending-at-stop": "keep"})
class drops_what_it_said_it_keeps(Base):
    """The vendor declares that waiting messages are kept at stop; they are dropped."""


@breaks("R-10.1.6.1-09", clauses=_MESSAGES, readings={"pending-at-stop": "deliver"})
class drops_what_it_said_it_delivers(Base):
    """The vendor declares that waiting messages are delivered at stop; they are dropped."""


@breaks("R-10.1.6.1-09", clauses=_MESSAGES, readings={"pending-at-stop": "drop", "receiver-not-ready": "drop"})
class keeps_what_it_said_it_drops(ReleasesHeld):
    """The vendor declares that messages to receivers that are not operational are lost; they arrive after the start."""

    link_class = Holding
