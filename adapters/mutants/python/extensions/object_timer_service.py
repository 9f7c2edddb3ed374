"""Wrong frameworks, clause 10.3.1: schedulers of object timers are not there, or refuse."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.programming_model import (
    Implementation,
    PortConnection,
    TimerHandler,
    UcmError,
)
from ucm_cts.adapters.mutants.python.methods import refuses_if
from ucm_cts.adapters.mutants.python.registry import TRIGGERED, Base, Row, breaks, family
from ucm_cts.adapters.mutants.python.variants.triggered import TakesSeveralSchedulers
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.object_timers import ScheduledTimer, SchedulesTimers, Triggers

ANY_TRIGGER = (*(f"R-10.3.1-{number:02}" for number in (1, *range(16, 37))), "R-10.3-10")
"""Without timers, or with few of them, anything may fail."""


def _has(implementation: Implementation, *definitions: str) -> bool:
    return {*definitions} <= {policy.definition for policy in implementation.policies}


@refuses_if("_check_policies", "R-10.3.1-16", clauses=TRIGGERED, also=ANY_TRIGGER)
def refuses_object_timers(_self: Base, implementation: Implementation) -> bool:
    """A component with object timers cannot be added."""
    return _has(implementation, s.OBJECT_TIMERS)


@refuses_if("_check_policies", "R-10.3.1-16", clauses=TRIGGERED, also=("R-10.3.1-36",))
def refuses_object_timers_of_self_executing(_self: Base, implementation: Implementation) -> bool:
    """A self-executing component cannot have object timers."""
    return _has(implementation, s.OBJECT_TIMERS, s.SELF_EXECUTING)


@refuses_if("_check_policies", "R-10.3.1-16", clauses=TRIGGERED, also=("R-10.3.1-36",))
def refuses_object_timers_of_active(_self: Base, implementation: Implementation) -> bool:
    """An active component cannot have object timers."""
    return _has(implementation, s.OBJECT_TIMERS, s.ACTIVE)


@refuses_if("_check_startable", "R-10.3.1-16", clauses=TRIGGERED, also=ANY_TRIGGER)
def refuses_to_start_object_timers(self: Base) -> bool:
    """A component with object timers cannot be started."""
    return any(_has(member.implementation, s.OBJECT_TIMERS) for member in self.members.values())


@refuses_if("_check_policies", "R-10.3-10", clauses=TRIGGERED)
def refuses_both_kinds_of_timers(_self: Base, implementation: Implementation) -> bool:
    """A component cannot have index timers and object timers."""
    return _has(implementation, s.OBJECT_TIMERS, s.INDEX_TIMERS)


@breaks("R-10.3-10", clauses=TRIGGERED, readings={"object-second-timer-policy": "separate"})
class refuses_a_second_scheduler_it_declares(Base):
    """A second policy for object timers is refused, although two are declared."""


@breaks("R-10.3-10", clauses=TRIGGERED, readings={"object-second-timer-policy": "refused"})
class accepts_a_second_scheduler(TakesSeveralSchedulers):
    """A second policy for object timers is accepted, although it is declared refused."""


class _Gives(Base):
    """``_given`` is what a component gets for its scheduler."""

    def _given(self, member: Member, element: PortConnection) -> PortConnection | None:
        return element

    def _service_element(self, member: Member, policy: s.Policy) -> PortConnection:
        element = super()._service_element(member, policy)
        if policy.definition != s.OBJECT_TIMERS:
            return element
        return self._given(member, element) or PortConnection("nothing", ())


@breaks("R-10.3.1-17", clauses=TRIGGERED, also=ANY_TRIGGER)
class gives_no_scheduler(_Gives):
    """A component gets no reference of its scheduler."""

    def _given(self, member: Member, element: PortConnection) -> PortConnection | None:
        return None


@breaks("R-10.3.1-17", clauses=TRIGGERED, also=ANY_TRIGGER)
class gives_a_null_scheduler(_Gives):
    """A component gets a null reference as its scheduler."""

    def _given(self, member: Member, element: PortConnection) -> PortConnection | None:
        return PortConnection(element.from_port, (None,))


@breaks("R-10.3.1-17", clauses=TRIGGERED, also=ANY_TRIGGER)
class gives_a_scheduler_once(_Gives):
    """A component gets its scheduler at its first start only."""

    def _given(self, member: Member, element: PortConnection) -> PortConnection | None:
        before: bool = member.__dict__.get("had_scheduler", False)
        member.__dict__["had_scheduler"] = True
        return None if before else element


@breaks("R-10.3.1-17", clauses=TRIGGERED, also=ANY_TRIGGER)
class gives_the_first_scheduler_again(_Gives):
    """After a restart a component gets the scheduler of its first phase, which serves no more."""

    def _given(self, member: Member, element: PortConnection) -> PortConnection | None:
        first: PortConnection = member.__dict__.setdefault("first_scheduler", element)
        return first


@breaks("R-10.3.1-17", clauses=TRIGGERED, also=("R-10.3.1-16",))
class gives_schedulers_to_all(Base):
    """Components without the policy get a scheduler as well."""

    def _with_services(self, member: Member, connections: Any) -> list[PortConnection]:
        given = super()._with_services(member, connections)
        others = [m.implementation for m in self.members.values() if _has(m.implementation, s.OBJECT_TIMERS)]
        if others and not _has(member.implementation, s.OBJECT_TIMERS):
            policy = next(p for p in others[0].policies if p.definition == s.OBJECT_TIMERS)
            given.append(SchedulesTimers._service_element(self, member, policy))
        return given


class _Raises(Triggers):
    """``refused`` says which timers cannot be made: of the delay, the interval, and how many wait."""

    refused: Any = staticmethod(lambda delay, interval, waiting: True)

    def _make(
        self, handler: TimerHandler, delay: Sequence[int], interval: Sequence[int] | None, max_rounds: int
    ) -> ScheduledTimer:
        if self.refused(delay, interval, len(self._waiting)):
            raise UcmError("refused")
        return super()._make(handler, delay, interval, max_rounds)


family(
    _Raises,
    "refused",
    {
        "makes_no_timer": Row("R-10.3.1-17", "No timer can be made.", lambda *_: True, ANY_TRIGGER),
        "makes_no_repeated_timer": Row(
            "R-10.3.1-17", "No repeated timer can be made.", lambda _, interval, __: interval is not None, ANY_TRIGGER
        ),
        "makes_no_single_timer": Row(
            "R-10.3.1-17",
            "No timer with one trigger can be made.",
            lambda _, interval, __: interval is None,
            ANY_TRIGGER,
        ),
        "takes_whole_milliseconds_only": Row(
            "R-10.3.1-17", "Delays with microseconds are refused.", lambda delay, *_: delay[1] % 1000 != 0, ANY_TRIGGER
        ),
        "takes_less_than_a_second_only": Row(
            "R-10.3.1-17", "Delays of a second or more are refused.", lambda delay, *_: delay[0] > 0, ANY_TRIGGER
        ),
        "has_three_timers": Row(
            "R-10.3.1-17", "No timer can be made while three wait.", lambda *given: given[2] >= 3, ANY_TRIGGER
        ),
        "has_sixteen_timers": Row(
            "R-10.3.1-17", "No timer can be made while sixteen wait.", lambda *given: given[2] >= 16, ANY_TRIGGER
        ),
    },
    TRIGGERED,
)


@breaks("R-10.3.1-17", clauses=TRIGGERED, also=ANY_TRIGGER)
class makes_no_timer_in_startup(Triggers):
    """A timer cannot be made in on_startup."""

    def _start(self, timer: Any) -> None:
        if not self._is_serving:
            raise UcmError("not operational")
        super()._start(timer)


class _Returns(Triggers):
    """``value`` is returned in place of a timer with one trigger."""

    value: Any = None

    def once(self, handler: TimerHandler, delay: Sequence[int]) -> ScheduledTimer:
        super().once(handler, delay)
        return self.value  # type: ignore[no-any-return]


family(
    _Returns,
    "value",
    {
        "returns_no_timer": Row("R-10.3.1-01", "scheduler_trigger returns nothing.", None, ANY_TRIGGER),
        "returns_a_number": Row("R-10.3.1-01", "scheduler_trigger returns a number.", 1, ANY_TRIGGER),
    },
    TRIGGERED,
)


@breaks("R-10.3.1-31", clauses=TRIGGERED, readings={"repeated-result": "timer"}, also=("R-10.3.1-17",))
class returns_no_repeated_timer(Base):
    """schedule_repeated_trigger returns nothing, although a timer is declared."""
