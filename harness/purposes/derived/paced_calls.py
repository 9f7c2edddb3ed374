"""Scenarios of active components that are executed each period, or with a least distance, when they are called (10.5)."""

from __future__ import annotations

import functools
from collections.abc import Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Hook, Policy, Scenario, Step
from ucm_cts.harness.purposes.container_services import HAS_CLOCK
from ucm_cts.harness.purposes.derived.paced_policies import NAMES, OTHER_PORT, PORT, policy, purposes_about
from ucm_cts.harness.purposes.derived.through_components import through_components
from ucm_cts.harness.purposes.scripts import TestPurpose

_INSIDE = "inside"
_PERIODIC, _SPORADIC = s.PERIODIC_ACTIVE, s.SPORADIC_ACTIVE

_USUAL, _WIDE, _LONG = 50, 100, 300
"""Periods in milliseconds. With the long one lateness shows."""

_BESIDE = {
    "a clock": HAS_CLOCK,
    "a trace of the port": Policy(s.PORT_TRACE, PORT, {s.METHODS_TO_TRACE: "exchange", s.LOG_SEVERITY: "info"}),
}
"""Other policies that the component has."""

_BURST = 5
_MANY, _IDLE = 12, 12
"""So many calls at once, and so many periods without a call before a burst."""

APART = {_PERIODIC: "2-10 2-11 2-12", _SPORADIC: "2-15 2-16 2-17"}
EACH_ONCE = {_PERIODIC: "2-08 2-09", _SPORADIC: "2-13 2-14"}
"""The requirements on distances, and on single executions, of each policy."""


def paced_call_purposes() -> list[TestPurpose]:
    """Bursts, single calls, offsets, long executions, phases, several components; of both policies."""
    purposes = [_offsets(), through_components(_offsets())]
    for definition in (_PERIODIC, _SPORADIC):
        purposes += [of(definition) for of in (_bursts, _single, _held, _phases, _several)]
        purposes.append(through_components(_held(definition)))
    return purposes


def _server(*policies: Policy, plan: dict[Hook, tuple[s.Action, ...]] | None = None) -> Declaration:
    return Declaration((PORT, OTHER_PORT), policies=policies, plan=plan or {})


def _scenario(server: Declaration, *steps: Step) -> Scenario:
    """The server is called at ``api`` and ``aux``, started before ``steps`` and stopped after them."""
    begin = (
        s.AddComponent("server"),
        s.GetPortElement("server", PORT, "api"),
        s.GetPortElement("server", OTHER_PORT, "aux"),
        s.Start(),
    )
    return Scenario({"server": server}, (*begin, *steps, s.Stop(), s.GetComponents()))


def _calls(*refs: str, first: int = 1) -> tuple[Step, ...]:
    """Each reference is called by a thread of its own."""
    return tuple(s.Invoke(ref, first + n, thread=f"caller {first + n}") for n, ref in enumerate(refs))


def _joins(count: int, first: int = 1) -> tuple[Step, ...]:
    return tuple(s.Join(f"caller {first + n}") for n in range(count))


def _both(definition: str, period: float, offset: float = 0) -> tuple[Policy, ...]:
    return tuple(policy(definition, period, offset, port=port) for port in (PORT, OTHER_PORT))


def _bursts(definition: str) -> TestPurpose:
    """Five at once, on one port element, on two, one after the other, and twice."""
    cases = []
    server = _server(policy(definition, _USUAL))
    one = (*_calls(*["api"] * _BURST), *_joins(_BURST))
    cases.append(("one port", _scenario(server, *one)))
    two = (*_calls("api", "aux", "api", "aux", "api"), *_joins(_BURST))
    cases.append(("two ports", _scenario(_server(*_both(definition, _USUAL)), *two)))
    cases.append(("after a while", _scenario(server, s.Pause(2 * _USUAL + 20), *one)))
    idle = (*_burst_of(["api"], 1), s.Pause(_IDLE * _USUAL), *_burst_of(["api"] * 3, 11))
    cases.append(("after a long while", _scenario(server, *idle)))
    cases.append((f"{_MANY} at once", _scenario(server, *_calls(*["api"] * _MANY), *_joins(_MANY))))
    for what, further in _BESIDE.items():
        cases.append((f"beside {what}", _scenario(_server(policy(definition, _USUAL), further), *one)))
    again = (*one, s.Pause(_USUAL), *_calls("api", "api", first=11), *_joins(2, 11))
    cases.append(("again", _scenario(server, *again)))
    in_turn = tuple(s.Invoke("api", n) for n in range(1, _BURST + 1))
    cases.append(("one after the other", _scenario(server, *in_turn)))
    raising = _server(policy(definition, _USUAL), plan={"exchange": (s.RaiseError(),)})
    cases.append(("calls that raise", _scenario(raising, *_calls("api", "api", "api"), *_joins(3), *in_turn)))
    slow = _server(policy(definition, _LONG))
    for early in (20, 150):
        cases.append((f"a long period, after {early} ms", _scenario(slow, s.Pause(early), *_burst_of(["api"] * 3, 1))))
    return purposes_about(f"{NAMES[definition]}/bursts", f"{EACH_ONCE[definition]} {APART[definition]}", *cases)


