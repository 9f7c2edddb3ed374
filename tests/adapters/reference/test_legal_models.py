"""Models that are legal by construction are taken for legal by everyone: schema, reader, reference tool chain, its generators."""

from __future__ import annotations

from hypothesis import HealthCheck, Phase, given, seed, settings

from ucm_cts.adapters.contract.metamodel.common import Element, walk, without_lines
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.contract.metamodel.spelling import SPELLINGS
from ucm_cts.adapters.contract.metamodel.writing import write_model
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.bench.large_model import large_model
from ucm_cts.harness.toolchains.corpus.legal_models import legal_models
from ucm_cts.harness.toolchains.corpus.schema import violations
from ucm_cts.harness.toolchains.idl.comparing import compare
from ucm_cts.reference_models.mapping.idl.mapping import expected_idl

some = settings(max_examples=30, deadline=None, suppress_health_check=list(HealthCheck))


@some
@given(legal_models())
def test_legal_models_are_legal(model: Model) -> None:
    written = write_model(model)
    reading = read_model(written, "m.xml")
    assert (reading.problems, without_lines(reading.model)) == ((), model)
    assert violations(written) == []
    _, reported = reference().check(written, "m.xml")
    assert [str(diagnostic) for diagnostic in reported] == []


@settings(some, max_examples=10)
@given(legal_models())
def test_legal_models_can_be_mapped(model: Model) -> None:
    program = reference()
    for task in program.generators:
        files, reported = program.generate(task, write_model(model), "m.xml")
        assert reported == []
        assert files
        if task == "idl":
            expected = expected_idl(read_model(write_model(model), "m.xml").model)
            assert [str(difference) for difference in compare(expected, files).differences] == []


def test_every_class_is_in_legal_models() -> None:
    drawn: set[type[Element]] = set()

    @settings(some, database=None, phases=[Phase.generate])
    @given(legal_models())
    def look(model: Model) -> None:
        drawn.update(type(element) for element in walk(model))

    for number in range(10):  # some classes are rare
        seed(number)(look)()
        if drawn == set(SPELLINGS):
            break
    assert drawn == set(SPELLINGS)


def test_the_large_model_is_legal_and_as_large_as_wanted() -> None:
    model = large_model(12_000)
    assert 9_000 < sum(1 for _ in walk(model)) < 15_000
    written = write_model(model)
    assert violations(written) == []
    _, reported = reference().check(written, "m.xml")
    assert reported == []
