"""Boundaries of what the core provides: few and many self-executing components, clients, emitters, receivers, calls and records."""

from __future__ import annotations

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import (
    AnyType,
    Datum,
    Integer,
    Interface,
    Method,
    Parameter,
    Sequence,
    String,
    message_interface,
)
from ucm_cts.adapters.contract.scenario import Declaration, Policy, Scenario, Step
from ucm_cts.harness.purposes.connections import MESSAGE, SERVICE, provided_end, required_end
from ucm_cts.harness.purposes.container_services import HAS_TRACE, TRACE
from ucm_cts.harness.purposes.data.corner_values import LONG_STRING
from ucm_cts.harness.purposes.provocations.boundaries import load_boundaries
from ucm_cts.harness.purposes.scripts import TestPurpose

_UNPROTECTED = Policy(s.UNPROTECTED_PASSIVE)
_NUMBER = Integer("ULONG")
_SERVICE = Interface({"serve": Method((Parameter("given", "INOUT", _NUMBER),))})
_SERVER = Declaration(
    ("in.api",), policies=(_UNPROTECTED,), plan={"method": (s.Answer("serve"),)}, ports={"in.api": "service"}
)
_RUNNER = Declaration(("in.api",), policies=(Policy(s.SELF_EXECUTING),), plan={"run": (s.HoldAtGate("ran"),)})
_LONGEST_SEQUENCE = 4097
"""The most elements of a sequence that are carried: a trace holds each of them several times."""

_MOST = 8
"""The most components of a kind. Calls and records have no such limit."""


def core_boundary_purposes() -> list[TestPurpose]:
    """One purpose for each thing that is counted."""
    counts = [count for count in load_boundaries().counts if count]
    few = [count for count in counts if count <= _MOST]
    purposes = []
    for what, (clause, requirements, make, some) in {
        "self-executing components": ("10.1.3.2", ("R-10.1.3.2-01", "R-10.1.3.2-03"), _runners, few),
        "phases of a self-executing component": ("10.1.3.2", ("R-10.1.3.2-01",), _running_phases, few),
        "clients of a server": ("10.1.5.1", ("R-10.1.5.1-03", "R-10.1.5.1-01"), _clients, few),
        "calls of a client": ("10.1.5.1", ("R-10.1.5.1-01",), _service_calls, counts),
        "phases of a server": ("10.1.5.1", ("R-10.1.5.1-01",), _serving_phases, few),
        "services of a component": ("10.1.5.1", ("R-10.1.5.1-01", "R-10.1.5.1-13"), _services, few),
        "emitters of a connection": ("10.1.6.1", ("R-10.1.6.1-03", "R-10.1.6.1-10"), _emitters, few),
        "receivers of a connection": ("10.1.6.1", ("R-10.1.6.1-04",), _receivers, few),
        "receivers of which one leaves": ("10.1.2", ("R-10.1.2-10",), _leaving_receivers, [c for c in few if c > 1]),
        "records": ("10.1.4.2", ("R-10.1.4.2-26",), _records, counts),
    }.items():
        name = f"boundary/{what}"
        text = f"There are {', '.join(map(str, some))} {what}."
        scenarios = tuple((f"boundary/{count} {what}", make(count)) for count in some)
        purposes.append(TestPurpose(name, clause, text, requirements, scenarios))
    purposes.append(_sizes())
    text = f"A component that runs again and again is started {', '.join(map(str, few))} times; each phase has a run of its own."
    name = "boundary/phases with runs"
    scenarios = tuple((f"boundary/{count} phases with runs", _running_phases(count, again=True)) for count in few)
    purposes.append(TestPurpose(name, "10.1.3.2", text, ("R-10.1.3.2-01",), scenarios, under=("run-trigger=repeated",)))
    return purposes


def _sizes() -> TestPurpose:
    """Long texts and sequences, in services and in messages; shorter ones are corner values of their types (harness/purposes/data/)."""
    sizes = [size for size in load_boundaries().sizes if size > LONG_STRING]
    some = [size for size in sizes if size <= _LONGEST_SEQUENCE]
    texts = tuple("x" * (size - 1) + "y" for size in sizes)
    numbers = tuple([*range(size - 1), size] for size in some)
    scenarios = (
        ("boundary/texts of many sizes in services", _echoed(String("CHAR8"), texts)),
        ("boundary/texts of many sizes in messages", _pushed(String("CHAR8"), texts)),
        ("boundary/sequences of many sizes in messages", _pushed(Sequence(_NUMBER), numbers)),
    )
    text = f"Texts of {_list(sizes)} characters and sequences of {_list(some)} elements are carried."
    return TestPurpose("boundary/sizes of values", "10.1.1", text, ("R-10.1.1-11", "R-10.1.1-16"), scenarios)


