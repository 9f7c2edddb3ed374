"""Which requirements the rules of the C++ profiles stand for: those that the models of the mappings make them look at."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from typing import get_args

from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.harness.catalogue import SUITE
from ucm_cts.harness.toolchains.cpp.probes import GENERATED, HEADERS, rule_of
from ucm_cts.reference_models.cpp.expected import Standard
from ucm_cts.reference_models.cpp.mapping import expected_cpp

MODELS = SUITE / "models" / "mapping"


@functools.cache
def stand_for() -> Mapping[str, frozenset[str]]:
    """The requirements that each rule stands for."""
    found: dict[str, set[str]] = {"cpp_headers": set(HEADERS.values()), GENERATED[1]: {GENERATED[0]}}
    for path in sorted(MODELS.glob("*.xml")):
        model = read_model(path.read_bytes(), path.name).model
        for standard in get_args(Standard):
            for expected in expected_cpp(model, standard, {}).expected:
                found.setdefault(rule_of(expected.claim), set()).add(expected.requirement)
    return {rule: frozenset(requirements) for rule, requirements in found.items()}
