"""A vendor's IDL and the expectations of it: finds the declaration of a path, and compares types by meaning."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

from ucm_cts.harness.toolchains.idl.language import scopes
from ucm_cts.harness.toolchains.idl.language.values import worth
from ucm_cts.reference_models.mapping.idl import declarations as idl
from ucm_cts.reference_models.mapping.idl.expectations import ExpectedIdl, Path

Meaning = tuple[Any, ...]
"""A type with all names followed: basic, text, sequence, array, declared (by its path), parameter, or unknown (by its name)."""

EIGHT_BITS = ("int8", "uint8")


PRINTED = {
    "component_execution_policies": "standard_execution_policies",
    "container_services": "standard_services",
    "timer": "timer_service",
}
"""The modules of clause 10 that 12.11 prints under other names (interpretation standard-idl)."""


def spelled(name: str) -> str:
    """A model's name as IDL can write it."""
    return name.replace("-", "_")


class Vendor:
    """The declarations of a vendor, ``incomplete`` if some of them could not be read or are elsewhere."""

    def __init__(
        self, root: scopes.Scope, expected: ExpectedIdl, readings: Mapping[str, str], unreadable: bool, missing: bool
    ) -> None:
        self.root = root
        self.expected = expected
        self.readings = readings
        self.unreadable = unreadable
        self.missing = missing
        self.met: dict[str, set[str]] = {}
        """Values of options that the IDL shows, independent of the declared ones."""

    def reading(self, option: str) -> str:
        """What the vendor declares for ``option``, empty for nothing."""
        return self.readings.get(option, "")

    def is_printed(self, path: Path) -> bool:
        """Whether the vendor has what 12.11 prints instead of what follows from the model of a standard module."""
        reading = self.reading("standard-idl")
        if not path or path[0] not in PRINTED or reading == "model":
            return False
        if reading == "printed-with-timers" or (reading == "printed" and path[0] != "timer"):
            return True
        return reading != "printed" and (self.root.own(path[0]) is None and self.root.own(PRINTED[path[0]]) is not None)

    # Places
    def at(self, path: Path) -> scopes.Hit | None:
        """What stands where the model's ``path`` leads."""
        hit: scopes.Hit | None = None
        for name in path:
            hit = self.inside(hit, name)
            if hit is None:
                return None
        return hit

    def inside(self, hit: scopes.Hit | None, name: str) -> scopes.Hit | None:
        """What the model's ``name`` has become in the scope that ``hit`` opens, or at the root."""
        for candidate in (spelled(name), spelled(name).removeprefix("_")):
            entry = self.root.own(candidate) if hit is None else None
            found = scopes.Hit(entry) if entry is not None else None
            if hit is not None:
                found = scopes.member(hit, candidate) or _enumerator(hit, candidate)
            if found is not None and found.entry.declaration.name == candidate:
                return found
        return self._renamed(hit, name) if "-" in name and self.reading("idl-hyphens") != "underscore" else None

    def _renamed(self, hit: scopes.Hit | None, name: str) -> scopes.Hit | None:
        """What has the name but for its hyphens (interpretation idl-names), if just one thing has."""
        scope = self.root if hit is None else hit.entry.inner
        pattern = re.compile(r"\w*".join(map(re.escape, name.split("-"))), re.IGNORECASE)
        like = [key for key in (scope.members if scope is not None else ()) if pattern.fullmatch(key)]
        entry = scope.own(like[0]) if scope is not None and len(like) == 1 else None
        return scopes.Hit(entry, hit.bound if hit is not None else scopes.NOTHING) if entry is not None else None

    def pattern(self, name: str, flags: int = re.IGNORECASE, usual: bool = False) -> re.Pattern[str]:
        """How the model's ``name`` may be written: ``*`` is any part of a name, not none. A hyphen may become anything, unless the vendor
        declares ``_`` (interpretation idl-names), or only the ``usual`` spelling is asked for, which is that.
        """
        hyphen = "_" if usual or self.reading("idl-hyphens") == "underscore" else r"\w*"
        return re.compile(re.escape(name).replace(r"\*", r"\w+").replace(r"\-", hyphen), flags)

    def like(self, name: str, candidates: Iterable[str]) -> str:
        """The one of ``candidates`` that the model's ``name`` has become, in lower case; ``name`` with ``_`` for hyphens if none has."""
        plain, known = spelled(name).lower(), {one.lower() for one in candidates}
        found = known if plain not in known and "-" in name else set()
        found = {one for one in found if self.pattern(name).fullmatch(one)}
        return found.pop() if len(found) == 1 else plain

    def entry(self, type_: idl.Type) -> scopes.Entry | None:
        """Where the declaration that an expected type names is, if it names one that is there."""
        if not isinstance(type_, idl.Named):
            return None
        hit = self.at(tuple(type_.name.split("::")[1:]))
        return hit.entry if hit is not None else None

    # Types
    def known(self, type_: idl.Type, scope: scopes.Scope, bound: scopes.Bound = scopes.NOTHING) -> bool:
        """Whether all names in a vendor's type mean something."""
        match type_:
            case idl.Annotated():
                return self.known(type_.type, scope, bound)
            case idl.SequenceOf() | idl.ArrayOf():
                return self.known(type_.element, scope, bound)
            case idl.Named():
                return scopes.resolve(type_.name, scope, bound) is not None or self._printed_boolean(type_.name)
        return True

    def _printed_boolean(self, name: str) -> bool:
        """The table prints bool, which is no type of IDL (interpretation idl-boolean)."""
        return name == "bool" and self.reading("idl-boolean") != "boolean"

    def same(
        self, found: idl.Type, scope: scopes.Scope, expected: idl.Type, bound: scopes.Bound = scopes.NOTHING
    ) -> bool:
        """Whether a vendor's type means the expected one. What the model leaves open decides nothing."""
        if expected == idl.Basic("") or self.is_open(expected) or self._standard(found, expected):
            return True
        if isinstance(found, idl.Annotated) and not isinstance(expected, idl.Annotated):
            found = found.type
        if isinstance(found, idl.Named) and isinstance(expected, idl.Named):
            hit = scopes.resolve(found.name, scope, bound)
            if hit is None:
                wanted = self.pattern(expected.name.rsplit("::", 1)[-1], 0)
                return self.missing and wanted.fullmatch(found.name.rsplit("::", 1)[-1]) is not None
            actual = hit.bound.get(hit.entry.declaration.name.lower()) if scopes.is_parameter(hit) else None
            if actual is not None:
                return self.same(actual.type, actual.scope, expected, actual.bound)
            if hit.entry is self.entry(expected) and not hit.bound:
                return True
        if isinstance(found, idl.SequenceOf) and isinstance(expected, idl.SequenceOf):
            return self.same(found.element, scope, expected.element, bound) and self._size(
                found.bound, scope
            ) == self._size(expected.bound, scope)
        if (
            isinstance(found, idl.ArrayOf)
            and isinstance(expected, idl.ArrayOf)
            and self._sizes(found, scope) == self._sizes(expected, scope)
        ):
            return self.same(found.element, scope, expected.element, bound)
        return self.meaning(found, scope, bound) == self.expected_meaning(expected)

    def is_open(self, expected: idl.Type) -> bool:
        """Whether the IDL leaves open what ``expected`` is. Another fact reports a missing declaration."""
        path = tuple(expected.name.split("::")[1:]) if isinstance(expected, idl.Named) else ()
        if not path or path in self.expected.abstract:
            return False
        return path in self.expected.unmapped or self.at(path) is None

    def _standard(self, found: idl.Type, expected: idl.Type) -> bool:
        """Whether a type of a standard module is meant that the vendor declares as 12.11 prints it."""
        if not isinstance(found, idl.Named) or not isinstance(expected, idl.Named):
            return False
        path = tuple(expected.name.split("::")[1:])
        return self.is_printed(path) and found.name.rsplit("::", 1)[-1] == path[-1]

    def _size(self, expression: idl.Expression | None, scope: scopes.Scope) -> object:
        return None if expression is None else worth(expression, scope)

    def _sizes(self, array: idl.ArrayOf, scope: scopes.Scope) -> tuple[object, ...]:
        return tuple(self._size(dimension, scope) for dimension in array.dimensions)

    def meaning(
        self, type_: idl.Type, scope: scopes.Scope, bound: scopes.Bound = scopes.NOTHING, steps: int = scopes.MOST_STEPS
    ) -> Meaning:
        """What a vendor's type means."""
        match type_:
            case idl.Basic():
                name = {"int16": "short", "int32": "long", "int64": "long long"}.get(type_.name, type_.name)
                name = {"uint16": "unsigned short", "uint32": "unsigned long", "uint64": "unsigned long long"}.get(
                    name, name
                )
                return ("basic", name, name if name in EIGHT_BITS else "")
            case idl.Annotated():
                return _tagged(self.meaning(type_.type, scope, bound, steps), type_.annotations)
            case idl.Text():
                return ("text", type_.wide, self._size(type_.bound, scope))
            case idl.SequenceOf():
                return (
                    "sequence",
                    self.meaning(type_.element, scope, bound, steps),
                    self._size(type_.bound, scope),
                )
            case idl.ArrayOf():
                return _array(self.meaning(type_.element, scope, bound, steps), self._sizes(type_, scope))
        return self._named(type_.name, scope, bound, steps)

    def _named(self, name: str, scope: scopes.Scope, bound: scopes.Bound, steps: int) -> Meaning:
        hit = scopes.resolve(name, scope, bound)
        if self._printed_boolean(name) and hit is None:
            return ("basic", "boolean", "")
        if hit is None or not steps:
            return ("unknown", name)
        declaration = hit.entry.declaration
        if isinstance(declaration, idl.Typedef):
            inner = self.meaning(declaration.type, hit.entry.scope, hit.bound, steps - 1)
            return _tagged(inner, declaration.annotations)
        if isinstance(declaration, idl.TemplateParameter):
            actual = hit.bound.get(declaration.name.lower())
            if actual is not None:
                return self.meaning(actual.type, actual.scope, actual.bound, steps - 1)
            return ("parameter", declaration.name.lower())
        return ("declared", tuple(part.lower() for part in hit.entry.path))

    def expected_meaning(self, type_: idl.Type, steps: int = scopes.MOST_STEPS) -> Meaning:
        """What an expected type means, in the same terms."""
        match type_:
            case idl.Annotated():
                return _tagged(self.expected_meaning(type_.type, steps), type_.annotations)
            case idl.SequenceOf():
                return ("sequence", self.expected_meaning(type_.element, steps), self._size(type_.bound, self.root))
            case idl.ArrayOf():
                return _array(self.expected_meaning(type_.element, steps), self._sizes(type_, self.root))
            case idl.Named():
                path = tuple(type_.name.split("::")[1:])
                if path in self.expected.abstract:
                    return ("parameter", self.like(self.expected.abstract[path].name, self._parameters(path[:-1])))
                if path in self.expected.types and steps:
                    return self.expected_meaning(self.expected.types[path], steps - 1)
                hit = self.at(path)
                if hit is not None and isinstance(hit.entry.declaration, idl.Typedef) and steps:
                    inner = self.meaning(hit.entry.declaration.type, hit.entry.scope, scopes.NOTHING, steps - 1)
                    return _tagged(
                        inner, hit.entry.declaration.annotations
                    )  # left open, so what the vendor makes of it
                found = hit.entry.path if hit is not None else tuple(map(spelled, path))
                return ("declared", tuple(part.lower() for part in found))
        return self.meaning(type_, self.root)

    def _parameters(self, path: Path) -> list[str]:
        """The names of the template parameters of the module at ``path``, and of those around it."""
        modules = (self.at(path[:depth]) for depth in range(1, len(path) + 1))
        declared = [hit.entry.declaration for hit in modules if hit is not None]
        return [parameter.name for one in declared if isinstance(one, idl.Module) for parameter in one.parameters]

    def value_kind(self, type_: idl.Type) -> str:
        """How values of an expected type are written: text, character, truth, enumerator or number."""
        meaning = self.expected_meaning(type_)
        if meaning[0] in ("text", "declared"):
            return "text" if meaning[0] == "text" else "enumerator"
        return {"char": "character", "wchar": "character", "boolean": "truth"}.get(str(meaning[1]), "number")


def _enumerator(hit: scopes.Hit, name: str) -> scopes.Hit | None:
    declaration = hit.entry.declaration
    if isinstance(declaration, idl.Enum) and any(one.name.lower() == name.lower() for one in declaration.enumerators):
        entry = hit.entry.scope.own(name)
        return scopes.Hit(entry, hit.bound) if entry is not None else None
    return None


def _tagged(meaning: Meaning, annotations: tuple[idl.Annotation, ...]) -> Meaning:
    tags = [one.name.lower() for one in annotations if one.name.lower() in EIGHT_BITS]
    return ("basic", "octet", tags[0]) if tags and meaning[:2] == ("basic", "octet") else meaning


def _array(element: Meaning, sizes: tuple[object, ...]) -> Meaning:
    if element[0] == "array":
        return ("array", element[1], (*sizes, *element[2]))
    return ("array", element, sizes)
