"""Reads UCM models: bytes of XML in any printed spelling become a ``Model``, and what does not fit becomes a problem.

Models come from others and may be hostile: size, depth and the number of problems are bounded, document types and so entities
are refused. Reading is fast because the parser hands over attributes under the names of fields already (``_RENAMED``), so
that an element in canonical spelling is built by one call; all others take the way through ``_mended``.
"""

from __future__ import annotations

import io
import os
from collections.abc import Callable, Iterator, Mapping
from typing import Any, BinaryIO, Literal
from xml.parsers import expat

import msgspec

from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.entries import OUTERMOST, Converter, Entry
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Model
from ucm_cts.adapters.contract.metamodel.spelling import (
    IGNORED,
    OTHER_WORDS,
    SPELLINGS,
    TAGS,
    TRUTHS,
    containers,
)

LARGEST = 512 * 1024 * 1024
"""Bytes that a model may have."""

DEEPEST = 256
"""Elements that may stand inside one another."""

LONGEST = 10_000_000
"""Bytes that one tag or comment may have, and all text where none belongs."""

MOST_TAGS = 10_000_000
MOST_PROBLEMS = 1000
"""The greatest number of reported problems of one file."""

ENCODINGS = ("utf-8", "utf-16", "us-ascii", "iso-8859-1")

Kind = Literal[
    "not XML",
    "refused",
    "unknown element",
    "misplaced element",
    "unknown attribute",
    "missing attribute",
    "bad literal",
    "bad number",
    "text",
]


class Problem(msgspec.Struct, frozen=True, kw_only=True):
    """Something wrong in a file.

    ``kind``: the kind of problem; "not XML" and "refused" end the reading.
    ``line``: where it stands, counted from 1.
    ``element``: the tag of the element, empty if there is none.
    ``message``: what is wrong, and the remedy.
    ``clause``: the clause that says otherwise, empty if there is none.
    """

    kind: Kind
    line: int
    element: str
    message: str
    clause: str = ""


class Reading(msgspec.Struct, frozen=True, kw_only=True):
    """The result of reading a file.

    ``name``: the file.
    ``model``: what could be read; empty after "not XML" and "refused".
    ``problems``: what could not be read, in the order of lines.
    """

    name: str
    model: Model
    problems: tuple[Problem, ...] = ()


Source = bytes | BinaryIO
"""A model as it is written: all its bytes, or an open file, of which never all is in memory. A file must be seekable."""


def whole(xml: Source) -> bytes:
    """All bytes of ``xml``."""
    if isinstance(xml, bytes):
        return xml
    xml.seek(0)
    return xml.read()


def read_model(xml: Source, name: str) -> Reading:
    """The model that ``xml`` holds. Raises nothing, but ``OSError`` if ``xml`` is a file that cannot be read."""
    stream = io.BytesIO(xml) if isinstance(xml, bytes) else xml
    reader = _Reader(stream)
    reader.read(texts=False)
    if reader.has_text:
        reader = _Reader(stream)
        reader.read(texts=True)
    problems = sorted(reader.problems, key=lambda problem: problem.line)
    return Reading(name=name, model=reader.model, problems=tuple(problems))


class _Stop(Exception):
    """Reading cannot go on."""

    def __init__(self, kind: Kind, message: str) -> None:
        super().__init__(message)
        self.kind: Kind = kind


_Frame = tuple[Entry, dict[str, Any], dict[str, list[Element]], dict[str, Entry]]

_HIDDEN = "\0"
_FIELDS = {field for cls in SPELLINGS for field in cls.__struct_fields__}
_RENAMED = {field: _HIDDEN + field for field in _FIELDS} | {
    attribute: field for spelling in SPELLINGS.values() for attribute, field in spelling.attributes.items()
}
"""Names of attributes as the parser is to hand them over: fields for those in canonical spelling. Others that are called like
a field are hidden, so that no model can set it.
"""
_PRINTED = {renamed: printed for printed, renamed in _RENAMED.items()}

_SPACE = " \t\r\n"

_BETWEEN = "}"
"""Stands between the namespace and the name of what is in one."""


_PIECE = 1 << 20
"""Bytes that are read at once."""


class _Words(dict[str, str]):
    """Texts that were met: equal ones become the same one, because a model has few texts and each of them often."""

    def __missing__(self, text: str) -> str:
        self[text] = text
        return text


