"""Trials of one mutant or one conformant variant: the ordinary pipeline examines it, and the result says what failed and why."""

from __future__ import annotations

import atexit
import functools
import time
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

import msgspec

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.adapters.mutants.cpp import COMMAND, NativeMutant, being, native_mutants
from ucm_cts.adapters.mutants.python.subjects import CONTAINER, MUTANTS, VARIANTS, Mutant
from ucm_cts.harness.catalogue.requirements import load_life_cycle, load_requirements
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.confirmation import is_timed
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.execution.leftovers import HOST_CHECKS
from ucm_cts.harness.hosting.hosts import HostUnavailable
from ucm_cts.harness.hosting.locate import WrongUse, locate
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.results.failures import length
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.values import Execution, FrameworkReport
from ucm_cts.harness.selftest.divergence import divergence
from ucm_cts.harness.selftest.matrix import Kill, MutantResult, VariantResult
from ucm_cts.harness.selftest.wording import Wording
from ucm_cts.harness.statement.applicability import purposes_for, why_not
from ucm_cts.harness.statement.files import stated_by
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.monitor import Monitor

PATIENCE = 500
"""Milliseconds, as a vendor would declare them: mutants often never do what is waited for, and their machine is this one."""

COMPARED = 25
"""The number of findings for a requirement that are compared with the trace of the right framework, short scenarios first."""

LIMITS_OF_MUTANTS = Limits(seconds=3, incident_seconds=20)
"""What a trial waits for a mutant that hangs."""

LIMITS_OF_VARIANTS = Limits(seconds=60)
"""A conformant variant does not hang: when it does not answer, the machine is busy."""

_OF_EXTENSIONS = ("10.2", "10.3", "10.4", "10.5")
"""Clauses of profile extensions."""

_DERIVED = "ucm_cts.adapters.mutants.python"

Shown = tuple[Finding, Execution]


@dataclass(frozen=True)
class Subject:
    """A framework whose verdicts are known.

    ``name``: its name.
    ``lie``: its defect, one sentence; empty for a variant.
    ``adapter``: its endpoint.
    ``reference``: the reference framework, whose statement it has, but for ``readings``.
    ``model``: endpoint of the framework that it was made from.
    ``model_readings``: the readings that are declared of that one, where they are not the reference framework's.
    ``clauses``: beginnings of the clauses whose purposes are run.
    ``breaks``: the requirements that it must fail; none for a conformant variant.
    ``also``: the requirements that it may fail too.
    ``readings``: its own readings.
    ``is_native``: it is part of the executable with the native mutants.
    ``is_rare``: its defect shows rarely.
    """

    name: str
    lie: str
    adapter: str
    reference: str
    model: str
    clauses: tuple[str, ...]
    breaks: tuple[str, ...] = ()
    also: tuple[str, ...] = ()
    readings: Mapping[str, str] = field(default_factory=dict)
    model_readings: Mapping[str, str] = field(default_factory=dict)
    is_native: bool = False
    is_rare: bool = False


@dataclass(frozen=True)
class Thoroughness:
    """How much is run.

    ``seed``: of the run.
    ``whole``: the whole profile instead of the subject's own clauses, for a mutant that is killed, too.
    ``quick``: begin with what is likely to kill a mutant, and end when it is killed; otherwise it is spared what is derived from dimensions then.
    ``beginning``: only purposes whose names begin so.
    ``real_time``: subjects in Python, and native ones of profile extensions, run in real time instead of virtual time.
    """

    seed: int = 1
    whole: bool = False
    quick: bool = False
    beginning: str = ""
    real_time: bool = False


def all_mutants() -> dict[str, Subject]:
    """Every mutant there is, by name. Native ones come with an installed suite only."""
    native = native_mutants() if COMMAND.is_file() else {}
    return {m.name: _subject(m) for m in MUTANTS.values()} | {
        name: native_subject(mutant) for name, mutant in native.items()
    }


