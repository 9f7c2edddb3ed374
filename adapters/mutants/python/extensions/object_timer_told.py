"""Wrong frameworks, clause 10.3.1: triggers enter wrong handlers, hand over wrong timers, or tell wrong rounds and times."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from ucm_cts.adapters.contract.programming_model import ObjectTimer
from ucm_cts.adapters.mutants.python.extensions.object_timer_triggers import TRIGGER_TIMES
from ucm_cts.adapters.mutants.python.registry import MISSING_TRIGGERS, TRIGGERED, Base, Row, breaks, family
from ucm_cts.adapters.reference.python.object_timers import Trigger, Triggers
from ucm_cts.adapters.reference.python.timers import Timer


class _Rounds(Base):
    """``told`` makes the round that a trigger tells."""

    told: Any = None

    def _round_told(self, timer: Trigger) -> int:
        return self.told(timer)  # type: ignore[no-any-return]


family(
    _Rounds,
    "told",
    {
        "tells_round_0_always": Row("R-10.3.1-24", "Every trigger tells round 0.", lambda timer: 0),
        "counts_rounds_from_two": Row("R-10.3.1-24", "Rounds are counted from 2.", lambda timer: timer.round + 2),
        "counts_rounds_by_two": Row("R-10.3.1-24", "Rounds rise by two.", lambda timer: 2 * timer.round),
        "counts_rounds_down": Row(
            "R-10.3.1-24", "Rounds are counted down.", lambda timer: timer.max_rounds - timer.round - 1
        ),
        "counts_rounds_modulo_four": Row("R-10.3.1-24", "Rounds begin anew after four.", lambda timer: timer.round % 4),
        "counts_rounds_modulo_sixteen": Row(
            "R-10.3.1-24", "Rounds begin anew after 16.", lambda timer: timer.round % 16
        ),
        "tells_all_rounds": Row(
            "R-10.3.1-24", "Every trigger tells how many rounds there are.", lambda timer: timer.max_rounds
        ),
        "tells_a_text_as_the_round": Row("R-10.3.1-24", "The round is a text.", lambda timer: str(timer.round)),
        "counts_rounds_from_one_undeclared": Row(
            "R-10.3.1-24",
            "Rounds are counted from 1, and 0 is declared.",
            lambda timer: timer.round + 1,
            (),
            {"first-round": "zero"},
        ),
    },
    TRIGGERED,
)


@breaks("R-10.3.1-24", clauses=TRIGGERED)
class counts_rounds_of_all_timers(Base):
    """Rounds count the triggers of all timers."""

    def _round_told(self, timer: Trigger) -> int:
        counts: dict[int, int] = self.manager.__dict__.setdefault("all_rounds", {})
        key = 0
        counts[key] = counts.get(key, -1) + 1
        return counts[key]


_HANDLERS = (
    *MISSING_TRIGGERS,
    *TRIGGER_TIMES,
    "R-10.3.1-24",
    "R-10.3.1-29",
    "R-10.3.1-31",
    "R-10.3.1-35",
    "R-10.3.1-30",
    "R-10.3.1-33",
)


@breaks("R-10.3.1-25", clauses=TRIGGERED, also=_HANDLERS)
class calls_the_last_handler(Triggers):
    """A timer calls the handler that was given last."""

    def _start(self, timer: Timer) -> None:
        assert isinstance(timer, Trigger)
        self.__dict__["last_handler"] = timer.handler
        super()._start(timer)

    def _next(self) -> Timer | None:
        timer = super()._next()
        if timer is None:
            return None
        with self._changed:
            current = self._waiting.get(timer.number)
            if current is timer:
                changed = replace(timer, handler=self.__dict__["last_handler"])  # type: ignore[call-arg]
                self._waiting[timer.number] = changed
                return changed
        return timer


@breaks("R-10.3.1-25", clauses=TRIGGERED, also=_HANDLERS)
class calls_the_first_handler(Triggers):
    """A timer calls the handler that was given first."""

    def _start(self, timer: Timer) -> None:
        assert isinstance(timer, Trigger)
        first = self.__dict__.setdefault("first_handler", timer.handler)
        super()._start(replace(timer, handler=first))


@breaks("R-10.3.1-25", clauses=TRIGGERED, also=_HANDLERS)
class calls_the_handler_before(Triggers):
    """A timer calls the handler of the timer that was made before it."""

    def _start(self, timer: Timer) -> None:
        assert isinstance(timer, Trigger)
        before = self.__dict__.get("handler_before", timer.handler)
        self.__dict__["handler_before"] = timer.handler
        super()._start(replace(timer, handler=before))


class _HandsOver(Base):
    """``_instead`` is handed over in place of the timer that triggers."""

    def _instead(self, triggers: Triggers, timer: Trigger) -> Any:
        raise NotImplementedError

    def _timer_told(self, triggers: Triggers, timer: Trigger) -> ObjectTimer | None:
        return self._instead(triggers, timer)  # type: ignore[no-any-return]


_OBJECTS = (
    *MISSING_TRIGGERS,
    *TRIGGER_TIMES,
    "R-10.3.1-24",
    "R-10.3.1-25",
    "R-10.3.1-29",
    "R-10.3.1-30",
    "R-10.3.1-31",
    "R-10.3.1-33",
    "R-10.3.1-01",
    "R-10.3.1-28",
)


@breaks("R-10.3.1-26", clauses=TRIGGERED, also=(*_OBJECTS, "R-10.1.1-07", "R-10.1.1-08"))
class hands_over_no_timer(_HandsOver):
    """A handler gets a null reference for its timer."""

    def _instead(self, triggers: Triggers, timer: Trigger) -> Any:
        return None


@breaks("R-10.3.1-26", clauses=TRIGGERED, also=_OBJECTS)
class hands_over_the_first_timer(_HandsOver):
    """A handler gets the timer that was made first."""

    def _instead(self, triggers: Triggers, timer: Trigger) -> Any:
        return triggers.given(replace(timer, number=1))


@breaks("R-10.3.1-26", clauses=TRIGGERED, also=_OBJECTS)
class hands_over_the_last_timer(_HandsOver):
    """A handler gets the timer that was made last."""

    def _instead(self, triggers: Triggers, timer: Trigger) -> Any:
        last = max([timer.number, *triggers._waiting])
        return triggers.given(replace(timer, number=last))


@breaks("R-10.3.1-26", clauses=TRIGGERED, also=_OBJECTS)
class hands_over_a_new_timer(_HandsOver):
    """A handler gets a new object, with an identifier that no timer has."""

    def _instead(self, triggers: Triggers, timer: Trigger) -> Any:
        return triggers.given(replace(timer, number=triggers._new_number() + 1000))


class _Delta(Base):
    """``told`` makes the time difference that a trigger tells, of its time as the framework has it."""

    told: Any = None

    def _delta_time(self, timer: Trigger) -> Sequence[int]:
        return self.told(timer, super()._delta_time(timer))  # type: ignore[no-any-return]


family(
    _Delta,
    "told",
    {
        "tells_no_time_difference": Row(
            "R-10.3.1-27",
            "delta_time is 0, and the delay is declared.",
            lambda *_: [0, 0],
            (),
            {"delta-time": "requested"},
        ),
        "tells_negative_time_differences": Row("R-10.3.1-27", "delta_time is negative.", lambda _, own: [-1, own[1]]),
        "tells_milliseconds_of_difference": Row(
            "R-10.3.1-27",
            "delta_time has milliseconds where microseconds are due.",
            lambda _, own: [own[0], own[1] // 1000],
            (),
            {"delta-time": "requested"},
        ),
        "tells_microseconds_only": Row(
            "R-10.3.1-27", "delta_time is in microseconds alone.", lambda _, own: [0, own[0] * 10**6 + own[1] + 10**6]
        ),
        "tells_seconds_only": Row("R-10.3.1-27", "delta_time has seconds only.", lambda _, own: [own[0]]),
        "tells_the_start_delay_always": Row(
            "R-10.3.1-27",
            "delta_time is the start delay, also in later rounds.",
            lambda timer, _: list(timer.asked),
            (),
            {"delta-time": "requested"},
        ),
        "tells_lateness_undeclared": Row(
            "R-10.3.1-27",
            "delta_time is the lateness, and the time since the call is declared.",
            lambda *_: [0, 500],
            (),
            {"delta-time": "since-scheduled"},
        ),
        "tells_the_delay_undeclared": Row(
            "R-10.3.1-27",
            "delta_time is the interval, and the time since the call is declared.",
            lambda _, own: own,
            (),
            {"delta-time": "since-scheduled"},
        ),
        "tells_the_delay_as_lateness": Row(
            "R-10.3.1-27",
            "delta_time is the delay, and the lateness is declared.",
            lambda _, own: own,
            (),
            {"delta-time": "lateness"},
        ),
    },
    TRIGGERED,
)
