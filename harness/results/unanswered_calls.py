"""Business calls that never came back: which call a framework has lost, and which requirement that breaks.

A call counts if all bodies were operational when it was made, the body called was not removed before and nothing was broken, if it is the framework's turn (no body is still inside on
account of it), and if nothing that may end it was called before patience had run out once.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.purposes.connections import required_ends
from ucm_cts.harness.results.values import Execution, Incident
from ucm_cts.reference_models.findings import Arrow, Finding
from ucm_cts.reference_models.model.execution_policies import call_guarantees
from ucm_cts.reference_models.model.runtime import lane

_BETWEEN_COMPONENTS = ("R-11.2.3-03", "interactions")
_BY_CONNECTOR = {
    s.SERVICE_CONNECTOR: ("R-10.1.5.1-01", "service_call_ends"),
    s.MESSAGE_CONNECTOR: ("R-10.1.6.1-10", "messages_arrived"),
}
"""The requirement that a call breaks which does not come back, and its property."""


@dataclass
class _OpenCall:
    """A business call that has not come back; ``lost``: nothing but the framework can be the reason.

    ``call`` says what is called.
    """

    event: t.Call | t.Request
    call: s.Invoke | t.Request
    possible: bool
    ended: bool = False
    overdue: bool = False

    @property
    def lost(self) -> bool:
        return self.possible and (self.overdue or not self.ended)


@dataclass
class _Targets:
    """Which bodies references and connections lead to: by the steps that gave them out, as a framework's proxies do not show it.

    ``bodies``: the body by the variable of its id.
    ``references``: the body by the variable of the reference.
    ``connections``: client, port and the body connected, by the variable of the connection; none once it is undone.
    ``removed``: bodies that were removed. What becomes of a call of theirs is open.
    """

    bodies: dict[str, tuple[str, int]] = field(default_factory=dict)
    references: dict[str, tuple[str, int]] = field(default_factory=dict)
    connections: dict[str, tuple[tuple[str, int], str, tuple[str, int] | None]] = field(default_factory=dict)
    removed: set[tuple[str, int]] = field(default_factory=set)

    def note(self, step: s.Step) -> None:
        """``step`` has returned."""
        if isinstance(step, s.GetPortElement):
            self.references.pop(step.bind, None)
            if step.id in self.bodies:
                self.references[step.bind] = self.bodies[step.id]
        elif isinstance(step, s.Connect) and step.id in self.bodies and step.to in self.references:
            self.connections[step.bind] = self.bodies[step.id], step.port, self.references[step.to]
        elif isinstance(step, s.Disconnect) and step.connection in self.connections:
            self.connections[step.connection] = (*self.connections[step.connection][:2], None)

    def may_lead_to(self, call: s.Invoke | t.Request, body: tuple[str, int]) -> bool:
        """Does ``call`` come to ``body``, as far as is known?"""
        if isinstance(call, s.Invoke):
            return self.references.get(call.ref, body) == body
        goals = {to for client, port, to in self.connections.values() if (client, port) == (call.body, call.port)}
        return not goals or body in goals

    def are_there(self, call: s.Invoke | t.Request) -> bool:
        """Does ``call`` lead to nothing that is removed, and not through a port that was connected and no longer is?"""
        if isinstance(call, s.Invoke):
            return self.references.get(call.ref) not in self.removed
        ever = {to for client, port, to in self.connections.values() if (client, port) == (call.body, call.port)}
        return self.removed.isdisjoint(ever) and ever != {None}


@dataclass
class _Reading:
    """A trace as far as it has been read: what each thread is doing, which bodies are operational, and which links are ``broken``: a call
    of a body may wait until they are mended.
    """

    scenario: Scenario
    threads: dict[int, list[t.Event]] = field(default_factory=dict)
    calls: dict[int, _OpenCall] = field(default_factory=dict)
    ready: dict[tuple[str, int], bool] = field(default_factory=dict)
    targets: _Targets = field(default_factory=_Targets)
    broken: set[str] = field(default_factory=set)

    def take(self, event: t.Event) -> None:
        """Read the next event."""
        stack = self.threads.setdefault(event.thread, [])
        match event:
            case t.Call():
                stack.append(event)
                self._begin(event)
            case t.Request():
                stack.append(event)
                self._add_call(event, event)
            case t.Enter():
                stack.append(event)
                self._note_phase(event)
            case t.Return() | t.Raise() | t.Reply() | t.Exit():
                if stack:
                    self.calls.pop(stack.pop().n, None)
                if isinstance(event, t.Exit) and event.hook == "on_startup":
                    self.ready[event.body] = not event.raised
                if isinstance(event, t.Return):
                    step = self.scenario.steps[event.step]
                    self.targets.note(step)
                    if isinstance(step, s.Mend):
                        self.broken.discard(step.link)
            case t.Skip() if stack and isinstance(stack[-1], t.Call) and stack[-1].step == event.step:
                self.calls.pop(stack.pop().n, None)
            case t.Create():
                self.ready[event.body] = False
                self._note_body(event, stack)
            case t.Timeout():
                self._run_out_of_patience()
            case _:
                pass

    def _begin(self, event: t.Call) -> None:
        step = self.scenario.steps[event.step]
        if isinstance(step, s.Invoke):
            self._add_call(event, step)
        elif step.undoes:
            for call in self.calls.values():
                call.ended = True
        if isinstance(step, s.Break):
            self.broken.add(step.link)

    def _add_call(self, event: t.Call | t.Request, call: s.Invoke | t.Request) -> None:
        self.calls[event.n] = _OpenCall(event, call, self._is_possible(call))

    def _is_possible(self, call: s.Invoke | t.Request) -> bool:
        """Is there nothing now that it may wait for?"""
        may_wait = bool(self.broken) and isinstance(call, t.Request)
        return self._all_ready() and self.targets.are_there(call) and not may_wait

    def _note_phase(self, event: t.Enter) -> None:
        if event.hook == "on_shutdown":
            self.ready[event.body] = False
        elif event.hook == "on_remove":
            self.ready.pop(event.body, None)
            self.targets.removed.add(event.body)

    def _note_body(self, event: t.Create, stack: list[t.Event]) -> None:
        step = self.scenario.steps[stack[-1].step] if stack and isinstance(stack[-1], t.Call) else None
        if isinstance(step, s.AddComponent):
            self.targets.bodies[step.bind or step.component] = event.body

    def _run_out_of_patience(self) -> None:
        if not self.has_bodies_inside():
            for call in self.calls.values():
                call.overdue = call.overdue or not call.ended

    def _all_ready(self) -> bool:
        return all(self.ready.values())

    def is_left_open(self, call: _OpenCall) -> bool:
        """Was the call impossible when it was made, and is it still?"""
        return not call.possible and not self._is_possible(call.call)

    def held_up(self, waiting: Sequence[_OpenCall]) -> list[_OpenCall]:
        """The calls that may wait until a broken link is mended, and those that wait for the bodies that made them."""
        found = [c for c in waiting if self.broken and isinstance(c.call, t.Request) and self.is_left_open(c)]
        for call in found:  # grows meanwhile
            body = call.event.body if isinstance(call.event, t.Request) else None
            found += [
                c for c in waiting if c not in found and body is not None and self.targets.may_lead_to(c.call, body)
            ]
        return found

    def tops(self) -> Iterator[t.Event]:
        """What each thread is doing last."""
        return (stack[-1] for stack in self.threads.values() if stack)

    def has_bodies_inside(self) -> bool:
        """Is a thread inside a body that waits for no call of its own?"""
        return any(isinstance(event, t.Enter) for event in self.tops())


def is_left_open(execution: Execution) -> bool:
    """Is all that is under way at the end of the trace calls that the text leaves open: of what is removed, or not all operational yet, or
    through what is broken?
    """
    reading = _Reading(execution.scenario)
    for event in execution.trace:
        reading.take(event)
    under_way = [reading.calls.get(event.n) for event in reading.tops()]
    return bool(under_way) and all(call is not None and reading.is_left_open(call) for call in under_way)


def lost_call(execution: Execution) -> t.Call | t.Request | None:
    """The call, of the test or of a body, that the framework has lost; None if it has certainly lost none."""
    incident = execution.incident
    reading = _Reading(execution.scenario)
    for event in execution.trace:
        reading.take(event)
    if incident is None or reading.has_bodies_inside():
        return None
    waiting = [reading.calls[event.n] for event in reading.tops() if event.n in reading.calls]
    hangs = incident.kind == "hang"
    held = reading.held_up(waiting)
    lost = [c.event for c in waiting if c not in held and (c.lost or (c.possible and not hangs))]
    return max(lost, key=lambda event: event.n, default=None)


def finding_of_lost_call(execution: Execution) -> Finding | None:
    """A business call that did not come back, although every component was operational: 10.1.3.2, 10.1.5, 10.1.6 or 11.2.3."""
    call, incident = lost_call(execution), execution.incident
    if call is None or incident is None:
        return None
    scenario = execution.scenario
    caller, port, callee = _ends(scenario, call)
    requirement, rule = _requirement(scenario, call, port, callee)
    name = call.method or "exchange" if isinstance(call, t.Request) else "exchange"
    goal = f" to {callee[0]}" if callee is not None else ""
    return Finding(
        requirement,
        rule,
        f"call lost in a {incident.kind}",
        f"the call of {name} that {caller} makes through {port}{goal} comes back: every component is operational",
        f"it did not come back: {_what_happened(incident)}",
        (call.n,),
        call.step if isinstance(call, t.Call) else None,
        (Arrow(callee[0] if callee is not None else "manager", caller, "result"),),
    )


def _what_happened(incident: Incident) -> str:
    return "no answer within the time limit" if incident.kind == "hang" else f"{incident.kind}, {incident.detail}"


def _requirement(
    scenario: Scenario, call: t.Call | t.Request, port: str, callee: tuple[str, str] | None
) -> tuple[str, str]:
    """The requirement of the connector or execution policy that the call goes through, with its property."""
    if isinstance(call, t.Request):
        for variable, port_element, connector in required_ends(scenario):
            if (_component(scenario, variable), port_element) == (call.component, port):
                return _BY_CONNECTOR[connector]
    declaration = scenario.components.get(callee[0]) if callee is not None else None
    promised = call_guarantees(declaration, callee[1]) if declaration is not None and callee is not None else ()
    return (promised[0], "calls_carried_out") if promised else _BETWEEN_COMPONENTS


def _ends(scenario: Scenario, call: t.Call | t.Request) -> tuple[str, str, tuple[str, str] | None]:
    """Who calls, through which port element or reference, and the component and port element called, if that is known."""
    if isinstance(call, t.Request):
        connected = (step for step in scenario.steps if isinstance(step, s.Connect) and step.port == call.port)
        to = next((step.to for step in connected if _component(scenario, step.id) == call.component), "")
        return lane(call.component, call.instance), call.port, _referred(scenario, to)
    step = scenario.steps[call.step]
    assert isinstance(step, s.Invoke)
    return "the test", f"reference {step.ref}", _referred(scenario, step.ref)


def _referred(scenario: Scenario, reference: str) -> tuple[str, str] | None:
    """The component and the port element that the variable ``reference`` stands for."""
    for step in scenario.steps:
        if isinstance(step, s.GetPortElement) and step.bind == reference:
            component = _component(scenario, step.id)
            return (component, step.port) if component else None
    return None


def _component(scenario: Scenario, variable: str) -> str:
    """The component of the instance that ``variable`` stands for; empty if it was never added."""
    added = (step for step in scenario.steps if isinstance(step, s.AddComponent))
    return next((step.component for step in added if (step.bind or step.component) == variable), "")
