"""What stands behind the names that packages publish: theirs are imported in a sandbox, and never by the harness."""

from __future__ import annotations

import importlib
import json
import os
import select
import sys
import time
from contextlib import suppress
from dataclasses import dataclass
from functools import reduce
from pathlib import Path

from ucm_cts.harness.hosting.sandbox import start, why_none
from ucm_cts.harness.hosting.view import view_of

_SECONDS = 60.0
_LONGEST = 1 << 16
_OURS = __name__.partition(".")[0]


class NoMeaning(Exception):
    """Nothing can be said of a name; the text says why."""


@dataclass(frozen=True)
class Meaning:
    """``path``: the path that a name stands for; None if it stands for anything else. ``type``: the name of its type."""

    path: str | None
    type: str


def meaning_of(module: str, name: str, sandbox: bool = True) -> Meaning:
    """What ``name`` in ``module`` is. Raises ``NoMeaning``."""
    if module.partition(".")[0] == _OURS:
        try:
            found: object = reduce(getattr, name.split("."), importlib.import_module(module))
        except (ImportError, AttributeError) as error:
            raise NoMeaning(f"{type(error).__name__}: {error}") from error
        return Meaning(str(found) if isinstance(found, str | Path) else None, type(found).__name__)
    said = _asked(module, name, sandbox)
    if "fails" in said:
        raise NoMeaning(said["fails"])
    return Meaning(said.get("path"), said.get("type", "path"))


def _asked(module: str, name: str, sandbox: bool) -> dict[str, str]:
    view = view_of([]) if sandbox and not why_none() else None
    answer, theirs = os.pipe()
    try:
        words = [sys.executable, "-m", "ucm_cts.adapters.sdk.python.naming", module, name, str(theirs)]
        with open(os.devnull, "wb") as nothing:
            try:
                started = start(words, view, pass_fds=[theirs], out=nothing, error=nothing)
            finally:
                os.close(theirs)
        try:
            line = _line(answer)
        finally:
            started.end()
    except OSError as error:
        raise NoMeaning(f"it cannot be asked: {error}") from error
    finally:
        os.close(answer)
    with suppress(ValueError, RecursionError):
        said = json.loads(line)
        if isinstance(said, dict) and all(isinstance(text, str) for text in said.values()):
            if "fails" in said and view is not None and (hint := view.hint(said["fails"])):
                said["fails"] += f"; {hint}"
            return said
    raise NoMeaning("importing it ended the process" if not line else "it writes to a channel that it has not opened")


def _line(source: int) -> bytes:
    """The first line that comes from descriptor ``source``."""
    line = b""
    deadline = time.monotonic() + _SECONDS
    poll = select.poll()
    poll.register(source, select.POLLIN)
    while b"\n" not in line and len(line) < _LONGEST:
        if not poll.poll(max(deadline - time.monotonic(), 0) * 1000):
            raise NoMeaning(f"it was not imported within {_SECONDS:g} s")
        chunk = os.read(source, 4096)
        if not chunk:
            break
        line += chunk
    return line
