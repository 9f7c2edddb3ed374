"""Checks annotations: those of clause 14 as such, and those that data types of the model need."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from ucm_cts.harness.toolchains.idl.language.reading import Files, NotIdl, read_expression
from ucm_cts.harness.toolchains.idl.language.scopes import Entry, Scope, every
from ucm_cts.harness.toolchains.idl.language.showing import show, show_worth
from ucm_cts.harness.toolchains.idl.language.values import Worth, equal, model_worth, worth
from ucm_cts.harness.toolchains.idl.results import NotExercised, Wrong
from ucm_cts.harness.toolchains.idl.subject import here
from ucm_cts.harness.toolchains.idl.vendor import Vendor
from ucm_cts.reference_models.mapping.idl import declarations as idl
from ucm_cts.reference_models.mapping.idl.expectations import Defaulted, Indexed, Numbered, Tagged


class Defined(NamedTuple):
    """An annotation of clause 14: its requirement, and its one member if it has one."""

    requirement: str
    member: str
    type: idl.Type | None


DEFINED = {
    "int8": Defined("R-14-02", "", None),
    "uint8": Defined("R-14-03", "", None),
    "memoryfootprint": Defined("R-14-04", "max", idl.Basic("unsigned long")),
    "indextype": Defined("R-14-05", "typeid", idl.Text()),
    "defaultvalue": Defined("R-14-06", "val", idl.Text()),
}
"""By their names in lower case, because clause 12 spells some in two ways (interpretation annotation-spellings)."""

STANDARD_VALUES = {"value", "default"}
"""Annotations of IDL itself that say the same as DefaultValue."""

_NO_NUMBER = -(2**70)
"""What an annotation gives whose value is no number: none that could be right."""

KINDS = {
    "short": {"SHORT"},
    "long": {"LONG"},
    "long long": {"LONGLONG"},
    "unsigned short": {"USHORT"},
    "unsigned long": {"ULONG"},
    "unsigned long long": {"ULONGLONG"},
    "int16": {"SHORT"},
    "int32": {"LONG"},
    "int64": {"LONGLONG"},
    "uint16": {"USHORT"},
    "uint32": {"ULONG"},
    "uint64": {"ULONGLONG"},
    "octet": {"BYTE", "UBYTE"},
    "int8": {"BYTE"},
    "uint8": {"UBYTE"},
}
"""Which kinds of the model an integer type of IDL can be."""


def annotations_of(declaration: idl.Declaration) -> Iterator[idl.Annotation]:
    """The annotations of a declaration, those in front of its type too."""
    yield from declaration.annotations
    type_ = getattr(declaration, "type", None)
    while isinstance(type_, (idl.Annotated, idl.ArrayOf)):
        yield from type_.annotations if isinstance(type_, idl.Annotated) else ()
        type_ = type_.type if isinstance(type_, idl.Annotated) else type_.element


def find(declaration: idl.Declaration, name: str) -> idl.Annotation | None:
    """The annotation ``name`` of a declaration, however its letters are written."""
    return next((a for a in annotations_of(declaration) if last(a.name) == name.lower()), None)


def last(name: str) -> str:
    """The annotation that a scoped name means, in lower case."""
    return name.rsplit("::", 1)[-1].lower()


def applied(vendor: Vendor, read: Files) -> Iterator[tuple[str, list[Wrong]]]:
    """Of each use and each definition of an annotation of clause 14: its requirement, and what is wrong with it."""
    for entry in every(vendor.root):
        declaration = entry.declaration
        for annotation in annotations_of(declaration):
            defined = DEFINED.get(last(annotation.name))
            if defined is not None:
                yield defined.requirement, list(_misused(annotation, defined))
        if isinstance(declaration, idl.AnnotationDefinition) and declaration.name.lower() in DEFINED:
            defined = DEFINED[declaration.name.lower()]
            yield defined.requirement, list(_misdefined(vendor, entry, defined))


def _misused(annotation: idl.Annotation, defined: Defined) -> Iterator[Wrong]:
    names = [one.name.lower() for one in annotation.arguments]
    wanted = [defined.member] if defined.member else []
    if names == wanted or (names == [""] and wanted):
        return
    expected = f"@{annotation.name}({defined.member})" if wanted else f"@{annotation.name} without members"
    yield Wrong(expected, f"({', '.join(names)})", annotation.place)


def _misdefined(vendor: Vendor, entry: Entry, defined: Defined) -> Iterator[Wrong]:
    definition = entry.declaration
    assert isinstance(definition, idl.AnnotationDefinition)
    found = [(member.name, member.type) for member in definition.members]
    wanted = [(defined.member, defined.type)] if defined.type is not None else []
    printed = [(name, idl.Text() if type_ == idl.Named("String") else type_) for name, type_ in found]
    meant, due = ([(n, vendor.meaning(t, entry.scope)) for n, t in members] for members in (printed, wanted))
    if meant != due and all(vendor.known(type_, entry.scope) for _, type_ in printed):
        expected = ", ".join(f"{show(t)} {n}" for n, t in wanted if t is not None) or "no members"
        observed = ", ".join(f"{show(t)} {n}" for n, t in found) or "no members"
        yield Wrong(f"annotation {definition.name} with {expected}", observed, definition.place)


def tagged(vendor: Vendor, fact: Tagged) -> list[Wrong]:
    """Whether a declaration has an annotation, and its value."""
    hit = here(vendor, fact.path)
    declaration = hit.entry.declaration
    found = find(declaration, fact.name)
    if fact.maximum is None:
        return (
            []
            if found is not None
            else [Wrong(f"@{fact.name} {declaration.name}", "no such annotation", declaration.place)]
        )
    if found is None:
        raise NotExercised
    value = _value(found, hit.entry.scope)
    if equal(value, fact.maximum):
        return []
    return [Wrong(f"@{fact.name}(max={fact.maximum})", show_worth(value), found.place)]


def _value(annotation: idl.Annotation, scope: Scope) -> Worth | None:
    """The value that an annotation with one member gives."""
    return worth(annotation.arguments[0].value, scope) if len(annotation.arguments) == 1 else None


def indexed(vendor: Vendor, fact: Indexed) -> list[Wrong]:
    """Whether the index type is given where it is needed, is an integer, and is the model's."""
    hit = here(vendor, fact.path, (idl.Typedef, idl.Enum))
    declaration = hit.entry.declaration
    found = [a for a in annotations_of(declaration) if last(a.name) == "indextype"]
    if not found:
        return _unindexed(vendor, fact, declaration)
    kinds = [_kinds(vendor, annotation, hit.entry.scope) for annotation in found]
    if not fact.kinds:
        return [
            Wrong("an integer type", f"{show_worth(_value(annotation, hit.entry.scope))}", annotation.place)
            for annotation, kind in zip(found, kinds, strict=True)
            if kind is not None and not kind
        ]
    wrong = [a for a, kind in zip(found, kinds, strict=True) if kind and not kind & set(fact.kinds)]
    return [
        Wrong(f"an index of kind {' or '.join(fact.kinds)}", show_worth(_value(a, hit.entry.scope)), a.place)
        for a in wrong
    ]


