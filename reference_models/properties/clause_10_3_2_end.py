"""Properties about the numbers of index timers: callbacks tell them, is_canceled asks for them, and they are used anew (10.3.2)."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.reference_models.conclusions import Conclusions, takes
from ucm_cts.reference_models.model.index_timers import timer_phases
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.paced_phases import lateness
from ucm_cts.reference_models.model.phases import noticed
from ucm_cts.reference_models.model.timer_events import Timer, TimerPhase
from ucm_cts.reference_models.model.timer_times import earliest, latest
from ucm_cts.reference_models.properties.clause_10_3 import at_of
from ucm_cts.reference_models.properties.clause_10_3_end import DueAnswer, answer_of, due_shown
from ucm_cts.reference_models.properties.declaration import Property, property_at

_NOTHING_ELSE, _NUMBER_TOLD, _APART = "R-10.3.2-22", "R-10.3.2-34", "R-10.3.2-37"
_TELLS, _NUMBERS = "R-10.3.2-40", "R-10.3.2-33"

_LONG_ENOUGH = 1_000_000_000
"""A component whose timers do not call back for so long is quiet, in nanoseconds."""

_SEVERAL = 3


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
                    expected=f"is_canceled({number}) of '{phase.member.lane}' gives {due_shown(runtime, due)}",
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


@property_at("closed", _NUMBERS, feature="timers", timed=True)
def number_in_use(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A number is started while its timer waits: the new timer counts, the old one, both, or the call is refused; never none."""
    for phase in timer_phases(runtime):
        for old, new in _started_twice(runtime, phase):
            both = [c for c in phase.callbacks if c.number == old.number and c.n > old.call.request.n]
            at_new = [c for c in both if _is_at(runtime, new, c.t)]
            at_old = [c for c in both if _is_at(runtime, old, c.t)]
            refused = new.call.reply is not None and new.call.reply.failed
            value = (
                "refuse"
                if refused
                else "both"
                if at_new and at_old
                else "replace"
                if at_new
                else "keep"
                if at_old
                else ""
            )
            if value and (yield from takes(runtime, "number-in-use", value)):
                continue
            declared = runtime.ics.reading("number-in-use")
            yield check.fail(
                value or "lost",
                expected=f"timer {old.number} of '{phase.member.lane}', which is started again while it waits, "
                + (f"behaves as declared: {declared}" if value else "calls back"),
                observed=f"it did as under '{value}'" if value else "it did not, for either start",
                at=(*at_of(old, *both), *(() if value else noticed(runtime, latest(runtime, new, 0)))),
            )


def _started_twice(runtime: ObservedRuntime, phase: TimerPhase) -> Iterator[tuple[Timer, Timer]]:
    """Two sporadic timers, the only ones of their number, of which the second was started while the first one waited, and that both should
    have called back, at moments that can be told apart, with nothing to keep them out.
    """
    by_number: dict[int, list[Timer]] = {}
    for timer in phase.timers:
        by_number.setdefault(timer.number, []).append(timer)
    late = lateness(runtime)
    if any(not e.over or e.left - e.enter.t > late for e in phase.executions):
        return
    for timers in by_number.values():
        if len(timers) != 2 or not timers[0].is_contested:
            continue
        old, new = timers
        dues = [latest(runtime, timer, 0) for timer in timers]
        plain = all(t.rate is None and t.has_usual_times and not t.cancels and not t.is_in_startup for t in timers)
        if not plain or dues[0] is None or dues[1] is None or max(dues[0], dues[1]) > phase.of.ended_at:
            continue
        if abs(dues[0] - dues[1]) > 2 * late:
            yield old, new


def _is_at(runtime: ObservedRuntime, timer: Timer, moment: int) -> bool:
    due, last = earliest(runtime, timer, 0), latest(runtime, timer, 0)
    return due is not None and last is not None and due <= moment <= last
