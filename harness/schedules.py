"""Gate schedules: scenarios that provoke overlap in a component with an execution policy, all orders of few callers (10.1.3.2).

The first caller is held inside at a gate. Each of the others is sent off and looked for, so that it is known to be inside or
to wait; then the gate is opened and everybody must come back.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Policy, Scenario, Step
from ucm_cts.harness.scripts import TestPurpose

_PORTS = ("in.api", "aux.api")
_CLAUSE = "10.1.3.2"


@dataclass(frozen=True)
class _Way:
    """A way into the server: its port element, called by the test or by a component, perhaps of another container."""

    port: str
    client: str = ""

    @property
    def name(self) -> str:
        return f"{self.port.partition('.')[0]}{f' by {self.client}' if self.client else ''}"


_WAYS = tuple(_Way(port, client) for client in ("", "component", "component elsewhere") for port in _PORTS)


@dataclass(frozen=True)
class _Kind:
    """A server under test: its policies, and what overlap in it would break, by the ports of two callers."""

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
_SELF_EXECUTING = _Kind("self-executing", (Policy(s.SELF_EXECUTING),), ("R-10.1.3.2-06",), ("R-10.1.3.2-06",))


def overlap_purposes() -> list[TestPurpose]:
    """Two callers on every pair of ways, and three on every combination of ports, for each kind of server."""
    purposes = []
    for kind in _KINDS:
        for same, requirements in ((True, kind.same), (False, kind.different)):
            chosen = [ways for ways in _combinations() if (len({way.port for way in ways}) == 1) == same]
            ports = "one port" if same else "several ports"
            scenarios = tuple(
                (f"{kind.name}/{', '.join(w.name for w in ways)}", _meeting(kind, ways)) for ways in chosen
            )
            text = f"Callers of {ports} of a component that is {kind.name} are sent while one is held inside."
            purposes.append(
                TestPurpose(f"{kind.name}/{ports}", _CLAUSE, text, (*requirements, *_served(kind)), scenarios)
            )
    runs = tuple((f"self-executing/{way.name}", _meeting_with_run(way)) for way in _WAYS)
    text = "A self-executing component runs, once started and once started again, and one run at a time."
    alone = ("R-10.1.3.2-01", "R-10.1.3.2-02", "R-10.1.3.2-03", "R-10.1.3.2-05")
    purposes.append(TestPurpose("self-executing/alone", _CLAUSE, text, alone, (("self-executing/alone", _runs()),)))
    purposes.append(
        TestPurpose(
            "two execution policies",
            "10.1.3",
            "A component has more than one execution policy.",
            ("R-10.1.3-03",),
            tuple((f"two policies/{one} and {other}", _contradictory(one, other)) for one, other in _PAIRS),
        )
    )
    text = "Callers of a self-executing component are sent while its run is held inside."
    purposes.append(TestPurpose("self-executing/run and ports", _CLAUSE, text, ("R-10.1.3.2-06",), runs))
    return purposes


def _served(kind: _Kind) -> tuple[str, ...]:
    return () if kind.name.startswith("unprotected") else ("R-10.1.3.2-17",)


def _combinations() -> Iterator[tuple[_Way, ...]]:
    yield from itertools.product(_WAYS, repeat=2)
    yield from itertools.product(_WAYS[: len(_PORTS)], repeat=3)


def _meeting(kind: _Kind, ways: tuple[_Way, ...]) -> Scenario:
    server = Declaration(_PORTS, plan={"exchange": (s.HoldAtGate("inside"),)}, policies=kind.policies)
    callers = [f"caller {number}" for number in range(len(ways))]
    calls: list[Step] = []
    for number, caller in enumerate(callers):
        calls.append(s.Invoke(f"way {number}", number + 1, thread=caller))
        calls.append(s.ReachGate("inside") if number == 0 else s.Settle(caller))
    calls += [s.OpenGate("inside"), *map(s.Join, callers)]
    return _scenario(server, ways, calls)


def _meeting_with_run(way: _Way) -> Scenario:
    plan: dict[s.Hook, tuple[s.Action, ...]] = {"run": (s.HoldAtGate("running"),)}
    server = Declaration(_PORTS, plan=plan, policies=_SELF_EXECUTING.policies)
    calls: list[Step] = [s.ReachGate("running"), s.Invoke("way 0", 1, thread="caller"), s.Settle("caller")]
    return _scenario(server, (way,), [*calls, s.OpenGate("running"), s.Join("caller")])


_PAIRS = tuple(itertools.combinations((s.SELF_EXECUTING, s.ACTIVE, s.PROTECTED_PASSIVE, s.UNPROTECTED_PASSIVE), 2))


def _contradictory(one: str, other: str) -> Scenario:
    policies = tuple(Policy(name, "in.api" if name == s.ACTIVE else None) for name in (one, other))
    steps = (s.AddComponent("server"), s.Start(), s.Stop(), s.GetComponents())
    return Scenario({"server": Declaration(_PORTS, policies=policies)}, steps)


def _runs() -> Scenario:
    plan: dict[s.Hook, tuple[s.Action, ...]] = {"run": (s.HoldAtGate("running"),)}
    several = s.ReachGate("running", more=6)
    steps = (
        s.AddComponent("server"),
        s.Start(),
        s.ReachGate("running"),
        s.ReachGate("running", more=1),  # it must not come: the patience it takes is the time for a second run to show
        s.OpenGate("running"),
        several,
        s.Stop(),
        s.GetComponents(),
        s.Start(),
        several,
        s.Stop(),
        s.GetComponents(),
    )
    return Scenario({"server": Declaration(plan=plan, policies=_SELF_EXECUTING.policies)}, steps)


def _scenario(server: Declaration, ways: tuple[_Way, ...], calls: list[Step]) -> Scenario:
    """The server is set up with one client for each way that wants one, called, and stopped."""
    components = {"server": server}
    steps: list[Step] = [s.AddComponent("server")]
    elsewhere = any(way.client == "component elsewhere" for way in ways)
    if elsewhere:
        steps.append(s.CreateContainer("elsewhere"))
    for number, way in enumerate(ways):
        goal = f"goal {number}" if way.client else f"way {number}"
        steps.append(s.GetPortElement("server", way.port, goal))
        if way.client:
            client, container = f"client {number}", "elsewhere" if way.client == "component elsewhere" else s.MANAGER
            call = s.CallPort("out.api", number + 11)
            components[client] = Declaration(("in.api",), ("out.api",), plan={"exchange": (call,)})
            steps += [
                s.AddComponent(client, container),
                s.Connect(client, "out.api", goal, f"link {number}", container),
                s.GetPortElement(client, "in.api", f"way {number}", container),
            ]
    steps += [s.Start(), *([s.Start("elsewhere")] if elsewhere else []), *calls]
    steps += [*([s.Stop("elsewhere")] if elsewhere else []), s.Stop(), s.GetComponents()]
    return Scenario(components, tuple(steps))