def _subject(mutant: Mutant) -> Subject:
    reference = "reference-py"
    model = f"{_DERIVED}:{mutant.made_from}" if mutant.made_from else reference
    of_model = VARIANTS[mutant.made_from].readings if mutant.made_from else {}
    own = mutant.clauses, mutant.requirements, mutant.also, mutant.readings, of_model
    return Subject(mutant.name, mutant.lie, f"{_DERIVED}:{mutant.name}", reference, model, *own)


def native_subject(mutant: NativeMutant, command: Path = COMMAND) -> Subject:
    """The native ``mutant`` that is in the executable ``command``."""
    reference = "reference-cpp"
    own = mutant.clauses, mutant.requirements, mutant.also, mutant.readings
    return Subject(
        mutant.name, mutant.lie, str(command), reference, reference, *own, is_native=True, is_rare=mutant.is_rare
    )


def all_variants() -> dict[str, Subject]:
    """Every conformant variant there is, by name. One of 10.3.1 runs the test purposes of all of 10.3, and so on."""
    reference = "reference-py"
    return {
        v.name: Subject(
            v.name, "", f"{_DERIVED}:{v.name}", reference, reference, _whole(v.clauses), readings=v.readings
        )
        for v in VARIANTS.values()
    }


def _whole(clauses: tuple[str, ...]) -> tuple[str, ...]:
    """``clauses``, and instead of a part of a clause of profile extensions the whole clause."""
    return tuple(next((whole for whole in _OF_EXTENSIONS if clause.startswith(whole)), clause) for clause in clauses)


def examine_mutant(subject: Subject, how: Thoroughness) -> MutantResult:
    """The trial of a mutant: which requirements fail, and whether for the right reason."""
    ran = _run(subject, how)
    kills = tuple(ran.kill(subject, requirement) for requirement in sorted(ran.shown))
    return MutantResult(
        subject.name,
        subject.lie,
        subject.breaks[0].removeprefix("R-").rpartition("-")[0],
        subject.breaks,
        subject.also,
        kills,
        ran.incidents,
        ran.scenarios,
        ran.seconds,
        ran.trouble,
        subject.is_rare,
        tuple(ran.wrongly_said()),
    )


def examine_variant(subject: Subject, how: Thoroughness) -> VariantResult:
    """The trial of a conformant variant: the requirements that fail, although none may."""
    ran = _run(subject, how)
    failed = tuple(ran.kill(subject, requirement) for requirement in sorted(ran.shown))
    return VariantResult(subject.name, failed, ran.incidents, ran.scenarios, ran.seconds, ran.trouble)


@dataclass
class _Trial:
    """What the ordinary pipeline showed of one subject."""

    seed: int
    virtual_time: bool
    shown: dict[str, list[Shown]] = field(default_factory=dict)
    right: dict[str, Kill] = field(default_factory=dict)
    incidents: tuple[str, ...] = ()
    scenarios: int = 0
    seconds: float = 0.0
    trouble: str = ""

    def wrongly_said(self) -> Iterator[str]:
        """Of each property one finding whose text is wrong."""
        met: set[tuple[str, str]] = set()
        wordings: dict[int, Wording] = {}
        for finding, execution in (one for shown in self.shown.values() for one in shown):
            wording = wordings.setdefault(id(execution.scenario), Wording(execution.scenario))
            problem = wording.problem(finding)
            if problem and (finding.rule, problem) not in met:
                met.add((finding.rule, problem))
                said = f"expected {finding.expected}; observed {finding.observed}"
                yield f"{problem}: {finding.requirement} ({finding.rule}) in {execution.name}: {said}"

    def kill(self, subject: Subject, requirement: str) -> Kill:
        """The finding that says best why ``requirement`` failed."""
        known = self.right.get(requirement)
        if known is not None:
            return known
        by_length = sorted(self.shown[requirement], key=lambda shown: length(shown[1]))[:COMPARED]
        for number, (finding, execution) in enumerate(by_length, 1):
            if _names_the_place(subject, self, finding, execution):
                self.right[requirement] = _kill(finding, execution, True, number)
                return self.right[requirement]
        return _kill(*by_length[0], False, len(by_length))


