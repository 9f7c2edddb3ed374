"""The types that are carried to check clause 10.1.1 (``suite/data_types.yaml``)."""

from __future__ import annotations

import functools

from ucm_cts.adapters.contract.data_types import AnyType
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import read
from ucm_cts.harness.catalogue.requirements import SUITE


class TypesUnderTest(Value, frozen=True):
    """Types of one sort: their requirement, and a name for each."""

    sort: str
    requirement: str
    types: dict[str, AnyType]


@functools.cache
def load_types() -> tuple[TypesUnderTest, ...]:
    """All types, sort by sort. Raises ``DocumentError``."""
    return read(SUITE / "data_types.yaml", tuple[TypesUnderTest, ...])
