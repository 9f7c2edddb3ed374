"""Reads values in the syntax of IDL constants (9.2.2.6): literals, names, and expressions as in IDL 4, 7.4.1.4.3."""

from __future__ import annotations

import re
from typing import NamedTuple

TRUTHS = {"TRUE": True, "FALSE": False}


class NotAConstant(Exception):
    """The text is not what IDL writes for a constant."""


class Text(NamedTuple):
    """A character, or a string: ``content`` has one sign for each character."""

    content: str
    is_string: bool


class Name(NamedTuple):
    """An enumerator or a constant, by its name."""

    reference: str


Operand = bool | int | float | Text | Name


class Operation(NamedTuple):
    """``sign`` applied to two expressions, or to ``right`` alone if ``left`` is None."""

    sign: str
    left: Expression | None
    right: Expression


Expression = Operand | Operation

_TOKEN = re.compile(
    r"""\s*(?:
    (?P<float>[0-9]+\.[0-9]*(?:[eE][+-]?[0-9]+)?|\.[0-9]+(?:[eE][+-]?[0-9]+)?|[0-9]+[eE][+-]?[0-9]+)(?![\w.])
    |(?P<hexadecimal>0[xX][0-9a-fA-F]+)(?![\w.])
    |(?P<octal>0[0-7]*)(?![\w.])
    |(?P<decimal>[1-9][0-9]*)(?![\w.])
    |L?(?P<string>"(?:[^"\\]|\\.)*")
    |L?(?P<char>'(?:[^'\\]|\\(?:x[0-9a-fA-F]{1,2}|u[0-9a-fA-F]{1,4}|[0-7]{1,3}|.))')
    |(?P<name>(?:::)?[A-Za-z_]\w*(?:::[A-Za-z_]\w*)*)
    |(?P<sign><<|>>|[-+*/%|^&~()])
    )""",
    re.VERBOSE,
)
_ESCAPE = re.compile(r"\\(?:x[0-9a-fA-F]{1,2}|u[0-9a-fA-F]{1,4}|[0-7]{1,3}|.)")
_BASES = {"hexadecimal": 16, "octal": 8, "decimal": 10}
_BINDING = (("|",), ("^",), ("&",), ("<<", ">>"), ("+", "-"), ("*", "/", "%"))
"""Operators of two operands, those that bind least first."""

_DEEPEST = 100
"""Signs and parentheses that may stand inside one another."""

LONGEST = 1000
"""The greatest number of characters of a checked value, beside those of strings: these may have any length (10.2)."""


def parsed(text: str) -> Expression:
    """What ``text`` says. Raises ``NotAConstant``."""
    return _Parser(text).whole()


class _Parser:
    """Reads one value, from the left."""

    def __init__(self, text: str) -> None:
        self._tokens: list[tuple[str, str]] = []
        self._at = 0
        self._depth = 0
        position, others, text = 0, 0, text.rstrip()
        while position < len(text):
            match = _TOKEN.match(text, position)
            if match is None:
                raise NotAConstant(f"'{text[position : position + 20].strip()}' is nothing in IDL")
            others += match.end() - position if match.lastgroup != "string" else 0
            if others > LONGEST:
                raise NotAConstant(f"it is longer than {LONGEST} characters")
            self._tokens.append((match.lastgroup or "", match[match.lastgroup or 0]))
            position = match.end()

    def whole(self) -> Expression:
        """All of it."""
        found = self._binary(0) if len(self._tokens) > 1 else self._unary()
        if self._at < len(self._tokens):
            raise NotAConstant(f"'{self._tokens[self._at][1][:20]}' is too much")
        return found

    def _binary(self, level: int) -> Expression:
        if level == len(_BINDING):
            return self._unary()
        left = self._binary(level + 1)
        while self._next()[0] == "sign" and self._next()[1] in _BINDING[level]:
            sign = self._take()[1]
            left = Operation(sign, left, self._binary(level + 1))
        return left

    def _unary(self) -> Expression:
        kind, text = self._take()
        if kind == "sign" and text in "-+~(":
            self._depth += 1
            if self._depth > _DEEPEST:
                raise NotAConstant("it is nested too deep")
            found = self._inside() if text == "(" else Operation(text, None, self._unary())
            self._depth -= 1
            return found
        return self._operand(kind, text)

    def _inside(self) -> Expression:
        found = self._binary(0)
        if self._take() != ("sign", ")"):
            raise NotAConstant("a parenthesis is not closed")
        return found

    def _operand(self, kind: str, text: str) -> Expression:
        if kind in _BASES:
            return int(text, _BASES[kind])
        if kind == "float":
            return float(text)
        if kind == "char":
            return Text(_ESCAPE.sub(".", text[1:-1]), is_string=False)
        if kind == "string":
            content = text[1:-1]
            while self._next()[0] == "string":
                content += self._take()[1][1:-1]
            return Text(_ESCAPE.sub(".", content), is_string=True)
        if kind == "name":
            return TRUTHS.get(text, Name(text))
        raise NotAConstant(f"'{text}' cannot stand there" if text else "something is missing at the end")

    def _next(self) -> tuple[str, str]:
        return self._tokens[self._at] if self._at < len(self._tokens) else ("", "")

    def _take(self) -> tuple[str, str]:
        token = self._next()
        self._at += 1
        return token
