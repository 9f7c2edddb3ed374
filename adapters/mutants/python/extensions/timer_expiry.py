"""Wrong frameworks, clause 10.3.2: index timers expire early, late, seldom, too often, or not at all."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.mutants.python.methods import alters
from ucm_cts.adapters.mutants.python.registry import MISSING_CALLBACKS, TIMED, Base, Row, breaks, family
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.timers import Timer, Timers

_EARLY = (
    "R-10.3.2-25",
    "R-10.3.2-31",
    "R-10.3.2-32",
    "R-10.3.2-28",
    "R-10.3.2-27",
    "R-10.3.2-35",
    "R-10.3.2-38",
    "R-10.3.2-33",
    "R-10.3.2-40",
    "R-10.3.2-22",
)
_LATE = (
    "R-10.3.2-26",
    "R-10.3.2-31",
    "R-10.3.2-32",
    "R-10.3.2-28",
    "R-10.3.2-27",
    "R-10.3.2-35",
    "R-10.3.2-33",
    *MISSING_CALLBACKS,
)
_AGAIN = ("R-10.3.2-29", "R-10.3.2-38", "R-10.3.2-25", "R-10.3.2-33", "R-10.3.2-22", "R-10.3.2-40")


class _Lasts(Timers):
    """A delay lasts ``seconds`` longer, by ``times``."""

    change = (1.0, 0.0)

    def _due(self, time_out: Sequence[Any]) -> float:
        now = time.monotonic()
        times, more = self.change
        return now + max(0.0, (super()._due(time_out) - now) * times + more)


family(
    _Lasts,
    "change",
    {
        "expires_a_little_early": Row("R-10.3.2-25", "A timer is ten milliseconds early.", (1.0, -0.01), also=_EARLY),
        "expires_half_a_second_early": Row("R-10.3.2-25", "A timer is half a second early.", (1.0, -0.5), also=_EARLY),
        "expires_at_half_its_time": Row("R-10.3.2-25", "A delay lasts half of its time.", (0.5, 0.0), also=_EARLY),
        "expires_at_once": Row("R-10.3.2-25", "Every timer is due at once.", (0.0, 0.0), also=_EARLY),
        "takes_milliseconds": Row("R-10.3.2-25", "Times are taken as milliseconds.", (0.001, 0.0), also=_EARLY),
        "expires_late": Row("R-10.3.2-26", "A timer is a quarter of a second late.", (1.0, 0.25), also=_LATE),
        "expires_a_second_late": Row("R-10.3.2-21", "A timer is a second late.", (1.0, 1.0), also=_LATE),
        "expires_at_double_its_time": Row("R-10.3.2-21", "A delay lasts twice its time.", (2.0, 0.0), also=_LATE),
    },
    TIMED,
)


@breaks("R-10.3.2-21", clauses=TIMED, also=(*_LATE, "R-10.3.2-20", "R-10.3.2-28"))
class never_expires(Timers):
    """No timer ever calls back."""

    def _next(self) -> Timer | None:
        self.trigger.ended.wait()
        return None


@breaks("R-10.3.2-27", clauses=TIMED, also=(*_EARLY, *_LATE))
class counts_from_the_first_timer(Timers):
    """A relative time counts from when the first timer of the component was started."""

    origin = 0.0

    def _due(self, time_out: Sequence[Any]) -> float:
        self.origin = self.origin or time.monotonic()
        if time_out[1] == s.ABSOLUTE_TIME:
            return super()._due(time_out)
        return self.origin + float(time_out[0])


@breaks("R-10.3.2-25", clauses=TIMED, also=(*_EARLY, *_LATE))
class counts_from_the_start(Timers):
    """A relative time counts from the start of the component."""

    def begin(self) -> None:
        self.__dict__.setdefault("begun", time.monotonic())
        super().begin()

    def _due(self, time_out: Sequence[Any]) -> float:
        begun: float = self.__dict__.get("begun", time.monotonic())
        return super()._due(time_out) if time_out[1] == s.ABSOLUTE_TIME else begun + float(time_out[0])


@breaks("R-10.3.2-25", clauses=TIMED, also=(*_EARLY, *_LATE))
class rounds_to_full_seconds(Timers):
    """Timers expire when the clock shows full seconds, at the nearest one."""

    def _due(self, time_out: Sequence[Any]) -> float:
        due = super()._due(time_out)
        ahead = time.time() - time.monotonic()
        return round(due + ahead) - ahead


@breaks("R-10.3.2-26", clauses=TIMED, also=(*_LATE, "R-10.3.2-21"))
class looks_twice_a_second(Timers):
    """Timers are looked after twice a second only."""

    def _next(self) -> Timer | None:
        timer = super()._next()
        if timer is not None and time.monotonic() - timer.due < 0.05:
            self.trigger.ended.wait(0.3)
        return timer


@breaks("R-10.3.2-26", clauses=TIMED, also=_LATE)
class pauses_between_callbacks(Timers):
    """A tenth of a second passes between two callbacks of a component."""

    def _serve(self) -> None:
        while timer := self._next():
            self._call_back(timer)
            self.trigger.ended.wait(0.1)


# sporadic timers


@breaks("R-10.3.2-29", clauses=TIMED, also=_AGAIN)
class repeats_sporadic_timers(Timers):
    """A sporadic timer calls back again and again."""

    def start_sporadic_scheduler(self, number: int, time_out: Sequence[Any]) -> None:
        due = self._due(time_out)
        self._start(Timer(number, due, max(1.0, due - time.monotonic()), list(time_out)))


@breaks("R-10.3.2-29", clauses=TIMED, also=_AGAIN)
class calls_back_two_times(Timers):
    """A sporadic timer calls back twice, one at once after the other."""

    def take(self, timer: Timer) -> bool:
        if not super().take(timer):
            return False
        if timer.rate is None and timer.number not in self.__dict__.setdefault("repeated", set()):
            self.__dict__["repeated"].add(timer.number)
            self._waiting[timer.number] = timer
        return True


@breaks("R-10.3.2-29", clauses=TIMED, also=_AGAIN)
class calls_back_later_again(Timers):
    """A sporadic timer calls back once more after two further delays."""

    def take(self, timer: Timer) -> bool:
        if not super().take(timer):
            return False
        if timer.rate is None and timer.number not in self.__dict__.setdefault("repeated", set()):
            self.__dict__["repeated"].add(timer.number)
            again = replace(timer, due=time.monotonic() + 2 * max(1, int(timer.asked[0]) % 100))  # type: ignore[arg-type]
            self._waiting[timer.number] = again
        return True


@breaks("R-10.3.2-36", clauses=TIMED, also=(*_LATE, "R-10.3.2-40"))
class serves_the_first_alone(Timers):
    """Only the timer that was started first calls back."""

    def _start(self, timer: Timer) -> None:
        if self.__dict__.setdefault("first", timer.number) == timer.number:
            super()._start(timer)


@breaks("R-10.3.2-36", clauses=TIMED, also=_LATE)
class merges_what_is_due_at_once(Timers):
    """Of timers that are due at the same moment one calls back."""

    def take(self, timer: Timer) -> bool:
        for other in list(self._waiting.values()):
            if other is not timer and other.rate is None and abs(other.due - timer.due) < 0.01:
                del self._waiting[other.number]
        return super().take(timer)


# periodic timers


@breaks("R-10.3.2-30", clauses=TIMED, also=(*MISSING_CALLBACKS, "R-10.3.2-32"))
class does_not_repeat(Timers):
    """A periodic timer calls back once."""

    def start_periodic_scheduler(self, number: int, delay: Sequence[Any], rate: Sequence[Any]) -> None:
        self._start(Timer(number, self._due(delay), None, list(delay)))


@breaks("R-10.3.2-30", clauses=TIMED, also=(*MISSING_CALLBACKS, "R-10.3.2-32"))
class repeats_three_times(Timers):
    """A periodic timer ends after three callbacks."""

    def take(self, timer: Timer) -> bool:
        counts = self.__dict__.setdefault("counts", {})
        counts[timer.number] = counts.get(timer.number, 0) + (timer.rate is not None)
        taken = super().take(timer)
        if counts[timer.number] == 3:
            self._waiting.pop(timer.number, None)
            counts[timer.number] = 0
        return taken


_RATE = (
    "R-10.3.2-32",
    "R-10.3.2-30",
    "R-10.3.2-31",
    "R-10.3.2-38",
    "R-10.3.2-39",
    "R-10.3.2-36",
    "R-10.3.2-40",
    "R-10.3.2-35",
)


class _Rate(Timers):
    """The rate is changed by ``times`` and ``more`` seconds."""

    change = (1.0, 0.0)

    def _next_due(self, timer: Timer, rate: float) -> float:
        times, more = self.change
        return timer.due + rate * times + more


family(
    _Rate,
    "change",
    {
        "repeats_often": Row("R-10.3.2-32", "A rate lasts half of its time.", (0.5, 0.0), also=_RATE),
        "repeats_a_little_often": Row("R-10.3.2-32", "A rate is twenty milliseconds short.", (1.0, -0.02), also=_RATE),
        "repeats_seldom": Row("R-10.3.2-30", "A rate lasts twice its time.", (2.0, 0.0), also=_RATE),
        "drifts_away": Row("R-10.3.2-32", "A rate is sixty milliseconds long.", (1.0, 0.06), also=_RATE),
    },
    TIMED,
)


@breaks("R-10.3.2-32", clauses=TIMED, also=(*_RATE, "R-10.3.2-33"))
class takes_the_rate_as_a_frequency(Timers):
    """A rate of two means two callbacks a second."""

    def _next_due(self, timer: Timer, rate: float) -> float:
        return timer.due + 1 / rate


@breaks("R-10.3.2-31", clauses=TIMED, also=_RATE)
class begins_with_the_rate(Timers):
    """The first callback of a periodic timer waits for the rate, and not for the delay."""

    def start_periodic_scheduler(self, number: int, delay: Sequence[Any], rate: Sequence[Any]) -> None:
        self._start(
            Timer(number, self._due(rate if rate[1] == s.RELATIVE_TIME else delay), float(rate[0]), list(delay))
        )


@breaks("R-10.3.2-31", clauses=TIMED, also=(*_RATE, "R-10.3.2-25", "R-10.3.2-28"))
class begins_at_once(Timers):
    """The first callback of a periodic timer comes at once."""

    def start_periodic_scheduler(self, number: int, delay: Sequence[Any], rate: Sequence[Any]) -> None:
        self._start(Timer(number, time.monotonic(), float(rate[0]), list(delay)))


@breaks("R-10.3.2-32", clauses=TIMED, also=_RATE)
class repeats_at_the_delay(Timers):
    """A periodic timer repeats at its delay."""

    def start_periodic_scheduler(self, number: int, delay: Sequence[Any], rate: Sequence[Any]) -> None:
        super().start_periodic_scheduler(number, delay, delay if delay[1] == s.RELATIVE_TIME and delay[0] else rate)


@breaks("R-10.3.2-32", clauses=TIMED, also=_RATE, readings={"timer-overrun": "skipped"})
class catches_up_what_it_declares_skipped(Base):
    """Expiries that were missed are caught up, although they are declared to be left out."""


# dates


@alters("_date_clock", "R-10.3.2-28", clauses=TIMED, also=("R-10.3.2-35", "R-10.3.2-30", "R-10.3.2-31", "R-10.3.2-32"))
def dates_come_two_seconds_late(_self: Base, now: int, _member: Member) -> int:
    """A date is reached two seconds late."""
    return now - 2_000_000_000


@alters("_date_clock", "R-10.3.2-28", clauses=TIMED, also=("R-10.3.2-35", "R-10.3.2-31", "R-10.3.2-32"))
def dates_come_early(_self: Base, now: int, _member: Member) -> int:
    """A date is reached a second early."""
    return now + 1_000_000_000


@breaks("R-10.3.2-28", clauses=TIMED, also=("R-10.3.2-21", "R-10.3.2-30", "R-10.3.2-31", "R-10.3.2-35"))
class takes_dates_as_relative(Base):
    """The flag is not looked at: a date counts from the call."""

    def _lasting(self, member: Member, time_out: Sequence[Any]) -> float:
        return float(time_out[0])


@breaks("R-10.3.2-28", clauses=TIMED, also=("R-10.3.2-35", "R-10.3.2-31", "R-10.3.2-32"))
class serves_dates_at_once(Base):
    """Every date is reached at once."""

    def _lasting(self, member: Member, time_out: Sequence[Any]) -> float:
        return 0.0 if time_out[1] == s.ABSOLUTE_TIME else super()._lasting(member, time_out)


@breaks("R-10.3.2-28", clauses=TIMED, also=("R-10.3.2-35", "R-10.3.2-30"), readings={"past-time": "never"})
class serves_a_past_that_it_declares_ignored(Base):
    """A date that has passed calls back at once, although it is declared to do nothing."""


@breaks("R-10.3.2-25", clauses=TIMED, readings={"zero-delay": "ignored"})
class serves_no_delay_that_it_declares_ignored(Base):
    """A delay of zero calls back at once, although it is declared to do nothing."""


@breaks("R-10.3.2-33", clauses=TIMED, readings={"number-in-use": "both"})
class replaces_what_it_declares_both(Base):
    """A number that is started again replaces its timer, although both are declared to run."""


@breaks("R-10.3.2-33", clauses=TIMED, also=(*MISSING_CALLBACKS,))
class loses_a_number_in_use(Timers):
    """A number that is started while it waits loses both its timers."""

    def _start(self, timer: Timer) -> None:
        if self._waiting.pop(timer.number, None) is None:
            super()._start(timer)


@breaks("R-10.3.2-26", clauses=TIMED, also=_LATE)
class serves_no_delay_late(Timers):
    """A sporadic timer with a delay of zero calls back half a second later."""

    def _due(self, time_out: Sequence[Any]) -> float:
        return super()._due(time_out) + (0.5 if list(time_out) == [0, s.RELATIVE_TIME] else 0.0)


@breaks("R-10.3.2-30", clauses=TIMED, also=(*MISSING_CALLBACKS, "R-10.3.2-32"))
class does_not_repeat_dates(Timers):
    """A periodic timer that begins at a date calls back once."""

    def start_periodic_scheduler(self, number: int, delay: Sequence[Any], rate: Sequence[Any]) -> None:
        if delay[1] == s.ABSOLUTE_TIME:
            self._start(Timer(number, self._due(delay), None, list(delay)))
        else:
            super().start_periodic_scheduler(number, delay, rate)


@breaks("R-10.3.2-42", clauses=TIMED, readings={"timer-in-startup": "ignored"})
class serves_timers_of_startup_that_it_declares_ignored(Base):
    """A timer that is set in on_startup calls back, although it is declared to have no effect."""


@breaks("R-10.3.2-32", clauses=TIMED, readings={"absolute-rate": "refused"})
class serves_rates_that_it_declares_refused(Base):
    """A rate with the flag of dates is a period, although it is declared to be refused."""


@breaks("R-10.3.2-31", clauses=TIMED, also=_RATE, readings={"first-periodic-expiry": "delay-plus-rate"})
class begins_at_the_delay_that_it_declares_later(Base):
    """The first callback of a periodic timer comes at the delay, although it is declared to come one rate later."""
