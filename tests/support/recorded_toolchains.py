"""Runs of tool chains of ours that were recorded, for tests that judge them again."""

from __future__ import annotations

import functools
from dataclasses import dataclass

import msgspec

from ucm_cts.adapters.mutants.toolchain.registry import Mutant, Variant, mutants, variants
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.results.values import ToolChainReport
from ucm_cts.harness.selftest.toolchains import declaring
from ucm_cts.harness.toolchains.campaign import TASKS, ToolChainCampaign, ToolChainPlan
from ucm_cts.harness.toolchains.commands.description import Command, ToolChain
from ucm_cts.harness.toolchains.commands.processing import InProcess, Processor
from ucm_cts.harness.toolchains.examinations import examination_for
from ucm_cts.harness.toolchains.recording import Recorder, ToolChainRecord
from ucm_cts.harness.toolchains.renaming import Renaming
from ucm_cts.harness.toolchains.selecting import as_selected

SEED = 5
COMMAND = Command(("ucm-cts-toolchain", "{model}", "{out}"))


@dataclass(frozen=True)
class Recorded:
    """A run: what was recorded, what it was of, and what came out."""

    record: ToolChainRecord
    plan: ToolChainPlan
    report: ToolChainReport
    expression: str


@functools.cache
def recorded(profile: str, expression: str = "", subject: str = "", seed: int = SEED) -> Recorded:
    """A run on the reference tool chain, or on the mutant or variant ``subject``."""
    known: dict[str, Mutant | Variant] = {**mutants(), **variants()}
    program = known[subject].derive(reference()) if subject else reference()
    readings = known[subject].declares if subject else ()
    return run_on(InProcess(program), profile, expression, readings, seed)


def run_on(
    processor: Processor, profile: str, expression: str = "", readings: tuple[str, ...] = (), seed: int = SEED
) -> Recorded:
    """A run on ``processor`` that declares ``readings``."""
    task = TASKS[profile]
    toolchain = ToolChain("ours", "1", **{task: COMMAND})  # type: ignore[arg-type]
    statement = declaring(readings) if readings else default_statement()
    plan = ToolChainPlan("ours", "1", profile, statement, jobs=2, seed=seed, source="ours.toml")
    examination = examination_for(profile, statement, Renaming(seed), expression, COMMAND)
    recorder = Recorder(processor)
    campaign = ToolChainCampaign(recorder, examination, plan)
    for _ in campaign.process():
        pass
    campaign.judge()
    for _ in campaign.confirm():
        pass
    report = as_selected(campaign.report(), campaign, profile, expression)
    names = [name for name, _ in examination.models]
    return Recorded(recorder.record(toolchain, task, report, names, plan.jobs), plan, report, expression)


def without_times(report: ToolChainReport) -> ToolChainReport:
    """``report`` without how long requirements took, which no record shows."""
    results = tuple(msgspec.structs.replace(one, seconds=0.0) for one in report.requirements)
    return msgspec.structs.replace(report, requirements=results)
