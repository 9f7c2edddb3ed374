"""Wrong frameworks, clause 10.3.2: callbacks enter protected components that are executed, are lost, or tell other times."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from contextlib import suppress

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.methods import alters
from ucm_cts.adapters.mutants.python.registry import MISSING_CALLBACKS, TIMED, Base, breaks
from ucm_cts.adapters.reference.python.connectors import Link
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.timers import Timer

_INSIDE = ("R-10.3.2-43", "R-10.3.2-44", "R-10.3.2-26")


@breaks("R-10.3.2-43", clauses=TIMED, also=_INSIDE)
class protects_from_no_callbacks(Base):
    """A callback enters a protected component while it is executed."""

    def _execute_callback(self, member: Member, work: Callable[[], None]) -> None:
        work()


class _Unprotected(Base):
    """The same, for components with the execution policy ``policy``."""

    policy = ""

    def _execute_callback(self, member: Member, work: Callable[[], None]) -> None:
        if member.execution.definition == self.policy:
            work()
        else:
            super()._execute_callback(member, work)


@breaks("R-10.3.2-43", clauses=TIMED, also=_INSIDE)
class protects_active_from_no_callbacks(_Unprotected):
    """A callback enters an active component while it is executed."""

    policy = s.ACTIVE


@breaks("R-10.3.2-43", clauses=TIMED, also=_INSIDE)
class protects_passive_from_no_callbacks(_Unprotected):
    """A callback enters a protected passive component while it is executed."""

    policy = s.PROTECTED_PASSIVE


@breaks("R-10.3.2-43", clauses=TIMED, also=_INSIDE)
class protects_self_executing_from_no_callbacks(_Unprotected):
    """A callback enters a self-executing component while it runs."""

    policy = s.SELF_EXECUTING


@breaks("R-10.3.2-43", clauses=TIMED, also=_INSIDE)
class protects_callbacks_from_no_calls(Base):
    """A call enters a protected component while a timer calls it back."""

    def _execute_callback(self, member: Member, work: Callable[[], None]) -> None:
        with suppress(RuntimeError):
            if self._is_protected(member):
                with member.execution.lock:
                    pass
        work()


@breaks("R-10.3.2-44", clauses=TIMED, also=(*MISSING_CALLBACKS, "R-10.3.2-43", "R-10.3.2-35"))
class loses_callbacks_of_busy_components(Base):
    """A timer that expires while its protected component is executed does not call back."""

    def _execute_callback(self, member: Member, work: Callable[[], None]) -> None:
        if not self._is_protected(member):
            super()._execute_callback(member, work)
        elif member.execution.lock.acquire(blocking=False):
            try:
                super()._execute_callback(member, work)
            finally:
                member.execution.lock.release()
        elif member.timers is not None:
            for number, timer in list(member.timers._waiting.items()):
                if timer.rate is None and timer.due <= time.monotonic():
                    member.timers._waiting.pop(number)


@alters("_told", "R-10.3.2-35", clauses=TIMED)
def tells_no_time(_self: Base, _told: list[Datum], _member: Member, _timer: Timer) -> list[Datum]:
    """Each callback tells a time of zero."""
    return [0, s.RELATIVE_TIME]


@alters("_told", "R-10.3.2-35", clauses=TIMED)
def tells_one_second_more(_self: Base, told: list[Datum], _member: Member, _timer: Timer) -> list[Datum]:
    """The time that is told is a second more than the one that was asked for."""
    return [int(told[0]) + 1, told[1]]  # type: ignore[arg-type]


@alters("_told", "R-10.3.2-35", clauses=TIMED)
def tells_the_other_flag(_self: Base, told: list[Datum], _member: Member, _timer: Timer) -> list[Datum]:
    """The flag that is told is the other one."""
    return [told[0], s.RELATIVE_TIME if told[1] == s.ABSOLUTE_TIME else s.ABSOLUTE_TIME]


@alters("_told", "R-10.3.2-35", clauses=TIMED)
def tells_relative_dates(self: Base, _told: list[Datum], member: Member, _timer: Timer) -> list[Datum]:
    """The time that is told is the date of the call, with the flag of relative times."""
    return [self._local_time(member) // 1_000_000_000, s.RELATIVE_TIME]


@alters("_told", "R-10.3.2-35", clauses=TIMED)
def tells_a_date_of_ten_seconds_ago(self: Base, _told: list[Datum], member: Member, _timer: Timer) -> list[Datum]:
    """The date that is told is ten seconds old."""
    return [self._local_time(member) // 1_000_000_000 - 10, s.ABSOLUTE_TIME]


@breaks("R-10.3.2-35", clauses=TIMED, readings={"callback-time": "now"})
class tells_requests_that_it_declares_dates(Base):
    """The time that is told is the one asked for, although the date of the call is declared."""


class _KnowsCallbacks(Link):
    """Fails when a component calls while it is called back."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if threading.current_thread().__dict__.get("is called back"):
            raise UcmError("no calls in callbacks")
        return super()._request(method, arguments)


@breaks("R-10.1.5.1-01", clauses=TIMED)
class serves_nobody_who_is_called_back(Base):
    """A component that is called back by its timer cannot call others."""

    link_class = _KnowsCallbacks

    def _call_body(self, member: Member, timer: Timer) -> None:
        thread = threading.current_thread()
        thread.__dict__["is called back"] = True
        try:
            super()._call_body(member, timer)
        finally:
            thread.__dict__["is called back"] = False
