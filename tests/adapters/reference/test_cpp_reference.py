"""How the C++ reference framework reads what the text leaves open."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence

import pytest
from cpp_builds import CONNECTED, PAIR, Builds, events, story

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t

pytestmark = pytest.mark.native

RAISES: Callable[[s.Hook], s.Declaration] = lambda hook: s.Declaration(("p_e",), plan={hook: (s.RaiseError(),)})

READINGS: dict[str, tuple[dict[str, s.Declaration], tuple[s.Step, ...], str]] = {
    "a failed on_startup shuts down those already started": (
        {**PAIR, "B": RAISES("on_startup")},
        (*CONNECTED, s.AddComponent("B"), s.Start(), s.Stop(), s.AddComponent("P", bind="again")),
        "on_startup P, on_startup C, on_startup B, on_shutdown C, on_shutdown P, start: UCM_ERROR, stop: ok, "
        "on_init P2, add_component: ok",
    ),
    "a failed on_shutdown does not spare the others": (
        {**PAIR, "B": RAISES("on_shutdown")},
        (s.AddComponent("P"), s.AddComponent("B"), s.Start(), s.Stop(), s.Stop()),
        "on_startup P, on_startup B, start: ok, on_shutdown B, on_shutdown P, stop: UCM_ERROR, stop: ok",
    ),
    "a failed on_init leaves nothing": (
        {"B": RAISES("on_init")},
        (s.AddComponent("B"), s.Start(), s.GetComponents()),
        "on_init B, add_component: UCM_ERROR, start: ok, get_components: ok",
    ),
    "a failed on_remove removes": (
        {"B": RAISES("on_remove")},
        (s.AddComponent("B"), s.RemoveComponent("B"), s.RemoveComponent("B")),
        "on_remove B, remove_component: UCM_ERROR, remove_component: NOT_FOUND",
    ),
    "starting needs all connections": (
        PAIR,
        (s.AddComponent("P"), s.AddComponent("C"), s.Start(), s.Stop()),
        "start: UCM_ERROR, stop: ok",
    ),
    "nothing is configured after start": (
        PAIR,
        (*CONNECTED, s.Start(), s.Start(), s.AddComponent("P", bind="q"), s.Disconnect("k"), s.RemoveComponent("C")),
        "on_startup P, on_startup C, start: ok, start: ok, add_component: UCM_ERROR, disconnect: UCM_ERROR, "
        "remove_component: UCM_ERROR",
    ),
    "a provider in use stays, a client takes its connections along": (
        PAIR,
        (*CONNECTED, s.RemoveComponent("P"), s.RemoveComponent("C"), s.Disconnect("k"), s.RemoveComponent("P")),
        "remove_component: UCM_ERROR, on_disconnect C, on_remove C, remove_component: ok, disconnect: NOT_FOUND, "
        "on_remove P, remove_component: ok",
    ),
    "wrong arguments of connect": (
        PAIR,
        (
            *CONNECTED,
            s.Connect("C", "r_e", "ref", "x"),
            s.Connect("C", "r_e", "nil", "x"),
            s.Connect("C", "q", "ref", "x"),
            s.Connect("P", "p_e", "ref", "x"),
            s.Connect("unknown", "r_e", "ref", "x"),
            s.GetPortElement("C", "r_e", "x"),
        ),
        "connect: UCM_ERROR, connect: BAD_PARAMETER, connect: BAD_PARAMETER, connect: BAD_PARAMETER, connect: NOT_FOUND, "
        "get_port_element: NOT_FOUND",
    ),
    "removing a container undoes what leads into it": (
        PAIR,
        (
            s.CreateContainer("sub"),
            s.AddComponent("P", container="sub"),
            s.AddComponent("P", container="sub", bind="P2"),
            s.GetPortElement("P", "p_e", "ref", container="sub"),
            s.AddComponent("C"),
            s.Connect("C", "r_e", "ref", "k"),
            s.Start(container="sub"),
            s.RemoveContainer("sub"),
            s.RemoveContainer("sub"),
            s.Disconnect("k"),
            s.Start(),
        ),
        "on_startup P, on_startup P2, start: ok, on_shutdown P2, on_shutdown P, on_disconnect C, on_remove P2, "
        "on_remove P, remove_container: ok, remove_container: NOT_FOUND, disconnect: NOT_FOUND, start: UCM_ERROR",
    ),
    "destroy ends everything": (
        PAIR,
        (
            *CONNECTED,
            s.CreateContainer("sub"),
            s.AddComponent("P", container="sub", bind="q"),
            s.Start(),
            s.Start(container="sub"),
            s.Destroy(),
            s.GetComponents(),
            s.Start(container="sub"),
            s.Destroy(),
        ),
        "on_startup P, on_startup C, start: ok, on_startup P2, start: ok, on_shutdown P2, on_shutdown C, on_shutdown P, "
        "on_disconnect C, on_remove P2, on_remove C, on_remove P, destroy: ok, get_components: UCM_ERROR, "
        "start: UCM_ERROR, destroy: UCM_ERROR",
    ),
    "not everything that is asked for exists": (
        PAIR,
        (
            s.AddComponent("nobody"),
            s.RemoveContainer("nil"),
            s.RemoveContainer("manager"),
            s.RemoveComponent("unknown"),
        ),
        "add_component: UCM_ERROR, remove_container: NOT_FOUND, remove_container: NOT_FOUND, remove_component: NOT_FOUND",
    ),
}


@pytest.mark.parametrize("reading", READINGS)
def test_readings_of_the_reference_framework(builds: Builds, reading: str) -> None:
    components, steps, expected = READINGS[reading]
    reported = ", ".join(story(builds.reference, s.Scenario(components, steps)))
    assert reported.endswith(expected), reported


# execution policies


def provider(policy: str, plan: dict[s.Hook, tuple[s.Action, ...]] | None = None) -> s.Declaration:
    """A component with two provided port elements, the first of which is managed if the policy is that of a port."""
    port = "p_e" if policy == s.ACTIVE else None
    return s.Declaration(("p_e", "q_e"), plan=plan or {}, policies=(s.Policy(policy, port),))


READY = (s.AddComponent("P"), s.GetPortElement("P", "p_e", "p"), s.GetPortElement("P", "q_e", "q"), s.Start())
PROTECTED = (s.SELF_EXECUTING, s.ACTIVE, s.PROTECTED_PASSIVE)


def executions(trace: Sequence[t.Event]) -> Iterator[tuple[t.Event, int]]:
    """Each event inside a body, and how many threads are inside then."""
    inside: Counter[int] = Counter()
    for event in trace:
        if isinstance(event, t.Enter):
            inside[event.thread] += 1
        if isinstance(event, t.Enter | t.Exit):
            yield event, sum(count > 0 for count in inside.values())
        if isinstance(event, t.Exit):
            inside[event.thread] -= 1


def where(trace: Sequence[t.Event]) -> list[str]:
    return [e.where for e in trace if isinstance(e, t.Settled)]


def returned(trace: Sequence[t.Event], scenario: s.Scenario) -> list[object]:
    return [e.value for e in trace if isinstance(e, t.Return) and isinstance(scenario.steps[e.step], s.Invoke)]


def overlap(policy: str, first: str, second: str) -> s.Scenario:
    return s.Scenario(
        {"P": provider(policy, {"exchange": (s.HoldAtGate("g"),)})},
        (
            *READY,
            s.Invoke(first, 1, thread="a"),
            s.ReachGate("g"),
            s.Invoke(second, 2, thread="b"),
            s.Settle("a"),
            s.Settle("b"),
            s.Stop(thread="z"),
            s.Settle("z"),
            s.OpenGate("g"),
            *(s.Join(worker) for worker in "abz"),
        ),
    )


@pytest.mark.parametrize("ports", ["pp", "pq", "qp", "qq"])
@pytest.mark.parametrize("policy", PROTECTED)
def test_a_protected_component_is_executed_once_at_a_time(builds: Builds, policy: str, ports: str) -> None:
    scenario = overlap(policy, *ports)
    trace = events(builds.reference, scenario)
    own_thread = policy == s.ACTIVE and ports[0] == "p"
    assert where(trace) == ["blocked" if own_thread else "held", "blocked", "blocked"]
    assert {threads for _, threads in executions(trace)} == {1}
    assert sorted(map(str, returned(trace, scenario))) == ["-2", "-3"], "each call that had to wait is carried out"
    assert not [e for e in trace if isinstance(e, t.Timeout)]


def test_an_unprotected_component_is_not_kept_from_overlapping(builds: Builds) -> None:
    scenario = overlap(s.UNPROTECTED_PASSIVE, "p", "q")
    trace = events(builds.reference, scenario)
    assert where(trace) == ["held", "held", "done"]
    assert max(threads for _, threads in executions(trace)) == 3, "on_shutdown does not wait either"
    assert t.Reference("P", 1, "p_e") in [e.value for e in trace if isinstance(e, t.Return)]


def test_an_active_component_executes_on_its_own_thread(builds: Builds) -> None:
    invoked = (s.Invoke("p", 1), s.Invoke("p", 2, thread="w"), s.Join("w"), s.Invoke("q", 3))
    trace = events(builds.reference, s.Scenario({"P": provider(s.ACTIVE)}, (*READY, *invoked)))
    threads = [e.thread for e in trace if isinstance(e, t.Enter) and e.hook == "exchange"]
    callers = [e.thread for e in trace if isinstance(e, t.Call)][-3:]
    assert threads[0] == threads[1]
    assert threads[0] not in callers
    assert threads[2] == callers[2], "the other port element is protected, but not active"


@pytest.mark.parametrize("policy", PROTECTED)
def test_exceptions_travel_to_the_caller(builds: Builds, policy: str) -> None:
    failing = provider(policy, {"exchange": (s.RaiseError(),)})
    trace = events(builds.reference, s.Scenario({"P": failing}, (*READY, s.Invoke("p", 1), s.Invoke("p", 2))))
    assert [(e.error, e.detail.partition(": ")[2]) for e in trace if isinstance(e, t.Raise)] == [
        ("UNDECLARED", "the probe fails in exchange")
    ] * 2


@pytest.mark.parametrize("policy", PROTECTED)
def test_a_component_may_call_itself(builds: Builds, policy: str) -> None:
    port = "p_e" if policy == s.ACTIVE else None
    plan: dict[s.Hook, tuple[s.Action, ...]] = {"on_startup": (s.CallPort("r_e", 5),)}
    own = s.Declaration(("p_e",), ("r_e",), plan=plan, policies=(s.Policy(policy, port),))
    steps = (s.AddComponent("P"), s.GetPortElement("P", "p_e", "p"), s.Connect("P", "r_e", "p", "k"), s.Start())
    trace = events(builds.reference, s.Scenario({"P": own}, steps))
    assert [e.value for e in trace if isinstance(e, t.Reply)] == [~5]
    assert [e.dependencies for e in trace if isinstance(e, t.Enter) and e.dependencies] == [
        (t.Dependency("r_e", ("opaque",)),)
    ]


A_WHILE = s.ReachGate("never")


def test_run_is_triggered_while_the_component_is_ready(builds: Builds) -> None:
    executing = s.Declaration(plan={"run": (s.RaiseError(),)}, policies=(s.Policy(s.SELF_EXECUTING),))
    components = {"P": executing, "Q": s.Declaration()}
    steps = (s.AddComponent("P"), s.AddComponent("Q"), A_WHILE, *(s.Start(), A_WHILE, s.Stop(), A_WHILE) * 2)
    trace = events(builds.reference, s.Scenario(components, steps, patience=40))
    ready, runs = 0, [0, 0, 0, 0, 0]
    for event in trace:
        if isinstance(event, t.Exit) and event.hook == "on_startup":
            ready += 1
        if isinstance(event, t.Enter) and event.hook == "on_shutdown":
            ready -= 1
        if isinstance(event, t.Enter) and event.hook == "run":
            assert ready == 2, "run is called after all on_startup and before any on_shutdown"
        if isinstance(event, t.Enter | t.Exit) and event.hook == "run":
            runs[sum(isinstance(e, t.Timeout) for e in trace if e.n < event.n)] += 1
    assert runs[0] == runs[4] == 0
    assert min(runs[1], runs[3]) > 2, "again after it failed, and again after a restart"


def test_stop_waits_for_run(builds: Builds) -> None:
    executing = provider(s.SELF_EXECUTING, {"run": (s.HoldAtGate("g"),)})
    steps = (
        *READY,
        s.ReachGate("g"),
        s.Invoke("p", 1, thread="w"),
        s.Settle("w"),
        s.Stop(thread="z"),
        s.Settle("z"),
        s.GetComponents(),
        s.OpenGate("g"),
        s.Join("z"),
        s.Destroy(),
    )
    trace = events(builds.reference, s.Scenario({"P": executing}, steps))
    assert where(trace) == ["blocked", "blocked"]
    assert {threads for _, threads in executions(trace)} == {1}
    assert not [e for e in trace if isinstance(e, t.Timeout | t.Raise)]


def test_references_of_protected_components_cross_containers_and_outlive_them(builds: Builds) -> None:
    client = s.Declaration(requires=("r_e",), plan={"on_startup": (s.CallPort("r_e", 4),)})
    steps = (
        s.AddComponent("P"),
        s.GetPortElement("P", "p_e", "p"),
        s.CreateContainer("sub"),
        s.AddComponent("C", container="sub"),
        s.Connect("C", "r_e", "p", "k", container="sub"),
        s.RemoveComponent("P"),
        s.Start(container="sub"),
        s.RemoveContainer("sub"),
        s.RemoveComponent("P"),
        s.Invoke("p", 1),
    )
    trace = events(builds.reference, s.Scenario({"P": provider(s.ACTIVE), "C": client}, steps))
    assert [e.value for e in trace if isinstance(e, t.Reply)] == [~4]
    assert [(e.step, e.error) for e in trace if isinstance(e, t.Raise)] == [(5, "UCM_ERROR")]
    assert [e.value for e in trace if isinstance(e, t.Return) and e.step == 9] == [~1]


REFUSED: dict[str, tuple[s.Policy, ...]] = {
    "two policies": (s.Policy(s.PROTECTED_PASSIVE), s.Policy(s.UNPROTECTED_PASSIVE)),
    "one policy twice": (s.Policy(s.PROTECTED_PASSIVE), s.Policy(s.PROTECTED_PASSIVE)),
    "active and passive": (s.Policy(s.ACTIVE, "p_e"), s.Policy(s.PROTECTED_PASSIVE)),
    "unknown": (s.Policy("protected"),),
    "active without a port": (s.Policy(s.ACTIVE),),
    "active on what is not provided": (s.Policy(s.ACTIVE, "r_e"),),
    "passive on a port": (s.Policy(s.PROTECTED_PASSIVE, "p_e"),),
    "a parameter": (s.Policy(s.SELF_EXECUTING, parameters={"period": "2"}),),
}


@pytest.mark.parametrize("policies", REFUSED.values(), ids=REFUSED)
def test_policies_that_are_refused(builds: Builds, policies: tuple[s.Policy, ...]) -> None:
    component = s.Declaration(("p_e",), policies=policies)
    scenario = s.Scenario({"P": component, "Q": provider(s.ACTIVE)}, (s.AddComponent("P"), s.AddComponent("Q")))
    trace = events(builds.reference, scenario)
    assert [e.error for e in trace if isinstance(e, t.Raise)] == ["UCM_ERROR"]
    assert [e.component for e in trace if isinstance(e, t.Create)] == ["Q"]
