"""Tool chains that do not report what their reader finds, and those that declare another reading than they have."""

from __future__ import annotations

from typing import NamedTuple

from ucm_cts.adapters.contract.metamodel.reading import Problem
from ucm_cts.adapters.mutants.toolchain.checking import deaf, tells_of
from ucm_cts.adapters.mutants.toolchain.registry import Derive, breaks, named
from ucm_cts.adapters.mutants.toolchain.variants.ports import naming_by_heir, naming_by_owner
from ucm_cts.adapters.reference.toolchain.program import Program

BAD, MISSING, MISPLACED = ({"bad literal", "bad number"}, {"missing attribute"}, {"misplaced element"})


class Unread(NamedTuple):
    """Problems of ``kinds`` with ``attribute``, or with any, of elements that are called one of ``tags`` are not reported."""

    requirements: str
    lie: str
    kinds: set[str] = set()
    tags: str = ""
    attribute: str = ""
    also: tuple[str, ...] = ()
    declares: tuple[str, ...] = ()

    def derive(self) -> Derive:
        def ignored(problem: Problem, _: object) -> bool:
            about = not self.attribute or tells_of(self.attribute, problem.message)
            return problem.kind in self.kinds and problem.element in self.tags.split() and about

        return lambda program: deaf(program, ignored)


