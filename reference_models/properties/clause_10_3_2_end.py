"""Properties about the numbers of index timers: callbacks tell them, is_canceled asks for them, and they are used anew (10.3.2)."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.reference_models.conclusions import Conclusions, takes
from ucm_cts.reference_models.model.index_timers import timer_phases
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.paced_phases import lateness
from ucm_cts.reference_models.model.phases import noticed
from ucm_cts.reference_models.model.timer_events import Timer, TimerCallback, TimerPhase
from ucm_cts.reference_models.model.timer_times import earliest, free_after, latest
from ucm_cts.reference_models.properties.clause_10_3 import at_of
from ucm_cts.reference_models.properties.clause_10_3_end import DueAnswer, answer_of, due_shown
from ucm_cts.reference_models.properties.declaration import Property, property_at

_NOTHING_ELSE, _NUMBER_TOLD, _APART = "R-10.3.2-22", "R-10.3.2-34", "R-10.3.2-37"
_TELLS, _NUMBERS, _CANCELS, _ONCE = "R-10.3.2-40", "R-10.3.2-33", "R-10.3.2-38", "R-10.3.2-29"

_LONG_ENOUGH = 1_000_000_000
"""A component whose timers do not call back for so long is quiet, in nanoseconds."""

_SEVERAL = 3

_FIRST_ONES = 4
"""So many callbacks of a timer are compared where its number was started twice."""


@property_at("closed", _NOTHING_ELSE, _NUMBER_TOLD, _APART, feature="timers", timed=True)
def callbacks_have_a_timer(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Each callback belongs to a timer that its component started, and tells the number of that timer."""
    phases = timer_phases(runtime)
    for phase in phases:
        strays = [c for c in phase.callbacks if c.timer is None and c.number is not None and c.told is not None]
        if not strays:
            yield from _kept_apart(check, phase)
            continue
        stray = strays[0]
        owed = [t for t in phase.timers if t.is_started and _is_owed(runtime, t, stray.t)]
        elsewhere = [t for p in phases if p.of.member is not phase.member for t in p.timers if t.number == stray.number]
        if owed:
            requirement, why = _NUMBER_TOLD, f"timer {owed[0].number} was due"
        elif any(t.call.request.n < stray.n for t in elsewhere):
            requirement, why = _APART, "only another component started a timer of that number"
        else:
            requirement, why = _NOTHING_ELSE, "it had started no timer of that number"
        yield check.fail(
            "no timer",
            expected=f"'{phase.member.lane}' is called back when one of its timers expires, with the number of that timer",
            observed=f"it was called back with number {stray.number}; {why}",
            at=(stray.n,),
            requirement=requirement,
        )


def _is_owed(runtime: ObservedRuntime, timer: Timer, moment: int) -> bool:
    """Was a callback of the timer due at ``moment``, and had not come?"""
    due = earliest(runtime, timer, len(timer.callbacks))
    return due is not None and due <= moment and timer.waits(timer.until[0]) and moment < timer.until[1]


def _kept_apart(check: Property, phase: TimerPhase) -> Conclusions:
    come = {c.number for c in phase.callbacks if c.timer is not None}
    if len(come) >= _SEVERAL:
        yield check.kept(_NUMBER_TOLD)
    live = [t for t in phase.timers if t.cancelled is None]
    since = max((t.cancelled.request.t for t in phase.timers if t.cancelled is not None), default=phase.of.started.t)
    if not live and phase.of.ended_at - since > _LONG_ENOUGH:
        yield check.kept(_NOTHING_ELSE)


