"""Every testable requirement has a wrong subject that fails it, and fails nothing that it does not break."""

from __future__ import annotations

import pytest
from derived import CORE_SUBJECTS, POLICY_SUBJECTS, SUBJECTS, WrongSubject
from pipeline import failing_requirements

from ucm_cts.harness.catalogue import load_requirements
from ucm_cts.reference_models.ledger import RULES


@pytest.mark.parametrize("subject", SUBJECTS.values(), ids=SUBJECTS.keys())
def test_subject_fails_for_the_right_reason(subject: WrongSubject) -> None:
    failing = failing_requirements(subject.adapter)
    missed = set(subject.requirements) - set(failing)
    spilled = {k: v for k, v in failing.items() if k not in subject.requirements and k not in subject.also}
    assert not missed, f"{subject.name} survives {missed}; it fails {failing}"
    assert not spilled, f"{subject.name} also fails {spilled}"


def test_every_testable_requirement_has_a_wrong_subject() -> None:
    subjects = [*SUBJECTS.values(), *POLICY_SUBJECTS.values(), *CORE_SUBJECTS.values()]
    broken = {requirement for subject in subjects for requirement in subject.requirements}
    testable = {r.id for r in load_requirements() if any(rule in RULES for rule in r.rules)}
    permissions = {r.id for r in load_requirements() if r.level == "may"}  # nothing can break them
    assert testable - broken - permissions == set()
    assert broken <= testable
