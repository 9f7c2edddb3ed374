"""Conformant frameworks, clause 10.3.1: what the text leaves open about object timers."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.programming_model import ObjectTimer, PortConnection, TimerHandler, UcmError
from ucm_cts.adapters.mutants.python.registry import TRIGGERED, Base, variant_of
from ucm_cts.adapters.mutants.python.variants import timed
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.object_timers import ScheduledTimer, Trigger, Triggers
from ucm_cts.adapters.reference.python.timers import Timer, Timers

_MICROSECONDS = 1_000_000


def for_objects(timers: type[Timers], name: str) -> type[Triggers]:
    """What ``timers`` does to index timers, done to object timers."""
    return type(name, (timers, Triggers), {"__doc__": timers.__doc__})


def _as(name: str, of: type[Timers], **readings: str) -> None:
    """A variant of index timers is one of object timers, too."""
    declared = {f"object-{option.replace('_', '-')}": value for option, value in readings.items()}
    variant_of(*TRIGGERED, readings=declared)(for_objects(of, name))


_as(
    "triggers_count_from_the_last", timed.counts_from_the_last_callback, timer_anchor="chained", timer_overrun="shifted"
)
_as("triggers_leave_out_missed_ones", timed.leaves_out_missed_expiries, timer_overrun="skipped")
_as("triggers_merge_missed_ones", timed.merges_missed_expiries, timer_overrun="merged")
_as("triggers_begin_anew", timed.begins_anew_after_long_callbacks, timer_overrun="shifted")
_as("triggers_on_their_way_come", timed.cancels_what_is_not_on_its_way, timer_cancel="tolerant")
_as("triggers_say_what_is_inactive", timed.says_what_is_inactive, is_cancelled="inactive")
_as("triggers_of_startup_are_ignored", timed.ignores_timers_of_startup, timer_in_startup="ignored")
_as("triggers_are_a_little_late", timed.is_a_little_late)


@variant_of(
    *TRIGGERED,
    readings={
        **{f"object-{option}": value for option, value in timed.READINGS_OF_BOTH.items()},
        "timer-ids": "ever",
        "repeated-result": "printed",
        "first-repeated-trigger": "delay",
        "zero-rounds": "refused",
        "first-round": "zero",
        "rounds-attribute": "requested",
        "delta-time": "requested",
    },
)
class declares_its_object_timers(Base):
    """The reference framework, with all that it does declared."""


@variant_of(*TRIGGERED, readings={f"object-{option}": "as-index-timers" for option in timed.READINGS_OF_BOTH})
class declares_both_kinds_alike(Base):
    """The reference framework, whose object timers do as its index timers."""


class TakesSeveralSchedulers(Base):
    """A component may have several policies for object timers, each with a scheduler of its own."""

    def _check_schedulers(self, implementation: Any, timers: Sequence[s.Policy]) -> None:
        for policy in timers:
            super()._check_schedulers(implementation, [policy])


@variant_of(*TRIGGERED, readings={"object-second-timer-policy": "separate"})
class has_two_schedulers(TakesSeveralSchedulers):
    """A component may have several policies for object timers, each with a scheduler of its own."""


class _Numbered(ScheduledTimer):
    """Its identifier is the least that no timer has which waits when it is made."""

    def id(self) -> str:
        known: dict[int, int] = self.triggers.__dict__.setdefault("identifiers", {})
        return str(known[self.timer.number])


@variant_of(*TRIGGERED, readings={"timer-ids": "waiting"})
class uses_identifiers_again(Triggers):
    """The identifier of a timer that has ended is given to the next one."""

    timer_class = _Numbered

    def _new_number(self) -> int:
        number = super()._new_number()
        known: dict[int, int] = self.__dict__.setdefault("identifiers", {})
        used = {known[waiting] for waiting in self._waiting}
        known[number] = next(one for one in range(1, 1_000_000) if one not in used)
        return number


@variant_of(*TRIGGERED)
class has_long_identifiers(ScheduledTimer):
    """Identifiers are long texts with characters of eight bits."""

    def id(self) -> str:
        return "timer\u00e9 " * 300 + super().id()


@variant_of(*TRIGGERED, readings={"repeated-result": "timer"})
class gives_repeated_timers(Base):
    """schedule_repeated_trigger returns the timer."""

    def _repeated_result(self, timer: ObjectTimer) -> ObjectTimer | None:
        return timer


@variant_of(*TRIGGERED)
class gives_repeated_timers_unasked(gives_repeated_timers):
    """The same, without a declaration."""


@variant_of(*TRIGGERED, readings={"first-repeated-trigger": "delay-plus-interval"})
class triggers_one_interval_later(Triggers):
    """The first repeated trigger comes one interval after the start delay."""

    def _start(self, timer: Timer) -> None:
        super()._start(replace(timer, due=timer.due + (timer.rate or 0.0)))


class _NoRounds(Triggers):
    """Takes repeated triggers without rounds."""

    def repeated(
        self, handler: TimerHandler, start_delay: Sequence[int], interval: Sequence[int], max_rounds: int
    ) -> ScheduledTimer:
        if max_rounds:
            return super().repeated(handler, start_delay, interval, max_rounds)
        made = super().repeated(handler, start_delay, interval, 1)
        self._without_rounds(made)
        return made

    def _without_rounds(self, made: ScheduledTimer) -> None:
        raise NotImplementedError


@variant_of(*TRIGGERED, readings={"zero-rounds": "none"})
class takes_no_rounds(_NoRounds):
    """A timer with no rounds never triggers."""

    def _without_rounds(self, made: ScheduledTimer) -> None:
        self._waiting.pop(made.timer.number, None)


@variant_of(*TRIGGERED, readings={"zero-rounds": "endless"})
class triggers_without_end(_NoRounds):
    """A timer with no rounds triggers until it is cancelled."""

    def _without_rounds(self, made: ScheduledTimer) -> None:
        waiting = self._waiting[made.timer.number]
        assert isinstance(waiting, Trigger)
        self._waiting[made.timer.number] = replace(waiting, max_rounds=2**32 - 1)


@variant_of(*TRIGGERED, readings={"first-round": "one"})
class counts_rounds_from_one(Base):
    """Rounds are counted from 1."""

    def _round_told(self, timer: Trigger) -> int:
        return timer.round + 1


@variant_of(*TRIGGERED, readings={"first-round": "one"})
class counts_repeated_rounds_from_one(Base):
    """Rounds of repeated triggers are counted from 1, and a single trigger has 0."""

    def _round_told(self, timer: Trigger) -> int:
        return timer.round + 1 if timer.rate is not None else 0


class _Counts(Triggers):
    """Knows how many rounds each timer has done."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.done: dict[int, int] = {}

    def _following(self, timer: Timer) -> Timer | None:
        self.done[timer.number] = self.done.get(timer.number, 0) + 1
        return super()._following(timer)


