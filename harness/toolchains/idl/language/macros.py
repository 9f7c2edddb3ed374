"""Macros of the preprocessor: what they are, and what stands in a text instead of their names.

Macros may be hostile: what they make of a text, and how deep they go, is bounded. The library pcpp (1.30, of 2021) has no such
bounds: it does not end for macros that double, and falls over those that name themselves in an argument.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

MOST_TOKENS = 1_000_000
"""Tokens that macros may make of the files of a model."""

DEEPEST_CALLS = 50
"""Levels to which calls of macros may stand in arguments of calls."""

LONGEST_CHAIN = 500
"""Macros each of which may be used in the one before."""

LONGEST_JOINED = 10_000
"""Characters that a token made by ## or # may have."""

TOKEN = re.compile(
    r'"(?:\\.|[^"\\\n])*"|\'(?:\\[^\n]|[^\'\\\n])+\'|[^\W\d]\w*|\.?\d(?:[eEpP][-+]|[\w.])*|\#\#|\n|[^\S\n]+|.',
    re.DOTALL,
)
NAME = re.compile(r"[^\W\d]\w*")
REST = "__VA_ARGS__"


class Refused(Exception):
    """Macros that cannot be replaced; the message says why."""


@dataclass(frozen=True)
class Macro:
    """A macro: with parameters if it is like a function."""

    body: tuple[str, ...]
    parameters: tuple[str, ...] | None = None


def defined(text: str) -> tuple[str, Macro]:
    """The name and the macro that ``text`` defines, which follows on #define. Raises ``Refused``."""
    head = re.match(r"\s*([^\W\d]\w*)(\(([^()]*)\))?", text)
    if head is None:
        raise Refused("a macro needs a name")
    parameters = None
    if head[2] is not None:
        parameters = tuple(one.strip() for one in head[3].split(",")) if head[3].strip() else ()
        parameters = tuple(REST if one == "..." else one for one in parameters)
        if not all(NAME.fullmatch(one) for one in parameters):
            raise Refused(f"the parameters of the macro '{head[1][:40]}' are not names")
    body = tuple(TOKEN.findall(re.sub(r"[^\S\n]*(##)[^\S\n]*", r"\1", text[head.end() :].strip())))
    return head[1], Macro(body, parameters)


Hidden = frozenset[str]
_Token = tuple[str, Hidden]


class Expander:
    """Replaces macros, and counts what that costs over all files."""

    def __init__(self) -> None:
        self._left = MOST_TOKENS

    def expanded(self, text: str, macros: Mapping[str, Macro]) -> str:
        """``text`` with all ``macros`` replaced; as many lines, each where it was. Raises ``Refused``."""
        if not any(name in macros for name in set(NAME.findall(text))):
            return text
        return "".join(self._tokens([(token, frozenset()) for token in TOKEN.findall(text)], macros, 0))

    def _tokens(self, tokens: Sequence[_Token], macros: Mapping[str, Macro], depth: int) -> Iterator[str]:
        if depth > DEEPEST_CALLS:
            raise Refused("calls of macros nest deeper than this suite reads; make it simpler")
        waiting = list(reversed(tokens))
        while waiting:
            name, hidden = waiting.pop()
            macro = macros.get(name)
            if macro is None or name in hidden:
                yield name
                continue
            arguments: list[list[_Token]] = []
            lines = 0
            if macro.parameters is not None:
                called = _called(waiting)
                if called is None:
                    yield name
                    continue
                arguments, lines = _arguments(name, waiting, called)
            within = hidden | {name}
            if len(within) > LONGEST_CHAIN:
                raise Refused("macros use one another deeper than this suite reads; make it simpler")
            body = self._body(name, macro, arguments, within, macros, depth)
            self._left -= len(body) + 1 + len(within) // 8
            if self._left < 0:
                raise Refused(f"macros make more than {MOST_TOKENS} tokens of the files; make it simpler")
            waiting += [("\n", within)] * lines
            waiting += [(" ", within), *reversed(body), (" ", within)]

    def _body(
        self,
        name: str,
        macro: Macro,
        arguments: list[list[_Token]],
        hidden: Hidden,
        macros: Mapping[str, Macro],
        depth: int,
    ) -> list[_Token]:
        """The tokens of a macro with its arguments instead of its parameters."""
        if macro.parameters is None:
            return _joined([(token, hidden) for token in macro.body])
        given = _by_parameter(name, macro.parameters, arguments)
        whole: dict[str, list[_Token]] = {}
        made: list[_Token] = []
        body = macro.body
        for at, token in enumerate(body):
            if token == "#" and at + 1 < len(body) and body[at + 1] in given:
                continue
            if token not in given:
                made.append((token, hidden))
            elif at and body[at - 1] == "#":
                text = "".join(one for one, _ in given[token]).strip()[:LONGEST_JOINED]
                made.append(('"' + re.sub(r'(["\\])', r"\\\1", text) + '"', hidden))
            elif "##" in (body[at - 1 : at] + body[at + 1 : at + 2]):
                made += [(one, kept | hidden) for one, kept in given[token]] or [("", hidden)]
            else:
                if token not in whole:
                    whole[token] = [(one, hidden) for one in self._tokens(given[token], macros, depth + 1)]
                made += whole[token]
            if len(made) > self._left:
                raise Refused(f"macros make more than {MOST_TOKENS} tokens of the files; make it simpler")
        return _joined(made)


