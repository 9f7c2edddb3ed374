"""Statements of vendors for tests."""

from __future__ import annotations

import msgspec

from ucm_cts.harness.catalogue.requirements import load_capabilities, load_requirements
from ucm_cts.harness.results.statement import HOOKS, Statement, default_statement

ADAPTER = "ucm_cts.adapters.reference.python.adapter:ReferenceAdapter"
REQUIREMENTS = {r.id: r for r in load_requirements()}
CORE_REQUIREMENTS = [r for r in load_requirements() if r.profile == "core" and not r.untestable]
PARTS = [capability.id for capability in load_capabilities().capabilities if capability.profile == "core"]
"""Those of 10.1."""
UNASKED = ["properties"]
"""Those of 10.2 to 10.5 about which no adapter can be asked."""
EXTENSIONS = [c.id for c in load_capabilities().capabilities if c.profile == "extensions" and c.id not in UNASKED]
"""Those about which adapters are asked."""
ASKED = {
    "unknown-policy": "refused",
    "incompatible-ends": "refused",
    "attribute-defaults": "set",
    "missing-execution-policy": "default",
    "unprotected-concurrency": "concurrent",
    "message-order": "fifo",
}
"""Readings of which only those who declare them are asked anything."""
EVERYTHING = {hook: "hook" for hook in HOOKS} | ASKED


def stating(capabilities: dict[str, bool] | None = None, **changes: object) -> Statement:
    """What holds without a statement, but for this."""
    default = default_statement()
    readings = default.readings | EVERYTHING | changes.pop("readings", {})  # type: ignore[operator]
    return msgspec.structs.replace(
        default, readings=readings, capabilities=default.capabilities | (capabilities or {}), **changes
    )
