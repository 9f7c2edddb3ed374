"""Checks that a trace can be true. A trace that no correct host can record is the adapter's fault and never gives a verdict."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Sequence
from typing import Any

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.traits import bound_by, duration, used_by
from ucm_cts.harness.execution.body_behaviour import BodyChecks, Frame, Thread
from ucm_cts.harness.execution.step_order import StepOrder

_PUNCTUALITY, _GRAIN = 0.9, 5_000_000
"""A wait for patience that ends after this part of it, less so many nanoseconds, is believed: clocks differ."""

_LONGEST_PATIENCE = 24 * 60 * 60 * 1000
_NANOSECONDS = 1_000_000


def contradiction(scenario: Scenario, trace: Iterable[t.Event], stuck: Collection[str] = ()) -> str | None:
    """Why ``trace`` cannot be what happened when ``scenario`` ran; None if it can.

    The ``stuck`` workers may leave steps open; the trace is read once, event by event. Checks order, nesting, threads, gates,
    completeness, and that bodies kept to their plans.
    """
    check = _Check(scenario)
    for event in trace:
        problem = check.take(event)
        if problem:
            return problem
    return check.end(stuck)


def believable(scenario: Scenario, events: Sequence[t.Event]) -> tuple[t.Event, ...]:
    """The first of ``events``, up to the first contradiction."""
    check = _Check(scenario)
    for index, event in enumerate(events):
        if check.take(event):
            return tuple(events[:index])
    return tuple(events)


class _Check(BodyChecks):
    """Follows the steps of a scenario, and the bodies that they reach."""

    def __init__(self, scenario: Scenario) -> None:
        super().__init__(scenario)
        self.taken = 0
        self.length = len(scenario.steps)
        self.done: dict[int, bool] = {}
        self.threads: dict[int, Thread] = {}
        self.bound = {s.MANAGER, s.UNKNOWN, s.NIL}
        self.null = {s.NIL}
        self.order = StepOrder(scenario)
        self.waiting: dict[int, t.Held] = {}
        self.arrivals: Counter[str] = Counter()
        self.opened: set[str] = set()
        patience = min(max(scenario.patience, 0), _LONGEST_PATIENCE) * _NANOSECONDS
        self.shortest_wait = patience * _PUNCTUALITY - _GRAIN

    def take(self, event: t.Event) -> str | None:
        """The contradiction that the next event makes; None if it makes none."""
        self.taken += 1
        if event.n != self.taken:
            return f"event number {event.n} where {self.taken} is due"
        thread = self.threads.get(event.thread)
        if thread is None:
            thread = self.threads[event.thread] = Thread(event.thread)
        elif thread.clock is not None and event.t < thread.clock:
            return f"event {event.n} is earlier than the one before it on thread {event.thread}"
        problem = self.check_gate(event) if self.waiting else None
        if problem is None:
            problem = _CHECKS[type(event)](self, event, thread)
        thread.clock = event.t
        return f"event {event.n}: {problem}" if problem else None

    def end(self, stuck: Collection[str]) -> str | None:
        """The contradiction if the trace ends here, and these workers are stuck; None if there is none."""
        unknown = set(stuck) - {step.thread for step in self.scenario.steps}
        if unknown:
            return f"'{min(unknown)}' is stuck, and there is no such worker"
        for number, step in enumerate(self.scenario.steps):
            if self.done.get(number) or step.thread in stuck:
                continue
            ended = isinstance(step, s.Join) or (self.done.get(number) if step.ends_with else not self.why_open(number))
            if not ended:
                return f"step {number} ({s.operation(step)}) is missing or not ended"
        return None

    def check_gate(self, event: t.Event) -> str | None:
        """A body that is held lets its thread go on when the gate is open, patience has run out or all steps have ended."""
        held = self.waiting.pop(event.thread, None)
        if held is None or held.gate in self.opened or event.t - held.t >= self.shortest_wait:
            return None
        if all(self.done.get(number) for number in self.order.steps[None] if not self.is_silent(number)):
            return None
        return f"{held.component} goes on although gate {held.gate!r} is closed"

    def is_silent(self, number: int) -> bool:
        """No event shows that the step has succeeded."""
        return not self.scenario.steps[number].ends_with

    def check_order(self, number: int, thread: Thread) -> str | None:
        """A thread takes its steps one by one, in order; steps that it passes without an event must have ended."""
        if thread.frames:
            return f"step {number} begins while another one is open on thread {thread.number}"
        problem = self.order.begin(number, thread.number)
        if problem or not self.order.passed:
            return problem
        for passed in self.order.passed:
            why = self.why_open(passed)
            if why is not None:
                operation = s.operation(self.scenario.steps[passed])
                return f"step {number} comes after step {passed} ({operation}), {why}"
        return None

    def why_open(self, number: int) -> str | None:
        """Why the step cannot have ended, by an event or because what it waits for has happened; None if it can."""
        step = self.scenario.steps[number]
        if number in self.done:
            return None
        if isinstance(step, s.ReachGate):
            is_reached = self.arrivals[step.gate] >= max(step.more, step.total, 1)
            return None if is_reached else f"which has not seen a body at gate {step.gate!r}"
        if isinstance(step, s.Join):
            return None if self.has_done_all(step.worker, number) else f"and '{step.worker}' is not done"
        return "which is missing"

    def has_done_all(self, worker: str, number: int) -> bool:
        """Has ``worker`` done all its steps before step ``number``?"""
        steps = self.order.steps.get(worker, ())
        return all(self.done.get(n) for n in steps if n < number and not self.is_silent(n))

    def check_call(self, event: t.Call, thread: Thread) -> str | None:
        number = event.step
        if not 0 <= number < self.length:
            return f"there is no step {number}"
        step = self.scenario.steps[number]
        if step.ends_with != "return":
            return f"step {number} is no operation"
        if number in self.done:
            return f"step {number} is carried out twice"
        missing = self.missing(step)
        if missing:
            return f"step {number} is carried out although {missing[0]} is not bound"
        problem = self.check_order(number, thread)
        self.done[number] = False
        thread.frames.append(Frame(event))
        return problem

    def check_skip(self, event: t.Skip, thread: Thread) -> str | None:
        step = self.step(event)
        if isinstance(step, str):
            return step
        if step.ends_with != "return" and not used_by(step):
            return f"step {event.step} is no operation"
        frames = thread.frames
        if step.optional and event.variable == s.operation(step) and frames:
            top = frames.pop().event
            self.done[event.step] = True
            is_own = isinstance(top, t.Call) and top.step == event.step
            return None if is_own else f"step {event.step} is skipped and was not begun"
        if event.step in self.done:
            return f"step {event.step} is carried out twice"
        if event.variable not in self.missing(step):
            return f"step {event.step} is skipped although {event.variable} is bound"
        problem = self.check_order(event.step, thread)
        self.done[event.step] = True
        return problem

    def missing(self, step: s.Step) -> list[str]:
        """The variables that ``step`` reads and that are not bound, or that hold no reference to call."""
        if type(step) is s.Invoke:
            return [] if step.ref in self.bound and step.ref not in self.null else [step.ref]
        return [variable for variable in used_by(step) if variable not in self.bound]

    def check_timeout(self, event: t.Timeout, thread: Thread) -> str | None:
        step = self.step(event)
        if isinstance(step, str):
            return step
        if step.ends_with or event.step in self.done:
            return f"step {event.step} is not a wait"
        if thread.clock is not None and event.t - thread.clock < self.shortest_wait:
            return f"step {event.step} runs out of patience too early"
        problem = self.check_order(event.step, thread)
        self.done[event.step] = True
        return problem

    def check_done(self, event: t.Counted | t.Paused | t.Stressed, thread: Thread) -> str | None:
        step = self.step(event)
        if isinstance(step, str):
            return step
        if step.ends_with != t.kind_of(event) or event.step in self.done:
            return f"step {event.step} is not the step that this event ends"
        shortest = duration(step)[0] * _NANOSECONDS * _PUNCTUALITY - _GRAIN
        if thread.clock is not None and event.t - thread.clock < shortest:
            return f"step {event.step} ends too early"
        if isinstance(event, t.Counted) and not 0 <= event.distinct <= event.received:
            return f"step {event.step} has counted {event.distinct} of {event.received}"
        problem = self.check_order(event.step, thread)
        self.done[event.step] = True
        return problem

    def check_opened(self, event: t.Opened, thread: Thread) -> str | None:
        number = self.order.next_open(event.gate, event.thread)
        if number is None:
            return f"gate {event.gate!r} is opened, and no step opens it here"
        problem = self.check_order(number, thread)
        self.done[number] = True
        self.opened.add(event.gate)
        return problem

    def check_settled(self, event: t.Settled, thread: Thread) -> str | None:
        number = self.order.next_settle(event.worker, event.thread)
        if number is None:
            return f"no step settles '{event.worker}' here"
        problem = self.check_order(number, thread)
        self.done[number] = True
        if event.where == "done" and not self.has_done_all(event.worker, number):
            return f"'{event.worker}' is recorded as done and is not"
        return problem

    def check_end(self, event: t.Return | t.Raise, thread: Thread) -> str | None:
        number = event.step
        if not 0 <= number < self.length:
            return f"there is no step {number}"
        step = self.scenario.steps[number]
        if step.ends_with != "return":
            return f"step {number} is no operation"
        frames = thread.frames
        top = frames[-1].event if frames else None
        if type(top) is not t.Call or top.step != number:
            return f"step {number} ends without being open on thread {event.thread}"
        frames.pop()
        self.done[number] = True
        if type(event) is t.Raise:
            return None
        assert isinstance(event, t.Return)
        too_early = event.t - top.t < self.shortest_wait
        if type(step) is s.ReadLog and len(event.records or ()) < step.records and too_early:
            return f"step {number} gives up waiting for {step.records} records too early"
        if type(step) is s.Invoke:
            right = type(event.value) is int or (event.wrong and event.value is None)
            return None if right and event.records is None else self.check_value(step, event)
        self.bound.update(bound_by(step))
        if type(step) is s.GetPortElement:
            (self.null.add if event.value is None else self.null.discard)(step.bind)
        return self.check_value(step, event)

    def step(self, event: t.StepEvent) -> s.Step | str:
        """The step of the event, or why there is none."""
        if not 0 <= event.step < self.length:
            return f"there is no step {event.step}"
        return self.scenario.steps[event.step]

    def check_value(self, step: s.Step, event: t.Return) -> str | None:
        value = event.value
        if event.records is None and _IS_OF[step.returns] is type(value):
            return None  # most are integers, or nothing
        if (step.returns == "records") != (event.records is not None):
            return f"{s.operation(step)} returned {'no ' if event.records is None else ''}records"
        if max(len(value) if isinstance(value, tuple) else 0, len(event.records or ())) > t.MOST:
            return f"{s.operation(step)} returned more than {t.MOST} ids or records"
        if not _fits(value, step.returns):
            return f"{s.operation(step)} cannot return {value!r}"
        if isinstance(value, t.Reference) and value.instance > len(self.made.get(value.component, ())):
            return f"a reference to {value.component}#{value.instance}, which was never made"
        return None

    def check_held(self, event: t.Held, thread: Thread) -> str | None:
        self.arrivals[event.gate] += 1
        self.waiting[event.thread] = event
        return self.check_act(event, thread)


def _fits(value: object, returns: s.Returns | None) -> bool:
    """Is ``value`` of the kind that the call ``returns``?"""
    match returns:
        case "id" | "value":
            return isinstance(value, int)
        case "ids":
            return isinstance(value, tuple)
        case "reference":
            return value is None or value == "opaque" or isinstance(value, t.Reference)
        case _:
            return value is None


_IS_OF: dict[s.Returns | None, type | None] = {
    "id": int,
    "value": int,
    "ids": None,
    "reference": None,
    "records": None,
    None: type(None),
}
"""The type that what a call returns has, for those kinds of which nothing else is to be checked."""

_CHECKS: dict[type, Callable[[_Check, Any, Thread], str | None]] = {
    t.Call: _Check.check_call,
    t.Skip: _Check.check_skip,
    t.Return: _Check.check_end,
    t.Raise: _Check.check_end,
    t.Timeout: _Check.check_timeout,
    t.Opened: _Check.check_opened,
    t.Settled: _Check.check_settled,
    t.Counted: _Check.check_done,
    t.Paused: _Check.check_done,
    t.Stressed: _Check.check_done,
    t.Create: _Check.check_create,
    t.Enter: _Check.check_enter,
    t.Exit: _Check.check_exit,
    t.Request: _Check.check_request,
    t.Reply: _Check.check_reply,
    t.Siblings: _Check.check_act,
    t.Held: _Check.check_held,
    t.Pushed: _Check.check_act,
}
"""The check of each kind of event."""