def _called(waiting: list[_Token]) -> int | None:
    """Where in the reversed tokens the bracket is that begins the arguments, if that is what comes next."""
    at = len(waiting) - 1
    while at >= 0 and waiting[at][0].isspace():
        at -= 1
    return at if at >= 0 and waiting[at][0] == "(" else None


def _arguments(name: str, waiting: list[_Token], begin: int) -> tuple[list[list[_Token]], int]:
    """The arguments of a call, which are taken from ``waiting``, and the number of lines that they end."""
    lines = sum(token == "\n" for token, _ in waiting[begin:])
    del waiting[begin:]
    arguments: list[list[_Token]] = [[]]
    depth = 1
    while waiting:
        token, hidden = waiting.pop()
        depth += (token == "(") - (token == ")")
        lines += token == "\n"
        if depth == 0:
            return arguments, lines
        if token == "," and depth == 1:
            arguments.append([])
        else:
            arguments[-1].append((" " if token == "\n" else token, hidden))
    raise Refused(f"the arguments of the macro '{name[:40]}' do not end")


def _by_parameter(name: str, parameters: tuple[str, ...], arguments: list[list[_Token]]) -> dict[str, list[_Token]]:
    if parameters and parameters[-1] == REST:
        last = len(parameters) - 1
        rest = [one for argument in arguments[last:] for one in [*argument, (",", Hidden())]][:-1]
        arguments = [*arguments[:last], rest]
    if not parameters and not any(token.strip() for token, _ in arguments[0]):
        arguments = arguments[1:]
    if len(arguments) != len(parameters):
        raise Refused(f"the macro '{name[:40]}' has {len(parameters)} parameters, and {len(arguments)} arguments")
    return {parameter: _stripped(argument) for parameter, argument in zip(parameters, arguments, strict=True)}


def _stripped(tokens: list[_Token]) -> list[_Token]:
    begin, end = 0, len(tokens)
    while begin < end and tokens[begin][0].isspace():
        begin += 1
    while begin < end and tokens[end - 1][0].isspace():
        end -= 1
    return tokens[begin:end]


def _joined(tokens: list[_Token]) -> list[_Token]:
    """``tokens`` with one token instead of two with ## between them."""
    joined: list[_Token] = []
    for at, (token, hidden) in enumerate(tokens):
        if token == "##":
            continue
        if at > 1 and tokens[at - 1][0] == "##" and joined:
            token = joined.pop()[0] + token
            if len(token) > LONGEST_JOINED:
                raise Refused(f"## makes a token of more than {LONGEST_JOINED} characters")
        joined.append((token, hidden))
    return joined
