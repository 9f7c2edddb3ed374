"""What several components share: clock, log and connectors lose or mix what two of them do at once (10.1.4 to 10.1.6)."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TypeVar

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import Base, breaks
from ucm_cts.adapters.reference.python.connectors import Link, Taker
from ucm_cts.adapters.reference.python.members import Member

T = TypeVar("T")
_THROUGH_CONNECTORS = ("R-10.1.2-10", "R-10.1.5.1-01", "R-10.1.5.1-03", "R-10.1.5.1-12")


# clock and trace


class _Busy(Base):
    """Knows whether two threads use a service at once."""

    @contextmanager
    def _using(self) -> Iterator[bool]:
        runtime = vars(self.manager)
        runtime["users"] = runtime.get("users", 0) + 1
        time.sleep(0.001)
        try:
            yield runtime["users"] > 1
        finally:
            runtime["users"] -= 1


@breaks("R-10.1.4.1-09", clauses=("10.1.4",), also=("R-10.1.4.1-08", "R-10.1.4.1-06"))
class clock_gives_zero_to_two(_Busy):
    """Of two components that ask for local time at the same time one gets 0."""

    def _local_time(self, member: Member) -> int:
        with self._using() as contended:
            return 0 if contended else super()._local_time(member)


@breaks("R-10.1.4.1-06", clauses=("10.1.4",))
class clock_fails_for_two(_Busy):
    """Of two components that ask for synchronized time at the same time one is refused."""

    def _synchronized_time(self, member: Member) -> int:
        with self._using() as contended:
            if contended:
                raise UcmError("busy")
            return super()._synchronized_time(member)


@breaks("R-10.1.4.2-26", clauses=("10.1.4",))
class log_loses_one_of_two(_Busy):
    """Of two messages that are logged at the same time one is lost."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        with self._using() as contended:
            if not contended:
                super()._log(member, severity, message)


@breaks("R-10.1.4.2-26", clauses=("10.1.4",), also=("R-10.1.4.2-53", "R-10.1.4.2-47", "R-10.1.4.2-51"))
class log_mixes_two_texts(_Busy):
    """Messages that are logged at the same time get each other's text."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        self.manager.__dict__["text"] = message
        with self._using():
            super()._log(member, severity, self.manager.__dict__["text"])


@breaks("R-10.1.4.2-25", clauses=("10.1.4",))
class log_fails_for_two(_Busy):
    """Of two components that log at the same time one gets an exception."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        with self._using() as contended:
            if contended:
                raise UcmError("busy")
            super()._log(member, severity, message)


@breaks("R-10.1.4.2-32", clauses=("10.1.4",))
class port_trace_loses_one_of_two(_Busy):
    """Of two traced calls at the same time one leaves no record."""

    def _trace_call(self, member: Member, port: str, method: str, work: Callable[[], T]) -> T:
        with self._using() as contended:
            if contended:
                return work()
        return super()._trace_call(member, port, method, work)


# connectors


class _Slots(Link):
    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        self.__dict__["arguments"] = arguments
        time.sleep(0.001)
        given = self.__dict__["arguments"]
        return super()._request(method, given if len(given) == len(arguments) else arguments)


@breaks("R-10.1.5.1-01", clauses=("10.1.5",), also=("R-10.1.5.1-04", "R-10.1.5.1-08", "R-10.1.5.1-03"))
class services_share_arguments(_Slots):
    """Requests that are made at the same time share one place for their arguments."""


@breaks("R-10.1.6.1-03", clauses=("10.1.6",), also=("R-10.1.2-10", "R-10.1.6.1-04"))
class takes_one_push_at_a_time(Link):
    """Of messages that emitters push at the same time one is lost, and push returns ok."""

    pushing = 0

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        self.pushing += 1
        time.sleep(0.0005)
        try:
            return "ok" if self.pushing > 1 and not self.broken else super()._emit(method, arguments)
        finally:
            self.pushing -= 1


@breaks("R-10.1.2-09", clauses=("10.1.2",), also=("R-10.1.6.1-03",), readings={"message-overflow": "block"})
class refuses_a_second_push(Link):
    """Of messages that emitters push at the same time one gets internal_error; the vendor declares that push waits."""

    pushing = 0

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        self.pushing += 1
        time.sleep(0.0005)
        try:
            return "internal_error" if self.pushing > 1 and not self.broken else super()._emit(method, arguments)
        finally:
            self.pushing -= 1


@replaces("_deliver", "R-10.1.6.1-08", clauses=("10.1.6",), also=("R-10.1.2-10", "R-10.1.6.1-03", "R-10.1.6.1-04"))
def gives_up_after_three_failures(self: Link, taker: Taker, method: str) -> None:
    """Once receivers of a connection raised three times, none of them gets messages."""
    while (message := taker.messages.get()) is not None:
        if self.__dict__.get("failures", 0) >= 3:
            continue
        try:
            taker.enter(method, [message])
        except Exception:  # noqa: BLE001 - whatever the body raises
            self.__dict__["failures"] = self.__dict__.get("failures", 0) + 1


class _NotesFailedCalls(Link):
    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        try:
            return super()._request(method, arguments)
        except Exception:
            self.__dict__["failed"] = True
            raise


@breaks("R-12.10-10", clauses=("10.1.5",), also=("R-10.1.5.1-12",))
class waits_for_calls_that_failed(Base):
    """stop of a server does not end if a call of it ended with an exception."""

    link_class = _NotesFailedCalls

    def _close_entrances(self, member: Member) -> None:
        if any(link.__dict__.get("failed") for link, _ in self._takers_of(member)):
            threading.Event().wait()
        super()._close_entrances(member)


@breaks("R-10.1.5.1-01", clauses=("10.1.5",), also=("R-10.1.5.1-10", "R-10.1.5.1-03", "R-10.1.1-07"))
class closes_after_an_exception(Link):
    """After a server raised an exception, the next call of that connection is refused."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if self.__dict__.pop("failed", False):
            raise UcmError("the connection was closed")
        try:
            return super()._request(method, arguments)
        except Exception:
            self.__dict__["failed"] = bool(self.takers) and not self.broken
            raise
