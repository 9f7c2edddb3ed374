"""Can this trace be true? What no host that tells the truth can answer is the adapter's fault, never a verdict."""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Action, Scenario
from ucm_cts.adapters.contract.trace import (
    BodyEvent,
    Call,
    Create,
    Enter,
    Event,
    Exit,
    Held,
    Opened,
    Raise,
    Reference,
    Reply,
    Request,
    Return,
    Siblings,
    Skip,
    Timeout,
)
from ucm_cts.harness.scripts import bound_by, used_by

_SILENT = (s.OpenGate, s.ReachGate, s.Join)
_ID_GIVING = (s.AddComponent, s.Connect, s.Invoke)


def contradiction(scenario: Scenario, trace: Sequence[Event], stuck: bool = False) -> str | None:
    """Why ``trace`` cannot be what happened when ``scenario`` ran; None if it can.

    ``stuck`` traces may leave steps open. Checks order, nesting, completeness, and that bodies kept to their plans.
    """
    return _Check(scenario).run(trace, stuck)


class _Check:
    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.done: dict[int, bool] = {}
        self.open: dict[int, list[Event]] = {}
        self.bodies: dict[str, int] = {}
        self.last_inline = -1
        self.clock: dict[int, int] = {}
        self.bound = {s.MANAGER, s.UNKNOWN, s.NIL}
        self.null = {s.NIL}
        self.holds: dict[tuple[str, int], dict[str, int]] = {}
        self.acts: dict[int, list[list[Action]]] = {}

    def run(self, trace: Sequence[Event], stuck: bool) -> str | None:
        for index, event in enumerate(trace):
            if event.n != index + 1:
                return f"event number {event.n} where {index + 1} is due"
            if event.t < self.clock.get(event.thread, event.t):
                return f"event {event.n} is earlier than the one before it on thread {event.thread}"
            self.clock[event.thread] = event.t
            problem = self.check(event)
            if problem:
                return f"event {event.n}: {problem}"
        if stuck:
            return None
        for number, step in enumerate(self.scenario.steps):
            if not isinstance(step, _SILENT) and not self.done.get(number):
                return f"step {number} ({s.operation(step)}) is missing or not ended"
        return None

    def check(self, event: Event) -> str | None:
        if isinstance(event, Call | Skip | Timeout | Return | Raise):
            return self.check_step(event)
        if isinstance(event, Opened):
            return None
        return self.check_body(event)

    def check_step(self, event: Call | Skip | Timeout | Return | Raise) -> str | None:
        if not 0 <= event.step < len(self.scenario.steps):
            return f"there is no step {event.step}"
        step = self.scenario.steps[event.step]
        if isinstance(event, Timeout):
            return None if isinstance(step, _SILENT) else f"step {event.step} is not a wait"
        if isinstance(step, _SILENT):
            return f"step {event.step} is no operation"
        frames = self.open.setdefault(event.thread, [])
        if isinstance(event, Call | Skip):
            if event.step in self.done:
                return f"step {event.step} is carried out twice"
            missing = [
                v for v in used_by(step) if v not in self.bound or (isinstance(step, s.Invoke) and v in self.null)
            ]
            if isinstance(event, Skip) and event.variable not in missing:
                return f"step {event.step} is skipped although {event.variable} is bound"
            if isinstance(event, Call) and missing:
                return f"step {event.step} is carried out although {missing[0]} is not bound"
            if step.thread is None:
                if event.step < self.last_inline:
                    return f"step {event.step} comes after step {self.last_inline}"
                self.last_inline = event.step
            self.done[event.step] = isinstance(event, Skip)
            if isinstance(event, Call):
                frames.append(event)
            return None
        if not frames or not isinstance(frames[-1], Call) or frames[-1].step != event.step:
            return f"step {event.step} ends without being open on thread {event.thread}"
        frames.pop()
        self.done[event.step] = True
        if isinstance(event, Raise):
            return None
        self.bound.update(bound_by(step))
        if isinstance(step, s.GetPortElement):
            (self.null.add if event.value is None else self.null.discard)(step.bind)
        return self.check_value(step, event)

    def check_value(self, step: s.Step, event: Return) -> str | None:
        value = event.value
        if isinstance(step, _ID_GIVING):
            fits = isinstance(value, int)
        elif isinstance(step, s.GetComponents):
            fits = isinstance(value, tuple)
        elif isinstance(step, s.GetPortElement):
            fits = value is None or value == "opaque" or isinstance(value, Reference)
        else:
            fits = value is None
        if not fits:
            return f"{s.operation(step)} cannot return {value!r}"
        if isinstance(value, Reference) and value.instance > self.bodies.get(value.component, 0):
            return f"a reference to {value.component}#{value.instance}, which was never made"
        return None

    def check_body(self, event: BodyEvent | Event) -> str | None:
        assert isinstance(event, BodyEvent)
        declaration = self.scenario.components.get(event.component)
        if declaration is None:
            return f"there is no component {event.component}"
        made = self.bodies.get(event.component, 0)
        if isinstance(event, Create):
            self.bodies[event.component] = event.instance
            return None if event.instance == made + 1 else f"instance {event.instance} is made after {made}"
        if not 1 <= event.instance <= made:
            return f"instance {event.instance} of {event.component} was never made"
        frames = self.open.setdefault(event.thread, [])
        acts = self.acts.setdefault(event.thread, [])
        if isinstance(event, Enter):
            frames.append(event)
            acts.append([])
            return self.check_enter(declaration, event)
        if isinstance(event, Request):
            if acts:
                acts[-1].append(s.CallPort(event.port, event.value))
            frames.append(event)
            return None if event.port in declaration.requires else f"a request through {event.port!r}"
        top = frames[-1] if frames else None
        same = isinstance(top, BodyEvent) and (top.component, top.instance) == (event.component, event.instance)
        if isinstance(event, Reply):
            if not (same and isinstance(top, Request) and top.port == event.port):
                return "a reply without its request"
            frames.pop()
            return None
        if not (same and isinstance(top, Enter)):
            return f"{event.component} acts without having been entered"
        if isinstance(event, Exit):
            frames.pop()
            return self.check_exit(declaration, top, event, acts.pop())
        if isinstance(event, Siblings):
            acts[-1].append(s.QuerySiblings())
        if isinstance(event, Held):
            acts[-1].append(s.HoldAtGate(event.gate))
            gates = {a.gate for a in declaration.plan.get(top.hook, ()) if isinstance(a, s.HoldAtGate)}
            return None if event.gate in gates else f"held at {event.gate!r}, which the plan does not name"
        return None

    def check_enter(self, declaration: s.Declaration, event: Enter) -> str | None:
        if event.hook == "exchange" and (event.value is None or event.port not in declaration.provides):
            return f"exchange on {event.port!r} with {event.value!r}"
        if event.hook in ("on_connect", "on_disconnect") and not declaration.connectable:
            return f"{event.hook} on a body that is not Connectable"
        if event.hook == "set_container_interface" and not declaration.fragment:
            return "set_container_interface on a body that is no fragment"
        if (event.hook == "on_startup") != (event.dependencies is not None):
            return f"{event.hook} {'with' if event.dependencies is not None else 'without'} dependencies"
        if event.dependencies is not None:
            held = self.holds[event.component, event.instance] = {}
            for dependency in event.dependencies:
                given = sum(reference is not None for reference in dependency.references)
                held[dependency.port] = held.get(dependency.port, 0) + given
        return None

    def check_exit(self, declaration: s.Declaration, enter: Enter, event: Exit, acts: list[Action]) -> str | None:
        if enter.hook != event.hook:
            return f"{event.hook} is left where {enter.hook} was entered"
        plan = declaration.plan.get(enter.hook, ())
        if event.raised != any(isinstance(a, s.RaiseError) for a in plan):
            return f"{event.hook} {'raised' if event.raised else 'did not raise'} against its plan"
        if acts != self.due(plan, event):
            return f"{event.component} did not act in {event.hook} as its plan says"
        if event.hook == "on_shutdown":
            self.holds.pop((event.component, event.instance), None)
        if event.hook != "exchange" or event.raised or enter.value is None:
            return None
        planned = [a.value for a in plan if isinstance(a, s.ReturnValue)]
        due = planned[-1] if planned else ~enter.value
        return None if event.value == due else f"exchange returned {event.value}, its plan says {due}"

    def due(self, plan: Sequence[Action], event: Exit) -> list[Action]:
        """What the plan has the body do, given the references it holds."""
        held = self.holds.get((event.component, event.instance), {})
        due: list[Action] = []
        for action in plan:
            if isinstance(action, s.RaiseError):
                break
            if isinstance(action, s.CallPort):
                due.extend([action] * held.get(action.port, 0))
            elif not isinstance(action, s.ReturnValue):
                due.append(action)
        return due
