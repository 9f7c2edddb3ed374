"""Random names of probes for each compilation, so that headers under test cannot know them."""

from __future__ import annotations

import re
import secrets

TAG = r"(?:R-[0-9.]+-[0-9]+|body|support|running|prelude)#\w+"
"""A name that a piece of a translation unit goes by in messages of the compiler."""

_ISSUED = re.compile(rf'^(#line 1 "{TAG})"$', re.MULTILINE)
_OURS = re.compile(r"^(?!#include)(.*)$", re.MULTILINE)
_NAME = re.compile(r"\bucts(?![A-Za-z0-9])")


class Disguise:
    """Names of one compilation: ``ucts``, with which all names of ours begin, and the tags get a random word."""

    def __init__(self) -> None:
        self._word = secrets.token_hex(8)

    @property
    def name(self) -> str:
        """What stands for ``ucts``."""
        return f"ucts{self._word}"

    def put_on(self, text: str) -> str:
        """The translation unit ``text`` as it is compiled."""
        ours = _OURS.sub(lambda line: _NAME.sub(self.name, line[1]), text)
        return _ISSUED.sub(rf'\1@{self._word}"', ours)

    def taken_off(self, message: str) -> str:
        """What was ``message`` of it, in the names of ``text``; tags that were not issued are none any more."""
        own = re.sub(
            rf"({TAG})(@{self._word})?",
            lambda tag: tag[1] if tag[2] else tag[1].replace("#", " "),
            message,
            flags=re.ASCII,
        )
        return own.replace(self.name, "ucts")
