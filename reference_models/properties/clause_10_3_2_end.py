"""Properties about how index timers end: they are cancelled, their number is used anew, or their component is stopped (10.3.2)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.reference_models.conclusions import Conclusions, takes
from ucm_cts.reference_models.model.index_timers import is_callback, timer_phases
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.paced_phases import lateness
from ucm_cts.reference_models.model.phases import is_outside, noticed
from ucm_cts.reference_models.model.service_policies import has_timers
from ucm_cts.reference_models.model.timer_events import Timer, TimerPhase
from ucm_cts.reference_models.model.timer_times import earliest, free_after, latest
from ucm_cts.reference_models.properties.clause_10_3_2 import at_of
from ucm_cts.reference_models.properties.declaration import Property, property_at

_NOTHING_ELSE, _NUMBER_TOLD, _APART = "R-10.3.2-22", "R-10.3.2-34", "R-10.3.2-37"
_CANCELS, _TELLS, _PHASES, _NUMBERS = "R-10.3.2-38", "R-10.3.2-40", "R-10.3.2-42", "R-10.3.2-33"

_LONG_ENOUGH = 1_000_000_000
"""A component whose timers do not call back for so long is quiet, in nanoseconds."""

_SEVERAL = 3


@property_at("closed", _CANCELS, feature="timers", timed=True)
def cancelled_timers_are_silent(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A cancelled timer calls back no more, but for a callback that was due before cancel_timer returned, where that is tolerated."""
    for phase in timer_phases(runtime):
        for timer in phase.timers:
            cancel = timer.cancelled
            if cancel is None or cancel.reply is None or timer.is_contested or cancel.reply.failed:
                continue
            later = [c for c in timer.callbacks if c.n > cancel.reply.n]
            wrong = [c for c in later if not _is_tolerated(runtime, phase, timer, cancel, timer.callbacks.index(c))]
            if len(later) > 1 or wrong:
                yield check.fail(
                    "calls back",
                    expected=f"timer {timer.number} of '{phase.member.lane}' calls back no more once it is cancelled",
                    observed=f"it called back {'once' if len(later) == 1 else f'{len(later)} times'} after cancel_timer had returned",
                    at=(timer.call.request.n, cancel.reply.n, *(c.n for c in later)),
                )
            elif _would_have_come(runtime, timer, cancel):
                yield check.kept()


def _is_tolerated(runtime: ObservedRuntime, phase: TimerPhase, timer: Timer, cancel: MethodCall, number: int) -> bool:
    assert cancel.reply is not None
    if runtime.ics.reading("timer-cancel") == "strict" or _is_from_own_callback(timer, cancel):
        return False
    due = earliest(runtime, timer, number)
    if due is None or due > cancel.reply.t:
        return due is None
    callback = timer.callbacks[number]
    free = free_after(runtime, timer, cancel.reply.t, callback.t)
    return free is None or callback.t <= free + lateness(runtime)


def _is_from_own_callback(timer: Timer, cancel: MethodCall) -> bool:
    caller = cancel.business.caller
    return caller is not None and any(caller.enter is callback.enter for callback in timer.callbacks)


def _would_have_come(runtime: ObservedRuntime, timer: Timer, cancel: MethodCall) -> bool:
    """Would its next callback have been due after it was cancelled, and before its phase ended?"""
    next_due = latest(runtime, timer, sum(c.n < cancel.request.n for c in timer.callbacks))
    ends = timer.again.request.t if timer.again is not None else timer.phase.of.ended_at
    return next_due is not None and cancel.request.t < next_due < ends


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
                    expected=f"is_canceled({number}) of '{phase.member.lane}' gives {_due_shown(runtime, due)}",
                    observed=f"it gave {printed(reply.results or ())[1:-1] or 'nothing'}",
                    at=(call.request.n, reply.n),
                )
                break
            if isinstance(due, bool):
                told.add(due)
        else:
            if len(told) > 1:
                yield check.kept()


