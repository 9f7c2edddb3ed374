"""Properties about when timers call back: never early, in time, once or again and again (10.3)."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from ucm_cts.reference_models.conclusions import Conclusions, takes
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.execution_policies import protection_of
from ucm_cts.reference_models.model.executions import Execution
from ucm_cts.reference_models.model.index_timers import timer_phases
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.paced_phases import lateness, shown
from ucm_cts.reference_models.model.phases import noticed
from ucm_cts.reference_models.model.timer_events import Timer
from ucm_cts.reference_models.model.timer_options import option_of, reading_of
from ucm_cts.reference_models.model.timer_times import (
    MOST,
    busy,
    earliest,
    free_after,
    is_kept_out,
    is_long,
    last_expiry,
    latest,
    may_be_delayed,
    overrun,
)
from ucm_cts.reference_models.model.timers import all_timers
from ucm_cts.reference_models.properties.clause_10_3 import EARLY, LATE, RATE, OfKind, at_of, both
from ucm_cts.reference_models.properties.declaration import Property, property_at

_EXPIRES: OfKind = {"index": "R-10.3.2-21", "object": "R-10.3.1-18"}
_ONCE: OfKind = {"index": "R-10.3.2-29", "object": _EXPIRES["object"]}
_AGAIN: OfKind = {"index": "R-10.3.2-30", "object": "R-10.3.1-23"}
_FIRST: OfKind = {"index": "R-10.3.2-31", "object": "R-10.3.1-21"}
_SEVERAL: OfKind = {"index": "R-10.3.2-36", "object": "R-10.3.1-34"}
_ONE_ONLY: OfKind = {"index": "R-10.3.2-39", "object": "R-10.3.1-32"}
_IN_THE_END: OfKind = {"index": "R-10.3.2-44", "object": "R-10.3.1-36"}
_OWN_START, _NUMBERS, _APART, _ANEW = "R-10.3.2-27", "R-10.3.2-33", "R-10.3.2-37", "R-10.3-04"


_MISSING = (_ANEW, *both(_EXPIRES, _AGAIN, _SEVERAL, _ONE_ONLY, _IN_THE_END), _NUMBERS, _APART)

_ENOUGH, _AT_ONCE = 3, 3
"""So many callbacks show that a timer repeats, and so many timers that wait at once are several."""

_QUIET = 3
"""A sporadic timer does not call back again within so many delays."""

_USUAL_NUMBERS = range(1, 256)


def _judged(runtime: ObservedRuntime) -> list[Timer]:
    """The timers with usual times whose number is theirs alone, and those without a delay that do call back again and again."""
    plain = [t for t in all_timers(runtime) if not t.is_contested and t.is_started]
    return [t for t in plain if t.has_usual_times or _begins_at_once(t)]


def _begins_at_once(timer: Timer) -> bool:
    """Has it no delay, and an interval, and calls back? Its first expiry comes while its component is executed, which a policy may protect."""
    is_protected = protection_of(timer.phase.member.declaration) not in ("", "unprotected")
    is_plain = timer.has_no_delay and timer.max_rounds != 0 and not timer.is_in_startup
    rate = timer.rate
    return is_plain and not is_protected and rate is not None and not rate.is_absolute and bool(timer.callbacks)


@property_at("closed", *both(EARLY, _FIRST, RATE), feature="timers", timed=True)
def timers_never_early(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """No callback comes before its time has passed since its timer was started."""
    for timer in _judged(runtime):
        for number, callback in enumerate(timer.callbacks[:MOST]):
            if timer.most is not None and number >= timer.most:
                break
            due = earliest(runtime, timer, number)
            requirement = _of_time(timer, number, EARLY)
            if due is None or callback.t >= due:
                yield check.kept(requirement)
                continue
            yield check.fail(
                "early",
                expected=f"{timer.label} of '{timer.phase.member.lane}' calls back {_asked(timer, number)}",
                observed=f"it called back {shown(due - callback.t)} too early",
                at=at_of(timer, *timer.callbacks[: number + 1]),
                requirement=requirement,
            )
            break


def _of_time(timer: Timer, number: int, of_single: OfKind) -> str:
    """The requirement about the time of callback ``number``; ``of_single`` is that of timers that do not repeat."""
    return (of_single if timer.rate is None else RATE if number else _FIRST)[timer.kind]


def _asked(timer: Timer, number: int) -> str:
    first = f"{timer.delay.shown} after it was started"
    if timer.delay.is_absolute:
        first = f"when the clock shows {timer.delay.shown}"
    if timer.rate is None:
        return first
    return f"the first time {first}" if not number else f"every {timer.rate.shown}, the first time {first}"


@property_at("closed", *both(LATE, _FIRST, RATE), *_MISSING, feature="timers", timed=True)
def timers_expire_in_time(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Each expiry calls back, within the declared lateness if nothing holds the component."""
    come: list[Timer] = []
    for timer in _judged(runtime):
        if (
            timer.is_in_startup
            and reading_of(runtime, timer.kind, "timer-in-startup") != "works"
            and not timer.callbacks
        ):
            continue
        finding = _late(check, runtime, timer)
        if finding is not None:
            yield finding
        elif timer.callbacks:
            come.append(timer)
    for timer in come:
        yield from _kept(check, runtime, timer, come)
    for timer in all_timers(runtime):
        is_plain = timer.is_started and not timer.is_contested and bool(timer.callbacks)
        if not is_plain or timer.has_usual_times or timer.rate is None:
            continue
        finding = _stops(check, runtime, timer, was_busy=False)
        if finding is not None:
            yield finding


