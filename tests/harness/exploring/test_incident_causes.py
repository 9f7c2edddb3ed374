"""Which incidents have one cause."""

from __future__ import annotations

import msgspec
import pytest

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.results.incident_causes import DistinctIncidents, cause_of_incident
from ucm_cts.harness.results.incidents import may_wait
from ucm_cts.harness.results.values import Execution, Incident, IncidentKind

BODY = 1, 1, 0, "one", 1
STARTED = (t.Create(*BODY), t.Enter(*BODY, "on_startup"), t.Exit(*BODY, "on_startup"))
STOPPED = (*STARTED, t.Enter(*BODY, "on_shutdown"))
INVOKED = t.Call(1, 1, 0, 0)
ASKED = t.Request(*BODY, "out.api", 1)


@pytest.mark.parametrize(
    ("trace", "may"),
    [
        ((t.Create(*BODY), INVOKED), True),
        ((*STARTED, INVOKED), False),
        ((*STOPPED, INVOKED), True),
        ((t.Create(*BODY), INVOKED, t.Return(1, 1, 0, 0)), False),
        ((*STARTED[:2], ASKED), True),
        ((*STARTED[:2], ASKED, t.Reply(*BODY, "out.api", 1)), False),
        ((*STARTED, ASKED), False),
        ((), False),
    ],
)
def test_traces_that_may_wait(trace: t.Trace, may: bool) -> None:
    assert may_wait(Scenario({}, (s.Invoke("one", 1),)), trace) == may


def incident(
    kind: IncidentKind, detail: str, *trace: t.Event, names: tuple[str, ...] = (), steps: int = 1
) -> Execution:
    scenario = Scenario({name: s.Declaration() for name in names}, (s.Start(),) * steps)
    return Execution("drawn", scenario, trace, Incident(kind, detail))


CALLED = t.Call(1, 1, 0, 0)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (incident("crash", "SIGSEGV"), incident("crash", "SIGABRT")),
        (incident("crash", "SIGSEGV"), incident("exit", "SIGSEGV")),
        (incident("crash", "SIGSEGV", CALLED), incident("crash", "SIGSEGV")),
        (incident("refused", "no bolts\nat 1"), incident("refused", "no nuts\nat 1")),
    ],
)
def test_incidents_with_different_causes(one: Execution, other: Execution) -> None:
    assert cause_of_incident(one) != cause_of_incident(other)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (incident("hang", "no answer within 0.5 s", CALLED), incident("hang", "no answer within 12 s", CALLED)),
        (incident("refused", "at 0x7f00aa"), incident("refused", "at 0x11")),
        (incident("refused", "id 3f2a9c0e-11aa"), incident("refused", "id 77777777-eeee")),
        (incident("refused", "bolts\nline 1"), incident("refused", "bolts\nline 2 and more")),
        (incident("refused", "bob is odd", names=("bob",)), incident("refused", "ann is odd", names=("ann",))),
        (incident("hang", "never came back: worker1, worker2"), incident("hang", "never came back: worker6")),
    ],
)
def test_incidents_with_one_cause(one: Execution, other: Execution) -> None:
    assert cause_of_incident(one) == cause_of_incident(other)


def test_the_shortest_scenario_of_each_cause_of_incidents_is_kept() -> None:
    unknown = incident("crash", "SIGSEGV")
    known = [incident("crash", "SIGSEGV", CALLED, steps=steps) for steps in (5, 3, 4)]
    odd = msgspec.structs.replace(unknown, incident=Incident("crash", "SIGSEGV", reproduced=False))
    distinct = DistinctIncidents()
    for execution in unknown, *known, unknown, odd, incident("hang", "no answer"):
        distinct.add(execution)
    assert [(report.execution, report.occurrences) for report in distinct.reports] == [
        (known[1], 5),
        (odd, 1),
        (incident("hang", "no answer"), 1),
    ]


def test_calls_that_may_wait_are_another_cause() -> None:
    scenario = Scenario({}, (s.Invoke("one", 1),))
    hang = Execution("drawn", scenario, (*STARTED, INVOKED), Incident("hang", "no answer"))
    waits = msgspec.structs.replace(hang, trace=(*STOPPED, INVOKED))
    assert cause_of_incident(hang)[:3] == cause_of_incident(waits)[:3]
    assert cause_of_incident(hang) != cause_of_incident(waits)
