"""Trials of adapters that cheat, in the ordinary pipeline: the requirements of their register must fail (docs/honesty.md)."""

from __future__ import annotations

import importlib
import time
from typing import Any

from ucm_cts.adapters.mutants.python.subjects import CHEATS, UNSEEN, Cheat
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.results.values import FrameworkReport
from ucm_cts.harness.selftest.matrix import CheatResult

_IN_HOSTS = ("exchanging", "intruding", "recognising", "tampering")
"""The cheats of these modules change the SDK, or look at their process. The others run in the harness's own: some of them learn
from one run for the next.
"""

ENDS_THE_HOST = {"leaves_when_it_fails"}

FEW, MANY = 30, 40
"""At most ``FEW`` purposes are run, and none of more than ``MANY`` scenarios."""


def examine_cheat(cheat: Cheat) -> CheatResult:
    """The trial of ``cheat``: the failed requirements and incidents, compared with its register."""
    began = time.monotonic()
    report = report_on(cheat)
    came_out = tuple(sorted(what_came_out(report)))
    shown = any(due and set(due) <= set(came_out) for due in (cheat.detected_by, cheat.or_else))
    found = report.verdict != "conformant" and shown
    as_it_should = found if cheat.detected_by else not came_out
    seconds = round(time.monotonic() - began, 3)
    return CheatResult(cheat.name, cheat.lie, cheat.detected_by, came_out, as_it_should, seconds)


def all_cheats() -> dict[str, Cheat]:
    """All cheats, also those that no observation can show, by name."""
    return {**CHEATS, **UNSEEN}


def report_on(cheat: Cheat) -> FrameworkReport:
    """The report of a run of ``cheat``, after its rehearsals."""
    in_process = cheat.name not in ENDS_THE_HOST and not (
        cheat.adapter and cheat.adapter.__module__.endswith(_IN_HOSTS)
    )
    _rehearse(cheat, True)
    for seed in range(1, cheat.rehearsals + 2):
        if seed > cheat.rehearsals:
            _rehearse(cheat, False)
        limits = Limits(seconds=5, incident_seconds=2)
        with Driver(locate(cheat.endpoint, in_process), seed, limits) as driver:
            campaign = Campaign(driver, "core")
            for _ in campaign.check(purposes(cheat)):
                pass
            report = campaign.report()
    return report


def purposes(cheat: Cheat) -> list[TestPurpose]:
    """The purposes that exercise the requirements that the cheat must fail, or the first ones, and unforeseen scenarios."""
    quick = [
        purpose
        for purpose in load_purposes("core")
        if len(purpose.scenarios) <= MANY
        and purpose.clause.startswith(cheat.clauses)
        and not purpose.id.startswith("self-executing")
    ]
    concerned = [p for p in quick if set(p.requirements) & set(cheat.detected_by) or p.id == "unforeseen"]
    return concerned if len(concerned) > 1 else [*quick[:FEW], *concerned]


def what_came_out(report: FrameworkReport) -> set[str]:
    """The requirements that failed, and the kinds of incidents."""
    failed = {result.id for result in report.requirements if result.verdict == "fail"}
    return failed | {item.incident.kind for item in report.incidents}


def _rehearse(cheat: Cheat, on: bool) -> None:
    if cheat.rehearsals:
        subject: Any = cheat.adapter or importlib.import_module(cheat.endpoint).player
        subject.rehearsing = on