def _unindexed(vendor: Vendor, fact: Indexed, declaration: idl.Declaration) -> list[Wrong]:
    if not fact.kinds or (fact.kinds == ("ULONG",) and vendor.reading("index-annotations") != "always"):
        raise NotExercised
    return [
        Wrong(
            f"@IndexType for {' or '.join(fact.kinds)} on {declaration.name}", "no such annotation", declaration.place
        )
    ]


def _kinds(vendor: Vendor, annotation: idl.Annotation, scope: Scope) -> set[str] | None:
    """The kinds that an IndexType's type can be, none if it is no integer; None if the annotation itself is wrong."""
    value = _value(annotation, scope)
    if not isinstance(value, str):
        return None
    kinds: set[str] = set()
    for one in value.split(","):  # an index type for each dimension of an array
        name = " ".join(one.split())
        type_ = idl.Basic(name) if name in KINDS else idl.Named(name.replace(" ", "_"))
        meaning = vendor.meaning(type_, scope)
        if meaning[0] == "unknown" and (vendor.missing or vendor.unreadable):
            return None
        kind = KINDS.get(meaning[2] or meaning[1], set()) if meaning[0] == "basic" else set()
        if not kind:
            return set()
        kinds |= kind
    if "ULONG" in kinds and vendor.reading("idl-ulonglong") != "unsigned-long-long":
        kinds.add("ULONGLONG")
    return kinds


