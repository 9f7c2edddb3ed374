"""Tool chains that claim another reading of inherited names than they have."""

from __future__ import annotations

from ucm_cts.adapters.mutants.toolchain.registry import breaks
from ucm_cts.adapters.mutants.toolchain.variants.ports import naming_by_heir, naming_by_owner
from ucm_cts.adapters.reference.toolchain.program import Program


@breaks(
    *("R-9.3.3.2-04", "R-9.4.3.2-10", "R-9.5.3.4-01", "R-9.5.3.5-01", "R-9.5.4.3-04", "R-9.5.5.4-05"),
    also=("R-9.5.3.1-05",),
    declares=("inherited-member-names=heir",),
)
def heirs_do_not_name_what_they_inherit(program: Program) -> Program:
    """Declares that an inherited member has the name of its heir, and knows it by the name of its declaring element."""
    return naming_by_owner(program)


@breaks("R-9.3.3.2-04", declares=("inherited-member-names=owner",))
def owners_do_not_name_what_others_inherit(program: Program) -> Program:
    """Declares that an inherited member has the name of its declaring element, and knows it in connectors by the name of its heir."""
    return naming_by_heir(program)
