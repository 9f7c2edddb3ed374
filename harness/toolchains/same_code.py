"""Is the code in generated files the same, comments and layout apart? What is between semicolons and braces is compared, in any order."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from ucm_cts.harness.toolchains.idl.language.preprocessing import Line, logical_lines, without_comments
from ucm_cts.harness.toolchains.idl.language.problems import NotIdl

_TOKEN = re.compile(r"\"(?:\\.|[^\"\\])*\"|'(?:\\.|[^'\\])*'|\w+|::|\S")

_ENDS = ("{", "}", ";")

_PLACES = ("line", "#")
"""Directives that say where the text comes from."""


@dataclass(frozen=True)
class Piece:
    """A piece of code: its ``text`` with one blank between tokens, and where it begins; ``line`` is counted from 1."""

    text: str
    file: str
    line: int


@dataclass(frozen=True)
class Change:
    """The first piece of code that is only there afterwards, or, if there is none, that was only there before."""

    piece: Piece
    is_new: bool


def pieces(files: Mapping[str, str]) -> tuple[Piece, ...]:
    """The pieces of the code in ``files``, texts by name: IDL or C++. The names of files and of include guards are no part of them."""
    return tuple(piece for name, text in sorted(files.items()) for piece in _of_file(name, text))


def first_change(before: tuple[Piece, ...], after: tuple[Piece, ...]) -> Change | None:
    """How the code ``after`` differs from the code ``before``; None if it is the same."""
    for ours, others, is_new in ((after, before, True), (before, after, False)):
        left = Counter(piece.text for piece in others)
        for piece in ours:
            if not left[piece.text]:
                return Change(piece, is_new)
            left[piece.text] -= 1
    return None


def _of_file(name: str, text: str) -> Iterator[Piece]:
    try:
        plain = without_comments(text, name)
    except NotIdl as error:  # a comment without an end, or no text at all
        yield Piece(error.problem.text, name, error.problem.line)
        return
    tokens: list[str] = []
    begins = 0
    for line in logical_lines(plain):
        if line.directive:
            if line.directive not in _PLACES:
                yield Piece(_of_directive(line), name, line.number)
            continue
        for number, physical in enumerate(line.text.split("\n"), line.number):
            for token in _TOKEN.findall(physical):
                begins = begins if tokens else number
                tokens.append(token)
                if token in _ENDS:
                    yield Piece(" ".join(tokens), name, begins)
                    tokens = []
    if tokens:
        yield Piece(" ".join(tokens), name, begins)


def _of_directive(line: Line) -> str:
    """A directive with what it defines or asks; others by their kind only, as files and include guards have any names."""
    words = _TOKEN.findall(line.operand)
    is_code = line.directive in ("if", "elif") or (line.directive == "define" and len(words) > 1)
    return " ".join([f"#{line.directive}", *(words if is_code else ())])