def _run(subject: Subject, how: Thoroughness) -> _Trial:
    is_extended = subject.clauses[0].startswith(_OF_EXTENSIONS)
    # native defects of the other clauses are of threads, which meet as they do only in real time
    ran = _Trial(how.seed, not how.real_time and (is_extended or not subject.is_native))
    began = time.monotonic()
    profile = "extensions" if is_extended else "core" if how.whole or subject.clauses != CONTAINER else "container"
    statement = _statement(subject)
    try:
        endpoint = locate(subject.adapter, virtual_time=ran.virtual_time)
        with _being(subject), Driver(endpoint, how.seed, _limits(subject)) as driver:
            campaign = Campaign(driver, profile, (), statement)
            purposes = _purposes(subject, how, profile, statement)
            if how.quick:
                _check(ran, subject, campaign, _likely_first(purposes, subject), may_end=True)
            else:
                written = [purpose for purpose in purposes if not purpose.of_dimensions]
                derived = [purpose for purpose in purposes if purpose.of_dimensions]
                _check(ran, subject, campaign, written, may_end=False)
                _check(ran, subject, campaign, derived, may_end=not how.whole)
            report = campaign.report()
            ran.incidents = _incidents_of(report)
            if not subject.breaks and not how.beginning:
                ran.trouble = _undecided(report, purposes, statement)
    except (HostUnavailable, WrongUse) as problem:
        ran.trouble = str(problem)
    ran.seconds = round(time.monotonic() - began, 3)
    return ran


def _check(ran: _Trial, subject: Subject, campaign: Campaign, purposes: Sequence[TestPurpose], may_end: bool) -> None:
    """Add what ``purposes`` show; with ``may_end`` only until a mutant is killed."""
    if may_end and _is_killed(ran, subject):
        return
    for checked in campaign.check(purposes):
        for finding, execution in checked.failures:
            if finding is not None:
                ran.shown.setdefault(finding.requirement, []).append((finding, execution))
        ran.scenarios += checked.executions
        if may_end and _is_killed(ran, subject):
            return


def _limits(subject: Subject) -> Limits:
    return LIMITS_OF_MUTANTS if subject.breaks else LIMITS_OF_VARIANTS


def _being(subject: Subject) -> AbstractContextManager[None]:
    return being(subject.name) if subject.is_native else nullcontext()


def _is_killed(ran: _Trial, subject: Subject) -> bool:
    return bool(subject.breaks) and (any if subject.is_rare else all)(
        requirement in ran.shown and ran.kill(subject, requirement).names_the_place for requirement in subject.breaks
    )


def _undecided(report: FrameworkReport, purposes: Iterable[TestPurpose], statement: Statement) -> str:
    """The requirements that ``purposes`` ask for and that nothing exercised, told as a trouble: what a vendor may declare leaves none so,
    but for those that need a test facility which is not offered.
    """
    asked = {requirement for purpose in purposes for requirement in purpose.requirements}
    decidable = {r.id for r in load_requirements() if r.id in asked and why_not(r, statement) is None}
    without = (r for r in report.requirements if r.verdict in ("error", "inconclusive") and not r.exercised)
    unsettled = [r.id for r in without if r.id in decidable]
    return f"undecided: {', '.join(unsettled)}" if unsettled else ""


def _incidents_of(report: FrameworkReport) -> tuple[str, ...]:
    incidents = (item.incident for item in report.incidents)
    return tuple(dict.fromkeys(f"{incident.kind}: {incident.detail.splitlines()[0]}" for incident in incidents))


def _purposes(subject: Subject, how: Thoroughness, profile: str, statement: Statement) -> Sequence[TestPurpose]:
    """Those for what the subject breaks come first."""
    purposes = [p for p in purposes_for(statement, profile) if p.id.startswith(how.beginning)]
    own = purposes if how.whole else [p for p in purposes if p.clause.startswith(subject.clauses)]
    return sorted(own, key=lambda purpose: not _concerns(purpose, subject))


