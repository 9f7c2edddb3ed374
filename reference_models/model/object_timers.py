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
from ucm_cts.reference_models.model.timer_events import Timer, TimerCallback, TimerPhase, note_later_calls, span_of
from ucm_cts.reference_models.model.timer_options import option_of
from ucm_cts.reference_models.model.timer_times import earliest, goes_on_after_exceptions

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
    ``resumed``: how often each timer triggered in later phases, by its number.
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
        self.resumed: dict[int, int] = {}
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
        note_later_calls(found, self.calls)
        return found

    def _take_call(self, phase: TimerPhase, call: MethodCall) -> None:
        request = call.request
        if request.method in _STARTS:
            timer = _timer(self.runtime, phase, call, len(self.timers) + 1)
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
        made = [t for t in self.timers if t.call.reply is None or not t.call.reply.failed]
        before = [t for t in made if t.handler == callback.enter.port and t.call.request.n < callback.n]
        here = [t for t in before if t.phase is phase]
        earlier = [t for t in before if t.phase is not phase and t.is_started and self._may_go_on(t, phase)]
        if here and not self.runtime.ics.permits(option_of(self.runtime, "object", "timers-at-stop"), "resumed"):
            earlier = []
        if not here and not earlier:
            return
        callback.may_be_earlier = bool(earlier)
        timer = self._whose(callback, [*earlier, *here])
        if timer is None:
            callback.is_open = callback.stranger is None
            return
        callback.timer = timer
        if timer in earlier:
            self.resumed[timer.number] = self.resumed.get(timer.number, 0) + 1
            phase.resumed.append(callback)
            return
        timer.callbacks.append(callback)
        self._own(timer, callback.enter.timer)

    def _may_go_on(self, timer: Timer, phase: TimerPhase) -> bool:
        """May a timer of an earlier phase, which waited when that ended, trigger in this one?"""
        done = len(timer.callbacks) + self.resumed.get(timer.number, 0)
        return timer.waits(phase.of.startup.n) and (timer.most is None or done < timer.most)

    def _whose(self, callback: TimerCallback, timers: list[Timer]) -> Timer | None:
        """The timer of the handler that triggers it: the only one that may, or that with the identifier that was told; those that may be it
        are contested from now on.
        """
        if callback.id is not None:
            others = [t for t in self.timers if t.handler != callback.enter.port and t.phase is timers[-1].phase]
            # without "ever", a repeated one may have ended with rounds that were left out, and its identifier be given again
            is_ever = self.runtime.ics.reading("timer-ids") == "ever"
            others = [t for t in others if t.id == callback.id and t.waits(callback.n) and (is_ever or t.rate is None)]
            others = [t for t in others if t.has_usual_times and not t.is_contested and _share_scheduler([t, *timers])]
            if others and all(t.id not in (None, callback.id) for t in timers):
                callback.stranger = others[0]
                return None
        possible = timers if len(timers) == 1 else self._possible(callback, timers)
        if len(possible) == 1:
            return possible[0]
        for timer in possible:
            timer.is_contested = True
        return None

    def _possible(self, callback: TimerCallback, timers: list[Timer]) -> list[Timer]:
        """Those of several timers that may trigger it: they wait, and have the identifier that was told, or none that is known. An identifier
        may be given again unless that is declared not to happen.
        """
        waiting = [t for t in timers if self._may_come(t, callback)]
        if callback.id is None:
            return waiting or timers
        same = [t for t in timers if t.id == callback.id]
        unknown = [t for t in waiting if t.id is None]
        here = [t for t in same if t.phase is timers[-1].phase]
        if here and self.runtime.ics.reading("timer-ids") == "ever" and _share_scheduler(timers):
            return here
        return [*(t for t in same if t in waiting), *unknown] or same or [t for t in timers if t.id is None] or timers

    def _may_come(self, timer: Timer, callback: TimerCallback) -> bool:
        """May it still trigger? It waits, or was cancelled when it was on its way."""
        if timer.waits(callback.n):
            return True
        cancel = timer.cancelled
        if cancel is None or timer.has_come(callback.n):
            return False
        due = earliest(self.runtime, timer, len(timer.callbacks))
        return due is None or cancel.reply is None or due <= cancel.reply.t


def _share_scheduler(timers: list[Timer]) -> bool:
    """Were they made by one scheduler? Others may give the same identifiers."""
    return len({timer.call.request.port for timer in timers}) == 1


def _timer(runtime: ObservedRuntime, phase: TimerPhase, call: MethodCall, number: int) -> Timer | None:
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
        goes_on_after_exceptions(runtime, "object"),
        call.request.handler or "",
        rounds if isinstance(rounds, int) else None,
    )


def told_by(call: MethodCall, method: str) -> Datum | None:
    """What ``method`` of an object timer gave; None if this is no such call, or it gave nothing."""
    reply = call.reply
    if call.request.method != method or call.request.timer is None or reply is None or reply.failed:
        return None
    return reply.results[0] if reply.results and len(reply.results) == 1 else None
