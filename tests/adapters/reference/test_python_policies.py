"""Execution policies (10.1.3) in the Python reference framework, and what the Python SDK shows of them."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from typing import Any

import pytest
from performing import answer, hooks, play, scenario

from ucm_cts.adapters.contract.messages import Traced
from ucm_cts.adapters.contract.programming_model import (
    ComponentExecution,
    ComponentObject,
    Implementation,
    PortConnection,
    PortElementObject,
    UcmError,
)
from ucm_cts.adapters.contract.scenario import (
    ACTIVE,
    PROTECTED_PASSIVE,
    SELF_EXECUTING,
    UNPROTECTED_PASSIVE,
    Policy,
)
from ucm_cts.adapters.contract.trace import Enter, Event, Exit
from ucm_cts.adapters.reference.python.framework import ContainerManager

PASSIVE = {"provides": ["in", "side"], "policies": [{"definition": PROTECTED_PASSIVE}]}
BOTH_ACTIVE = {
    "provides": ["in", "side"],
    "policies": [{"definition": ACTIVE, "port": "in"}, {"definition": ACTIVE, "port": "side"}],
}
IN_ACTIVE = BOTH_ACTIVE | {"policies": [{"definition": ACTIVE, "port": "in"}]}
RUNNING = {"provides": ["in", "side"], "policies": [{"definition": SELF_EXECUTING}]}
OPEN = PASSIVE | {"policies": [{"definition": UNPROTECTED_PASSIVE}]}
PROTECTED = {"passive": PASSIVE, "active": IN_ACTIVE, "both active": BOTH_ACTIVE, "self-executing": RUNNING}

HOLDS = {"plan": {"exchange": [{"do": "hold", "gate": "g"}]}}
FOUND = [
    "add_component component=s",
    "get_port_element id=s port=in bind=in",
    "get_port_element id=s port=side bind=side",
]
OVERLAP = ["invoke ref={0} value=1 thread=v", "reach gate=g", "invoke ref={1} value=2 thread=w", "settle worker=w",
           "settle worker=v", "open gate=g", "join worker=v", "join worker=w"]  # fmt: skip
WAYS = [("in", "in"), ("in", "side"), ("side", "in"), ("side", "side")]


def most_inside(events: tuple[Event, ...], component: str = "s") -> int:
    """How many business methods of ``component`` were inside at a time."""
    inside = most = 0
    for event in events:
        if isinstance(event, Enter | Exit) and event.component == component and event.hook in ("exchange", "run"):
            inside += 1 if isinstance(event, Enter) else -1
            most = max(most, inside)
    return most


def events_of(components: dict[str, Any], steps: list[str], patience: int = 2000) -> tuple[Event, ...]:
    traced = answer(scenario(components, steps, patience))
    assert isinstance(traced, Traced), traced
    assert not traced.stuck
    return traced.events


def settled(trace: list[str]) -> list[str]:
    return [line.partition("where=")[2] for line in trace if line.startswith("settled")]


@pytest.mark.parametrize(("first", "second"), WAYS)
@pytest.mark.parametrize("declared", PROTECTED.values(), ids=PROTECTED.keys())
def test_calls_of_a_protected_component_exclude_each_other(declared: dict[str, Any], first: str, second: str) -> None:
    steps = [*FOUND, *(step.format(first, second) for step in OVERLAP)]
    assert most_inside(events_of({"s": declared | HOLDS}, steps)) == 1
    trace = play({"s": declared | HOLDS}, steps)
    managed = first in {policy.get("port") for policy in declared["policies"]}
    assert settled(trace) == ["blocked", "blocked" if managed else "held"]
    assert sorted(line[-2:] for line in trace if ":return" in line) == ["-2", "-3"]


def test_calls_of_an_unprotected_component_meet() -> None:
    steps = [*FOUND, *(step.format("in", "in") for step in OVERLAP)]
    assert most_inside(events_of({"s": OPEN | HOLDS}, steps)) == 2
    assert settled(play({"s": OPEN | HOLDS}, steps)) == ["held", "held"]


@pytest.mark.parametrize("declared", [{"provides": ["in", "side"]}, OPEN], ids=["none", "unprotected"])
def test_unprotected_components_are_known_by_their_own_references(declared: dict[str, Any]) -> None:
    assert "return step=1 value=s#1.in" in play({"s": declared}, FOUND)


@pytest.mark.parametrize("declared", PROTECTED.values(), ids=PROTECTED.keys())
def test_protection_holds_between_components_and_survives_exceptions(declared: dict[str, Any]) -> None:
    client = {"provides": ["go"], "requires": ["out"],
              "plan": {"exchange": [{"do": "call", "port": "out", "value": 5}]}}  # fmt: skip
    server = declared | {"plan": {"exchange": [{"do": "hold", "gate": "g"}, {"do": "raise"}]}}
    steps = [*FOUND, "add_component component=c", "connect id=c port=out to=in bind=link", "remove_component id=s",
             "get_port_element id=c port=go bind=go", "start", "invoke ref=go value=1 thread=v",
             "reach gate=g", "invoke ref=in value=2 thread=w", "settle worker=w", "open gate=g", "join worker=v",
             "join worker=w", "invoke ref=side value=3"]  # fmt: skip
    assert most_inside(events_of({"s": server, "c": client}, steps)) == 1
    trace = play({"s": server, "c": client}, steps)
    assert "raise step=5 error=UCM_ERROR" in trace  # its connection is recognised
    assert settled(trace) == ["blocked"]
    assert any("reply c#1 port=out raised=True" in line for line in trace)
    assert trace[-1] == "raise step=15 error=UNDECLARED"


def test_an_active_component_has_one_thread_of_its_own() -> None:
    events = events_of(
        {"s": IN_ACTIVE}, [*FOUND, "invoke ref=in value=1", "invoke ref=in value=2", "invoke ref=side value=3"]
    )
    threads = [event.thread for event in events if isinstance(event, Enter) and event.hook == "exchange"]
    assert threads == [1, 1, 0]


def test_a_removed_active_component_refuses_calls() -> None:
    trace = play({"s": IN_ACTIVE}, [*FOUND, "remove_component id=s", "invoke ref=in value=1"])
    assert trace[-1] == "raise step=4 error=UCM_ERROR"


@pytest.mark.parametrize(
    ("policies", "accepted"),
    [
        ([{"definition": PROTECTED_PASSIVE}, {"definition": UNPROTECTED_PASSIVE}], False),
        ([{"definition": PROTECTED_PASSIVE}, {"definition": PROTECTED_PASSIVE}], False),
        ([{"definition": SELF_EXECUTING}, {"definition": ACTIVE, "port": "in"}], False),
        ([{"definition": "own"}], False),
        ([{"definition": ACTIVE}], False),
        ([{"definition": ACTIVE, "port": "strange"}], False),
        ([{"definition": PROTECTED_PASSIVE, "port": "in"}], False),
        ([{"definition": PROTECTED_PASSIVE, "parameters": {"period": "1"}}], False),
        (BOTH_ACTIVE["policies"], True),
    ],
)
def test_policies_are_taken_or_refused(policies: list[dict[str, Any]], accepted: bool) -> None:
    trace = play({"s": PASSIVE | {"policies": policies}}, ["add_component component=s", "start"])
    assert trace[-1] == "return step=1"
    assert ("raise step=0 error=UCM_ERROR" not in trace) == accepted
    assert ("create s#1" in trace) == accepted


def test_run_ends_before_its_component_is_shut_down() -> None:
    running = RUNNING | {"plan": {"run": [{"do": "hold", "gate": "g"}]}}
    trace = play(
        {"s": running},
        [*FOUND, "start", "reach gate=g", "invoke ref=in value=1 thread=w", "settle worker=w", "stop thread=v",
         "settle worker=v", "open gate=g", "join worker=v", "join worker=w", "invoke ref=in value=1"],
    )  # fmt: skip
    assert settled(trace) == ["blocked", "blocked"]
    assert [line for line in trace if "=run" in line or "=on_shutdown" in line] == [
        "1:enter s#1 hook=run", "1:exit s#1 hook=run", "3:enter s#1 hook=on_shutdown", "3:exit s#1 hook=on_shutdown",
    ]  # fmt: skip


def test_stop_does_not_wait_for_a_run_that_has_not_begun() -> None:
    trace = play(
        {"s": RUNNING | HOLDS},
        [*FOUND, "start", "invoke ref=in value=1 thread=w", "reach gate=g", "stop", "open gate=g", "join worker=w"],
    )
    assert trace.index("return step=6") < trace.index("opened gate=g")
    assert "s.run" not in hooks(trace[trace.index("return step=6") :])


# what takes bodies that a scenario cannot describe


class Element(PortElementObject):
    def __init__(self, work: Callable[[int], int]) -> None:
        self.work = work

    def exchange(self, value: int) -> int:
        return self.work(value)


class Body(ComponentObject, ComponentExecution):
    """Does at each port, and in ``run``, what a test has put there."""

    def __init__(self) -> None:
        self.elements: dict[str, Element] = {"in": Element(lambda value: -value), "side": Element(lambda value: -value)}
        self.runs = 0
        self.fails = False
        self.is_ready = False

    def run(self) -> None:
        assert self.is_ready
        self.runs += 1
        if self.fails:
            raise ValueError("run fails")

    def on_init(self) -> None:
        pass

    def on_startup(self, dependencies: Sequence[PortConnection]) -> None:
        self.is_ready = True

    def on_shutdown(self) -> None:
        self.is_ready = False

    def on_remove(self) -> None:
        pass

    def get_portElement(self, provided: str) -> PortElementObject | None:
        return self.elements.get(provided)

    def get_policy_element(self, policy: str, element: str) -> ComponentExecution | None:
        return self

    def set_attribute(self, name: str, value: str) -> None:
        pass


def runtime_of(*policies: Policy) -> tuple[ContainerManager, Body, Callable[[str], PortElementObject]]:
    """A runtime with one component, its body, and what gives its references."""
    body = Body()
    runtime = ContainerManager([Implementation("s", ("in", "side"), (), (), False, False, lambda: body, policies)])
    member = runtime.add_component("s", {})
    return runtime, body, lambda port: runtime.get_port_element(member, port)


def soon(condition: Callable[[], bool]) -> bool:
    deadline = time.monotonic() + 5
    while not condition() and time.monotonic() < deadline:
        time.sleep(0.001)
    return condition()


ONE_POLICY = [Policy(PROTECTED_PASSIVE), Policy(SELF_EXECUTING), Policy(ACTIVE, "in"), Policy(ACTIVE, "side")]


@pytest.mark.parametrize("policy", ONE_POLICY)
def test_a_call_that_comes_back_on_the_same_thread_is_let_in(policy: Policy) -> None:
    _, body, reference = runtime_of(policy)
    body.elements["in"].work = lambda value: reference("side").exchange(value) + 1
    answers: list[int] = []
    caller = threading.Thread(target=lambda: answers.append(reference("in").exchange(5)), daemon=True)
    caller.start()
    caller.join(5)
    assert answers == [-4]


@pytest.mark.parametrize("policy", ONE_POLICY)
def test_references_of_protected_components_are_always_the_same(policy: Policy) -> None:
    _, body, reference = runtime_of(policy)
    assert reference("in") is reference("in") is not body.elements["in"]
    assert reference("in") is not reference("side")


def test_exceptions_of_an_active_component_reach_the_caller() -> None:
    _, body, reference = runtime_of(Policy(ACTIVE, "in"))
    body.elements["in"].work = lambda value: [][value]
    with pytest.raises(IndexError):
        reference("in").exchange(0)
    with pytest.raises(IndexError):  # the thread has survived
        reference("in").exchange(0)


@pytest.mark.parametrize("fails", [False, True])
def test_run_is_triggered_again_and_again_while_the_component_is_ready(fails: bool) -> None:
    runtime, body, _ = runtime_of(Policy(SELF_EXECUTING))
    body.fails = fails
    time.sleep(0.02)
    assert body.runs == 0
    for _ in range(2):
        runtime.start()
        before = body.runs
        assert soon(lambda: body.runs >= before + 3)  # noqa: B023 - called at once
        runtime.stop()
        last = body.runs
        time.sleep(0.02)
        assert body.runs == last
    runtime.start()
    runtime.destroy()
    last = body.runs
    time.sleep(0.02)
    assert body.runs == last


def test_a_start_that_fails_triggers_nothing() -> None:
    first, second = Body(), Body()

    def fail(dependencies: Sequence[PortConnection]) -> None:
        time.sleep(0.02)
        raise ValueError("does not start")

    second.on_startup = fail  # type: ignore[method-assign]
    bodies = iter([first, second])
    policies = (Policy(SELF_EXECUTING),)
    runtime = ContainerManager([Implementation("s", (), (), (), False, False, lambda: next(bodies), policies)])
    for _ in range(2):
        runtime.add_component("s", {})
    with pytest.raises(UcmError):
        runtime.start()
    assert first.runs == 0


def test_a_body_that_cannot_run_is_refused() -> None:
    class Idle(Body):
        def get_policy_element(self, policy: str, element: str) -> None:
            return None

    runtime = ContainerManager([Implementation("s", (), (), (), False, False, Idle, (Policy(SELF_EXECUTING),))])
    with pytest.raises(UcmError):
        runtime.add_component("s", {})
