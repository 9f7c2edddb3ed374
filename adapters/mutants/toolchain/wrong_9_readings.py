"""Tool chains that declare how they read a place of clause 9 and refuse what is legal then."""

from __future__ import annotations

from ucm_cts.adapters.mutants.toolchain.registry import breaks, named
from ucm_cts.adapters.mutants.toolchain.variants_9_ports import naming_by_heir, naming_by_owner
from ucm_cts.adapters.reference.toolchain.program import Program


@breaks(
    *("R-9.3.3.2-04", "R-9.4.3.2-10", "R-9.5.3.4-01", "R-9.5.3.5-01", "R-9.5.4.3-04", "R-9.5.5.4-05"),
    also=("R-9.5.3.1-05",),
    declares=("inherited-member-names=heir",),
)
def heirs_do_not_name_what_they_inherit(program: Program) -> Program:
    """Says that an inherited member is named by who inherits it, and knows it by the name of who declares it."""
    return naming_by_owner(program)


@breaks("R-9.3.3.2-04", declares=("inherited-member-names=owner",))
def owners_do_not_name_what_others_inherit(program: Program) -> Program:
    """Says that an inherited member is named by who declares it, and knows it in connectors by the name of who inherits it."""
    return naming_by_heir(program)


_PROMISES: tuple[tuple[str, tuple[str, ...], str], ...] = (
    ("negative multiplicities", ("R-9.3.3.4-04",), "negative-multiplicities=accepted"),
    ("items of two types", ("R-9.3.3.4-08", "R-9.5.3.5-05"), "repeated-item-bindings=accepted"),
    ("abstract types of items", ("R-9.5.3.5-03", "R-9.5.3.7-03"), "abstract-actual-types=accepted"),
    ("delegations of other bindings", ("R-9.5.5.6-05",), "delegation-bindings=any"),
    ("policies on ports beside others", ("R-9.4.1-04",), "policies-on-ports-counted=apart"),
    ("selector values of two cases", ("R-9.2.4.6-05",), "repeated-selector-values=accepted"),
    ("parameters of two values", ("R-9.2.9.4-03", "R-9.5.4.2-09"), "repeated-parameter-values=accepted"),
)
"""What is refused, the requirements that this breaks, and the reading that allows it."""


for _what, _requirements, _reading in _PROMISES:
    _derive = named(
        lambda program: program,
        f"refuses_{_what.replace(' ', '_')}",
        f"Says that {_what} are legal, and refuses them as the reference tool chain does.",
    )
    breaks(*_requirements, declares=(_reading,))(_derive)
