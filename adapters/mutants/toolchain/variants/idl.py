"""Conformant tool chains that generate other IDL than the reference does: each uses a freedom of clause 12."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TypeVar

import msgspec

from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.modules import MODULES
from ucm_cts.adapters.mutants.toolchain import rewriting as rw
from ucm_cts.adapters.mutants.toolchain.registry import Derive, named, variant
from ucm_cts.adapters.reference.toolchain.program import Program


def _variant(name: str, derive: Derive, *declares: str) -> None:
    variant(task="idl", declares=declares)(named(derive, name))


for _name, _edits in rw.table("variants/idl.yaml", dict[str, dict[str, str]]).items():
    _variant(_name, rw.replacing(_edits))
_variant(
    "values_in_hexadecimal",
    rw.replaced(r'@DefaultValue\(val="(\d+)"\)', lambda m: f'@DefaultValue(val="0x{int(m[1]):X}")'),
)

DEFINITIONS = {"Drive": "self_executing", "Day_Duty": "self_running", "Night": "stoppable", "Meter": "sampled"}
"""The policy definitions, as IDL spells them, by the policies that use them."""


def _definition(match: re.Match[str]) -> str:
    return f"get_tp_{DEFINITIONS[match[1]]}_"


_SAME = rw.replaced(rw.GUARD, f"\n{rw.GUARD}")

for _reading in (
    "native-types=supported",
    "idl-attribute-defaults=annotated",
    "idl-interface-attributes=attributes",
    "idl-standard-files=generated",
    "standard-idl=printed",
    "standard-idl=printed-with-timers",
    "standard-idl=model",
    "idl-enumerator-values=observed",
    "idl-enumerator-values=default-value",
):
    _variant(f"declared_{_reading.replace('-', '_').replace('=', '_as_')}", _SAME, _reading)
_variant("footprint_by_another_name", rw.replaced(r"unsigned long max;", "uint32 max;", rw.STANDARD))
_variant(
    "ids_written_out",
    rw.replaced(r"\bcomponentId (?=\w+[(,)])|\bconnectionId (?=\w+[(,)])", "long ", rw.STANDARD),
    "idl-standard-files=generated",
)
_variant("hyphens_are_underscores", _SAME, "idl-hyphens=underscore")
_variant("all_index_types_declared", _SAME, "index-annotations=always")
_variant("capitals_declared", _SAME, "idl-template-names=upper")
_variant("direct_templates_declared", _SAME, "idl-template-propagation=direct")
_variant("instances_declared", _SAME, "idl-policy-getters=instance")
_variant(
    "unsigned_long_declared",
    rw.replaced("typedef unsigned long long ", "typedef unsigned long "),
    "idl-ulonglong=unsigned-long",
)
_variant("bool_declared", rw.replaced("typedef boolean ", "typedef bool "), "idl-boolean=bool")
_variant(
    "definitions_declared",
    rw.replaced(r"get_tp_(Drive|Day_Duty|Night|Meter)_", _definition),
    "idl-policy-getters=definition",
)
_variant(
    "equivalent_syntax_besides",
    rw.appended("porttype asking_port { provides PortElementObject api; };\ncomponent Extra { port asking_port p; };"),
    "idl-output=both",
)
_variant(
    "annotations_defined_as_printed",
    rw.replaced(
        r"@annotation (\w+) \{\n *string (\w+);\n\};", r"@Annotation \1 {\n    attribute String \2;\n}", rw.STANDARD
    ),
)


HEADS: dict[str, tuple[str, tuple[tuple[str, rw.Replacement], ...]]] = {
    "macros_for_numbers": (
        "#define UCM_N_8 8\n#define UCM_N_16 \\\n  (UCM_N_8 * 2) /* twice\n as much */\n#define UCM_1 1\n#undef UCM_1\n",
        ((r"string<16>", "string<UCM_N_16>"), (r"sequence<([^<>,]*), 8>", r"sequence<\1, UCM_N_8>")),
    ),
    "macros_for_keywords": (
        "#define UCM_LOCAL local\n#define UCM_NOTHING\n#define UCM_INDEX(t) @IndexType(typeid=#t)\n#define UCM_IF(x) x ## face\n",
        (
            (r"\binterface (?=\w+(?: :| \{|;))", "UCM_NOTHING UCM_LOCAL UCM_IF(inter) "),
            (r'@IndexType\(typeid="([^"]*)"\)', r"UCM_INDEX(\n  \1\n)"),
        ),
    ),
    "branches_that_are_not_taken": (
        "#if 0\nDon't read this; module {\n# if 1\n#  error no\n# else\n# endif\n#elif defined UCM_OLD && UCM_OLD > 2\n#error no\n"
        "#else\n#define UCM_NEW (1 << 3)\n#endif\n#ifdef __OTHER_COMPILER__\n#include <other.idl>\n#endif\n",
        ((r"\n( *)(interface )", r"\n#if UCM_NEW == 8 && !defined(UCM_OLD)\n\1\2\n#else\n\1}\n#endif\n"),),
    ),
    "guards_of_another_kind": (
        "#pragma once\n",
        ((r"#ifndef (\w+)\n", r"#if !defined(\1)\n"), (r"\n#endif\n$", "\n#endif // guard\n")),
    ),
    "no_guards": ("", ((r"#ifndef (\w+)\n#define \1\n", "\n\n"), (r"\n#endif\n$", "\n"))),
}
"""By the variant's name: what stands first in each file, and patterns with what stands instead."""


