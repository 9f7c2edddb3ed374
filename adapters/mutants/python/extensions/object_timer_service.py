"""Wrong frameworks, clause 10.3.1: schedulers and object timers are not there, refuse, or say wrong things of themselves."""

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
from ucm_cts.adapters.mutants.python.methods import alters, refuses_if
from ucm_cts.adapters.mutants.python.registry import MISSING_TRIGGERS, TRIGGERED, Base, Row, breaks, family
from ucm_cts.adapters.mutants.python.variants.triggered import TakesSeveralSchedulers
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.object_timers import ScheduledTimer, SchedulesTimers, Trigger, Triggers

_ALL = (*(f"R-10.3.1-{number:02}" for number in (1, *range(16, 37))), "R-10.3-10")
"""Without timers, or with few of them, anything may fail."""


def _has(implementation: Implementation, *definitions: str) -> bool:
    return {*definitions} <= {policy.definition for policy in implementation.policies}


@refuses_if("_check_policies", "R-10.3.1-16", clauses=TRIGGERED, also=_ALL)
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


@refuses_if("_check_startable", "R-10.3.1-16", clauses=TRIGGERED, also=_ALL)
def refuses_to_start_object_timers(self: Base) -> bool:
    """A component with object timers cannot be started."""
    return any(_has(member.implementation, s.OBJECT_TIMERS) for member in self.members.values())


@refuses_if("_check_policies", "R-10.3-10", clauses=TRIGGERED)
def refuses_both_kinds_of_timers(_self: Base, implementation: Implementation) -> bool:
    """A component cannot have index timers and object timers."""
    return _has(implementation, s.OBJECT_TIMERS, s.INDEX_TIMERS)


@breaks("R-10.3-10", clauses=TRIGGERED, readings={"second-timer-policy": "separate"})
class refuses_a_second_scheduler_it_declares(Base):
    """A second policy for object timers is refused, although two are declared."""


@breaks("R-10.3-10", clauses=TRIGGERED, readings={"second-timer-policy": "refused"})
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


@breaks("R-10.3.1-17", clauses=TRIGGERED, also=_ALL)
class gives_no_scheduler(_Gives):
    """A component gets no reference of its scheduler."""

    def _given(self, member: Member, element: PortConnection) -> PortConnection | None:
        return None


@breaks("R-10.3.1-17", clauses=TRIGGERED, also=_ALL)
class gives_a_null_scheduler(_Gives):
    """A component gets a null reference as its scheduler."""

    def _given(self, member: Member, element: PortConnection) -> PortConnection | None:
        return PortConnection(element.from_port, (None,))


@breaks("R-10.3.1-17", clauses=TRIGGERED, also=_ALL)
class gives_a_scheduler_once(_Gives):
    """A component gets its scheduler at its first start only."""

    def _given(self, member: Member, element: PortConnection) -> PortConnection | None:
        before: bool = member.__dict__.get("had_scheduler", False)
        member.__dict__["had_scheduler"] = True
        return None if before else element


@breaks("R-10.3.1-17", clauses=TRIGGERED, also=_ALL)
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
        "makes_no_timer": Row("R-10.3.1-17", "No timer can be made.", lambda *_: True, _ALL),
        "makes_no_repeated_timer": Row(
            "R-10.3.1-17", "No repeated timer can be made.", lambda _, interval, __: interval is not None, _ALL
        ),
        "makes_no_single_timer": Row(
            "R-10.3.1-17", "No timer with one trigger can be made.", lambda _, interval, __: interval is None, _ALL
        ),
        "takes_whole_milliseconds_only": Row(
            "R-10.3.1-17", "Delays with microseconds are refused.", lambda delay, *_: delay[1] % 1000 != 0, _ALL
        ),
        "takes_less_than_a_second_only": Row(
            "R-10.3.1-17", "Delays of a second or more are refused.", lambda delay, *_: delay[0] > 0, _ALL
        ),
        "has_three_timers": Row(
            "R-10.3.1-17", "No timer can be made while three wait.", lambda *given: given[2] >= 3, _ALL
        ),
        "has_sixteen_timers": Row(
            "R-10.3.1-17", "No timer can be made while sixteen wait.", lambda *given: given[2] >= 16, _ALL
        ),
    },
    TRIGGERED,
)


@breaks("R-10.3.1-17", clauses=TRIGGERED, also=_ALL)
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
        "returns_no_timer": Row("R-10.3.1-01", "scheduler_trigger returns nothing.", None, _ALL),
        "returns_a_number": Row("R-10.3.1-01", "scheduler_trigger returns a number.", 1, _ALL),
    },
    TRIGGERED,
)


