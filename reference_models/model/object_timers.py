"""Finds in a trace which object timers components made, and which triggers belong to them (10.3.1)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.reference_models.model.executions import Execution
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.phases import phases_of
from ucm_cts.reference_models.model.runtime import Member
from ucm_cts.reference_models.model.service_policies import policies_of, policy_elements
from ucm_cts.reference_models.model.timer_events import Timer, TimerCallback, TimerPhase, span_of

_STARTS = (s.SCHEDULE_ONCE, s.SCHEDULE_REPEATED)


def object_timer_phases(runtime: ObservedRuntime) -> list[TimerPhase]:
    """All phases of components with object timers, in the order in which they began."""
    if runtime.object_timer_phases is None:
        found: list[TimerPhase] = []
        for member in runtime.bodies.values():
            if policies_of(member.declaration, s.OBJECT_TIMERS) and not member.suspended:
                found += _Reading(runtime, member).phases()
        runtime.object_timer_phases = found
    return runtime.object_timer_phases


def is_trigger(execution: Execution, member: Member) -> bool:
    """Was a component entered at one of its handlers?"""
    return execution.enter.hook == "method" and execution.enter.port in member.declaration.handlers


class _Reading:
    """The object timers of one component.

    ``owners``: the timer of each number under which one came to the body, as far as that is known.
    ``ids``: what the timer of such a number said first of its identifier.
    """

    def __init__(self, runtime: ObservedRuntime, member: Member) -> None:
        self.runtime, self.member = runtime, member
        elements = policy_elements(member.declaration, s.OBJECT_TIMERS)
        calls = [c for c in runtime.interactions.calls if c.request.body == member.body and c.request.port in elements]
        self.calls = calls
        self.executions = runtime.executions.of(member.body)
        self.timers: list[Timer] = []
        self.owners: dict[int, Timer] = {}
        self.ids: dict[int, Datum] = {}
        for call in calls:
            identifier = told_by(call, s.TIMER_ID)
            if identifier is not None and call.request.timer is not None:
                self.ids.setdefault(call.request.timer, identifier)

    def phases(self) -> list[TimerPhase]:
        """Its phases, with what belongs to each."""
        found = []
        for of in phases_of(self.runtime, self.member):
            phase = TimerPhase(of, kind="object", ids=self.ids)
            phase.calls = [c for c in self.calls if of.startup.n < c.request.n < of.closed]
            phase.executions = [e for e in self.executions if of.startup.n < e.enter.n < of.closed]
            phase.callbacks = [TimerCallback(e) for e in phase.executions if is_trigger(e, self.member)]
            happened = [(c.request.n, c) for c in phase.calls] + [(c.n, c) for c in phase.callbacks]
            for _, one in sorted(happened, key=lambda pair: pair[0]):
                if isinstance(one, MethodCall):
                    self._take_call(phase, one)
                else:
                    self._take_trigger(phase, one)
            found.append(phase)
        return found

    def _take_call(self, phase: TimerPhase, call: MethodCall) -> None:
        request = call.request
        if request.method in _STARTS:
            timer = _timer(phase, call, len(self.timers) + 1)
            if timer is not None:
                phase.timers.append(timer)
                self.timers.append(timer)
                if call.reply is not None:
                    self._own(timer, call.reply.timer)
        elif request.method == s.CANCEL and request.timer is not None:
            owner = self.owners.get(request.timer)
            if owner is not None:
                owner.cancels.append(call)

    def _own(self, timer: Timer, number: int | None) -> None:
        """It came to the body under this number."""
        if number is not None:
            self.owners[number] = timer
            timer.handles.append(number)

    def _take_trigger(self, phase: TimerPhase, callback: TimerCallback) -> None:
        callback.id = self.ids.get(callback.enter.timer or 0)
        before = [t for t in self.timers if t.handler == callback.enter.port and t.call.request.n < callback.n]
        here = [t for t in before if t.phase is phase]
        if not here:
            waiting = [t for t in before if t.phase is not phase and t.is_started and t.waits(phase.of.startup.n)]
            if waiting:
                callback.timer = waiting[0]
                phase.resumed.append(callback)
            return
        timer = self._whose(callback, here)
        if timer is None:
            callback.is_open = callback.stranger is None
            return
        callback.timer = timer
        timer.callbacks.append(callback)
        self._own(timer, callback.enter.timer)

    def _whose(self, callback: TimerCallback, timers: list[Timer]) -> Timer | None:
        """The timer of the handler that triggers it: the only one, or that with the identifier that was told; those that may be it are
        contested from now on.
        """
        if callback.id is not None:
            same = [t for t in timers if t.id == callback.id]
            others = [t for t in self.timers if t.handler != callback.enter.port and t.phase is timers[0].phase]
            others = [t for t in others if t.id == callback.id and t.waits(callback.n)]
            if others and not same:
                callback.stranger = others[0]
                return None
            unknown = [t for t in timers if t.id is None]
            timers = same if len(same) == 1 else timers if len(timers) == 1 else same or unknown
        if len(timers) == 1:
            return timers[0]
        for timer in timers:
            timer.is_contested = True
        return None


def _timer(phase: TimerPhase, call: MethodCall, number: int) -> Timer | None:
    arguments = call.request.arguments or ()
    times = [span_of(one) for one in arguments[:2]]
    is_repeated = call.request.method == s.SCHEDULE_REPEATED
    delay, rate = times[0] if times else None, times[1] if len(times) > 1 else None
    rounds = arguments[2] if is_repeated and len(arguments) > 2 else None
    if delay is None or (is_repeated and (rate is None or not isinstance(rounds, int))):
        return None
    return Timer(
        phase,
        call,
        number,
        delay,
        rate if is_repeated else None,
        call.request.n < phase.of.started.n,
        "object",
        call.request.handler or "",
        rounds if isinstance(rounds, int) else None,
    )


def told_by(call: MethodCall, method: str) -> Datum | None:
    """What ``method`` of an object timer gave; None if this is no such call, or it gave nothing."""
    reply = call.reply
    if call.request.method != method or call.request.timer is None or reply is None or reply.failed:
        return None
    return reply.results[0] if reply.results and len(reply.results) == 1 else None