def _with_directives(head: str, changes: tuple[tuple[str, rw.Replacement], ...]) -> Derive:
    def rewrite(text: str) -> str:
        for pattern, replacement in changes:
            text = re.sub(pattern, replacement, text)
        return f"{head}{text}"

    return lambda program: rw.rewritten(program, lambda files: {name: rewrite(text) for name, text in files.items()})


for _name, (_head, _changes) in HEADS.items():
    _variant(_name, _with_directives(_head, _changes))


@variant(task="idl")
def standard_declarations_in_a_module(program: Program) -> Program:
    """What 12.10 prints stands in a module."""
    names = r"::(?=PortElementObject|ComponentObject)"

    def rewrite(files: rw.Files) -> rw.Files:
        text = files[rw.STANDARD].replace("\nstruct Property", "\nmodule ucm {\nstruct Property", 1)
        text = text.replace("\nmodule standard_execution", "\n};\nmodule standard_execution", 1)
        return {rw.STANDARD: re.sub(names, "::ucm::", text), rw.MODEL: re.sub(names, "::ucm::", files[rw.MODEL])}

    return rw.rewritten(program, rewrite)


@variant(task="idl")
@rw.rewriting
def local_interfaces(files: rw.Files) -> rw.Files:
    """Interfaces have the keyword local."""
    return {n: re.sub(r"\binterface (?=\w+(?: :| \{|;))", "local interface ", t) for n, t in files.items()}


@variant(task="idl")
def other_order(program: Program) -> Program:
    """What stands first in the model stands last, as far as IDL allows."""
    generate = program.generators["idl"]
    generators = {**program.generators, "idl": lambda model: generate(_reversed(model))}
    return replace(program, generators=generators)


_M = TypeVar("_M", bound=Element)


def _reversed(element: _M) -> _M:
    """Modules, and what they hold, the other way round; what is inside of that is not touched."""
    fields = {name: getattr(element, name) for name in element.__struct_fields__}
    turned = {
        name: tuple(_reversed(one) if isinstance(one, MODULES) else one for one in reversed(value))
        for name, value in fields.items()
        if isinstance(value, tuple)
    }
    return msgspec.structs.replace(element, **turned)


@variant(task="idl")
@rw.rewriting
def a_file_for_each_module(files: rw.Files) -> rw.Files:
    """Each piece of a top module has its own file, and one includes them all."""
    head, *pieces = re.split(r"^(?=module )", files[rw.MODEL].removesuffix(rw.GUARD), flags=re.MULTILINE)
    names = {f"part_{n}.idl": f'#include "{rw.STANDARD}"\n{piece}' for n, piece in enumerate(pieces)}
    includes = "".join(f'#include "{name}"\n' for name in names)
    return {rw.STANDARD: files[rw.STANDARD], **names, rw.MODEL: f"{head}{includes}{rw.GUARD}"}


_HEAD = r"interface (\w+)((?: : [^{]*)?) \{\n"
_GETTER = r" *\S+ get_(?!tp_)\w+\(\);\n"


@variant(task="idl")
@rw.rewriting
def getters_in_bodies(files: rw.Files) -> rw.Files:
    """Getters of ports are declared in each body interface instead of the equivalent interface."""
    text = files[rw.MODEL]
    blocks = re.findall(rf"{_HEAD}((?:.*\n)*?) *\}};\n", text)
    getters = {name: re.findall(_GETTER, body, re.MULTILINE) for name, _, body in blocks}
    bases = {name: re.findall(r"\w+(?=,|$)", heads) for name, heads, _ in blocks}

    def all_of(name: str) -> list[str]:
        return [*getters.get(name, []), *(g for base in bases.get(name, []) for g in all_of(base))]

    text = re.sub(_GETTER, "", text)
    moved = re.sub(_HEAD, lambda m: m[0] + "".join(all_of(m[1]) if m[1].endswith("_Body") else []), text)
    return {**files, rw.MODEL: moved}


@variant(task="idl")
@rw.rewriting
def templates_around_templates(files: rw.Files) -> rw.Files:
    """A module around a template is a template with the same parameter, and instances are made one by one."""
    text = re.sub(
        r"module messages \{(?=\n *module message_api<)", "module messages<typename MESSAGE_TYPE_T> {", files[rw.MODEL]
    )
    text = re.sub(
        r"module (\S*::messages)::message_api(<\S+>) (\w+);",
        r"module \1\2 \3_around;\n        module \3_around::message_api\2 \3;",
        text,
    )
    return {**files, rw.MODEL: text}


@variant(task="idl")
@rw.rewriting
def interfaces_of_their_own_for_bindings(files: rw.Files) -> rw.Files:
    """Instead of an instance of a template there is an interface with the types that are bound."""
    text = re.sub(
        r"module \S+::message_api<(\S+)> (\w+);",
        r"interface \2_intf : ::PortElementObject {\n"
        r"            ::bindings_platform::return_codes::comm_ecode push(in \1 message);\n        };",
        files[rw.MODEL],
    )
    return {**files, rw.MODEL: re.sub(r"(\w+_message_api)::message_intf (?=get_)", r"\1_intf ", text)}
