"""Scenarios of services (10.1.5): all directions of parameters, small numbers of clients, and calls that are interrupted.

Clients call from all places, one by one and at once; calls are undone or stopped while they are carried out.

A client calls when the test calls it. Its server answers with the argument, so that every answer shows which call it belongs to.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal, get_args

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum, Integer, Interface, Method, Parameter
from ucm_cts.adapters.contract.scenario import Declaration, Policy, Scenario, Step
from ucm_cts.harness.purposes.connections import SERVICE, provided_end, required_end
from ucm_cts.harness.purposes.scripts import TestPurpose

_CLAUSE = "10.1.5.1"
_LINK, _GATE = "link", "inside"
_ELSEWHERE, _FAR = "elsewhere", "far away"

Direction = Literal["IN", "OUT", "INOUT", "RETURN"]

_NUMBER = Integer("LONG")
_ECHO = Interface({"echo": Method((Parameter("given", "IN", _NUMBER), Parameter("result", "RETURN", _NUMBER)))})

_POLICIES: dict[str, tuple[Policy, ...]] = {
    "no policy": (),
    "protected passive": (Policy(s.PROTECTED_PASSIVE),),
    "unprotected passive": (Policy(s.UNPROTECTED_PASSIVE),),
    "active": (Policy(s.ACTIVE, "in.api"),),
}
"""Execution policies of the server."""

_PLACES: dict[str, tuple[str, ...]] = {
    "one container": (s.MANAGER,) * 4,
    "clients elsewhere": (s.MANAGER, *(_ELSEWHERE,) * 3),
    "server elsewhere": (_ELSEWHERE, *(s.MANAGER,) * 3),
    "three containers": (s.MANAGER, _ELSEWHERE, _FAR, s.MANAGER),
}
"""Where the server is, and where its clients are."""


@dataclass
class _Configuration:
    """A scenario under construction: a server and its clients, in the containers that ``places`` names for each."""

    places: Sequence[str]
    interface: Interface = _ECHO
    components: dict[str, Declaration] = field(default_factory=dict)
    steps: list[Step] = field(default_factory=list)

    def begin(self, server: Declaration, clients: int, calls: Sequence[s.CallMethod]) -> _Configuration:
        """Add, attach and start the server and the clients, each client with arguments of its own."""
        self.steps += [s.CreateContainer(place) for place in self.containers if place != s.MANAGER]
        self.steps.append(s.Link(SERVICE, "service", _LINK))
        self._add("server", server, self.places[0])
        self.steps.append(provided_end(SERVICE, _LINK, "server", container=self.places[0]))
        for number in range(clients):
            name, place = f"client {number}", self.places[number + 1]
            own = tuple(_of_client(call, number) for call in calls)
            ports = {"out.api": "service"}
            self._add(name, Declaration(("in.api",), ("out.api",), plan={"exchange": own}, ports=ports), place)
            self.steps.append(required_end(SERVICE, _LINK, name, container=place))
            self.steps.append(s.GetPortElement(name, "in.api", f"tell {number}", place))
        self.steps += map(s.Start, self.containers)
        return self

    def end(self, *stopped: str) -> Scenario:
        """All containers that are not ``stopped`` are."""
        self.steps += [s.Stop(place) for place in reversed(self.containers) if place not in stopped]
        self.steps.append(s.GetComponents())
        return Scenario(self.components, tuple(self.steps), interfaces={"service": self.interface})

    def call_at_once(self, clients: int) -> None:
        """The first client's call is held in the server, then the other clients call: each is inside or waits."""
        for number in range(clients):
            worker = f"caller {number}"
            self.steps.append(s.Invoke(f"tell {number}", number + 1, thread=worker))
            self.steps.append(s.ReachGate(_GATE) if number == 0 else s.Settle(worker))
        self.steps.append(s.Settle("caller 0"))

    def let_go(self, clients: int) -> None:
        """Let the server go on, and join all workers."""
        self.steps += [s.OpenGate(_GATE), *(s.Join(f"caller {number}") for number in range(clients))]

    @property
    def containers(self) -> list[str]:
        """Those that components are in, in the order in which they are started."""
        return list(dict.fromkeys(self.places))

    def _add(self, name: str, declaration: Declaration, place: str) -> None:
        self.components[name] = declaration
        self.steps.append(s.AddComponent(name, place))


def service_purposes() -> list[TestPurpose]:
    """Directions of parameters; numbers, places and policies of clients and servers; calls in flight."""
    return [_directions(), _one_by_one(), *_at_once(), *_in_flight()]


def _of_client(call: s.CallMethod, number: int) -> s.CallMethod:
    arguments = tuple(a + 100 * number if isinstance(a, int) else a for a in call.arguments)
    return s.CallMethod(call.port, call.method, arguments)


def _echoing(policies: tuple[Policy, ...] = (), *before: s.Action) -> Declaration:
    plan: dict[s.Hook, tuple[s.Action, ...]] = {"method": (*before, s.Answer("echo"))}
    return Declaration(("in.api",), plan=plan, policies=policies, ports={"in.api": "service"})


def _echo(value: int) -> s.CallMethod:
    return s.CallMethod("out.api", "echo", (value,))


