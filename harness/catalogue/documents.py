"""Read YAML (and so JSON) and TOML documents into typed values, with errors that name file, line and remedy.

Documents may be hostile: size is bounded, anchors, aliases, tags, several documents and duplicate keys are refused.
"""

from __future__ import annotations

import os
import re
import stat
import tomllib
from pathlib import Path
from typing import Any, TypeVar

import msgspec
import yaml

T = TypeVar("T")

LARGEST = 4 * 1024 * 1024
"""Bytes a document may have."""

DEEPEST = 50
"""Levels a document may nest."""
_TOO_DEEP = f"nests deeper than {DEEPEST} levels"

MOST_DOTS = 100
"""Dots a line of a TOML document may have."""


LONGEST_PROBLEM = 600
"""How many characters of a wrong value a message shows."""


class DocumentError(Exception):
    """A document cannot be used; the text names file, line and what to do."""

    def __init__(self, path: Path, line: int | None, problem: str) -> None:
        super().__init__(f"{path}:{line}: {_shown(problem)}" if line else f"{path}: {_shown(problem)}")


def _shown(problem: str) -> str:
    """``problem`` as one printable line."""
    line = " ".join(problem.split())
    line = line if len(line) <= LONGEST_PROBLEM else f"{line[:LONGEST_PROBLEM]}..."
    return "".join(character if character.isprintable() else "\ufffd" for character in line)


_Loader: type[Any] = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def read(path: Path, type_: type[T]) -> T:
    """The document at ``path`` as a ``type_``; raises ``DocumentError`` with the line of the first misfit."""
    value, lines = read_lines(path)
    return convert(path, value, type_, lines)


def convert(path: Path, value: object, type_: type[T], lines: dict[str, int]) -> T:
    """``value`` as a ``type_``; ``lines`` maps msgspec's paths (``$.steps[2].op``) to lines of ``path``."""
    try:
        return msgspec.convert(value, type_)
    except msgspec.ValidationError as error:
        problem, _, where = str(error).partition(" - at ")
        place = where.strip("`").replace("key in ", "")
        field = re.search(r"unknown field `(.*)`", problem)
        line = lines.get(f"{place or '$'}.{field.group(1)}") if field else None
        while line is None and place:
            line = lines.get(place)
            place = place[: max(place.rfind("."), place.rfind("["), 0)]
        at = f" (at {where.strip('`')})" if where else ""
        raise DocumentError(path, line or lines.get("$"), problem + at) from None


def read_text(path: Path, largest: int = LARGEST) -> str:
    """The text of the file at ``path``. Raises ``DocumentError`` if it cannot be read, is too large or not UTF-8."""
    try:
        with open(path, "rb", opener=without_waiting) as stream:
            if not stat.S_ISREG(os.fstat(stream.fileno()).st_mode):
                raise DocumentError(path, None, "is no plain file; write what it holds to a file, and give its name")
            raw = stream.read(largest + 1)
    except (OSError, ValueError) as error:
        raise DocumentError(path, None, f"cannot be read: {getattr(error, 'strerror', None) or error}") from None
    if len(raw) > largest:
        raise DocumentError(path, None, f"is larger than {largest} bytes; split it, or leave out what is not needed")
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError as error:
        raise DocumentError(path, raw[: error.start].count(b"\n") + 1, "is not UTF-8; save it as UTF-8") from None


def without_waiting(path: str, flags: int) -> int:
    """An opener for ``open`` that does not wait for the other end of a pipe."""
    return os.open(path, flags | os.O_NONBLOCK | os.O_CLOEXEC, 0o666)


def read_lines(path: Path) -> tuple[object, dict[str, int]]:
    """The document at ``path`` as plain values, and the line of each place in it (``$.steps[2].op``)."""
    text = read_text(path)
    lines: dict[str, int] = {}
    try:
        return _Building(path, text, lines).document(), lines
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        # newer readers of YAML have a limit of their own, and reach it by reading ahead
        deep = "nesting depth" in (error.problem or "")
        problem = _TOO_DEEP if deep else f"not YAML: {error.problem}"
        raise DocumentError(path, mark.line + 1 if mark else None, problem) from None
    except yaml.YAMLError as error:
        raise DocumentError(path, None, f"not YAML: {' '.join(str(error).split())}") from None


def read_toml(path: Path, largest: int = LARGEST) -> tuple[dict[str, Any], dict[str, int]]:
    """The TOML document at ``path``, and the line of each table and key (``readings``, ``readings.run-trigger``).

    Raises ``DocumentError``.
    """
    text = read_text(path, largest).removeprefix("\ufeff")
    for number, line in enumerate(text.split("\n"), 1):
        if line.count(".") > MOST_DOTS:  # each may be one more level
            raise DocumentError(path, number, "nests too deep")
    try:
        return tomllib.loads(text), _toml_lines(text)
    except tomllib.TOMLDecodeError as error:
        problem, _, place = str(error).partition(" (at ")
        named = re.match(r"line (\d+)", place)
        last = text.rstrip("\n").count("\n") + 1
        raise DocumentError(path, int(named[1]) if named else last, f"not TOML: {problem}; mend it there") from None
    except RecursionError:
        raise DocumentError(path, None, "nests too deep") from None
    except ValueError:
        raise DocumentError(path, None, "a number this long is not allowed") from None


