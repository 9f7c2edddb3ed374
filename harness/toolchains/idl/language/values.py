"""Evaluates expressions of IDL."""

from __future__ import annotations

import math
import operator
import re
from collections.abc import Callable
from typing import NamedTuple

from ucm_cts.harness.toolchains.idl.language.reading import NotIdl, read_expression
from ucm_cts.harness.toolchains.idl.language.scopes import MOST_STEPS, Scope, resolve
from ucm_cts.reference_models.mapping.idl import declarations as idl


class Chosen(NamedTuple):
    """An enumerator, by its name in lower case."""

    name: str


Number = int | float
Worth = int | float | str | bool | Chosen

WIDEST_SHIFT = 64


def worth(expression: idl.Expression, scope: Scope, steps: int = MOST_STEPS) -> Worth | None:
    """The value of ``expression`` in ``scope``; None if it has none."""
    try:
        return _worth(expression, scope, steps)
    except (ArithmeticError, ValueError, TypeError, RecursionError):
        return None


def _worth(expression: idl.Expression, scope: Scope, steps: int) -> Worth | None:
    match expression:
        case idl.Literal():
            return _literal(expression)
        case idl.Named():
            return _of_name(expression.name, scope, steps)
        case idl.Unary():
            operand = _number(_worth(expression.operand, scope, steps))
            return _UNARY[expression.operator](operand)
        case idl.Binary():
            left, right = (_worth(one, scope, steps) for one in (expression.left, expression.right))
            return _BINARY[expression.operator](_number(left), _number(right))
    return None


def _number(value: Worth | None) -> Number:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise TypeError
    return value


def _divided(left: Number, right: Number) -> Number:
    if isinstance(left, int) and isinstance(right, int):
        return abs(left) // abs(right) * (1 if (left < 0) == (right < 0) else -1)
    return left / right


def _shifted(left: Number, right: Number, shift: Callable[[int, int], int]) -> int:
    if not isinstance(left, int) or not isinstance(right, int) or not 0 <= right <= WIDEST_SHIFT:
        raise TypeError
    return shift(left, right)


_UNARY: dict[str, Callable[[Number], Number]] = {
    "-": operator.neg,
    "+": operator.pos,
    "~": lambda a: ~int(a),
}

_BINARY: dict[str, Callable[[Number, Number], Number]] = {
    "|": lambda a, b: int(a) | int(b),
    "^": lambda a, b: int(a) ^ int(b),
    "&": lambda a, b: int(a) & int(b),
    "<<": lambda a, b: _shifted(a, b, operator.lshift),
    ">>": lambda a, b: _shifted(a, b, operator.rshift),
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": _divided,
    "%": lambda a, b: int(math.fmod(a, b)),
}


def _literal(literal: idl.Literal) -> Worth:
    text = literal.text
    match literal.kind:
        case "integer":
            return whole(text)
        case "real" | "fixed":
            return float(text.rstrip("dDfF"))
        case "truth":
            return text == "TRUE"
    return _unescaped(text)


def whole(text: str) -> int:
    """The value of an integer literal: decimal, octal after a 0, or hexadecimal. Raises ``ValueError``."""
    if text.lower().startswith("0x"):
        return int(text, 16)
    return int(text, 8) if len(text) > 1 and text.startswith("0") else int(text)


_ESCAPE = re.compile(r"\\(?:x([0-9A-Fa-f]{1,2})|u([0-9A-Fa-f]{1,4})|([0-7]{1,3})|(.?))", re.DOTALL)

_ESCAPED = dict(zip("ntvbrfa\\?'\"", "\n\t\v\b\r\f\a\\?'\"", strict=True))
"""What IDL's escape sequences of one letter stand for."""


def _unescaped(text: str) -> str:
    """Raises ``ValueError`` for a sequence that IDL does not have."""

    def character(match: re.Match[str]) -> str:
        hexadecimal, universal, octal, letter = match.groups()
        if letter is None:
            return chr(int(octal, 8) if octal else int(hexadecimal or universal, 16))
        if letter not in _ESCAPED:
            raise ValueError(match[0])
        return _ESCAPED[letter]

    return _ESCAPE.sub(character, text)


def _of_name(name: str, scope: Scope, steps: int) -> Worth | None:
    hit = resolve(name, scope)
    if hit is None or not steps:
        return None
    if isinstance(hit.entry.declaration, idl.Enumerator):
        return Chosen(hit.entry.declaration.name.lower())
    if isinstance(hit.entry.declaration, idl.Constant):
        return worth(hit.entry.declaration.value, hit.entry.scope, steps - 1)
    return None


def model_worth(value: str, kind: str, scope: Scope) -> Worth | None:
    """What ``value`` of a model means for a type whose ``kind`` is text, character, truth, enumerator or number.

    Texts and characters may stand without quotes (interpretation idl-values); names are looked up in the vendor's ``scope``.
    """
    bare = value.strip()
    try:
        expression = read_expression(value)
    except NotIdl:
        expression = None
    if kind in ("text", "character"):
        quoted = isinstance(expression, idl.Literal) and expression.kind in ("text", "character")
        return worth(expression, scope) if quoted and expression is not None else value
    if kind == "truth" and bare.upper() in ("TRUE", "FALSE"):
        return bare.upper() == "TRUE"
    if isinstance(expression, idl.Named) and kind == "enumerator":
        return Chosen(expression.name.rsplit("::", 1)[-1].replace("-", "_").lower())
    return worth(expression, scope) if expression is not None else None


def equal(one: Worth | None, other: Worth | None) -> bool:
    """Whether two values are the same; real ones may differ by what writing them in fewer digits costs."""
    if isinstance(one, float) or isinstance(other, float):
        numbers = [value for value in (one, other) if isinstance(value, (int, float))]
        return len(numbers) == 2 and math.isclose(numbers[0], numbers[1], rel_tol=1e-6, abs_tol=1e-300)
    return type(one) is type(other) and one == other