def _directions() -> TestPurpose:
    """Every combination of directions, declared in one order and in the other, with two parameters of each."""
    scenarios = []
    kinds: tuple[Direction, ...] = get_args(Direction)
    for chosen in itertools.chain.from_iterable(itertools.combinations(kinds, n) for n in range(len(kinds) + 1)):
        methods = {"forth": _method(chosen), "back": _method(chosen[::-1])}
        calls = [s.CallMethod("out.api", name, _numbers(len(m.arguments), 1)) for name, m in methods.items()]
        answers = tuple(s.Answer(name, _numbers(len(m.results), 51)) for name, m in methods.items())
        server = Declaration(("in.api",), plan={"method": answers}, ports={"in.api": "service"})
        configuration = _Configuration(_PLACES["one container"], Interface(methods)).begin(server, 1, calls)
        configuration.steps.append(s.Invoke("tell 0", 1))
        scenarios.append((f"services/{', '.join(chosen) or 'no parameters'}", configuration.end()))
    text = "A client calls methods with parameters of every combination of directions."
    return _purpose("services/directions", text, ("08", "01"), scenarios)


def _method(directions: Sequence[Direction]) -> Method:
    """Two parameters of each direction, and one result."""
    several = [(d, n) for d in directions for n in ((1,) if d == "RETURN" else (1, 2))]
    return Method(tuple(Parameter(f"{d.lower()}_{n}", d, _NUMBER) for d, n in several))


def _numbers(count: int, first: int) -> tuple[Datum, ...]:
    return tuple(range(first, first + count))


def _one_by_one() -> TestPurpose:
    scenarios = []
    for (place, places), clients in itertools.product(_PLACES.items(), (1, 2, 3)):
        configuration = _Configuration(places[: clients + 1]).begin(_echoing(), clients, [_echo(1), _echo(2)])
        configuration.steps += [s.Invoke(f"tell {number}", number + 1) for number in (*range(clients), 0)]
        scenarios.append((f"services/{clients} of {place}, one by one", configuration.end()))
    text = "Clients in one container and in several call one server, one after the other."
    return _purpose("services/one by one", text, ("03", "01"), scenarios)


def _at_once() -> list[TestPurpose]:
    purposes = []
    for policy, policies in _POLICIES.items():
        scenarios = []
        for (place, places), clients in itertools.product(_PLACES.items(), (2, 3)):
            server = _echoing(policies, s.HoldAtGate(_GATE))
            configuration = _Configuration(places[: clients + 1]).begin(server, clients, [_echo(1), _echo(2)])
            configuration.call_at_once(clients)
            configuration.let_go(clients)
            scenarios.append((f"services/{policy}, {clients} of {place}, at once", configuration.end()))
        text = f"Clients call while the first is held inside the server, which has {policy}."
        purposes.append(_purpose(f"services/{policy}, at once", text, ("04", "11", "03"), scenarios))
    return purposes


@dataclass(frozen=True)
class _Interruption:
    """An operation while the server is held; its object is ``server`` or ``client 0``."""

    name: str
    whose: str

    def step(self, places: Sequence[str]) -> Step:
        """The step, on a thread of its own: it may wait for the server."""
        container = places[0] if self.whose == "server" else places[1]
        if self.name == "stop":
            return s.Stop(container, thread="meanwhile")
        port = "in.api" if self.whose == "server" else "out.api"
        return s.Detach(_LINK, self.whose, port, container, thread="meanwhile")


def _in_flight() -> list[TestPurpose]:
    purposes = []
    kinds = [_Interruption(name, whose) for name in ("stop", "detach") for whose in ("client 0", "server")]
    for kind in kinds:
        scenarios = []
        for (place, places), policy, clients in itertools.product(_PLACES.items(), ("no policy", "active"), (1, 2)):
            if (kind, place) == (kinds[0], "one container") or (place == "three containers" and clients == 1):
                continue  # as the server's, and as elsewhere
            server = _echoing(_POLICIES[policy], s.HoldAtGate(_GATE))
            configuration = _Configuration(places[: clients + 1]).begin(server, clients, [_echo(1)])
            configuration.call_at_once(clients)
            step = kind.step(places)
            configuration.steps += [step, s.Settle("meanwhile")]
            configuration.let_go(clients)
            configuration.steps.append(s.Join("meanwhile"))
            stopped = (step.container,) if isinstance(step, s.Stop) else ()
            name = f"services/{kind.name} {kind.whose} of {place}, {policy}, {clients} calling"
            scenarios.append((name, configuration.end(*stopped)))
        what = "The container of {} is stopped" if kind.name == "stop" else "{} is detached"
        text = f"{what.format(f'the {kind.whose.split()[0]}')} while the server is held."
        text = text[0].upper() + text[1:]
        purposes.append(_purpose(f"services/{kind.name} {kind.whose}", text, ("12",), scenarios))
    return purposes


def _purpose(
    name: str, text: str, requirements: Sequence[str], scenarios: Sequence[tuple[str, Scenario]]
) -> TestPurpose:
    ids = tuple(f"R-{_CLAUSE}-{number}" for number in requirements)
    return TestPurpose(name, _CLAUSE, text, ids, tuple(scenarios))
