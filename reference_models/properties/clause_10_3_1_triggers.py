"""Properties about triggers of object timers: how many there are, at which handler, and what they tell (10.3.1)."""

from __future__ import annotations

from collections import Counter

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.reference_models.conclusions import Conclusions, takes
from ucm_cts.reference_models.model.execution_policies import protection_of
from ucm_cts.reference_models.model.object_timers import object_timer_phases
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.paced_phases import granularity, lateness
from ucm_cts.reference_models.model.phases import noticed
from ucm_cts.reference_models.model.timer_events import TimeOut, Timer, TimerCallback, TimerPhase
from ucm_cts.reference_models.model.timer_options import reading_of
from ucm_cts.reference_models.model.timer_times import MOST, busy, earliest, free_after, is_long, latest, sure_rounds
from ucm_cts.reference_models.properties.clause_10_3 import at_of
from ucm_cts.reference_models.properties.declaration import Property, property_at

_BOUNDED, _COUNTED, _HANDLER = "R-10.3.1-23", "R-10.3.1-24", "R-10.3.1-25"
_TIMER, _DELTA = "R-10.3.1-26", "R-10.3.1-27"

_QUIET = 3
"""A timer that has made its rounds does not trigger again within so many intervals."""

_FIRST_ROUNDS = {0: "zero", 1: "one"}
"""The readings of ``first-round``."""


