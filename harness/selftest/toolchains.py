"""One tool chain derived from the reference one, in the ordinary pipeline: mutants must be killed, variants spared."""

from __future__ import annotations

import functools
import time
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace

import msgspec

from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.mutants.toolchain.registry import Mutant, Variant, mutants, variants
from ucm_cts.adapters.reference.toolchain.program import Program, reference
from ucm_cts.harness.catalogue.profiles import PARTS, TOOLCHAIN_PROFILES
from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.results.statement import Statement, default_statement
from ucm_cts.harness.results.values import MODEL_FILE, RequirementResult
from ucm_cts.harness.selftest.consulted import consulted_for
from ucm_cts.harness.selftest.matrix import Kill, MutantResult, VariantResult
from ucm_cts.harness.toolchains.campaign import TASKS, ToolChainCampaign, ToolChainPlan
from ucm_cts.harness.toolchains.commands.processing import InProcess
from ucm_cts.harness.toolchains.corpus.documentation import PART
from ucm_cts.harness.toolchains.examinations import examination_for
from ucm_cts.harness.toolchains.generation import documentation_models, mapping_models
from ucm_cts.harness.toolchains.renaming import Renaming

_REFERENCE = replace(reference(), read=functools.lru_cache(8192)(read_model))
"""Mutants differ in what they make of models, seldom in how they read them."""

SOME = 4
"""Models of generators that are processed before the verdicts are checked for the first time."""

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
    """The requirements of tool chains that have a check, without permissions: nothing breaks those."""
    parts = {part for profile in TOOLCHAIN_PROFILES for part in PARTS[profile]}
    return tuple(r.id for r in load_requirements() if r.profile in parts and r.rules and r.level != "may")


def examine_toolchain(subject: ToolChainSubject) -> MutantResult | VariantResult:
    """What becomes of ``subject``."""
    began = time.monotonic()
    known: Mapping[str, Mutant | Variant] = {**mutants(), **variants()}
    derived = known[subject.name]
    profile = _PROFILES[derived.task]
    statement = declaring(derived.declares, derived.claims)
    program = derived.derive(_REFERENCE)
    kills: dict[str, Kill] = {}
    models = 0
    trouble = ""
    for names in _batches(derived, program):
        examination = examination_for(profile, statement, Renaming(), models=names)
        campaign = ToolChainCampaign(
            InProcess(program), examination, ToolChainPlan(subject.name, "", profile, statement, jobs=1)
        )
        for _ in campaign.process():
            pass
        campaign.judge()
        report = campaign.report()
        models += report.models
        kills |= {r.id: _kill(r) for r in report.requirements if r.verdict == "fail" and r.id not in kills}
        unsettled = [r.id for r in report.requirements if r.verdict in ("error", "inconclusive")]
        trouble = f"undecided: {', '.join(unsettled)}" if unsettled and names is None else ""
        if subject.breaks and kills.keys() >= set(subject.breaks):
            break
    seconds = round(time.monotonic() - began, 3)
    failed = tuple(kills[requirement] for requirement in sorted(kills))
    if not subject.breaks:
        return VariantResult(subject.name, failed, (), models, seconds, trouble)
    clause = subject.breaks[0].removeprefix("R-").rpartition("-")[0]
    return MutantResult(subject.name, subject.lie, clause, subject.breaks, subject.also, failed, (), models, seconds)


def _batches(derived: Mutant | Variant, program: Program) -> list[tuple[str, ...] | None]:
    """The models to go through, None for all of them at once.

    What a generator makes as the reference tool chain makes it has been judged there. Of what it makes otherwise a mutant gets
    some after others, until it is found out; a variant gets the smallest and the largest ones, and of each option that it
    declares models whose comparison depends on that. Whoever claims the standard properties gets the models about these.
    """
    if derived.task == "check":
        return [None]
    if PART in derived.claims:
        return [tuple(documentation_models())]
    names = [
        name
        for name, text in mapping_models().items()
        if _made(program, derived.task, text) != _usual(derived.task, text)
    ]
    if isinstance(derived, Variant):
        wanted = tuple(dict.fromkeys((*names[:SOME], *names[-SOME:], *_shows_what_is_declared(derived, names))))
        return [wanted] if wanted else []
    return [tuple(names[first : first + SOME]) for first in range(0, len(names), SOME)]


def _shows_what_is_declared(variant: Variant, changed: Collection[str]) -> Iterator[str]:
    """For each option that ``variant`` declares, the smallest and the largest model that depends on it, if possible of those ``changed``."""
    consulted = consulted_for(variant.task) if variant.declares else {}
    for reading in variant.declares:
        option = reading.partition("=")[0]
        of_option = [name for name, options in consulted.items() if option in options]
        shown = [name for name in of_option if name in changed] or of_option
        yield from (*shown[:1], *shown[-1:])


def _made(program: Program, task: str, text: str) -> object:
    try:
        return program.generate(task, text.encode(), MODEL_FILE)[0]
    except Exception as problem:  # noqa: BLE001 - a mutant may do anything
        return type(problem)


@functools.lru_cache(256)
def _usual(task: str, text: str) -> object:
    return _made(_REFERENCE, task, text)


def declaring(readings: tuple[str, ...], claims: tuple[str, ...] = ()) -> Statement:
    """What holds without a statement, but for ``readings`` (``option=value``) and ``claims`` of parts."""
    default = default_statement()
    declared = dict(reading.split("=", 1) for reading in readings)
    capabilities = default.capabilities | dict.fromkeys(claims, True)
    return msgspec.structs.replace(default, readings=default.readings | declared, capabilities=capabilities)


def _kill(result: RequirementResult) -> Kill:
    """The reference tool chain fails no requirement, so each failure of a mutant is a difference from it."""
    finding = result.findings[0].finding
    difference = finding.expected, finding.observed
    return Kill(result.id, finding.cause, finding.rule, *difference, (), True, len(result.findings))


def _doc(one: Mutant | Variant) -> str:
    return " ".join((one.derive.__doc__ or one.name.replace("_", " ")).split()).rstrip(".")
