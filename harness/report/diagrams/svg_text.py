"""How much room text takes in a drawing. Drawings use one monospaced face, so columns are enough to know."""

from __future__ import annotations

import unicodedata

CHARACTER = 7.25
"""Width of one column at the drawings' size of 12 pixels, in any of the usual monospaced faces."""


def columns(text: str) -> int:
    """The columns that ``text`` takes: two for a wide character, none for a combining one."""
    return sum(0 if unicodedata.combining(c) else 2 if unicodedata.east_asian_width(c) in "WF" else 1 for c in text)


def shortened(text: str, limit: int) -> str:
    """``text`` cut to ``limit`` columns, with an ellipsis if something is missing."""
    if columns(text) <= limit:
        return text
    while text and columns(text) >= limit:
        text = text[:-1]
    return text + "…"
