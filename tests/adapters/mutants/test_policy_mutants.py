"""Mutants of execution policies (10.1.3) fail; variants do not fail."""

from __future__ import annotations

import functools
from collections.abc import Mapping

import msgspec
import pytest
from performing import answer
from pipeline import check_killed, check_wording, spilled

from ucm_cts.adapters.contract.messages import Traced
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.mutants.python.subjects import POLICIES, Mutant, Variant, mutants_of, variants_of
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.purposes.derived.schedules import overlap_purposes
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.statement.applicability import purposes_for
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

pytestmark = [
    pytest.mark.slow,
    # threads of a defective framework may end with an exception: that is its defect
    pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning"),
]

SCRIPTED = {
    "waits-for-one-who-fails",
    "entered-while-it-waits-for-another",
    "run-that-fails",
    "run-beside-one-that-failed",
    "boundary/phases with runs",
    "executes-by-itself-while-nobody-calls",
    "self-executing/alone",
    "two execution policies",
}


@functools.cache
def scenarios(*declared: tuple[str, str]) -> dict[str, Scenario]:
    """Callers of the test and of a component, and run, met by another one; with a patience that wrong subjects try."""
    default = default_statement()
    statement = msgspec.structs.replace(default, readings={**default.readings, **dict(declared)})
    own = {purpose.id for purpose in overlap_purposes()} | SCRIPTED
    purposes = [purpose for purpose in purposes_for(statement, "core") if purpose.id in own]
    met = {name: plain for purpose in purposes for name, plain in purpose.scenarios}
    short = {name: plain for name, plain in met.items() if "elsewhere" not in name and name.count(",") < 2}
    return {name: msgspec.structs.replace(plain, patience=300) for name, plain in short.items()}


def failing(
    adapter: type[ReferenceAdapter], readings: Mapping[str, str] = {}, enough: frozenset[str] = frozenset()
) -> dict[str, str]:
    """Failing requirements, each with an example. Waiting for more ends when all of ``enough`` have failed."""
    monitor = Monitor(load_life_cycle(), Ics(readings))
    found: dict[str, str] = {}
    for name, asked in scenarios(*readings.items()).items():
        reply = answer(asked, adapter)
        assert isinstance(reply, Traced), (name, reply)
        problem = contradiction(asked, reply.events, reply.stuck)
        assert problem is None, (name, problem)
        findings = monitor.judge(asked, reply.events).findings
        check_wording(asked, findings)
        for f in findings:
            found.setdefault(f.requirement, f"{name}: expected {f.expected}; observed {f.observed}")
        if enough and enough <= found.keys():
            break
    return found


def test_reference_framework_is_not_failed() -> None:
    assert failing(ReferenceAdapter) == {}


@pytest.mark.parametrize("variant", variants_of(POLICIES).values(), ids=variants_of(POLICIES).keys())
def test_conformant_framework_is_not_failed(variant: Variant) -> None:
    assert failing(variant.adapter, variant.readings) == {}


@pytest.mark.parametrize("mutant", mutants_of(POLICIES).values(), ids=mutants_of(POLICIES).keys())
def test_mutant_fails_for_the_right_reason(mutant: Mutant) -> None:
    found = failing(mutant.adapter, mutant.readings, frozenset(mutant.requirements))
    if not found.keys() >= set(mutant.requirements) or spilled(mutant, found):
        check_killed(mutant)
