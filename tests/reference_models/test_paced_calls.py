"""Calls that wait when a component paced by 10.5.2 is stopped, and executions that are too close because the first one was late."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import msgspec
import pytest

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.reference_models.model import pacing
from ucm_cts.reference_models.monitor import Monitor

_MS = 1_000_000
_PACED = s.Policy(
    "sporadic_protected_active_component", "in.api", settings={"spac_priority": 1, "spac_min_period": 10_000}
)
_SCENARIO = s.Scenario(
    {"A": s.Declaration(("in.api", "aux.api"), policies=(_PACED,))},
    (
        s.AddComponent("A"),
        s.GetPortElement("A", "in.api", "managed"),
        s.GetPortElement("A", "aux.api", "other"),
        s.Start(),
        s.Invoke("other", 2, thread="first"),
        s.Invoke("managed", 1, thread="second"),
        s.Stop(),
        s.Join("second"),
    ),
    patience=2000,
)


def _trace(leaves_at: int) -> list[t.Event]:
    """A call of another port is executed until millisecond ``leaves_at``; the stop returns at 10, and the test waits until 2,010."""
    body = {"component": "A", "instance": 1}
    begin = [
        t.Call(1, 0, 0, 0),
        t.Create(2, 0, 0, **body),
        t.Enter(3, 0, 0, **body, hook="on_init", attributes={}),
        t.Exit(4, 0, 0, **body, hook="on_init"),
        t.Return(5, 0, 0, 0, value=1),
        t.Call(6, 0, 0, 1),
        t.Return(7, 0, 0, 1, value="opaque"),
        t.Call(8, 0, 0, 2),
        t.Return(9, 0, 0, 2, value="opaque"),
        t.Call(10, 0, 0, 3),
        t.Enter(11, 0, 0, **body, hook="on_startup", dependencies=()),
        t.Exit(12, 0, 0, **body, hook="on_startup"),
        t.Return(13, 0, 0, 3),
        t.Call(14, 1 * _MS, 1, 4),
        t.Enter(15, 1 * _MS, 1, **body, hook="exchange", port="aux.api", value=2),
        t.Call(16, 2 * _MS, 2, 5),
    ]
    stop = [
        t.Call(0, 3 * _MS, 0, 6),
        t.Enter(0, 4 * _MS, 0, **body, hook="on_shutdown"),
        t.Exit(0, 5 * _MS, 0, **body, hook="on_shutdown"),
        t.Return(0, 10 * _MS, 0, 6),
    ]
    leave = [
        t.Exit(0, leaves_at * _MS, 1, **body, hook="exchange", value=-3),
        t.Return(0, leaves_at * _MS, 1, 4, value=-3),
    ]
    rest = sorted([*stop, *leave, t.Timeout(0, 2010 * _MS, 0, 7)], key=lambda event: event.t)
    return [msgspec.structs.replace(event, n=n) for n, event in enumerate([*begin, *rest], 1)]


@pytest.mark.parametrize(("leaves_at", "found"), [(3, ["left waiting"]), (1500, [])])
def test_a_call_waits_on_while_the_component_executes_another(leaves_at: int, found: list[str]) -> None:
    verdicts = Monitor(load_life_cycle()).judge(_SCENARIO, _trace(leaves_at))
    assert [finding.cause for finding in verdicts.findings if finding.requirement == "R-10.5.2-20"] == found


def _phase(definition: str) -> Any:
    """The first instant is at 20 ms, each further one 50 ms later."""
    return SimpleNamespace(
        policy=SimpleNamespace(definition=definition),
        period=50 * _MS,
        first=lambda latest: 20 * _MS,
        busy_since=lambda moment, limit: moment,
    )


def _executions(*asked_and_came: tuple[float, float]) -> Any:
    return [SimpleNamespace(asked=round(asked * _MS), t=round(came * _MS), left=0) for asked, came in asked_and_came]


@pytest.mark.parametrize(
    ("executions", "late"),
    [
        ([(0, 0), (0, 50), (0, 70)], 0),  # the second came in time: the third is early itself
        ([(0, 30), (0, 60)], 7),  # the first was late
        ([(0, 0), (0, 80), (0, 110)], 7),
        ([(0, 0), (0, 52), (0, 80)], 0),  # not as late as the next one is close
    ],
)
def test_sporadic_executions_are_too_close_by_the_lateness_of_the_first(
    executions: list[tuple[float, float]], late: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pacing, "granularity", lambda runtime: _MS // 2)
    runtime: Any = SimpleNamespace(ics=SimpleNamespace(reading=lambda option: ""))
    close = pacing.too_close(runtime, _phase(s.SPORADIC_ACTIVE), _executions(*executions))
    assert close is not None
    assert close.late_by // _MS == late


@pytest.mark.parametrize(
    ("executions", "late"),
    [
        ([(0, 21), (0, 40)], 0),  # the instant was served
        ([(0, 50), (0, 75)], 25),  # the first was late for its instant
        ([(0, 65), (0, 75)], 0),  # the first was early for the next instant
        ([(0, 19.8), (0, 40)], 0),
    ],
)
def test_periodic_executions_that_are_early_for_an_instant_may_be_late_for_the_one_before(
    executions: list[tuple[float, float]], late: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pacing, "granularity", lambda runtime: _MS // 2)
    monkeypatch.setattr(pacing, "lateness", lambda runtime: 5 * _MS)
    runtime: Any = SimpleNamespace(ics=SimpleNamespace(reading=lambda option: ""))
    early = pacing.too_early(runtime, _phase(s.PERIODIC_ACTIVE), _executions(*executions), "one-a-period")
    assert early is not None
    assert early.late_by // _MS == late