def _list(numbers: list[int]) -> str:
    return ", ".join(map(str, numbers))


def _echoed(of: AnyType, values: tuple[Datum, ...]) -> Scenario:
    """A client calls with each of ``values`` and gets it back."""
    interfaces = {"service": Interface({"serve": Method((Parameter("given", "INOUT", of),))})}
    calls = tuple(s.CallMethod("out.api", "serve", (value,)) for value in values)
    client = msgspec.structs.replace(_user(calls[0], "service"), plan={"exchange": calls})
    return Scenario({"server": _SERVER, "client": client}, _ECHO, interfaces=interfaces)


def _pushed(of: AnyType, values: tuple[Datum, ...]) -> Scenario:
    """An emitter pushes each of ``values`` to a receiver."""
    pushes = tuple(s.CallMethod("out.api", s.PUSH, (value,)) for value in values)
    scenario = _with_messages(1, 1)
    emitter = msgspec.structs.replace(scenario.components["emitter 0"], plan={"exchange": pushes})
    steps = tuple(
        msgspec.structs.replace(step, total=len(values)) if isinstance(step, s.ReachGate) else step
        for step in scenario.steps
    )
    components = {**scenario.components, "emitter 0": emitter}
    return Scenario(components, steps, interfaces={"numbers": message_interface(of)})


_ECHO: tuple[Step, ...] = (
    s.Link(SERVICE, "service", "line"),
    s.AddComponent("server"),
    provided_end(SERVICE, "line", "server"),
    s.AddComponent("client"),
    required_end(SERVICE, "line", "client"),
    s.GetPortElement("client", "in.api", "to client"),
    s.Start(),
    s.Invoke("to client", 1),
    s.Stop(),
)


def _runners(count: int) -> Scenario:
    """Each runs: it passes a gate that is open, under a name of its own."""
    names = [f"runner {number}" for number in range(count)]
    components = {
        name: Declaration(("in.api",), policies=_RUNNER.policies, plan={"run": (s.HoldAtGate(f"ran {name}"),)})
        for name in names
    }
    steps: list[Step] = [s.AddComponent(name) for name in names]
    steps += [s.OpenGate(f"ran {name}") for name in names]
    steps += [s.Start(), *(s.ReachGate(f"ran {name}") for name in names), s.Stop()]
    return Scenario(components, tuple(steps))


def _running_phases(count: int, again: bool = False) -> Scenario:
    """Each phase ends when there have been as many runs; if there are more of them in one phase, ``again`` waits for another one."""
    phases = (
        (s.Start(), s.ReachGate("ran", more=1) if again else s.ReachGate("ran", total=number), s.Stop())
        for number in range(1, count + 1)
    )
    steps = (s.AddComponent("runner"), s.OpenGate("ran"), *(step for phase in phases for step in phase))
    return Scenario({"runner": _RUNNER}, steps)


def _clients(count: int) -> Scenario:
    return _with_clients(count, (s.Start(), *(_call(name) for name in _clients_named(count)), s.Stop()))


def _service_calls(count: int) -> Scenario:
    return _with_clients(1, (s.Start(), *(_call("client 0", number) for number in range(count)), s.Stop()))


def _serving_phases(count: int) -> Scenario:
    phases = tuple(step for number in range(count) for step in (s.Start(), _call("client 0", number), s.Stop()))
    return _with_clients(1, phases)


def _with_clients(count: int, calls: tuple[Step, ...]) -> Scenario:
    components = {"server": _SERVER}
    steps: list[Step] = [s.Link(SERVICE, "service", "line"), s.AddComponent("server")]
    steps.append(provided_end(SERVICE, "line", "server"))
    for number, name in enumerate(_clients_named(count)):
        components[name] = _user(s.CallMethod("out.api", "serve", (number + 1,)), "service")
        steps += [s.AddComponent(name), required_end(SERVICE, "line", name)]
        steps.append(s.GetPortElement(name, "in.api", f"to {name}"))
    return Scenario(components, (*steps, *calls), interfaces={"service": _SERVICE})


