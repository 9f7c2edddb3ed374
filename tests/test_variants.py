"""Nobody is failed for using a freedom that the text gives."""

from __future__ import annotations

import pytest
from derived import VARIANTS
from pipeline import failing_requirements

from ucm_cts.adapters.reference_py.adapter import ReferenceAdapter


@pytest.mark.parametrize("adapter", VARIANTS.values(), ids=VARIANTS.keys())
def test_conformant_variant_is_not_failed(adapter: type[ReferenceAdapter]) -> None:
    assert failing_requirements(adapter) == {}
