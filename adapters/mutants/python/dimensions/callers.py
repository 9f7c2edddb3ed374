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


@replaces(
    "_keep_running",
    "R-10.1.3.2-01",
    clauses=POLICIES,
    readings={"run-trigger": "repeated"},
    also=("R-10.1.3.2-03",),
)
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

    def run_and_keep() -> None:
        try:
            trigger.run(body_run)
        except Exception:
            member.execution.lock.acquire()  # once more than it is released, before anybody who waits can have it
            raise

    while not trigger.ended.wait(self.period):
        try:
            self._execute(member, None, run_and_keep)
        except Exception:  # noqa: BLE001 - whatever the body raises
            trigger.ended.wait()
            return


@replaces("_exclusion", "R-10.1.3.2-13", clauses=POLICIES, also=_CALLS)
@contextmanager
def waits_a_fifth_of_a_second(_self: Base, member: Member, _port: str | None) -> Iterator[None]:
    """Who has waited for 200 ms is let into a protected component."""
    lock = member.execution.lock
    got = lock.acquire(timeout=0.2)
    try:
        yield
    finally:
        if got:
            lock.release()


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
