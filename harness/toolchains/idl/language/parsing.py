"""Parses preprocessed IDL by ``grammar.lark``."""

from __future__ import annotations

import functools
from pathlib import Path

from lark import Lark
from lark.exceptions import UnexpectedCharacters, UnexpectedEOF, UnexpectedInput, UnexpectedToken
from lark.lexer import PatternRE, PatternStr, TerminalDef

from ucm_cts.harness.toolchains.idl.language.building import Builder
from ucm_cts.harness.toolchains.idl.language.problems import NotIdl, Problem, problem_at
from ucm_cts.reference_models.mapping.idl.declarations import Declaration, Expression


def parsed(text: str, file: str, start: str) -> tuple[Declaration, ...] | Expression:
    """What ``text`` declares (``start``: ``start``), or its value (``expression_alone``). Raises ``NotIdl``.

    ``text`` has neither directives nor comments, and its size and nesting are bounded (``reading``).
    """
    parser, builder = _parser()
    builder.begin(file)
    try:
        declared: tuple[Declaration, ...] | Expression = parser.parse(text, start=start)  # type: ignore[assignment]
    except UnexpectedInput as error:
        raise NotIdl(_problem_of(error, text, file)) from None
    if builder.reserved is not None:
        word = builder.reserved
        raise NotIdl(
            Problem(file, word.line or 0, word.column or 0, f"'{word}' is a keyword of IDL; write '_{word}' for a name")
        )
    return declared


def _problem_of(error: UnexpectedInput, text: str, file: str) -> Problem:
    if isinstance(error, UnexpectedToken) and error.token.type != "$END":
        met = f"'{error.token[:40]}'"
    elif isinstance(error, UnexpectedCharacters):
        met = repr(text[error.pos_in_stream] if error.pos_in_stream is not None else "")
    else:
        last = text.rstrip()
        return problem_at(text, len(last), file, "the text ends before its declarations do")
    assert not isinstance(error, UnexpectedEOF)
    return Problem(file, error.line, error.column, f"{met} is not expected here")


@functools.cache
def _parser() -> tuple[Lark, Builder]:
    builder = Builder()
    lark = Lark(
        (Path(__file__).parent / "grammar.lark").read_text(),
        parser="lalr",
        lexer="contextual",
        start=["start", "expression_alone"],
        transformer=builder,
        edit_terminals=_whole_words,
    )
    return lark, builder


def _whole_words(terminal: TerminalDef) -> None:
    """Keywords end where words end: ``longlong`` is a name."""
    if isinstance(terminal.pattern, PatternStr) and terminal.pattern.value.isalnum():
        terminal.pattern = PatternRE(rf"{terminal.pattern.value}\b")
        terminal.priority = 2
