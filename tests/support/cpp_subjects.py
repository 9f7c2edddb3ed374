"""The models of the C++ mapping and what clause 13 expects of them."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from pathlib import Path

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.harness.catalogue.requirements import SUITE
from ucm_cts.harness.toolchains.cpp.compiling import Headers
from ucm_cts.reference_models.mapping.cpp.expected import ExpectedCpp, Standard
from ucm_cts.reference_models.mapping.cpp.mapping import expected_cpp

NO_HEADERS = Headers(Path("/nowhere"), ())
PROFILES: Mapping[Standard, tuple[str, ...]] = {"cpp11": ("cpp", "cpp11"), "cpp03": ("cpp", "cpp03")}


@functools.cache
def model(name: str) -> Model:
    path = SUITE / "models" / "mapping" / f"{name}.xml"
    reading = read_model(path.read_bytes(), path.name)
    assert reading.problems == ()
    return reading.model


def expectations(name: str, standard: Standard = "cpp11", **readings: str) -> ExpectedCpp:
    declared = {option.replace("_", "-"): value for option, value in readings.items()}
    return expected_cpp(model(name), standard, declared)
