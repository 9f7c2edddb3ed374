"""The width of text in a drawing. Drawings use one monospaced face, so the width follows from the columns."""

from __future__ import annotations

from rich.cells import cell_len
from rich.text import Text

CHARACTER = 7.25
"""Width of one column at the drawings' size of 12 pixels, in any of the usual monospaced faces."""


def width_of(text: str) -> int:
    """The pixels that ``text`` takes."""
    return round(cell_len(text) * CHARACTER)


def shortened(text: str, limit: int) -> str:
    """``text`` cut to ``limit`` columns, with an ellipsis if something is missing."""
    shown = Text(text)
    shown.truncate(limit, overflow="ellipsis")
    return shown.plain
