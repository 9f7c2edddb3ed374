"""Puts the names and payloads of the scripts back in the place of drawn ones, wherever a text holds them."""

from __future__ import annotations

import re
from collections.abc import Iterable

from ucm_cts.harness.execution.naming import NameIndex

_NUMBER = r"(?<!\d)-?\d{10,}(?!\d)"
"""What may be a payload: it is never a part of a longer number, such as a time."""

_WORD = r"[^\W\d]\w{4,}"
"""What may be a name, or hold one."""


class Revealing:
    """Knows what each drawn name and payload stands for, spelled as in JSON."""

    def __init__(self) -> None:
        self._plain: dict[str, str] = {}
        self._names = NameIndex()
        self._others: list[str] = []
        self._pattern: re.Pattern[str] | None = None
        self._seen: dict[str, str] = {}
        self._found: dict[str, str] = {}

    def __contains__(self, drawn: str) -> bool:
        return drawn in self._plain

    def add(self, drawn: str, plain: str) -> None:
        """From now on ``plain`` is written for ``drawn``, a name or a number."""
        self._plain[drawn] = plain
        self._seen.clear()
        if re.fullmatch(_WORD, drawn):
            self._names.add(drawn)
        elif drawn and not re.fullmatch(_NUMBER, drawn):
            self._others.append(drawn)
            self._pattern = None

    def reveal(self, text: str) -> str:
        """``text`` with all that is known put back; a name that begins with another one goes first."""
        if self._pattern is None:
            longest_first = sorted(self._others, key=len, reverse=True)
            self._pattern = re.compile("|".join((_NUMBER, *_by_first_letter(longest_first), _WORD)))
        return self._pattern.sub(self._revealed, text)

    def words_in(self, text: str) -> dict[str, str]:
        """What of ``text`` is put back, and with what."""
        self._found.clear()
        self._seen.clear()
        self.reveal(text)
        return {drawn: plain for drawn, plain in self._found.items() if drawn != plain}

    def _revealed(self, found: re.Match[str]) -> str:
        text = found[0]
        if text in self._plain:
            return self._put_back(text)
        plain = self._seen.get(text)
        if plain is None:
            plain = self._seen[text] = self._within(text)
        return plain

    def _put_back(self, drawn: str) -> str:
        plain = self._found[drawn] = self._plain[drawn]
        return plain

    def _within(self, text: str) -> str:
        """``text``, which is no name, with the names and payloads in it put back: frameworks make longer names of them."""
        parts, place, rest = [], 0, 0
        while place < len(text):
            name = self._names.at(text, place)
            if name is None:
                place += 1
                continue
            parts += [self._numbers_of(text[rest:place]), self._put_back(name)]
            place = rest = place + len(name)
        return "".join([*parts, self._numbers_of(text[rest:])])

    def _numbers_of(self, text: str) -> str:
        return re.sub(_NUMBER, self._number, text)

    def _number(self, found: re.Match[str]) -> str:
        unsigned = found[0].removeprefix("-")
        number = next((one for one in (found[0], unsigned) if one in self._plain), None)
        return found[0] if number is None else found[0].removesuffix(number) + self._put_back(number)


def _by_first_letter(names: Iterable[str]) -> Iterable[str]:
    """One pattern for all of ``names`` that begin alike, so that each place of a text is compared with a few of them only."""
    by_letter: dict[str, list[str]] = {}
    for name in names:
        by_letter.setdefault(name[0], []).append(re.escape(name[1:]))
    for letter, rests in by_letter.items():
        yield f"{re.escape(letter)}(?:{'|'.join(rests)})"
