"""Adapters that cheat are found out by the ordinary pipeline, for the right reason; the limits of that are what docs/honesty.md says."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest

from ucm_cts.adapters.derived import CHEATS, UNSEEN, Cheat
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.results import Report
from ucm_cts.harness.running.campaign import Campaign
from ucm_cts.harness.running.driver import Driver, Limits
from ucm_cts.harness.scenarios.purposes import load_purposes
from ucm_cts.harness.scenarios.scripts import TestPurpose

ENDS_THE_HOST = {"leaves_when_it_fails"}
CHANGES_THE_SDK = {name for name, cheat in CHEATS.items() if cheat.adapter and "tampering" in cheat.adapter.__module__}
"""These cannot be run in this process."""

FEW, MANY = 30, 40
"""So many purposes are enough here, and so many scenarios of one are left to a run."""


def purposes(cheat: Cheat) -> list[TestPurpose]:
    """Those that mean to exercise what the cheat is to fail, or the first ones; and those that nobody foresees."""
    quick = [
        purpose
        for purpose in load_purposes("core")
        if len(purpose.scenarios) <= MANY
        and purpose.clause.startswith(cheat.clauses)
        and not purpose.id.startswith("self-executing")
    ]
    concerned = [p for p in quick if set(p.requirements) & set(cheat.detected_by) or p.id == "unforeseen"]
    return concerned if len(concerned) > 1 else [*quick[:FEW], *concerned]


def report_on(cheat: Cheat) -> Report:
    in_process = cheat.name not in ENDS_THE_HOST | CHANGES_THE_SDK
    rehearse(cheat, True)
    for seed in range(1, cheat.rehearsals + 2):
        if seed > cheat.rehearsals:
            rehearse(cheat, False)
        limits = Limits(seconds=5, incident_seconds=2)
        with Driver(locate(cheat.door, in_process), seed, limits) as driver:
            campaign = Campaign(driver, "core")
            for _ in campaign.check(purposes(cheat)):
                pass
            report = campaign.report()
    return report


def rehearse(cheat: Cheat, on: bool) -> None:
    if cheat.rehearsals:
        subject = cheat.adapter or importlib.import_module(cheat.door).player
        subject.rehearsing = on


def what_came_out(report: Report) -> set[str]:
    failed = {result.id for result in report.requirements if result.verdict == "fail"}
    return failed | {item.incident.kind for item in report.incidents}


@pytest.mark.parametrize("cheat", CHEATS.values(), ids=CHEATS.keys())
def test_cheat_is_found_out_for_the_right_reason(cheat: Cheat) -> None:
    report = report_on(cheat)
    assert report.verdict != "conformant"
    assert set(cheat.detected_by) <= what_came_out(report)


@pytest.mark.parametrize("cheat", UNSEEN.values(), ids=UNSEEN.keys())
def test_what_no_observation_shows(cheat: Cheat) -> None:
    assert not what_came_out(report_on(cheat))


def test_the_page_tells_of_each() -> None:
    page = (Path(__file__).parent.parent / "docs" / "honesty.md").read_text()
    for cheat in CHEATS.values():
        assert f"| `{cheat.name}`: {cheat.lie} | {', '.join(cheat.detected_by)} |" in page, cheat.name
    for cheat in UNSEEN.values():
        assert f"(`{cheat.name}`)" in page, cheat.name
