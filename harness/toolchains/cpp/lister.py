"""Lists declarations with libclang, in a process of its own, because headers can make libclang take all time and memory.

It is given the name of a file with a ``Request`` and prints ``Answers``; ``listing`` runs it within limits.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal

import msgspec

from ucm_cts.adapters.contract.value import Value

try:
    from clang import cindex  # type: ignore[import-untyped, unused-ignore]
except ImportError:
    cindex = None

ELEMENTS = ("PortElementObject", "Abstract_PortElementObject")
FILE = "listed.cpp"
ASKED = "asked"
"""What the text calls that which a question is about, in a namespace of the question's own."""


class Question(Value, frozen=True):
    """``line`` of the text is where it stands, ``place`` the namespace that it has there; ``members`` are what may be there."""

    number: int
    line: int
    place: str
    kind: Literal[
        "not-corba",
        "nothing-else",
        "is-element",
        "no-operations",
        "not-in-header",
        "no-other-enumerators",
        "fixed-type",
    ]
    members: tuple[str, ...] = ()


class Request(Value, frozen=True):
    """A translation unit of headers in ``folder``, included in its first ``included`` lines, and questions.

    ``attempts`` are options, of which the first that libclang understands count.
    """

    text: str
    included: int
    folder: str
    attempts: tuple[tuple[str, ...], ...]
    questions: tuple[Question, ...]


class Found(Value, frozen=True):
    """Something that should not be there, and where that is; ``file`` is relative to the folder, or empty."""

    observed: str
    file: str = ""
    line: int = 0


class Answer(Value, frozen=True):
    """What was found; ``missing`` is why nothing can be said."""

    number: int
    missing: str = ""
    found: tuple[Found, ...] = ()


class Answers(Value, frozen=True):
    """One answer for each question, or none and the ``problem``."""

    answers: tuple[Answer, ...] = ()
    problem: str = ""


class NotThere(Exception):
    """The subject is not declared, which another check reports."""


def answers(request: Request) -> Answers:
    """What libclang has to say of ``request``."""
    if cindex is None:
        return Answers(problem="libclang cannot be used: pip install 'ucm-cts[toolchain]'")
    answers = Answers(problem="nothing was tried")
    for options in request.attempts:
        answers = _Tree(request, options).answers()
        if not answers.problem:
            break
    return answers