def _single(definition: str) -> TestPurpose:
    """Calls at several moments of a period, and with a long one."""
    cases = []
    server = _server(policy(definition, _WIDE))
    for early, later in ((20, 30), (60, 20), (5, 90)):
        steps = (s.Pause(early), *_calls("api"), s.Pause(later), *_calls("api", first=2), *_joins(2))
        cases.append((f"after {early} and {early + later} ms", _scenario(server, *steps)))
    slow = _server(policy(definition, _LONG))
    steps = (*_calls("api"), *_joins(1), s.Pause(20), *_calls("api", first=2), *_joins(1, 2))
    cases.append(("a long period", _scenario(slow, *steps)))
    steps = (*_calls("api"), *_joins(1), s.Pause(_LONG + 40), *_calls("api", first=2), *_joins(1, 2))
    cases.append(("a long period, and longer pause", _scenario(slow, *steps)))
    steps = (*_calls("api"), *_joins(1), s.Pause(_LONG + _LONG // 2), *_calls("api", first=2), *_joins(1, 2))
    cases.append(("a long period, and half of one more", _scenario(slow, *steps)))
    unmanaged = (*_calls("aux", "aux"), *_joins(2), *_calls("api", first=3), *_joins(1, 3))
    cases.append(("beside a port that is not managed", _scenario(server, *unmanaged)))
    cases.append(("no call", _scenario(_server(*_both(definition, 10)), s.Pause(120))))
    return purposes_about(f"{NAMES[definition]}/single calls", f"{EACH_ONCE[definition]} {APART[definition]}", *cases)


def _offsets() -> TestPurpose:
    """Calls wait from the start on."""
    cases = []
    for offset, period in ((0, _USUAL), (20, _USUAL), (180, _USUAL), (250, 30)):
        server = _server(policy(_PERIODIC, period, offset))
        cases.append((f"{offset} ms", _scenario(server, *_calls("api", "api"), *_joins(2))))
    server = _server(policy(_PERIODIC, _USUAL, 170))
    later = (s.Pause(280), *_calls("api", "api"), *_joins(2))
    cases.append(("has passed", _scenario(server, *later)))
    return purposes_about(f"{NAMES[_PERIODIC]}/offsets", "1-22 1-30 2-10", *cases)


def _held(definition: str) -> TestPurpose:
    """An execution is held across several periods, or for a part of one, while others wait."""
    cases = []
    plan: dict[Hook, tuple[s.Action, ...]] = {"exchange": (s.HoldAtGate(_INSIDE),)}
    for name, policies, other in (
        ("one port", (policy(definition, _USUAL),), "api"),
        ("two ports", _both(definition, _USUAL), "aux"),
    ):
        steps = (
            *_calls("api"),
            s.ReachGate(_INSIDE),
            *_calls(other, first=2),
            s.Settle("caller 2"),
            s.Pause(3 * _USUAL),
            *_calls("api", first=3),
            s.OpenGate(_INSIDE),
            *_joins(3),
        )
        cases.append((name, _scenario(_server(*policies, plan=plan), *steps)))
    unmanaged = (
        *_calls("aux"),
        s.ReachGate(_INSIDE),
        *_calls("api", first=2),
        s.Pause(3 * _USUAL),
        s.Settle("caller 2"),
        s.OpenGate(_INSIDE),
        *_joins(2),
    )
    cases.append(("a port that is not managed", _scenario(_server(policy(definition, _USUAL), plan=plan), *unmanaged)))
    brief = (*_calls("api"), s.ReachGate(_INSIDE), *_calls("api", first=2), s.Settle("caller 2"))
    let_go = (s.Pause(_LONG // 6), s.OpenGate(_INSIDE), *_joins(2))
    cases.append(("a part of a period", _scenario(_server(policy(definition, _LONG), plan=plan), *brief, *let_go)))
    own = APART[definition].split()[0 if definition == _SPORADIC else 2]
    return purposes_about(f"{NAMES[definition]}/long executions", f"2-19 {own}", *cases)


def _phases(definition: str) -> TestPurpose:
    """The component is stopped while calls wait, and started again."""
    server = _server(policy(definition, _LONG))
    waiting = _calls("api", "api", "api")
    pending = (s.Invoke("api", 9, thread="first"), s.Pause(20), *waiting, s.Pause(20))
    stopped = (*pending, s.Stop(), s.Join("first"), *_joins(3), s.Pause(_LONG + 50))
    cases = [("stop while calls wait", _scenario(server, *stopped))]
    cases.append(("restart after calls waited", _scenario(server, *stopped[:-1], s.Start(), s.Pause(2 * _LONG + 50))))
    removed = (*stopped[:-1], s.RemoveComponent("server"), s.Pause(_LONG + 50))
    cases.append(("removal", _scenario(server, *removed)))
    quick = _server(*_both(definition, _USUAL, 20))
    once = functools.partial(_burst_of, ("api", "aux", "api"))
    again = (*once(1), s.Stop(), s.Pause(_USUAL + 10), s.Start(), *once(11), s.Stop(), s.Start(), *once(21))
    cases.append(("restart", _scenario(quick, *again)))
    return purposes_about(f"{NAMES[definition]}/phases", f"2-20 2-21 {EACH_ONCE[definition]}", *cases)


def _burst_of(refs: Sequence[str], first: int) -> tuple[Step, ...]:
    return (*_calls(*refs, first=first), *_joins(len(refs), first))


def _several(definition: str) -> TestPurpose:
    """Two components with different periods and priorities, and two instances of one."""
    cases = []
    for fast, slow in ((1, 255), (255, 1), (9, 9)):
        components = {
            "fast": _server(policy(definition, _USUAL, priority=fast)),
            "slow": _server(policy(definition, _LONG, priority=slow)),
        }
        order = ("slow", "fast") if slow > fast else ("fast", "slow")
        added = (step for name in order for step in _added(name))
        steps = (*added, s.Start(), *_burst_of(["fast", "slow", "fast", "slow", "fast"], 1), s.Stop())
        cases.append((f"priorities {fast} and {slow}", Scenario(components, steps)))
    server = {"server": _server(policy(definition, _USUAL))}
    steps = (
        *_added("server"),
        *_added("server", "second"),
        s.Start(),
        *_burst_of(["server", "second"] * 3, 1),
        s.Stop(),
    )
    cases.append(("two instances", Scenario(server, steps)))
    cases += [("in another container", _below(definition)), ("called by components", _peers(definition))]
    return purposes_about(f"{NAMES[definition]}/several", f"1-27 {EACH_ONCE[definition]}", *cases)


def _below(definition: str) -> Scenario:
    """A second instance, in another container, is called when the first one has been removed, and while the first one's container starts."""
    server = {"server": _server(policy(definition, _USUAL, 40))}
    steps: tuple[Step, ...] = (
        *(
            s.CreateContainer("below"),
            s.AddComponent("server", bind="first"),
            s.Start(),
            s.Stop(),
            s.RemoveComponent("first"),
        ),
        *(s.AddComponent("server", "below", bind="second"), s.GetPortElement("second", PORT, "api", "below")),
        *(s.Start("below"), *_burst_of(["api"] * 3, 1), s.Start(), s.Pause(_USUAL), *_burst_of(["api"] * 3, 11)),
        *(s.Stop(), *_burst_of(["api"] * 2, 21), s.Stop("below")),
    )
    return Scenario(server, steps)


def _peers(definition: str) -> Scenario:
    """Three components call the server through connections."""
    components = {"server": _server(policy(definition, _USUAL))}
    steps: list[Step] = [s.AddComponent("server"), s.GetPortElement("server", PORT, "goal")]
    for number in range(3):
        name = f"client {number}"
        components[name] = Declaration((PORT,), ("out.api",), plan={"exchange": (s.CallPort("out.api", 40 + number),)})
        steps += [s.AddComponent(name), s.Connect(name, "out.api", "goal", f"line {number}")]
        steps.append(s.GetPortElement(name, PORT, name))
    steps += [s.Start(), *_burst_of(["client 0", "client 1", "client 2"], 1), s.Stop()]
    return Scenario(components, tuple(steps))


def _added(component: str, name: str = "") -> tuple[Step, ...]:
    """Added under ``name``, which also names a reference to its port element."""
    return (s.AddComponent(component, bind=name), s.GetPortElement(name or component, PORT, name or component))