UNREAD = {
    "any_direction": Unread("R-9.2.7-10", "Takes any word for a direction.", BAD, "Parameter", "direction"),
    "any_mode": Unread("R-9.2.7.4-03", "Takes any word for a mode.", BAD, "Attribute", "mode"),
    "any_nature": Unread("R-9.3.3.3-04", "Takes any word for a nature.", BAD, "InteractionItem", "nature"),
    "any_upper_multiplicity": Unread(
        "R-9.3.3.4-03", "Takes any word for an upper multiplicity.", BAD, "InteractionRole", "upperMultiplicity"
    ),
    "any_kind": Unread("R-9.3.5.2-04", "Takes any word for the kind of a port element.", BAD, "PortElement", "kind"),
    "any_multiplicity": Unread(
        "R-9.4.3.1-03",
        "Takes any word for a multiplicity.",
        BAD,
        "TechnicalAspect",
        "multiplicity",
        also=("R-9.4.3.1-02",),
    ),
    "any_applicability": Unread(
        "R-9.4.3.2-05",
        "Takes any word for an applicability.",
        BAD,
        "TechnicalPolicyDefinition",
        "applicability",
        also=("R-9.4.3.2-04",),
    ),
    "defaults_of_any_kind": Unread(
        "R-9.2.4.6-07", "Takes any word for whether a case is the default.", BAD, "UnionCase"
    ),
    "index_values_of_any_kind": Unread(
        "R-9.2.4.8-02", "Takes words and fractions for index values.", BAD, "Enumerator"
    ),
    "sizes_of_any_kind": Unread(
        "R-9.2.4.11-02", "Takes words and fractions for sizes of arrays.", BAD, "ArrayDimension"
    ),
    "greatest_sizes_of_any_kind": Unread(
        "R-9.2.5.1-02", "Takes words and fractions for greatest sizes.", {"bad number"}, "StringType Sequence"
    ),
    # values that are missing
    "integers_of_any_kind": Unread(
        "R-9.2.3.2-02", "Takes any word for a kind of integer, or none.", BAD | MISSING, "PrimitiveInteger", "kind"
    ),
    "floats_of_any_kind": Unread(
        "R-9.2.3.3-02 R-9.2.3.3-04",
        "Takes any word for a kind of float, FIXED among them.",
        BAD | MISSING,
        "PrimitiveFloat",
        "kind",
    ),
    "characters_of_any_kind": Unread(
        "R-9.2.3.4-02", "Takes any word for a kind of character, or none.", BAD | MISSING, "PrimitiveChar", "kind"
    ),
    "strings_of_anything": Unread(
        "R-9.2.5.2-02", "Takes any word for the base of a string, or none.", BAD | MISSING, "StringType", "charBase"
    ),
    "direction_left_out": Unread(
        "R-9.2.7.3-02", "Does without the direction of a parameter.", MISSING, "Parameter", "direction"
    ),
    "nature_left_out": Unread(
        "R-9.3.3.3-03", "Does without the nature of an item.", MISSING, "InteractionItem", "nature"
    ),
    "lower_multiplicity_left_out": Unread(
        "R-9.3.3.4-02",
        "Does without the lower multiplicity of a role.",
        MISSING,
        "InteractionRole",
        "lowerMultiplicity",
    ),
    "kind_left_out": Unread("R-9.3.5.2-03", "Does without the kind of a port element.", MISSING, "PortElement", "kind"),
    "multiplicity_left_out": Unread(
        "R-9.4.3.1-02", "Does without the multiplicity of an aspect.", MISSING, "TechnicalAspect", "multiplicity"
    ),
    "applicability_left_out": Unread(
        "R-9.4.3.2-04",
        "Does without the applicability of a policy definition.",
        MISSING,
        "TechnicalPolicyDefinition",
        "applicability",
    ),
    "enumerators_count_themselves": Unread(
        "R-9.2.4.8-01", "Takes enumerators without value.", MISSING, "Enumerator", "value"
    ),
    "sizes_may_be_missing": Unread(
        "R-9.2.4.11-01", "Takes dimensions without size.", MISSING, "ArrayDimension", "size"
    ),
    "greatest_sizes_may_be_missing": Unread(
        "R-9.2.5.1-01",
        "Takes strings and sequences without greatest size, although it says that it does not.",
        MISSING,
        "Sequence",
        "maxSize",
        declares=("absent-max-size=refused",),
    ),
    # elements in places where they do not belong
    "components_among_aspects": Unread(
        "R-9.4.2.1-05",
        "Lets component modules stand anywhere.",
        MISPLACED,
        "ComponentModule",
        also=("R-9.1.4.8-02", "R-9.2.2.15-03"),
    ),
    "aspects_among_components": Unread(
        "R-9.5.2.1-04",
        "Lets technical aspects stand anywhere.",
        MISPLACED,
        "TechnicalAspect",
        also=("R-9.1.4.8-02", "R-9.2.2.15-03"),
    ),
    "ports_of_composites": Unread("R-9.5.5.2-02", "Lets ports stand anywhere.", MISPLACED, "Port"),
    "attributes_anywhere": Unread("R-9.1.2-03", "Takes attributes wherever they stand.", MISPLACED, "Attribute"),
    "parameters_anywhere": Unread(
        "R-9.1.2-05 R-9.1.2-06",
        "Takes configuration parameters wherever they stand, in patterns, too, although it says otherwise.",
        MISPLACED,
        "ConfigurationParameter",
        declares=("pattern-parameters=refused",),
    ),
    "annotation_definitions_anywhere": Unread(
        "R-9.1.2-09", "Takes definitions of annotations outside of contract modules.", MISPLACED, "AnnotationDefinition"
    ),
    "annotations_anywhere": Unread("R-9.2.2.8-02", "Takes annotations wherever they stand.", MISPLACED, "Annotation"),
    # declarations that are not true
    "modules_in_pieces": Unread(
        "R-9.1.4.1-02",
        "Reads two modules of one name as one, although it says that this is an error.",
        declares=("modules-given-twice=refused",),
    ),
    "mode_left_out": Unread(
        "R-9.2.7.4-02",
        "Says that an attribute must have a mode, and does without.",
        declares=("attribute-mode-absent=required",),
    ),
    "native_types_unseen": Unread(
        "R-9.2.5.3-01",
        "Takes native types, although it says that it does not know them.",
        declares=("native-types=unsupported",),
    ),
    "modules_extend_modules": Unread(
        "R-9.3.2.2-03",
        "Says that modules do not extend modules, and takes no notice of it.",
        declares=("module-extension=refused",),
    ),
}

for _name, _one in UNREAD.items():
    breaks(*_one.requirements.split(), also=_one.also, declares=_one.declares)(named(_one.derive(), _name, _one.lie))


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
