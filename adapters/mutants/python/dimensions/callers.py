"""Several callers at once: components under each policy, and everything else that is shared (10.1.3, 10.1.4, 11.2)."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TypeVar

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import PortConnection, PortElementObject, UcmError
from ucm_cts.adapters.contract.scenario import ACTIVE, PROTECTED_PASSIVE, SELF_EXECUTING, UNPROTECTED_PASSIVE
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import POLICIES, Base, PeerProxy, Row, breaks, family
from ucm_cts.adapters.reference.python.connectors import Link, Taker
from ucm_cts.adapters.reference.python.execution import Trigger
from ucm_cts.adapters.reference.python.framework import Container
from ucm_cts.adapters.reference.python.members import Member

T = TypeVar("T")

_CALLS = (
    "R-10.1.3.2-17",
    "R-10.1.3.2-08",
    "R-10.1.3.2-15",
    "R-11.1.2-02",
    "R-11.1.3-01",
    "R-11.2.1.2-07",
    "R-11.2.3-03",
)
_THROUGH_CONNECTORS = ("R-10.1.2-10", "R-10.1.5.1-01", "R-10.1.5.1-03", "R-10.1.5.1-12")
_EXCLUSIONS = ("R-10.1.3.2-06", "R-10.1.3.2-09", "R-10.1.3.2-10", "R-10.1.3.2-13", "R-10.1.3.2-16")


class Crowded(Base):
    """Knows how many callers are in a component or wait for it."""

    definition = ""

    def _execute(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        if member.execution.definition != self.definition or port is None:
            return super()._execute(member, port, work)
        with self._counted(member) as crowd:
            return self._execute_in(crowd, member, port, work)

    @contextmanager
    def _counted(self, member: Member) -> Iterator[int]:
        lock: threading.Lock = member.__dict__.setdefault("crowd lock", threading.Lock())
        with lock:
            crowd = member.__dict__["crowd"] = member.__dict__.get("crowd", 0) + 1
        try:
            yield crowd
        finally:
            with lock:
                member.__dict__["crowd"] -= 1

    def _execute_in(self, crowd: int, member: Member, port: str, work: Callable[[], T]) -> T:
        """``crowd`` counts the caller, too."""
        return super()._execute(member, port, work)


class _Opens(Crowded):
    """The ``opened``-th caller enters at once."""

    opened = 3

    def _execute_in(self, crowd: int, member: Member, port: str, work: Callable[[], T]) -> T:
        return work() if crowd == self.opened else super()._execute_in(crowd, member, port, work)


class _OpensActive(_Opens):
    definition = ACTIVE


class _OpensProtected(_Opens):
    definition = PROTECTED_PASSIVE


class _OpensSelfExecuting(_Opens):
    definition = SELF_EXECUTING


class _Rejects(Crowded):
    """The ``rejected``-th caller is refused."""

    rejected = 3

    def _execute_in(self, crowd: int, member: Member, port: str, work: Callable[[], T]) -> T:
        if crowd >= self.rejected:
            raise UcmError("busy")
        return super()._execute_in(crowd, member, port, work)


class _RejectsActive(_Rejects):
    definition = ACTIVE


class _RejectsProtected(_Rejects):
    definition = PROTECTED_PASSIVE


class _RejectsSelfExecuting(_Rejects):
    definition = SELF_EXECUTING


for _base, _attribute, _rows in (
    (
        _OpensActive,
        "opened",
        {
            "active_lets_the_third_caller_in": Row(
                "R-10.1.3.2-09", "The third caller of an active component enters at once.", 3, _EXCLUSIONS
            ),
            "active_lets_the_sixth_caller_in": Row(
                "R-10.1.3.2-09", "The sixth caller of an active component enters at once.", 6, _EXCLUSIONS
            ),
        },
    ),
    (
        _OpensProtected,
        "opened",
        {
            "protected_lets_the_third_caller_in": Row(
                "R-10.1.3.2-13", "The third caller of a protected component enters at once.", 3, _EXCLUSIONS
            ),
            "protected_lets_the_eighth_caller_in": Row(
                "R-10.1.3.2-13", "The eighth caller of a protected component enters at once.", 8, _EXCLUSIONS
            ),
        },
    ),
    (
        _OpensSelfExecuting,
        "opened",
        {
            "self_executing_lets_the_third_caller_in": Row(
                "R-10.1.3.2-06", "The third caller of a self-executing component enters at once.", 3, _EXCLUSIONS
            ),
            "self_executing_lets_the_fifth_caller_in": Row(
                "R-10.1.3.2-06", "The fifth caller of a self-executing component enters at once.", 5, _EXCLUSIONS
            ),
        },
    ),
    (
        _RejectsActive,
        "rejected",
        {
            "active_rejects_the_fourth_caller": Row(
                "R-10.1.3.2-08",
                "The fourth caller of an active component is refused.",
                4,
                (*_CALLS, *_THROUGH_CONNECTORS),
            ),
            "active_rejects_the_eighth_caller": Row(
                "R-10.1.3.2-08",
                "The eighth caller of an active component is refused.",
                8,
                (*_CALLS, *_THROUGH_CONNECTORS),
            ),
        },
    ),
    (
        _RejectsProtected,
        "rejected",
        {
            "protected_rejects_the_third_caller": Row(
                "R-10.1.3.2-15",
                "The third caller of a protected component is refused.",
                3,
                (*_CALLS, *_THROUGH_CONNECTORS),
            ),
            "protected_rejects_the_seventh_caller": Row(
                "R-10.1.3.2-15",
                "The seventh caller of a protected component is refused.",
                7,
                (*_CALLS, *_THROUGH_CONNECTORS),
            ),
        },
    ),
    (
        _RejectsSelfExecuting,
        "rejected",
        {
            "self_executing_rejects_the_third_caller": Row(
                "R-11.2.1.2-07",
                "The third caller of a self-executing component is refused.",
                3,
                (*_CALLS, *_THROUGH_CONNECTORS),
            ),
        },
    ),
):
    family(_base, _attribute, _rows, clauses=POLICIES)


@breaks("R-10.1.3.2-21", clauses=POLICIES, also=("R-11.1.3-01", "R-11.2.1.1-02"))
class mixes_results_of_three_callers(Base):
    """Of three callers of an unprotected component that are inside one gets the result of another."""

    def _reference_to(self, member: Member, port: str) -> PortElementObject | None:
        element = super()._reference_to(member, port)
        if element is None or member.execution.definition != UNPROTECTED_PASSIVE:
            return element
        return member.execution.references.setdefault(port, _Mixing(element))


class _Mixing(PortElementObject):
    def __init__(self, target: PortElementObject) -> None:
        self.target = target
        self.inside = self.last = 0

    def exchange(self, value: int) -> int:
        self.inside += 1
        try:
            own = self.last = self.target.exchange(value)
            if self.inside < 3:
                return own
            time.sleep(0.005)
            return self.last
        finally:
            self.inside -= 1

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        return self.target.call(method, arguments)


# self-execution beside others


@replaces("_keep_running", "R-10.1.3.2-01", clauses=POLICIES, readings={"run-trigger": "repeated"})
def ends_running_after_a_failure(self: Base, member: Member, trigger: Trigger) -> None:
    """Once a run of one component raised, the other components of the runtime are not run any more."""

    def work() -> None:
        body_run = self._execution_api(member).run
        try:
            self._execute(member, None, lambda: trigger.run(body_run))
        except Exception:  # noqa: BLE001 - whatever the body raises
            self.manager.__dict__.setdefault("failed", member)

    while not trigger.ended.wait(self.period):
        if self.manager.__dict__.get("failed", member) is member:
            work()


@replaces("_keep_running", "R-10.1.3.2-17", clauses=POLICIES, also=(*_CALLS, "R-12.10-10"))
def locks_ports_after_a_failing_run(self: Base, member: Member, trigger: Trigger) -> None:
    """After a run that raised the ports of the component serve nobody."""
    body_run = self._execution_api(member).run
    while not trigger.ended.wait(self.period):
        try:
            self._execute(member, None, lambda: trigger.run(body_run))
        except Exception:  # noqa: BLE001 - whatever the body raises
            member.execution.lock.acquire()
            trigger.ended.wait()
            return


# calls between components


@breaks("R-11.1.3-01", also=("R-11.1.2-02", "R-11.2.3-03", "R-11.2.1.1-02", "R-11.2.1.2-07"))
class passes_values_in_one_slot(Base):
    """Calls between components at the same time share one place for their values."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = super()._dependencies_of(member)
        return [
            PortConnection(d.from_port, tuple(_Slot(t, member, self.manager) for t in d.to_port if t)) for d in given
        ]


class _Slot(PeerProxy):
    def __init__(self, target: PortElementObject, member: Member, manager: Container) -> None:
        super().__init__(target, member)
        self.slot = vars(manager)

    def exchange(self, value: int) -> int:
        self.slot["value"] = value
        time.sleep(0.001)
        return self.target.exchange(int(self.slot["value"]))


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


@replaces("_deliver", "R-10.1.6.1-08", clauses=("10.1.6",), also=("R-10.1.2-10", "R-10.1.6.1-04"))
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