@breaks("R-10.3.1-31", clauses=TRIGGERED, readings={"repeated-result": "timer"}, also=("R-10.3.1-17",))
class returns_no_repeated_timer(Base):
    """schedule_repeated_trigger returns nothing, although a timer is declared."""


class _Fails(ScheduledTimer):
    """``failing`` is the method that raises, and ``ended`` whether it does so for timers that have ended only."""

    failing = ("", False)

    def _fail(self, method: str) -> None:
        failing, ended = self.failing
        if failing == method and not (ended and self.timer.number in self.triggers._waiting):
            raise UcmError("no such timer")

    def id(self) -> str:
        self._fail("id")
        return super().id()

    def rounds(self) -> int:
        self._fail("rounds")
        return super().rounds()

    def is_cancelled(self) -> bool:
        self._fail("is_cancelled")
        return super().is_cancelled()

    def cancel(self) -> None:
        self._fail("cancel")
        super().cancel()


family(
    _Fails,
    "failing",
    {
        "id_raises": Row("R-10.3.1-01", "id raises.", ("id", False), _ALL),
        "rounds_raises": Row("R-10.3.1-01", "rounds raises.", ("rounds", False), _ALL),
        "is_cancelled_raises": Row("R-10.3.1-01", "is_cancelled raises.", ("is_cancelled", False), _ALL),
        "cancel_raises": Row("R-10.3.1-01", "cancel raises.", ("cancel", False), _ALL),
        "id_raises_afterwards": Row("R-10.3.1-01", "id of an ended timer raises.", ("id", True), _ALL),
        "rounds_raises_afterwards": Row("R-10.3.1-01", "rounds of an ended timer raises.", ("rounds", True), _ALL),
        "is_cancelled_raises_afterwards": Row(
            "R-10.3.1-01", "is_cancelled of an ended timer raises.", ("is_cancelled", True), _ALL
        ),
    },
    TRIGGERED,
)


@alters("id", "R-10.3.1-29", clauses=TRIGGERED, also=_ALL)
def identifiers_are_numbers(self: ScheduledTimer, _own: str) -> Any:
    """id gives a number."""
    return self.timer.number


@alters("rounds", "R-10.3.1-30", clauses=TRIGGERED)
def rounds_are_texts(_self: ScheduledTimer, own: int) -> Any:
    """rounds gives a text."""
    return str(own)


@alters("rounds", "R-10.3.1-30", clauses=TRIGGERED)
def rounds_are_negative(_self: ScheduledTimer, own: int) -> int:
    """rounds gives a negative number."""
    return -own


@alters("is_cancelled", "R-10.3.1-33", clauses=TRIGGERED)
def is_cancelled_gives_a_number(_self: ScheduledTimer, own: bool) -> Any:
    """is_cancelled gives 0 or 1."""
    return int(own)


_IDS = ("R-10.3.1-26", "R-10.3.1-25", "R-10.3.1-29", "R-10.3.1-31", "R-10.3.1-33", *MISSING_TRIGGERS)


class _Identified(ScheduledTimer):
    """``identifier`` makes the identifier of the timer."""

    identifier: Any = None

    def id(self) -> str:
        return str(self.identifier(self.timer))


family(
    _Identified,
    "identifier",
    {
        "has_one_identifier": Row("R-10.3.1-28", "All timers have one identifier.", lambda _: "timer", _IDS),
        "has_empty_identifiers": Row("R-10.3.1-28", "All identifiers are empty.", lambda _: "", _IDS),
        "has_identifiers_of_handlers": Row(
            "R-10.3.1-28", "Timers of one handler have one identifier.", lambda timer: id(timer.handler), _IDS
        ),
        "has_identifiers_of_delays": Row(
            "R-10.3.1-28", "Timers of one delay have one identifier.", lambda timer: timer.asked, _IDS
        ),
        "has_four_identifiers": Row(
            "R-10.3.1-28", "Identifiers begin anew after four.", lambda timer: timer.number % 4, _IDS
        ),
        "has_sixteen_identifiers": Row(
            "R-10.3.1-28", "Identifiers begin anew after sixteen.", lambda timer: timer.number % 16, _IDS
        ),
    },
    TRIGGERED,
)


@breaks("R-10.3.1-28", clauses=TRIGGERED, readings={"timer-ids": "ever"}, also=_IDS)
class gives_identifiers_again(Triggers):
    """The identifier of an ended timer is given again, although that is declared never to happen."""

    def _new_number(self) -> int:
        return next(number for number in range(1, 1_000_000) if number not in self._waiting)


class _Renamed(ScheduledTimer):
    """``_prefix`` begins its identifier."""

    def _prefix(self) -> object:
        return ""

    def id(self) -> str:
        return f"{self._prefix()}{super().id()}"