@property_at("closed", _TELLS, feature="timers", timed=True)
def is_canceled_tells(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """is_canceled gives false for a timer that waits and true for one that was cancelled while it waited."""
    for phase in timer_phases(runtime):
        told: set[bool] = set()
        for call in (c for c in phase.calls if c.request.method == s.IS_CANCELED):
            reply = call.reply
            if reply is None or reply.failed:
                continue
            answer = reply.results[0] if reply.results and len(reply.results) == 1 else None
            number = (call.request.arguments or (None,))[0]
            due = _due_answer(runtime, phase, call)
            wrong = not isinstance(answer, bool) or (isinstance(due, bool) and answer is not due)
            if not wrong and due == "open" and _number_is_plain(phase, number):
                wrong = not (yield from takes(runtime, "is-cancelled", "inactive" if answer else "cancelled"))
            if wrong:
                yield check.fail(
                    "no boolean" if not isinstance(answer, bool) else f"not {str(due).lower()}",
                    expected=f"is_canceled({number}) of '{phase.member.lane}' gives {due_shown(runtime, phase.kind, due)}",
                    observed=f"it gave {printed(reply.results or ())[1:-1] or 'nothing'}",
                    at=(call.request.n, reply.n),
                )
                break
            if isinstance(due, bool):
                told.add(due)
        else:
            if len(told) > 1:
                yield check.kept()


def _number_is_plain(phase: TimerPhase, number: object) -> bool:
    return not any(t.is_contested or t.is_in_startup for t in phase.timers if t.number == number)


def _due_answer(runtime: ObservedRuntime, phase: TimerPhase, call: MethodCall) -> DueAnswer:
    """What is_canceled has to answer; ``open`` if the text leaves it to the vendor, ``unknown`` if its timer is not judged."""
    number = (call.request.arguments or (None,))[0]
    if call.over > phase.of.until:
        return "unknown"  # the component is being stopped
    others = (
        c for c in phase.calls if c.request.method != s.IS_CANCELED and (c.request.arguments or ())[:1] == (number,)
    )
    if any(c.request.n < call.over and c.over > call.request.n for c in others):
        return "unknown"  # which of both came first is open
    timers = [t for t in phase.timers if t.number == number and t.call.request.n < call.request.n]
    if any(not t.has_usual_times or t.is_contested or t.call.reply is None or t.is_in_startup for t in timers):
        return "unknown"
    started = [t for t in timers if t.is_started]
    if not started:
        earlier = (t for p in timer_phases(runtime) if p.member is phase.member and p is not phase for t in p.timers)
        return "unknown" if any(t.number == number for t in earlier) else "open"
    return answer_of(runtime, started[-1], call)


@property_at("closed", _NUMBERS, _ONCE, feature="timers", timed=True)
def number_in_use(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A number is started while its timer waits: the new timer counts, the old one, both, or the call is refused; never none.

    Those that count and do not repeat call back once.
    """
    for phase in timer_phases(runtime):
        for old, new in _started_twice(runtime, phase):
            later = [c for c in phase.callbacks if c.number == old.number and c.n > new.call.request.n]
            value = _reading_of_use(runtime, old, new, [c.t for c in later])
            if value and (yield from takes(runtime, "number-in-use", value)):
                counting = {"replace": (new,), "both": (old, new)}.get(value, (old,))
                yield from _no_surplus(check, runtime, counting, (old, new), later)
                continue
            declared = runtime.ics.reading("number-in-use")
            late = max(_late_by(runtime, (old, new), timer, [c.t for c in later]) for timer in (old, new))
            yield check.fail(
                value or ("late" if late else "lost"),
                expected=f"timer {old.number} of '{phase.member.lane}', which is started again while it waits, "
                + (
                    f"behaves as declared: {declared}"
                    if value
                    else "calls back whenever one of the starts, or each, is due"
                ),
                observed=f"it did as under '{value}'" if value else "it did not, for either start",
                at=(*at_of(old, *later), *(() if value else noticed(runtime, latest(runtime, new, 0)))),
                requirement=_NUMBERS,
                late_by=0 if value else late,
            )


def _no_surplus(
    check: Property,
    runtime: ObservedRuntime,
    counting: Sequence[Timer],
    both: tuple[Timer, Timer],
    later: Sequence[TimerCallback],
) -> Conclusions:
    """Those of ``both`` timers of one number that count since the second one was started call back once each, if none of them repeats."""
    old, new = both
    reply = new.call.reply
    if reply is None or any(timer.rate is not None for timer in counting):
        return
    after = [callback for callback in later if callback.t > reply.t + lateness(runtime)]
    if len(after) > len(counting):
        yield check.fail(
            "again",
            expected=f"timer {new.number} of '{new.phase.member.lane}', which is started again while it waits, calls back once"
            + (" for each start" if len(counting) > 1 else ""),
            observed=f"it called back {len(after)} times",
            at=(*at_of(old), *at_of(new, *after)),
            requirement=_ONCE,
        )


def _reading_of_use(runtime: ObservedRuntime, old: Timer, new: Timer, came: Sequence[int]) -> str:
    """The reading of ``number-in-use`` that explains when callbacks ``came``; empty if there is none."""
    served = []
    for timer in (old, new):
        times = _times_after(runtime, timer, new)
        hit = sum(any(due <= moment <= last for moment in came) for due, last in times)
        if 0 < hit < len(times):
            return ""
        served.append(hit > 0)
    if new.call.reply is not None and new.call.reply.failed:
        return "refuse" if served[0] else ""
    return {(True, True): "both", (False, True): "replace", (True, False): "keep"}.get((served[0], served[1]), "")


def _late_by(runtime: ObservedRuntime, timers: tuple[Timer, Timer], timer: Timer, came: Sequence[int]) -> int:
    """Nanoseconds by which callbacks of ``timer`` came late that did not come in time; 0 if one of them did not come at all.

    A callback that any of the two ``timers`` was due to give in time is not a late one.
    """
    new = timers[1]
    due_times = [times for one in timers for times in _times_after(runtime, one, new)]
    spare = [moment for moment in came if not any(due <= moment <= last for due, last in due_times)]
    most = 0
    for due, last in _times_after(runtime, timer, new):
        if any(due <= moment <= last for moment in came):
            continue
        late = next((moment for moment in spare if moment > last), None)
        if late is None:
            return 0
        spare.remove(late)
        most = max(most, late - last)
    return most


def _times_after(runtime: ObservedRuntime, timer: Timer, new: Timer) -> list[tuple[int, int]]:
    """Between which moments the first callbacks of ``timer`` are due after ``new`` was started, and before the phase ends."""
    found = []
    for number in range(1 if timer.rate is None else _FIRST_ONES):
        due, last = earliest(runtime, timer, number), latest(runtime, timer, number)
        is_after = due is not None and new.call.reply is not None and due > new.call.reply.t
        if due is not None and last is not None and is_after and last < timer.phase.of.ended_at:
            found.append((due, last))
    return found


def _from_before(runtime: ObservedRuntime, phase: TimerPhase) -> set[int]:
    """The numbers of timers of an earlier phase, which may go on in this one."""
    if not runtime.ics.permits("timers-at-stop", "resumed"):
        return set()
    earlier = [p for p in timer_phases(runtime) if p.member is phase.member and p.of.started.n < phase.of.started.n]
    return {timer.number for p in earlier for timer in p.timers}


def _started_twice(runtime: ObservedRuntime, phase: TimerPhase) -> Iterator[tuple[Timer, Timer]]:
    """Two timers, the only ones of their number, of which the second was started while the first one waited, and that both should
    have called back, at moments that can be told apart, with nothing to keep them out.
    """
    by_number: dict[int, list[Timer]] = {}
    for timer in phase.timers:
        by_number.setdefault(timer.number, []).append(timer)
    late = lateness(runtime)
    if any(not e.over or e.left - e.enter.t > late for e in phase.executions):
        return
    resumed = _from_before(runtime, phase)
    for number, timers in by_number.items():
        if len(timers) != 2 or not timers[0].is_contested or number in resumed:
            continue
        old, new = timers
        plain = all(t.has_usual_times and not t.cancels and not t.is_in_startup for t in timers)
        times = [_times_after(runtime, timer, new) for timer in timers] if plain else [[], []]
        are_apart = all(a[0] > b[1] + late or b[0] > a[1] + late for a, b in itertools.product(*times))
        if all(times) and are_apart:
            yield old, new


@property_at("closed", _CANCELS, feature="timers", timed=True)
def cancelled_numbers_are_silent(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A number that was started while its timer waited calls back no more once it is cancelled, where it has one timer as declared."""
    if runtime.ics.reading("number-in-use") not in ("replace", "keep", "refuse"):
        return
    for phase in timer_phases(runtime):
        for timer in phase.timers:
            cancel = timer.cancelled
            last = max((t.call.over for t in phase.timers if t.number == timer.number), default=0)
            if not timer.is_contested or cancel is None or cancel.reply is None or cancel.request.n < last:
                continue
            over = cancel.reply
            later = [c for c in phase.callbacks if c.number == timer.number and c.n > over.n]
            free = [free_after(runtime, timer, over.t, c.t) for c in later]
            wrong = [c for c, at in zip(later, free, strict=True) if at is not None and c.t > at + lateness(runtime)]
            if wrong:
                yield check.fail(
                    "calls back",
                    expected=f"number {timer.number} of '{phase.member.lane}', which was started twice, calls back no more once it is cancelled",
                    observed="it called back after cancel_timer had returned",
                    at=(timer.call.request.n, over.n, *(c.n for c in wrong)),
                )
