"""Contention: components use what is shared at the same time, so often that a loss or a mixture shows (``suite/contention.yaml``).

Each component is called on a thread of its own and waits at a gate; when all are there the gate opens, and each uses the clock,
the log, a peer, a server or a message connector again and again, with values of its own.
"""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Integer, Interface, Method, Parameter, message_interface
from ucm_cts.adapters.contract.scenario import Action, Declaration, Policy, Scenario, Step
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import read
from ucm_cts.harness.catalogue.requirements import SUITE
from ucm_cts.harness.purposes.connections import MESSAGE, SERVICE, provided_end, required_end
from ucm_cts.harness.purposes.container_services import CLOCK, HAS_CLOCK, HAS_TRACE, TRACE
from ucm_cts.harness.purposes.scripts import TestPurpose

_UNPROTECTED = Policy(s.UNPROTECTED_PASSIVE)
_NUMBER = Integer("ULONG")
_INTERFACES = {
    "numbers": message_interface(_NUMBER),
    "adder": Interface({"serve": Method((Parameter("given", "INOUT", _NUMBER),))}),
}
_READY = "ready"
_PAUSE = 1
"""Milliseconds around the use of clocks, in which the host reads its own."""


class Contention(Value, frozen=True):
    """``suite/contention.yaml``.

    ``callers``: how many components at once.
    ``uses``: how often each uses what is shared.
    """

    callers: tuple[int, ...]
    uses: int


def load_contention() -> Contention:
    """The table of the suite."""
    return read(SUITE / "contention.yaml", Contention)


def contention_purposes() -> list[TestPurpose]:
    """Calls between components, which profile container has, too."""
    table = load_contention()
    scenarios = tuple(
        (f"contention/calls of {clients} components", _calls(clients, table.uses)) for clients in table.callers
    )
    text = "Components call one peer at the same time, again and again."
    return [TestPurpose("contention/calls", "11.1.3", text, ("R-11.1.3-01",), scenarios)]


def service_contention_purposes() -> list[TestPurpose]:
    """What the core provides: clock, log and both connectors."""
    table = load_contention()
    purposes = []
    for what, (clause, requirements, make) in {
        "clock": ("10.1.4.1", ("R-10.1.4.1-06", "R-10.1.4.1-08", "R-10.1.4.1-10"), _clocks),
        "log": ("10.1.4.2", ("R-10.1.4.2-26", "R-10.1.4.2-25", "R-10.1.4.2-51", "R-10.1.4.2-53"), _logs),
        "service": ("10.1.5.1", ("R-10.1.5.1-04", "R-10.1.5.1-01", "R-10.1.5.1-03"), _services),
        "messages": ("10.1.2", ("R-10.1.2-09", "R-10.1.2-10"), _messages),
    }.items():
        scenarios = tuple(
            (f"contention/{what} of {users} components", make(users, table.uses)) for users in table.callers
        )
        text = f"Components use the {what} at the same time, again and again."
        purposes.append(TestPurpose(f"contention/{what}", clause, text, requirements, scenarios))
    return purposes


def _calls(clients: int, uses: int) -> Scenario:
    components = {"server": Declaration(("in.api",))}
    steps: list[Step] = [s.AddComponent("server"), s.GetPortElement("server", "in.api", "to server")]
    for number, name in enumerate(_users(clients)):
        actions = tuple(s.CallPort("out.api", 1000 * number + use) for use in range(uses))
        components[name] = Declaration(("in.api",), ("out.api",), plan={"exchange": (s.HoldAtGate(_READY), *actions)})
        steps += [s.AddComponent(name), s.Connect(name, "out.api", "to server", f"link of {name}")]
    return Scenario(components, (*steps, *_at_once(clients)))


