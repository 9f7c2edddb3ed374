"""``ucm-cts run --toolchain``: certifies a tool chain."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from ucm_cts.harness.catalogue.profiles import TOOLCHAIN_PROFILES
from ucm_cts.harness.cli.last_run import failed_in
from ucm_cts.harness.cli.options import greet, leave_with, name_of, nothing_selected
from ucm_cts.harness.cli.terminal import Interrupts, Output, ends_like_interrupts, progress_of
from ucm_cts.harness.hosting.extras import need
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.purposes.selection import words_of
from ucm_cts.harness.report.write import keep_report, report_folder
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.known_failures import KnownFailure, known_today
from ucm_cts.harness.results.statement import Statement, default_statement
from ucm_cts.harness.results.tally import ended_early
from ucm_cts.harness.results.values import ToolChainReport
from ucm_cts.harness.statement.files import check_subject, read_statement
from ucm_cts.harness.toolchains.campaign import TASKS, Examination, ToolChainCampaign, ToolChainPlan
from ucm_cts.harness.toolchains.commands.description import ToolChain, read_toolchain
from ucm_cts.harness.toolchains.commands.processing import CommandLine, Processor
from ucm_cts.harness.toolchains.examinations import examination_for
from ucm_cts.harness.toolchains.recording import Recorder, ToolChainRecord
from ucm_cts.harness.toolchains.renaming import Renaming
from ucm_cts.harness.toolchains.selecting import as_selected, named, testable


@dataclass(frozen=True)
class ToolChainRun:
    """What a user wants: the arguments of ``ucm-cts run --toolchain``.

    ``path``: the file that describes the tool chain.
    ``everything``: the summary lists everything.
    ``hidden``: what its commands must not see, besides the report.
    """

    path: Path
    profile: str
    expression: str
    out: Path
    known_failures: Path | None
    ics: Path | None
    seed: int
    everything: bool = False
    failed_first: bool = False
    sandbox: bool = True
    hidden: tuple[Path, ...] = ()


@dataclass(frozen=True)
class ToolChainRan:
    """A run that is over: its ``plan``, its ``report``, its ``record``, and the failures that were ``known``."""

    plan: ToolChainPlan
    report: ToolChainReport
    record: Callable[[], ToolChainRecord]
    known: Sequence[KnownFailure]


def certify_toolchain(wanted: ToolChainRun) -> NoReturn:
    """Run it, write the report, and end. Raises ``WrongUse`` and ``DocumentError``."""
    prepared = prepare(wanted)
    console = Output()
    with ends_like_interrupts() as interrupts, interrupts.held(), report_folder(wanted.out) as folder:
        ran = run_toolchain(prepared, console, interrupts)
        leave_with(console, ran.report, keep_report(ran.report, folder), ran.known, wanted.everything)


@dataclass(frozen=True)
class Prepared:
    """What a run needs: all that a user may have got wrong has been checked."""

    wanted: ToolChainRun
    toolchain: ToolChain
    statement: Statement
    known: Sequence[KnownFailure]
    processor: Processor
    examination: Examination


def prepare(wanted: ToolChainRun) -> Prepared:
    """Check what is ``wanted``, and run nothing yet. Raises ``WrongUse`` and ``DocumentError``."""
    path, profile, expression = wanted.path, wanted.profile, wanted.expression
    need("toolchain", "certifying a tool chain")
    toolchain = read_toolchain(path)
    command = toolchain.command_for(TASKS[profile])
    if command is None:
        raise WrongUse(f"{path} does not say how '{TASKS[profile]}' is done, which profile '{profile}' needs")
    known = known_today(wanted.known_failures)
    statement = stated_of_toolchain(wanted.ics, toolchain, profile)
    processor = CommandLine(toolchain, wanted.sandbox, [wanted.out, *wanted.hidden])
    examination = examination_for(
        profile, statement, Renaming(wanted.seed, toolchain.dialect), expression, command, sandbox=wanted.sandbox
    )
    ids = testable(profile)
    names = [name for name, _ in examination.models]
    words = words_of(expression)
    if expression and not named(ids, expression) and not any(word in name.lower() for word in words for name in names):
        raise nothing_selected(expression, [*ids, *names], "model")
    if not examination.models:
        raise nothing_selected(expression, ids, "model")
    return Prepared(wanted, toolchain, statement, known, processor, examination)


def run_toolchain(prepared: Prepared, console: Output, interrupts: Interrupts) -> ToolChainRan:
    """Run it, and write no report; ``interrupts`` are held."""
    wanted, toolchain, examination = prepared.wanted, prepared.toolchain, prepared.examination
    greet(console, name_of(toolchain), wanted.profile, wanted.seed)
    plan = ToolChainPlan(
        toolchain.product,
        toolchain.version,
        wanted.profile,
        prepared.statement,
        prepared.known,
        source=str(wanted.path),
        seed=wanted.seed,
        first=failed_in(wanted.out, console).models if wanted.failed_first else (),
    )
    recorder = Recorder(prepared.processor)
    campaign = ToolChainCampaign(recorder, examination, plan)
    incomplete = _conduct(campaign, len(examination.models), console, interrupts)
    if not campaign.is_judged:
        campaign.judge()
    for warning in campaign.warnings():
        console.say(f"warning: {warning}")
    report = ended_early(campaign.report(), incomplete)
    report = as_selected(report, campaign, wanted.profile, wanted.expression)

    def record() -> ToolChainRecord:
        names = [name for name, _ in examination.models]
        return recorder.record(toolchain, TASKS[wanted.profile], report, names, plan.jobs)

    return ToolChainRan(plan, report, record, prepared.known)


def stated_of_toolchain(path: Path | None, toolchain: ToolChain, profile: str) -> Statement:
    """The statement in the file at ``path``, else the default, about ``toolchain``. Raises ``WrongUse`` and ``DocumentError``."""
    statement = read_statement(path) if path is not None else default_statement()
    check_subject(statement, toolchain, profile)
    return statement


def profiles_of(toolchain: ToolChain) -> tuple[str, ...]:
    """The profiles for which ``toolchain`` has a command. Raises ``WrongUse`` if there is none."""
    profiles = tuple(p for p in TOOLCHAIN_PROFILES if toolchain.command_for(TASKS[p]) is not None)
    if not profiles:
        raise WrongUse(f"{toolchain.source} says of no task how it is done; there is [check], [idl], [cpp11], [cpp03]")
    return profiles


def _conduct(campaign: ToolChainCampaign, models: int, console: Output, interrupts: Interrupts) -> str:
    """Process all models, judge and confirm. Returns why that ended early, empty if it did not."""
    done = 0
    with progress_of(console) as progress:
        task = progress.add_task("asking", total=models)
        try:
            with interrupts.permitted():
                for name in campaign.process():
                    done += 1
                    progress.update(task, advance=1, description=f"asking {one_line(name, 40)}")
                progress.update(task, description="confirming failures")
                campaign.judge()
                for _ in campaign.confirm():
                    pass
        except KeyboardInterrupt:
            return f"interrupted after {done} of {models} models"
    return ""
