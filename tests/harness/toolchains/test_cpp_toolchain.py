"""Profiles cpp11 and cpp03 on whole tool chains: the reference keeps all, mutants break what they say, no variant is failed."""

from __future__ import annotations

import functools

import pytest
from mapping_subjects import PROFILES, model

from ucm_cts.adapters.mutants.toolchain.registry import Mutant, Variant, mutants, variants
from ucm_cts.adapters.mutants.toolchain.rewriting import SHOWN_BY
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.toolchains.cpp.comparing import compare
from ucm_cts.harness.toolchains.cpp.compiling import Compiler
from ucm_cts.harness.toolchains.differences import Comparison
from ucm_cts.reference_models.mapping.cpp.expected import Standard
from ucm_cts.reference_models.mapping.cpp.mapping import expected_cpp

pytestmark = pytest.mark.native

KNOWN = mutants()

TRIED = (
    "dimensions_out_of_order_cpp11",
    "less_or_equal_is_less_cpp03",
    "exceptions_are_corbas_cpp11",
    "operation_that_nobody_asked_for_cpp03",
    "getter_returns_a_pointer_cpp11",
    "connections_lead_nowhere_cpp03",
    "null_is_nullptr_cpp03",
    "copy_of_structure_is_empty_cpp11",
    "interfaces_wrap_corba_cpp03",
)
"""One mutant for each way in which defects are found; ucm-cts selftest tries all."""

SPARED = (
    ("plain_members_cpp11", "data_types"),
    ("connections_in_another_order_cpp03", "ports"),
    ("ancestors_not_virtual_cpp11", "interfaces"),
    ("overloads_of_startup_cpp11", "ports"),
    ("connections_derived_cpp03", "refinement"),
)


def compared(derived: Mutant | Variant, name: str) -> Comparison:
    """What the files come to that ``derived`` makes of a model."""
    standard: Standard = "cpp11" if derived.task == "cpp11" else "cpp03"
    files = derived.derive(reference()).generators[derived.task](model(name))
    declared = dict(reading.split("=", 1) for reading in derived.declares)
    return compare(model(name), files, standard, declared, Compiler())


@pytest.mark.parametrize("standard", PROFILES)
@pytest.mark.parametrize("name", ["refinement", "modules"])
def test_the_reference_is_conformant(name: str, standard: Standard) -> None:
    files = reference().generators[standard](model(name))
    comparison = compare(model(name), files, standard, {}, Compiler())
    assert [str(difference) for difference in comparison.differences] == []
    assert comparison.unjudged == {}
    expected = expected_cpp(model(name), standard, {}).expected
    assert sum(comparison.exercised.values()) == len(expected) + len([f for f in files if f.endswith(".hpp")])


@pytest.mark.parametrize("name", TRIED)
def test_mutants_break_their_requirements(name: str) -> None:
    mutant = KNOWN[name]
    differences = compared(mutant, SHOWN_BY[name]).differences
    assert [str(d) for d in differences if d.expected == d.observed] == []
    failed = {d.requirement for d in differences}
    assert set(mutant.breaks) <= failed <= {*mutant.breaks, *mutant.also}


@pytest.mark.parametrize(("name", "shown"), SPARED)
def test_variants_are_spared(name: str, shown: str) -> None:
    comparison = compared(variants()[name], shown)
    assert [str(difference) for difference in comparison.differences] == []
    assert comparison.unjudged == {}


@functools.cache
def generated(task: str, name: str) -> dict[str, str]:
    return dict(reference().generators[task](model(name)))


@pytest.mark.parametrize("name", SHOWN_BY)
def test_each_mutant_generates_something_else(name: str) -> None:
    mutant = KNOWN[name]
    assert mutant.derive(reference()).generators[mutant.task](model(SHOWN_BY[name])) != generated(
        mutant.task, SHOWN_BY[name]
    )


@pytest.mark.parametrize("standard", PROFILES)
def test_each_requirement_has_a_mutant(standard: Standard) -> None:
    broken = {requirement for m in KNOWN.values() if m.task == standard for requirement in m.breaks}
    testable = {r.id for r in load_requirements() if r.profile in PROFILES[standard] and r.rules}
    assert testable - broken == set()
