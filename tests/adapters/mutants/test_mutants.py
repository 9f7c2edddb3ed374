"""Mutants in Python fail for the right reason, and fail nothing that they do not break."""

from __future__ import annotations

import pytest
from pipeline import check_killed

from ucm_cts.adapters.mutants.python.subjects import CONTAINER, MUTANTS, Mutant, mutants_of
from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.execution.leftovers import HOST_CHECKS
from ucm_cts.harness.selftest.trials import Thoroughness
from ucm_cts.reference_models.properties.table import PROPERTIES

pytestmark = pytest.mark.slow

OF_CONTAINER = mutants_of(CONTAINER)
EACH = 50
"""Of the mutants of the life cycle one of so many goes on after it is killed; in a self-test, all do."""


@pytest.mark.parametrize("mutant", MUTANTS.values(), ids=MUTANTS.keys())
def test_mutant_fails_for_the_right_reason(mutant: Mutant) -> None:
    check_killed(mutant)


@pytest.mark.parametrize("mutant", list(OF_CONTAINER.values())[::EACH], ids=list(OF_CONTAINER)[::EACH])
def test_mutant_fails_nothing_else_in_the_whole_life_cycle(mutant: Mutant) -> None:
    check_killed(mutant, Thoroughness())


def test_every_testable_requirement_has_a_mutant() -> None:
    broken = {requirement for mutant in MUTANTS.values() for requirement in mutant.requirements}
    checks = PROPERTIES.keys() | HOST_CHECKS.keys()
    testable = {r.id for r in load_requirements() if any(rule in checks for rule in r.rules)}
    permissions = {r.id for r in load_requirements() if r.level == "may"}  # nothing can break them
    assert testable - broken - permissions == set()
    assert broken <= testable
