"""Reads headers with libclang, for what no probe can see: what is there that should not be.

Nothing is judged, and that is said, where libclang cannot be used or does not understand the headers.
"""

from __future__ import annotations

import re
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ucm_cts.harness.toolchains.cpp.checks import class_words
from ucm_cts.harness.toolchains.cpp.compiling import STANDARDS, Compiler, Headers, run
from ucm_cts.harness.toolchains.differences import Difference
from ucm_cts.reference_models.cpp import expected as claims
from ucm_cts.reference_models.cpp.expected import Class, Connected, Expected, ExpectedCpp, Named, Returned

try:
    from clang import cindex  # type: ignore[import-untyped, unused-ignore]
except ImportError:
    cindex = None

Listed = tuple[list[Difference], dict[str, int], dict[str, str]]
"""Differences, how often each requirement was looked at, and why others were not."""

RULE = "cpp_unexpected"
ELEMENTS = ("PortElementObject", "Abstract_PortElementObject")
LISTED = (claims.NotCorba, claims.NothingElse, claims.NoOperations, claims.NotInHeader)
"""The claims that libclang decides."""

_FOLDERS = re.compile(r"#include <\.\.\.> search starts here:\n(.*?)End of search list", re.DOTALL)


class NotThere(Exception):
    """What is to be looked at is not declared; another check tells."""


def listed(expected: ExpectedCpp, headers: Headers, compiler: Compiler) -> Listed:
    """What libclang has against the headers. Raises ``NoCompiler``."""
    wanted = [e for e in expected.expected if isinstance(e.claim, LISTED)]
    if not wanted:
        return [], {}, {}
    try:
        tree = _Tree(expected.standard, headers, compiler)
    except _Unusable as error:
        return [], {}, {e.requirement: str(error) for e in wanted}
    differences: list[Difference] = []
    counted: Counter[str] = Counter()
    unjudged: dict[str, str] = {}
    for one in wanted:
        try:
            differences += tree.look(one)
            counted[one.requirement] += 1
        except NotThere as error:
            unjudged.setdefault(one.requirement, str(error))
    return differences, dict(counted), unjudged


class _Unusable(Exception):
    """libclang says nothing that counts; the message says why."""


