"""Reads IDL: the text of files to declarations, each with its place, or to a problem that names file, line and column.

The text may be hostile: its size, its nesting and the length of its expressions are bounded, and parsing takes time in proportion.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from ucm_cts.harness.toolchains.idl.language.preprocessing import LARGEST, Preprocessed, preprocessed, without_comments
from ucm_cts.harness.toolchains.idl.language.problems import NotIdl, Problem, problem_at
from ucm_cts.reference_models.mapping.idl.declarations import Declaration, Expression

DEEPEST = 100
"""Levels to which brackets may nest."""

LONGEST_CHAIN = 1000
"""Operators that may stand in one file between two semicolons or braces."""


@dataclass(frozen=True)
class Files:
    """What several files declare, file by file; what is wrong with those that do not; files that are included and not there; and
    what the preprocessor left.
    """

    declarations: Mapping[str, tuple[Declaration, ...]]
    problems: tuple[Problem, ...]
    missing: tuple[str, ...]
    left: Preprocessed = field(default_factory=Preprocessed, repr=False, compare=False)


def read_files(files: Mapping[str, str]) -> Files:
    """What ``files`` (name to text) declare, which may include one another. Never raises."""
    left = preprocessed(files)
    declarations: dict[str, tuple[Declaration, ...]] = {}
    problems = []
    for name in files:
        try:
            if name in left.problems:
                raise NotIdl(left.problems[name])
            declarations[name] = _declared(left.texts[name], name)
        except NotIdl as error:
            problems.append(error.problem)
    return Files(declarations, tuple(problems), tuple(sorted(left.missing)), left)


def read_idl(text: str, file: str = "") -> tuple[Declaration, ...]:
    """The declarations in ``text``. Raises ``NotIdl``."""
    read = read_files({file: text})
    if read.problems:
        raise NotIdl(read.problems[0])
    return read.declarations[file]


@functools.lru_cache(maxsize=32)
def _declared(text: str, file: str) -> tuple[Declaration, ...]:
    """What a preprocessed text declares; vendors hand over one standard file with each model."""
    parsed = _parsed(text, file, "start")
    assert isinstance(parsed, tuple)
    return parsed


def read_expression(text: str) -> Expression:
    """The value of a constant as it may stand in a model. Raises ``NotIdl``."""
    expression = _parsed(without_comments(text), "", "expression_alone")
    assert not isinstance(expression, tuple)
    return expression


_QUOTED = r'"(?:\\.|[^"\\\n])*"'
_VALUE = re.compile(rf"(?:=|\[|\bcase\b)(?:{_QUOTED}|[^;{{}}\"])*|{_QUOTED}")
"""What may hold a shift: from where a value begins to the end of the declaration. Elsewhere >> closes two brackets."""


def _shifts_marked(text: str) -> str:
    """``text`` with another character, and a blank, for each shift to the right."""
    return re.sub(rf"{_QUOTED}|>>", lambda m: "\u226b " if m[0] == ">>" else m[0], text)


def _bounded(text: str, file: str) -> None:
    """Refuse what would cost more than a file of IDL is worth; ``text`` has no comments any more."""
    depth = chain = 0
    for match in re.finditer(
        r'"(?:\\.|[^"\\\n])*"|\'(?:\\[^\n]|[^\'\\\n])+\'|::|[(\[{]|[)\]}]|[;]|[-+*/%|&^~]|<<|>>', text
    ):
        token = match[0]
        if token in "([{":
            depth += 1
        elif token in ")]}":
            depth -= 1
        if token in "{};":
            chain = 0
        elif token not in "()[]::" and token[0] not in "\"'":
            chain += 1
        if depth > DEEPEST or chain > LONGEST_CHAIN:
            what = "nests deeper" if depth > DEEPEST else "is a longer expression"
            raise NotIdl(problem_at(text, match.start(), file, f"{what} than this suite reads; make it simpler"))
    nested = re.search(rf"(?:sequence\s*<\s*){{{DEEPEST}}}", text)
    if nested:
        raise NotIdl(problem_at(text, nested.start(), file, "nests deeper than this suite reads; make it simpler"))


def _parsed(text: str, file: str, start: str) -> tuple[Declaration, ...] | Expression:
    _bounded(text, file)
    if ">>" in text:
        text = _shifts_marked(text) if start != "start" else _VALUE.sub(lambda m: _shifts_marked(m[0]), text)
    from ucm_cts.harness.toolchains.idl.language.parsing import parsed  # its parser is part of the extra toolchain only

    return parsed(text, file, start)


__all__ = ["LARGEST", "Files", "NotIdl", "Problem", "read_expression", "read_files", "read_idl"]
