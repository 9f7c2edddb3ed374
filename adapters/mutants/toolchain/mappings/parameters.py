"""Tool chains that pass values of one kind of type in one direction in a wrong way, and those that are wrong about types made of others."""

from __future__ import annotations

from collections.abc import Mapping

from ucm_cts.adapters.mutants.toolchain.rewriting import BOTH, CPP03, CPP11, Wrong, register

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


def _tasks(kind: str) -> tuple[str, ...]:
    return BOTH if kind in IN_BOTH else CPP11


def _passed(kind: str, name: str, how: str) -> dict[str, str]:
    """The parameter ``name`` of the method for ``kind`` is passed in another way."""
    return {rf"( pass_{kind}\((?:[^\n]*, )?)(?:const )?{_TYPE}&? {name}\b": rf"\1{how} {name}"}


def _returned(kind: str, how: str) -> dict[str, str]:
    return {rf"(virtual ){_TYPE} pass_{kind}\(": rf"\1{how} pass_{kind}("}


register(
    "passing",
    {
        f"in_{kind}_{_HOW[how]}": Wrong(breaks=requirement, edits=_passed(kind, "given", how), tasks=_tasks(kind))
        for kind, (requirement, how) in GIVEN.items()
    },
)
register(
    "passing",
    {
        f"{direction}_{kind}_{_HOW[how]}": Wrong(breaks=REFERENCE, edits=_passed(kind, name, how), tasks=_tasks(kind))
        for direction, name, table in (("out", "taken", TAKEN), ("inout", "changed", CHANGED))
        for kind, how in table.items()
    },
)
register(
    "passing",
    {
        f"{kind}_returned_{_HOW[how]}": Wrong(breaks=RESULT, edits=_returned(kind, how), tasks=_tasks(kind))
        for kind, how in RETURNED.items()
    },
)


_STORED = (("by_short", "int32"), ("by_longlong", "int32"), ("by_ulonglong", "int64"))
"""Enumerations, and the type that is below them instead."""

register(
    "kinds",
    {
        f"enumeration_{name}_is_{type_}": Wrong(
            breaks="R-13.2.3-04", edits={rf"enum {name}_t : \w+ ": f"enum {name}_t : {type_}_t "}, tasks=CPP11
        )
        for name, type_ in _STORED
    },
)
register(
    "kinds",
    {
        f"safe_enum_{name}_is_{type_}": Wrong(
            breaks="R-13.10.2-04",
            edits={rf"safe_enum< {name}_t_def, \w+ >": f"safe_enum< {name}_t_def, {type_}_t >"},
            tasks=CPP03,
        )
        for name, type_ in _STORED
    },
)