def _likely_first(purposes: Iterable[TestPurpose], subject: Subject) -> list[TestPurpose]:
    """``purposes``, those first that are likely to kill ``subject``, or take little time."""
    return sorted(purposes, key=lambda p: (not _concerns(p, subject), len(p.scenarios)))


def _concerns(purpose: TestPurpose, subject: Subject) -> bool:
    """Whether ``purpose`` checks a requirement that ``subject`` breaks."""
    return not set(subject.breaks).isdisjoint(purpose.requirements)


def _statement(subject: Subject) -> Statement:
    """What is stated of the framework that it was made from, but for its own readings."""
    usual = stated_by(None, subject.reference)
    ixit = {**usual.ixit, "patience": PATIENCE}
    readings = {**usual.readings, **subject.readings, "core-models": "built-in"}  # models have mutants of their own
    return msgspec.structs.replace(usual, readings=readings, ixit=ixit)


def _statement_of_model(subject: Subject) -> Statement:
    """What is stated of the framework that ``subject`` was made from."""
    usual = stated_by(None, subject.reference)
    return msgspec.structs.replace(usual, readings={**usual.readings, **subject.model_readings})


def _kill(finding: Finding, execution: Execution, names_the_place: bool, looked_at: int) -> Kill:
    shown = finding.expected, finding.observed, finding.events
    return Kill(finding.requirement, execution.name, finding.rule, *shown, names_the_place, looked_at)


def _names_the_place(subject: Subject, ran: _Trial, finding: Finding, execution: Execution) -> bool:
    """Whether the finding is about a difference between the mutant and its model.

    An incident always is, and what a host's process holds. Where only the statement is wrong, the finding must vanish under the statement of the model.
    """
    if execution.incident is not None or finding.rule in HOST_CHECKS:
        return True
    right = _right_traces(subject.model, ran.seed, ran.virtual_time).of(execution.scenario)
    parted = divergence(execution.scenario, right, execution.trace, ran.virtual_time)
    if parted.explains(finding):
        return True
    if not subject.readings or not (parted.is_of_order or is_timed(finding)):
        return False
    # it lies in its statement: under its model's the finding must vanish
    right_monitor = Monitor(load_life_cycle(), _statement_of_model(subject).ics)
    found = right_monitor.judge(execution.scenario, execution.trace).findings
    return all(other.requirement != finding.requirement for other in found)


class _RightTraces:
    """The traces of the framework from which mutants were made."""

    def __init__(self, adapter: str, seed: int, virtual_time: bool) -> None:
        self._driver = Driver(locate(adapter, virtual_time=virtual_time), seed)
        self._known: dict[bytes, Trace] = {}

    def close(self) -> None:
        """End the host."""
        self._driver.__exit__(None, None, None)

    def of(self, scenario: Scenario) -> Trace:
        """The trace of ``scenario``, in its own names; empty if the framework did not come back."""
        key = msgspec.json.encode(scenario)
        if key not in self._known:
            (answer,) = self._driver.run([("right", scenario)])
            self._known[key] = self._driver.revealed(answer).trace
        return self._known[key]


@functools.cache
def _right_traces(adapter: str, seed: int, virtual_time: bool) -> _RightTraces:
    """One for each process, which keeps its host from trial to trial and ends it at exit."""
    traces = _RightTraces(adapter, seed, virtual_time)
    atexit.register(traces.close)
    return traces


T = TypeVar("T")


def names(subjects: Mapping[str, T], wanted: Sequence[str], others: Collection[str] = ()) -> Iterator[T]:
    """The ``wanted`` ones of ``subjects``, all if none is named. Raises ``WrongUse`` if one is not even among ``others``."""
    for name in wanted:
        if name not in subjects and name not in others:
            raise WrongUse(f"there is no mutant or variant '{name}'; 'ucm-cts selftest --list' names them all")
    yield from (subject for name, subject in subjects.items() if not wanted or name in wanted)
