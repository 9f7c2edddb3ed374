"""A vendor's regular expression for diagnostics, in time that grows with the text only: RE2 does not go back and try again."""

from __future__ import annotations

import functools
from collections.abc import Iterator
from typing import Any


class WrongExpression(ValueError):
    """It is no regular expression; the text says why."""


@functools.cache
def compiled(expression: str) -> Any:
    """``expression``, with ``^`` and ``$`` at the ends of lines. Raises ``WrongExpression``."""
    import re2  # part of the extra toolchain only

    options = re2.Options()
    options.log_errors = False
    try:
        return re2.compile(f"(?m){expression}", options)
    except (re2.error, ValueError) as error:
        reason = error.args[0].decode(errors="replace") if error.args and isinstance(error.args[0], bytes) else error
        raise WrongExpression(
            f"the diagnostic is no regular expression of RE2, which has no look-around and no back-references: {reason}"
        ) from None


def matches(expression: str, text: str) -> Iterator[Any]:
    """What ``expression`` matches in ``text``."""
    yield from compiled(expression).finditer(text)
