"""When a timer may call back at the earliest and must at the latest, by the vendor's readings (10.3)."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.reference_models.model.clock_reading import ClockReading
from ucm_cts.reference_models.model.clock_readings import LOCAL, SYNCHRONIZED
from ucm_cts.reference_models.model.execution_policies import protection_of
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.paced_phases import granularity, lateness
from ucm_cts.reference_models.model.service_policies import has_timers
from ucm_cts.reference_models.model.timer_events import SECOND, Kind, Timer, TimerCallback
from ucm_cts.reference_models.model.timer_options import reading_of

CLOCKS = {"local": LOCAL, "synchronized": SYNCHRONIZED}
"""The readings of ``absolute-clock``, with the method that reads each clock."""

_FIRST = {
    "index": ("first-periodic-expiry", "delay-plus-rate"),
    "object": ("first-repeated-trigger", "delay-plus-interval"),
}
"""The option that says when a timer that repeats calls back first, and its reading that makes that later."""

MOST = 100
"""So many callbacks of one timer are judged one by one: a framework may call back without end."""


def earliest(runtime: ObservedRuntime, timer: Timer, number: int) -> int | None:
    """Before when callback ``number`` of ``timer``, from 0, cannot come; None if that is not known."""
    begun = _begun(runtime, timer)
    if begun is None:
        return None
    due = begun[0] + _after(runtime, timer, number)
    return max(due, timer.phase.of.started.t if timer.is_in_startup else 0) - granularity(runtime)


def latest(runtime: ObservedRuntime, timer: Timer, number: int) -> int | None:
    """Until when it must have come if nothing keeps it out; None if that is not known."""
    begun = _begun(runtime, timer)
    if begun is None:
        return None
    chained = number if reading_of(runtime, timer.kind, "timer-anchor") == "chained" else 0
    due = begun[1] + _after(runtime, timer, number) + (chained + 1) * lateness(runtime)
    end = timer.phase.of.start.end
    return max(due, end.t + lateness(runtime)) if timer.is_in_startup and end is not None else due


def goes_on_after_exceptions(runtime: ObservedRuntime, kind: Kind) -> bool:
    """Do timers of ``kind`` that repeat go on when a callback of theirs raises, as their vendor declares?"""
    return reading_of(runtime, kind, "callback-exception") == "continues"


def last_expiry(runtime: ObservedRuntime, timer: Timer) -> int | None:
    """Before when ``timer`` cannot have made its last round, also if others were left out; None if it has no end, or that is not known."""
    return None if timer.most is None else earliest(runtime, timer, timer.most - 1)


def first_after(runtime: ObservedRuntime, timer: Timer) -> int:
    """How long after its delay the first callback of ``timer`` is due, in nanoseconds."""
    return _after(runtime, timer, 0)


def _after(runtime: ObservedRuntime, timer: Timer, number: int) -> int:
    """How long after the first instant callback ``number`` is due."""
    if timer.rate is None:
        return 0
    option, later = _FIRST[timer.kind]
    return (number + (runtime.ics.reading(option) == later)) * timer.rate.lasts


def _begun(runtime: ObservedRuntime, timer: Timer) -> tuple[int, int] | None:
    """Between which moments the delay has passed; None if the call has not returned, or its date cannot be told."""
    if timer.begun == "open":
        timer.begun = _begin(runtime, timer)
    return timer.begun


def _begin(runtime: ObservedRuntime, timer: Timer) -> tuple[int, int] | None:
    call = timer.call
    if call.reply is None:
        return None
    if not timer.delay.is_absolute:
        return call.request.t + timer.delay.lasts, call.reply.t + timer.delay.lasts
    reading = _reading_for(runtime, timer)
    if reading is None:
        return None
    remaining = timer.delay.lasts - reading.time
    return max(reading.asked + remaining, call.request.t), max(reading.answered + remaining, call.reply.t)


def _reading_for(runtime: ObservedRuntime, timer: Timer) -> ClockReading | None:
    """The reading of the declared clock from which the body made the date."""
    return read_before(timer, CLOCKS.get(runtime.ics.reading("absolute-clock"), ""))


def read_before(timer: Timer, method: str) -> ClockReading | None:
    """What the component read by ``method`` last before it started ``timer``."""
    before = (r for r in timer.phase.readings.get(method, ()) if r.end < timer.call.request.n)
    return max(before, key=lambda reading: reading.end, default=None)


def read_in(timer: Timer, method: str, callback: TimerCallback) -> ClockReading | None:
    """What it read by ``method`` first in ``callback``."""
    left = callback.execution.end if callback.execution.over else callback.n
    own = (r for r in timer.phase.readings.get(method, ()) if callback.n < r.begin < left)
    return next(own, None)


def free_after(runtime: ObservedRuntime, timer: Timer, due: int, before: int) -> int | None:
    """When the component was free for a callback that was due at ``due`` and has not come until ``before``; None if it never was.

    Its executions may keep the callback out, and so may those of other components with timers, as one thread may call all of them.
    """
    free = due
    for begin, end in sorted(busy(runtime, before), key=lambda span: span[0]):
        if begin > free + lateness(runtime):
            break
        if end is None:
            return None
        free = max(free, end)
    return free


def busy(runtime: ObservedRuntime, before: int) -> Iterator[tuple[int, int | None]]:
    """When executions began and ended that may keep a callback out: one thread may wait for any component that has timers."""
    for member in runtime.bodies.values():
        if has_timers(member.declaration):
            for execution in runtime.executions.of(member.body):
                if execution.enter.t < before:
                    yield execution.enter.t, execution.left if execution.over else None


def is_long(runtime: ObservedRuntime, begin: int, end: int | None) -> bool:
    """May an execution that began and ended then keep more than one callback out?"""
    return end is None or end - begin > lateness(runtime)


def may_be_delayed(runtime: ObservedRuntime, callback: TimerCallback, since: int = 0) -> bool:
    """Did another execution of a component with timers, for longer than a moment, end so lately that it may have kept ``callback`` out, or, with
    ``since``, after that?
    """
    for member in runtime.bodies.values():
        for one in runtime.executions.of(member.body) if has_timers(member.declaration) else ():
            is_other = one is not callback.execution and one.enter.n < callback.n
            since_when = since or callback.t - SECOND
            if is_other and (not one.over or (one.left - one.enter.t > SECOND // 20 and one.left > since_when)):
                return True
    return False


def is_kept_out(runtime: ObservedRuntime, timer: Timer, callback: TimerCallback, due: int) -> bool:
    """Was the component, which is protected, executed when the callback was due, for longer than the declared lateness?"""
    if protection_of(timer.phase.member.declaration) in ("", "unprotected"):
        return False
    late = lateness(runtime)
    return any(
        e.enter.t < due and e.over and due + late < e.left <= callback.t
        for e in timer.phase.executions
        if e is not callback.execution
    )


def is_late(runtime: ObservedRuntime, timer: Timer, number: int) -> bool:
    """Did callback ``number`` come so late that something kept it out? Then it need not be the one of that number."""
    due = latest(runtime, timer, number)
    return due is None or timer.callbacks[number].t > due


def overrun(runtime: ObservedRuntime, timer: Timer) -> int:
    """The number of the first callback of a periodic ``timer`` that may have come at another time because something lasted too long; that
    of its callbacks if there is none.
    """
    if timer.disturbed is None:
        timer.disturbed = _overrun(runtime, timer)
    return timer.disturbed


def sure_rounds(runtime: ObservedRuntime, timer: Timer) -> int:
    """How many of its callbacks, from the first one, are certainly those of its first rounds."""
    number = overrun(runtime, timer)
    is_own = number < len(timer.callbacks) and (timer.rate is None or not is_late(runtime, timer, number))
    return number + is_own


def _overrun(runtime: ObservedRuntime, timer: Timer) -> int:
    if timer.rate is None:
        return len(timer.callbacks)
    for number, callback in enumerate(timer.callbacks):
        left = callback.execution.left if callback.execution.over else callback.t + timer.rate.lasts
        if is_late(runtime, timer, number) or left - callback.t >= timer.rate.lasts - lateness(runtime):
            return number
    return len(timer.callbacks)
