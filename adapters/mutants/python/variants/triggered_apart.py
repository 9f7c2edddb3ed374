"""Conformant frameworks, clause 10.3.1: what becomes of rounds whose component is not free, or whose handler raises.

A trigger may be taken when it is due, with all that it tells, and enter its component later.
"""

from __future__ import annotations

import math
import queue
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace

from ucm_cts.adapters.mutants.python.registry import TIMED, TRIGGERED, Base, variant_of
from ucm_cts.adapters.mutants.python.variants import timed
from ucm_cts.adapters.mutants.python.variants.triggered import (
    for_objects,
    resumes_triggers,
    tells_rounds_done,
    tells_rounds_left,
    tells_time_since_last,
)
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.object_timers import ScheduledTimer, Trigger, Triggers
from ucm_cts.adapters.reference.python.timers import Timer


class _TakesWhenDue(Base):
    """A trigger is taken when it is due, with all that it tells; ``_pass_on`` has it enter the component."""

    def _trigger(self, member: Member, triggers: Triggers, timer: Timer) -> None:
        assert isinstance(timer, Trigger)
        is_wanted = self._is_wanted(member, timer)
        if triggers.take(timer) and is_wanted:
            told = self._timer_told(triggers, timer), self._delta_time(timer), self._round_told(timer)

            def enter() -> None:
                if not triggers.trigger.ended.is_set():
                    timer.handler.on_trigger(*told)  # type: ignore[arg-type]

            def execute() -> None:
                with suppress(Exception):
                    self._execute_callback(member, enter)

            self._pass_on(triggers, execute)

    def _is_wanted(self, member: Member, timer: Trigger) -> bool:
        return True

    def _pass_on(self, triggers: Triggers, execute: Callable[[], None]) -> None:
        raise NotImplementedError

    def _end_execution(self, member: Member) -> None:
        super()._end_execution(member)
        for triggers in member.schedulers:
            for thread in triggers.__dict__.get("threads", ()):
                thread.join()

    def _begin_thread(self, triggers: Triggers, work: Callable[[], None]) -> None:
        thread = threading.Thread(target=work, daemon=True)
        triggers.__dict__.setdefault("threads", []).append(thread)
        thread.start()


@variant_of(*TRIGGERED, readings={"object-timer-cancel": "tolerant", "object-timer-overrun": "queued"})
class triggers_on_own_threads(_TakesWhenDue):
    """Each trigger has a thread of its own, which waits for the component."""

    def _pass_on(self, triggers: Triggers, execute: Callable[[], None]) -> None:
        self._begin_thread(triggers, execute)


@variant_of(*TRIGGERED, readings={"object-timer-cancel": "tolerant", "object-timer-overrun": "skipped"})
class leaves_out_rounds_while_executed(triggers_on_own_threads):
    """A round that is due while its protected component is executed is left out, and counts."""

    def _is_wanted(self, member: Member, timer: Trigger) -> bool:
        is_busy = self._is_protected(member) and member.execution.thread_inside is not None
        return timer.rate is None or not is_busy


class _Posts(_TakesWhenDue):
    """Triggers are put in a queue of their component, which a thread serves."""

    def _pass_on(self, triggers: Triggers, execute: Callable[[], None]) -> None:
        posts: queue.SimpleQueue[Callable[[], None] | None] | None = triggers.__dict__.get("posts")
        if posts is None:
            posts = triggers.__dict__["posts"] = queue.SimpleQueue()
            serve: Callable[[], Callable[[], None] | None] = posts.get

            def work() -> None:
                while done := serve():
                    done()

            self._begin_thread(triggers, work)
        posts.put(execute)

    def _end_execution(self, member: Member) -> None:
        for triggers in member.schedulers:
            triggers.trigger.ended.set()
            if posts := triggers.__dict__.get("posts"):
                posts.put(None)
        super()._end_execution(member)


@variant_of(
    *TRIGGERED,
    readings={"object-timer-cancel": "tolerant", "object-timer-overrun": "queued", "rounds-attribute": "done"},
)
class posts_triggers(_Posts):
    """Triggers are put in a queue; all of them come, also when their timer is cancelled, and ``rounds`` counts them when they are put there."""

    triggers_class = tells_rounds_done


@variant_of(*TRIGGERED, readings={"delta-time": "since-last", "object-is-cancelled": "inactive"})
class posts_triggers_with_the_time_since_the_last(_Posts, tells_time_since_last):
    """The same; they tell the time between two expiries, and a timer whose triggers have all been put there is inactive."""

    triggers_class = for_objects(timed.says_what_is_inactive, "posted")


