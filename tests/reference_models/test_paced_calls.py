"""Calls that wait when a component paced by 10.5.2 is stopped."""

from __future__ import annotations

import msgspec
import pytest

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.harness.catalogue.requirements import load_life_cycle
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