class _Done(ScheduledTimer):
    def rounds(self) -> int:
        assert isinstance(self.triggers, _Counts)
        return self.triggers.done.get(self.timer.number, 0)


class _Left(_Done):
    def rounds(self) -> int:
        return self.timer.max_rounds - super().rounds()


@variant_of(*TRIGGERED, readings={"rounds-attribute": "done"})
class tells_rounds_done(_Counts):
    """rounds is the number of triggers that have come."""

    timer_class = _Done


@variant_of(*TRIGGERED, readings={"rounds-attribute": "left"})
class tells_rounds_left(_Counts):
    """rounds is the number of triggers that are to come."""

    timer_class = _Left


@variant_of(*TRIGGERED)
class has_no_rounds_for_single_triggers(ScheduledTimer):
    """rounds of a timer with one trigger is 0."""

    def rounds(self) -> int:
        return self.timer.max_rounds if self.timer.rate is not None else 0


def _time(seconds: float) -> list[int]:
    return [*divmod(max(0, int(seconds * _MICROSECONDS)), _MICROSECONDS)]


@variant_of(*TRIGGERED, readings={"delta-time": "since-scheduled"})
class tells_time_since_scheduled(Base):
    """delta_time is the time since the timer was made."""

    def _delta_time(self, timer: Trigger) -> Sequence[int]:
        return _time(time.monotonic() - timer.scheduled)


@variant_of(*TRIGGERED, readings={"delta-time": "since-last"})
class tells_time_since_last(Base):
    """delta_time is the time since the last trigger of the timer."""

    def _delta_time(self, timer: Trigger) -> Sequence[int]:
        return _time(time.monotonic() - timer.last)


@variant_of(*TRIGGERED, readings={"delta-time": "lateness"})
class tells_its_lateness(Base):
    """delta_time is by how much the trigger is late."""

    def _delta_time(self, timer: Trigger) -> Sequence[int]:
        return _time(time.monotonic() - timer.due)


@variant_of(*TRIGGERED)
class hands_over_one_object(Triggers):
    """The timer that triggers is the very object that the scheduler returned."""

    def given(self, timer: Trigger) -> ScheduledTimer:
        known: dict[int, ScheduledTimer] = self.__dict__.setdefault("given_out", {})
        return known.setdefault(timer.number, super().given(timer))


@variant_of(*TRIGGERED, readings={"object-zero-delay": "refused"})
class refuses_triggers_at_once(Triggers):
    """A delay of zero is refused."""

    def _make(
        self, handler: TimerHandler, delay: Sequence[int], interval: Sequence[int] | None, max_rounds: int
    ) -> ScheduledTimer:
        if not any(delay):
            raise UcmError("no delay")
        return super()._make(handler, delay, interval, max_rounds)


@variant_of(*TRIGGERED, readings={"object-zero-delay": "ignored"})
class ignores_triggers_at_once(Triggers):
    """A timer with a delay of zero never triggers."""

    def _make(
        self, handler: TimerHandler, delay: Sequence[int], interval: Sequence[int] | None, max_rounds: int
    ) -> ScheduledTimer:
        made = super()._make(handler, delay if any(delay) else [3600, 0], interval, max_rounds)
        if not any(delay):
            self._waiting.pop(made.timer.number, None)
        return made


@variant_of(*TRIGGERED)
class raises_for_ended_timers(ScheduledTimer):
    """Cancelling a timer that has ended raises."""

    def cancel(self) -> None:
        if self.timer.number not in self.triggers._waiting:
            raise UcmError("the timer has ended")
        super().cancel()


@variant_of(*TRIGGERED, readings={"object-timers-at-stop": "resumed"})
class resumes_triggers(Base):
    """Object timers that wait at stop go on after the restart."""

    def _service_element(self, member: Member, policy: s.Policy) -> PortConnection:
        before = member.schedulers[-1:]
        element = super()._service_element(member, policy)
        for earlier in before if policy.definition == s.OBJECT_TIMERS else ():
            triggers = member.schedulers[-1]
            assert isinstance(triggers, Triggers)
            assert isinstance(earlier, Triggers)
            triggers._waiting, triggers._cancelled = earlier._waiting, earlier._cancelled
            triggers._numbers = earlier._numbers
        return element


@variant_of(*TRIGGERED)
class triggers_on_one_thread(timed.has_one_timer_thread):
    """One thread at a time triggers handlers, in all components of the runtime."""
