"""The part of a container that executes components by a policy of 10.5. One concern each, for variants to override."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.reference.python.execution import Trigger
from ucm_cts.adapters.reference.python.members import HasMembers, Member
from ucm_cts.adapters.reference.python.pacing import Pace, PacedExecutor

T = TypeVar("T")


class PacesExecutions(HasMembers):
    """Executes what is periodic, sporadic or in the background."""

    pace_class: type[Pace] = Pace
    paced_executor_class: type[PacedExecutor] = PacedExecutor

    def _begin_pace(self, member: Member) -> None:
        """The component becomes operational: its offset begins to pass."""
        execution = member.execution
        if execution.paces:
            return
        execution.paces = self._paces(member, time.monotonic())
        if execution.definition == s.ACTIVE:
            execution.paced_executor = self.paced_executor_class(execution.paces.__getitem__)

    def _paces(self, member: Member, origin: float) -> dict[str | None, Pace]:
        """All managed port elements share the instants of the component."""
        pace = self.pace_class(member.execution.extended[0], origin)
        return {policy.port: pace for policy in member.execution.extended}

    def _end_pace(self, member: Member) -> None:
        """The component is about to be shut down; also called of one that has no pace."""
        execution = member.execution
        executor, execution.paced_executor = execution.paced_executor, None
        execution.paces = {}
        if executor is not None:
            executor.end()

    def _execute_paced(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        executor = member.execution.paced_executor
        if executor is None or port is None:
            raise pm.UcmError(f"component {member.id} is not operational")
        pace = member.execution.paces[port]
        return executor.execute(port, lambda: self._execute_alone(member, port, lambda: self._at_pace(pace, work)))

    def _at_pace(self, pace: Pace, work: Callable[[], T]) -> T:
        """The component is entered now."""
        pace.entered_at = time.monotonic()
        try:
            return work()
        finally:
            pace.left_at = time.monotonic()

    def _run_paced(self, member: Member, trigger: Trigger) -> None:
        """Run once when the offset has passed, and again each period if there is one."""
        pace = member.execution.paces.get(None)
        number = 0
        while pace is not None and self._await(trigger, pace.tick(number)):
            self._run(member, trigger)
            if member.execution.extended[0].definition == s.BACKGROUND:
                return
            number = pace.after_run(number)

    def _await(self, trigger: Trigger, moment: float) -> bool:
        """Wait for ``moment``; False if the phase ends before."""
        while (remaining := moment - time.monotonic()) > 0:
            if trigger.ended.wait(remaining):
                return False
        return not trigger.ended.is_set()

    # of the class that also executes components without a pace

    def _run(self, member: Member, trigger: Trigger) -> None:
        raise NotImplementedError

    def _execute_alone(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        raise NotImplementedError
