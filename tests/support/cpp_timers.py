"""Components with timers in the C++ reference framework: their traces, and when they were called back."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from cpp_builds import Builds, events

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.harness.execution.integrity import contradiction

LATE = 0.4
"""Seconds. Callbacks come at most so much later on a machine that is busy otherwise."""

READY = (s.AddComponent("A"), s.GetPortElement("A", "in", "tell"), s.Start())
TELL = s.Invoke("tell", 1)

EXECUTIONS = {
    "passive": (s.Policy(s.PROTECTED_PASSIVE),),
    "active": (s.Policy(s.ACTIVE, "in"),),
    "self-executing": (s.Policy(s.SELF_EXECUTING),),
    "periodic": (s.Policy(s.PERIODIC_ACTIVE, "in", settings={"ppac_period": 1, "ppac_offset": 0, "ppac_priority": 1}),),
}
"""Policies of protected components."""


def traced(builds: Builds, component: s.Declaration, *steps: s.Step) -> tuple[t.Event, ...]:
    """What ``component`` as A shows, which is started first. All steps are over in time, and the trace agrees with the plan."""
    scenario = s.Scenario({"A": component}, (*READY, *steps), 8000)
    trace = events(builds.reference, scenario)
    assert contradiction(scenario, trace) is None
    assert not [e for e in trace if isinstance(e, t.Timeout)]
    return trace


def replies(trace: Sequence[t.Event], port: str) -> list[Any]:
    return [e.results for e in trace if isinstance(e, t.Reply) and e.port == port]


def first(trace: Sequence[t.Event], method: str) -> t.Request:
    return next(e for e in trace if isinstance(e, t.Request) and e.method == method)


def check_times(callbacks: Sequence[t.Event], begin: int, due: Sequence[float]) -> None:
    """They came so many seconds after ``begin``."""
    came = [(e.t - begin) / 1e9 for e in callbacks]
    assert len(came) == len(due), came
    assert all(at <= moment < at + LATE for moment, at in zip(came, due, strict=True)), came


def while_called(builds: Builds, component: s.Declaration) -> tuple[tuple[t.Event, ...], t.Exit]:
    """What ``component`` shows while it is held at gate g in a call and afterwards, and how that call left it."""
    told = s.Invoke("tell", 1, thread="w")
    after = (s.ReachGate("g"), s.Pause(150), s.OpenGate("g"), s.Join("w"), s.Pause(150))
    trace = traced(builds, component, told, *after)
    (left,) = (e for e in trace if isinstance(e, t.Exit) and e.hook == "exchange")
    return trace, left


def ended(builds: Builds, component: s.Declaration, end: s.Step) -> tuple[t.Event, ...]:
    """What ``component`` shows that is called back, and held there at gate g, when ``end`` begins on thread z: that waits."""
    steps = (TELL, s.ReachGate("g"), end, s.Settle("z"), s.OpenGate("g"), s.Join("z"))
    trace = traced(builds, component, *steps)
    assert [e.where for e in trace if isinstance(e, t.Settled)] == ["blocked"]
    left = next(e for e in trace if isinstance(e, t.Exit) and e.hook == "method")
    shut_down = next(e for e in trace if isinstance(e, t.Enter) and e.hook == "on_shutdown")
    assert left.n < shut_down.n
    return trace
