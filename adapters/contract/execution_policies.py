"""Execution policies: those of 10.1.3, those of 10.5 that extend them, and the parameters of the latter.

``adapters.contract.scenario`` exports all names of this module.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

SELF_EXECUTING = "protected_self-executing_component"
ACTIVE = "protected_active_component"
PROTECTED_PASSIVE = "protected_passive_component"
UNPROTECTED_PASSIVE = "unprotected_passive_component"
"""The four execution policies of 10.1.3."""

SELF_EXECUTION_API = "self-execution_api"
"""The port element that a self-executing component provides to its container."""

PERIODIC_SELF_EXECUTING: Final = "periodic_self-executing_component"
BACKGROUND: Final = "background_self-executing_component"
PERIODIC_ACTIVE: Final = "periodic_protected_active_component"
SPORADIC_ACTIVE: Final = "sporadic_protected_active_component"
"""The four execution policies of 10.5."""

EXTENDED: Mapping[str, str] = {
    PERIODIC_SELF_EXECUTING: SELF_EXECUTING,
    BACKGROUND: SELF_EXECUTING,
    PERIODIC_ACTIVE: ACTIVE,
    SPORADIC_ACTIVE: ACTIVE,
}
"""The policy of 10.1.3 that each policy of 10.5 extends."""

PERIOD: Mapping[str, str] = {
    PERIODIC_SELF_EXECUTING: "psec_period",
    PERIODIC_ACTIVE: "ppac_period",
    SPORADIC_ACTIVE: "spac_min_period",
}
OFFSET: Mapping[str, str] = {
    PERIODIC_SELF_EXECUTING: "psec_offset",
    BACKGROUND: "bsec_offset",
    PERIODIC_ACTIVE: "ppac_offset",
}
PRIORITY: Mapping[str, str] = {
    PERIODIC_SELF_EXECUTING: "psec_priority",
    BACKGROUND: "bsec_priority",
    PERIODIC_ACTIVE: "ppac_priority",
    SPORADIC_ACTIVE: "spac_priority",
}
"""The parameters of each policy of 10.5 (10.5.1). A period and an offset are in microseconds, a priority is a plain number."""


def is_self_executing(definition: str) -> bool:
    """Does the container call ``run`` of components with this execution policy?"""
    return EXTENDED.get(definition, definition) == SELF_EXECUTING
