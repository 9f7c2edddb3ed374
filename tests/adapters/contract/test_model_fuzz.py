"""Reading ends with an answer for any bytes; reader and schema agree about models built as clause 9 says."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from second_schema import second_opinion

from ucm_cts.adapters.contract.metamodel.common import walk
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.spelling import SPELLINGS
from ucm_cts.harness.toolchains.corpus import strategies
from ucm_cts.harness.toolchains.corpus.fuzzing import PRINTED, PROPERTIES
from ucm_cts.harness.toolchains.corpus.schema import violations

quick = settings(max_examples=300, deadline=None, suppress_health_check=list(HealthCheck))


@pytest.mark.parametrize("holds", PROPERTIES, ids=lambda holds: holds.__name__)
def test_properties_of_reading(holds: Callable[[Any], None]) -> None:
    given(PROPERTIES[holds])(quick(holds))()


@settings(quick, max_examples=3)
@given(st.tuples(*map(strategies.models, SPELLINGS)))
def test_every_class_is_drawn(models: tuple[Model, ...]) -> None:
    for cls, model in zip(SPELLINGS, models, strict=True):
        assert any(type(element) is cls for element in walk(model))


@settings(quick, max_examples=40)
@given(strategies.spoilt(st.sampled_from(PRINTED)))
def test_two_validators_agree(xml: bytes) -> None:
    text = xml.decode()
    assume("\u00a0" not in text)  # which xmlschema takes for a space
    assume(not re.search(r"<(\w+)[^<>]*(?<!/)>\s+</\1>", text))  # libxml2 lets blanks stand where nothing may
    assert second_opinion().is_valid(text) == (not violations(xml))
