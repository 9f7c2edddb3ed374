"""Drawn scenarios as a part of each run of the suite; what fails is remembered in the folder of the report."""

from __future__ import annotations

from pathlib import Path

from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.exploring.exploration import DRAWN, KNOWN, Exploration
from ucm_cts.harness.exploring.memory import Memory, open_databases
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.results.values import FrameworkReport

DRAWN_SCENARIOS = "scenarios drawn at random"
"""The measure of how many scenarios a run drew."""

EXAMPLES = "examples"
"""The folder, within that of the report, of failures that drawn scenarios showed."""


def exploration_in(out: Path | None, campaign: Campaign, seed: int) -> Exploration:
    """Draws scenarios for ``campaign``. It knows the failures that are remembered in the report's folder ``out``, if there is one."""
    kept = out / EXAMPLES if out is not None else None
    is_there = kept is not None and kept.is_dir() and not kept.is_symlink()
    memory = _memory(out, campaign.report()) if out is not None and is_there else None
    return Exploration(campaign, seed, memory)


def draw_scenarios(campaign: Campaign, seed: int, most: int) -> int:
    """Draw ``most`` scenarios, or fewer if nothing more can be tried, and count them. Returns how many causes of failure they show."""
    failures, far = 0, 0
    if most:
        for progress in exploration_in(None, campaign, seed).explore():
            failures, far = progress.failures, progress.scenarios
            if far >= most:
                break
        campaign.count(DRAWN_SCENARIOS, far)
    return failures


def remember_in(out: Path, report: FrameworkReport) -> str:
    """Keep in ``out`` the failures that drawn scenarios showed: the next run into the same folder tries them again. Returns what prevents
    that, empty if nothing does.
    """
    named = (DRAWN, KNOWN)
    shown_by = [found.execution for result in report.requirements for found in result.findings]
    shown_by += [item.execution for item in report.incidents]
    if any(execution is not None and execution.name.startswith(named) for execution in shown_by):
        try:
            _memory(out, report).remember_all(report, named)
        except (OSError, WrongUse) as error:
            return f"failures of drawn scenarios are not kept for the next run: {error}"
    return ""


def _memory(out: Path, report: FrameworkReport) -> Memory:
    return Memory(open_databases([str(out / EXAMPLES)]), report.product, report.profile)
