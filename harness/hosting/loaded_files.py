"""Which files processes have loaded as code: the libraries of a product, as the system tells, and not as the product says."""

from __future__ import annotations

import os
from collections.abc import Iterable

_EXECUTABLE = "x"


def loaded_by(pids: Iterable[int]) -> frozenset[str]:
    """The files that are mapped as code by the processes ``pids``; those that have ended have none."""
    return frozenset(path for pid in pids for path in _mapped(pid))


def _mapped(pid: int) -> frozenset[str]:
    try:
        with open(f"/proc/{pid}/maps", encoding="utf-8", errors="surrogateescape") as maps:
            rows = [line.rstrip("\n").split(maxsplit=5) for line in maps]
    except OSError:
        return frozenset()
    paths = {row[5] for row in rows if len(row) == 6 and _EXECUTABLE in row[1] and row[5].startswith("/")}
    return frozenset(path for path in paths if not path.endswith(" (deleted)") and os.path.isfile(path))