@property_at("closed", _BOUNDED, feature="timers", timed=True)
def rounds_are_bounded(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A repeated trigger comes as often as was asked for; what no rounds mean is declared."""
    for phase in object_timer_phases(runtime):
        for timer in phase.timers:
            if timer.max_rounds is None or timer.rate is None or timer.is_contested:
                continue
            if timer.max_rounds == 0:
                yield from _no_rounds(check, runtime, timer)
            elif len(timer.callbacks) > timer.max_rounds:
                yield check.fail(
                    "too many",
                    expected=f"{timer.label} of '{phase.member.lane}' triggers {timer.max_rounds} times",
                    observed=f"it triggered {len(timer.callbacks)} times",
                    at=at_of(timer, *timer.callbacks[: timer.max_rounds + 1]),
                )
            elif len(timer.callbacks) == timer.max_rounds:
                if _is_quiet(timer, timer.rate):
                    yield check.kept()
            elif timer.is_started and timer.has_usual_times and _lacks_rounds(runtime, timer):
                yield check.fail(
                    "too few",
                    expected=f"{timer.label} of '{phase.member.lane}' triggers {timer.max_rounds} times, as timer-overrun=queued declares",
                    observed=f"it triggered {len(timer.callbacks)} times",
                    at=(
                        *at_of(timer, *timer.callbacks),
                        *noticed(runtime, latest(runtime, timer, timer.max_rounds - 1)),
                    ),
                )


@property_at("closed", _BOUNDED, feature="timers", timed=True)
def rounds_by_identifier(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Where several repeated timers of one handler have as many rounds, and are told apart by their identifiers only, each identifier comes as
    often as that.
    """
    for phase in object_timer_phases(runtime):
        for handler in sorted({timer.handler for timer in phase.timers if timer.is_contested}):
            timers = [timer for timer in phase.timers if timer.handler == handler]
            triggers = [callback for callback in phase.callbacks if callback.enter.port == handler]
            rounds = timers[0].max_rounds
            if not rounds or not _are_alike(timers, triggers) or not all(_is_over(runtime, timer) for timer in timers):
                continue
            came = Counter(printed([trigger.id]) for trigger in triggers)
            wrong = [identifier for identifier, times in came.items() if times != rounds]
            if len(came) != len(timers):
                continue  # that identifiers differ is another requirement
            if not wrong:
                yield check.kept()
                continue
            yield check.fail(
                "rounds of others",
                expected=f"each of {len(timers)} timers of handler '{handler}' of '{phase.member.lane}' triggers {rounds} times",
                observed=f"the one with the identifier {wrong[0][1:-1]} triggered {came[wrong[0]]} times",
                at=(*(timer.call.request.n for timer in timers), *(trigger.n for trigger in triggers)),
            )


def _are_alike(timers: list[Timer], triggers: list[TimerCallback]) -> bool:
    """Have all one scheduler and as many rounds, waited together, and does each trigger tell its identifier?"""
    first = triggers[0].n if triggers else 0
    same = len({(timer.call.request.port, timer.max_rounds) for timer in timers}) == 1
    plain = all(t.is_started and t.has_usual_times and not t.cancels and t.call.over < first for t in timers)
    return same and plain and all(trigger.id is not None and not trigger.may_be_earlier for trigger in triggers)


def _is_over(runtime: ObservedRuntime, timer: Timer) -> bool:
    """Have all its rounds been due, and did nothing keep one out or raise?"""
    due = latest(runtime, timer, (timer.max_rounds or 1) - 1)
    held = any(is_long(runtime, begin, end) for begin, end in busy(runtime, timer.until[1]))
    raised = any(callback.execution.failed for callback in timer.phase.callbacks)
    return due is not None and due + lateness(runtime) < timer.until[1] and not held and not raised


def _is_quiet(timer: Timer, rate: TimeOut) -> bool:
    """Did it stay silent for long after its last round?"""
    return timer.until[1] - timer.callbacks[-1].t > _QUIET * rate.lasts


def _lacks_rounds(runtime: ObservedRuntime, timer: Timer) -> bool:
    """Are rounds missing, of which none may be left out, although all have been due, and nothing keeps them out any more?"""
    assert timer.max_rounds is not None
    overrun, anchor, in_startup = (
        reading_of(runtime, timer.kind, option) for option in ("timer-overrun", "timer-anchor", "timer-in-startup")
    )
    is_queued = (overrun, anchor) == ("queued", "grid")
    is_there = not timer.is_in_startup or in_startup == "works"
    due = latest(runtime, timer, timer.max_rounds - 1)
    if due is None or not is_queued or not is_there:
        return False
    free = free_after(runtime, timer, max([due, *(c.t for c in timer.callbacks)]), timer.until[1])
    return free is not None and free + timer.max_rounds * lateness(runtime) < timer.until[1]


def _no_rounds(check: Property, runtime: ObservedRuntime, timer: Timer) -> Conclusions:
    """What a timer with no rounds did is permitted."""
    if timer.has_no_delay or timer.is_in_startup:
        return  # another option may be the reason of what it did
    due = latest(runtime, timer, 1)
    if timer.is_started:
        free = None if due is None else free_after(runtime, timer, due, timer.until[1])
        if not timer.callbacks and (free is None or free + lateness(runtime) > timer.until[1]):
            return
        value = "endless" if timer.callbacks else "none"
    elif timer.call.reply is not None and timer.call.reply.n <= timer.phase.of.until:
        value = "refused"
    else:
        return
    if not (yield from takes(runtime, "zero-rounds", value)):
        yield check.fail(
            "no rounds",
            expected=f"{timer.label} of '{timer.phase.member.lane}', with no rounds, behaves as declared: "
            f"zero-rounds={runtime.ics.reading('zero-rounds')}",
            observed=f"it did as under '{value}'",
            at=at_of(timer, *timer.callbacks[:1]),
        )


@property_at("closed", _COUNTED, feature="timers", timed=True)
def rounds_count_up(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """The rounds of successive triggers of one timer rise by one from the declared first one, the same for all timers; a single trigger has that,
    or 0.
    """
    claims: set[Datum | None] = set()
    for phase in object_timer_phases(runtime):
        for timer in phase.timers:
            if timer.is_contested or not timer.callbacks or not timer.is_started:
                continue
            rounds = [_round_of(callback) for callback in timer.callbacks[:MOST]]
            first = rounds[0]
            expected = f"triggers of {timer.label} of '{phase.member.lane}' tell rounds that rise by one"
            declared = runtime.ics.reading("first-round")
            is_single = timer.rate is None
            sure = sure_rounds(runtime, timer)
            if not sure:
                continue  # rounds may have been left out before the first one
            name = _FIRST_ROUNDS.get(first) if isinstance(first, int) and not isinstance(first, bool) else None
            is_right = name is not None and (
                (is_single and first == 0) or (yield from takes(runtime, "first-round", name))
            )
            claims |= {first} if first or not is_single else set()
            is_right = is_right and len(claims) < 2
            if not is_right:
                yield check.fail(
                    "first",
                    expected=f"{expected}, from {'0 or 1, the same for all timers' if declared == 'observed' else declared}",
                    observed=f"the first one told {printed(first)}",
                    at=at_of(timer, timer.callbacks[0]),
                )
                continue
            is_protected = protection_of(phase.member.declaration) not in ("", "unprotected")
            wrong = _out_of_order(rounds if is_protected else rounds[:sure], sure)
            if wrong is not None:
                yield check.fail(
                    "not by one",
                    expected=expected,
                    observed=f"trigger {wrong + 1} told {printed(rounds[wrong])}, and the one before it {printed(rounds[wrong - 1])}",
                    at=at_of(timer, *timer.callbacks[wrong - 1 : wrong + 1]),
                )
            elif len(rounds) > 1:
                yield check.kept()


def _round_of(callback: TimerCallback) -> Datum | None:
    arguments = callback.enter.arguments or ()
    return arguments[1] if len(arguments) == 2 else None


def _out_of_order(rounds: list[Datum | None], sure: int) -> int | None:
    """The first place where a round does not follow from the one before; from ``sure`` on some may have been left out."""
    for place in range(1, len(rounds)):
        one, other = rounds[place - 1], rounds[place]
        if not isinstance(one, int) or not isinstance(other, int) or isinstance(other, bool):
            return place
        if other != one + 1 if place < sure else other <= one:
            return place
    return None


@property_at("closed", _HANDLER, _TIMER, feature="timers", timed=True)
def triggers_have_their_timer(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Each trigger enters the handler that its timer was made with, and hands over that timer."""
    for phase in object_timer_phases(runtime):
        is_right = True
        for callback in phase.callbacks:
            if callback.enter.wrong:
                observed, requirement = f"it was handed {callback.enter.wrong}", _TIMER
            elif callback.stranger is not None:
                observed = f"it was handed {callback.stranger.label}"
                requirement = _HANDLER
            elif callback.timer is None and not callback.is_open:
                observed, requirement = "no timer that was made with it was left", _HANDLER
            else:
                why = _other_timer(runtime, phase, callback)
                if not why:
                    continue
                observed, requirement = why, _TIMER
            yield check.fail(
                "otherwise",
                expected=f"handler '{callback.enter.port}' of '{phase.member.lane}' is triggered by a timer that was made with it, and handed "
                "that timer",
                observed=observed,
                at=(callback.n,),
                requirement=requirement,
            )
            is_right = False
            break
        come = [c.timer for c in phase.callbacks if c.timer is not None and c.timer.phase is phase]
        if is_right and len({timer.handler for timer in come}) > 1:
            yield check.kept(_HANDLER)
        asked = (c for c in phase.callbacks if c.timer in come and c.id is not None)
        known = {(c.enter.port, c.timer.number) for c in asked if c.timer is not None and _was_known(c.timer, c)}
        if is_right and len(known) > len({handler for handler, _ in known}):
            yield check.kept(_TIMER)


def _was_known(timer: Timer, callback: TimerCallback) -> bool:
    """Had the timer said its identifier before it triggered?"""
    return timer.handles[0] != callback.enter.timer


def _other_timer(runtime: ObservedRuntime, phase: TimerPhase, callback: TimerCallback) -> str:
    """Why the timer that was handed over is not the one that triggers; empty if it may be."""
    if callback.id is None or callback in phase.resumed:
        return ""
    same_handler = [t for t in phase.timers if t.handler == callback.enter.port and t.call.request.n < callback.n]
    are_others = bool(same_handler) and all(t.id not in (None, callback.id) for t in same_handler)
    if are_others and not callback.may_be_earlier:
        return f"it was handed a timer with the identifier {printed(callback.id)}, which none of that handler has"
    timer = callback.timer
    if timer is None or timer.is_contested or timer.id is None:
        return ""
    if timer.id != callback.id:
        return (
            f"it was handed a timer with the identifier {printed(callback.id)}, and the timer has {printed(timer.id)}"
        )
    number = timer.callbacks.index(callback) if callback in timer.callbacks else 0
    due = earliest(runtime, timer, number)
    is_early = due is not None and callback.t < due
    if not is_early and not timer.has_come(callback.n):
        return ""
    owed = [t for t in same_handler if t is not timer and _is_owed(runtime, t, callback)]
    return f"it was handed timer {timer.number}, and timer {owed[0].number} was due" if owed else ""


def _is_owed(runtime: ObservedRuntime, timer: Timer, callback: TimerCallback) -> bool:
    """Was a trigger of ``timer`` due at the callback, and had not come?"""
    due = earliest(runtime, timer, len([c for c in timer.callbacks if c.n < callback.n]))
    return due is not None and due <= callback.t and timer.waits(callback.n)


@property_at("closed", _DELTA, feature="timers", timed=True)
def delta_time_tells(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """delta_time is one quantity for all triggers, the declared one if there is one, within timer-lateness."""
    declared = runtime.ics.reading("delta-time")
    common = {"since-scheduled", "since-last", "lateness", "requested"}
    for phase in object_timer_phases(runtime):
        for callback in phase.callbacks[:MOST]:
            told, timer = callback.delta, callback.timer
            fitting: set[str] = set()
            if told is not None and timer is not None and not timer.is_contested and timer.phase is phase:
                fitting = _readings_of_delta(runtime, timer, timer.callbacks.index(callback), told)
                common &= fitting
                if len(fitting) == 1:
                    yield from takes(runtime, "delta-time", *fitting)
            elif told is not None or callback.enter.wrong:
                continue
            if told is None or not common or declared not in ("observed", *fitting):
                yield check.fail(
                    "no time" if told is None else "otherwise",
                    expected=f"triggers of '{phase.member.lane}' tell a time difference"
                    + (f", as declared: {declared}" if declared != "observed" else ", the same one for all triggers"),
                    observed=f"handler '{callback.enter.port}' was told {printed((callback.enter.arguments or (None,))[0])}",
                    at=(*(at_of(timer) if timer is not None else ()), callback.n),
                )
                return
            yield check.kept()


def _readings_of_delta(runtime: ObservedRuntime, timer: Timer, number: int, told: TimeOut) -> set[str]:
    """The readings of ``delta-time`` that explain what trigger ``number`` told."""
    callback, tolerance = timer.callbacks[number], lateness(runtime) + granularity(runtime)
    made = timer.call.request.t
    last = timer.callbacks[number - 1].t if number else made
    before = earliest(runtime, timer, number - 1) if number else None
    due = earliest(runtime, timer, number)
    # a trigger may wait for its component with what it tells
    expired = min(due, callback.t) if due is not None else made
    fitting = set()
    if expired - made - tolerance <= told.lasts <= callback.t - made + tolerance:
        fitting.add("since-scheduled")
    least, most = expired - last - tolerance, callback.t - (last if before is None else min(before, last)) + tolerance
    if least <= told.lasts <= most or (not number and told.lasts <= tolerance):
        fitting.add("since-last")
    if due is None or timer.is_in_startup or told.lasts <= max(0, callback.t - due) + tolerance:
        fitting.add("lateness")
    asked = [timer.delay] if timer.rate is None else [timer.rate, *([] if number else [timer.delay])]
    times = [one.lasts for one in asked]
    if timer.rate is not None and not number:
        times.append(timer.delay.lasts + timer.rate.lasts)  # first-repeated-trigger=delay-plus-interval
    if any(abs(told.lasts - one) <= granularity(runtime) for one in times):
        fitting.add("requested")
    return fitting
