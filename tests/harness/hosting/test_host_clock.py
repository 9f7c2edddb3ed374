"""A host's times increase from answer to answer and match the elapsed time; honest hosts have no contradiction."""

from __future__ import annotations

import pytest

from ucm_cts.adapters.contract.trace import Opened, Trace
from ucm_cts.harness.execution.host_clock import DRIFT, GRAIN, HostClock

MS = 1_000_000
BEHIND = 7_000 * MS
"""The host's clock shows so much less than the harness's."""


def trace_at(*times: int) -> Trace:
    return tuple(Opened(n, t - BEHIND, 0, "g") for n, t in enumerate(times, 1))


def test_answers_in_the_order_in_which_they_were_lived() -> None:
    clock = HostClock(True)
    assert clock.contradiction(trace_at(20 * MS, 30 * MS), 10 * MS, 40 * MS) is None
    assert clock.contradiction((), 10 * MS, 40 * MS) is None
    assert clock.contradiction(trace_at(30 * MS, 39 * MS), 10 * MS, 41 * MS) is None
    assert clock.contradiction(trace_at(50 * MS, 3_000 * MS), 45 * MS, 3_000 * MS) is None


def test_replayed_trace_is_a_contradiction() -> None:
    clock = HostClock(False)
    trace = trace_at(20 * MS, 30 * MS)
    assert clock.contradiction(trace, 10 * MS, 40 * MS) is None
    assert "a replayed trace" in str(clock.contradiction(trace, 50 * MS, 60 * MS))


@pytest.mark.parametrize("is_near", [True, False])
def test_more_time_than_has_passed(is_near: bool) -> None:
    clock = HostClock(is_near)
    assert clock.contradiction(trace_at(20 * MS, 30 * MS), 19 * MS, 31 * MS) is None
    problem = clock.contradiction(trace_at(40 * MS, 540 * MS), 35 * MS, 42 * MS)
    assert (problem is not None) == is_near
    assert problem is None or "more than have passed" in problem


def test_clocks_may_drift_apart() -> None:
    hour = 3_600_000 * MS
    clock = HostClock(True)
    assert clock.contradiction(trace_at(20 * MS, 30 * MS), 20 * MS, 31 * MS) is None
    late = trace_at(hour, hour + int(hour * DRIFT) + GRAIN // 2)
    assert clock.contradiction(late, hour - MS, hour) is None
