"""Profile idl on whole tool chains: the reference keeps all, each mutant breaks what it says, and no variant is failed."""

from __future__ import annotations

import functools

import pytest
from hypothesis import HealthCheck, given, settings
from mapping_subjects import Subject, subjects

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.mutants.toolchain.registry import Mutant, Variant, mutants, variants
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.selftest.matrix import MutantResult
from ucm_cts.harness.selftest.toolchains import all_subjects, declaring, examine_toolchain
from ucm_cts.harness.toolchains.corpus.legal_models import legal_models
from ucm_cts.harness.toolchains.idl.comparing import compare
from ucm_cts.harness.toolchains.idl.declared_support import not_applicable
from ucm_cts.harness.toolchains.idl.language.reading import read_files
from ucm_cts.harness.toolchains.idl.omniidl import opinion
from ucm_cts.reference_models.mapping.idl.declarations import Module
from ucm_cts.reference_models.mapping.idl.expectations import RULE_OF
from ucm_cts.reference_models.mapping.idl.mapping import expected_idl

pytestmark = pytest.mark.slow

DEFAULTS = default_statement().readings

SHOWN_ELSEWHERE = (
    *("names_clash_in_idl", "keywords_as_they_are", "less_common_keywords_as_they_are", "refuses_keywords"),
    *("annotated_models_become_nothing", "annotations_as_remarks"),
)
"""What only models show that may be refused, or that are decorated."""

MUTANTS = {name: mutant for name, mutant in mutants().items() if mutant.task == "idl" and not mutant.claims}
VARIANTS = {name: variant for name, variant in variants().items() if variant.task == "idl" and not variant.claims}
"""Those about the standard property of 10.2 are in test_standard_properties.py."""

DECLARING = [
    variant
    for name, variant in VARIANTS.items()
    if any(DEFAULTS[o] != v for o, v in (reading.split("=") for reading in variant.declares))
    and name != "equivalent_syntax_besides"
]
"""Those that declare what does not hold by default. One of them shows no more than that other files are permitted."""

SEEN_ELSEWHERE = {"R-12-01", "R-9.2.9.4-04"}
"""The requirements that no comparison of one model sees."""


@functools.cache
def changed(mutant: Mutant | Variant) -> tuple[Subject, ...]:
    """The models of which a derived tool chain makes other files than the reference, with these files."""
    generate = mutant.derive(reference()).generators["idl"]
    made = (subject._replace(files=generate(subject.model)) for subject in subjects())
    return tuple(one for one, same in zip(made, subjects(), strict=True) if one.files != same.files)


@pytest.mark.parametrize("subject", subjects(), ids=[s.name for s in subjects()])
def test_the_reference_is_conformant(subject: Subject) -> None:
    comparison = compare(subject.expected, subject.files)
    assert not comparison.differences
    assert sum(comparison.exercised.values()) > len(subject.expected.facts) / 2


@pytest.mark.parametrize("subject", subjects(), ids=[s.name for s in subjects()])
def test_omniidl_takes_all_that_has_no_templates(subject: Subject) -> None:
    read = read_files(subject.files)
    assert not read.problems
    assert not read.missing
    text = str(read.declarations)
    templates = "TemplateParameter(" in text
    assert opinion(subject.files).verdict == ("none" if templates else "agreed")
    assert Module.__name__ in text


@settings(max_examples=8, deadline=None, derandomize=True, database=None, suppress_health_check=list(HealthCheck))
@given(legal_models())
def test_generated_idl_of_random_models_is_as_expected(model: Model) -> None:
    """Both are written independently of each other, from the clause."""
    assert not compare(expected_idl(model), reference().generators["idl"](model)).differences


def test_every_requirement_with_a_rule_has_a_mutant_and_a_model() -> None:
    testable = {r.id for r in load_requirements() if r.profile == "idl" and r.rules}
    assert testable == RULE_OF.keys()
    assert testable <= {requirement for mutant in MUTANTS.values() for requirement in mutant.breaks}
    values = {"idl-enumerator-values": "observed"}
    seen = {r for subject in subjects() for r in compare(subject.expected, subject.files, values).exercised}
    beside = changed(VARIANTS["with_equivalents"])
    seen |= {r for one in beside for r in compare(one.expected, one.files, {"idl-output": "both"}).exercised}
    assert testable - seen == SEEN_ELSEWHERE


@pytest.mark.parametrize("mutant", [m for n, m in MUTANTS.items() if n not in SHOWN_ELSEWHERE], ids=lambda m: m.name)
def test_mutants_are_killed_for_the_right_reason(mutant: Mutant) -> None:
    broken: set[str] = set()
    readings = dict(reading.split("=") for reading in mutant.declares)
    for subject in changed(mutant):
        if not subject.files:
            assert mutant.breaks == ("R-12-01",)
            return
        differences = compare(subject.expected, subject.files, readings, opinion).differences
        assert [str(d) for d in differences if d.expected == d.observed] == []
        broken |= {d.requirement for d in differences}
        assert broken <= {*mutant.breaks, *mutant.also}
        if broken >= set(mutant.breaks):
            return
    pytest.fail(f"survives: {broken}")


@pytest.mark.parametrize("variant", [v for n, v in VARIANTS.items() if n not in SHOWN_ELSEWHERE], ids=lambda v: v.name)
def test_variants_are_spared(variant: Variant) -> None:
    subjects = changed(variant)
    assert subjects
    readings = dict(reading.split("=") for reading in variant.declares)
    for subject in subjects[:3]:
        assert not compare(subject.expected, subject.files, readings).differences, subject.name


@pytest.mark.parametrize("variant", DECLARING, ids=lambda v: v.name)
def test_no_declaration_leaves_a_requirement_undecided(variant: Variant) -> None:
    """What a vendor may leave out and declares to leave out is not asked."""
    generate = variant.derive(reference()).generators["idl"]
    statement = declaring(variant.declares)
    exercised: set[str] = set()
    for subject in subjects():
        exercised |= compare(subject.expected, generate(subject.model), statement.readings).exercised.keys()
    assert RULE_OF.keys() - exercised - not_applicable(statement).keys() == SEEN_ELSEWHERE


def test_omniidl_spares_the_variants() -> None:
    for name, variant in VARIANTS.items():
        if name in SHOWN_ELSEWHERE:
            continue
        for subject in changed(variant)[:1]:
            assert opinion(subject.files).verdict != "refused", name


@pytest.mark.parametrize("name", SHOWN_ELSEWHERE)
def test_open_names_and_decoration(name: str) -> None:
    """A tool chain may refuse open names, and what it generates of them must be IDL; decoration changes nothing."""
    result = examine_toolchain(all_subjects()[name])
    if isinstance(result, MutantResult):
        assert [kill.requirement for kill in result.kills] == list(result.breaks)
    else:
        assert result.is_spared
