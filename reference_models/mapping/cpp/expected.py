"""What the C++ mapping makes of a model: claims, each with its requirement and the element of the model."""

from __future__ import annotations

from typing import Literal

from ucm_cts.adapters.contract.value import Value
from ucm_cts.reference_models.mapping.cpp.claims import Claim
from ucm_cts.reference_models.mapping.cpp.classes import Abstract

Standard = Literal["cpp11", "cpp03"]


class Expected(Value, frozen=True):
    """``claim`` must hold for ``requirement`` to be kept, because of ``element``, which begins at ``line`` of the model."""

    requirement: str
    element: str
    line: int
    claim: Claim


class ExpectedCpp(Value, frozen=True):
    """What a model makes the tool chain declare, in the order of the model."""

    standard: Standard
    expected: tuple[Expected, ...]
    abstract: tuple[Abstract, ...]
