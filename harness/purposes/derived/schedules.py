"""Gate schedules: scenarios that provoke overlap in a component with an execution policy, all orders of few callers (10.1.3.2).

The first caller is held inside at a gate. Each of the others calls, and the scenario waits until it is inside or waits itself;
then the gate opens and all must return.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Policy, Scenario, Step
from ucm_cts.harness.purposes.connections import INTERFACES, MESSAGE, SERVICE, Connector, provided_end, required_end
from ucm_cts.harness.purposes.container_services import HAS_CLOCK
from ucm_cts.harness.purposes.provocations.boundaries import load_boundaries
from ucm_cts.harness.purposes.scripts import TestPurpose

_PORTS = ("in.api", "aux.api")
_SERVICE_PORT = "service.api"
_MESSAGE_PORT = "message.api"
_CLAUSE = "10.1.3.2"
_MOMENT = 20
"""Milliseconds in which an execution that is not kept out shows itself."""

_INTERFACES = {"service": INTERFACES[SERVICE], "message": INTERFACES[MESSAGE]}
_INTERFACE_OF = {_SERVICE_PORT: "service", _MESSAGE_PORT: "message"}
_CONNECTOR_OF: dict[str, Connector] = {_SERVICE_PORT: SERVICE, _MESSAGE_PORT: MESSAGE}


_RAISED, _RESTARTED = "after a call that raised", "after a restart"
_SECOND, _BELOW, _SUCCESSOR = "as a second instance", "in a sub-container", "as a successor"
_TRACED, _WITH_CLOCK = "with traces of its ports", "with a clock"
_LATE, _LONG = "after a long wait", 3_500
"""A situation that lasts for so many milliseconds: nobody who waits for a protected component is let in before."""

_SITUATIONS = (_RAISED, _RESTARTED, _SECOND, _BELOW, _SUCCESSOR, _TRACED, _WITH_CLOCK)
_FURTHER_POLICIES = {
    _TRACED: tuple(
        Policy(s.PORT_TRACE, port, {s.METHODS_TO_TRACE: "exchange", s.LOG_SEVERITY: "info"}) for port in _PORTS
    ),
    _WITH_CLOCK: (HAS_CLOCK,),
}
"""By situation: what the server has beside its execution policy."""


@dataclass(frozen=True)
class _Way:
    """A way into the server: its port element, called by the test or by a component, perhaps of another container; that of
    the service through a service connector, that of messages through a message connector.
    """

    port: str
    client: str = ""

    @property
    def name(self) -> str:
        return f"{self.port.partition('.')[0]}{f' by {self.client}' if self.client else ''}"


_CLIENTS = ("component", "component elsewhere")
_WAYS = tuple(_Way(port, client) for client in ("", *_CLIENTS) for port in _PORTS)
_SERVICE_WAYS = tuple(_Way(_SERVICE_PORT, client) for client in _CLIENTS)
_MESSAGE_WAY = _Way(_MESSAGE_PORT, "component")


@dataclass(frozen=True)
class _Kind:
    """A server under test: its policies, and the requirement that an overlap breaks, by the ports of two callers."""

    name: str
    policies: tuple[Policy, ...]
    same: tuple[str, ...]
    different: tuple[str, ...]


_KINDS = (
    _Kind("protected passive", (Policy(s.PROTECTED_PASSIVE),), ("R-10.1.3.2-13",), ("R-10.1.3.2-16",)),
    _Kind("unprotected passive", (Policy(s.UNPROTECTED_PASSIVE),), ("R-10.1.3.2-20",), ("R-10.1.3.2-20",)),
    _Kind("active on one port", (Policy(s.ACTIVE, "in.api"),), ("R-10.1.3.2-09",), ("R-10.1.3.2-10",)),
    _Kind(
        "active on two ports",
        (Policy(s.ACTIVE, "in.api"), Policy(s.ACTIVE, "aux.api")),
        ("R-10.1.3.2-09",),
        ("R-10.1.3.2-09",),
    ),
)
_ACTIVE_SERVICE = _Kind(
    "active on a service", (Policy(s.ACTIVE, _SERVICE_PORT),), ("R-10.1.3.2-09",), ("R-10.1.3.2-10",)
)
_ACTIVE_RECEIVER = _Kind(
    "active on messages",
    (Policy(s.ACTIVE, "in.api"), Policy(s.ACTIVE, _MESSAGE_PORT)),
    ("R-10.1.3.2-09",),
    ("R-10.1.3.2-09",),
)
_SELF_EXECUTING = _Kind("self-executing", (Policy(s.SELF_EXECUTING),), ("R-10.1.3.2-06",), ("R-10.1.3.2-06",))


def overlap_purposes() -> list[TestPurpose]:
    """Two callers on every pair of ways, and three on every combination of ports, for each kind of server."""
    purposes = []
    for kind in _KINDS:
        for same, requirements in ((True, kind.same), (False, kind.different)):
            chosen = [ways for ways in _combinations() if (len({way.port for way in ways}) == 1) == same]
            ports = "one port" if same else "several ports"
            scenarios = _meetings(kind, chosen)
            text = f"Callers of {ports} of a component that is {kind.name} are sent while one is held inside."
            purposes.append(
                TestPurpose(f"{kind.name}/{ports}", _CLAUSE, text, (*requirements, *_served(kind)), scenarios)
            )
    for kind in (*_KINDS, _ACTIVE_SERVICE):
        scenarios = _meetings(kind, _combinations_with_services())
        text = f"Clients of a service connector call a component that is {kind.name} while one is held inside."
        concerned = tuple(dict.fromkeys((*kind.same, *kind.different, *_served(kind))))
        purposes.append(TestPurpose(f"{kind.name}/services", _CLAUSE, text, concerned, scenarios))
    purposes += [_active_as_a_whole(), *_receivers(), *_in_situations()]
    entered = (*_WAYS, *_SERVICE_WAYS, _MESSAGE_WAY)
    runs = tuple((f"self-executing/{way.name}", _meeting_with_run(way)) for way in entered)
    text = "Callers of a self-executing component are sent while its run is held inside."
    purposes.append(TestPurpose("self-executing/run and ports", _CLAUSE, text, ("R-10.1.3.2-06",), runs))
    return purposes


def _active_as_a_whole() -> TestPurpose:
    """The policy is attached to the component, by vendors who allow that beside ports (active-applicability)."""
    kind = _Kind("active as a whole", (Policy(s.ACTIVE),), ("R-10.1.3.2-09",), ("R-10.1.3.2-09",))
    pairs = itertools.product(_WAYS[: len(_PORTS)], repeat=2)
    scenarios = _meetings(kind, pairs)
    text = f"A component that is {kind.name} is called by two, one while the other is held inside."
    under = ("protected-active-applicability=onBoth",)
    return TestPurpose(kind.name, _CLAUSE, text, kind.same, scenarios, under=under)


def _receivers() -> list[TestPurpose]:
    """A message is pushed to a component while a call is held inside, and a call is made while a message is."""
    purposes = []
    for kind in (*_KINDS, _ACTIVE_RECEIVER, _SELF_EXECUTING):
        pairs = ((_WAYS[0], _MESSAGE_WAY), (_MESSAGE_WAY, _WAYS[0]))
        scenarios = _meetings(kind, pairs)
        text = f"A component that is {kind.name} is called and gets a message, one while the other is held inside."
        purposes.append(TestPurpose(f"{kind.name}/messages", _CLAUSE, text, kind.different, scenarios))
    return purposes


def _in_situations() -> list[TestPurpose]:
    """Protected components are protected whatever went before, whichever instance of their implementation they are, everywhere, and whatever
    other policies they have.
    """
    purposes = []
    ways = _WAYS[: len(_PORTS)]
    for kind in (_KINDS[0], _KINDS[3], _SELF_EXECUTING):
        situations = (*_SITUATIONS, _LATE) if kind is _KINDS[0] else _SITUATIONS
        scenarios = tuple((f"{kind.name}/{what}", _meeting(kind, ways, what)) for what in situations)
        text = f"A component that is {kind.name} is called by two, {', '.join(situations)}."
        purposes.append(TestPurpose(f"{kind.name}/afterwards", _CLAUSE, text, kind.different, scenarios))
    return purposes


def crowd_purposes() -> list[TestPurpose]:
    """More callers than two on components of every kind: on one port, and on several ports by turns."""
    purposes = []
    for kind in (*_KINDS, _SELF_EXECUTING):
        scenarios = []
        for count in load_boundaries().callers:
            for name, ways in (("one port", _WAYS[:1]), ("several ports", _WAYS[: len(_PORTS)])):
                crowd = tuple(itertools.islice(itertools.cycle(ways), count))
                scenarios.append((f"{kind.name}/{count} callers of {name}", _meeting(kind, crowd)))
        text = f"Many callers of a component that is {kind.name} are sent while one is held inside."
        concerned = tuple(dict.fromkeys((*kind.same, *kind.different, *_served(kind))))
        purposes.append(TestPurpose(f"{kind.name}/crowds", _CLAUSE, text, concerned, tuple(scenarios)))
    return purposes


def _served(kind: _Kind) -> tuple[str, ...]:
    return () if kind.name.startswith("unprotected") else ("R-10.1.3.2-17",)


def _combinations() -> Iterator[tuple[_Way, ...]]:
    yield from itertools.product(_WAYS, repeat=2)
    yield from itertools.product(_WAYS[: len(_PORTS)], repeat=3)


def _combinations_with_services() -> Iterator[tuple[_Way, ...]]:
    """Clients of the service among themselves, and beside the test."""
    yield from itertools.product(_SERVICE_WAYS, repeat=2)
    for way in _SERVICE_WAYS:
        yield from itertools.permutations((_WAYS[0], way))
    yield (*_SERVICE_WAYS, _WAYS[0])


def _meetings(kind: _Kind, several: Iterable[tuple[_Way, ...]]) -> tuple[tuple[str, Scenario], ...]:
    return tuple((f"{kind.name}/{', '.join(way.name for way in ways)}", _meeting(kind, ways)) for ways in several)


def _meeting(kind: _Kind, ways: tuple[_Way, ...], situation: str = "") -> Scenario:
    """All are sent to the server, which is in one of ``_SITUATIONS``."""
    raised = situation == _RAISED
    hold = (s.HoldAtGate("inside"),)
    method: tuple[s.Action, ...] = (s.RaiseError(),) if raised else (*hold, s.Answer(s.PUSH, ("ok",)))
    if not raised and _MESSAGE_WAY not in ways:
        method = hold
    all_ways = (*ways, _SERVICE_WAYS[0]) if raised else ways
    policies = (*kind.policies, *_FURTHER_POLICIES.get(situation, ()))
    server = _server(all_ways, {"exchange": hold, "method": method}, policies)
    callers = [f"caller {number}" for number in range(len(ways))]
    calls: list[Step] = [s.Stop(), s.Start()] if situation == _RESTARTED else []
    calls += [s.Invoke(f"way {len(ways)}", 21)] if raised else []
    for number, caller in enumerate(callers):
        calls.append(s.Invoke(f"way {number}", number + 1, thread=caller))
        calls.append(s.ReachGate("inside") if number == 0 else s.Settle(caller))
    if _MESSAGE_WAY in ways or kind.policies == (Policy(s.UNPROTECTED_PASSIVE),):
        calls.append(s.Pause(_MOMENT))
    if situation == _LATE:
        calls.append(s.Pause(_LONG))
    calls += [s.OpenGate("inside"), *map(s.Join, callers)]
    if _MESSAGE_WAY in ways:
        calls.append(s.ReachGate("inside", total=len(ways)))
    return _scenario(server, all_ways, calls, situation)


def _meeting_with_run(way: _Way) -> Scenario:
    plan: dict[s.Hook, tuple[s.Action, ...]] = {"run": (s.HoldAtGate("running"),)}
    is_message = way == _MESSAGE_WAY
    if is_message:
        plan["method"] = (s.HoldAtGate("got"), s.Answer(s.PUSH, ("ok",)))
    server = _server((way,), plan, _SELF_EXECUTING.policies)
    calls: list[Step] = [s.OpenGate("got")] if is_message else []
    calls += [s.ReachGate("running"), s.Invoke("way 0", 1, thread="caller"), s.Settle("caller")]
    calls += [s.Pause(_MOMENT)] if is_message else []
    calls += [s.OpenGate("running"), s.Join("caller"), *([s.ReachGate("got")] if is_message else [])]
    return _scenario(server, (way,), calls)


def _server(
    ways: tuple[_Way, ...], plan: dict[s.Hook, tuple[s.Action, ...]], policies: tuple[Policy, ...]
) -> Declaration:
    """It has a service, and gets messages, only where a client calls or pushes."""
    ports = {port: name for port, name in _INTERFACE_OF.items() if any(way.port == port for way in ways)}
    if not ports:
        plan = {hook: actions for hook, actions in plan.items() if hook != "method"}
    return Declaration((*_PORTS, *ports), plan=plan, policies=policies, ports=ports)


def _scenario(server: Declaration, ways: tuple[_Way, ...], calls: list[Step], situation: str = "") -> Scenario:
    """The server is set up with one client for each way that wants one, called, and stopped."""
    components = {"server": server}
    place = "below" if situation == _BELOW else s.MANAGER
    other = "other server"
    steps: list[Step] = [s.CreateContainer(place)] if situation == _BELOW else []
    steps += [s.AddComponent("server", bind=other)] if situation in (_SECOND, _SUCCESSOR) else []
    steps += [s.Start(), s.Stop(), s.RemoveComponent(other)] if situation == _SUCCESSOR else []
    steps.append(s.AddComponent("server", place))
    elsewhere = any(way.client == "component elsewhere" for way in ways)
    if elsewhere:
        steps.append(s.CreateContainer("elsewhere"))
    for port, interface in server.ports.items():
        steps.append(s.Link(_CONNECTOR_OF[port], interface, f"line of {port}"))
        steps.append(provided_end(_CONNECTOR_OF[port], f"line of {port}", "server", port, place))
    for number, way in enumerate(ways):
        if not way.client:
            steps.append(s.GetPortElement("server", way.port, f"way {number}", place))
            continue
        client, container = f"client {number}", "elsewhere" if way.client == "component elsewhere" else s.MANAGER
        components[client] = _client(way, number)
        if way.port in _INTERFACE_OF:
            steps.append(s.AddComponent(client, container))
            steps.append(required_end(_CONNECTOR_OF[way.port], f"line of {way.port}", client, container=container))
        else:
            steps.append(s.GetPortElement("server", way.port, f"goal {number}", place))
            steps.append(s.AddComponent(client, container))
            steps.append(s.Connect(client, "out.api", f"goal {number}", f"link {number}", container))
        steps.append(s.GetPortElement(client, "in.api", f"way {number}", container))
    others = [*(["elsewhere"] if elsewhere else []), *([place] if place != s.MANAGER else [])]
    steps += [s.Start(), *map(s.Start, others), *calls, *map(s.Stop, others), s.Stop(), s.GetComponents()]
    return Scenario(components, tuple(steps), interfaces={name: _INTERFACES[name] for name in server.ports.values()})


def _client(way: _Way, number: int) -> Declaration:
    if way.port not in _INTERFACE_OF:
        call: s.Action = s.CallPort("out.api", number + 11)
        return Declaration(("in.api",), ("out.api",), plan={"exchange": (call,)})
    call = s.CallMethod("out.api", s.PUSH if way == _MESSAGE_WAY else "serve", (number + 11,))
    return Declaration(
        ("in.api",), ("out.api",), plan={"exchange": (call,)}, ports={"out.api": _INTERFACE_OF[way.port]}
    )
