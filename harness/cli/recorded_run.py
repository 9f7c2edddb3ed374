"""A run with a record, for certificates: the run of ``ucm-cts run``, once and as a whole."""

from __future__ import annotations

from dataclasses import dataclass

from ucm_cts.harness.certificates.rejudging import RunPlan
from ucm_cts.harness.cli.framework_run import FrameworkRun
from ucm_cts.harness.cli.one_run import carry_out
from ucm_cts.harness.cli.options import greet, name_of
from ucm_cts.harness.cli.terminal import Output
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.recording import Record, RecordingDriver
from ucm_cts.harness.exploring.in_runs import draw_scenarios
from ucm_cts.harness.hosting.locate import WrongUse, locate
from ucm_cts.harness.results.known_failures import known_today
from ucm_cts.harness.results.values import FrameworkReport
from ucm_cts.harness.statement.applicability import purposes_for
from ucm_cts.harness.statement.files import check_subject, stated_by


@dataclass(frozen=True)
class RecordedRun:
    """A run that has ended: its report, its record, and the plan by which the record is judged again."""

    report: FrameworkReport
    record: Record
    plan: RunPlan


def run_recorded(wanted: FrameworkRun, console: Output) -> RecordedRun:
    """Run what is ``wanted``, one run of a whole profile. Failures that an earlier run remembered are not tried.

    Raises ``WrongUse``, ``DocumentError`` and ``HostUnavailable``; whoever interrupts the run gets no record.
    """
    plan = _plan(wanted)
    purposes = purposes_for(plan.statement, plan.profile, plan.systematic)
    with RecordingDriver(locate(wanted.adapter, wanted.in_process), plan.seed, wanted.limits) as driver:
        check_subject(plan.statement, driver.identity, plan.profile)
        greet(console, name_of(driver.identity), plan.profile, plan.seed)
        campaign = Campaign(driver, plan.profile, plan.known, plan.statement)
        carry_out(campaign, purposes, lambda: draw_scenarios(campaign, plan.seed, plan.drawn), console)
        return RecordedRun(campaign.report(), driver.record, plan)


def _plan(wanted: FrameworkRun) -> RunPlan:
    """Only what is derived again can be judged again."""
    parts = {
        "-k": wanted.expression,
        "--repeat": wanted.repeat != 1,
        "--resume": wanted.resume,
        "--failed-first": wanted.failed_first,
        "--in-process": wanted.in_process,
    }
    named = next((option for option, is_given in parts.items() if is_given), None)
    if named is not None:
        raise WrongUse(f"{named} cannot be certified: a certificate is of one whole run of a profile; leave it out")
    if wanted.explore.is_time and wanted.explore.amount:
        raise WrongUse(
            "a certificate counts the scenarios that are drawn; write a number of them, such as 500scenarios"
        )
    return RunPlan(
        wanted.profile,
        wanted.seed,
        stated_by(wanted.ics, wanted.adapter),
        known_today(wanted.known_failures),
        wanted.systematic,
        int(wanted.explore.amount),
        wanted.limits.seconds,
        wanted.limits.memory,
        wanted.limits.incident_seconds,
    )
