"""Which adapters can be served in virtual time, and what puts their hosts into it."""

from __future__ import annotations

import os
import struct
from pathlib import Path

from ucm_cts.harness.hosting.compiled_parts import COMPILED, HOW_TO_COMPILE

LIBRARY = COMPILED / "libucm_cts_virtual_time.so"
"""The library that is loaded before an executable, in place of the C library's clocks and waits."""

_LONGEST_HEADER = 4096
_LOADER = 3  # PT_INTERP: the program that loads the libraries
_TAKES = "that takes a Python adapter, or an executable for this machine that the system's loader loads"


def why_not(kind: str, target: str, in_process: bool = False) -> str:
    """Why the adapter ``target`` of that ``kind`` cannot be served in virtual time, and what can; empty if it can."""
    if in_process or kind not in ("python", "executable") or (kind == "python" and os.sep in target):
        return f"{_TAKES}, in a process of its own"
    if kind == "python":
        return ""
    if not LIBRARY.is_file():
        return f"this installation has no {LIBRARY.name}, which takes glibc: {HOW_TO_COMPILE}"
    return "" if _is_loaded_like(Path(target), LIBRARY) else _TAKES


def _is_loaded_like(program: Path, library: Path) -> bool:
    """Is ``program`` loaded by the system's loader, for the machine that ``library`` is for?"""
    head, other = _head(program), _head(library)
    if len(head) < 64 or head[:4] != b"\x7fELF" or head[4:6] != other[4:6] or head[18:20] != other[18:20]:
        return False
    order = "<" if head[5] == 1 else ">"
    is_wide = head[4] == 2
    (table,) = struct.unpack_from(order + ("Q" if is_wide else "I"), head, 32 if is_wide else 28)
    size, number = struct.unpack_from(order + "HH", head, 54 if is_wide else 42)
    places = [table + size * each for each in range(number)]
    return any(struct.unpack_from(order + "I", head, place)[0] == _LOADER for place in places if place + 4 <= len(head))


def _head(file: Path) -> bytes:
    try:
        with file.open("rb") as opened:
            return opened.read(_LONGEST_HEADER)
    except OSError:
        return b""
