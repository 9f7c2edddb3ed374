"""A run with a dishonest host ends with a report; only behaviour of the framework fails a requirement."""

from __future__ import annotations

import json
import random
from pathlib import Path

import pytest
from command_line import ucm_cts
from hostile import lying
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.report.write import save_report
from ucm_cts.harness.results.values import FRAMEWORK_INCIDENTS, Report

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("here")]

LIES = st.lists(
    st.tuples(st.sampled_from(lying.KINDS), st.integers(0, 200), st.integers(0, 200)), min_size=1, max_size=4
)
PURPOSES = load_purposes("container")


def examples(number: int) -> settings:
    """The same examples each time; nothing is kept, and slow machines are no failures."""
    return settings(
        max_examples=number, derandomize=True, database=None, deadline=None, suppress_health_check=list(HealthCheck)
    )


def report_on(lies: list[tuple[str, int, int]], in_process: bool, purposes: int) -> Report:
    """The report on a host that tells ``lies``, written and with its failures shortened and replayed."""
    some = random.Random(json.dumps(lies)).sample(PURPOSES, purposes)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("LIES", json.dumps(lies))
        if not in_process:
            patch.setenv("DIES", "yes")
        limits = Limits(seconds=5, incident_seconds=2)
        with Driver(locate("hostile.lying", in_process), seed=3, limits=limits) as driver:
            campaign = Campaign(driver, "container")
            for _ in campaign.check(some):
                pass
            if in_process:
                for _ in campaign.shorten():
                    pass
            report = campaign.report()
        save_report(report, Path("out"))
        for saved in sorted(Path("out", "failures").glob("*.json"))[:1]:
            assert ucm_cts("replay", saved, "hostile.lying", *["--in-process"] * in_process).status in (0, 1)
    return report


@given(LIES)
@examples(60)
def test_traces_that_are_not_true(lies: list[tuple[str, int, int]]) -> None:
    report = report_on(lies, in_process=True, purposes=6)
    for result in report.requirements:
        for failed in result.findings:
            incident = failed.execution.incident
            assert incident is None or incident.kind in FRAMEWORK_INCIDENTS, failed.finding


@given(LIES)
@examples(8)
def test_last_words_that_are_not_true(lies: list[tuple[str, int, int]]) -> None:
    report = report_on(lies, in_process=False, purposes=2)
    assert report.incidents
    assert {item.incident.kind for item in report.incidents} <= {"exit", "protocol", "garbage", "untried"}


def test_step_that_does_not_exist_is_the_adapters_doing() -> None:
    report = report_on([("step", 1, 99), ("step", 0, 99)], in_process=True, purposes=6)
    assert {item.incident.kind for item in report.incidents} == {"contradiction"}
    assert {r.verdict for r in report.requirements} <= {"pass", "error", "inconclusive"}
