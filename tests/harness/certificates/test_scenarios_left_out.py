"""Records of runs in which the time for incidents is used up: most scenarios are left out, hundreds before an answer."""

from __future__ import annotations

import inspect

import pytest
from recorded_runs import judged, plan_of, recorded, some_purposes

from ucm_cts.harness.certificates.rejudging import without_clock
from ucm_cts.harness.execution import record as r
from ucm_cts.harness.execution.driver import MOST_UNTRIED
from ucm_cts.harness.hosting.hosts import Hosts


@pytest.mark.slow
@pytest.mark.parametrize(("incident_seconds", "every", "untried"), [(1.0, 1, 200), (0.0, 100, 50)])
@pytest.mark.usefixtures("here")
def test_a_run_that_leaves_out_nearly_all_is_judged_like_the_run(
    incident_seconds: float, every: int, untried: int
) -> None:
    adapter = "hostile.failing:HangsInStop"
    plan = plan_of(adapter, seconds=0.5, incident_seconds=incident_seconds, drawn=150)
    purposes = some_purposes(plan, every=every)
    report, record = recorded(adapter, plan, purposes)
    incidents = [one.incident for one in record.entries if isinstance(one, r.Answered) and one.incident]
    assert sum(incident.kind == "untried" for incident in incidents) > untried
    again = judged(record, plan, purposes)
    assert again.problems == ()
    assert without_clock(again.report) == without_clock(report)


def test_a_record_holds_as_many_as_a_driver_asks_for() -> None:
    """Each of those on their way to a host, and the one after them, comes after some that are left out."""
    window = inspect.signature(Hosts.run).parameters["window"].default
    assert (window + 1) * (MOST_UNTRIED + 1) <= r.MOST_AHEAD
