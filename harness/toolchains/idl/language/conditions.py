"""Evaluates conditions after #if: whole numbers and operators as in C++, and whether macros are defined."""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Mapping

from ucm_cts.harness.toolchains.idl.language.macros import Expander, Macro, Refused

LONGEST_CONDITION = 2000
"""Tokens that a condition may have when its macros are replaced."""

DEEPEST_CONDITION = 15
"""Levels to which brackets and signs may nest in a condition."""

_TOKEN = re.compile(
    r"\s*(0[xX][\da-fA-F]+|0[bB][01]+|\d+|[^\W\d]\w*|'(?:\\?[^\n])'|&&|\|\||<<|>>|[<>=!]=|[-+*/%<>!~&|^()?:])"
)

_LEVELS: tuple[dict[str, Callable[[int, int], int]], ...] = (
    {"||": lambda a, b: int(bool(a) or bool(b))},
    {"&&": lambda a, b: int(bool(a) and bool(b))},
    {"|": operator.or_},
    {"^": operator.xor},
    {"&": operator.and_},
    {"==": operator.eq, "!=": operator.ne},
    {"<": operator.lt, ">": operator.gt, "<=": operator.le, ">=": operator.ge},
    {"<<": lambda a, b: a << (b & 63), ">>": lambda a, b: a >> (b & 63)},
    {"+": operator.add, "-": operator.sub},
    {
        "*": operator.mul,
        "/": lambda a, b: abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1) if b else 0,
        "%": lambda a, b: abs(a) % abs(b) * (1 if a >= 0 else -1) if b else 0,
    },
)
"""Operators with two operands, from those that bind least. What is divided by nothing is 0: it may stand where it is not needed."""

_SIGNS: dict[str, Callable[[int], int]] = {
    "!": lambda a: int(not a),
    "~": operator.inv,
    "-": operator.neg,
    "+": operator.pos,
}


def holds(text: str, macros: Mapping[str, Macro], expander: Expander) -> bool:
    """Whether the condition ``text`` holds under ``macros``. Raises ``Refused``."""
    asked = re.sub(
        r"\bdefined\b\s*(?:\(\s*([^\W\d]\w*)\s*\)|([^\W\d]\w*))", lambda m: str(int((m[1] or m[2]) in macros)), text
    )
    return _Condition(expander.expanded(asked, macros)).value() != 0


class _Condition:
    def __init__(self, text: str) -> None:
        text = re.sub(r"\b(0[xX][\da-fA-F]+|0[bB][01]+|\d+)[uUlL]+\b", r"\1", text.strip())
        self._tokens: list[str] = []
        at = 0
        while at < len(text):
            found = _TOKEN.match(text, at)
            if found is None or len(self._tokens) >= LONGEST_CONDITION:
                raise Refused("this condition cannot be read; make it simpler")
            self._tokens.append(found[1])
            at = found.end()
        self._at = 0

    def value(self) -> int:
        value = self._choice(0)
        if self._at < len(self._tokens):
            raise Refused(f"'{self._tokens[self._at][:40]}' is not expected in this condition")
        return value

    def _next(self) -> str:
        return self._tokens[self._at] if self._at < len(self._tokens) else ""

    def _taken(self, *tokens: str) -> str:
        found = self._next()
        if found not in tokens:
            return ""
        self._at += 1
        return found

    def _choice(self, depth: int) -> int:
        if depth > DEEPEST_CONDITION:
            raise Refused("this condition nests deeper than this suite reads; make it simpler")
        value = self._level(0, depth)
        if not self._taken("?"):
            return value
        yes = self._choice(depth + 1)
        if not self._taken(":"):
            raise Refused("a ':' is missing in this condition")
        no = self._choice(depth + 1)
        return yes if value else no

    def _level(self, level: int, depth: int) -> int:
        if level == len(_LEVELS):
            return self._single(depth)
        value = self._level(level + 1, depth)
        while (sign := self._taken(*_LEVELS[level])) != "":
            value = _wrapped(_LEVELS[level][sign](value, self._level(level + 1, depth)))
        return value

    def _single(self, depth: int) -> int:
        signs = []
        while (sign := self._taken(*_SIGNS)) != "":
            signs.append(sign)
        if self._taken("("):
            value = self._choice(depth + 1)
            if not self._taken(")"):
                raise Refused("a ')' is missing in this condition")
        else:
            value = _number(self._next())
            self._at += 1
        for sign in reversed(signs):
            value = _wrapped(_SIGNS[sign](value))
        return value


def _wrapped(value: int) -> int:
    """``value`` in 64 bits."""
    return (int(value) + 2**63) % 2**64 - 2**63


def _number(token: str) -> int:
    if token.startswith("'"):
        return ord(token[-2])
    if token[:1].isdigit():
        if len(token) > 100:
            raise Refused("this number has too many digits")
        base = {"0x": 16, "0b": 2}.get(token[:2].lower(), 8 if token.startswith("0") else 10)
        try:
            return _wrapped(int(token, base))
        except ValueError:
            raise Refused(f"'{token[:40]}' is no number") from None
    if token and (token[0].isalpha() or token[0] == "_"):
        return int(token == "true")
    raise Refused(f"'{token}' is not expected in this condition" if token else "this condition ends too early")
