"""Whatever comes as a model, reading it ends with an answer; reader and schema agree about what is built as clause 9 says."""

from __future__ import annotations

from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from ucm_cts.adapters.contract.metamodel.common import walk, without_lines
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.reading import MOST_PROBLEMS, Reading, read_model
from ucm_cts.adapters.contract.metamodel.spelling import SPELLINGS
from ucm_cts.adapters.contract.metamodel.writing import write_model
from ucm_cts.harness.models.core_models import CORE
from ucm_cts.harness.toolchains import strategies
from ucm_cts.harness.toolchains.schema import second_opinion, violations

quick = settings(max_examples=300, deadline=None, suppress_health_check=list(HealthCheck))
slow = settings(quick, max_examples=40)

PRINTED = [write_model(read_model(path.read_bytes(), path.name).model) for path in sorted(CORE.glob("*.xml"))]
LEGAL = st.sampled_from(PRINTED) | strategies.models().map(write_model)


def fits(reading: Reading, size: int) -> None:
    assert isinstance(reading.model, Model)
    assert len(reading.problems) <= MOST_PROBLEMS + 1
    for problem in reading.problems:
        assert problem.message.isprintable()
        assert len(problem.message) < 1000
        assert 1 <= problem.line <= size + 1


@quick
@given(strategies.models())
def test_what_is_written_is_read_again(model: Model) -> None:
    written = write_model(model)
    reading = read_model(written, "m.xml")
    assert reading.problems == ()
    assert without_lines(reading.model) == model
    assert violations(written) == []


@settings(quick, max_examples=3)
@given(st.tuples(*map(strategies.models, SPELLINGS)))
def test_every_class_is_drawn(models: tuple[Model, ...]) -> None:
    for cls, model in zip(SPELLINGS, models, strict=True):
        assert any(type(element) is cls for element in walk(model))


@quick
@given(strategies.spoilt(LEGAL))
def test_schema_and_reader_agree(xml: bytes) -> None:
    reading = read_model(xml, "m.xml")
    fits(reading, len(xml))
    assert bool(reading.problems) == bool(violations(xml)), (reading.problems, violations(xml))


@slow
@given(strategies.spoilt(st.sampled_from(PRINTED)))
def test_two_validators_agree(xml: bytes) -> None:
    assume("\u00a0" not in xml.decode())  # which xmlschema takes for a space
    assert second_opinion().is_valid(xml.decode()) == (not violations(xml))


@quick
@given(strategies.nearly_models(LEGAL) | st.binary(max_size=200))
def test_nothing_is_raised(xml: bytes) -> None:
    fits(read_model(xml, "m.xml"), len(xml))