def _clocks(users: int, uses: int) -> Scenario:
    actions: tuple[Action, ...] = tuple(
        s.CallMethod(CLOCK, method) for _ in range(uses) for method in ("get_local_time", "get_synchronized_time")
    )
    reader = Declaration(
        ("in.api",),
        plan={"exchange": (s.HoldAtGate(_READY), *actions)},
        policies=(_UNPROTECTED, HAS_CLOCK),
    )
    steps = [s.AddComponent(name) for name in _users(users)]
    return Scenario(dict.fromkeys(_users(users), reader), (*steps, *_at_once(users, s.Pause(_PAUSE))))


def _logs(users: int, uses: int) -> Scenario:
    severities = ("debug", "info", "warning", "error")
    components = {}
    for number, name in enumerate(_users(users)):
        actions = tuple(
            s.CallMethod(TRACE, "log", (severities[(number + use) % 4], f"message{number}x{use}"))
            for use in range(uses)
        )
        components[name] = Declaration(
            ("in.api",),
            plan={"exchange": (s.HoldAtGate(_READY), *actions)},
            policies=(_UNPROTECTED, HAS_TRACE),
        )
    steps = [s.AddComponent(name) for name in components]
    return Scenario(components, (*steps, *_at_once(users, s.ReadLog(users * uses))))


def _services(clients: int, uses: int) -> Scenario:
    answer = Declaration(
        ("in.api",), policies=(_UNPROTECTED,), plan={"method": (s.Answer("serve"),)}, ports={"in.api": "adder"}
    )
    components = {"server": answer}
    steps: list[Step] = [
        s.Link(SERVICE, "adder", "line"),
        s.AddComponent("server"),
        provided_end(SERVICE, "line", "server"),
    ]
    for number, name in enumerate(_users(clients)):
        actions = tuple(s.CallMethod("out.api", "serve", (1000 * number + use,)) for use in range(uses))
        components[name] = _user(actions, "adder")
        steps += [s.AddComponent(name), required_end(SERVICE, "line", name)]
    return Scenario(components, (*steps, *_at_once(clients)), interfaces={"adder": _INTERFACES["adder"]})


def _messages(emitters: int, uses: int) -> Scenario:
    receiver = Declaration(
        ("in.api",),
        policies=(_UNPROTECTED,),
        plan={"method": (s.HoldAtGate("arrived"), s.Answer(s.PUSH, ("ok",)))},
        ports={"in.api": "numbers"},
    )
    components = {"receiver": receiver}
    steps: list[Step] = [
        s.Link(MESSAGE, "numbers", "line"),
        s.AddComponent("receiver"),
        provided_end(MESSAGE, "line", "receiver"),
    ]
    for number, name in enumerate(_users(emitters)):
        actions = tuple(s.CallMethod("out.api", s.PUSH, (1000 * number + use,)) for use in range(uses))
        components[name] = _user(actions, "numbers")
        steps += [s.AddComponent(name), required_end(MESSAGE, "line", name)]
    arrived = s.ReachGate("arrived", total=emitters * uses)
    calls = (s.OpenGate("arrived"), *_at_once(emitters, arrived))
    return Scenario(components, (*steps, *calls), interfaces={"numbers": _INTERFACES["numbers"]})


def _user(actions: tuple[Action, ...], interface: str) -> Declaration:
    plan: dict[s.Hook, tuple[Action, ...]] = {"exchange": (s.HoldAtGate(_READY), *actions)}
    return Declaration(("in.api",), ("out.api",), plan=plan, policies=(_UNPROTECTED,), ports={"out.api": interface})


def _users(count: int) -> list[str]:
    return [f"user {number}" for number in range(count)]


def _at_once(count: int, *afterwards: Step) -> Iterator[Step]:
    """Start all, call each on its own thread, let them go together, and stop when all are done."""
    names = _users(count)
    yield from (s.GetPortElement(name, "in.api", f"to {name}") for name in names)
    yield s.Start()
    yield from (step for step in afterwards if isinstance(step, s.Pause))
    for number, name in enumerate(names):
        yield s.Invoke(f"to {name}", number + 1, thread=name)
        yield s.ReachGate(_READY)
    yield s.OpenGate(_READY)
    yield from map(s.Join, names)
    yield from afterwards
    yield s.Stop()
