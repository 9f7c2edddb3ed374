"""Wrong frameworks, clause 10.3.1: object timers that fail in one situation: many of them, both kinds, several schedulers, in handlers, later."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.programming_model import PortConnection, TimerHandler
from ucm_cts.adapters.mutants.python.registry import MISSING_TRIGGERS, TRIGGERED, Base, breaks
from ucm_cts.adapters.mutants.python.variants.triggered import (
    TakesSeveralSchedulers,
    resumes_triggers,
    triggers_without_end,
)
from ucm_cts.adapters.mutants.python.variants.triggered_apart import EndsObjectsThatRaise
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.object_timers import ScheduledTimer, Trigger, Triggers
from ucm_cts.adapters.reference.python.timers import Timer

_SILENT = ("R-10.3.1-31", "R-10.3.1-33", "R-10.3.1-18", "R-10.3.1-23")


class _KnowsItsTrigger(Base):
    """Schedulers know in whose trigger they are called: ``inside`` is the thread and the timer."""

    def _trigger(self, member: Member, triggers: Triggers, timer: Timer) -> None:
        triggers.__dict__["inside"] = threading.get_ident(), timer
        try:
            super()._trigger(member, triggers, timer)
        finally:
            triggers.__dict__["inside"] = 0, None


def _timer_inside(triggers: Triggers) -> Trigger | None:
    """The timer in whose handler ``triggers`` are called."""
    thread, timer = triggers.__dict__.get("inside", (0, None))
    return timer if thread == threading.get_ident() else None


class _LosesInHandlers(Triggers):
    def _start(self, timer: Timer) -> None:
        if timer.rate is not None or _timer_inside(self) is None:
            super()._start(timer)


@breaks("R-10.3.1-34", clauses=TRIGGERED, also=(*MISSING_TRIGGERS, "R-10.3.1-25"))
class loses_single_triggers_made_in_handlers(_KnowsItsTrigger):
    """A timer with one trigger that is made in a handler never triggers."""

    triggers_class = _LosesInHandlers


class _CancelsFirstRounds(Triggers):
    def cancel_timer(self, number: int) -> None:
        own = _timer_inside(self)
        if own is not None and own.number == number and own.round > 0:
            self._cancelled.add(number)
        else:
            super().cancel_timer(number)


@breaks("R-10.3.1-31", clauses=TRIGGERED, also=_SILENT)
class cancels_in_the_handler_of_the_first_round_only(_KnowsItsTrigger):
    """A repeated timer cannot be cancelled in its own handler from the second round on."""

    triggers_class = _CancelsFirstRounds


@breaks("R-10.3.1-36", clauses=TRIGGERED, also=("R-10.1.3.2-12", "R-10.1.3.2-10", *MISSING_TRIGGERS))
class enters_beside_executions_from_the_second_round_on(Base):
    """The second round of a timer, and later ones, enter a protected component that is executed."""

    def _trigger(self, member: Member, triggers: Triggers, timer: Timer) -> None:
        assert isinstance(timer, Trigger)
        if not timer.round:
            super()._trigger(member, triggers, timer)
        elif triggers.take(timer):
            with suppress(Exception):
                self._call_handler(triggers, timer)


@breaks("R-10.3.1-32", clauses=TRIGGERED, readings={"object-second-timer-policy": "separate"}, also=MISSING_TRIGGERS)
class cancel_ends_the_timer_of_the_first_scheduler(TakesSeveralSchedulers):
    """cancel of a timer ends the timer of that number of the other scheduler, too."""

    def _service_element(self, member: Member, policy: s.Policy) -> PortConnection:
        element = super()._service_element(member, policy)
        if policy.definition == s.OBJECT_TIMERS:
            known = list(member.schedulers)

            def cancel(number: int) -> None:
                for triggers in known:
                    Triggers.cancel_timer(triggers, number)

            member.schedulers[-1].cancel_timer = cancel  # type: ignore[method-assign]
        return element


class _BothKinds(Base):
    """``_join_kinds`` is given the index timers and the object timers of a component that has both."""

    def _join_kinds(self, member: Member) -> None:
        raise NotImplementedError

    def _service_element(self, member: Member, policy: s.Policy) -> PortConnection:
        element = super()._service_element(member, policy)
        if member.timers is not None and member.schedulers:
            self._join_kinds(member)
        return element


@breaks("R-10.3.1-32", clauses=TRIGGERED, also=MISSING_TRIGGERS)
class cancel_of_an_index_timer_ends_the_object(_BothKinds):
    """cancel_timer ends the object timer of that number, too."""

    def _join_kinds(self, member: Member) -> None:
        timers, triggers = member.timers, member.schedulers[-1]
        assert timers is not None
        own = type(timers).cancel_timer.__get__(timers)

        def cancel(number: int) -> None:
            own(number)
            triggers._waiting.pop(number, None)

        timers.cancel_timer = cancel  # type: ignore[method-assign]


@breaks("R-10.3.2-39", clauses=TRIGGERED, also=("R-10.3.2-21", "R-10.3.2-36"))
class cancel_of_an_object_ends_index_timers(_BothKinds):
    """cancel of an object timer ends all index timers of its component, too."""

    def _join_kinds(self, member: Member) -> None:
        timers, triggers = member.timers, member.schedulers[-1]
        assert timers is not None
        own = type(triggers).cancel_timer.__get__(triggers)

        def cancel(number: int) -> None:
            own(number)
            timers._waiting.clear()

        triggers.cancel_timer = cancel  # type: ignore[method-assign]


@breaks("R-10.3.1-28", clauses=TRIGGERED, also=("R-10.3.1-25", "R-10.3.1-26"))
class has_a_hundred_identifiers(ScheduledTimer):
    """The identifier is a number of two digits."""

    def id(self) -> str:
        return str(self.timer.number % 100)


@breaks("R-10.3.1-34", clauses=TRIGGERED, also=MISSING_TRIGGERS)
class has_room_for_100_timers(Triggers):
    """A timer that is made while 100 wait never triggers."""

    def _start(self, timer: Timer) -> None:
        if len(self._waiting) < 100:
            super()._start(timer)


@breaks("R-10.3.1-34", clauses=TRIGGERED, also=(*MISSING_TRIGGERS, "R-10.3.1-25"))
class loses_timers_made_at_once(Triggers):
    """Of two timers that are made by two threads within two milliseconds the second one never triggers."""

    def _start(self, timer: Timer) -> None:
        before, self.__dict__["made"] = self.__dict__.get("made"), (threading.get_ident(), time.monotonic())
        if before is None or before[0] == threading.get_ident() or time.monotonic() - before[1] > 0.002:
            super()._start(timer)


@breaks("R-10.3.1-33", clauses=TRIGGERED)
class forgets_cancels_when_a_timer_is_made(Triggers):
    """is_cancelled gives false again when another timer has been made."""

    def _start(self, timer: Timer) -> None:
        self._cancelled.clear()
        super()._start(timer)


@breaks("R-10.3.1-27", clauses=TRIGGERED, readings={"delta-time": "observed"})
class tells_two_time_differences(Base):
    """delta_time is what was asked for in a single trigger, and the lateness in others."""

    def _delta_time(self, timer: Trigger) -> Sequence[int]:
        return super()._delta_time(timer) if timer.rate is None else [0, 0]


@breaks("R-10.3.1-27", clauses=TRIGGERED, readings={"delta-time": "observed"})
class tells_a_time_that_means_nothing(Base):
    """delta_time is always the same time."""

    def _delta_time(self, timer: Trigger) -> Sequence[int]:
        return [12345, 678]


@breaks("R-10.3.1-24", clauses=TRIGGERED, readings={"first-round": "observed"})
class counts_rounds_of_some_timers_from_one(Base):
    """Rounds of every other timer are counted from 1, the others from 0."""

    def _round_told(self, timer: Trigger) -> int:
        return timer.round + timer.number % 2


@breaks("R-10.3.1-35", clauses=TRIGGERED, also=("R-11.2.3-15", "R-11.2.3-17", "R-11.2.3-27", "R-11.2.3-06"))
class triggers_what_waited_when_it_stopped(Base):
    """A trigger that waits for its component when stop is called enters when that is free, also after stop returned."""

    def _trigger(self, member: Member, triggers: Triggers, timer: Timer) -> None:
        assert isinstance(timer, Trigger)

        def enter() -> None:
            if triggers.take(timer):
                self._call_handler(triggers, timer)

        with suppress(Exception):
            self._execute_callback(member, enter)


@breaks("R-10.3.1-23", clauses=TRIGGERED, readings={"zero-rounds": "endless"}, also=("R-10.3.1-34",))
class ends_timers_without_end(triggers_without_end):
    """A timer without an end triggers six times."""

    def _is_last(self, timer: Trigger) -> bool:
        return super()._is_last(timer) or (timer.max_rounds > 2**31 and timer.round >= 5)


@breaks("R-10.3.1-31", clauses=TRIGGERED, readings={"zero-rounds": "endless"}, also=_SILENT)
class does_not_cancel_timers_without_end(triggers_without_end):
    """A timer without an end cannot be cancelled."""

    def cancel_timer(self, number: int) -> None:
        waiting = self._waiting.get(number)
        if isinstance(waiting, Trigger) and waiting.max_rounds > 2**31:
            self._cancelled.add(number)
        else:
            super().cancel_timer(number)


@breaks("R-10.3.1-21", clauses=TRIGGERED, also=("R-10.3.1-23", "R-10.3.1-20"))
class takes_no_start_delay_for_the_interval(Triggers):
    """A repeated timer with no start delay triggers first after its interval."""

    def repeated(
        self, handler: TimerHandler, start_delay: Sequence[int], interval: Sequence[int], max_rounds: int
    ) -> ScheduledTimer:
        return super().repeated(handler, start_delay if any(start_delay) else interval, interval, max_rounds)


@breaks("R-10.3.1-31", clauses=TRIGGERED, readings={"object-timers-at-stop": "resumed"}, also=_SILENT)
class does_not_cancel_timers_of_an_earlier_phase(resumes_triggers):
    """A timer that goes on after a restart cannot be cancelled any more."""

    def _service_element(self, member: Member, policy: s.Policy) -> PortConnection:
        element = super()._service_element(member, policy)
        if policy.definition == s.OBJECT_TIMERS:
            triggers = member.schedulers[-1]
            triggers._waiting = dict(triggers._waiting)
        return element


@breaks(
    "R-10.3.1-23", clauses=TRIGGERED, readings={"object-timer-overrun": "queued"}, also=("R-10.3.1-22", "R-10.3.1-24")
)
class loses_one_of_the_rounds_that_wait(Triggers):
    """One of the rounds that have to wait for their component is left out, although they are declared to be caught up."""

    def _next_due(self, timer: Timer, rate: float) -> float:
        due = super()._next_due(timer, rate)
        return due + rate if due < time.monotonic() - 0.05 else due

    def _following(self, timer: Timer) -> Timer | None:
        following = super()._following(timer)
        assert isinstance(timer, Trigger)
        if isinstance(following, Trigger) and timer.rate is not None and following.due > timer.due + 1.5 * timer.rate:
            return replace(following, round=following.round + 1) if following.round + 1 < timer.max_rounds else None
        return following


class _Raising(Base):
    """``_take_exception`` is told of a handler that raised."""

    def _take_exception(self, triggers: Triggers, timer: Trigger) -> None:
        raise NotImplementedError

    def _call_handler(self, triggers: Triggers, timer: Trigger) -> None:
        try:
            super()._call_handler(triggers, timer)
        except Exception:  # noqa: BLE001 - a handler may raise any
            self._take_exception(triggers, timer)


@breaks("R-10.3.1-34", clauses=TRIGGERED, also=MISSING_TRIGGERS)
class ends_all_timers_when_a_handler_raises(_Raising):
    """When a handler raises, all timers of its component end."""

    def _take_exception(self, triggers: Triggers, timer: Trigger) -> None:
        triggers._waiting.clear()


@breaks("R-10.3.1-34", clauses=TRIGGERED, also=MISSING_TRIGGERS)
class makes_no_timers_after_a_handler_raised(_Raising):
    """Timers that are made after a handler raised never trigger."""

    def _take_exception(self, triggers: Triggers, timer: Trigger) -> None:
        triggers._start = lambda timer: None  # type: ignore[method-assign]


@breaks("R-10.3.1-18", clauses=TRIGGERED, also=("R-10.3.1-22", "R-10.3.1-23", "R-10.3.1-24", "R-10.3.1-25"))
class triggers_again_when_a_handler_raises(_Raising):
    """A handler that raises is triggered again at once."""

    def _take_exception(self, triggers: Triggers, timer: Trigger) -> None:
        Base._call_handler(self, triggers, timer)


@breaks("R-10.3.1-23", clauses=TRIGGERED, readings={"object-callback-exception": "continues"}, also=MISSING_TRIGGERS)
class ends_timers_that_raise_undeclared(EndsObjectsThatRaise):
    """A repeated timer whose handler raises ends, although it is declared to go on."""


@breaks("R-10.3.1-23", clauses=TRIGGERED, readings={"object-callback-exception": "ends"})
class goes_on_after_exceptions_undeclared(Base):
    """A repeated timer whose handler raises goes on, although it is declared to end."""


@breaks("R-10.3.1-23", clauses=TRIGGERED)
class counts_rounds_by_handler(Triggers):
    """Timers with one handler use up each other's rounds."""

    def _is_last(self, timer: Trigger) -> bool:
        made = self.__dict__.setdefault("made", {})
        made[timer.handler] = made.get(timer.handler, 0) + 1
        return bool(made[timer.handler] >= timer.max_rounds)


@breaks("R-10.3.1-36", clauses=TRIGGERED, also=("R-10.3.1-23",))
class gives_up_rounds_that_wait(Triggers):
    """A repeated timer ends with a round that waited for its component for a tenth of a second."""

    def _following(self, timer: Timer) -> Timer | None:
        has_waited = timer.rate is not None and time.monotonic() - timer.due > 0.1
        return None if has_waited else super()._following(timer)