_TABLE = re.compile(r"[ \t]*\[[ \t]*([^\[\]#\n]+?)[ \t]*\]")
_KEY = re.compile(r"[ \t]*(?:\"([^\"\\\n]*)\"|'([^'\n]*)'|([A-Za-z0-9_-]+))[ \t]*=")


def _toml_lines(text: str) -> dict[str, int]:
    """The line of each table and key that begins a line."""
    lines: dict[str, int] = {}
    table = ""
    for number, line in enumerate(text.split("\n"), 1):
        if opened := _TABLE.match(line):
            table = f"{opened[1]}."
            lines.setdefault(opened[1], number)
        elif given := _KEY.match(line):
            lines.setdefault(table + next(key for key in given.groups() if key is not None), number)
    return lines


def _line(event: Any) -> int:
    return int(event.start_mark.line) + 1


class _Building:
    """Builds plain values from the events of a document. Its text is parsed once, and nothing is made between events and values.

    All events are read first: building recurses, so it must be known before how deep the document nests.
    """

    def __init__(self, path: Path, text: str, lines: dict[str, int]) -> None:
        self._path = path
        self._lines = lines
        self._loader = _Loader(text)
        try:
            self._events = iter(self._read())
        finally:
            self._loader.dispose()

    def document(self) -> object:
        """The value of the document."""
        first = next(self._events, None)
        if first is None:
            raise DocumentError(self._path, 1, "is empty")
        return self._value(first, "$")

    def _read(self) -> list[Any]:
        """The events of scalars and collections."""
        events: list[Any] = []
        documents: list[Any] = []
        depth = 0
        while (event := self._loader.get_event()) is not None:
            kind = type(event)
            if kind is yaml.AliasEvent or getattr(event, "anchor", None):
                raise self._error(event, "anchors and aliases are not allowed; write it out")
            if kind is yaml.ScalarEvent:
                events.append(event)
            elif kind is yaml.MappingStartEvent or kind is yaml.SequenceStartEvent:
                events.append(event)
                depth += 1
                if depth > DEEPEST:
                    raise self._error(event, _TOO_DEEP)
            elif kind is yaml.MappingEndEvent or kind is yaml.SequenceEndEvent:
                events.append(event)
                depth -= 1
            elif kind is yaml.DocumentStartEvent:
                documents.append(event)
        if len(documents) > 1:
            raise self._error(documents[1], "not YAML: but found another document")
        return events

    def _error(self, event: Any, problem: str) -> DocumentError:
        return DocumentError(self._path, _line(event), problem)

    def _value(self, event: Any, place: str) -> object:
        """The value that begins with ``event``."""
        kind = type(event)
        self._lines[place] = line = _line(event)
        if kind is yaml.ScalarEvent:
            return self._scalar(event)
        if kind is yaml.SequenceStartEvent:
            items: list[object] = []
            while type(event := next(self._events)) is not yaml.SequenceEndEvent:
                items.append(self._value(event, f"{place}[{len(items)}]"))
            return items
        mapping: dict[str, object] = {}
        while type(event := next(self._events)) is not yaml.MappingEndEvent:
            if type(event) is not yaml.ScalarEvent:
                raise self._error(event, "a key must be a plain word")
            key = event.value
            if key in mapping:
                raise self._error(event, f"'{key}' is given twice; keep one")
            mapping[key] = self._value(next(self._events), f"{place}.{key}")
            self._lines[f"{place}.{key}"] = _line(event)
            self._lines.setdefault(f"{place}[...]", line)
        return mapping

    def _scalar(self, event: Any) -> object:
        text, tag = event.value, event.tag
        if tag is None or tag == "!":
            tag = self._loader.resolve(yaml.ScalarNode, text, event.implicit)
        if tag == "tag:yaml.org,2002:str":
            return text
        if tag == "tag:yaml.org,2002:int" and re.fullmatch(r"[-+]?[0-9]+", text):
            if len(text) > 20:
                raise self._error(event, "a number this long is not allowed")
            return int(text)
        if tag == "tag:yaml.org,2002:bool" and text in ("true", "false"):
            return text == "true"
        if tag == "tag:yaml.org,2002:null":
            return None
        if tag.removeprefix("tag:yaml.org,2002:") in ("int", "float", "bool", "timestamp", "value", "merge"):
            return text
        raise self._error(event, f"tag '{tag}' is not allowed; write plain text")