def _services(count: int) -> Scenario:
    """One component serves on so many ports, each with a client."""
    ports = [f"s{number}.api" for number in range(count)]
    server = Declaration(
        tuple(ports),
        policies=(_UNPROTECTED,),
        plan={"method": (s.Answer("serve"),)},
        ports=dict.fromkeys(ports, "service"),
    )
    components = {"server": server}
    steps: list[Step] = [s.AddComponent("server")]
    for number, port in enumerate(ports):
        name = f"client {number}"
        components[name] = _user(s.CallMethod("out.api", "serve", (number + 1,)), "service")
        steps += [s.Link(SERVICE, "service", f"line {number}"), provided_end(SERVICE, f"line {number}", "server", port)]
        steps += [s.AddComponent(name), required_end(SERVICE, f"line {number}", name)]
        steps.append(s.GetPortElement(name, "in.api", f"to {name}"))
    calls = (s.Start(), *(_call(name) for name in _clients_named(count)), s.Stop())
    return Scenario(components, (*steps, *calls), interfaces={"service": _SERVICE})


def _clients_named(count: int) -> list[str]:
    return [f"client {number}" for number in range(count)]


def _call(client: str, value: int = 1) -> Step:
    return s.Invoke(f"to {client}", value)


def _emitters(count: int) -> Scenario:
    return _with_messages(count, 1)


def _receivers(count: int) -> Scenario:
    return _with_messages(1, count)


def _leaving_receivers(count: int) -> Scenario:
    """Before the second start the first receiver is detached; the others get what is pushed then."""
    first = "receiver 0"
    again: tuple[Step, ...] = (
        s.Detach("line", first, "in.api"),
        s.RemoveComponent(first),
        s.Start(),
        s.Invoke("to emitter 0", 2),
    )
    arrivals: tuple[Step, ...] = tuple(s.ReachGate(f"at receiver {number}", total=2) for number in range(1, count))
    return _with_messages(1, count, (*again, *arrivals, s.Stop()))


def _with_messages(emitters: int, receivers: int, afterwards: tuple[Step, ...] = ()) -> Scenario:
    components: dict[str, Declaration] = {}
    steps: list[Step] = [s.Link(MESSAGE, "numbers", "line")]
    for number in range(receivers):
        name = f"receiver {number}"
        plan: tuple[s.Action, ...] = (s.HoldAtGate(f"at {name}"), s.Answer(s.PUSH, ("ok",)))
        components[name] = Declaration(
            ("in.api",), policies=(_UNPROTECTED,), plan={"method": plan}, ports={"in.api": "numbers"}
        )
        steps += [s.AddComponent(name), provided_end(MESSAGE, "line", name), s.OpenGate(f"at {name}")]
    for number in range(emitters):
        name = f"emitter {number}"
        components[name] = _user(s.CallMethod("out.api", s.PUSH, (number + 1,)), "numbers")
        steps += [s.AddComponent(name), required_end(MESSAGE, "line", name)]
        steps.append(s.GetPortElement(name, "in.api", f"to {name}"))
    calls: tuple[Step, ...] = (s.Start(), *(s.Invoke(f"to emitter {number}", number + 1) for number in range(emitters)))
    arrivals: tuple[Step, ...] = tuple(
        s.ReachGate(f"at receiver {number}", total=emitters) for number in range(receivers)
    )
    interfaces = {"numbers": message_interface(_NUMBER)}
    return Scenario(components, (*steps, *calls, *arrivals, s.Stop(), *afterwards), interfaces=interfaces)


def _user(action: s.Action, interface: str) -> Declaration:
    return Declaration(
        ("in.api",), ("out.api",), plan={"exchange": (action,)}, policies=(_UNPROTECTED,), ports={"out.api": interface}
    )


def _records(count: int) -> Scenario:
    writes = tuple(s.CallMethod(TRACE, "log", ("info", f"record{number}")) for number in range(count))
    policies = (_UNPROTECTED, HAS_TRACE)
    writer = Declaration(("in.api",), plan={"exchange": writes}, policies=policies)
    steps = (
        s.AddComponent("writer"),
        s.GetPortElement("writer", "in.api", "to writer"),
        s.Start(),
        s.Invoke("to writer", 1),
        s.ReadLog(count),
        s.Stop(),
    )
    return Scenario({"writer": writer}, steps)
