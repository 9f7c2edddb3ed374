"""Properties about how timers end: they are cancelled, or their component is stopped (10.3)."""

from __future__ import annotations

from typing import Literal

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.reference_models.conclusions import Conclusions, takes
from ucm_cts.reference_models.model.index_timers import is_callback
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.object_timers import is_trigger
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.paced_phases import lateness
from ucm_cts.reference_models.model.phases import is_outside
from ucm_cts.reference_models.model.service_policies import has_timers
from ucm_cts.reference_models.model.timer_events import Kind, Timer, TimerCallback, TimerPhase
from ucm_cts.reference_models.model.timer_options import option_of, reading_of
from ucm_cts.reference_models.model.timer_times import earliest, free_after, last_expiry, latest
from ucm_cts.reference_models.model.timers import all_timer_phases
from ucm_cts.reference_models.properties.clause_10_3 import PHASES, OfKind
from ucm_cts.reference_models.properties.declaration import Property, property_at

_CANCELS: OfKind = {"index": "R-10.3.2-38", "object": "R-10.3.1-31"}

DueAnswer = bool | Literal["open", "unknown"]


@property_at("closed", *_CANCELS.values(), feature="timers", timed=True)
def cancelled_timers_are_silent(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A cancelled timer calls back no more, but for a callback that was due before the cancel returned, where that is tolerated."""
    for phase in all_timer_phases(runtime):
        for timer in phase.timers:
            cancel = timer.cancelled
            if cancel is None or cancel.reply is None or timer.is_contested or cancel.reply.failed:
                continue
            later = [c for c in timer.callbacks if c.n > cancel.reply.n]
            wrong = [c for c in later if not _is_tolerated(runtime, phase, timer, cancel, timer.callbacks.index(c))]
            if wrong:
                yield check.fail(
                    "calls back",
                    expected=f"{timer.label} of '{phase.member.lane}' calls back no more once it is cancelled",
                    observed=f"it called back {'once' if len(later) == 1 else f'{len(later)} times'} after {cancel.request.method} had returned",
                    at=(timer.call.request.n, cancel.reply.n, *(c.n for c in later)),
                    requirement=_CANCELS[timer.kind],
                )
            elif _would_have_come(runtime, timer, cancel):
                yield check.kept(_CANCELS[timer.kind])
        for callback in phase.resumed:
            if callback.timer is not None and _is_after(runtime, phase, callback.timer, callback):
                yield check.fail(
                    "goes on",
                    expected=f"{callback.timer.label} of '{phase.member.lane}', of an earlier phase, calls back no more once it is cancelled",
                    observed="it called back after that",
                    at=(callback.timer.call.request.n, *(c.request.n for c in callback.timer.cancels), callback.n),
                    requirement=_CANCELS[phase.kind],
                )
                break


def _is_tolerated(runtime: ObservedRuntime, phase: TimerPhase, timer: Timer, cancel: MethodCall, number: int) -> bool:
    assert cancel.reply is not None
    if reading_of(runtime, timer.kind, "timer-cancel") == "strict":
        return False
    due = earliest(runtime, timer, number)
    if due is None or due > cancel.reply.t:
        return due is None
    callback = timer.callbacks[number]
    free = free_after(runtime, timer, cancel.reply.t, callback.t)
    return free is None or callback.t <= free + lateness(runtime)


def _is_after(runtime: ObservedRuntime, phase: TimerPhase, timer: Timer, callback: TimerCallback) -> bool:
    """Did a timer of an earlier phase, which was cancelled in this one and not replaced, call back when it cannot have been on its way?"""
    cancel = timer.cancelled
    is_replaced = any(t.number == timer.number or t.handler == timer.handler != "" for t in phase.timers)
    if (
        cancel is None
        or cancel.reply is None
        or cancel not in phase.calls
        or is_replaced
        or callback.n < cancel.reply.n
    ):
        return False
    if reading_of(runtime, timer.kind, "timer-cancel") == "strict":
        return True
    free = free_after(runtime, timer, cancel.reply.t, callback.t)
    return free is not None and callback.t > free + lateness(runtime)


def _would_have_come(runtime: ObservedRuntime, timer: Timer, cancel: MethodCall) -> bool:
    """Would its next callback have been due after it was cancelled, and before its phase ended?"""
    next_due = latest(runtime, timer, sum(c.n < cancel.request.n for c in timer.callbacks))
    ends = timer.again.request.t if timer.again is not None else timer.phase.of.ended_at
    return next_due is not None and cancel.request.t < next_due < ends


def answer_of(runtime: ObservedRuntime, timer: Timer, call: MethodCall) -> DueAnswer:
    """What the question ``call`` about ``timer``, whether it was cancelled, has to be answered; ``open`` if the text leaves it to the vendor,
    ``unknown`` if that depends on what cannot be seen.
    """
    before = [c for c in timer.cancels if c.request.n < call.request.n]
    if timer.may_have_failed(before[0].over if before else call.over):
        return "unknown"
    if not before:
        if not timer.waits(call.request.n):
            return "open"
        due = last_expiry(runtime, timer)
        is_sure = timer.most is None or (due is not None and call.reply is not None and call.reply.t < due)
        return False if is_sure else "unknown"
    cancel = timer.cancelled
    if cancel is None:
        return "unknown"  # it had expired when somebody cancelled it
    due = earliest(runtime, timer, len([c for c in timer.callbacks if c.n < cancel.request.n]))
    while_waiting = cancel.reply is not None and not cancel.reply.failed and due is not None and cancel.reply.t < due
    return True if while_waiting and cancel.over < call.request.n else "unknown"


def due_shown(runtime: ObservedRuntime, kind: Kind, due: DueAnswer) -> str:
    """Such an answer for people."""
    if isinstance(due, bool):
        return str(due).lower()
    option = option_of(runtime, kind, "is-cancelled")
    declared = runtime.ics.reading(option)
    shown = {"inactive": "true", "cancelled": "false"}.get(declared)
    return f"{shown}, as {option}={declared} declares" if shown and due == "open" else "a boolean"


@property_at("closed", *PHASES.values(), feature="timers", timed=True)
def timers_serve_operational_components(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """No callback enters a component before its on_startup returned, or after its stop or removal did."""
    for member in list(runtime.bodies.values()):
        if not has_timers(member.declaration) or member.suspended:
            continue
        entered = (e for e in runtime.executions.of(member.body) if is_callback(e) or is_trigger(e, member))
        outside = next((e for e in entered if is_outside(runtime, member, e.enter.n)), None)
        if outside is not None:
            yield check.fail(
                "not operational",
                expected=f"'{member.lane}' is called back after its on_startup returned and before stop returned",
                observed="it was called back outside of that",
                at=(outside.enter.n,),
                requirement=PHASES["object" if is_trigger(outside, member) else "index"],
            )


@property_at("closed", *PHASES.values(), feature="timers", timed=True)
def timers_wait_no_longer(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A timer that waits at stop does not call back while its component is stopped; afterwards it does if that is declared."""
    phases = all_timer_phases(runtime)
    for phase in phases:
        plain = [t for t in phase.timers if t.is_started and not t.is_contested and t.call.request.n < phase.of.until]
        waiting = [t for t in plain if t.waits(phase.of.until) and not t.may_have_failed(phase.of.until)]
        dues = [due for t in waiting if (due := latest(runtime, t, len(t.callbacks))) is not None]
        own = (p for p in phases if p.member is phase.member and p.kind == phase.kind)
        following = [p for p in own if p.of.number > phase.of.number]
        paused = [p.t for p in runtime.interactions.pauses if phase.of.closed < p.n]
        paused = [t for t in paused if not following or t < following[0].of.startup.t]
        if paused and any(phase.of.ended_at < due < paused[-1] for due in dues):
            yield check.kept(PHASES[phase.kind])
        if following:
            lasting = [
                t
                for t in waiting
                if t.waits(phase.of.closed)  # another container may have been stopped first
                and not _may_never_come(runtime, t)
            ]
            yield from _after_restart(check, runtime, phase, following[0], lasting)


def _may_never_come(runtime: ObservedRuntime, timer: Timer) -> bool:
    """Is it one of those that are ignored by what may hold?"""
    unusual = (("zero-delay", timer.has_no_delay), ("timer-in-startup", timer.is_in_startup))
    return any(
        is_so and runtime.ics.permits(option_of(runtime, timer.kind, name), "ignored") for name, is_so in unusual
    )


def _after_restart(
    check: Property, runtime: ObservedRuntime, phase: TimerPhase, later: TimerPhase, waiting: list[Timer]
) -> Conclusions:
    waiting = [timer for timer in waiting if not _is_touched(timer, phase, later)]
    resumed = [c for c in later.resumed if c.timer in waiting]
    lates = (_resumed_until(runtime, timer, later) for timer in waiting)
    is_over = any(late is not None and late < later.of.ended_at for late in lates)
    if not resumed and not is_over:
        return
    value = "resumed" if resumed else "dropped"
    if not (yield from takes(runtime, option_of(runtime, phase.kind, "timers-at-stop"), value)):
        declared = "call back after the restart" if value == "dropped" else "are dropped"
        yield check.fail(
            value,
            expected=f"timers of '{phase.member.lane}' that wait when it is stopped {declared}, as declared",
            observed="one called back" if resumed else "none called back",
            at=(waiting[0].call.request.n, phase.of.until, *(c.n for c in resumed)),
            requirement=PHASES[phase.kind],
        )


def _resumed_until(runtime: ObservedRuntime, timer: Timer, later: TimerPhase) -> int | None:
    """Until when a timer that goes on in a later phase must have called back: with the rest of its time, or when a round is due again. None if
    that is not known: rounds that pass while it cannot call back may be left out, and count.
    """
    started, due = later.of.started.t, latest(runtime, timer, len(timer.callbacks))
    if due is None or (
        timer.rate is not None and timer.most is not None and (last_expiry(runtime, timer) or 0) <= started
    ):
        return None
    again = started + (timer.rate.lasts if timer.rate is not None else 0) + lateness(runtime)
    return max(due + started - timer.phase.of.ended_at, again)


def _is_touched(timer: Timer, phase: TimerPhase, later: TimerPhase) -> bool:
    """Did a call after its phase name its number, or cancel it, or schedule its handler anew?"""
    calls = [*phase.afterwards, *later.calls]
    if timer.kind == "index":
        changing = (call for call in calls if call.request.method != s.IS_CANCELED)
        return any((call.request.arguments or (None,))[0] == timer.number for call in changing)
    cancelling = (call.request.timer for call in calls if call.request.method == s.CANCEL)
    return any(t.handler == timer.handler for t in later.timers) or any(one in timer.handles for one in cancelling)
