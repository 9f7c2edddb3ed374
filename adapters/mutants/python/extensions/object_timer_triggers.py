"""Wrong frameworks, clause 10.3.1: triggers come early, late, seldom, too often, or beside other executions."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from ucm_cts.adapters.mutants.python.methods import alters
from ucm_cts.adapters.mutants.python.registry import MISSING_TRIGGERS, TRIGGERED, Base, Row, breaks, family
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.object_timers import Trigger, Triggers
from ucm_cts.adapters.reference.python.timers import Timer

TRIGGER_TIMES = ("R-10.3.1-19", "R-10.3.1-20", "R-10.3.1-21", "R-10.3.1-22", "R-10.3.1-26", "R-10.3.1-27")
_EARLY = (*TRIGGER_TIMES, "R-10.3.1-31", "R-10.3.1-33", "R-10.3.1-18", "R-10.3.1-23", "R-10.3.1-35", "R-10.3.1-30")
_LATE = (*TRIGGER_TIMES, *MISSING_TRIGGERS)


class _Due(Triggers):
    """``due`` makes another delay, in seconds, from the one that was asked for."""

    due_after: Any = None

    def _due(self, time_out: Sequence[Any]) -> float:
        return time.monotonic() + float(self.due_after(time_out[0] + time_out[1] / 1e6))


family(
    _Due,
    "due_after",
    {
        "triggers_a_little_early": Row("R-10.3.1-19", "A trigger is ten ms early.", lambda s: max(0, s - 0.01), _EARLY),
        "triggers_at_half_its_time": Row("R-10.3.1-19", "A delay lasts half of its time.", lambda s: s / 2, _EARLY),
        "triggers_at_once": Row("R-10.3.1-19", "Every timer is due at once.", lambda _: 0, _EARLY),
        "drops_microseconds": Row("R-10.3.1-19", "Delays are whole seconds, rounded down.", math.floor, _EARLY),
        "drops_seconds": Row("R-10.3.1-19", "Only the microseconds of a delay count.", lambda s: s % 1, _EARLY),
        "rounds_delays": Row(
            "R-10.3.1-19", "Delays are rounded to tenths of seconds.", lambda s: round(s, 1), (*_EARLY, *_LATE)
        ),
        "triggers_late": Row("R-10.3.1-20", "A trigger is a quarter of a second late.", lambda s: s + 0.25, _LATE),
        "takes_delays_as_milliseconds": Row(
            "R-10.3.1-19",
            "The microseconds of a delay are taken as nanoseconds.",
            lambda s: s // 1 + s % 1 / 1000,
            _EARLY,
        ),
        "rounds_delays_up": Row("R-10.3.1-18", "Delays are whole seconds, rounded up.", math.ceil, _LATE),
        "triggers_at_double_its_time": Row("R-10.3.1-20", "A delay lasts twice its time.", lambda s: 2 * s, _LATE),
    },
    TRIGGERED,
)


@breaks("R-10.3.1-18", clauses=TRIGGERED, also=(*_LATE, "R-10.3.1-25"))
class never_triggers(Triggers):
    """No timer ever triggers."""

    def _next(self) -> Timer | None:
        self.trigger.ended.wait()
        return None


@breaks("R-10.3.1-20", clauses=TRIGGERED, also=(*_LATE,))
class looks_three_times_a_second(Triggers):
    """Timers are looked after three times a second only."""

    def _next(self) -> Timer | None:
        timer = super()._next()
        if timer is not None and time.monotonic() - timer.due < 0.05:
            self.trigger.ended.wait(0.333 - time.monotonic() % 0.333)
        return timer


class _Bounded(Triggers):
    """``rounds`` makes another number of rounds from the one that was asked for; ``is_single`` timers have it, too."""

    rounds_made: Any = None

    def _is_last(self, timer: Trigger) -> bool:
        return timer.round + 1 >= int(self.rounds_made(timer.max_rounds))


family(
    _Bounded,
    "rounds_made",
    {
        "makes_one_round_more": Row(
            "R-10.3.1-23", "A repeated timer triggers once more.", lambda n: n + 1, ("R-10.3.1-31",)
        ),
        "makes_one_round_fewer": Row(
            "R-10.3.1-23", "A repeated timer triggers once less.", lambda n: max(1, n - 1), MISSING_TRIGGERS
        ),
        "makes_one_round_only": Row(
            "R-10.3.1-23", "A repeated timer triggers once.", lambda _: 1, (*MISSING_TRIGGERS, "R-10.3.1-24")
        ),
        "makes_two_rounds_always": Row(
            "R-10.3.1-23", "A repeated timer triggers twice.", lambda _: 2, (*MISSING_TRIGGERS, "R-10.3.1-31")
        ),
        "makes_eight_rounds_at_most": Row(
            "R-10.3.1-23", "A repeated timer triggers eight times at most.", lambda n: min(n, 8), MISSING_TRIGGERS
        ),
        "makes_rounds_without_end": Row(
            "R-10.3.1-23", "A repeated timer triggers without end.", lambda _: 2**32, ("R-10.3.1-31", "R-10.3.1-30")
        ),
    },
    TRIGGERED,
)

_ANOTHER = ("R-10.3.1-23", "R-10.3.1-24", "R-10.3.1-31", "R-10.3.1-19", "R-10.3.1-26", "R-10.3.1-27", "R-10.3.1-30")


@breaks("R-10.3.1-18", clauses=TRIGGERED, also=_ANOTHER)
class triggers_twice(Base):
    """A timer with one trigger triggers twice."""

    def _trigger(self, member: Member, triggers: Triggers, timer: Timer) -> None:
        super()._trigger(member, triggers, timer)
        assert isinstance(timer, Trigger)
        if timer.rate is None and not triggers.trigger.ended.is_set():
            timer.handler.on_trigger(triggers.given(timer), self._delta_time(timer), timer.round)


@breaks("R-10.3.1-18", clauses=TRIGGERED, also=_ANOTHER)
class triggers_again_later(Triggers):
    """A timer with one trigger triggers again after another delay."""

    def _following(self, timer: Timer) -> Timer | None:
        following = super()._following(timer)
        is_first = isinstance(timer, Trigger) and timer.rate is None and timer.due - timer.scheduled < 0.65
        return replace(timer, due=timer.due + 0.7) if is_first else following


class _Repeats(Triggers):
    """``times`` makes another start delay and interval, in seconds, from those that were asked for."""

    times: Any = None

    def _start(self, timer: Timer) -> None:
        if timer.rate is not None:
            now = time.monotonic()
            delay, rate = self.times(timer.due - now, timer.rate)
            timer = replace(timer, due=now + delay, rate=rate)
        super()._start(timer)


_SERIES = (*_LATE, "R-10.3.1-23", "R-10.3.1-31", "R-10.3.1-24")

family(
    _Repeats,
    "times",
    {
        "first_trigger_comes_at_once": Row(
            "R-10.3.1-21", "The first repeated trigger comes at once.", lambda d, i: (0, i), (*_EARLY,)
        ),
        "first_trigger_comes_after_the_interval": Row(
            "R-10.3.1-21",
            "The first repeated trigger comes after one interval.",
            lambda d, i: (i, i),
            (*_EARLY, *_LATE),
        ),
        "first_trigger_comes_one_interval_late": Row(
            "R-10.3.1-21", "The first repeated trigger comes one interval late.", lambda d, i: (d + i, i), _SERIES
        ),
        "first_trigger_comes_half_an_interval_late": Row(
            "R-10.3.1-21",
            "The first repeated trigger comes half an interval late.",
            lambda d, i: (d + i / 2, i),
            _SERIES,
        ),
        "repeats_after_the_start_delay": Row(
            "R-10.3.1-22", "The start delay is the interval, too.", lambda d, i: (d, d), (*_EARLY, *_SERIES)
        ),
        "repeats_twice_as_often": Row("R-10.3.1-22", "The interval is half as long.", lambda d, i: (d, i / 2), _EARLY),
        "repeats_half_as_often": Row("R-10.3.1-22", "The interval is twice as long.", lambda d, i: (d, 2 * i), _SERIES),
        "repeats_a_little_too_often": Row(
            "R-10.3.1-22", "The interval is 2 % too short.", lambda d, i: (d, 0.98 * i), _EARLY
        ),
        "repeats_a_little_too_seldom": Row(
            "R-10.3.1-22", "The interval is 5 % too long.", lambda d, i: (d, 1.05 * i), _SERIES
        ),
        "counts_intervals_from_the_start": Row(
            "R-10.3.1-22",
            "The interval includes the start delay.",
            lambda d, i: (d, max(0.05, i - d)),
            (*_EARLY, *_SERIES),
        ),
    },
    TRIGGERED,
)


@alters("_next_due", "R-10.3.1-22", clauses=TRIGGERED, also=_SERIES)
def triggers_drift(_self: Triggers, due: float, _timer: Timer, _rate: float) -> float:
    """Each interval lasts four milliseconds longer."""
    return due + 0.004


class _Waits(Triggers):
    """``most`` timers wait at once; others are due when one of them has ended, and then after their whole delay."""

    most = 1

    def _start(self, timer: Timer) -> None:
        if len(self._waiting) < self.most:
            super()._start(timer)
        else:
            self.__dict__.setdefault("queued", []).append(timer)

    def take(self, timer: Timer) -> bool:
        taken = super().take(timer)
        queued = self.__dict__.get("queued")
        if queued and len(self._waiting) < self.most:
            following = queued.pop(0)
            super()._start(replace(following, due=max(following.due, time.monotonic() + 0.3)))
        return taken


_QUEUED = (*_LATE, "R-10.3.1-20", "R-10.3.1-25", "R-10.3.1-31", "R-10.3.1-33")

family(
    _Waits,
    "most",
    {
        "waits_for_one_timer": Row("R-10.3.1-34", "One timer waits at a time.", 1, _QUEUED),
        "waits_for_two_timers": Row("R-10.3.1-34", "Two timers wait at a time.", 2, _QUEUED),
        "waits_for_sixteen_timers": Row("R-10.3.1-20", "Sixteen timers wait at a time.", 16, _QUEUED),
    },
    TRIGGERED,
)


@breaks("R-10.3.1-34", clauses=TRIGGERED, also=_QUEUED)
class replaces_the_timer_of_a_handler(Triggers):
    """A handler has one timer: a new one takes the place of the one before."""

    def _start(self, timer: Timer) -> None:
        assert isinstance(timer, Trigger)
        with self._changed:
            for one in list(self._waiting.values()):
                if isinstance(one, Trigger) and one.handler is timer.handler:
                    del self._waiting[one.number]
        super()._start(timer)


@breaks("R-10.3.1-20", clauses=TRIGGERED, also=(*_QUEUED, "R-10.3.1-22"))
class triggers_in_the_order_of_calls(Triggers):
    """Timers trigger in the order in which they were made."""

    def _next(self) -> Timer | None:
        with self._changed:
            first = min(self._waiting, default=None)
            if first is not None:
                for timer in list(self._waiting.values()):
                    if timer.due < self._waiting[first].due:
                        self._waiting[timer.number] = replace(timer, due=self._waiting[first].due)
        return super()._next()


# protection


@breaks("R-10.3.1-36", clauses=TRIGGERED, also=("R-10.3.1-18",))
class triggers_beside_other_executions(Base):
    """A trigger enters a protected component that is executed."""

    def _execute_callback(self, member: Member, work: Callable[[], None]) -> None:
        work()


@breaks("R-10.3.1-36", clauses=TRIGGERED, also=MISSING_TRIGGERS)
class drops_triggers_of_busy_components(Base):
    """A trigger is dropped if its component is executed."""

    def _trigger(self, member: Member, triggers: Triggers, timer: Timer) -> None:
        if member.execution.thread_inside is None:
            super()._trigger(member, triggers, timer)
        else:
            triggers.take(timer)


@breaks("R-10.3.1-36", clauses=TRIGGERED, also=("R-10.3.1-18", "R-10.3.1-34"))
class triggers_beside_triggers(Base):
    """Two timers of one component trigger at once, each on a thread of its own."""

    def _trigger(self, member: Member, triggers: Triggers, timer: Timer) -> None:
        assert isinstance(timer, Trigger)
        if triggers.take(timer):
            told = self._timer_told(triggers, timer), self._delta_time(timer), self._round_told(timer)
            ended = triggers.trigger.ended

            def enter() -> None:
                if not ended.is_set():
                    timer.handler.on_trigger(*told)  # type: ignore[arg-type]

            threading.Thread(target=enter, daemon=True).start()


family(
    _Due,
    "due_after",
    {
        "triggers_at_once_below_a_tick": Row(
            "R-10.3.1-19", "Delays below 50 ms are due at once.", lambda s: s if s >= 0.05 else 0, _EARLY
        ),
        "keeps_delays_in_nanoseconds_of_32_bits": Row(
            "R-10.3.1-19", "Delays are nanoseconds of 32 bits.", lambda s: round(s * 10**9) % 2**32 / 10**9, _EARLY
        ),
        "keeps_delays_in_signed_nanoseconds": Row(
            "R-10.3.1-19", "Delays are nanoseconds of 31 bits.", lambda s: max(0, s if s < 2.147 else 0), _EARLY
        ),
        "keeps_delays_in_milliseconds_of_16_bits": Row(
            "R-10.3.1-19", "Delays are milliseconds of 16 bits.", lambda s: int(s * 1000 + 0.999) % 2**16 / 1000, _EARLY
        ),
    },
    TRIGGERED,
)

family(
    _Bounded,
    "rounds_made",
    {
        "keeps_rounds_in_5_bits": Row(
            "R-10.3.1-23", "A repeated timer has 31 rounds at most.", lambda n: min(n, 31), MISSING_TRIGGERS
        ),
        "keeps_rounds_in_31_bits": Row(
            "R-10.3.1-23", "Rounds are numbers of 31 bits.", lambda n: n if n < 2**31 else 1, MISSING_TRIGGERS
        ),
    },
    TRIGGERED,
)


@breaks("R-10.3.1-20", clauses=TRIGGERED, also=(*_QUEUED, "R-10.3.1-35"))
class is_not_woken_by_earlier_timers(Triggers):
    """A timer that is due before those that wait is noticed when the first of these is due."""

    def _start(self, timer: Timer) -> None:
        first = min((one.due for one in self._waiting.values()), default=timer.due)
        super()._start(replace(timer, due=max(timer.due, first)))


@breaks("R-10.3.1-36", clauses=TRIGGERED, also=MISSING_TRIGGERS)
class rounds_enter_beside_other_executions(Base):
    """A trigger of a repeated timer enters a protected component that is executed."""

    def _trigger(self, member: Member, triggers: Triggers, timer: Timer) -> None:
        if timer.rate is not None:
            member.__dict__["is_spared"] = True
        super()._trigger(member, triggers, timer)
        member.__dict__.pop("is_spared", None)

    def _execute_callback(self, member: Member, work: Callable[[], None]) -> None:
        if member.__dict__.get("is_spared"):
            work()
        else:
            super()._execute_callback(member, work)
