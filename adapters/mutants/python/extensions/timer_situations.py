"""Wrong frameworks, clause 10.3: timers that fail in one situation: numbers that are started twice, or alike; callbacks that raise, or are late; a stop."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

from ucm_cts.adapters.mutants.python.registry import MISSING_CALLBACKS, TIMED, TRIGGERED, Base, breaks
from ucm_cts.adapters.mutants.python.variants.triggered_apart import EndsTimersThatRaise
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.object_timers import Triggers
from ucm_cts.adapters.reference.python.timers import Timer, Timers


@breaks("R-10.3.2-33", clauses=TIMED, also=(*MISSING_CALLBACKS, "R-10.3.2-32"))
class loses_a_periodic_number_in_use(Timers):
    """Starting a number whose periodic timer waits ends that timer, and starts none."""

    def _start(self, timer: Timer) -> None:
        before = self._waiting.get(timer.number)
        if before is not None and before.rate is not None:
            del self._waiting[timer.number]
        else:
            super()._start(timer)


class _KeepsTheOld(Timers):
    """A number that is started while its timer waits has a second timer, which ``_is_kept`` may leave there when it is cancelled."""

    def _start(self, timer: Timer) -> None:
        before = self._waiting.get(timer.number)
        super()._start(timer)
        if before is not None:
            self.__dict__.setdefault("twice", set()).add(timer.number)

    def cancel_timer(self, number: int) -> None:
        if number in self.__dict__.get("twice", ()):
            self._cancelled.add(number)
        else:
            super().cancel_timer(number)


@breaks("R-10.3.2-38", clauses=TIMED, also=("R-10.3.2-40", "R-10.3.2-29"))
class does_not_cancel_numbers_started_twice(_KeepsTheOld):
    """A number that was started while its timer waited cannot be cancelled."""


class _Raising(Base):
    """``_take_exception`` is told of a callback that raised."""

    def _take_exception(self, timers: Timers) -> None:
        raise NotImplementedError

    def _call_body(self, member: Member, timer: Timer) -> None:
        try:
            super()._call_body(member, timer)
        except Exception:  # noqa: BLE001 - a callback may raise any
            self._take_exception(self._timers_of(member))


@breaks("R-10.3.2-36", clauses=TIMED, also=MISSING_CALLBACKS)
class ends_all_timers_when_a_callback_raises(_Raising):
    """When a callback raises, all timers of its component end."""

    def _take_exception(self, timers: Timers) -> None:
        timers._waiting.clear()


@breaks("R-10.3.2-36", clauses=TIMED, also=MISSING_CALLBACKS)
class starts_no_timers_after_a_callback_raised(_Raising):
    """Timers that are started after a callback raised never call back."""

    def _take_exception(self, timers: Timers) -> None:
        timers._start = lambda timer: None  # type: ignore[method-assign]


@breaks("R-10.3.2-30", clauses=TIMED, readings={"callback-exception": "continues"}, also=MISSING_CALLBACKS)
class ends_what_raises_undeclared(EndsTimersThatRaise):
    """A periodic timer whose callback raises ends, although it is declared to go on."""


@breaks("R-10.3.2-30", clauses=TIMED, readings={"callback-exception": "ends"})
class repeats_what_raises_undeclared(Base):
    """A periodic timer whose callback raises goes on, although it is declared to end."""


@breaks("R-10.3.2-42", clauses=TIMED, also=("R-11.2.3-15", "R-11.2.3-17", "R-11.2.3-27", "R-11.2.3-06"))
class serves_what_waited_when_it_stopped(Base):
    """A callback that waits for its component when stop is called enters when that is free, also after stop returned."""

    def _call_back(self, member: Member, timer: Timer) -> None:
        timers = self._timers_of(member)

        def enter() -> None:
            if timers.take(timer):
                self._call_body(member, timer)

        with suppress(Exception):
            self._execute_callback(member, enter)


@breaks("R-10.3.2-29", clauses=TIMED)
class keeps_the_rate_of_a_number(Timers):
    """A sporadic timer that is started under the number of a periodic one that waits repeats at its rate."""

    def _start(self, timer: Timer) -> None:
        before = self._waiting.get(timer.number)
        repeats = before is not None and before.rate is not None and timer.rate is None
        super()._start(replace(timer, rate=before.rate) if before is not None and repeats else timer)


@breaks("R-10.3.2-33", clauses=TIMED, also=MISSING_CALLBACKS)
class keeps_the_kind_of_a_number(Timers):
    """A periodic timer that is started under the number of a sporadic one that waits calls back once."""

    def _start(self, timer: Timer) -> None:
        before = self._waiting.get(timer.number)
        super()._start(replace(timer, rate=None) if before is not None and before.rate is None else timer)


@breaks("R-10.3-04", clauses=TIMED, also=("R-10.3.2-22", "R-10.3.2-33", *MISSING_CALLBACKS))
class takes_a_number_for_its_old_timer(Timers):
    """A number that is cancelled and started anew while its callback waits for the component calls back for the old timer, and ends."""

    def take(self, timer: Timer) -> bool:
        with self._changed:
            if timer.number in self._waiting and self._waiting[timer.number] is not timer:
                del self._waiting[timer.number]
                return True
        return super().take(timer)


@breaks("R-10.3.2-21", clauses=TIMED, also=("R-10.3.2-31", "R-10.3.2-37", *MISSING_CALLBACKS))
class has_timers_for_each_implementation(Base):
    """Timers that an instance starts call back the first instance of its implementation."""

    def _timers_of(self, member: Member) -> Timers:
        like = (one for one in self.members.values() if one.implementation is member.implementation)
        return next((one.timers for one in like if one.timers is not None), None) or super()._timers_of(member)


@breaks("R-10.3.2-33", clauses=TIMED, also=("R-10.3.2-36", "R-10.3.2-39", *MISSING_CALLBACKS))
class takes_numbers_for_equal_by_their_low_bytes(Timers):
    """A timer ends another one whose number is the same in the lowest sixteen bits."""

    def _start(self, timer: Timer) -> None:
        alike = [number for number in self._waiting if number % 2**16 == timer.number % 2**16]
        for number in alike:
            del self._waiting[number]
        super()._start(timer)


@breaks("R-10.3.2-33", clauses=TIMED, also=("R-10.3.2-30", *MISSING_CALLBACKS))
class calls_back_ten_times(Timers):
    """A periodic timer ends with its tenth callback."""

    def _following(self, timer: Timer) -> Timer | None:
        counts = self.__dict__.setdefault("counts", Counter())
        counts[timer.number] += 1
        return None if counts[timer.number] == 10 else super()._following(timer)


class _CountsFromWhatWasDue(Timers):
    """What a callback starts counts from when the callback was due, although that may be long ago."""

    def _call_back_at(self, timer: Timer) -> None:
        self.__dict__["serving"], self.__dict__["base"] = threading.get_ident(), timer.due
        self._call_back(timer)

    def _serve(self) -> None:
        while timer := self._next():
            self._call_back_at(timer)

    def _due(self, time_out: Sequence[Any]) -> float:
        if self.__dict__.get("serving") == threading.get_ident():
            return float(self.__dict__["base"]) + self._seconds(time_out)
        return super()._due(time_out)


@breaks("R-10.3.2-25", clauses=TIMED, also=("R-10.3.2-27",))
class counts_from_when_its_callback_was_due(_CountsFromWhatWasDue):
    """A timer that is started in a callback counts from when that callback was due."""


@breaks("R-10.3.1-19", clauses=TRIGGERED)
class counts_from_when_its_trigger_was_due(_CountsFromWhatWasDue, Triggers):
    """An object timer that is made in a trigger counts from when that trigger was due."""
