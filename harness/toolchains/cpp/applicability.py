"""Which requirements the rules of the C++ profiles stand for, and which of them do not apply to a vendor."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from typing import get_args

from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.harness.catalogue.requirements import SUITE, load_requirements
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.statement.applicability import why_not
from ucm_cts.harness.toolchains.corpus.decoration import DECORATION_OF_CPP
from ucm_cts.harness.toolchains.cpp.probes.check import GENERATED, HEADERS, rule_of
from ucm_cts.reference_models.mapping.cpp.expected import Standard
from ucm_cts.reference_models.mapping.cpp.mapping import expected_cpp

ASKED_OF = {"R-13.2.1-04": "cpp-struct=accessors"}
"""The requirements that are only asked of those who declare a reading (``option=value``)."""

_DECLARED = dict(reading.split("=") for reading in ASKED_OF.values())

MODELS = SUITE / "models" / "mapping"


@functools.cache
def stand_for() -> Mapping[str, frozenset[str]]:
    """The requirements that each rule stands for: those that it checks with the models of the mappings."""
    found: dict[str, set[str]] = {"cpp_headers": set(HEADERS.values()), GENERATED[1]: {GENERATED[0]}}
    found[DECORATION_OF_CPP[1]] = {DECORATION_OF_CPP[0]}
    for path in sorted(MODELS.glob("*.xml")):
        model = read_model(path.read_bytes(), path.name).model
        for standard in get_args(Standard):
            for expected in expected_cpp(model, standard, _DECLARED).expected:
                found.setdefault(rule_of(expected.claim), set()).add(expected.requirement)
    return {rule: frozenset(requirements) for rule, requirements in found.items()}


def not_applicable(statement: Statement) -> Mapping[str, str]:
    """The requirements of clause 13 that do not apply to this vendor, and why."""
    reasons = {r.id: why_not(r, statement) for r in load_requirements() if r.rules and r.id.startswith("R-13")}
    undeclared = {
        requirement: f"only asked of who declares {reading}"
        for requirement, reading in ASKED_OF.items()
        if not statement.meets(reading)
    }
    return undeclared | {requirement: why[1] for requirement, why in reasons.items() if why is not None}