def _late(check: Property, runtime: ObservedRuntime, timer: Timer) -> Finding | None:
    """The first callback that came too late or not at all.

    After an execution that lasted for a period, missed expiries may be caught up, left out or merged, and only the end is judged.
    """
    disturbed = overrun(runtime, timer)
    for number in range(min(len(timer.callbacks) + 1, MOST)):
        due = latest(runtime, timer, number)
        if due is None or (timer.most is not None and number >= timer.most):
            return None
        if number > disturbed:
            return _stops(check, runtime, timer)
        callback = timer.callbacks[number] if number < len(timer.callbacks) else None
        free = free_after(runtime, timer, due, callback.t if callback is not None else timer.until[1])
        if free is None:
            return None
        if timer.rate is not None and free > due:
            return _stops(check, runtime, timer, free)
        limit = due if free == due else free + lateness(runtime)
        if callback is None:
            is_missing = limit < timer.until[1]
            return _untimely(check, runtime, timer, number, None, _is_busy(runtime, timer, due)) if is_missing else None
        if callback.t > limit:
            return _untimely(check, runtime, timer, number, callback.t - limit, _is_busy(runtime, timer, due))
    return None


def _is_busy(runtime: ObservedRuntime, timer: Timer, due: int) -> bool:
    """Was its component executed when it was due, for longer than a moment?"""
    return any(e.enter.t <= due and (not e.over or e.left > due) for e in _long_executions(runtime, timer))


def _long_executions(runtime: ObservedRuntime, timer: Timer) -> list[Execution]:
    """The executions of its component that may keep more than one callback out."""
    return [e for e in timer.phase.executions if is_long(runtime, e.enter.t, e.left if e.over else None)]


def _stops(
    check: Property, runtime: ObservedRuntime, timer: Timer, free: int = 0, was_busy: bool = True
) -> Finding | None:
    """After an execution that lasted for a period, or kept a callback out until ``free``: callbacks still come, as long as there are rounds left."""
    assert timer.rate is not None
    until = timer.until[1]
    if timer.most is not None:
        last = last_expiry(runtime, timer)
        if last is None:
            return None
        until = min(until, last)
    ends = [
        timer.until[1] if end is None else end
        for begin, end in busy(runtime, timer.until[1])
        if is_long(runtime, begin, end)
    ]
    quiet_since = max([free, *(callback.t for callback in timer.callbacks[-1:]), *ends])
    if until - quiet_since > 2 * timer.rate.lasts + lateness(runtime):
        return _untimely(check, runtime, timer, len(timer.callbacks), None, was_busy)
    return None


