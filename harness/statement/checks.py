"""Checks a vendor's statement without running a scenario: false claims, requirements that do not apply, the models."""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.harness.catalogue.profiles import PARTS
from ucm_cts.harness.catalogue.requirements import Requirement, load_capabilities
from ucm_cts.harness.models.core_models import compare
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.tally import Tally
from ucm_cts.harness.statement.applicability import lacking_claims, why_not
from ucm_cts.reference_models.findings import Finding


def check_statement(statement: Statement, profile: str, requirements: Sequence[Requirement], tally: Tally) -> None:
    """Enter into ``tally`` what ``statement`` means for ``requirements``. Raises ``DocumentError`` for unusable models."""
    for requirement in requirements:
        unmet = why_not(requirement, statement)
        if unmet is not None:
            tally.settle(requirement.id, *unmet)
    if "core" not in PARTS[profile]:
        return
    for capability in load_capabilities().capabilities:
        if capability.profile == "core" and not statement.capabilities[capability.id]:
            tally.deny(_left_out(capability.id, statement))
    for requirement_id, parts in lacking_claims(statement, profile).items():
        tally.explain(requirement_id, f"all scenarios that are to exercise it ask for what is not claimed: {parts}")
    if statement.meets("core-models=shipped"):
        claimed = statement.extensions if "extensions" in PARTS[profile] else ()
        tally.add_models(compare(statement.model_paths, statement.readings, claimed))


def _left_out(part: str, statement: Statement) -> Finding:
    where = f" ({statement.source})" if statement.source else ""
    return Finding(
        "R-10.1-01",
        "core_claimed",
        f"{part} left out",
        "a vendor who claims profile core claims every part of 10.1",
        f"the vendor's statement{where} leaves out {part}",
    )
