"""Recorded runs of a few test purposes, for the tests of records."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import contextmanager
from typing import Any
from unittest import mock

from ucm_cts.harness.certificates import rejudging
from ucm_cts.harness.certificates.rejudging import Judged, RunPlan, judge_again
from ucm_cts.harness.cli.one_run import carry_out
from ucm_cts.harness.cli.terminal import Output
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.recording import Record, RecordingDriver, decoded, encoded
from ucm_cts.harness.exploring.in_runs import draw_scenarios
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.results.values import FrameworkReport
from ucm_cts.harness.statement.applicability import purposes_for
from ucm_cts.harness.statement.files import stated_by

EVERY = 12
"""One of so many test purposes is run, besides those that a test names."""


def plan_of(adapter: str, profile: str = "container", **more: Any) -> RunPlan:
    """A plan with the statement that is published with ``adapter``."""
    return RunPlan(profile, 7, stated_by(None, adapter), **more)


def some_purposes(plan: RunPlan, words: Iterable[str] = (), every: int = EVERY) -> tuple[TestPurpose, ...]:
    """Some test purposes from all over the profile, and all that name one of ``words``."""
    of_plan = purposes_for(plan.statement, plan.profile, plan.systematic)
    return tuple(
        purpose
        for number, purpose in enumerate(of_plan)
        if number % every == 0 or any(word in (purpose.id, *purpose.requirements) for word in words)
    )


def recorded(
    adapter: str, plan: RunPlan, purposes: Iterable[TestPurpose], in_process: bool = False
) -> tuple[FrameworkReport, Record]:
    """A run of ``purposes``, and its record as it comes out of a file."""
    with RecordingDriver(locate(adapter, in_process), plan.seed, plan.limits) as driver:
        campaign = Campaign(driver, plan.profile, plan.known, plan.statement)
        carry_out(campaign, tuple(purposes), lambda: draw_scenarios(campaign, plan.seed, plan.drawn), Output())
        report, record = campaign.report(), driver.record
    return report, decoded(encoded(record))


@contextmanager
def only(purposes: Iterable[TestPurpose]) -> Any:
    """Within it, a profile has no other test purposes."""
    with mock.patch.object(rejudging, "purposes_for", return_value=tuple(purposes)):
        yield


def judged(record: Record, plan: RunPlan, purposes: Iterable[TestPurpose]) -> Judged:
    """``record`` judged again, as that of a run of ``purposes``."""
    with only(purposes):
        return judge_again(record, plan)
