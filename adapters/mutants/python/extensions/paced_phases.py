"""Wrong frameworks, clause 10.5.2: components are executed outside of their operational phase, or otherwise after a restart."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import TypeVar

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import PACED, Base, breaks
from ucm_cts.adapters.reference.python.execution import Trigger
from ucm_cts.adapters.reference.python.members import Failures, Member
from ucm_cts.adapters.reference.python.pacing import Pace, PacedExecutor

T = TypeVar("T")

_RUNS = ("R-10.5.2-01", "R-10.5.2-02", "R-10.5.2-03", "R-10.5.2-04", "R-10.5.2-05", "R-10.5.2-06", "R-10.5.2-21")


@breaks("R-10.5.2-20", clauses=PACED, also=_RUNS)
class forgets_to_cancel_the_offset(Base):
    """A run for which an offset passes is made although the component has been stopped."""

    def _await(self, trigger: Trigger, moment: float) -> bool:
        time.sleep(max(0.0, moment - time.monotonic()))
        return True

    def _run(self, member: Member, trigger: Trigger) -> None:
        if trigger.ended.is_set() and not member.__dict__.get("late"):
            member.__dict__["late"] = True
            self._execution_api(member).run()
        super()._run(member, trigger)

    def _run_paced(self, member: Member, trigger: Trigger) -> None:
        pace = member.execution.paces.get(None)
        number = 0
        while pace is not None and self._await(trigger, pace.tick(number)):
            is_over = trigger.ended.is_set()
            self._run(member, trigger)
            if is_over or pace.policy.definition == s.BACKGROUND:
                return
            number = pace.after_run(number)


@replaces("_end_execution", "R-10.5.2-20", clauses=PACED, also=_RUNS)
def runs_on_for_a_while(self: Base, member: Member) -> None:
    """A periodic component runs once more a moment after stop."""
    was_running = member.execution.trigger is not None and member.execution.extended
    Base._end_execution(self, member)
    if was_running and member.execution.extended[0].definition == s.PERIODIC_SELF_EXECUTING:
        threading.Timer(0.03, self._execution_api(member).run).start()


@replaces("_start_up", "R-10.5.2-20", clauses=PACED, also=_RUNS)
def runs_before_on_startup(self: Base, member: Member, failures: Failures) -> bool:
    """A self-executing component of 10.5 runs once before its on_startup."""
    if member.execution.extended and member.execution.definition == s.SELF_EXECUTING:
        self._execution_api(member).run()
    return Base._start_up(self, member, failures)


@breaks("R-10.5.2-20", clauses=PACED, also=("R-10.5.2-09", "R-10.5.2-14", "R-10.5.2-08", "R-10.5.2-13"))
class executes_waiting_calls_after_stop(PacedExecutor):
    """Calls that wait when the component is stopped are executed afterwards."""

    def end(self) -> None:
        waiting, self._waiting = self._waiting, []
        super().end()

        def execute() -> None:
            for invocation in waiting:
                invocation.work()

        if waiting:
            threading.Timer(0.1, execute).start()


class _Restarts(Base):
    """Is told how many times a component has been started."""

    def _paces(self, member: Member, origin: float) -> dict[str | None, Pace]:
        paces = super()._paces(member, origin)
        phase = member.__dict__["phase"] = member.__dict__.get("phase", -1) + 1
        if phase:
            for pace in paces.values():
                self._change(pace)
        return paces

    def _change(self, pace: Pace) -> None:
        raise NotImplementedError


@breaks("R-10.5.2-21", clauses=PACED, also=("R-10.5.1-28", "R-10.5.1-29", "R-10.5.1-30"))
class ignores_the_offset_of_a_restart(_Restarts):
    """After a restart no offset passes."""

    def _change(self, pace: Pace) -> None:
        pace.first -= pace.offset


@breaks("R-10.5.2-21", clauses=PACED, also=_RUNS)
class ignores_the_period_of_a_restart(_Restarts):
    """After a restart the period of runs, and the least distance, are a third."""

    def _change(self, pace: Pace) -> None:
        pace.period /= 3


@breaks("R-10.5.2-21", clauses=PACED, also=_RUNS)
class does_not_run_after_a_restart(Base):
    """Self-executing components of 10.5 do not run after a restart."""

    def _run_paced(self, member: Member, trigger: Trigger) -> None:
        if not member.__dict__.get("ran"):
            member.__dict__["ran"] = True
            super()._run_paced(member, trigger)


@breaks("R-10.5.2-21", clauses=PACED, also=("R-10.5.2-09", "R-10.5.2-14", "R-10.5.1-30"))
class paces_the_first_phase_only(Base):
    """After a restart calls are executed at once."""

    def _execute_paced(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        if member.__dict__.get("phases", 0) > 1:
            return self._execute_alone(member, port, work)
        return super()._execute_paced(member, port, work)

    def _begin_pace(self, member: Member) -> None:
        member.__dict__["phases"] = member.__dict__.get("phases", 0) + 1
        super()._begin_pace(member)
