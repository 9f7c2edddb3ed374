"""Properties about the times of timers: dates, times that are unusual, missed expiries, and what callbacks of index timers tell (10.3)."""

from __future__ import annotations

from ucm_cts.reference_models.conclusions import Conclusions, takes
from ucm_cts.reference_models.model.clock_reading import ClockReading
from ucm_cts.reference_models.model.clock_readings import passed
from ucm_cts.reference_models.model.index_timers import timer_phases
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.paced_events import MILLISECOND
from ucm_cts.reference_models.model.paced_phases import granularity, lateness, shown
from ucm_cts.reference_models.model.phases import noticed
from ucm_cts.reference_models.model.timer_events import SECOND, TimeOut, Timer, TimerCallback, TimerPhase
from ucm_cts.reference_models.model.timer_options import option_of, reading_of
from ucm_cts.reference_models.model.timer_times import (
    CLOCKS,
    MOST,
    first_after,
    free_after,
    is_late,
    latest,
    may_be_delayed,
    overrun,
    read_before,
    read_in,
)
from ucm_cts.reference_models.model.timers import all_timer_phases
from ucm_cts.reference_models.properties.clause_10_3 import EARLY, LATE, PHASES, RATE, at_of, both
from ucm_cts.reference_models.properties.declaration import Property, property_at

_DATES, _TIME_TOLD = "R-10.3.2-28", "R-10.3.2-35"
_UNUSUAL = both(EARLY, RATE, LATE, PHASES)


def _clocks(runtime: ObservedRuntime) -> list[str]:
    """The methods of the clocks that may decide on dates."""
    declared = runtime.ics.reading("absolute-clock")
    return [CLOCKS[declared]] if declared in CLOCKS else [*CLOCKS.values()]