class _Tree:
    """The declarations in headers."""

    def __init__(self, standard: str, headers: Headers, compiler: Compiler) -> None:
        if cindex is None:
            raise _Unusable("libclang cannot be used: install the package libclang")
        self._folder = headers.folder
        text = "".join(f'#include "{name}"\n' for name in headers.names)
        options = [STANDARDS[standard], "-x", "c++", "-ferror-limit=0", "-w", *headers.options]
        options += [word for folder in _include_folders(standard, compiler) for word in ("-isystem", folder)]
        try:
            unit = cindex.Index.create().parse("listed.cpp", args=options, unsaved_files=[("listed.cpp", text)])
        except (cindex.LibclangError, cindex.TranslationUnitLoadError) as error:
            raise _Unusable(f"libclang cannot be used: {error}") from None
        wrong = next((d for d in unit.diagnostics if d.severity >= cindex.Diagnostic.Error), None)
        if wrong is not None:
            raise _Unusable(f"libclang does not understand the headers: {wrong.spelling[:200]}")
        self._unit = unit
        self._found: dict[str, list[Any]] = {}
        for cursor in unit.cursor.get_children():
            if self._is_ours(cursor):
                self._enter(cursor, "")

    def look(self, one: Expected) -> Iterator[Difference]:
        """What is wrong with what ``one`` claims. Raises ``NotThere``."""
        claim = one.claim
        match claim:
            case claims.NotCorba(owner):
                for base in self._bases(self._class(owner)):
                    if _path(base).startswith("::CORBA::"):
                        says = f"{class_words(owner)} derives from nothing of CORBA"
                        yield self._difference(one, says, f"it derives from {_path(base)}", base)
            case claims.NothingElse(owner, members):
                says = f"no pure virtual function of {class_words(owner)} that the model does not ask for"
                for method in self._pure(self._class(owner)):
                    if method.spelling not in members:
                        yield self._difference(one, says, f"{method.spelling} is pure virtual", method)
            case claims.NoOperations(owner):
                elements = [b for b in self._bases(self._class(owner)) if b.spelling in ELEMENTS]
                if not elements:
                    raise NotThere("no class PortElementObject is derived from")
                for method in _methods(elements[0]):
                    if method.is_virtual_method():
                        says = f"{elements[0].spelling} has no operations"
                        yield self._difference(one, says, f"it has {method.spelling}", method)
            case claims.NotInHeader(name):
                for variable in self._declared(name):
                    if variable.is_definition():
                        says = f"no header gives {name} its value"
                        yield self._difference(one, says, "a header defines it", variable)

    def _is_ours(self, cursor: Any) -> bool:
        file = cursor.location.file
        return file is not None and Path(file.name).resolve().is_relative_to(self._folder)

    def _enter(self, cursor: Any, path: str) -> None:
        kind = cursor.kind
        name = f"{path}::{cursor.spelling}"
        if kind == cindex.CursorKind.NAMESPACE:
            for child in cursor.get_children():
                self._enter(child, name)
        elif kind in _kinds() and (kind == cindex.CursorKind.VAR_DECL or cursor.is_definition()):
            self._found.setdefault(name, []).append(cursor)

    def _declared(self, name: str) -> list[Any]:
        if name not in self._found:
            raise NotThere(f"{name} is not declared")
        return self._found[name]

    def _class(self, owner: Class) -> Any:
        match owner:
            case Named(name):
                return self._declared(name)[0]
            case Returned(class_name, getter):
                for each in [self._declared(class_name)[0], *self._bases(self._declared(class_name)[0])]:
                    for method in _methods(each):
                        if method.spelling == getter:
                            return _argument(method.result_type)
                raise NotThere(f"{class_name} has no {getter}")
            case Connected(class_name, connection):
                inside = [c for c in self._declared(class_name)[0].get_children() if c.spelling == connection]
                place = class_name.rpartition("::")[0]
                around = [c for c in (*inside, *self._found.get(f"{place}::{connection}", ())) if _is_typedef(c)]
                if around:
                    return _argument(around[0].underlying_typedef_type)
                raise NotThere(f"no type {connection}")
        raise NotThere(str(owner))

    def _bases(self, cursor: Any) -> list[Any]:
        """All classes that the class derives from, nearest first."""
        found: dict[str, Any] = {}
        waiting = [cursor]
        while waiting:
            for child in waiting.pop(0).get_children():
                if child.kind == cindex.CursorKind.CXX_BASE_SPECIFIER:
                    base = child.type.get_canonical().get_declaration()
                    if _path(base) not in found:
                        found[_path(base)] = base
                        waiting.append(base)
        return list(found.values())

    def _pure(self, cursor: Any) -> Iterator[Any]:
        overridden: set[str] = set()
        for each in [cursor, *self._bases(cursor)]:
            if each.spelling in ELEMENTS:
                continue
            for method in _methods(each):
                if method.is_pure_virtual_method() and method.spelling not in overridden:
                    yield method
            overridden |= {m.spelling for m in _methods(each) if not m.is_pure_virtual_method()}

    def _difference(self, one: Expected, says: str, observed: str, cursor: Any) -> Difference:
        place = cursor.location
        file = Path(place.file.name).resolve() if place.file is not None else Path()
        ours = file.is_relative_to(self._folder)
        where = (str(file.relative_to(self._folder)), place.line) if ours else ("", 0)
        return Difference(one.requirement, RULE, one.element, one.line, says, observed, *where)


def _kinds() -> tuple[Any, ...]:
    kinds = cindex.CursorKind
    return (kinds.CLASS_DECL, kinds.STRUCT_DECL, kinds.TYPEDEF_DECL, kinds.TYPE_ALIAS_DECL, kinds.VAR_DECL)


def _is_typedef(cursor: Any) -> bool:
    return cursor.kind in (cindex.CursorKind.TYPEDEF_DECL, cindex.CursorKind.TYPE_ALIAS_DECL)


def _methods(cursor: Any) -> Iterator[Any]:
    return (c for c in cursor.get_children() if c.kind == cindex.CursorKind.CXX_METHOD)


def _argument(type_: Any) -> Any:
    """The class that an instance of a class template is made of."""
    canonical = type_.get_canonical()
    if canonical.get_num_template_arguments() < 1:
        raise NotThere(f"{canonical.spelling} is no instance of a class template")
    declared = canonical.get_template_argument_type(0).get_canonical().get_declaration()
    return declared.get_definition() or declared


def _path(cursor: Any) -> str:
    parts: list[str] = []
    while cursor is not None and cursor.kind != cindex.CursorKind.TRANSLATION_UNIT and cursor.spelling:
        parts.append(cursor.spelling)
        cursor = cursor.semantic_parent
    return "::" + "::".join(reversed(parts))


_SEARCHED: dict[tuple[tuple[str, ...], str], list[str]] = {}


def _include_folders(standard: str, compiler: Compiler) -> list[str]:
    """Where the compiler looks for headers by itself; libclang has no standard library of its own."""
    key = (compiler.command, standard)
    if key not in _SEARCHED:
        with tempfile.TemporaryDirectory(prefix="ucm-cts-cpp-") as folder:
            words = [*compiler.command, STANDARDS[standard], "-E", "-v", "-x", "c++", "/dev/null"]
            told = run(words, Path(folder), compiler).errors
        match = _FOLDERS.search(told)
        _SEARCHED[key] = [line.strip() for line in match[1].splitlines()] if match else []
    return _SEARCHED[key]