class _Tree:
    """The declarations in a translation unit."""

    def __init__(self, request: Request, options: tuple[str, ...]) -> None:
        self._request = request
        self._folder = Path(request.folder)
        self._options = options
        self._missing: dict[int, str] = {}
        self._descent: dict[int, list[Any]] = {}

    def answers(self) -> Answers:
        unsaved = [(FILE, self._request.text)]
        try:
            unit = cindex.Index.create().parse(FILE, args=list(self._options), unsaved_files=unsaved)
        except (cindex.LibclangError, cindex.TranslationUnitLoadError) as error:
            return Answers(problem=f"libclang cannot be used: {error}")
        for diagnostic in unit.diagnostics:
            if diagnostic.severity >= cindex.Diagnostic.Error and not self._is_of_questions(diagnostic):
                return Answers(problem=f"libclang does not understand the headers: {diagnostic.spelling[:200]}")
        places = {c.spelling: c for c in unit.cursor.get_children() if c.kind == cindex.CursorKind.NAMESPACE}
        self._descent = self._descended(unit)
        return Answers(tuple(self._answer(one, places.get(one.place)) for one in self._request.questions))

    def _is_of_questions(self, diagnostic: Any) -> bool:
        """Whether an error is in what follows the headers, or in what that makes of their templates; noted for its question."""
        asked = {question.line: question.number for question in self._request.questions}
        places = [diagnostic.location, *(note.location for note in diagnostic.children)]
        lines = [p.line for p in places if p.file is not None and p.file.name == FILE]
        for line in lines:
            if line in asked:
                self._missing.setdefault(asked[line], diagnostic.spelling[:200])
        return any(line > self._request.included for line in lines)

    def _descended(self, unit: Any) -> dict[int, list[Any]]:
        """For each question what its class derives from of CORBA, or as a port element: the compiler knows it of templates, too."""
        corba, elements = [], []
        for cursor in _declared(unit.cursor):
            if "::CORBA::" in _path(cursor) and cursor.kind in _classes() and cursor.is_definition():
                corba.append(cursor)
            elif cursor.spelling in ELEMENTS and (cursor.kind not in _classes() or cursor.is_definition()):
                elements.append(cursor)
        bases = {"not-corba": corba, "is-element": elements, "no-operations": elements}
        pairs = [(one, base) for one in self._request.questions for base in bases.get(one.kind, ())]
        if not pairs:
            return {}
        name = f"{pairs[0][0].place}_descends"
        lines = (f"{name}_{i} = __is_base_of({_path(b)}, ::{q.place}::{ASKED})," for i, (q, b) in enumerate(pairs))
        text = "\n".join([self._request.text, f"enum {name} {{", *lines, "};", ""])
        again = cindex.Index.create().parse(FILE, args=list(self._options), unsaved_files=[(FILE, text)])
        wrong = {d.location.line for d in again.diagnostics if d.severity >= cindex.Diagnostic.Error}
        enums = (c for c in again.cursor.get_children() if c.spelling == name)
        holds = {
            c.spelling
            for enum in enums
            for c in enum.get_children()
            if c.enum_value == 1 and c.location.line not in wrong
        }
        found: dict[int, list[Any]] = {}
        for number, (one, base) in enumerate(pairs):
            if f"{name}_{number}" in holds:
                found.setdefault(one.number, []).append(base)
        return found

    def _answer(self, one: Question, place: Any) -> Answer:
        missing = self._missing.get(one.number, "" if place is not None else "it was not read")
        if missing:
            return Answer(one.number, missing)
        try:
            return Answer(one.number, "", tuple(self._examine(one, place)))
        except NotThere as error:
            return Answer(one.number, str(error))

    def _examine(self, one: Question, place: Any) -> Iterator[Found]:
        """What is wrong. Raises ``NotThere``."""
        asked = next((c for c in place.get_children() if c.spelling == ASKED), None)
        if asked is None:
            raise NotThere("it was not read")
        if one.kind == "not-in-header":
            yield from self._defined(asked)
            return
        owner = asked.underlying_typedef_type.get_canonical().get_declaration()
        owner = owner.get_definition() or owner
        if owner.kind == cindex.CursorKind.NO_DECL_FOUND:
            raise NotThere("it is no class")
        if one.kind == "not-corba":
            for base in self._descent.get(one.number, ()):
                yield self._found(f"it derives from {_path(base)}", base)
        elif one.kind == "nothing-else":
            for method in _pure(owner):
                if method.spelling not in one.members:
                    yield self._found(f"{method.spelling} is pure virtual", method)
        elif one.kind == "no-other-enumerators":
            yield from self._others(owner, one.members)
        elif one.kind == "fixed-type":
            yield from self._untyped(owner)
        else:
            elements = self._descent.get(one.number, [])
            if one.kind == "is-element":
                if not elements:
                    yield self._found("it does not", owner)
                elif all(_is_hidden(owner, base) for base in elements):
                    yield self._found(f"it derives from {_path(elements[0])}, but not publicly", owner)
                return
            if not elements:
                raise NotThere("no class PortElementObject is derived from")
            element = elements[0].type.get_canonical().get_declaration()
            for method in (m for each in [element, *_bases(element)] for m in _methods(each)):
                if method.is_virtual_method():
                    yield self._found(f"{elements[0].spelling} has {method.spelling}", method)

    def _others(self, owner: Any, names: tuple[str, ...]) -> Iterator[Found]:
        """Enumerators with values that none of ``names`` has; other names of the same values add nothing."""
        if owner.kind != cindex.CursorKind.ENUM_DECL:
            raise NotThere("it is no enumeration")
        values = {c.enum_value for c in owner.get_children() if c.spelling in names}
        for other in owner.get_children():
            if other.kind == cindex.CursorKind.ENUM_CONSTANT_DECL and other.enum_value not in values:
                yield self._found(f"it has {other.spelling}", other)

    def _untyped(self, owner: Any) -> Iterator[Found]:
        """An enumeration whose declaration leaves the type of its values to the compiler; one that a macro writes is not judged."""
        if owner.kind != cindex.CursorKind.ENUM_DECL:
            raise NotThere("it is no enumeration")
        if owner.is_scoped_enum():
            return  # int, if it names none
        written = ["{" if token.spelling == "<%" else token.spelling for token in owner.get_tokens()]
        if written[:1] != ["enum"] or "{" not in written:
            raise NotThere("its declaration is written by a macro")
        if ":" not in written[: written.index("{")]:
            yield self._found("it names none", owner)

    def _defined(self, asked: Any) -> Iterator[Found]:
        uses = (c.referenced for c in asked.walk_preorder() if c.kind == cindex.CursorKind.DECL_REF_EXPR)
        variable = next((v for v in uses if v is not None and v.kind == cindex.CursorKind.VAR_DECL), None)
        if variable is None:
            raise NotThere("it is no variable")
        definition = variable.get_definition()
        if definition is not None:
            yield self._found("a header defines it", definition)

    def _found(self, observed: str, cursor: Any) -> Found:
        place = cursor.location
        file = Path(place.file.name).resolve() if place.file is not None else Path()
        if not file.is_relative_to(self._folder):
            return Found(observed)
        return Found(observed, str(file.relative_to(self._folder)), place.line)