@breaks("R-10.3.1-29", clauses=TRIGGERED, also=_ALL)
class renames_at_each_reading(_Renamed):
    """The identifier is another one whenever it is read."""

    def _prefix(self) -> object:
        readings: list[int] = self.triggers.__dict__.setdefault("readings", [0])
        readings[0] += 1
        return f"{readings[0]}-"


@breaks("R-10.3.1-29", clauses=TRIGGERED, also=_ALL)
class renames_ended_timers(_Renamed):
    """The identifier changes when the timer has triggered for the last time, or was cancelled."""

    def _prefix(self) -> object:
        return "" if self.timer.number in self.triggers._waiting else "ended "


@breaks("R-10.3.1-29", clauses=TRIGGERED, also=_ALL)
class renames_each_round(_Renamed):
    """The identifier tells when the timer is due."""

    def _prefix(self) -> object:
        waiting = self.triggers._waiting.get(self.timer.number)
        return waiting.due if waiting is not None else ""


class _Rounds(ScheduledTimer):
    """``told`` makes what rounds tells of the timer, and of the one that waits."""

    told: Any = None

    def rounds(self) -> int:
        waiting = self.triggers._waiting.get(self.timer.number)
        return self.told(self.timer, waiting)  # type: ignore[no-any-return]


def _left(timer: Trigger, waiting: Any) -> int:
    return timer.max_rounds - waiting.round if waiting is not None else 0


family(
    _Rounds,
    "told",
    {
        "tells_one_round_more": Row("R-10.3.1-30", "rounds is one too many.", lambda timer, _: timer.max_rounds + 1),
        "tells_no_rounds": Row("R-10.3.1-30", "rounds is always 0.", lambda *_: 0),
        "tells_one_round": Row("R-10.3.1-30", "rounds is always 1.", lambda *_: 1),
        "tells_the_timer_s_number": Row(
            "R-10.3.1-30", "rounds is the timer's number.", lambda timer, _: timer.number + 40
        ),
        "tells_rounds_left_undeclared": Row(
            "R-10.3.1-30",
            "rounds is what is left, although another meaning is declared.",
            _left,
            (),
            {"rounds-attribute": "done"},
        ),
        "tells_rounds_left_of_some": Row(
            "R-10.3.1-30",
            "rounds is what is left of timers with more than two rounds, and what was asked for of others.",
            lambda timer, waiting: _left(timer, waiting) if timer.max_rounds > 2 else timer.max_rounds,
            (),
            {"rounds-attribute": "observed"},
        ),
    },
    TRIGGERED,
)


@alters("is_cancelled", "R-10.3.1-33", clauses=TRIGGERED)
def says_never_cancelled_of_objects(_self: ScheduledTimer, _own: bool) -> bool:
    """is_cancelled gives false."""
    return False


@alters("is_cancelled", "R-10.3.1-33", clauses=TRIGGERED)
def says_always_cancelled_of_objects(_self: ScheduledTimer, _own: bool) -> bool:
    """is_cancelled gives true."""
    return True


@alters("is_cancelled", "R-10.3.1-33", clauses=TRIGGERED)
def says_whether_objects_wait(self: ScheduledTimer, _own: bool) -> bool:
    """is_cancelled tells whether the timer waits."""
    return self.timer.number in self.triggers._waiting


@alters("is_cancelled", "R-10.3.1-33", clauses=TRIGGERED)
def says_cancelled_of_all_objects(self: ScheduledTimer, _own: bool) -> bool:
    """is_cancelled gives true when any timer was cancelled."""
    return bool(self.triggers._cancelled)


@alters("is_cancelled", "R-10.3.1-33", clauses=TRIGGERED, readings={"is-cancelled": "cancelled"})
def says_cancelled_of_expired_objects(self: ScheduledTimer, _own: bool) -> bool:
    """is_cancelled gives true for timers that have expired, although the other reading is declared."""
    return self.timer.number not in self.triggers._waiting


class _OwnCopy(ScheduledTimer):
    """Remembers in the object, not in the timer, that it was cancelled."""

    was_cancelled = False

    def cancel(self) -> None:
        super().cancel()
        self.was_cancelled = True


@breaks("R-10.3.1-33", clauses=TRIGGERED, readings={"repeated-result": "timer"}, also=("R-10.3.1-31", "R-10.3.1-17"))
class forgets_that_objects_were_cancelled(_OwnCopy):
    """is_cancelled gives true once."""

    def is_cancelled(self) -> bool:
        answer, self.was_cancelled = self.was_cancelled, False
        return answer