class _Counts(Triggers):
    """Rounds that pass while the timer cannot trigger are left out, and count."""

    def _next(self) -> Timer | None:
        now = time.monotonic()
        with self._changed:
            for timer in list(self._waiting.values()):
                assert isinstance(timer, Trigger)
                if timer.rate is not None and timer.due < now - 0.05:
                    missed = math.ceil((now - timer.due) / timer.rate)
                    del self._waiting[timer.number]
                    if timer.round + missed < timer.max_rounds:
                        due = timer.due + missed * timer.rate
                        self._waiting[timer.number] = replace(timer, due=due, round=timer.round + missed)
        return super()._next()


@variant_of(*TRIGGERED, readings={"object-timer-overrun": "skipped"})
class leaves_out_rounds_that_count(_Counts):
    """Rounds that pass while the timer cannot trigger are left out, and count."""


@variant_of(*TRIGGERED, readings={"object-timers-at-stop": "resumed", "object-timer-overrun": "skipped"})
class resumes_what_is_left_of_rounds(resumes_triggers):
    """The same, and so are rounds that pass while the component is stopped; those that are left come afterwards."""

    triggers_class = _Counts


class _Merges(Triggers):
    """A trigger stands for all rounds that have passed, and tells the last of them."""

    def take(self, timer: Timer) -> bool:
        assert isinstance(timer, Trigger)
        with self._changed:
            if self._waiting.get(timer.number) is not timer:
                return False
            last, now = timer, time.monotonic()
            while last.rate is not None and last.round + 1 < last.max_rounds and last.due + last.rate <= now:
                last = replace(last, due=last.due + last.rate, round=last.round + 1)
            timer.__dict__["last_round"] = last.round
            following = self._following(last)
            del self._waiting[timer.number]
            if following is not None:
                self._waiting[timer.number] = following
            return True


@variant_of(*TRIGGERED, readings={"object-timer-overrun": "merged"})
class merges_rounds_that_count(Base):
    """One trigger stands for all rounds that have passed, and tells the last of them."""

    triggers_class = _Merges

    def _round_told(self, timer: Trigger) -> int:
        last: int = timer.__dict__["last_round"]
        return last


def _of_repeated(timer_class: type[ScheduledTimer]) -> type[ScheduledTimer]:
    """``timer_class``, but that a timer with one trigger has no rounds."""

    def rounds(timer: ScheduledTimer) -> int:
        return 0 if timer.timer.rate is None else timer_class.rounds(timer)

    return type("OfRepeated", (timer_class,), {"rounds": rounds})


@variant_of(*TRIGGERED, readings={"rounds-attribute": "done"})
class tells_rounds_done_of_repeated_triggers(Base):
    """rounds is the number of triggers that have come, and 0 for a timer with one trigger."""

    triggers_class = type("Done", (tells_rounds_done,), {"timer_class": _of_repeated(tells_rounds_done.timer_class)})


@variant_of(*TRIGGERED, readings={"rounds-attribute": "left"})
class tells_rounds_left_of_repeated_triggers(Base):
    """rounds is the number of triggers that are to come, and 0 for a timer with one trigger."""

    triggers_class = type("Left", (tells_rounds_left,), {"timer_class": _of_repeated(tells_rounds_left.timer_class)})


class EndsObjectsThatRaise(Base):
    """A repeated timer whose handler raises triggers no more."""

    def _call_handler(self, triggers: Triggers, timer: Trigger) -> None:
        try:
            super()._call_handler(triggers, timer)
        except Exception:
            triggers._waiting.pop(timer.number, None)
            raise


@variant_of(*TRIGGERED, readings={"object-callback-exception": "ends"})
class ends_objects_whose_handler_raises(EndsObjectsThatRaise):
    """A repeated timer whose handler raises triggers no more."""


@variant_of(*TRIGGERED, readings={"callback-exception": "observed", "object-callback-exception": "as-index-timers"})
class ends_objects_whose_handler_raises_unasked(EndsObjectsThatRaise):
    """The same, without a declaration."""


class EndsTimersThatRaise(Base):
    """A periodic timer whose callback raises calls back no more."""

    def _call_body(self, member: Member, timer: Timer) -> None:
        try:
            super()._call_body(member, timer)
        except Exception:
            self._timers_of(member)._waiting.pop(timer.number, None)
            raise


@variant_of(*TIMED, readings={"callback-exception": "ends"})
class ends_timers_whose_callback_raises(EndsTimersThatRaise):
    """A periodic timer whose callback raises calls back no more."""
