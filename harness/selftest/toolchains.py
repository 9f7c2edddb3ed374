"""One tool chain derived from the reference one, in the ordinary pipeline: is a mutant killed, is a variant spared?"""

from __future__ import annotations

import functools
import time
from collections.abc import Mapping
from dataclasses import dataclass, replace

import msgspec

from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.derived_toolchain.registry import Mutant, Variant, mutants, variants
from ucm_cts.adapters.toolchain.program import reference
from ucm_cts.harness.catalogue import load_requirements
from ucm_cts.harness.profiles import PARTS, TOOLCHAIN_PROFILES
from ucm_cts.harness.results import RequirementResult
from ucm_cts.harness.selftest.matrix import Kill, MutantResult, VariantResult
from ucm_cts.harness.stating.statement import Statement, default_statement
from ucm_cts.harness.toolchains.campaign import TASKS, ToolChainCampaign
from ucm_cts.harness.toolchains.dressing import Dress
from ucm_cts.harness.toolchains.examinations import examination_for
from ucm_cts.harness.toolchains.processing import InProcess

_REFERENCE = replace(reference(), read=functools.lru_cache(8192)(read_model))
"""Mutants differ in what they make of models, seldom in how they read them."""

_PROFILES: dict[str, str] = {task: profile for profile, task in TASKS.items()}


@dataclass(frozen=True)
class ToolChainSubject:
    """A derived tool chain by its name; a conformant variant breaks nothing."""

    name: str
    lie: str
    breaks: tuple[str, ...]
    also: tuple[str, ...] = ()


def all_subjects() -> Mapping[str, ToolChainSubject]:
    """All mutants, then all variants."""
    wrong = {m.name: ToolChainSubject(m.name, _doc(m), m.breaks, m.also) for m in mutants().values()}
    return wrong | {v.name: ToolChainSubject(v.name, _doc(v), ()) for v in variants().values()}


def testable_of_toolchains() -> tuple[str, ...]:
    """The requirements of tool chains that rules stand for and that can be broken."""
    parts = {part for profile in TOOLCHAIN_PROFILES for part in PARTS[profile]}
    return tuple(r.id for r in load_requirements() if r.profile in parts and r.rules and r.level != "may")


def examine_toolchain(subject: ToolChainSubject) -> MutantResult | VariantResult:
    """What becomes of ``subject``."""
    began = time.monotonic()
    known: Mapping[str, Mutant | Variant] = {**mutants(), **variants()}
    derived = known[subject.name]
    profile = _PROFILES[derived.task]
    statement = declaring(derived.declares)
    examination = examination_for(profile, statement, Dress())
    program = derived.derive(_REFERENCE)
    campaign = ToolChainCampaign(InProcess(program), examination, (subject.name, ""), profile, statement, jobs=1)
    for _ in campaign.ask():
        pass
    campaign.judge()
    report = campaign.report()
    failed = tuple(_kill(result) for result in report.requirements if result.verdict == "fail")
    seconds = round(time.monotonic() - began, 3)
    if not subject.breaks:
        unsettled = tuple(r.id for r in report.requirements if r.verdict in ("error", "inconclusive"))
        trouble = f"undecided: {', '.join(unsettled)}" if unsettled else ""
        return VariantResult(subject.name, failed, (), report.scenarios, seconds, trouble)
    clause = subject.breaks[0].removeprefix("R-").rpartition("-")[0]
    return MutantResult(
        subject.name, subject.lie, clause, subject.breaks, subject.also, failed, (), report.scenarios, seconds
    )


def declaring(readings: tuple[str, ...]) -> Statement:
    """What holds without a statement, but for ``readings`` (``option=value``)."""
    default = default_statement()
    declared = dict(reading.split("=", 1) for reading in readings)
    return msgspec.structs.replace(default, readings=default.readings | declared)


def _kill(result: RequirementResult) -> Kill:
    """The reference tool chain fails nothing, so whatever a mutant fails is where it parts from it."""
    finding = result.findings[0].finding
    told = finding.expected, finding.observed
    return Kill(result.id, finding.cause, finding.rule, *told, (), True, len(result.findings))


def _doc(one: Mutant | Variant) -> str:
    return " ".join((one.derive.__doc__ or one.name.replace("_", " ")).split()).rstrip(".")
