"""Which adapters can be served in virtual time, and what puts their hosts into it."""

from __future__ import annotations

import os
import stat
import struct
from pathlib import Path

from ucm_cts.harness.hosting.compiled_parts import COMPILED, HOW_TO_COMPILE

LIBRARY = COMPILED / "libucm_cts_virtual_time.so"
"""The library that is loaded before an executable, in place of the C library's clocks and waits."""

_LOADER = 3  # PT_INTERP: the program that loads the libraries
_LOADERS_OF_GLIBC = (b"/ld-linux", b"/ld64.so", b"/ld.so")
_NEEDS = "that needs a Python adapter, or an executable for this machine and glibc that loads shared libraries"


def why_not(kind: str, target: str, in_process: bool = False) -> str:
    """Why the adapter ``target`` of that ``kind`` cannot be served in virtual time, and what can; empty if it can."""
    if in_process or kind not in ("python", "executable") or (kind == "python" and os.sep in target):
        return f"{_NEEDS}, in a process of its own"
    if kind == "python":
        return ""
    if not LIBRARY.is_file():
        return f"this installation has no {LIBRARY.name}, which needs glibc: {HOW_TO_COMPILE}"
    if set(" :").intersection(str(LIBRARY)):
        return f"the path of {LIBRARY} has a blank or a colon, which the system's loader does not take; install ucm-cts elsewhere"
    return "" if _is_loaded_like(Path(target), LIBRARY) else _NEEDS


def _is_loaded_like(program: Path, library: Path) -> bool:
    """Does glibc's loader load ``program`` and its libraries, for the machine that ``library`` is for?"""
    try:
        if program.stat().st_mode & (stat.S_ISUID | stat.S_ISGID):  # loads only libraries of the system
            return False
        loader = _loader_of(program, library.read_bytes()[:20])
    except (OSError, struct.error):
        return False
    return any(part in loader for part in _LOADERS_OF_GLIBC)


def _loader_of(program: Path, like: bytes) -> bytes:
    """The loader that ``program`` names, if it is for the machine that the file is for that begins ``like`` this; else empty.

    Raises ``OSError``, and ``struct.error`` if the file is cut.
    """
    with program.open("rb") as file:
        head = file.read(64)
        if head[:4] != b"\x7fELF" or head[4:6] != like[4:6] or head[18:20] != like[18:20]:
            return b""
        order, is_wide = "<" if head[5] == 1 else ">", head[4] == 2
        (table,) = struct.unpack_from(order + ("Q" if is_wide else "I"), head, 32 if is_wide else 28)
        size, number = struct.unpack_from(order + "HH", head, 54 if is_wide else 42)
        for each in range(number):
            file.seek(table + size * each)
            entry = file.read(56 if is_wide else 32)
            if struct.unpack_from(order + "I", entry)[0] == _LOADER:
                place = struct.unpack_from(order + ("Q" if is_wide else "I"), entry, 8 if is_wide else 4)[0]
                file.seek(place)
                return file.read(256).partition(b"\0")[0]
    return b""