class _Reader:
    """One pass over a model."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream
        self.problems: list[Problem] = []
        self.model = Model()
        self.has_text = False
        self._texts = 0
        self._namespace = ""
        self._inside = OUTERMOST
        self._children: dict[str, list[Element]] = {}
        self._stack: list[_Frame] = []
        self._skipped = 0
        self._reported: _Frame | None = None
        self._parser = expat.ParserCreate(namespace_separator=_BETWEEN, intern=dict(_RENAMED))
        self._parser.XmlDeclHandler = self._declaration
        self._parser.StartDoctypeDeclHandler = self._doctype

    def read(self, texts: bool) -> None:
        """Read all; with ``texts`` note where text stands, otherwise only whether there is any."""
        seen: set[str] = set()
        self._parser.buffer_text = not texts
        self._parser.CharacterDataHandler = self._text if texts else seen.add
        self._parser.StartElementHandler, self._parser.EndElementHandler = self._handlers()
        try:
            self._feed()
        except _Stop as stop:
            self._end_with(stop.kind, str(stop), self._parser.CurrentLineNumber)
        except expat.ExpatError as error:
            problem = expat.ErrorString(error.code) or "it is malformed"
            self._end_with("not XML", f"is not XML: {problem}; mend it there", error.lineno)
        except (LookupError, ValueError):  # of encodings that Python does not know, or cannot use here
            self._end_with("not XML", "is in an unknown encoding; save it as UTF-8", 1)
        else:
            self.has_text = any(text.strip(_SPACE) for text in seen)
            self.model = _model(self._children)
        finally:  # the parser and what it calls hold each other
            self._parser.StartElementHandler = self._parser.EndElementHandler = None
            self._parser.CharacterDataHandler = None

    def _feed(self) -> None:
        if self._stream.seek(0, os.SEEK_END) > LARGEST:
            raise _Stop("refused", f"is larger than {LARGEST} bytes; split it")
        if sum(piece.count(b"<") for _, piece in self._pieces()) > MOST_TAGS:
            raise _Stop("refused", f"has more than {MOST_TAGS} tags; split it")
        for begin, piece in self._pieces():
            self._parser.Parse(piece, False)
            if begin - self._parser.CurrentByteIndex > LONGEST:
                raise _Stop("refused", f"a tag or comment is longer than {LONGEST} bytes; shorten it")
        self._parser.Parse(b"", True)

    def _pieces(self) -> Iterator[tuple[int, bytes]]:
        """All bytes, in pieces, each with its place."""
        self._stream.seek(0)
        begin = 0
        while piece := self._stream.read(_PIECE):
            yield begin, piece
            begin += len(piece)

    def _end_with(self, kind: Kind, message: str, line: int) -> None:
        self.model = Model()
        self.problems.append(Problem(kind=kind, line=line, element="", message=message))

    def _problem(self, kind: Kind, element: str, message: str, clause: str = "", line: int = 0) -> None:
        if len(self.problems) == MOST_PROBLEMS:
            raise _Stop("refused", f"has more than {MOST_PROBLEMS} problems; mend those first")
        message = "".join(character if character.isprintable() else "\ufffd" for character in message)
        line = line or self._parser.CurrentLineNumber
        self.problems.append(Problem(kind=kind, line=line, element=element, message=message, clause=clause))

    # what the parser calls

    def _handlers(self) -> tuple[Callable[[str, dict[str, Any]], None], Callable[[str], None]]:
        """What is called at the beginning and the end of each element; closures, because they are called so often."""
        parser, stack, words = self._parser, self._stack, _Words()
        inside = OUTERMOST
        children: dict[str, list[Element]] | None = self._children

        def start(tag: str, values: dict[str, Any]) -> None:
            nonlocal inside, children
            entry = inside.get(tag)
            if entry is None:
                entry = self._entry(tag, inside)
                if entry is None:
                    self._skip(start, end)
                    return
            if children is None:
                children = {}
                if len(stack) == DEEPEST:
                    raise _Stop("refused", f"is nested deeper than {DEEPEST} elements; make it flatter")
            values["line"] = parser.CurrentLineNumber
            stack.append((entry, values, children, inside))
            inside = entry.inside
            children = None

        def end(_tag: str) -> None:
            nonlocal inside, children
            entry, values, around, inside = stack.pop()
            _, _, field, build, _, required, given, converters, texts, _ = entry
            try:
                if len(values) != given and not required <= values.keys():
                    raise KeyError
                for text in texts:
                    if text in values:
                        values[text] = words[values[text]]
                for converted, convert in converters:
                    if converted in values:
                        values[converted] = convert(values[converted])
                if children is not None:
                    for holding, held in children.items():
                        values[holding] = tuple(held)
                element = build(**values)
            except (TypeError, KeyError, ValueError):
                element = self._mended(entry, values, children)
            children = around
            beside = around.get(field)
            if beside is None:
                around[field] = [element]
            else:
                beside.append(element)

        return start, end

    def _skip(self, start: Callable[[str, dict[str, Any]], None], end: Callable[[str], None]) -> None:
        """Take no notice of the element that begins here, nor of all inside."""
        self._skipped = 1

        def deeper(_tag: str, _values: object) -> None:
            self._skipped += 1
            if self._skipped + len(self._stack) > DEEPEST:
                raise _Stop("refused", f"is nested deeper than {DEEPEST} elements; make it flatter")

        def back(_tag: str) -> None:
            self._skipped -= 1
            if not self._skipped:
                self._parser.StartElementHandler, self._parser.EndElementHandler = start, end

        self._parser.StartElementHandler, self._parser.EndElementHandler = deeper, back

    def _declaration(self, _version: str, encoding: str | None, _standalone: int) -> None:
        if encoding is not None and encoding.lower() not in ENCODINGS:
            raise _Stop("refused", f"is said to be '{encoding[:40]}'; save it as UTF-8")

    def _doctype(self, *_: object) -> None:
        raise _Stop("refused", "has a document type, which may hold entities; take the DOCTYPE out")

    def _text(self, text: str) -> None:
        self._texts += len(text.strip(_SPACE))
        if self._texts > LONGEST:
            raise _Stop("refused", f"has more than {LONGEST} characters of text, where none belongs; take it out")
        if self._skipped or not text.strip(_SPACE) or self._reported is self._stack[-1]:
            return
        self._reported = self._stack[-1]
        tag = self._reported[0].tag
        shown = " ".join(text.split())[:40]
        message = f"'{shown}' stands in {tag}, where no text belongs; take it out, or make it an XML comment"
        self._problem("text", tag, message)

    # what is not in canonical spelling

    def _entry(self, tag: str, inside: dict[str, Entry]) -> Entry | None:
        """What an element is whose tag may not stand here as it is, if it is anything; otherwise that is a problem."""
        namespace, between, local = tag.rpartition(_BETWEEN)
        if not self._stack and between:
            self._namespace = namespace
        if between and namespace == self._namespace and local in inside:
            return inside[local]
        shown = local[:80]
        if local not in TAGS or namespace != self._namespace:
            known = ", ".join(sorted({entry.spelling.tag for entry in inside.values()})) or "nothing"
            around = self._stack[-1][0].tag if self._stack else "a model"
            message = f"{shown} is not known; {around} may hold {known}"
            self._problem("unknown element", shown, message, self._stack[-1][0].spelling.clause if self._stack else "")
        else:
            spelling = SPELLINGS[TAGS[local]]
            places = ", ".join(containers(spelling.cls))
            message = f"{shown} cannot stand here" + (f", only in {places}" if places else "; it must be outermost")
            self._problem("misplaced element", shown, message, spelling.clause)
        return None

    def _mended(self, entry: Entry, values: dict[str, Any], children: Mapping[str, list[Element]] | None) -> Element:
        """The element that ``values`` make once other spellings are replaced and what does not fit is left out and reported."""
        fitting = {key: value for key, value in values.items() if key in entry.fields}
        fitting |= {field: tuple(held) for field, held in (children or {}).items()}
        fitting["line"] = line = values.pop("line")
        for key, value in values.items():
            if key not in entry.fields and _BETWEEN not in key:
                self._other(entry, _PRINTED.get(key, key), value, fitting)
        for field in sorted(entry.required - fitting.keys()):
            attribute = entry.spelling.attribute(field)
            message = f"{entry.tag}{_called(fitting)} has no {attribute}; give it one"
            self._problem("missing attribute", entry.tag, message, entry.spelling.clause, line)
        for field, convert in entry.converters:
            if isinstance(fitting.get(field), str):
                self._convert(entry, field, convert, fitting)
        return entry.build(**fitting)

    def _other(self, entry: Entry, attribute: str, value: str, fitting: dict[str, Any]) -> None:
        """Take an attribute in another spelling for the field that it means, or report that it means nothing."""
        spelling = entry.spelling
        field = spelling.other_attributes.get(attribute)
        if (spelling.cls, attribute) in IGNORED or (attribute == "identifier" and "name" in fitting):
            return
        if field in entry.fields:
            value = OTHER_WORDS.get((spelling.cls, attribute), {}).get(value, value)
            if fitting.setdefault(field, value) == value:
                return
        known = ", ".join(spelling.attribute(field) for field in sorted(entry.fields - spelling.contained.keys()))
        message = f"{entry.tag}{_called(fitting)} has an attribute {attribute[:80]}; it may have {known or 'none'}"
        self._problem("unknown attribute", entry.tag, message, spelling.clause, fitting["line"])

    def _convert(self, entry: Entry, field: str, convert: Converter, fitting: dict[str, Any]) -> None:
        """Replace the text of a field by what it means; leave the field out if it means nothing."""
        text = fitting.pop(field)
        try:
            fitting[field] = convert(text)
        except (KeyError, ValueError):
            shown = f"{entry.tag}{_called(fitting)}: {entry.spelling.attribute(field)} is '{text[:80]}'"
            words = entry.spelling.literals.get(field) or (TRUTHS if field in entry.spelling.truths else None)
            if words is None:
                message = f"{shown}, which is not a number of at most 20 digits"
                self._problem("bad number", entry.tag, message, entry.spelling.clause, fitting["line"])
            else:
                known = ", ".join(dict.fromkeys(str(word) for word in words if words[word] == word or word in TRUTHS))
                message = f"{shown}, but must be one of {known}"
                self._problem("bad literal", entry.tag, message, entry.spelling.clause, fitting["line"])


def _called(values: Mapping[str, Any]) -> str:
    return f" '{values['name'][:80]}'" if values.get("name") else ""


def _model(outermost: Mapping[str, list[Element]]) -> Model:
    """The model of a file with these outermost elements, of which XML allows one."""
    for model in outermost.get("model", ()):
        assert isinstance(model, Model)
        return model
    modules = tuple(module for module in outermost.get("modules", ()) if isinstance(module, MODULES))
    return Model(line=modules[0].line if modules else 0, modules=modules)
