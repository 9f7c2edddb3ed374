"""Compares declarations that clause 12 prints with those of a vendor, if the vendor has them.

Those of 12.10 may stand in any module. Those of 12.11 are compared only in the modules that 12.11 prints, because the
same things may follow from the models of clause 10 (interpretation standard-idl). Names of parameters are free, since one of
those printed is not IDL: it differs only in case from its type's. Only the same names in another order are wrong.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator
from dataclasses import dataclass

from ucm_cts.harness.toolchains.idl.language.scopes import Entry, build, every, resolve
from ucm_cts.harness.toolchains.idl.language.showing import show_declaration
from ucm_cts.harness.toolchains.idl.results import Wrong
from ucm_cts.harness.toolchains.idl.vendor import Meaning, Vendor
from ucm_cts.reference_models.mapping.idl import declarations as idl
from ucm_cts.reference_models.mapping.idl.expectations import ExpectedIdl
from ucm_cts.reference_models.mapping.idl.standard import STANDARD


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
            yield requirement, [Wrong(f"{idl.kind_of(entry.declaration)} {name}", "no such declaration", idl.Place())]


def _is_promised(vendor: Vendor, path: tuple[str, ...]) -> bool:
    """Whether the vendor declares that the files hold what is printed under ``path``; modules of 12.11 may be in files that are included."""
    if vendor.unreadable:
        return False
    if len(path) == 1:
        return vendor.reading("idl-standard-files") == "generated"
    if vendor.missing:
        return False
    readings = ("printed-with-timers",) if path[0] == "timer_service" else ("printed", "printed-with-timers")
    return vendor.reading("standard-idl") in readings


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
    return owner is None or isinstance(owner.declaration, idl.Module)


def _kinds(entry: Entry) -> str:
    return "" if isinstance(entry.declaration, idl.Forward) else idl.kind_of(entry.declaration)


def _modelled(vendor: Vendor, path: tuple[str, ...]) -> bool:
    """Whether the model itself has such an element, which is compared with the model."""
    return any(fact.path == path for fact in vendor.expected.facts)


def _different(ours: Vendor, mine: Entry, theirs: Vendor, entry: Entry) -> Iterator[Wrong]:
    expected, found = mine.declaration, entry.declaration
    if idl.kind_of(expected) != idl.kind_of(found):
        yield Wrong(f"{idl.kind_of(expected)} {expected.name}", idl.kind_of(found), found.place)
        return
    yield from _other_ancestors(mine, entry)
    alike = _Alike(ours, mine, theirs, entry)
    match expected, found:
        case idl.Interface(), idl.Interface():
            yield from _other_operations(alike, expected, found)
        case ((idl.Struct() | idl.Exception_()), (idl.Struct() | idl.Exception_())):
            if not alike.members(expected.members, found.members) or (isinstance(found, idl.Struct) and found.base):
                yield Wrong(show_declaration(expected), show_declaration(found), found.place)
        case idl.Enum(), idl.Enum():
            if [one.name for one in expected.enumerators] != [one.name for one in found.enumerators]:
                yield Wrong(show_declaration(expected), show_declaration(found), found.place)
        case idl.Typedef(), idl.Typedef():
            if not alike.types(expected.type, found.type):
                yield Wrong(show_declaration(expected), show_declaration(found), found.place)


def _other_ancestors(mine: Entry, entry: Entry) -> Iterator[Wrong]:
    """Interfaces of 12.10 have just the printed ancestors; those of 12.11 may be port elements as 12.8.3 has it."""
    due, found = _bases(mine), _bases(entry)
    free = {_PORT_ELEMENT} if len(mine.path) > 1 else set()
    if due <= found <= due | free:
        return
    wanted = f"to inherit from {', '.join(sorted(due))}" if due else "without ancestors"
    observed = ", ".join(sorted(found)) or "no ancestors"
    yield Wrong(f"interface {entry.declaration.name} {wanted}", observed, entry.declaration.place)


def _other_operations(alike: _Alike, expected: idl.Interface, found: idl.Interface) -> Iterator[Wrong]:
    due, there = ([one for one in interface.body if _exported(one)] for interface in (expected, found))
    for one in due:
        namesakes = [other for other in there if other.name == one.name]
        if not any(alike.operations(one, other) for other in namesakes):
            observed = show_declaration(namesakes[0]) if namesakes else "no such operation"
            place = namesakes[0].place if namesakes else found.place
            yield Wrong(f"{show_declaration(one)} in interface {expected.name}", observed, place)
    for other in there:
        if all(other.name != one.name for one in due):
            observed = show_declaration(other)
            yield Wrong(f"no {idl.kind_of(other)} {other.name} in interface {expected.name}", observed, other.place)


def _exported(declaration: idl.Declaration) -> bool:
    return isinstance(declaration, (idl.Operation, idl.Attribute))


@dataclass(frozen=True)
class _Alike:
    """Whether what stands in a printed declaration is the same as in a vendor's."""

    ours: Vendor
    mine: Entry
    theirs: Vendor
    entry: Entry

    def types(self, expected: idl.Type, found: idl.Type) -> bool:
        """By the name of the type or by its meaning, wherever either stands; another name that is printed will not do."""
        if isinstance(expected, idl.SequenceOf) and isinstance(found, idl.SequenceOf):
            bounds = (expected.bound is None) == (found.bound is None)
            return bounds and self.types(expected.element, found.element)
        name = _last(found)
        if name and name == _last(expected):
            return True
        if name in _NAMES:
            return False
        wanted = self.ours.meaning(expected, self.mine.scope)
        return _without_scopes(wanted) == _without_scopes(self.theirs.meaning(found, self.entry.scope))

    def members(self, expected: tuple[idl.Member, ...], found: tuple[idl.Member, ...]) -> bool:
        """Names, types and order."""
        return [one.name for one in expected] == [one.name for one in found] and all(
            self.types(one.type, other.type) for one, other in zip(expected, found, strict=True)
        )

    def operations(self, expected: idl.Declaration, found: idl.Declaration) -> bool:
        """Result, directions, types and order of parameters, and exceptions; the same names must have the same order."""
        if not isinstance(expected, idl.Operation) or not isinstance(found, idl.Operation):
            return False
        taken = [one.direction for one in expected.parameters] == [one.direction for one in found.parameters]
        raised = [sorted(name.rsplit("::", 1)[-1] for name in one.raises) for one in (expected, found)]
        return (
            taken
            and raised[0] == raised[1]
            and not _exchanged(expected, found)
            and self.types(expected.returns, found.returns)
            and all(
                self.types(one.type, other.type)
                for one, other in zip(expected.parameters, found.parameters, strict=True)
            )
        )


def _exchanged(expected: idl.Operation, found: idl.Operation) -> bool:
    """Do parameters have the printed names, and others than their own?"""
    due, given = ([one.name.lower() for one in operation.parameters] for operation in (expected, found))
    return due != given and sorted(due) == sorted(given)


_PORT_ELEMENT = "PortElementObject"
_NAMES = frozenset(standard.declaration.name for standard in STANDARD)


def _last(type_: idl.Type) -> str:
    return type_.name.rsplit("::", 1)[-1] if isinstance(type_, idl.Named) else ""


def _without_scopes(meaning: Meaning) -> Meaning:
    if meaning[0] == "declared":
        return (meaning[1][-1],)
    return tuple(_without_scopes(one) if isinstance(one, tuple) and one else one for one in meaning)


def _bases(entry: Entry) -> frozenset[str]:
    declaration = entry.declaration
    names = declaration.bases if isinstance(declaration, idl.Interface) else ()
    return frozenset(name.rsplit("::", 1)[-1] for name in names)
