"""Who declares of a framework, or of its core models, what holds of another one is found out.

The subjects are the variants, each of which takes the readings that it declares; here another one is declared. Two values of each
option are tried in both directions; ``UNSEEN`` says which pairs no observation can tell apart, and why.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import msgspec
import pytest

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.messages import FromHost, Run, Traced, encode, from_host_decoder
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.mutants.python.subjects import VARIANTS, Variant
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.catalogue.requirements import (
    load_interpretations,
    load_life_cycle,
    load_options,
    load_requirements,
)
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.models.core_models import compare
from ucm_cts.harness.purposes.payloads import Payloads
from ucm_cts.harness.purposes.provocations.container_contention import container_contention_purposes
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.purposes.selection import plain_purposes
from ucm_cts.harness.results.statement import Statement, default_statement
from ucm_cts.harness.selftest.model_variants import ModelVariant, model_variants
from ucm_cts.harness.statement.applicability import fitting
from ucm_cts.harness.statement.files import stated_by
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

OBSERVED = "observed"
ENTRIES = {option: entry for entry in load_interpretations() for option in entry.options}


OF_MODELS = {models.option for models in model_variants().values()}
REFERENCE = Variant(
    "reference-py",
    ReferenceAdapter,
    (),
    {option: value for option, value in stated_by(None, "reference-py").readings.items() if option not in OF_MODELS},
)
"""The reference framework, for what no variant declares."""


class False_(NamedTuple):
    """A framework that takes the value ``taken`` of ``option`` and is said to take ``declared``."""

    subject: Variant
    option: str
    taken: str
    declared: str

    def __str__(self) -> str:
        return f"{self.option}={self.declared}-{self.taken}"


_LESS = "the declared value claims less: nothing is asked of what more the framework does"
_UNASKED = "nothing is asked of who declares nothing"
_FEWER_VALUES = "values that the declared type does not have are not sent"
_NO_FAULT = "what nobody asks the adapter to break does not break"

UNSEEN: Mapping[tuple[str, str, str], str] = {
    ("active-unmanaged", "protected", "unprotected"): _LESS,
    ("attribute-defaults", "set", "unasked"): _UNASKED,
    ("bounded-sequence", "any-length", "full-only"): _FEWER_VALUES,
    ("byte", "signed", "unsigned"): _FEWER_VALUES,
    ("char32", "full", "bmp"): _FEWER_VALUES,
    ("char8", "byte", "ascii"): _FEWER_VALUES,
    ("clock-epoch", "unix", "unspecified"): _LESS,
    ("comm-error", "at-once", "eventually"): _LESS,
    ("connector-fault", "hook", "impossible"): _NO_FAULT,
    ("connector-fault", "hook", "none"): _UNASKED,
    ("connector-fault", "impossible", "none"): _UNASKED,
    ("connector-fault", "none", "impossible"): _NO_FAULT,
    ("container-interface", "once", "repeated"): _LESS,
    ("container-operations", "at-once", "unasked"): _UNASKED,
    ("id-scope", "container", "runtime"): "what operations with ids of other containers do is not judged then",
    ("incompatible-ends", "refused", "unasked"): _UNASKED,
    ("local-clock", "monotonic", "settable"): _LESS,
    ("local-clock", "settable", "monotonic"): "nobody sets the clock of the machine during a run",
    ("log-message", "wide-unbounded", "narrow-255"): _FEWER_VALUES,
    ("log-threshold", "debug", "none"): "the severity below, trace, is not written unless log-severity-set declares it",
    ("message-delivery", "synchronous", "asynchronous"): _LESS,
    ("message-order", "fifo", "unordered"): _LESS,
    ("message-overflow", "block", "refuse"): _LESS,
    ("methods-to-trace", "list", "one-name"): _LESS,
    ("nan", "exact", "any"): _LESS,
    ("pending-at-stop", "deliver", "drop"): "where all is delivered at once nothing is pending",
    ("pending-at-stop", "deliver", "keep"): "where all is delivered at once nothing is pending",
    ("port-trace-applicability", "onBoth", "onComponent"): _LESS,
    ("port-trace-applicability", "onBoth", "onPort"): _LESS,
    ("protected-active-applicability", "onBoth", "onComponent"): _LESS,
    ("protected-active-applicability", "onBoth", "onPort"): _LESS,
    ("raw-references", "protected", "unprotected"): _LESS,
    ("self-exec-mutex", "component", "run-only"): _LESS,
    ("slow-receiver", "independent", "shared"): _LESS,
    ("stop-drain", "wait", "abandon"): _LESS,
    ("trace-sink", "hook", "none"): _UNASKED,
    ("transport-fault", "hook", "impossible"): _NO_FAULT,
    ("transport-fault", "hook", "none"): _UNASKED,
    ("transport-fault", "impossible", "none"): _UNASKED,
    ("transport-fault", "none", "impossible"): _NO_FAULT,
    ("unknown-policy", "refused", "unasked"): _UNASKED,
    ("unprotected-concurrency", "concurrent", "may-serialise"): _LESS,
    ("virtual-time", "hook", "none"): _UNASKED,
}
"""Option, value taken, value declared: why no trace of the subject contradicts the declaration."""


def false_declarations() -> Iterator[False_]:
    """One subject for each two values of each option of profile core that traces show."""
    for option, values in load_options().items():
        if ENTRIES[option].profile not in ("container", "core"):
            continue
        for taken in values:
            takers = [v for v in (*VARIANTS.values(), REFERENCE) if v.readings.get(option) == taken]
            for declared in values:
                if takers and OBSERVED not in (taken, declared) and declared != taken:
                    yield False_(takers[0], option, taken, declared)


CASES = list(false_declarations())


@pytest.mark.slow
@pytest.mark.parametrize("case", [c for c in CASES if c[1:] not in UNSEEN], ids=str)
def test_a_framework_that_does_otherwise_than_declared_is_found_out(case: False_) -> None:
    assert contradicted(case)


def test_what_cannot_be_seen_is_declared_of_some_subject() -> None:
    assert UNSEEN.keys() <= {case[1:] for case in CASES}


def contradicted(case: False_) -> bool:
    """Whether some scenario fails under what ``case`` declares; one that is also run under what is true may not fail there."""
    true, false = stating(case.subject.readings), stating({**case.subject.readings, case.option: case.declared})
    profile = ENTRIES[case.option].profile
    usual = {encode(Run(0, scenario)) for _, scenario in cases_under(true, profile)}
    engine, declared, actual = Engine(case.subject.adapter), monitor(false), monitor(true)
    own, related = concerned(case.option)

    def remoteness(purpose: TestPurpose, scenario: Scenario) -> int:
        asked = {need.partition("=")[0] for need in purpose.under}
        is_new = encode(Run(0, scenario)) not in usual
        reasons = (case.option in asked, is_new, own & {*purpose.requirements}, related & {*purpose.requirements})
        rank = next((rank for rank, reason in enumerate(reasons) if reason), len(reasons))
        return rank + 10 * any(isinstance(step, s.Stress) for step in scenario.steps)

    for _, plain in sorted(cases_under(false, profile), key=lambda one: remoteness(*one)):
        scenario = disguised(plain)
        traced = answer(engine, case.subject.name, scenario)
        if not isinstance(traced, Traced):  # what is claimed is not offered
            return True
        found = {finding.requirement for finding in declared.judge(scenario, traced.events).findings}
        if found and encode(Run(0, plain)) in usual:
            found -= {finding.requirement for finding in actual.judge(scenario, traced.events).findings}
        if found:
            return True
    return False


def stating(readings: Mapping[str, str]) -> Statement:
    """What the vendor of a variant states: as of the reference framework, but for these readings."""
    usual = stated_by(None, "reference-py")
    return msgspec.structs.replace(usual, readings={**usual.readings, **readings})


def monitor(statement: Statement) -> Monitor:
    return Monitor(load_life_cycle(), Ics(statement.readings))


def concerned(option: str) -> tuple[set[str], set[str]]:
    """The requirements that name the interpretation with this option, and those of its clauses."""
    entry = ENTRIES[option]
    own = {r.id for r in load_requirements() if entry.id in r.interpretations}
    return own, {r.id for r in load_requirements() if r.clause in entry.clauses}


def cases_under(statement: Statement, profile: str) -> list[tuple[TestPurpose, Scenario]]:
    """The scenarios that are run under ``statement``, but for most that are derived: those need minutes, and nothing here needs them."""
    declared = [reading for reading in statement.declared if reading not in default_statement().declared]
    at_once = [p for p in container_contention_purposes() if all(map(statement.meets, p.under))]
    return [
        (purpose, scenario)
        for purpose in (*plain_purposes(profile, *declared), *at_once)
        for _, scenario in fitting(purpose.scenarios, statement, as_written="R-10.1.3-02" in purpose.requirements)
    ]


_disguise, _payloads = Disguise(1, "{port}_{element}"), Payloads(1)


def disguised(plain: Scenario) -> Scenario:
    """``plain`` as a host gets it, with less patience: a host in this process that is waited for in vain is no news."""
    patience = max(1, plain.patience // 5)
    return _disguise.scenario(_payloads.deal(msgspec.structs.replace(plain, patience=patience)))


_answers: dict[tuple[str, bytes], FromHost] = {}


def answer(engine: Engine, subject: str, scenario: Scenario) -> FromHost:
    """The trace of a subject, which is recorded once whatever is declared of it."""
    line = encode(Run(0, scenario))
    if (subject, line) not in _answers:
        _answers[subject, line] = from_host_decoder().decode(engine.answer(line))
    return _answers[subject, line]


_BOTH_PLACES = "what is declared is there, too"
_AS_PRINTED = "what 10.1.4.2 prints is accepted whatever is declared, and noted in the report"

SAME_MODELS: Mapping[tuple[str, str, str], str] = {
    ("core-models", "shipped", "built-in"): "no models are compared then",
    ("core-root", "both", "core"): _BOTH_PLACES,
    ("core-root", "both", "none"): _BOTH_PLACES,
    ("extension-root", "both", "core"): _BOTH_PLACES,
    ("extension-root", "both", "root"): _BOTH_PLACES,
    ("port-trace-applicability", "onComponent", "onBoth"): _AS_PRINTED,
    ("port-trace-applicability", "onComponent", "onPort"): _AS_PRINTED,
}
"""Option, value that models have, value declared of them: why they are not found out."""


def false_models() -> Iterator[tuple[ModelVariant, str]]:
    """Models that are as one value of an option says, and another value that is declared of them."""
    for models in model_variants().values():
        for declared in ENTRIES[models.option].options[models.option]:
            if declared not in (OBSERVED, models.value) and (models.option, models.value, declared) not in SAME_MODELS:
                yield models, declared


@pytest.mark.parametrize(
    ("models", "declared"),
    [pytest.param(*case, id=f"{case[0].option}={case[1]}-{case[0].name}") for case in false_models()],
)
def test_models_that_are_otherwise_than_declared_are_found_out(
    models: ModelVariant, declared: str, tmp_path: Path
) -> None:
    compared = compare(models.write(tmp_path), {models.option: declared}, models.parts)
    assert [result.requirement for result in compared.results if result.status == "broken"]
