"""``ucm-cts run --toolchain``: certifies a tool chain."""

from __future__ import annotations

from pathlib import Path
from typing import NoReturn

from ucm_cts.harness.catalogue.profiles import TOOLCHAIN_PROFILES
from ucm_cts.harness.cli.options import greet, leave_with, name_of
from ucm_cts.harness.cli.terminal import Output, ends_like_interrupts, progress_of
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.write import prepare_folder, save_report
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.known_failures import known_today
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.statement.files import check_subject, read_statement
from ucm_cts.harness.toolchains.campaign import TASKS, ToolChainCampaign
from ucm_cts.harness.toolchains.commands.description import ToolChain, read_toolchain
from ucm_cts.harness.toolchains.commands.processing import CommandLine
from ucm_cts.harness.toolchains.examinations import examination_for
from ucm_cts.harness.toolchains.renaming import Renaming


def certify_toolchain(
    path: Path, profile: str, expression: str, out: Path, known_failures: Path | None, ics: Path | None, seed: int
) -> NoReturn:
    """Run ``profile`` on the tool chain that the file at ``path`` describes, write the report to ``out``, and end.

    Raises ``WrongUse`` and ``DocumentError``.
    """
    if profile not in TOOLCHAIN_PROFILES:
        raise WrongUse(f"profile '{profile}' is of frameworks; a tool chain has {', '.join(TOOLCHAIN_PROFILES)}")
    toolchain = read_toolchain(path)
    command = toolchain.command_for(TASKS[profile])
    if command is None:
        raise WrongUse(f"{path} does not say how '{TASKS[profile]}' is done, which profile '{profile}' needs")
    known = known_today(known_failures)
    statement = read_statement(ics) if ics is not None else default_statement()
    check_subject(statement, toolchain, profile)
    processor = CommandLine(toolchain)
    examination = examination_for(profile, statement, Renaming(seed, toolchain.dialect), expression, command)
    if not examination.models:
        raise WrongUse(f"no model matches -k '{expression}'; try a requirement or a part of its id")
    console = Output()
    greet(console, name_of(toolchain), profile, seed)
    prepare_folder(out)
    campaign = ToolChainCampaign(
        processor,
        examination,
        (toolchain.product, toolchain.version),
        profile,
        statement,
        known,
        source=str(path),
        seed=seed,
    )
    interrupted = _conduct(campaign, len(examination.models), console)
    for warning in campaign.warnings():
        console.say(f"warning: {warning}")
    report = campaign.report()
    save_report(report, out)
    leave_with(console, report, out, known, not expression, interrupted)


def profiles_of(toolchain: ToolChain) -> tuple[str, ...]:
    """The profiles for which ``toolchain`` has a command. Raises ``WrongUse`` if there is none."""
    profiles = tuple(p for p in TOOLCHAIN_PROFILES if toolchain.command_for(TASKS[p]) is not None)
    if not profiles:
        raise WrongUse(f"{toolchain.source} says of no task how it is done; there is [check], [idl], [cpp11], [cpp03]")
    return profiles


def _conduct(campaign: ToolChainCampaign, models: int, console: Output) -> bool:
    """Process all models, judge and confirm. Returns True if interrupted."""
    with ends_like_interrupts(), progress_of(console) as progress:
        task = progress.add_task("asking", total=models)
        try:
            for name in campaign.process():
                progress.update(task, advance=1, description=f"asking {one_line(name, 40)}")
        except KeyboardInterrupt:
            campaign.judge()
            return True
        campaign.judge()
        progress.update(task, description="confirming failures")
        try:
            for _ in campaign.confirm():
                pass
        except KeyboardInterrupt:
            return True
    return False
