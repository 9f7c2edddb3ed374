"""Requirements of profile idl that apply only to vendors who declare support for what they are about."""

from __future__ import annotations

import fnmatch
from collections.abc import Mapping

from ucm_cts.harness.results.statement import Statement
from ucm_cts.reference_models.mapping.idl.expectations import RULE_OF

ASKED_OF: dict[str, tuple[str, ...]] = {
    "R-12.4.1-11": ("native-types=supported",),
    "R-12.4.1-12": ("idl-enumerator-order=kept",),
    "R-12.4.1.1-0[23]": ("native-types=supported",),
    "R-14-04": ("native-types=supported",),
    "R-12.4.1.3-02": ("idl-enumerator-values=observed", "idl-enumerator-values=default-value"),
    "R-12.4.1.3-03": ("idl-attribute-defaults=annotated",),
    "R-12.6-10": ("idl-interface-attributes=attributes",),
    "R-12.10-29": ("idl-standard-files=generated",),
    "R-12.10-3?": ("idl-standard-files=generated",),
    "R-12.11.[12]-*": ("standard-idl=printed", "standard-idl=printed-with-timers"),
    "R-12.11.3-*": ("standard-idl=printed-with-timers",),
    "R-9.3.2.3-02": ("idl-output=both",),
    "R-9.3.4.7-*": ("idl-output=both",),
    "R-9.3.5.5-0[123]": ("idl-output=both",),
    "R-9.5.3.10-0[246]": ("idl-output=both",),
    "R-14-06": ("idl-enumerator-values=default-value", "idl-attribute-defaults=annotated"),
}
"""By patterns of requirements: the readings (``option=value``) of which one must be declared. A vendor who may leave a thing out keeps or
breaks nothing by it, so without such a declaration there would be no verdict.
"""


def not_applicable(statement: Statement) -> Mapping[str, str]:
    """The requirements that do not apply to this vendor, and why."""
    reasons = {
        pattern: f"only asked of who declares {' or '.join(readings)}"
        for pattern, readings in ASKED_OF.items()
        if not any(statement.meets(reading) for reading in readings)
    }
    return {r: reason for pattern, reason in reasons.items() for r in RULE_OF if fnmatch.fnmatchcase(r, pattern)}
