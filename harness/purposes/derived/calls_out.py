"""Scenarios in which a component calls another one from each place where it may be executed: runs, callbacks, responses, notifications."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import AnyType, Datum, Integer, Interface
from ucm_cts.adapters.contract.platform_interfaces import (
    CONNECTOR_PORTS,
    NOTIFY,
    PUBLISH,
    REQUEST,
    REQUEST_DATA,
    REQUEST_RESPONSE,
    RESPONSE,
    RESPONSE_DATA,
    SHARED,
    SHARED_DATA,
    WRITE,
    named_interfaces,
)
from ucm_cts.adapters.contract.scenario import Action, Declaration, Hook, Policy, Scenario, Step
from ucm_cts.harness.purposes.connections import INTERFACES, MESSAGE, PROVIDER, REQUIRER, SERVE, SERVICE
from ucm_cts.harness.purposes.container_services import HAS_TRACE, TRACE
from ucm_cts.harness.purposes.derived.object_timer_steps import HANDLERS, SCHEDULES, once
from ucm_cts.harness.purposes.derived.paced_policies import policy
from ucm_cts.harness.purposes.derived.timer_steps import PORT, SELF, TIMERS, after, sporadic
from ucm_cts.harness.purposes.scripts import TestPurpose

_CALLER, _CALLED, _OTHER = "caller", "called", "other"
_TELL = "tell"
_GOT = "got"
"""The gate that whoever is called passes."""

_AFTER_START = 30
"""Milliseconds, as an offset: the run comes when start has returned."""

_LONG = Integer("LONG")
_VALUE, _RESPONSE = 41, 42


@dataclass(frozen=True)
class _Connection:
    """A connection between two components, and what the one that calls does with it.

    ``connector``: its name. ``calls``: the role of the component that calls, and ``called``: of the other.
    ``does``: the method, or methods, that it calls, with arguments. ``answers``: what the other's body does then.
    ``requirement``: what is broken if that does not happen.
    """

    connector: str
    calls: str
    called: str
    does: tuple[tuple[str, tuple[Datum, ...]], ...]
    answers: tuple[Action, ...]
    requirement: str

    @property
    def interfaces(self) -> dict[str, Interface]:
        """The interfaces that it takes, under the name that it is bound to."""
        if self.connector in INTERFACES:
            return {self.connector: INTERFACES[self.connector]}
        return named_interfaces(self.connector, self.types[self.connector])

    @property
    def types(self) -> dict[str, dict[str, AnyType]]:
        """The types that it is bound to, if it is of 10.4."""
        data = {REQUEST_RESPONSE: (REQUEST_DATA, RESPONSE_DATA), SHARED_DATA: (SHARED,)}
        return {self.connector: dict.fromkeys(data[self.connector], _LONG)} if self.connector in data else {}

    def elements(self, role: str, port: str) -> dict[str, tuple[str, bool]]:
        """The port elements of an end in that ``role``: by name the interface, and whether they are provided."""
        if role in CONNECTOR_PORTS:
            of = CONNECTOR_PORTS[role].elements
            return {f"{port}.{e.name}": (f"{self.connector}.{e.interface}", e.provided) for e in of}
        return {f"{port}.api": (self.connector, role in PROVIDER.values())}

    def port(self, role: str, port: str) -> str:
        """What is attached of such an end."""
        return port if role in CONNECTOR_PORTS else f"{port}.api"

    def actions(self, port: str) -> tuple[Action, ...]:
        """The calls, through the required element of an end named ``port``."""
        (element,) = (name for name, (_, provided) in self.elements(self.calls, port).items() if not provided)
        return tuple(s.CallMethod(element, method, arguments) for method, arguments in self.does)


_SERVICE: Final = _Connection(SERVICE, REQUIRER[SERVICE], PROVIDER[SERVICE], ((SERVE, (_VALUE,)),), (), "R-10.1.5.1-01")
_MESSAGE: Final = _Connection(
    MESSAGE,
    REQUIRER[MESSAGE],
    PROVIDER[MESSAGE],
    ((s.PUSH, (_VALUE,)),),
    (s.Answer(s.PUSH, ("ok",)),),
    "R-10.1.6.1-01",
)
_REQUEST: Final = _Connection(
    REQUEST_RESPONSE,
    "rr_synchronous_client",
    "rr_synchronous_server",
    ((REQUEST, (_VALUE,)),),
    (s.Answer(REQUEST, (_RESPONSE, "ok")),),
    "R-10.4.1.2-01",
)
_PUBLICATION: Final = _Connection(
    SHARED_DATA,
    "sd_writer",
    "sd_reader",
    ((WRITE, (_VALUE,)), (PUBLISH, ())),
    (s.Answer(NOTIFY, ()),),
    "R-10.4.2.2-02",
)
_CONNECTIONS = {"a service": _SERVICE, "a message": _MESSAGE, "a request": _REQUEST, "a publication": _PUBLICATION}
_OF_THE_CORE = ("a service", "a message")


@dataclass(frozen=True)
class _Given:
    """What the container gives by a policy.

    ``policy``: of the caller. ``does``: its calls. ``awaited``: the steps after which their effect has shown.
    ``requirement``: what is broken if it has not.
    """

    policy: Policy
    does: tuple[Action, ...]
    awaited: tuple[Step, ...]
    requirement: str


_GIVEN = {
    "a timer": _Given(TIMERS, (sporadic(9, 1),), (after(1),), "R-10.3.2-21"),
    "the log": _Given(
        HAS_TRACE,
        (s.CallMethod(TRACE, "log", ("info", "called out")),),
        (s.ReadLog(1), s.Pause(30), s.ReadLog(1)),
        "R-10.1.4.2-26",
    ),
}
_OFTEN = ("run", "a periodic run")
"""Places where the caller is executed again and again: it would set its timer anew each time."""

_OF_OTHER_PURPOSES = ("run", "a message", "a service")
"""Places from which connections are called in other purposes: those of ``run``, and relays."""


@dataclass(frozen=True)
class _Place:
    """Where the caller is executed.

    ``hook``: of its body. ``clause``: about that place. ``policies``: of the caller.
    ``first``: what it does when it is told to, which leads to its execution there.
    ``provoked``: the steps after start.
    ``afterwards``: what it does when it has called.
    ``via``: the connection through which it is executed, if it is, and ``role``: the caller's role there.
    ``other``: what the other component there does when it is told to; if nothing, the caller is told.
    """

    hook: Hook
    clause: str
    policies: tuple[Policy, ...] = ()
    first: tuple[Action, ...] = ()
    provoked: tuple[Step, ...] = ()
    afterwards: tuple[Action, ...] = ()
    via: _Connection | None = None
    role: str = ""
    other: tuple[Action, ...] = ()


def _told(hook: Hook, clause: str, of: Policy, first: tuple[Action, ...] = (), *later: Step) -> _Place:
    """When the test calls it, or some time after that."""
    return _Place(hook, clause, (of,), first, (s.Invoke(_TELL, 1), *later))


def _reached(via: _Connection, clause: str) -> _Place:
    """When another component, which the test calls, reaches it through a connection."""
    told = (s.Invoke(_TELL, 1),)
    return _Place(
        "method", clause, provoked=told, afterwards=via.answers, via=via, role=via.called, other=via.actions("first")
    )


_ANSWERED = _Place(
    "method",
    "10.4.1",
    first=(s.CallMethod("first.client_req_p", REQUEST, (_VALUE,)),),
    provoked=(s.Invoke(_TELL, 1),),
    afterwards=(s.Answer(RESPONSE, ("ok",)),),
    via=_REQUEST,
    role="rr_asynchronous_client",
)

_PLACES = {
    "run": _Place("run", "10.1.3.2", (SELF,)),
    "a periodic run": _Place("run", "10.5", (policy(s.PERIODIC_SELF_EXECUTING, offset=_AFTER_START),)),
    "a run in the background": _Place("run", "10.5", (policy(s.BACKGROUND, offset=_AFTER_START),)),
    "a periodic execution": _told("exchange", "10.5", policy(s.PERIODIC_ACTIVE, port=PORT)),
    "a sporadic execution": _told("exchange", "10.5", policy(s.SPORADIC_ACTIVE, port=PORT)),
    "the callback of an index timer": _told("method", "10.3.2", TIMERS, (sporadic(5, 1),), after(1)),
    "the trigger of an object timer": _told("method", "10.3.1", SCHEDULES, (once(0.2),), after(0.2)),
    "a notification": _reached(_PUBLICATION, "10.4.2"),
    "a request that is served": _reached(_REQUEST, "10.4.1"),
    "a response": _ANSWERED,
    "a message": _reached(_MESSAGE, "10.3.2"),
    "a service": _reached(_SERVICE, "10.3.2"),
}


def calls_from_run() -> list[TestPurpose]:
    """Services and messages from the run of a self-executing component (10.1.3.2)."""
    return [_purpose("run", _OF_THE_CORE)]


def calls_from_callbacks() -> list[TestPurpose]:
    """Everything from each place of 10.3 to 10.5, what 10.4 adds from run, and timers and records of the log from everywhere."""
    others = [name for name in _CONNECTIONS if name not in _OF_THE_CORE]
    purposes = [_purpose("run", others, "10.4")]
    for name, place in _PLACES.items():
        given = [what for what, one in _GIVEN.items() if name not in _OFTEN and one.policy not in place.policies]
        reaches = _CONNECTIONS if name not in _OF_OTHER_PURPOSES else ()
        if given or reaches:
            purposes.append(_purpose(name, (*reaches, *given)))
    return purposes


def _purpose(place: str, connections: Iterable[str], clause: str = "") -> TestPurpose:
    known: dict[str, _Connection | _Given] = {**_CONNECTIONS, **_GIVEN}
    chosen = {name: known[name] for name in connections}
    name = f"calls from {place}{f' ({clause})' if clause else ''}"
    scenarios = tuple((f"{name}/{what}", _scenario(_PLACES[place], one)) for what, one in chosen.items())
    requirements = tuple(one.requirement for one in chosen.values())
    return TestPurpose(
        name, clause or _PLACES[place].clause, f"A component calls others from {place}.", requirements, scenarios
    )


@dataclass(frozen=True)
class _End:
    """An end of a connection: the ``line``, what joins there, in which ``role``, and the name of the ``port``."""

    line: str
    of: _Connection
    role: str
    port: str


def _scenario(place: _Place, out: _Connection | _Given) -> Scenario:
    """The caller is executed in its ``place`` and calls ``out``."""
    plans: dict[str, dict[Hook, tuple[Action, ...]]] = {_CALLER: {"exchange": place.first} if place.first else {}}
    ends: dict[str, list[_End]] = {_CALLER: []}
    if isinstance(out, _Given):
        plans[_CALLER][place.hook] = (*out.does, *place.afterwards)
        policies, awaited = (*place.policies, out.policy), out.awaited
    else:
        plans[_CALLER][place.hook] = (*out.actions("out"), *place.afterwards)
        plans[_CALLED] = {"method": (s.HoldAtGate(_GOT), *out.answers)}
        ends = {_CALLER: [_End("line", out, out.calls, "out")], _CALLED: [_End("line", out, out.called, "serves")]}
        policies, awaited = place.policies, (s.ReachGate(_GOT, total=1),)
    if place.via is not None:
        is_called = place.role == place.via.called
        ends[_CALLER].append(_End("first line", place.via, place.role, "first"))
        ends[_OTHER] = [_End("first line", place.via, place.via.calls if is_called else place.via.called, "first")]
        plans[_OTHER] = {"exchange": place.other} if is_called else {"method": place.via.answers}
    steps: list[Step] = [s.AddComponent(name) for name in ends]
    joined = {end.line: end.of for of in ends.values() for end in of}
    steps += [s.Link(of.connector, of.connector, line) for line, of in joined.items()]  # type: ignore[arg-type]
    steps += [
        s.Attach(end.line, end.role, name, end.of.port(end.role, end.port))  # type: ignore[arg-type]
        for name, of in ends.items()
        for end in sorted(of, key=lambda end: end.role == end.of.calls)
    ]
    told = _OTHER if place.other else _CALLER
    steps += [s.GetPortElement(told, PORT, _TELL), s.OpenGate(_GOT), s.Start(), *place.provoked]
    steps += [*awaited, s.Stop(), s.GetComponents()]
    components = {name: _component(of, plans[name], policies if name == _CALLER else ()) for name, of in ends.items()}
    interfaces = {name: one for of in joined.values() for name, one in of.interfaces.items()}
    types = {name: one for of in joined.values() for name, one in of.types.items()}
    return Scenario(components, tuple(steps), interfaces=interfaces, types=types, patience=4000)


def _component(ends: list[_End], plan: dict[Hook, tuple[Action, ...]], policies: tuple[Policy, ...]) -> Declaration:
    elements = {name: one for end in ends for name, one in end.of.elements(end.role, end.port).items()}
    return Declaration(
        (PORT, *(name for name, (_, provided) in elements.items() if provided)),
        tuple(name for name, (_, provided) in elements.items() if not provided),
        plan=plan,
        policies=policies,
        ports={name: interface for name, (interface, _) in elements.items()},
        handlers=HANDLERS if SCHEDULES in policies else (),
    )