def _untimely(
    check: Property, runtime: ObservedRuntime, timer: Timer, number: int, by: int | None, was_busy: bool
) -> Finding:
    if by is None:
        requirement = _why_missing(runtime, timer, number, was_busy)
        observed = f"callback {number + 1} did not come" if timer.rate is not None else "it did not"
    else:
        requirement = _of_time(timer, number, LATE)
        observed = f"it called back {shown(by)} later than timer-lateness permits"
    busy = ", once the component is free" if was_busy else ""
    return check.fail(
        "never" if by is None else "late",
        expected=f"{timer.label} of '{timer.phase.member.lane}' calls back {_asked(timer, number)}{busy}",
        observed=observed,
        at=(
            *at_of(timer, *timer.callbacks[: number + 1]),
            *(noticed(runtime, latest(runtime, timer, number)) if by is None else ()),
        ),
        requirement=requirement,
        late_by=by or 0,
    )


def _why_missing(runtime: ObservedRuntime, timer: Timer, number: int, was_busy: bool) -> str:
    """The requirement that is broken if callback ``number`` does not come: the one about what sets the timer apart."""
    others = [t for t in all_timers(runtime) if t is not timer and t.call.request.n < timer.until[0]]
    elsewhere = [t for t in others if _shares_number(t, timer)]
    here = [t for t in others if t.phase is timer.phase]
    beside = [t for t in others if t.phase.member is timer.phase.member and t.kind != timer.kind]
    cancelled = [*here, *beside, *(t for t in others if t.kind == timer.kind == "object" and t.number == timer.number)]
    if any(t.call.request.n > timer.call.request.n or t.cancels for t in elsewhere):
        return _APART
    due = latest(runtime, timer, number) or timer.until[1]
    cancels = [t.cancelled.request for t in cancelled if t.cancelled is not None]
    if any(timer.call.request.n < cancel.n and cancel.t < due for cancel in cancels):
        return _ONE_ONLY[timer.kind]
    if was_busy:
        return _IN_THE_END[timer.kind]
    if any(t.again is timer.call for t in here):
        return _ANEW
    if timer.kind == "index" and timer.number not in _USUAL_NUMBERS:
        return _NUMBERS
    if number or timer.max_rounds is not None:
        return _AGAIN[timer.kind]
    return (_SEVERAL if here else _EXPIRES)[timer.kind]


def _shares_number(one: Timer, other: Timer) -> bool:
    """Are these index timers of two components, with one number?"""
    return (
        one.kind == other.kind == "index" and one.number == other.number and one.phase.member is not other.phase.member
    )


def _kept(check: Property, runtime: ObservedRuntime, timer: Timer, come: Sequence[Timer]) -> Conclusions:
    """What a timer that came in time has shown."""
    if timer.kind == "index" or timer.rate is None:
        yield check.kept(_EXPIRES[timer.kind])
    yield check.kept(LATE[timer.kind])
    due = earliest(runtime, timer, 0)
    if due is not None and timer.rate is None and is_kept_out(runtime, timer, timer.callbacks[0], due):
        yield check.kept(_IN_THE_END[timer.kind])
    if timer.rate is not None:
        yield check.kept(_FIRST[timer.kind])
        if len(timer.callbacks) >= _ENOUGH:
            yield check.kept(RATE[timer.kind])
            if timer.kind == "index":
                yield check.kept(_AGAIN["index"])
    at_once = [t for t in come if t.phase is timer.phase and t.call.request.n < timer.callbacks[0].n]
    if len({t.number for t in at_once}) >= _AT_ONCE:
        yield check.kept(_SEVERAL[timer.kind])
    if timer.kind == "index" and timer.number not in _USUAL_NUMBERS:
        yield check.kept(_NUMBERS)
    if any(t.again is timer.call and t.cancels for t in timer.phase.timers):
        yield check.kept(_ANEW)
    span = timer.call.request.n, timer.callbacks[-1].n
    elsewhere = [t for t in come if _shares_number(t, timer)]
    if any(t.call.request.n < span[1] and span[0] < t.callbacks[-1].n for t in elsewhere):
        yield check.kept(_APART)
    cancels = [t.cancelled for t in timer.phase.timers if t.number != timer.number]
    if any(c is not None and c.reply is not None and span[0] < c.request.n < span[1] for c in cancels):
        yield check.kept(_ONE_ONLY[timer.kind])


