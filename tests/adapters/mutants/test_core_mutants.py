"""Mutants of clause 10.1 fail for the right reason; variants do not fail."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import nullcontext

import msgspec
import pytest
from performing import answer
from pipeline import TakesTooLong, bounded, check_killed, check_wording, spilled

from ucm_cts.adapters.contract.messages import Traced
from ucm_cts.adapters.contract.scenario import Burst, Scenario
from ucm_cts.adapters.mutants.python.subjects import CORE, Mutant, Variant, mutants_of, variants_of
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

pytestmark = pytest.mark.slow

SHORT = 0.2
"""Of the patience of scenarios. What a mutant never does is not waited for longer; a burst takes its time."""


def scenarios(clauses: tuple[str, ...], readings: Mapping[str, str]) -> Iterator[tuple[str, Scenario]]:
    for purpose in load_purposes("core", *(f"{option}={value}" for option, value in readings.items())):
        if purpose.clause.startswith(clauses):
            yield from purpose.scenarios


def failing(
    adapter: type[ReferenceAdapter],
    clauses: tuple[str, ...],
    patience: float = 1,
    readings: Mapping[str, str] = {},
    enough: frozenset[str] = frozenset(),
) -> dict[str, str]:
    """Failing requirements, each with an example. Waiting for more ends when all of ``enough`` have failed, or one who breaks them hangs."""
    monitor = Monitor(load_life_cycle(), Ics(readings))
    found: dict[str, str] = {}
    for name, whole in scenarios(clauses, readings):
        waits = 1 if _has_burst(whole) else patience
        asked = msgspec.structs.replace(whole, patience=int(whole.patience * waits))
        try:
            with bounded(asked) if enough else nullcontext():
                reply = answer(asked, adapter)
        except TakesTooLong:
            break
        assert isinstance(reply, Traced), (name, reply)
        problem = contradiction(asked, reply.events, reply.stuck)
        assert problem is None, (name, problem)
        findings = monitor.judge(asked, reply.events).findings
        check_wording(asked, findings)
        for finding in findings:
            found.setdefault(finding.requirement, _reported(name, finding))
        if enough and enough <= found.keys():
            break
    return found


def _has_burst(scenario: Scenario) -> bool:
    plans = (actions for declaration in scenario.components.values() for actions in declaration.plan.values())
    return any(isinstance(action, Burst) for actions in plans for action in actions)


def _reported(name: str, finding: Finding) -> str:
    return f"{name}: expected {finding.expected}; observed {finding.observed}"


def test_reference_framework_is_not_failed() -> None:
    assert failing(ReferenceAdapter, CORE) == {}


@pytest.mark.parametrize("variant", variants_of(CORE).values(), ids=variants_of(CORE).keys())
def test_conformant_framework_is_not_failed(variant: Variant) -> None:
    assert failing(variant.adapter, variant.clauses, readings=variant.readings) == {}


@pytest.mark.parametrize("mutant", mutants_of(CORE).values(), ids=mutants_of(CORE).keys())
def test_mutant_fails_for_the_right_reason(mutant: Mutant) -> None:
    enough = frozenset(mutant.requirements)
    found = failing(mutant.adapter, mutant.clauses, SHORT, mutant.readings, enough)
    if spilled(mutant, found):  # a busy machine needs more patience
        found = failing(mutant.adapter, mutant.clauses, 1, mutant.readings, enough)
    if not found.keys() >= set(mutant.requirements) or spilled(mutant, found):
        check_killed(mutant)
