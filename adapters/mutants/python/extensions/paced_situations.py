"""Wrong frameworks, clause 10.5: policies that hold up to a number, a length of time or a way of calling, and not beyond."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from typing import TypeVar

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.mutants.python.registry import PACED, Base, breaks
from ucm_cts.adapters.reference.python.connectors import Link
from ucm_cts.adapters.reference.python.execution import Trigger
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.pacing import Pace

T = TypeVar("T")

_ALL_RUNS = ("R-10.5.2-01", "R-10.5.2-02", "R-10.5.2-04", "R-10.5.1-31")
_SECOND, _BITS = 1_000_000, 32


@breaks("R-10.5.2-04", clauses=PACED, also=_ALL_RUNS)
class runs_as_often_as_a_byte_counts(Base):
    """In one phase a component runs 255 times and no more."""

    def _run(self, member: Member, trigger: Trigger) -> None:
        count = trigger.__dict__["count"] = trigger.__dict__.get("count", 0) + 1
        if count < 2**8:
            super()._run(member, trigger)


@breaks("R-10.5.2-01", clauses=PACED, also=_ALL_RUNS)
class runs_two_parts_of_a_hundred_late(Pace):
    """Periods are a fiftieth longer."""

    def __init__(self, policy: s.Policy, origin: float) -> None:
        super().__init__(policy, origin)
        if policy.definition == s.PERIODIC_SELF_EXECUTING:
            self.period *= 1.02


@breaks("R-10.5.2-01", clauses=PACED, also=_ALL_RUNS)
class runs_at_ticks(Pace):
    """A period lasts for whole ticks of two milliseconds."""

    def __init__(self, policy: s.Policy, origin: float) -> None:
        super().__init__(policy, origin)
        if policy.definition == s.PERIODIC_SELF_EXECUTING:
            self.period = -(-round(self.period * _SECOND) // 2000) * 2000 / _SECOND


@breaks("R-10.5.1-28", clauses=PACED, also=("R-10.5.1-29", "R-10.5.2-03", "R-10.5.2-06"))
class wraps_long_offsets(Pace):
    """Offsets are kept as microseconds in 32 bits."""

    def __init__(self, policy: s.Policy, origin: float) -> None:
        super().__init__(policy, origin)
        self.first = origin + round(self.offset * _SECOND) % 2**_BITS / _SECOND


@breaks("R-10.5.2-03", clauses=PACED, also=("R-10.5.2-01",))
class wraps_long_periods(Pace):
    """Periods are kept as milliseconds in 16 bits."""

    def __init__(self, policy: s.Policy, origin: float) -> None:
        super().__init__(policy, origin)
        if policy.definition == s.PERIODIC_SELF_EXECUTING and self.period > 1:
            self.period = max(1, round(self.period * 1000) % 2**16) / 1000


@breaks("R-10.5.2-02", clauses=PACED, also=(*_ALL_RUNS, "R-10.5.2-06"))
class runs_eight_components(Base):
    """Of the components of a container that run by a policy of 10.5 the first eight do."""

    def _begin_execution(self, member: Member) -> None:
        execution = member.execution
        running = [m for m in self.started if m.execution.trigger is not None and m.execution.extended]
        if len(running) < 8 or not execution.extended or execution.definition != s.SELF_EXECUTING:
            super()._begin_execution(member)


@breaks("R-10.5.2-06", clauses=PACED, also=("R-10.5.1-29",))
class has_one_thread_in_the_background(Base):
    """A component in the background waits while another one runs there."""

    def _run(self, member: Member, trigger: Trigger) -> None:
        extended = member.execution.extended
        if not extended or extended[0].definition != s.BACKGROUND:
            return super()._run(member, trigger)
        with self.manager.__dict__.setdefault("background", threading.Lock()):
            return super()._run(member, trigger)


@breaks("R-10.5.2-15", clauses=PACED, also=("R-10.5.2-17",))
class paces_only_what_finds_it_idle(Pace):
    """A call that comes while a sporadic component is executed enters at once afterwards."""

    def due(self, asked: float) -> float:
        found_it_executed = self.entered_at < asked < self.left_at
        return asked if found_it_executed and self.policy.definition == s.SPORADIC_ACTIVE else super().due(asked)


class _AtOnce(Link):
    """Calls through service connectors are marked."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        thread = threading.current_thread()
        thread.__dict__["by a service"] = True
        try:
            return super()._request(method, arguments)
        finally:
            thread.__dict__["by a service"] = False


@breaks("R-10.5.2-15", clauses=PACED, also=("R-10.5.2-10", "R-10.5.2-11"))
class does_not_pace_services(Base):
    """A call through a service connector is executed at once."""

    link_class = _AtOnce

    def _execute_paced(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        if threading.current_thread().__dict__.get("by a service"):
            return self._execute_alone(member, port, work)
        return super()._execute_paced(member, port, work)