def _declared(cursor: Any) -> Iterator[Any]:
    """All types that are declared in namespaces, and in classes of namespaces CORBA."""
    for child in cursor.get_children():
        if child.kind in (cindex.CursorKind.NAMESPACE, cindex.CursorKind.LINKAGE_SPEC):
            yield from _declared(child)
        elif child.kind in (*_classes(), cindex.CursorKind.TYPEDEF_DECL, cindex.CursorKind.TYPE_ALIAS_DECL):
            yield child


def _classes() -> tuple[Any, ...]:
    return (cindex.CursorKind.CLASS_DECL, cindex.CursorKind.STRUCT_DECL)


def _bases(cursor: Any) -> list[Any]:
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


def _is_hidden(cursor: Any, base: Any) -> bool:
    """Whether every way from the class to its ``base`` that the headers show leads through a base that is not public.

    Ways through instances of templates are not seen; where there is no other one it is not hidden.
    """
    wanted = _path(base.type.get_canonical().get_declaration())
    waiting, met, reached = [(cursor, True)], set[tuple[str, bool]](), False
    while waiting:
        current, public = waiting.pop(0)
        for child in current.get_children():
            if child.kind != cindex.CursorKind.CXX_BASE_SPECIFIER:
                continue
            above = child.type.get_canonical().get_declaration()
            open_way = public and child.access_specifier == cindex.AccessSpecifier.PUBLIC
            if _path(above) == wanted:
                if open_way:
                    return False
                reached = True
            if (_path(above), open_way) not in met:
                met.add((_path(above), open_way))
                waiting.append((above, open_way))
    return reached


def _pure(cursor: Any) -> Iterator[Any]:
    overridden: set[str] = set()
    for each in [cursor, *_bases(cursor)]:
        if each.spelling in ELEMENTS:
            continue
        for method in _methods(each):
            if method.is_pure_virtual_method() and method.spelling not in overridden:
                yield method
        overridden |= {m.spelling for m in _methods(each) if not m.is_pure_virtual_method()}


def _methods(cursor: Any) -> Iterator[Any]:
    return (c for c in cursor.get_children() if c.kind == cindex.CursorKind.CXX_METHOD)


def _path(cursor: Any) -> str:
    parts: list[str] = []
    while cursor is not None and cursor.kind != cindex.CursorKind.TRANSLATION_UNIT and cursor.spelling:
        parts.append(cursor.spelling)
        cursor = cursor.semantic_parent
    return "::" + "::".join(reversed(parts))


def main(name: str) -> None:
    """Answer the request in the file ``name``."""
    request = msgspec.json.decode(Path(name).read_bytes(), type=Request)
    sys.stdout.buffer.write(msgspec.json.encode(answers(request)))


if __name__ == "__main__":
    main(sys.argv[1])
