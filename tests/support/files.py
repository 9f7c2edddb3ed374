"""Files of the tests: the folders, the files that a guide shows, and files that one worker makes for all."""

from __future__ import annotations

import fcntl
import os
import re
from collections.abc import Callable
from pathlib import Path

import pytest

SUPPORT = Path(__file__).parent
ROOT = SUPPORT.parents[1]


def guide_files(page: Path) -> dict[str, str]:
    """By name: blocks marked ``<!-- file: NAME -->``, and files of a folder ``example`` that ``page`` links to."""
    text = page.read_text()
    linked = {name.rpartition("/")[2]: page.parent / name for name in re.findall(r"\]\((\S+/example/[^)]+)\)", text)}
    shown = re.findall(r"(?ms)^<!-- file: (\S+) -->\n```\w+\n(.*?)^```$", text)
    return {name: path.read_text() for name, path in linked.items()} | dict(shown)


def shared_folder(factory: pytest.TempPathFactory) -> Path:
    """A folder that all workers of this run have in common."""
    own = factory.getbasetemp()
    return own.parent if "PYTEST_XDIST_WORKER" in os.environ else own


def once(path: Path, make: Callable[[], object]) -> Path:
    """``path``, which ``make`` makes if no worker has made it yet. Other workers wait; what fails is tried by the next."""
    path.parent.mkdir(exist_ok=True)
    done = path.with_name(f"{path.name}.done")
    with path.with_name(f"{path.name}.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not done.exists():
            make()
            done.touch()
    return path
