"""Finds in a trace which timers components started, and which callbacks belong to them (10.3.2)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.reference_models.model.clock_reading import ClockReading
from ucm_cts.reference_models.model.clock_readings import CLOCK_METHODS, readings_of
from ucm_cts.reference_models.model.executions import Execution
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.phases import phases_of
from ucm_cts.reference_models.model.runtime import Member
from ucm_cts.reference_models.model.service_policies import policies_of, policy_elements
from ucm_cts.reference_models.model.timer_events import Timer, TimerCallback, TimerPhase, note_later_calls, time_out_of
from ucm_cts.reference_models.model.timer_times import earliest, goes_on_after_exceptions

_STARTS = (s.START_PERIODIC, s.START_SPORADIC)


def timer_phases(runtime: ObservedRuntime) -> list[TimerPhase]:
    """All phases of components with one policy for index timers, in the order in which they began."""
    if runtime.timer_phases is None:
        found: list[TimerPhase] = []
        for member in runtime.bodies.values():
            if len(policies_of(member.declaration, s.INDEX_TIMERS)) == 1 and not member.suspended:
                found += _phases(runtime, member)
        runtime.timer_phases = found
    return runtime.timer_phases


def is_callback(execution: Execution) -> bool:
    """Was a component entered at the callback of its timers?"""
    return execution.enter.hook == "method" and execution.enter.port == s.TIMER_CALLBACK


def service_calls_of(runtime: ObservedRuntime, member: Member) -> list[MethodCall]:
    """The calls of the timer service that the body of ``member`` made."""
    elements = policy_elements(member.declaration, s.INDEX_TIMERS)
    return [c for c in runtime.interactions.calls if c.request.body == member.body and c.request.port in elements]


def _phases(runtime: ObservedRuntime, member: Member) -> list[TimerPhase]:
    calls, executions = service_calls_of(runtime, member), runtime.executions.of(member.body)
    readings = _readings(runtime, member)
    known: dict[int, Timer] = {}
    found = []
    for of in phases_of(runtime, member):
        phase = TimerPhase(of, readings=readings)
        phase.calls = [c for c in calls if of.startup.n < c.request.n < of.closed]
        phase.executions = [e for e in executions if of.startup.n < e.enter.n < of.closed]
        phase.callbacks = [TimerCallback(e) for e in phase.executions if is_callback(e)]
        happened = [(c.request.n, c) for c in phase.calls] + [(c.n, c) for c in phase.callbacks]
        for _, one in sorted(happened, key=lambda pair: pair[0]):
            if isinstance(one, MethodCall):
                _take_call(runtime, phase, known, one)
            else:
                _take_callback(runtime, phase, known, one)
        found.append(phase)
    note_later_calls(found, calls)
    return found


def _readings(runtime: ObservedRuntime, member: Member) -> dict[str, list[ClockReading]]:
    if not policies_of(member.declaration, s.CLOCK):
        return {}
    return {m: [r for r in readings_of(runtime, m) if r.body == member.body] for m in CLOCK_METHODS}


def _take_call(runtime: ObservedRuntime, phase: TimerPhase, known: dict[int, Timer], call: MethodCall) -> None:
    arguments = call.request.arguments or ()
    number = arguments[0] if arguments else None
    if not isinstance(number, int):
        return
    before = known.get(number)
    earlier = None
    if before is not None and before.phase is not phase:
        before, earlier = None, before
    if call.request.method == s.CANCEL_TIMER and before is not None:
        before.cancels.append(call)
        before.is_contested = before.is_contested or before.call.over > call.request.n
    if call.request.method not in _STARTS:
        return
    timer = _timer(runtime, phase, call, number, arguments)
    if timer is None:
        return
    if before is not None:
        before.again = call
        overlaps = any(c.over > call.request.n for c in (before.call, *before.cancels))
        if overlaps or (before.is_started and before.waits(call.request.n)):
            before.is_contested = True
        timer.is_contested = before.is_contested  # which one calls back from now on is open
    elif earlier is not None and earlier.waits(call.request.n):
        timer.is_contested = earlier.is_started and runtime.ics.permits("timers-at-stop", "resumed")
    phase.timers.append(timer)
    if timer.is_started or (before is None and earlier is None):
        known[number] = timer


def _timer(
    runtime: ObservedRuntime, phase: TimerPhase, call: MethodCall, number: int, arguments: tuple[Datum, ...]
) -> Timer | None:
    times = [time_out_of(one) for one in arguments[1:]]
    delay = times[0] if times else None
    rate = times[1] if len(times) > 1 else None
    if delay is None:
        return None
    is_in_startup = call.request.n < phase.of.started.n
    return Timer(phase, call, number, delay, rate, is_in_startup, goes_on=goes_on_after_exceptions(runtime, "index"))


def _take_callback(
    runtime: ObservedRuntime, phase: TimerPhase, known: dict[int, Timer], callback: TimerCallback
) -> None:
    number = callback.number
    timer = known.get(number) if number is not None else None
    if timer is None or timer.call.request.n > callback.n:
        return
    callback.timer = timer
    if timer.phase is not phase:
        if timer.waits(phase.of.startup.n) and timer.is_started:
            phase.resumed.append(callback)
        else:
            callback.timer = None
        return
    before = _cancelled_before(phase, timer)
    due = earliest(runtime, timer, len(timer.callbacks))
    if before is not None and due is not None and callback.t < due:
        callback.timer = before  # it was on its way when its timer was cancelled
    callback.timer.callbacks.append(callback)


def _cancelled_before(phase: TimerPhase, timer: Timer) -> Timer | None:
    """The timer of the same number that had been cancelled when ``timer`` was started."""
    same = [t for t in phase.timers if t.number == timer.number and t.again is timer.call]
    return same[-1] if same and same[-1].cancels else None