@property_at("closed", _DATES, feature="timers", timed=True)
def absolute_times_are_dates(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A timer with an absolute time calls back when the clock has reached it, and no later than declared."""
    for phase in timer_phases(runtime):
        for timer in phase.timers:
            if timer.delay.is_absolute and timer.is_started and not timer.is_contested and not timer.cancels:
                yield from _dated(check, runtime, phase, timer)


def _dated(check: Property, runtime: ObservedRuntime, phase: TimerPhase, timer: Timer) -> Conclusions:
    methods = _clocks(runtime)
    before = {m: r for m in methods if (r := read_before(timer, m)) is not None}
    if not before or any(passed(timer.delay.lasts, r.time) >= 0 for r in before.values()):
        return  # a date that had passed already is a matter of its own
    date = timer.delay.lasts + first_after(runtime, timer)
    expected = f"timer {timer.number} of '{phase.member.lane}' calls back when the clock shows {date // SECOND} s"
    if timer.callbacks:
        callback = timer.callbacks[0]
        read = {m: r for m in methods if (r := read_in(timer, m, callback)) is not None}
        if len(read) < len(methods) or any(m in before and _was_set(runtime, before[m], r) for m, r in read.items()):
            return
        missing = [passed(r.time, date) for r in read.values()]
        over = [passed(date, r.time) - (r.answered - callback.t) for r in read.values()]
        if min(missing) > granularity(runtime):
            yield check.fail(
                "early",
                expected=expected,
                observed=f"the clock showed {shown(min(missing))} less",
                at=at_of(timer, callback),
            )
        elif min(over) > lateness(runtime) and not may_be_delayed(runtime, callback):
            yield check.fail(
                "late",
                expected=f"{expected}, or as much later as timer-lateness says",
                observed=f"the clock showed {shown(min(over))} more",
                at=at_of(timer, callback),
                late_by=min(over) - lateness(runtime),
            )
        else:
            yield check.kept()
        return
    if len(before) < len(methods):
        return  # it may be a date of the clock that was not read
    remaining = max(r.answered + passed(r.time, date) for r in before.values())
    if remaining + lateness(runtime) < timer.until[1] and all(e.over for e in phase.executions):
        at = (*at_of(timer), *noticed(runtime, remaining))
        yield check.fail("never", expected=expected, observed="it did not call back", at=at)


def _was_set(runtime: ObservedRuntime, earlier: ClockReading, later: ClockReading) -> bool:
    """Did the clock go on by another amount than the recorder's clock?"""
    tolerance = int(runtime.ics.tolerance("clock-tolerance") * MILLISECOND) + (later.answered - earlier.asked) // 50
    return abs(passed(earlier.time, later.time) - (later.asked - earlier.asked)) > tolerance + SECOND // 10


@property_at("closed", *_UNUSUAL, _DATES, feature="timers", timed=True)
def unusual_times(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A time-out of zero, a date that has passed, a rate with the flag of dates, and a timer that is set in on_startup do what is declared."""
    for phase in all_timer_phases(runtime):
        for timer in phase.timers:
            if timer.is_contested or timer.cancels or not timer.is_started:
                continue
            due = latest(runtime, timer, 0)
            if timer.is_in_startup:
                if timer.has_usual_times:
                    value = "works" if timer.callbacks else "ignored"
                    yield from _takes(check, runtime, timer, "timer-in-startup", value, due, PHASES[timer.kind])
            elif timer.rate is not None and timer.rate.is_absolute:
                value = "ignored" if timer.callbacks else "refused"
                yield from _takes(
                    check, runtime, timer, "absolute-rate", value, latest(runtime, timer, 1), RATE[timer.kind]
                )
            elif timer.has_no_delay and timer.max_rounds != 0:
                value = "at-once" if timer.callbacks else "ignored"
                yield from _takes(check, runtime, timer, "zero-delay", value, due, EARLY[timer.kind])
                yield from _at_once(check, runtime, timer, due)
            elif timer.delay.is_absolute:
                read = [r for m in _clocks(runtime) if (r := read_before(timer, m)) is not None]
                if len(read) == len(_clocks(runtime)) and all(passed(timer.delay.lasts, r.time) > 0 for r in read):
                    over = timer.call.reply.t + lateness(runtime) if timer.call.reply is not None else None
                    value = "at-once" if timer.callbacks else "never"
                    yield from _takes(check, runtime, timer, "past-time", value, over, _DATES)
                    yield from _at_once(check, runtime, timer, over)


def _at_once(check: Property, runtime: ObservedRuntime, timer: Timer, due: int | None) -> Conclusions:
    """A sporadic timer that was due when it was started, and calls back, does so within the lateness."""
    if due is None or not timer.callbacks or timer.rate is not None:
        return
    callback = timer.callbacks[0]
    free = free_after(runtime, timer, due, callback.t)
    limit = due if free in (None, due) else (free or 0) + lateness(runtime)
    if free is not None and callback.t > limit:
        yield check.fail(
            "late",
            expected=f"{timer.label} of '{timer.phase.member.lane}', which is due when it is started, calls back at once",
            observed=f"it called back {shown(callback.t - limit)} later than timer-lateness permits",
            at=at_of(timer, callback),
            requirement=LATE[timer.kind],
            late_by=callback.t - limit,
        )


def _takes(
    check: Property,
    runtime: ObservedRuntime,
    timer: Timer,
    option: str,
    value: str,
    due: int | None,
    requirement: str,
) -> Conclusions:
    """Is ``value``, which is what the timer did, permitted for ``option``? ``due`` is until when that was to be seen."""
    free = None if due is None else free_after(runtime, timer, due, timer.until[1])
    if free != due and timer.rate is not None and not timer.callbacks:
        return  # the first ones may have been left out
    if due is None or free is None or (free + lateness(runtime) > timer.until[1] and not timer.callbacks):
        return
    option = option_of(runtime, timer.kind, option)
    if not (yield from takes(runtime, option, value)):
        yield check.fail(
            option,
            expected=f"{timer.label} of '{timer.phase.member.lane}' behaves as declared: {option}={runtime.ics.reading(option)}",
            observed=f"it did as under '{value}'",
            at=at_of(timer, *timer.callbacks[:1]),
            requirement=requirement,
        )


@property_at("closed", *RATE.values(), feature="timers", timed=True)
def missed_expiries(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """What becomes of expiries while a callback lasts is as declared: caught up, left out, merged, or the grid begins anew."""
    for phase in all_timer_phases(runtime):
        for timer in phase.timers:
            if timer.rate is None or not timer.has_usual_times or timer.is_contested or not timer.is_started:
                continue
            number = overrun(runtime, timer)
            if number >= len(timer.callbacks) or reading_of(runtime, timer.kind, "timer-anchor") == "chained":
                continue
            fitting = _readings_of_overrun(runtime, timer, number)
            option = option_of(runtime, timer.kind, "timer-overrun")
            declared = runtime.ics.reading(option)
            if len(fitting) == 1:
                (value,) = fitting
                if (yield from takes(runtime, option, value)):
                    continue
            elif not fitting or declared in (*fitting, "observed"):
                continue
            yield check.fail(
                "overrun",
                expected=f"expiries of {timer.label} of '{phase.member.lane}' while it is executed are treated as declared: {declared}",
                observed=f"they were treated as under {' or '.join(sorted(fitting))}",
                at=at_of(timer, *timer.callbacks[number : number + 3]),
                requirement=RATE[timer.kind],
            )


def _readings_of_overrun(runtime: ObservedRuntime, timer: Timer, number: int) -> set[str]:
    """The readings of ``timer-overrun`` that explain what came after callback ``number``, which lasted, or came late after another execution;
    empty if too little is seen.
    """
    assert timer.rate is not None
    due, late, rate = latest(runtime, timer, number), lateness(runtime), timer.rate.lasts
    held = timer.callbacks[number].execution
    was_kept_out = is_late(runtime, timer, number)
    if due is None or not held.over:
        return set()
    free = free_after(runtime, timer, due, held.enter.t) if was_kept_out else held.left
    if free is None or (was_kept_out and (free == due or held.left - held.enter.t > late)):
        return set()
    grid = due - late
    passed_by, into = divmod(free - grid, rate)
    missed = passed_by + was_kept_out
    if missed < 2 or timer.until[1] < free + 2 * rate or not 2 * late < into < rate - 2 * late:
        return set()
    after = [c.t for c in timer.callbacks[number + (not was_kept_out) :]]
    window = min(missed * late, rate - into - late)  # one by one, each within the lateness
    at_once = sum(moment < free + window for moment in after)
    following = [m for m in after if m >= free + window]
    if after and after[0] < free:
        return set()  # the component is not protected, and nothing was missed
    if at_once >= missed and not (was_kept_out and missed == 2):
        return {"queued"}
    if at_once > 1 or not following:
        return set()
    if abs(following[0] - (grid + (passed_by + 1) * rate)) > late:
        return {"shifted"}
    # one that waits for its component may be the missed ones, or the one that was on its way when they were left out
    return ({"merged", "skipped"} if was_kept_out else {"merged"}) if at_once else {"skipped"}


@property_at("closed", _TIME_TOLD, feature="timers", timed=True)
def callbacks_tell_a_time(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """The time that a callback tells is the one asked for, the date when it was due, or that of the call."""
    for phase in timer_phases(runtime):
        for timer in phase.timers:
            for number, callback in enumerate(timer.callbacks[:MOST]):
                told = callback.told
                if told is None or timer.is_contested or not timer.is_started:
                    continue
                fitting = _readings_of_told(runtime, timer, number, callback, told)
                declared = runtime.ics.reading("callback-time")
                if len(fitting) == 1:
                    if (yield from takes(runtime, "callback-time", *fitting)):
                        yield check.kept()
                        continue
                elif fitting and declared in (*fitting, "observed"):
                    yield check.kept()
                    continue
                flag = "ABSOLUTE_TIME" if told.is_absolute else "RELATIVE_TIME"
                yield check.fail(
                    "otherwise",
                    expected=f"callbacks of timer {timer.number} of '{phase.member.lane}' tell a time"
                    + (f", as declared: {declared}" if declared != "observed" else ": the one asked for, or a date"),
                    observed=f"callback {number + 1} told {told.seconds} and {flag}",
                    at=at_of(timer, callback),
                )
                return


def _readings_of_told(
    runtime: ObservedRuntime, timer: Timer, number: int, callback: TimerCallback, told: TimeOut
) -> set[str]:
    fitting = set()
    if told == timer.delay or told == timer.rate:
        fitting.add("requested")
    if not told.is_absolute:
        return fitting
    if timer.delay.is_absolute and not number and abs(told.seconds - timer.delay.seconds) <= 1:
        fitting.add("due")
    read = [r for m in _clocks(runtime) if (r := read_in(timer, m, callback)) is not None]
    if not read:
        return {*fitting, "due", "now"}
    expected = latest(runtime, timer, number)
    for reading in read:
        entered = reading.time - (reading.answered - callback.t)
        if abs(passed(told.seconds * SECOND, entered)) <= SECOND + lateness(runtime):
            fitting.add("now")
        due = expected if expected is not None and number <= overrun(runtime, timer) else None
        waited = 0 if due is None else max(0, callback.t - due + lateness(runtime))
        if due is None or abs(passed(told.seconds * SECOND, entered - waited)) <= SECOND + lateness(runtime):
            fitting.add("due")
    return fitting