def numbered(vendor: Vendor, fact: Numbered) -> list[Wrong]:
    """Whether the values of enumerators follow from the IDL.

    If the vendor does not declare that they do, only those that are given are asked for.
    """
    is_asked = vendor.reading("idl-enumerator-values") in ("observed", "default-value")
    hit = here(vendor, fact.path, idl.Enum)
    enum = hit.entry.declaration
    assert isinstance(enum, idl.Enum)
    declared = vendor.reading("idl-enumerator-values") == "default-value"
    ways = {"defaultvalue"} if declared else {"defaultvalue", *STANDARD_VALUES}
    shown = {one.name.lower(): (_number_of(one, hit.entry.scope, ways), one) for one in enum.enumerators}
    position = {one.name.lower(): n for n, one in enumerate(enum.enumerators)}
    previous = {
        one.name.lower(): before for before, one in zip((None, *enum.enumerators), enum.enumerators, strict=False)
    }
    annotated = any(number is not None for number, _ in shown.values())
    if not is_asked and not annotated:
        raise NotExercised
    wanted = dict(fact.values)
    wrong = []
    for name, value in wanted.items():
        found = vendor.inside(hit, name)
        key = found.entry.declaration.name.lower() if found is not None else ""
        if key not in shown:
            continue
        number, enumerator = shown[key]
        if not is_asked and number in (None, _NO_NUMBER):
            continue
        before = previous[key]
        next_ = {position[key]}
        if before is not None:
            due = [v for n, v in wanted.items() if n.lower() == before.name.lower()]
            next_ |= {v + 1 for v in due if annotated}
        next_ = set() if declared else next_
        if value not in ({number} if number is not None else next_):
            observed = "nothing that tells it" if number is None else str(number)
            wrong.append(Wrong(f"value {value} of {name}", observed, enumerator.place))
    return wrong


def _number_of(declaration: idl.Declaration, scope: Scope, ways: set[str]) -> int | None:
    """The number that an annotation gives."""
    for annotation in annotations_of(declaration):
        if last(annotation.name) in ways:
            value = _value(annotation, scope)
            if isinstance(value, str):
                value = _parsed(value, scope)
            return value if isinstance(value, int) and not isinstance(value, bool) else _NO_NUMBER
    return None


def _parsed(text: str, scope: Scope) -> Worth | None:
    try:
        return worth(read_expression(text), scope)
    except NotIdl:
        return None


def defaulted(vendor: Vendor, fact: Defaulted) -> list[Wrong]:
    """Whether the default value, if one is given, is the model's."""
    hit = here(vendor, fact.path, idl.Attribute)
    declaration = hit.entry.declaration
    found: Sequence[idl.Annotation] = [
        a for a in annotations_of(declaration) if last(a.name) in {"defaultvalue", "default"}
    ]
    if not found and vendor.reading("idl-attribute-defaults") != "annotated":
        raise NotExercised
    if not found:
        return [Wrong(f"@DefaultValue on {declaration.name}", "no such annotation", declaration.place)]
    kind = vendor.value_kind(fact.type)
    wanted = model_worth(fact.value, kind, hit.entry.scope)
    value = _value(found[0], hit.entry.scope)
    alternatives = [value, model_worth(value, kind, hit.entry.scope) if isinstance(value, str) else None]
    if wanted is None or any(equal(one, wanted) for one in alternatives):
        return []
    return [Wrong(f"default value {show_worth(wanted)} of {declaration.name}", show_worth(value), found[0].place)]
