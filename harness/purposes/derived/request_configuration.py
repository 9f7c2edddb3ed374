"""Builds scenarios of request-response: one connection or several, a server and clients of either kind, and what they do."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final, Literal

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import AnyType, Datum, Integer
from ucm_cts.adapters.contract.platform_interfaces import (
    CONNECTOR_PORTS,
    REQUEST,
    REQUEST_DATA,
    REQUEST_RESPONSE,
    RESPONSE,
    RESPONSE_DATA,
    named_interfaces,
)
from ucm_cts.adapters.contract.scenario import Action, Declaration, Hook, Policy, Scenario, Step
from ucm_cts.harness.purposes.derived.connection_steps import ConnectionSteps

Kind = Literal["synchronous", "asynchronous"]
SYNCHRONOUS: Final = "synchronous"
ASYNCHRONOUS: Final = "asynchronous"
KINDS: tuple[Kind, ...] = (SYNCHRONOUS, ASYNCHRONOUS)

ASKED, ANSWERED, INSIDE = "asked", "answered", "inside"
"""Gates: servers pass ``asked`` at each request, clients ``answered`` at each response; ``inside`` is closed until it is opened."""

ELSEWHERE = "elsewhere"
"""Another container than the manager."""

_TYPES = "exchange"
_PORT, _SECOND_PORT = "ask", "more"
_LONG = Integer("LONG")
_EACH = 1000
"""The requests of one client are numbered from a multiple of this."""

_GIVEN = 50_000
"""Responses that a server makes up are numbered from here."""

_ANSWER = 77
"""With this number a server is called to answer; with following ones for its second answer and so on, if it gives them apart."""


@dataclass
class Configuration(ConnectionSteps):
    """A scenario under construction.

    ``server_place``: the container of servers; clients are in the manager.
    ``types``, ``values``: of requests and responses; without values requests are numbers of their own.
    """

    server_place: str = s.MANAGER
    types: tuple[AnyType, AnyType] = (_LONG, _LONG)
    values: tuple[tuple[Datum, ...], tuple[Datum, ...]] | None = None
    components: dict[str, Declaration] = field(default_factory=dict)
    steps: list[Step] = field(default_factory=list)
    kinds: list[Kind] = field(default_factory=list)
    requests: list[int] = field(default_factory=list)
    link: str = "first"
    links: list[str] = field(default_factory=list)
    containers: list[str] = field(default_factory=list)
    awaited: int = 0
    is_running: bool = False

    def __post_init__(self) -> None:
        if self.server_place != s.MANAGER:
            self.container(self.server_place)
        self.connection(self.link)

    # the configuration

    def container(self, name: str) -> Configuration:
        """A further container."""
        self.containers.append(name)
        self.steps.append(s.CreateContainer(name))
        return self

    def connection(self, link: str) -> Configuration:
        """A further connection, which servers and clients that follow belong to."""
        self.link = link
        self.links.append(link)
        self.steps.append(s.Link(REQUEST_RESPONSE, _TYPES, link))
        return self

    def server(
        self, kind: Kind, name: str = "server", held: bool = False, fixed: bool = False, code: str = "ok"
    ) -> Configuration:
        """A server that answers at once: asynchronously with the request itself, or if ``fixed`` with the value for responses."""
        pass_by: tuple[Action, ...] = (s.HoldAtGate(INSIDE),) if held else ()
        value = self.values[1][0] if self.values is not None else _GIVEN
        if kind == SYNCHRONOUS:
            return self._server(kind, name, {"method": (*pass_by, self._at(ASKED), s.Answer(REQUEST, (value, code)))})
        own = (s.Remembered(1, REQUEST, 1),) if fixed else (s.Remembered(0, REQUEST, 0), s.Remembered(1, REQUEST, 1))
        respond = s.CallMethod(f"{_PORT}.server_resp_p", RESPONSE, (value, 0), own)
        return self._server(kind, name, {"method": (*pass_by, self._at(ASKED), respond, s.Answer(REQUEST, (code,)))})

    def storing(
        self, order: Sequence[int], name: str = "server", unknown: int | None = None, apart: bool = False
    ) -> Configuration:
        """An asynchronous server that answers when it is called, in ``order``: all at once, or ``apart``, one at each call; first with an
        ``unknown`` identifier, if there is one.
        """
        port = f"{_PORT}.server_resp_p"
        calls = [
            s.CallMethod(
                port,
                RESPONSE,
                (_GIVEN + 10 * nth + index, 0),
                (s.Remembered(1, REQUEST, 1, nth),),
                given=_ANSWER + index if apart else None,
            )
            for index, nth in enumerate(order)
        ]
        if unknown is not None:
            calls.insert(0, s.CallMethod(port, RESPONSE, (_GIVEN, unknown)))
        plan: dict[Hook, tuple[Action, ...]] = {
            "method": (self._at(ASKED), s.Answer(REQUEST, ("ok",))),
            "exchange": tuple(calls),
        }
        return self._server(ASYNCHRONOUS, name, plan)

    def failing(self, kind: Kind) -> Configuration:
        """A server that raises at each request."""
        return self._server(kind, "server", {"method": (self._at(ASKED), s.RaiseError())})

    def clients(
        self,
        kinds: Sequence[Kind],
        requests: int,
        policies: tuple[Policy, ...] = (),
        holds: bool = False,
        second: str = "",
        place: str = s.MANAGER,
        again: bool = False,
    ) -> Configuration:
        """Clients that make so many requests each when they are called.

        ``holds``: and are held afterwards. ``second``: the connection of a second port of each, through which they make as many.
        ``again``: asynchronous ones make another request whenever they get a response.
        """
        for kind in kinds:
            number = len(self.kinds)
            element = "client_p" if kind == SYNCHRONOUS else "client_req_p"
            links = {_PORT: self.link, **({_SECOND_PORT: second} if second else {})}
            asks: list[Action] = [
                s.CallMethod(f"{port}.{element}", REQUEST, (self._request(number, nth * requests + index),))
                for nth, port in enumerate(links)
                for index in range(requests)
            ]
            once_more = s.CallMethod(f"{_PORT}.{element}", REQUEST, (self._request(number, _EACH - 1),))
            plan: dict[Hook, tuple[Action, ...]] = {
                "exchange": (*asks, *((s.HoldAtGate(INSIDE),) if holds else ())),
                "method": (self._at(ANSWERED), *((once_more,) if again else ()), s.Answer(RESPONSE, ("ok",))),
            }
            if kind == SYNCHRONOUS:
                del plan["method"]
            self._add(f"client {number}", f"rr_{kind}_client", plan, place, policies, links)
            self.kinds.append(kind)
            self.requests.append(len(asks))
        return self

    # what happens

    def start(self, held: bool = False) -> Configuration:
        """Open the gates that bodies only pass, and start all; ``held``: the gate inside stays closed."""
        if not self.is_running:
            self.steps += [s.OpenGate(gate) for gate in self._gates() if gate != INSIDE or not held]
        self.is_running = True
        self.steps += map(s.Start, self._places())
        return self

    def stop(self) -> Configuration:
        """Stop all."""
        self.steps += map(s.Stop, reversed(self._places()))
        return self

    def restart(self) -> Configuration:
        """Stop and start all."""
        return self.stop().start()

    def start_only(self, place: str) -> Configuration:
        """Start one container."""
        self.steps.append(s.Start(place))
        return self

    def stop_only(self, place: str) -> Configuration:
        """Stop one container."""
        self.steps.append(s.Stop(place))
        return self

    def stop_apart(self) -> Configuration:
        """Stop the manager on a thread of its own, and look where that is."""
        self.steps += [s.Stop(s.MANAGER, thread="stopper"), s.Settle("stopper")]
        return self

    def join_stop(self) -> Configuration:
        """Wait for that."""
        self.steps.append(s.Join("stopper"))
        return self

    def ask(self, number: int, wait: bool = True) -> Configuration:
        """A client makes its requests; ``wait`` for what it is to get by callback."""
        self.steps.append(s.Invoke(f"tell {number}", number + 1))
        if wait and self.kinds[number] == ASYNCHRONOUS:
            self.answered(self.requests[number])
        return self

    def ask_apart(self, number: int) -> Configuration:
        """A client makes its requests on a thread of its own."""
        self.steps.append(s.Invoke(f"tell {number}", number + 1, thread=f"asker {number}"))
        return self

    def ask_all(self, *numbers: int) -> Configuration:
        """Clients make their requests at once, each on a thread of its own; look where these are."""
        for number in numbers:
            self.ask_apart(number)
        for number in numbers:
            self.settle(number)
        return self

    def settle(self, number: int) -> Configuration:
        """Look where that thread is."""
        self.steps.append(s.Settle(f"asker {number}"))
        return self

    def join(self, *numbers: int) -> Configuration:
        """Wait for these threads."""
        self.steps += [s.Join(f"asker {number}") for number in numbers]
        return self

    def entered(self, total: int) -> Configuration:
        """Wait until so many requests have entered servers, in all."""
        self.steps.append(s.ReachGate(ASKED, total=total))
        return self

    def at_gate(self) -> Configuration:
        """Wait until a body is held inside."""
        self.steps.append(s.ReachGate(INSIDE, total=1))
        return self

    def answered(self, further: int) -> Configuration:
        """Wait for so many further responses that come by callback."""
        if further:
            self.awaited += further
            self.steps.append(s.ReachGate(ANSWERED, total=self.awaited))
        return self

    def answer(self, callbacks: int, server: str = "server") -> Configuration:
        """A storing server answers; wait for so many callbacks."""
        return self.answer_next(0, callbacks, server)

    def answer_next(self, nth: int, callbacks: int, server: str = "server") -> Configuration:
        """A server that answers apart gives its ``nth`` answer, from 0; wait for so many callbacks."""
        self.steps.append(s.Invoke(f"tell {server}", _ANSWER + nth))
        return self.answered(callbacks)

    def answer_at_once(self, count: int) -> Configuration:
        """A server that answers apart gives so many answers, each on a thread of its own; wait for as many callbacks."""
        threads = [f"answerer {nth}" for nth in range(count)]
        self.steps += [s.Invoke("tell server", _ANSWER + nth, thread=name) for nth, name in enumerate(threads)]
        self.steps += map(s.Join, threads)
        return self.answered(count)

    def open(self, gate: str) -> Configuration:
        """Open a gate."""
        self.steps.append(s.OpenGate(gate))
        return self

    def remove_server(self) -> Configuration:
        """Detach and remove the server, which is called so; all are stopped."""
        self.steps += [s.Detach(self.link, "server", _PORT), s.RemoveComponent("server")]
        return self

    def remove(self, number: int) -> Configuration:
        """Detach and remove a client; all are stopped."""
        name = f"client {number}"
        self.steps += [s.Detach(self.link, name, _PORT), s.RemoveComponent(name)]
        return self

    def end(self) -> Scenario:
        """The scenario: everything is stopped."""
        if INSIDE in self._gates() and not any(isinstance(x, s.OpenGate) and x.gate == INSIDE for x in self.steps):
            self.steps.append(s.OpenGate(INSIDE))
        stops = [s.Stop(place) for place in reversed(self._places())]
        types = {REQUEST_DATA: self.types[0], RESPONSE_DATA: self.types[1]}
        return Scenario(
            self.components,
            (*self.steps, *stops, s.GetComponents()),
            interfaces=named_interfaces(_TYPES, types),
            types={_TYPES: types},
        )

    def _server(self, kind: Kind, name: str, plan: dict[Hook, tuple[Action, ...]]) -> Configuration:
        self._add(name, f"rr_{kind}_server", plan, self.server_place)
        return self

    def _add(
        self,
        name: str,
        role: str,
        plan: dict[Hook, tuple[Action, ...]],
        place: str,
        policies: tuple[Policy, ...] = (),
        links: Mapping[str, str] | None = None,
    ) -> None:
        """A component with a port by which the test calls it, and one of that kind, or those of ``links``, with their connections."""
        links = links or {_PORT: self.link}
        elements = CONNECTOR_PORTS[role].elements
        ports = {f"{port}.{e.name}": e for port in links for e in elements}
        declaration = Declaration(
            ("in.api", *(port for port, e in ports.items() if e.provided)),
            tuple(port for port, e in ports.items() if not e.provided),
            plan=plan,
            policies=policies,
            ports={port: f"{_TYPES}.{e.interface}" for port, e in ports.items()},
        )
        self.components[name] = declaration
        tell = name.replace("client", "tell") if "client" in name else f"tell {name}"
        self.steps += [
            s.AddComponent(name, place),
            *(s.Attach(link, role, name, port, place) for port, link in links.items()),  # type: ignore[arg-type]
            s.GetPortElement(name, "in.api", tell, place),
        ]

    def _request(self, client: int, index: int) -> Datum:
        return self.values[0][0] if self.values is not None else (client + 1) * _EACH + index

    def _places(self) -> list[str]:
        return [*self.containers, s.MANAGER]

    def _gates(self) -> list[str]:
        plans = [a for c in self.components.values() for plan in c.plan.values() for a in plan]
        return sorted({a.gate for a in plans if isinstance(a, s.HoldAtGate)})

    @staticmethod
    def _at(gate: str) -> s.HoldAtGate:
        return s.HoldAtGate(gate)
