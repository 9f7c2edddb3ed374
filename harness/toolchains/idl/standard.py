"""Compares declarations that clause 12 prints with those of a vendor, if the vendor has them.

Those of 12.10 may stand in any module. Those of 12.11 are compared only in the modules that 12.11 prints, because the
same things may follow from the models of clause 10 (interpretation standard-idl). Names of parameters are free, since one of
those printed is not IDL: it differs only in case from its type's.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator
from typing import Any

from ucm_cts.harness.toolchains.idl.results import Wrong
from ucm_cts.harness.toolchains.idl.scopes import Entry, Hit, build, every, resolve
from ucm_cts.harness.toolchains.idl.showing import type_of
from ucm_cts.harness.toolchains.idl.vendor import Meaning, Vendor
from ucm_cts.reference_models.idl.declarations import (
    Attribute,
    Declaration,
    Enum,
    Exception_,
    Forward,
    Interface,
    Module,
    Named,
    Operation,
    Place,
    SequenceOf,
    Struct,
    Type,
    kind_of,
)
from ucm_cts.reference_models.idl.expectations import ExpectedIdl
from ucm_cts.reference_models.idl.standard import STANDARD


@functools.cache
def printed() -> tuple[tuple[str, Entry], ...]:
    """The printed declarations, each with its requirement."""
    root = build({"": [standard.wrapped for standard in STANDARD]})
    requirements = {(*standard.modules, standard.declaration.name): standard.requirement for standard in STANDARD}
    return tuple((requirements[entry.path], entry) for entry in every(root) if entry.path in requirements)


def standard_differences(vendor: Vendor) -> Iterator[tuple[str, list[Wrong]]]:
    """Of each printed declaration that the vendor has: its requirement, and what is different."""
    ours = Vendor(printed()[0][1].scope, _NOTHING, {}, False, False)
    for requirement, entry in printed():
        counterparts = _counterparts(vendor, entry)
        for theirs in counterparts:
            yield requirement, list(_different(ours, entry, vendor, theirs))
        if not counterparts and _is_promised(vendor, entry.path):
            name = "::".join(entry.path)
            yield requirement, [Wrong(f"{kind_of(entry.declaration)} {name}", "no such declaration", Place())]


def _is_promised(vendor: Vendor, path: tuple[str, ...]) -> bool:
    """Whether the vendor declares that the files hold what is printed under ``path``."""
    if vendor.unreadable or vendor.missing:
        return False
    if len(path) == 1:
        return vendor.reading("idl-standard-files") == "generated"
    promises = ("printed-with-timers",) if path[0] == "timer_service" else ("printed", "printed-with-timers")
    return vendor.reading("standard-idl") in promises


_NOTHING = ExpectedIdl((), {}, {})


def _counterparts(vendor: Vendor, ours: Entry) -> list[Entry]:
    """What a vendor declares of a name of 12.10 that is not in the model, or in the printed modules of 12.11."""
    path = ours.path
    if len(path) > 1:
        hit = resolve("::" + "::".join(path), vendor.root)
        return (
            [hit.entry] if hit is not None and hit.entry.path[:-1] == path[:-1] and not _modelled(vendor, path) else []
        )
    return [
        entry
        for entry in every(vendor.root)
        if entry.declaration.name == path[0]
        and _kinds(entry) == _kinds(ours)
        and _outside(entry)
        and not _modelled(vendor, entry.path)
    ]


def _outside(entry: Entry) -> bool:
    owner = entry.scope.owner
    return owner is None or isinstance(owner.declaration, Module)


def _kinds(entry: Entry) -> str:
    return "" if isinstance(entry.declaration, Forward) else kind_of(entry.declaration)


def _modelled(vendor: Vendor, path: tuple[str, ...]) -> bool:
    """Whether the model itself has such an element, which is compared with the model."""
    return any(fact.path == path for fact in vendor.expected.facts)


def _different(ours: Vendor, mine: Entry, theirs: Vendor, entry: Entry) -> Iterator[Wrong]:
    expected, found = mine.declaration, entry.declaration
    if kind_of(expected) != kind_of(found):
        yield Wrong(f"{kind_of(expected)} {expected.name}", kind_of(found), found.place)
        return
    missing = _bases(mine) - _bases(entry)
    if missing:
        yield Wrong(f"{expected.name} to inherit from {_shown(missing)}", _shown(_bases(entry)), found.place)
    for aspect in (_own_type, _contents):
        named, meant = ((aspect(ours, mine, by), aspect(theirs, entry, by)) for by in (True, False))
        if named[0] != named[1] and meant[0] != meant[1]:
            wanted, got = _shown(named[0]), _shown(named[1])
            yield Wrong(f"{expected.name} as clause 12 prints it: {wanted}", got, found.place)


def _shown(value: Any) -> str:
    if isinstance(value, (tuple, list, frozenset)):
        parts = sorted(map(str, value)) if isinstance(value, frozenset) else map(_shown, value)
        return "(" + ", ".join(parts) + ")"
    return str(value)


def _own_type(vendor: Vendor, entry: Entry, by_name: bool) -> object:
    type_ = type_of(entry.declaration)
    return _simple(vendor, type_, entry, by_name) if type_ is not None else None


def _simple(vendor: Vendor, type_: Type, entry: Entry, by_name: bool) -> str:
    """A type ``by_name`` of what it refers to, or else with typedefs followed. Where things stand does not matter."""
    if isinstance(type_, SequenceOf):
        return f"sequence of {_simple(vendor, type_.element, entry, by_name)}"
    if by_name and isinstance(type_, Named):
        return type_.name.rsplit("::", 1)[-1]
    return str(_without_scopes(vendor.meaning(type_, entry.scope)))


def _without_scopes(meaning: Meaning) -> Meaning:
    if meaning[0] == "declared":
        return (meaning[1][-1],)
    return tuple(_without_scopes(one) if isinstance(one, tuple) and one else one for one in meaning)


def _bases(entry: Entry) -> frozenset[str]:
    declaration = entry.declaration
    names = declaration.bases if isinstance(declaration, Interface) else ()
    return frozenset(name.rsplit("::", 1)[-1].lower() for name in names)


def _contents(vendor: Vendor, entry: Entry, by_name: bool) -> object:
    declaration = entry.declaration
    inner = Hit(entry).entry.inner
    match declaration:
        case Struct() | Exception_():
            members = inner.entries if inner is not None else ()
            return tuple((one.declaration.name, _own_type(vendor, one, by_name)) for one in members)
        case Enum():
            return tuple(one.name for one in declaration.enumerators)
        case Interface():
            exported = inner.entries if inner is not None else ()
            return frozenset(
                _operation(vendor, one, by_name)
                for one in exported
                if isinstance(one.declaration, (Operation, Attribute))
            )
    return None


def _operation(vendor: Vendor, entry: Entry, by_name: bool) -> str:
    declaration: Declaration = entry.declaration
    if not isinstance(declaration, Operation):
        return f"attribute {declaration.name}"
    parameters = ", ".join(f"{p.direction} {_simple(vendor, p.type, entry, by_name)}" for p in declaration.parameters)
    raised = ", ".join(sorted(name.rsplit("::", 1)[-1] for name in declaration.raises))
    return f"{_own_type(vendor, entry, by_name)} {declaration.name}({parameters})" + (
        f" raises ({raised})" if raised else ""
    )
