"""Scenarios of periodic and sporadic active components that are called, or get messages, through connectors (10.5)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Scenario, Step
from ucm_cts.harness.purposes.connections import (
    INTERFACES,
    MESSAGE,
    SERVE,
    SERVICE,
    Connector,
    provided_end,
    required_end,
)
from ucm_cts.harness.purposes.derived.paced_calls import APART, EACH_ONCE
from ucm_cts.harness.purposes.derived.paced_policies import NAMES, PORT, policy, purposes_about
from ucm_cts.harness.purposes.scripts import TestPurpose

_PERIODIC, _SPORADIC = s.PERIODIC_ACTIVE, s.SPORADIC_ACTIVE

_PERIOD = 50
"""Milliseconds."""

_GOT = "got"
_VALUES = (11, 22, 33)
_INTERFACE = "numbers"
_PROVIDED = {MESSAGE: "message.api", SERVICE: "service.api"}


def paced_connection_purposes() -> list[TestPurpose]:
    """Three messages, and three calls of a service, of both policies: far apart, and at once."""
    purposes = []
    for definition in (_PERIODIC, _SPORADIC):
        name, own = NAMES[definition], EACH_ONCE[definition]
        # early ones may be dropped or refused, unless they are declared to wait
        at_once = "early-invocation=delayed" if definition == _SPORADIC else ""
        apart = ("far apart", _scenario(MESSAGE, definition, _PERIOD + 20))
        purposes.append(purposes_about(f"{name}/messages", own, apart))
        together = ("three", _scenario(MESSAGE, definition, 0))
        purposes.append(purposes_about(f"{name}/messages at once", own, together, under=at_once))
        cases = [("far apart", _scenario(SERVICE, definition, _PERIOD + 20))]
        cases.append(("by one client, at once", _scenario(SERVICE, definition, 0)))
        cases.append(("by three clients, at once", _clients(definition)))
        purposes.append(purposes_about(f"{name}/services", f"{own} {APART[definition]}", *cases))
    return purposes


def _receiver(connector: Connector, definition: str) -> Declaration:
    """A component whose port element behind ``connector`` is paced; what comes there passes the gate."""
    port = _PROVIDED[connector]
    answer = (s.Answer(s.PUSH, ("ok",)),) if connector == MESSAGE else ()
    return Declaration(
        (port,),
        policies=(policy(definition, _PERIOD, port=port),),
        plan={"method": (s.HoldAtGate(_GOT), *answer)},
        ports={port: _INTERFACE},
    )


def _sender(connector: Connector, told: bool) -> Declaration:
    """A component that sends all values when it is called, or only the one that it is ``told``."""
    method = s.PUSH if connector == MESSAGE else SERVE
    sent = tuple(s.CallMethod("out.api", method, (n,), given=n if told else None) for n in _VALUES)
    return Declaration((PORT,), ("out.api",), plan={"exchange": sent}, ports={"out.api": _INTERFACE})


def _connected(connector: Connector, *senders: str) -> tuple[Step, ...]:
    """The receiver and ``senders``, added, connected, and started; each sender is told by its name."""
    steps: list[Step] = [s.AddComponent(name) for name in ("receiver", *senders)]
    steps += [
        s.Link(connector, _INTERFACE, "line"),
        provided_end(connector, "line", "receiver", _PROVIDED[connector]),
    ]
    for name in senders:
        steps += [required_end(connector, "line", name), s.GetPortElement(name, PORT, name)]
    return (*steps, s.OpenGate(_GOT), s.Start())


def _scenario(connector: Connector, definition: str, between: int) -> Scenario:
    """So many milliseconds pass between two values; if 0, one call of the test sends all."""
    components = {"receiver": _receiver(connector, definition), "sender": _sender(connector, bool(between))}
    told: list[Step]
    if between:
        told = [
            step
            for count, n in enumerate(_VALUES, 1)
            for step in (s.Invoke("sender", n), s.ReachGate(_GOT, total=count), s.Pause(between))
        ]
    elif connector == MESSAGE:  # the call may come back before the messages have been executed
        told = [s.Invoke("sender", 1), s.ReachGate(_GOT, total=len(_VALUES))]
    else:
        told = [s.Invoke("sender", 1)]
    steps = (*_connected(connector, "sender"), *told, s.Stop())
    return Scenario(components, steps, interfaces={_INTERFACE: INTERFACES[connector]})


def _clients(definition: str) -> Scenario:
    """Each of three clients calls once, at one time."""
    clients = tuple(f"client {n}" for n in _VALUES)
    components = {"receiver": _receiver(SERVICE, definition), **dict.fromkeys(clients, _sender(SERVICE, told=True))}
    calls = (s.Invoke(name, n, thread=name) for name, n in zip(clients, _VALUES, strict=True))
    steps = (*_connected(SERVICE, *clients), *calls, *map(s.Join, clients), s.Stop())
    return Scenario(components, steps, interfaces={_INTERFACE: INTERFACES[SERVICE]})
