"""Carries out a campaign plan for ``ucm-cts campaign``: progress, interrupts, reports, history and the page."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

import ucm_cts
from ucm_cts.harness.campaigns import cluster
from ucm_cts.harness.campaigns.agenda import Agenda, Due
from ucm_cts.harness.campaigns.conducting import conduct
from ucm_cts.harness.campaigns.outcome import PAGE, SUMMARY, Outcome, outcome_of, write_outcome
from ucm_cts.harness.campaigns.plan import read_plan
from ucm_cts.harness.campaigns.planning import work_of
from ucm_cts.harness.campaigns.store import NotKept, Store
from ucm_cts.harness.cli.options import CONFORMANT, HARNESS_FAILED, NOT_CONFORMANT, leave
from ucm_cts.harness.cli.terminal import Interrupts, Output, ends_like_interrupts, progress_of
from ucm_cts.harness.history.store import append
from ucm_cts.harness.hosting.extras import need
from ucm_cts.harness.report.json_report import entry_of
from ucm_cts.harness.report.out_folder import OutFolder
from ucm_cts.harness.results.foreign import one_line

if TYPE_CHECKING:
    from distributed import Client

LISTED = 20
"""How many lines of each kind the terminal shows; the page has all."""


@dataclass(frozen=True)
class Wanted:
    """The arguments of ``ucm-cts campaign``."""

    plan: Path
    out: Path
    scheduler: str | None
    workers: int
    dashboard: str
    database: Path | None
    is_dry: bool


def carry_out_plan(wanted: Wanted) -> None:
    """Do what is missing of the plan, write what came out, and end. Raises ``WrongUse`` and ``DocumentError``."""
    need("campaigns", "a campaign")
    if wanted.database is not None:
        need("history", "a history")
    console = Output()
    plan = read_plan(wanted.plan)
    out = wanted.out.absolute()
    database = wanted.database.absolute() if wanted.database is not None else None
    with (
        ends_like_interrupts() as interrupts,
        contextlib.chdir(wanted.plan.absolute().parent),  # its paths, and adapters, are found from there
        OutFolder(out, (PAGE, SUMMARY)) as folder,
    ):
        work = work_of(plan)
        store = Store(out / "units")
        agenda = Agenda(work, store.has)
        ready = list(agenda.begin())
        before = f"{agenda.before} of them kept before"
        console.say(f"UCM-CTS {ucm_cts.__version__}: {one_line(plan.path.name, 80)}, {agenda.number} units, {before}")
        if wanted.is_dry:
            leave(console, CONFORMANT)
        problem = _conduct(wanted, console, agenda, ready, store, interrupts) if ready else ""
        with interrupts.held():
            outcome = outcome_of(wanted.plan, agenda, store)
            unwritten = write_outcome(outcome, folder)
            if database is not None:
                whole = [r for r in outcome.reports.values() if not (r.incomplete or r.selection)]
                number = sum(append(database, [entry_of(report) for report in whole]))
                console.say(f"{number} run{'' if number == 1 else 's'} appended to {wanted.database}")
        _show(console, outcome, wanted.out)
    if problem or unwritten:
        console.file.flush()
        click.echo(f"ucm-cts: {one_line(problem or unwritten, 600)}", err=True)
        sys.exit(HARNESS_FAILED)
    leave(console, CONFORMANT if outcome.summary.is_well else NOT_CONFORMANT)


def _conduct(
    wanted: Wanted, console: Output, agenda: Agenda, ready: Sequence[Due], store: Store, interrupts: Interrupts
) -> str:
    """Have the units that are ``ready``, and those that follow from them, done. Returns why that ended early, empty if it did not."""
    work = agenda.work
    is_timed = bool(work.runs) or any(unit.timed for unit in work.trials.values())
    try:
        with _workers(wanted) as client:
            cluster.check_workers(client, is_timed)
            if client.dashboard_link:
                console.say(f"dashboard {client.dashboard_link}")
            hidden = [str(store.folder.parent)] if wanted.scheduler is None else []
            workers = cluster.DaskWorkers(client, hidden)
            with progress_of(console) as progress:
                task = progress.add_task("", total=agenda.number, completed=agenda.before)

                def tell(due: Due) -> None:
                    lost = f"{len(agenda.lost)} without a result, " if agenda.lost else ""
                    text = f"{lost}{one_line(agenda.names[due.address], 60)}"
                    progress.update(task, completed=agenda.before + agenda.done + len(agenda.lost), description=text)
                    if interrupts.came:
                        raise KeyboardInterrupt

                conduct(agenda, ready, store, workers, tell)
    except KeyboardInterrupt:
        return "interrupted; what had ended is kept, and the same command goes on"
    except NotKept as problem:
        return str(problem)
    except cluster.SchedulerLost as problem:
        return f"the scheduler is gone ({problem}); what had ended is kept, and the same command goes on"
    return ""


def _workers(wanted: Wanted) -> AbstractContextManager[Client]:
    return cluster.at(wanted.scheduler) if wanted.scheduler else cluster.embedded(wanted.workers, wanted.dashboard)


def _show(console: Output, outcome: Outcome, out: Path) -> None:
    """The end of a campaign, on the terminal."""
    summary = outcome.summary
    lines = [f"{run.name}: {run.verdict or 'no report'}{f' ({run.why})' if run.why else ''}" for run in summary.runs]
    for one in summary.self_tests:
        generated = f", {one.generated_killed} of {one.generated} generated ones" if one.generated else ""
        lines.append(
            f"self-test/seed-{one.seed}: {one.killed} of {one.mutants} mutants killed{generated}, "
            f"{one.spared} of {one.variants} variants spared"
        )
        lines += one.wrong
    lines += [f"no result of {one.unit}: {one.why}" for one in summary.lost]
    for line in lines[:LISTED]:
        console.say(one_line(line, 300))
    if len(lines) > LISTED:
        console.say(f"and {len(lines) - LISTED} lines more")
    left = f", {summary.left} have not ended" if summary.left else ""
    console.say(f"{summary.units} units, {len(summary.lost)} without a result{left}; {out / PAGE} shows all")
