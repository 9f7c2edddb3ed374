"""Every option of the interpretations is consulted: a declaration that the suite never reads would be a false promise."""

from __future__ import annotations

from collections.abc import Iterator, KeysView, Mapping

import msgspec
import pytest

from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.mutants.python.subjects import CONTAINER, MUTANTS, VARIANTS, variants_of
from ucm_cts.adapters.mutants.toolchain.registry import mutants, variants
from ucm_cts.adapters.reference.toolchain.program import Program, reference
from ucm_cts.harness.catalogue.requirements import (
    CLAIMABLE,
    load_interpretations,
    load_life_cycle,
    load_options,
    load_requirements,
)
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.models.core_models import CORE, EXTENSIONS
from ucm_cts.harness.models.core_models import compare as compare_models
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.results.statement import Statement, default_statement
from ucm_cts.harness.selftest.consulted import ConsultedReadings
from ucm_cts.harness.statement.applicability import purposes_for, why_not
from ucm_cts.harness.toolchains.acceptance import Acceptance
from ucm_cts.harness.toolchains.generation import OPEN, mapping_models
from ucm_cts.harness.toolchains.idl.comparing import compare as compare_idl
from ucm_cts.harness.toolchains.renaming import Renaming
from ucm_cts.reference_models.mapping.cpp.mapping import expected_cpp
from ucm_cts.reference_models.mapping.idl.mapping import expected_idl
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

pytestmark = pytest.mark.slow

REQUIREMENTS = {requirement.id: requirement for requirement in load_requirements()}
INTERPRETATION = {option: entry for entry in load_interpretations() for option in entry.options}
OF = "ucm_cts.adapters.mutants.python:"
"""How a mutant or a variant is named."""

NOT_CONSULTED: Mapping[str, str] = {}
"""Options without an effect on the suite, each with the reason."""


def test_every_option_is_consulted() -> None:
    consulted: set[str] = set()
    readings = ConsultedReadings(consulted)
    _decide_what_applies(msgspec.structs.replace(default_statement(), readings=readings))
    compare_models([CORE, EXTENSIONS], readings, CLAIMABLE)
    _compare_generated_files(consulted)
    for option in sorted(load_options().keys() - consulted):
        if _changes_selection(option):
            consulted.add(option)
        else:
            next((True for _ in _judge_traces(option, consulted) if option in consulted), False)
    assert load_options().keys() - consulted == NOT_CONSULTED.keys()


def _decide_what_applies(statement: Statement) -> None:
    Acceptance(statement, Renaming())
    purposes_for(statement, "core")
    for requirement in REQUIREMENTS.values():
        why_not(requirement, statement)


def _compare_generated_files(consulted: set[str]) -> None:
    """The files of the reference tool chain, then of mutants and variants that declare a reading of an option not yet consulted."""
    _compare_with_models(reference(), ConsultedReadings(consulted))
    for derived in (*mutants().values(), *variants().values()):
        declared = dict(reading.split("=", 1) for reading in derived.declares)
        if derived.task == "idl" and declared.keys() - consulted:
            _compare_with_models(derived.derive(reference()), ConsultedReadings(consulted, declared), declared.keys())


def _compare_with_models(
    program: Program, readings: ConsultedReadings, wanted: KeysView[str] | frozenset[str] = frozenset()
) -> None:
    """With all of the models, or until all options that are ``wanted`` have been consulted."""
    for name, text in mapping_models().items():
        if name.startswith(OPEN):
            continue
        if wanted and wanted <= readings.consulted:
            return
        model = read_model(text.encode(), name).model
        compare_idl(expected_idl(model), program.generators["idl"](model), readings)
        expected_cpp(model, "cpp11", readings)
        expected_cpp(model, "cpp03", readings)


def _changes_selection(option: str) -> bool:
    """Whether a value of ``option`` selects other test purposes than its first value."""
    values = load_options()[option]
    return (
        len({tuple(purpose.id for purpose in load_purposes("extensions", f"{option}={value}")) for value in values}) > 1
    )


def _judge_traces(option: str, consulted: set[str]) -> Iterator[None]:
    """Judges traces that concern ``option``: of frameworks that declare it, of the reference, and of variants that do not.

    The quick ones come first: traces of test purposes for the requirements that the option belongs to.
    """
    entry = INTERPRETATION[option]
    own = {r.id for r in REQUIREMENTS.values() if entry.id in r.interpretations or r.clause in entry.clauses}
    mutated = [(OF + m.name, m.readings, {*m.requirements}) for m in MUTANTS.values() if option in m.readings]
    declaring = [(OF + v.name, v.readings, own) for v in VARIANTS.values() if option in v.readings]
    others = [(OF + v.name, v.readings, own) for v in variants_of(CONTAINER).values() if option not in v.readings]
    for adapter, declared, requirements in [
        *mutated,
        *declaring,
        ("reference-py", {}, own),
        ("reference-py", {}, set(REQUIREMENTS)),
        *others,
    ]:
        readings = ConsultedReadings(consulted, declared)
        monitor = Monitor(load_life_cycle(), Ics(readings))
        purposes = load_purposes(entry.profile, *(f"{name}={value}" for name, value in declared.items()))
        own_purposes = [p for p in purposes if requirements.intersection(p.requirements)]
        cases = (case for p in own_purposes for case in (p.draw(1, readings) if p.draw else p.scenarios))
        with Driver(locate(adapter, virtual_time=True), 1) as driver:
            for answer in driver.run(cases):
                assert answer.trace, answer.name
                monitor.judge(answer.disguised, answer.trace)
                yield