@property_at("closed", *both(_AGAIN), feature="timers", timed=True)
def exceptions_of_callbacks(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Whether a timer that repeats goes on when a callback of it raised is as declared."""
    for timer in _judged(runtime):
        raised = timer.raised
        if timer.rate is None or raised is None:
            continue
        later = [c for number, c in enumerate(timer.callbacks) if _is_after(runtime, timer, number, raised)]
        if not later or (yield from takes(runtime, option_of(runtime, timer.kind, "callback-exception"), "continues")):
            continue
        yield check.fail(
            "continues",
            expected=f"{timer.label} of '{timer.phase.member.lane}', of which a callback raised, ends, as declared",
            observed="it called back again",
            at=(timer.call.request.n, raised.end, later[0].n),
            requirement=_AGAIN[timer.kind],
        )


def _is_after(runtime: ObservedRuntime, timer: Timer, number: int, raised: Execution) -> bool:
    """Was callback ``number`` certainly not on its way yet when the one that raised had left?"""
    due = earliest(runtime, timer, number)
    return due is not None and due > raised.left and timer.callbacks[number].n > raised.end


@property_at("closed", _OWN_START, feature="timers", timed=True)
def relative_times_count_from_start(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Timers that are started at different moments with one relative time expire as far apart as they were started."""
    late = lateness(runtime)
    for phase in timer_phases(runtime):
        timers = [t for t in _judged(runtime) if t.phase is phase and t.rate is None and t.callbacks]
        for one, other in itertools.combinations(timers, 2):
            apart = other.call.request.t - one.call.request.t
            busy = any(may_be_delayed(runtime, t.callbacks[0], t.call.request.t) for t in (one, other))
            if one.delay != other.delay or apart <= 2 * late or busy:
                continue
            came = other.callbacks[0].t - one.callbacks[0].t
            if abs(came - apart) <= late:
                yield check.kept()
                continue
            yield check.fail(
                "not from its start",
                expected=f"timers {one.number} and {other.number}, both of {one.delay.seconds} s, expire as far apart as they were "
                f"started: {shown(apart)}",
                observed=f"they called back {shown(came)} apart",
                at=(*at_of(one, one.callbacks[0]), *at_of(other, other.callbacks[0])),
            )
            break


@property_at("closed", *both(_ONCE), feature="timers", timed=True)
def sporadic_timers_come_once(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A sporadic timer calls back once, and not again within three further delays."""
    for timer in all_timers(runtime):
        if timer.rate is not None or timer.is_contested or not timer.callbacks or timer.cancels:
            continue
        if len(timer.callbacks) > 1:
            yield check.fail(
                "again",
                expected=f"{timer.label} of '{timer.phase.member.lane}', which does not repeat, calls back once",
                observed=f"it called back {len(timer.callbacks)} times",
                at=at_of(timer, *timer.callbacks),
                requirement=_ONCE[timer.kind],
            )
        elif timer.until[1] - timer.callbacks[0].t > _QUIET * timer.delay.lasts and not timer.delay.is_absolute:
            yield check.kept(_ONCE[timer.kind])
