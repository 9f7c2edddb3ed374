"""Files that a guide under docs/ shows or links to."""

from __future__ import annotations

import re
from pathlib import Path


def guide_files(page: Path) -> dict[str, str]:
    """By name: blocks marked ``<!-- file: NAME -->``, and files of a folder ``example`` that ``page`` links to."""
    text = page.read_text()
    linked = {name.rpartition("/")[2]: page.parent / name for name in re.findall(r"\]\((\S+/example/[^)]+)\)", text)}
    shown = re.findall(r"(?ms)^<!-- file: (\S+) -->\n```\w+\n(.*?)^```$", text)
    return {name: path.read_text() for name, path in linked.items()} | dict(shown)