def _due_shown(runtime: ObservedRuntime, due: bool | str) -> str:
    if isinstance(due, bool):
        return str(due).lower()
    declared = runtime.ics.reading("is-cancelled")
    shown = {"inactive": "true", "cancelled": "false"}.get(declared)
    return f"{shown}, as is-cancelled={declared} declares" if shown and due == "open" else "a boolean"


def _number_is_plain(phase: TimerPhase, number: object) -> bool:
    return not any(t.is_contested or t.is_in_startup for t in phase.timers if t.number == number)


def _due_answer(runtime: ObservedRuntime, phase: TimerPhase, call: MethodCall) -> bool | Literal["open", "unknown"]:
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
    timer = started[-1]
    before = [c for c in timer.cancels if c.request.n < call.request.n]
    if not before:
        if not timer.waits(call.request.n):
            return "open"
        due = earliest(runtime, timer, len([c for c in timer.callbacks if c.n < call.request.n]))
        is_sure = timer.rate is not None or (due is not None and call.reply is not None and call.reply.t < due)
        return False if is_sure else "unknown"
    cancel = timer.cancelled
    if cancel is None:
        return "open"
    due = earliest(runtime, timer, len([c for c in timer.callbacks if c.n < cancel.request.n]))
    while_waiting = cancel.reply is not None and not cancel.reply.failed and due is not None and cancel.reply.t < due
    return True if while_waiting and cancel.over < call.request.n else "unknown"


@property_at("closed", _PHASES, feature="timers", timed=True)
def timers_serve_operational_components(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """No callback enters a component before its on_startup returned, or after its stop or removal did."""
    for member in list(runtime.bodies.values()):
        if not has_timers(member.declaration) or member.suspended:
            continue
        entered = (e for e in runtime.executions.of(member.body) if is_callback(e))
        outside = next((e for e in entered if is_outside(runtime, member, e.enter.n)), None)
        if outside is not None:
            yield check.fail(
                "not operational",
                expected=f"'{member.lane}' is called back after its on_startup returned and before stop returned",
                observed="it was called back outside of that",
                at=(outside.enter.n,),
            )


@property_at("closed", _PHASES, feature="timers", timed=True)
def timers_wait_no_longer(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A timer that waits at stop does not call back while its component is stopped; afterwards it does if that is declared."""
    phases = timer_phases(runtime)
    for phase in phases:
        plain = [t for t in phase.timers if t.is_started and not t.is_contested and t.call.request.n < phase.of.until]
        waiting = [t for t in plain if t.waits(phase.of.until)]
        dues = [due for t in waiting if (due := latest(runtime, t, len(t.callbacks))) is not None]
        following = [p for p in phases if p.member is phase.member and p.of.number > phase.of.number]
        paused = [p.t for p in runtime.interactions.pauses if phase.of.closed < p.n]
        paused = [t for t in paused if not following or t < following[0].of.startup.t]
        if paused and any(phase.of.ended_at < due < paused[-1] for due in dues):
            yield check.kept()
        if following:
            yield from _after_restart(check, runtime, phase, following[0], waiting)


def _after_restart(
    check: Property, runtime: ObservedRuntime, phase: TimerPhase, later: TimerPhase, waiting: list[Timer]
) -> Conclusions:
    touched = {(call.request.arguments or (None,))[0] for call in later.calls if call.request.method != s.IS_CANCELED}
    waiting = [timer for timer in waiting if timer.number not in touched]
    resumed = [c for c in later.resumed if c.timer in waiting]
    dues = [due for t in waiting if (due := latest(runtime, t, len(t.callbacks))) is not None]
    is_over = any(max(due, later.of.started.t + lateness(runtime)) < later.of.ended_at for due in dues)
    if not resumed and not is_over:
        return
    value = "resumed" if resumed else "dropped"
    if not (yield from takes(runtime, "timers-at-stop", value)):
        declared = "call back after the restart" if value == "dropped" else "are dropped"
        yield check.fail(
            value,
            expected=f"timers of '{phase.member.lane}' that wait when it is stopped {declared}, as declared",
            observed="one called back" if resumed else "none called back",
            at=(waiting[0].call.request.n, phase.of.until, *(c.n for c in resumed)),
        )


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
