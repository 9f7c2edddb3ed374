"""Keeps the result of each unit in a file under its content address: whole or not at all, and checked when it is read."""

from __future__ import annotations

import hashlib
import os
import re
import tempfile
from pathlib import Path

from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.write import write_whole

_NAME = re.compile(r"[0-9a-f]{64}")


class NotKept(Exception):
    """A result cannot be kept. The text says why, and what to do."""


class Store:
    """The results in one folder. One process at a time writes to it."""

    def __init__(self, folder: Path) -> None:
        """Make the ``folder``. Raises ``WrongUse``."""
        self.folder = folder
        try:
            folder.mkdir(parents=True, exist_ok=True)
            tempfile.TemporaryFile(dir=folder).close()
        except OSError as error:
            raise WrongUse(f"'{folder}' cannot be written: {error.strerror}; choose another --out") from None

    def get(self, address: str) -> bytes | None:
        """The result of the unit with this ``address``; None if there is none, or if its file is damaged."""
        try:
            content = self._path(address).read_bytes()
        except OSError:
            return None
        head, _, result = content.partition(b"\n")
        return result if head.decode("ascii", "replace") == _digest(result) else None

    def has(self, address: str) -> bool:
        """Is there a whole result?"""
        return self.get(address) is not None

    def put(self, address: str, result: bytes) -> None:
        """Keep ``result``. Raises ``NotKept`` if there is no room, or the file cannot be written."""
        path = self._path(address)
        try:
            path.parent.mkdir(exist_ok=True)
            write_whole(path, f"{_digest(result)}\n".encode() + result)
        except OSError as error:
            raise NotKept(
                f"a result cannot be kept in '{self.folder}': {error.strerror or error}; what was kept before is not lost: "
                "make room and give the same command again"
            ) from None

    def addresses(self) -> frozenset[str]:
        """The addresses of all files, damaged ones too."""
        names = (name for _, _, files in os.walk(self.folder) for name in files)
        return frozenset(name for name in names if _NAME.fullmatch(name))

    def _path(self, address: str) -> Path:
        return self.folder / address[:2] / address


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
