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


def test_answers_of_a_side_host_are_examined_in_any_order_and_none_twice() -> None:
    def contradiction(clock: HostClock, *times: int) -> str | None:
        return clock.contradiction(trace_at(*(time * MS for time in times)), times[0] * MS - MS, times[-1] * MS + MS)

    for overlapping in ((50, 60), (45, 55), (55, 65), (40, 70), (52, 58)):
        clock = HostClock(True, in_order=False)
        assert contradiction(clock, 80, 90) is None
        assert contradiction(clock, 20, 30) is None
        assert contradiction(clock, 50, 60) is None
        assert contradiction(clock, 30, 50) is None
        assert "a replayed trace" in str(contradiction(clock, *overlapping))
    assert "a replayed trace" in str(contradiction(clock, 80, 90))


def test_first_answer_may_be_examined_late() -> None:
    clock = HostClock(True, in_order=False)
    assert clock.contradiction(trace_at(100_000 * MS, 100_010 * MS), 99_999 * MS, 100_011 * MS) is None
    assert clock.contradiction(trace_at(2_000 * MS, 2_010 * MS), 1_999 * MS, 2_011 * MS) is None


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
