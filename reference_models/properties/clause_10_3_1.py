"""Properties about schedulers and object timers: they are given out, their methods answer, and identifiers tell them apart (10.3.1)."""

from __future__ import annotations

import itertools
from collections.abc import Generator, Iterator

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.reference_models.conclusions import Conclusions, Taken, takes
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.object_timers import object_timer_phases, told_by
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.timer_events import Timer, TimerPhase
from ucm_cts.reference_models.model.timer_options import option_of
from ucm_cts.reference_models.model.timer_times import earliest
from ucm_cts.reference_models.properties.clause_10_3_end import DueAnswer, answer_of, due_shown
from ucm_cts.reference_models.properties.declaration import Property, property_at

_GIVES, _SCHEDULER, _CANCELS = "R-10.3.1-01", "R-10.3.1-17", "R-10.3.1-31"
_DIFFER, _STAYS, _ROUNDS, _TELLS = "R-10.3.1-28", "R-10.3.1-29", "R-10.3.1-30", "R-10.3.1-33"

_SEVERAL = 5
"""So many identifiers of timers that wait together are compared."""


@property_at("closed", _SCHEDULER, _GIVES, _CANCELS, feature="timers")
def schedulers_give_timers(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """The operations of the scheduler return, the one for a single trigger with a timer."""
    for phase in object_timer_phases(runtime):
        for timer in phase.timers:
            reply = timer.call.reply
            if reply is None or reply.n > phase.of.until:
                continue
            if reply.failed:
                if not (yield from _may_be_refused(runtime, timer)):
                    how = "it raised" if reply.raised else f"it raised {reply.exception}"
                    yield _wrong_call(check, phase, timer.call, "returns", how, _SCHEDULER)
                continue
            yield check.kept(_SCHEDULER)
            if timer.call.request.method == s.SCHEDULE_REPEATED:
                yield from _repeated_result(check, runtime, phase, timer)
            elif reply.timer is None:
                yield _wrong_call(
                    check, phase, timer.call, "returns a timer", f"it gave {reply.wrong or 'none'}", _GIVES
                )


def _wrong_call(
    check: Property, phase: TimerPhase, call: MethodCall, due: str, observed: str, requirement: str
) -> Finding:
    """``call`` did not do what is ``due``."""
    name = f"{call.request.method}({printed(call.request.arguments or ())[1:-1]})"
    at = (call.request.n, *((call.reply.n,) if call.reply is not None else ()))
    return check.fail(
        f"{call.request.method} {due}",
        expected=f"{name} of '{phase.member.lane}' {due}",
        observed=observed,
        at=at,
        requirement=requirement,
    )


def _may_be_refused(runtime: ObservedRuntime, timer: Timer) -> Generator[Taken, None, bool]:
    """May the scheduler refuse this call, by a reading that is not declared otherwise?"""
    reasons = [(option_of(runtime, "object", "zero-delay"), "refused")] if timer.has_no_delay else []
    reasons += [("zero-rounds", "refused")] if timer.max_rounds == 0 else []
    for option, value in reasons:
        if (yield from takes(runtime, option, value)):
            return True
    return False


def _repeated_result(check: Property, runtime: ObservedRuntime, phase: TimerPhase, timer: Timer) -> Conclusions:
    """Whether the method for repeated triggers returns the timer is declared; to return it is never wrong."""
    reply = timer.call.reply
    assert reply is not None
    if reply.wrong:
        yield _wrong_call(check, phase, timer.call, "returns a timer or nothing", f"it gave {reply.wrong}", _SCHEDULER)
    elif reply.timer is not None:
        yield Taken("repeated-result", "timer")
    elif not (yield from takes(runtime, "repeated-result", "printed")):
        yield _wrong_call(check, phase, timer.call, "returns a timer, as declared", "it gave none", _CANCELS)


@property_at("closed", _GIVES, _STAYS, _ROUNDS, _TELLS, feature="timers")
def timers_answer(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """The methods of a timer return, also when it has expired or was cancelled, with a value of their type."""
    for phase in object_timer_phases(runtime):
        for call in phase.calls:
            request, reply = call.request, call.reply
            if request.timer is None or reply is None or reply.n > phase.of.until:
                continue
            if reply.failed:
                if request.method != s.CANCEL or _certainly_waits(runtime, phase, call):
                    observed = "it raised" if reply.raised else f"it raised {reply.exception}"
                    yield _wrong_call(check, phase, call, "returns", observed, _GIVES)
                continue
            answer = told_by(call, request.method or "")
            due, requirement = _TYPES.get(request.method or "", ("", ""))
            if due and not _is_of_type(request.method or "", answer):
                observed = f"it gave {reply.wrong or printed(reply.results or ())[1:-1] or 'nothing'}"
                yield _wrong_call(check, phase, call, f"gives {due}", observed, requirement)
            elif due:
                yield check.kept(_GIVES)


_TYPES = {
    s.TIMER_ID: ("a string", _STAYS),
    s.TIMER_ROUNDS: ("a number of 32 bits without sign", _ROUNDS),
    s.IS_CANCELLED: ("a boolean", _TELLS),
}
"""What methods give, and the requirement about it."""


def _is_of_type(method: str, answer: Datum | None) -> bool:
    match method:
        case s.TIMER_ID:
            return isinstance(answer, str)
        case s.TIMER_ROUNDS:
            is_number = isinstance(answer, int) and not isinstance(answer, bool)
            return is_number and 0 <= answer <= s.LARGEST_NUMBER  # type: ignore[operator]
        case _:
            return isinstance(answer, bool)


def _asked(phase: TimerPhase, call: MethodCall) -> Timer | None:
    """The timer that ``call`` is about, if its triggers can be told from others."""
    timer = next((t for t in phase.timers if call.request.timer in t.handles), None)
    return timer if timer is not None and not timer.is_contested else None


def _certainly_waits(runtime: ObservedRuntime, phase: TimerPhase, call: MethodCall) -> bool:
    """Is the call about a timer that certainly waits until it returns?"""
    timer = _asked(phase, call)
    if timer is None or not timer.has_usual_times or timer.is_in_startup or not timer.waits(call.request.n):
        return False
    if timer.may_have_failed(call.over):
        return False
    due = earliest(runtime, timer, sum(c.n < call.request.n for c in timer.callbacks))
    return due is not None and call.reply is not None and call.reply.t < due


@property_at("closed", _DIFFER, feature="timers")
def identifiers_differ(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Timers of one scheduler that wait together have different identifiers; where that is declared, all timers have."""
    is_ever = runtime.ics.reading("timer-ids") == "ever"
    for phase in object_timer_phases(runtime):
        known = [t for t in phase.timers if t.id is not None and t.is_started]
        pairs = [(a, b) for a, b in itertools.combinations(known, 2) if a.call.request.port == b.call.request.port]
        together = [(a, b) for a, b in pairs if is_ever or _wait_together(runtime, a, b)]
        same = next(((a, b) for a, b in together if a.id == b.id), None)
        if same is not None:
            one, other = same
            yield check.fail(
                "same",
                expected=f"timers {one.number} and {other.number} of '{phase.member.lane}'"
                + (", as timer-ids=ever declares," if is_ever else ", which wait together,")
                + " have different identifiers",
                observed=f"both have {printed(one.id)}",
                at=(one.call.request.n, other.call.request.n),
            )
        elif len({t.number for pair in together for t in pair}) >= _SEVERAL:
            yield check.kept()


def _wait_together(runtime: ObservedRuntime, one: Timer, other: Timer) -> bool:
    """Did ``one`` certainly wait when ``other`` was made?"""
    begun = other.call
    due = earliest(runtime, one, (one.most or 1) - 1)
    is_before = due is not None and begun.reply is not None and begun.reply.t < due
    return (
        is_before
        and not one.may_have_failed(begun.over)
        and one.waits(begun.request.n)
        and one.call.over < begun.request.n
        and not one.is_in_startup
    )


@property_at("closed", _STAYS, feature="timers")
def identifiers_stay(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A timer gives the same identifier whenever it is asked."""
    for phase in object_timer_phases(runtime):
        told: dict[int, list[tuple[Datum, int]]] = {}
        for call in phase.calls:
            identifier = told_by(call, s.TIMER_ID)
            if isinstance(identifier, str) and call.request.timer is not None:
                told.setdefault(call.request.timer, []).append((identifier, call.request.n))
        for readings in told.values():
            changed = next((one for one in readings if one[0] != readings[0][0]), None)
            if changed is not None:
                yield check.fail(
                    "changes",
                    expected=f"a timer of '{phase.member.lane}' has the identifier {printed(readings[0][0])} whenever it is asked",
                    observed=f"it said {printed(changed[0])}",
                    at=(readings[0][1], changed[1]),
                )
        for timer in phase.timers:
            readings = [one for handle in timer.handles for one in told.get(handle, ())]
            if len(readings) > 1 and timer.callbacks and len({identifier for identifier, _ in readings}) == 1:
                yield check.kept()


@property_at("closed", _TELLS, feature="timers", timed=True)
def is_cancelled_tells(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """is_cancelled gives false for a timer that waits and true for one that was cancelled while it waited."""
    for phase in object_timer_phases(runtime):
        told: set[bool] = set()
        for call in (c for c in phase.calls if c.request.method == s.IS_CANCELLED):
            timer, answer = _asked(phase, call), told_by(call, s.IS_CANCELLED)
            if timer is None or not isinstance(answer, bool) or call.reply is None:
                continue
            due = _due_answer(runtime, phase, timer, call)
            wrong = isinstance(due, bool) and answer is not due
            if due == "open":
                wrong = not (
                    yield from takes(
                        runtime, option_of(runtime, "object", "is-cancelled"), "inactive" if answer else "cancelled"
                    )
                )
            if wrong:
                yield check.fail(
                    f"not {str(due).lower()}",
                    expected=f"is_cancelled of {timer.label} of '{phase.member.lane}' gives {due_shown(runtime, phase.kind, due)}",
                    observed=f"it gave {str(answer).lower()}",
                    at=(call.request.n, call.reply.n),
                )
                break
            if isinstance(due, bool):
                told.add(due)
        else:
            if len(told) > 1:
                yield check.kept()


def _due_answer(runtime: ObservedRuntime, phase: TimerPhase, timer: Timer, call: MethodCall) -> DueAnswer:
    """What is_cancelled has to answer, as ``answer_of``."""
    overlaps = any(c.request.n < call.over and c.over > call.request.n for c in timer.cancels)
    if overlaps or call.over > phase.of.until or not timer.has_usual_times or timer.is_in_startup:
        return "unknown"
    return answer_of(runtime, timer, call)


@property_at("closed", _ROUNDS, feature="timers", timed=True)
def rounds_tell(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """The attribute rounds is the number that was asked for, that was done or that is left: the same for all timers."""
    fitting = {"requested", "done", "left"}
    seen: list[tuple[TimerPhase, MethodCall, Timer]] = []
    for phase in object_timer_phases(runtime):
        for call in (c for c in phase.calls if c.request.method == s.TIMER_ROUNDS):
            timer, told = _asked(phase, call), told_by(call, s.TIMER_ROUNDS)
            is_judged = timer is not None and not timer.is_in_startup and call.over < phase.of.until
            if timer is None or not isinstance(told, int) or not timer.has_usual_times or not is_judged:
                continue
            seen.append((phase, call, timer))
            explained = {reading for reading, value in _readings_of_rounds(runtime, timer, call) if value == told}
            declared = runtime.ics.reading("rounds-attribute")
            if not fitting & explained or declared not in ("observed", *explained):
                yield check.fail(
                    "otherwise",
                    expected=f"rounds of {timer.label} of '{phase.member.lane}' tells the number of triggers that was asked for, done or left"
                    + (f", as declared: {declared}" if declared != "observed" else ", always the same one"),
                    observed=f"it gave {told}, of {timer.max_rounds or 1} with {_done(timer, call.request.n)} done",
                    at=(call.request.n, call.over),
                )
                return
            fitting &= explained
    if len(fitting) == 1 and len(seen) > 1:
        yield from takes(runtime, "rounds-attribute", *fitting)
    if any(timer.callbacks and timer.max_rounds is not None for _, _, timer in seen):
        yield check.kept()


def _done(timer: Timer, n: int) -> int:
    return sum(callback.n < n for callback in timer.callbacks)


def _readings_of_rounds(runtime: ObservedRuntime, timer: Timer, call: MethodCall) -> Iterator[tuple[str, int]]:
    """What the attribute may be under each reading: a trigger that is under way, or due, may be counted or not, a timer with one trigger may
    have no rounds, and one that was cancelled may have none left.
    """
    most = timer.max_rounds or 1
    yield "requested", most
    if timer.max_rounds is None:
        yield "requested", 0
    under_way = any(
        c.n < call.over and not (c.execution.over and c.execution.end < call.request.n) for c in timer.callbacks
    )
    until = _done(timer, call.over)
    while until < most and call.reply is not None and (earliest(runtime, timer, until) or call.reply.t) <= call.reply.t:
        until += 1
    for done in range(_done(timer, call.request.n) - under_way, until + 1):
        yield "done", done
        yield "left", most - done
    if timer.max_rounds is None:
        yield "done", 0
    if timer.max_rounds is None or timer.cancels or timer.may_have_failed(call.over):
        yield "left", 0
