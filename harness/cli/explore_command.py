"""``ucm-cts explore``: run ADAPTER on generated scenarios."""

from __future__ import annotations

import random
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import click
from rich.progress import Progress, TaskID, TimeElapsedColumn, TimeRemainingColumn

from ucm_cts.harness.cli import options
from ucm_cts.harness.cli.options import Budget
from ucm_cts.harness.cli.terminal import Output, ends_like_interrupts, progress_of
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.exploring.exploration import Exploration, Replayed
from ucm_cts.harness.exploring.exploration import Progress as HowFar
from ucm_cts.harness.exploring.memory import Memory, open_databases
from ucm_cts.harness.exploring.printing import FILE, exploration_file, found_text, is_found, known_text, seen_text
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.report.write import FAILURE_FILES, failure_files, keep_files, report_folder
from ucm_cts.harness.statement.files import check_subject, stated_by

FOR_INCIDENTS = 0.5
"""The part of the budget that crashes and hangs may take before scenarios that would meet more of them are left out."""


@click.command()
@options.adapter_argument
@click.option(
    "--budget",
    type=options.DrawnScenarios(),
    default="60s",
    show_default=True,
    help="How long to draw scenarios, or how many: 60s, 5m, 2h, 500scenarios.",
)
@options.framework_profile_option
@options.seed_option
@options.out_folder("ucm-cts-exploration", "The folder for what is found.")
@click.option(
    "--database",
    "databases",
    multiple=True,
    help="Where failures are remembered: a folder, readonly:folder, or module:NAME of a hypothesis ExampleDatabase. "
    "May be given several times. Without it, the folder 'examples' in the folder of --out.",
)
@options.ics_option
@options.in_process_option
@options.virtual_time_option
@options.jobs_option
@options.no_sandbox_option
@options.timeout_option
def explore(
    adapter: str,
    budget: Budget,
    profile: str,
    seed: int | None,
    out: Path,
    databases: Sequence[str],
    ics: Path | None,
    in_process: bool,
    virtual_time: bool,
    jobs: int | None,
    no_sandbox: bool,
    timeout: float,
) -> None:
    """Draw random scenarios, and shorten those that fail.

    Failures are remembered and tried first the next time. Exit status: 0 nothing found, 1 something found or
    interrupted, 2 wrong use, 3 UCM-CTS itself failed.
    """
    console = Output()
    statement = stated_by(ics, adapter, not no_sandbox)
    drawn = seed if seed is not None else random.SystemRandom().randrange(2**32)
    incident_seconds = FOR_INCIDENTS * budget.amount if budget.is_time else Limits.incident_seconds
    limits = Limits(timeout, incident_seconds=incident_seconds)
    endpoint = locate(adapter, in_process, sandbox=not no_sandbox, hidden=[out], virtual_time=virtual_time)
    with (
        ends_like_interrupts() as interrupts,
        report_folder(out, [FILE]) as folder,
        Driver(endpoint, drawn, limits, jobs or statement.hosts_at_once) as driver,
    ):
        identity = driver.identity
        check_subject(statement, identity, profile)
        database = open_databases(databases or [str(out / "examples")])
        memory = Memory(database, identity.product, profile)
        options.greet(console, f"exploring {options.name_of(identity)}", profile, drawn)
        campaign = Campaign(driver, profile, (), statement)
        known, far, interrupted = _explore(campaign, Exploration(campaign, drawn, memory), memory, budget, console)
        with interrupts.held():
            report = campaign.report()
            files = {**failure_files(report), FILE: exploration_file(report, far, known)}
            saved = keep_files(files, folder, (*FAILURE_FILES, FILE))
            memory.remember_all(report)
    console.print(found_text(report, far, saved.place or out))
    if saved.problem:
        where = f"they are in '{saved.place}'" if saved.place is not None else "no folder took them"
        click.echo(f"ucm-cts: the results cannot be written: {saved.problem}; {where}", err=True)
        sys.exit(options.HARNESS_FAILED)
    if interrupted:
        console.print("interrupted: what was found so far is kept, and shortened the next time")
    found = is_found(report)
    options.leave(
        console, options.NOT_CONFORMANT if found or interrupted else options.CONFORMANT, f"; what was found is in {out}"
    )


def _explore(
    campaign: Campaign, exploration: Exploration, memory: Memory, budget: Budget, console: Output
) -> tuple[list[Replayed], HowFar, bool]:
    """The failures that are still there, the scenarios run, and whether the run was interrupted."""
    known: list[Replayed] = []
    far = HowFar(0, 0, 0, 0, 0)
    with progress_of(console, TimeElapsedColumn(), TimeRemainingColumn()) as progress:
        task = progress.add_task("running remembered failures", total=budget.amount)
        try:
            known = exploration.replay()
            if known or memory.unreadable:
                console.print(known_text(known, memory.unreadable))
            began = time.monotonic()
            seen = len(exploration.failures)
            for far in exploration.explore():
                for failure in exploration.failures[seen:]:
                    console.print(seen_text(*failure))
                seen = far.failures
                spent = budget.spent(far.scenarios, time.monotonic() - began)
                _show(progress, task, far, spent)
                if spent >= budget.amount:
                    break
            progress.update(task, description="shortening scenarios of failures", completed=budget.amount)
            campaign.confirm(passes=False)
            for _ in campaign.shorten():
                pass
        except KeyboardInterrupt:
            return known, far, True
    return known, far, False


def _show(progress: Progress, task: TaskID, far: HowFar, spent: float) -> None:
    text = (
        f"{far.scenarios} scenarios, {far.rows} of {far.of} rows, {far.events} pairs of events, {far.failures} failures"
    )
    progress.update(task, description=text, completed=spent)
