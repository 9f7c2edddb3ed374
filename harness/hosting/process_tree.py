"""The processes below one of ours: the memory that they hold, and those that it leaves behind."""

from __future__ import annotations

import os
import secrets
import signal
import time
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

import psutil

MARK = "UCM_CTS_RUN"
"""The variable in the environment by which all processes of a run are known."""

_ROUNDS = 50
"""How many times strays are searched for, because they may start others while they are ended."""

_MIB = 1 << 20


def below(root: int) -> frozenset[psutil.Process]:
    """The descendants of process ``root`` and the members of its process group, without itself."""
    found: list[psutil.Process] = []
    with suppress(psutil.Error):
        found += psutil.Process(root).children(recursive=True)
    for number in psutil.pids():
        if number != root and _is_in_group(number, root):
            with suppress(psutil.Error):
                found.append(psutil.Process(number))
    return frozenset(found)


def _is_in_group(number: int, group: int) -> bool:
    with suppress(OSError):
        return os.getpgid(number) == group
    return False


def resident(processes: Iterable[psutil.Process], limit: int) -> int:
    """MiB of memory that ``processes`` hold together.

    Pages that processes share are counted once for all of them, but only where the sum with each counted exceeds ``limit``:
    that takes the system longer.
    """
    living = tuple(processes)
    held = sum(_bytes(one, shared_once=False) for one in living) // _MIB
    if held > limit and len(living) > 1:
        held = sum(_bytes(one, shared_once=True) for one in living) // _MIB
    return held


def _bytes(process: psutil.Process, shared_once: bool) -> int:
    with suppress(psutil.Error, OSError):
        if shared_once:
            with suppress(psutil.AccessDenied, AttributeError):
                return int(process.memory_full_info().pss)
        return int(process.memory_info().rss)
    return 0  # it has ended


def is_child_of(pid: int, parent: int) -> bool:
    """Whether process ``pid`` is a child of ``parent``, or has ended."""
    try:
        return bool(psutil.Process(pid).ppid() == parent)
    except psutil.NoSuchProcess:
        return True
    except psutil.Error:
        return False


def is_stopped(pid: int) -> bool:
    """Whether process ``pid`` stands still because of a signal such as SIGSTOP."""
    with suppress(psutil.Error):
        return bool(psutil.Process(pid).status() == psutil.STATUS_STOPPED)
    return False


def new_mark() -> str:
    """A value of ``MARK`` that no other run has."""
    return secrets.token_hex(16)


def end_marked(first: int, mark: str) -> dict[int, str]:
    """End the processes with ``mark`` in their environment, all of which began after the one with the number ``first``.

    Returns the command line of each, shortened, by its number. A process that has changed its environment is not found.
    """
    wanted = f"{MARK}={mark}".encode()
    ended: dict[int, str] = {}
    for _ in range(_ROUNDS):
        strays = [number for number in _since(first) if wanted in _environment_of(number)]
        if not strays:
            break
        for number in strays:
            ended.setdefault(number, _command_line(number))
            with suppress(OSError):
                os.kill(number, signal.SIGKILL)
        time.sleep(0.001)
    return ended


def _command_line(number: int) -> str:
    with suppress(psutil.Error):
        process = psutil.Process(number)
        return " ".join(process.cmdline())[:80] or process.name()
    return "a process"


def _since(first: int) -> Iterator[int]:
    """The processes with numbers that have been given since ``first``; all of them if counting has begun anew."""
    last = int(Path("/proc/loadavg").read_text().split()[-1])
    for name in os.listdir("/proc"):
        if name.isdecimal() and (last < first or int(name) > first):
            yield int(name)


def _environment_of(number: int) -> list[bytes]:
    """The initial environment of a process; empty if it has ended or belongs to another user."""
    with suppress(OSError), open(f"/proc/{number}/environ", "rb") as stream:
        return stream.read().split(b"\0")
    return []
