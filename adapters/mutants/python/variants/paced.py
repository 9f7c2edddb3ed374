"""Conformant frameworks, clause 10.5: what the text leaves open about execution by offset and period."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import PACED, Base, variant_of
from ucm_cts.adapters.reference.python.connectors import Link, Taker
from ucm_cts.adapters.reference.python.execution import Trigger
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.pacing import Invocation, Pace, PacedExecutor

T = TypeVar("T")


@variant_of(
    *PACED,
    readings={
        "offset-origin": "startup",
        "first-period": "offset",
        "period-anchor": "grid",
        "period-overrun": "queued",
        "background-again": "each-start",
        "periodic-active": "one-a-period",
        "paced-by": "component",
        "sporadic-measure": "starts",
        "early-invocation": "delayed",
        "parameter-values-checked": "refused",
        "priority-zero": "accepted",
    },
)
class declares_its_paces(Base):
    """The reference framework, with all that it does declared."""


@variant_of(*PACED, readings={"offset-origin": "start-call"})
class counts_from_the_call_of_start(Base):
    """An offset counts from the call of start."""

    def start(self) -> None:
        self.__dict__["called"] = time.monotonic()
        super().start()

    def _paces(self, member: Member, origin: float) -> dict[str | None, Pace]:
        return super()._paces(member, self.__dict__["called"])


@variant_of(*PACED, readings={"offset-origin": "start-return"})
class counts_from_the_return_of_start(Base):
    """An offset counts from a little after start has returned."""

    def _paces(self, member: Member, origin: float) -> dict[str | None, Pace]:
        return super()._paces(member, origin + 0.02)


@variant_of(*PACED, readings={"offset-origin": "system"})
class counts_from_the_first_start(Base):
    """The offsets of a first phase count from the first start of any container."""

    def start(self) -> None:
        self.manager.__dict__.setdefault("first_start", time.monotonic())
        super().start()

    def _paces(self, member: Member, origin: float) -> dict[str | None, Pace]:
        is_first = not member.__dict__.get("had_paces")
        member.__dict__["had_paces"] = True
        first: float = self.manager.__dict__["first_start"]
        return super()._paces(member, first if is_first else origin)


@variant_of(*PACED, readings={"first-period": "offset-plus-period"})
class runs_one_period_later(Pace):
    """The first instant of a period is one period after the offset."""

    def tick(self, number: int) -> float:
        return super().tick(number + 1)

    def tick_from(self, moment: float) -> int:
        return max(0, super().tick_from(moment) - 1)

    def _next_tick(self) -> int:
        return max(0, super()._next_tick() - 1)


@variant_of(*PACED, readings={"period-anchor": "chained", "period-overrun": "shifted"})
class runs_a_period_after_the_last(Base):
    """A period counts from the end of the run before."""

    def _run_paced(self, member: Member, trigger: Trigger) -> None:
        pace = member.execution.paces.get(None)
        if pace is None or member.execution.extended[0].definition == s.BACKGROUND:
            super()._run_paced(member, trigger)
            return
        due = pace.first
        while self._await(trigger, due):
            self._run(member, trigger)
            due = time.monotonic() + pace.period


@variant_of(*PACED, readings={"period-overrun": "skipped"})
class leaves_out_missed_runs(Pace):
    """Instants that pass during a run are left out."""

    def after_run(self, number: int) -> int:
        return max(number + 1, self.tick_from(time.monotonic()))


@variant_of(*PACED, readings={"period-overrun": "skipped"})
class begins_its_grid_with_its_thread(leaves_out_missed_runs):
    """The instants count from when a thread has begun, a little after start."""

    def __init__(self, policy: s.Policy, origin: float) -> None:
        super().__init__(policy, origin + 0.003)


@variant_of(*PACED, readings={"period-overrun": "merged"})
class merges_missed_runs(Pace):
    """One run follows at once for all instants that have passed during a run."""

    def after_run(self, number: int) -> int:
        return max(number + 1, self.tick_from(time.monotonic()) - 1)


@variant_of(*PACED, readings={"period-overrun": "shifted"})
class begins_the_grid_anew(Pace):
    """After a run that lasted for more than a period the periods count from its end."""

    def after_run(self, number: int) -> int:
        now = time.monotonic()
        if now > self.tick(number + 1):
            self.first = now - (number + 1) * self.period
        return number + 1


@variant_of(*PACED)
class runs_no_more_after_an_exception(Base):
    """A run that raises is the last one of its phase."""

    def _run(self, member: Member, trigger: Trigger) -> None:
        if not member.execution.extended:
            super()._run(member, trigger)
            return
        try:
            self._execute(member, None, lambda: trigger.run(self._execution_api(member).run))
        except Exception:  # noqa: BLE001 - a body may raise anything
            trigger.ended.set()


@variant_of(*PACED, readings={"background-again": "once-a-life"})
class runs_once_a_life(Base):
    """A background component runs in its first phase only."""

    def _run_paced(self, member: Member, trigger: Trigger) -> None:
        if member.execution.extended[0].definition == s.BACKGROUND and member.__dict__.get("ran"):
            return
        super()._run_paced(member, trigger)

    def _run(self, member: Member, trigger: Trigger) -> None:
        member.__dict__["ran"] = True
        super()._run(member, trigger)


@variant_of(*PACED, readings={"periodic-active": "all-a-period"})
class serves_all_at_an_instant(Pace):
    """All calls that wait at an instant are executed, one after the other."""

    def _next_tick(self) -> int:
        return 0


@variant_of(*PACED, readings={"periodic-active": "at-once-when-idle"})
class serves_at_once_when_idle(Pace):
    """A call is executed at once, if a period has passed since the last execution."""

    def due(self, asked: float) -> float:
        return max(asked, self.first, self.entered_at + self.period)


@variant_of(*PACED, readings={"periodic-active": "one-a-period"})
class says_one_a_period(Base):
    """One call is executed at each instant, and declared so."""


class _PacesEachPort(Base):
    def _paces(self, member: Member, origin: float) -> dict[str | None, Pace]:
        return {policy.port: self.pace_class(policy, origin) for policy in member.execution.extended}


@variant_of(*PACED, readings={"paced-by": "port"})
class paces_each_port(_PacesEachPort):
    """Each port element has instants of its own."""


@variant_of(*PACED, readings={"sporadic-measure": "end"})
class measures_from_the_end(Pace):
    """The least distance counts from the end of an execution."""

    def _since(self) -> float:
        return self.left_at


@variant_of(*PACED, readings={"early-invocation": "refused"})
class refuses_early_calls(Base):
    """A sporadic component that was executed a moment ago, or is waited for, refuses calls."""

    def _execute_paced(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        pace = member.execution.paces.get(port)
        if pace is None or pace.policy.definition != s.SPORADIC_ACTIVE:
            return super()._execute_paced(member, port, work)
        with self.manager.__dict__.setdefault("early", threading.Lock()):
            now = time.monotonic()
            if now < pace.entered_at + pace.period:
                raise pm.UcmError("the call comes too early")
            pace.entered_at = now
        return super()._execute_alone(member, port, lambda: self._at_pace(pace, work))


@variant_of(*PACED, readings={"early-invocation": "dropped"})
class drops_early_messages(Base):
    """Messages for a sporadic component that was executed a moment ago get ok and are dropped; calls wait."""

    def _execute_paced(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        pace = member.execution.paces.get(port)
        interface = member.implementation.interfaces.get(port or "")
        if pace is not None and interface is not None and s.PUSH in interface.methods:
            is_early = time.monotonic() < pace.entered_at + pace.period
            if is_early and pace.policy.definition == s.SPORADIC_ACTIVE:
                return ["ok"]  # type: ignore[return-value]
        return super()._execute_paced(member, port, work)


@variant_of(*PACED, readings={"early-invocation": "delayed"})
class says_that_early_calls_wait(Base):
    """Early calls wait, and it is declared."""


@variant_of(*PACED, readings={"parameter-values-checked": "unasked"})
class checks_no_values(Base):
    """Values of parameters that mean nothing are taken as others that do."""

    def _check_settings(self, policy: s.Policy) -> None:
        pass


@variant_of(*PACED, readings={"priority-zero": "refused"})
class knows_no_priority_zero(Base):
    """A priority of 0 is refused when the component is added."""

    def _check_policies(self, implementation: pm.Implementation) -> None:
        super()._check_policies(implementation)
        for policy in implementation.policies:
            if policy.settings.get(s.PRIORITY.get(policy.definition, "")) == 0:
                raise pm.UcmError("priorities begin with 1")


@variant_of(*PACED)
class serves_the_last_first(PacedExecutor):
    """Of several calls that wait the last one is executed first."""

    def _choose(self) -> Invocation:
        return max(self._waiting, key=lambda invocation: invocation.asked)


@replaces("_deliver", clauses=PACED)
def delivers_messages_after_a_while(self: Link, taker: Taker, method: str) -> None:
    """A message of a connection is delivered 300 ms after it was pushed."""
    while (message := taker.messages.get()) is not None:
        time.sleep(0.3)
        with suppress(Exception):
            taker.enter(method, [message])
