"""Tool chains that pass values of one kind of type in one direction in a wrong way, and those that are wrong about types made of others."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ucm_cts.adapters.mutants.toolchain.rewriting import BOTH, CPP03, CPP11, Edits, Wrong, register, replace_each

_TYPE = r"(::passing_application::passing::\w+)"

BY_VALUE, BY_REFERENCE, BY_CONSTANT_REFERENCE, BY_POINTER = r"\2", r"\2&", r"const \2&", r"\2*"

REFERENCE = "R-13.6.1-03"
PRIMITIVE = "R-13.6.1-04"
CONSTANT_REFERENCE = "R-13.6.1-05"
RESULT = "R-13.6.1-06"

GIVEN: Mapping[str, tuple[str, str]] = {
    "list": (CONSTANT_REFERENCE, BY_VALUE),
    "bounded": (CONSTANT_REFERENCE, BY_REFERENCE),
    "choice": (CONSTANT_REFERENCE, BY_VALUE),
    "array": (CONSTANT_REFERENCE, BY_VALUE),
    "record_alias": (CONSTANT_REFERENCE, BY_VALUE),
    "array_alias": (CONSTANT_REFERENCE, BY_POINTER),
    "wide_text": (CONSTANT_REFERENCE, BY_VALUE),
    "char": (PRIMITIVE, BY_CONSTANT_REFERENCE),
    "boolean": (PRIMITIVE, BY_CONSTANT_REFERENCE),
    "double": (PRIMITIVE, BY_CONSTANT_REFERENCE),
    "longlong": (PRIMITIVE, BY_CONSTANT_REFERENCE),
    "ulonglong": (PRIMITIVE, BY_REFERENCE),
}
"""By the kind of type: what an IN parameter breaks that is passed in this way."""

TAKEN: Mapping[str, str] = {
    "list": BY_CONSTANT_REFERENCE,
    "choice": BY_POINTER,
    "array": BY_VALUE,
    "record_alias": BY_VALUE,
    "boolean": BY_VALUE,
    "wide_text": BY_VALUE,
}
"""The same for OUT parameters."""

CHANGED: Mapping[str, str] = {
    "record": BY_CONSTANT_REFERENCE,
    "text": BY_VALUE,
    "level": BY_VALUE,
    "array": BY_VALUE,
    "choice": BY_CONSTANT_REFERENCE,
    "record_alias": BY_POINTER,
}
"""The same for INOUT parameters."""

RETURNED: Mapping[str, str] = {
    "array": BY_CONSTANT_REFERENCE,
    "bounded": BY_REFERENCE,
    "list": BY_POINTER,
    "choice": BY_CONSTANT_REFERENCE,
    "char": BY_CONSTANT_REFERENCE,
    "record_alias": BY_REFERENCE,
}
"""The same for results."""

IN_BOTH = frozenset({"list", "record_alias", "boolean", "text"})
"""Kinds that are passed in a wrong way to either standard; both are judged by the same code."""

_HOW = {
    BY_VALUE: "by_value",
    BY_REFERENCE: "by_reference",
    BY_CONSTANT_REFERENCE: "by_constant_reference",
    BY_POINTER: "by_pointer",
}


def _tasks(kind: str) -> Sequence[str]:
    return BOTH if kind in IN_BOTH else CPP11


def _passed(kind: str, name: str, how: str) -> Edits:
    """The parameter ``name`` of the method for ``kind`` is passed in another way."""
    return {rf"( pass_{kind}\((?:[^\n]*, )?)(?:const )?{_TYPE}&? {name}\b": rf"\1{how} {name}"}


def _returned(kind: str, how: str) -> Edits:
    return {rf"(virtual ){_TYPE} pass_{kind}\(": rf"\1{how} pass_{kind}("}


register(
    "passing",
    {
        f"in_{kind}_{_HOW[how]}": Wrong(requirement, _passed(kind, "given", how), tasks=_tasks(kind))
        for kind, (requirement, how) in GIVEN.items()
    },
)
register(
    "passing",
    {
        f"{direction}_{kind}_{_HOW[how]}": Wrong(REFERENCE, _passed(kind, name, how), tasks=_tasks(kind))
        for direction, name, table in (("out", "taken", TAKEN), ("inout", "changed", CHANGED))
        for kind, how in table.items()
    },
)
register(
    "passing",
    {
        f"{kind}_returned_{_HOW[how]}": Wrong(RESULT, _returned(kind, how), tasks=_tasks(kind))
        for kind, how in RETURNED.items()
    },
)

_OWNER = r"(class Abstract_Owner_Impl .*?)"
_ATTRIBUTES = r"(class Abstract_attributes .*?)"

PASSING: Mapping[str, Wrong] = {
    "array_read_by_reference": Wrong(
        "R-13.5-02", {rf"{_ATTRIBUTES}virtual {_TYPE} its_array\(": r"\1virtual const \2& its_array("}
    ),
    "alias_read_by_reference": Wrong(
        "R-13.5-02", {rf"{_ATTRIBUTES}virtual {_TYPE} fixed_record_alias\(": r"\1virtual const \2& fixed_record_alias("}
    ),
    "list_cannot_be_set": Wrong("R-13.5-03", {rf"{_ATTRIBUTES}    virtual void its_list\([^\n]*\n": r"\1"}),
    "character_is_set_by_pointer": Wrong(
        "R-13.5-03", {rf"{_ATTRIBUTES}virtual void its_char\({_TYPE}": r"\1virtual void its_char(\2*"}
    ),
    "fixed_union_is_set": Wrong(
        "R-13.5-05",
        {
            rf"{_ATTRIBUTES}(    virtual {_TYPE} fixed_choice\(\) = 0;\n)": r"\1\2    virtual void fixed_choice(const \3&) {}\n"
        },
    ),
    "list_of_a_component_cannot_be_set": Wrong("R-13.7-13", {rf"{_OWNER}    virtual void its_list\([^\n]*\n": r"\1"}),
    "union_of_a_component_read_by_reference": Wrong(
        "R-13.7-13", {rf"{_OWNER}virtual {_TYPE} its_choice\(": r"\1virtual const \2& its_choice("}
    ),
}
register("passing", PASSING)


def _typedef(name: str, pattern: str, instead: str) -> Edits:
    return {rf"{pattern}( {name};)": rf"{instead}\1"}


_STORED = (("by_short", "int32"), ("by_longlong", "int32"), ("by_ulonglong", "int64"))
"""Enumerations, and the type that is below them instead."""

register(
    "kinds",
    {
        f"enumeration_{name}_is_{type_}": Wrong(
            "R-13.2.3-04", {rf"enum {name}_t : \w+ ": f"enum {name}_t : {type_}_t "}, tasks=CPP11
        )
        for name, type_ in _STORED
    },
)
register(
    "kinds",
    {
        f"safe_enum_{name}_is_{type_}": Wrong(
            "R-13.10.2-04", {rf"safe_enum< {name}_t_def, \w+ >": f"safe_enum< {name}_t_def, {type_}_t >"}, tasks=CPP03
        )
        for name, type_ in _STORED
    },
)

_VECTOR = r"::std::vector< "

KINDS: Mapping[str, Wrong] = {
    "sequence_of_booleans_is_of_characters": Wrong(
        "R-13.2.5-02", _typedef("flags_t", _VECTOR + r"\S+ >", "::std::vector< char >")
    ),
    "sequence_of_characters_is_a_string": Wrong(
        "R-13.2.5-02", _typedef("letters_t", _VECTOR + r"\S+ >", "::std::string")
    ),
    "sequence_of_texts_is_of_pointers": Wrong(
        "R-13.2.5-02", _typedef("texts_t", _VECTOR + r"\S+ >", "::std::vector< const char* >")
    ),
    "sequence_of_sequences_is_flat": Wrong(
        "R-13.2.5-02", _typedef("lists_t", _VECTOR + r"\S+ >", "::kinds::numbers_t")
    ),
    "few_flags_are_one_more": Wrong("R-13.2.5-01", _typedef("few_flags_t", "3 >", "4 >")),
    "few_texts_are_one_less": Wrong("R-13.2.5-01", _typedef("few_texts_t", "3 >", "2 >")),
    "third_dimension_is_the_first": Wrong("R-13.2.4-02", _typedef("cube_t", "4 >, 3 >, 2 >", "2 >, 3 >, 4 >")),
    "array_of_texts_is_of_pointers": Wrong(
        "R-13.2.4-01", _typedef("three_texts_t", r"array< \S+, 3 >", "array< const char*, 3 >"), tasks=CPP11
    ),
    "ucm_array_of_flags_is_of_characters": Wrong(
        "R-13.10.1-01", _typedef("three_flags_t", r"array< \S+, 3 >", "array< char, 3 >"), tasks=CPP03
    ),
    "alias_of_a_sequence_is_of_another": Wrong(
        "R-13.2-02", _typedef("sequence_alias", r"typedef \S+", "typedef ::kinds::short_t")
    ),
    "large_constant_is_cut": Wrong("R-13.2.7-02", {r"a_ulonglong = \d+": "a_ulonglong = 1410065408"}),
    "constant_of_another_alias": Wrong(
        "R-13.2.7-02", {r"an_enumerator = \S+;": "an_enumerator = ::kinds::by_ubyte_t::ubyte_first;"}
    ),
}
register("kinds", KINDS)

IDL: Mapping[str, tuple[str, str, str]] = {
    # parameters of each kind (12.6)
    "in_sequence_is_inout": ("R-12.6-05", r"(pass_list\()in ", r"\1inout "),
    "in_union_is_out": ("R-12.6-05", r"(pass_choice\()in ", r"\1out "),
    "out_array_is_inout": ("R-12.6-05", r"(pass_array\(.*)\bout ", r"\1inout "),
    "out_boolean_is_in": ("R-12.6-05", r"(pass_boolean\(.*)\bout ", r"\1in "),
    "inout_structure_is_in": ("R-12.6-05", r"(pass_record\(.*)\binout ", r"\1in "),
    "inout_enumeration_is_out": ("R-12.6-05", r"(pass_level\(.*)\binout ", r"\1out "),
    "inout_reference_is_in": ("R-12.6-05", r"(pass_listener\(.*)\binout ", r"\1in "),
    "in_alias_is_another": ("R-12.6-06", r"(pass_record_alias\(in \S+::)record_alias", r"\1array_alias"),
    "out_character_is_wide": ("R-12.6-06", r"(pass_char\(.* out \S+::)char_t", r"\1wide_char_t"),
    "array_not_returned": ("R-12.6-07", r"\S+( pass_array\()", r"void\1"),
    "union_returned_as_its_selector": ("R-12.6-07", r"choice_t( pass_choice\()", r"level_t\1"),
    # attributes of each kind (12.6, 12.8.1)
    "boolean_attribute_can_be_written": (
        "R-12.6-10",
        r"(interface attributes \{[^}]*)readonly (attribute \S+ fixed_boolean;)",
        r"\1\2",
    ),
    "union_attribute_of_a_component_forgotten": (
        "R-12.8.1-02",
        r"(interface owner \{[^}]*?)attribute \S+ its_choice;",
        r"\1",
    ),
    "array_attribute_of_a_component_of_another_type": (
        "R-12.8.1-03",
        r"(interface owner \{[^}]*?)array_t( its_array;)",
        r"\1list_t\2",
    ),
    "sequence_attribute_of_a_component_is_read_only": (
        "R-12.8.1-04",
        r"(interface owner \{[^}]*?)(attribute \S+ its_list;)",
        r"\1readonly \2",
    ),
    # types made of others (12.4.1)
    "third_dimension_forgotten": ("R-12.4.1-08", r"(cube_t\[2\]\[3\])\[4\]", r"\1"),
    "array_of_texts_of_characters": ("R-12.4.1-08", r"text_t( three_texts_t)", r"char_t\1"),
    "sequence_of_booleans_of_characters": ("R-12.4.1-09", r"boolean_t(> flags_t)", r"char_t\1"),
    "sequence_of_sequences_flattened": ("R-12.4.1-09", r"numbers_t(> lists_t)", r"longlong_t\1"),
    "bound_of_texts_forgotten": ("R-12.4.1-09", r"label_t, 3>( few_texts_t)", r"label_t>\1"),
    "alias_of_a_union_of_a_structure": ("R-12.4.1-01", r"choice_t( union_alias)", r"record_t\1"),
    "case_of_a_sequence_of_texts": ("R-12.4.1-05", r"(union choice_t [^}]*)numbers_t( list;)", r"\1texts_t\2"),
    "field_of_a_wide_text_is_narrow": ("R-12.4.1-03", r"(struct everything_t [^}]*)wide_text_t", r"\1text_t"),
    # index types (12.4.1.2)
    "sequence_by_short_is_by_long": ("R-12.4.1.2-04", r'"short"(\)\n *typedef \S+ flags_t)', r'"long"\1'),
    "sequence_by_long_long_is_by_long": ("R-12.4.1.2-04", r'"long long"(\)\n *typedef \S+ ratios_t)', r'"long"\1'),
    "array_by_long_long_is_by_long": ("R-12.4.1.2-05", r'"long long"(\)\n *typedef \S+ three_flags_t)', r'"long"\1'),
    "array_by_unsigned_is_by_signed": (
        "R-12.4.1.2-05",
        r'"unsigned long long"(\)\n *typedef \S+ three_letters_t)',
        r'"long long"\1',
    ),
    "enumeration_by_short_is_by_long": ("R-12.4.1.2-06", r'"short"(\)\n *enum by_short_t)', r'"long"\1'),
    "enumeration_by_unsigned_is_by_signed": (
        "R-12.4.1.2-06",
        r'"unsigned long long"(\)\n *enum by_ulonglong_t)',
        r'"long long"\1',
    ),
    # constants (12.5)
    "constant_of_another_value": ("R-12.5-03", r"(a_ushort = )40000", r"\g<1>4000"),
    "constant_of_an_alias_of_a_number": ("R-12.5-02", r"const \S+ a_text = .*;", "const ::kinds::long_t a_text = 4;"),
}
"""By the mutant's name: the requirement that it breaks, a pattern in the model's file, and what stands there instead."""

ALSO: Mapping[str, tuple[str, ...]] = {"constant_of_an_alias_of_a_number": ("R-12.5-03",)}
"""What the same defect breaks besides."""

DECLARES: Mapping[str, tuple[str, ...]] = {"boolean_attribute_can_be_written": ("idl-interface-attributes=attributes",)}
"""What such a tool chain claims, so that what it does is wrong."""

replace_each(IDL, also=ALSO, declares=DECLARES)
