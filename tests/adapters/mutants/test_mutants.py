"""Every testable requirement has a mutant that fails it, and fails nothing that it does not break."""

from __future__ import annotations

import pytest
from pipeline import check_killed, failing_requirements, spilled

from ucm_cts.adapters.mutants.python.subjects import CONTAINER, MUTANTS, Mutant, mutants_of
from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.execution.leftovers import FREED, HOST_CHECKS
from ucm_cts.reference_models.properties.table import PROPERTIES

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("mutant", mutants_of(CONTAINER).values(), ids=mutants_of(CONTAINER).keys())
def test_mutant_fails_for_the_right_reason(mutant: Mutant) -> None:
    if FREED in mutant.requirements:  # it keeps what a host frees when it ends
        check_killed(mutant)
        return
    failing = failing_requirements(mutant)
    if not failing.keys() >= set(mutant.requirements) or spilled(mutant, failing):
        check_killed(mutant)


def test_every_testable_requirement_has_a_mutant() -> None:
    broken = {requirement for mutant in MUTANTS.values() for requirement in mutant.requirements}
    checks = PROPERTIES.keys() | HOST_CHECKS.keys()
    testable = {r.id for r in load_requirements() if any(rule in checks for rule in r.rules)}
    permissions = {r.id for r in load_requirements() if r.level == "may"}  # nothing can break them
    assert testable - broken - permissions == set()
    assert broken <= testable
