"""Starts programs of somebody else: in a sandbox of bubblewrap where one is to be had, else in a process group of their own.

In a sandbox they have process numbers, mounts, users and shared memory of their own: they see neither the harness nor what belongs to
it, can write only to a scratch folder, and are dead when the sandbox is ended. The network is that of the machine.
"""

from __future__ import annotations

import json
import os
import re
import resource
import select
import shutil
import signal
import subprocess
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cache, cached_property
from pathlib import Path
from typing import IO, Protocol

import psutil

from ucm_cts.harness.hosting.process_tree import MARK, below, end_marked, is_child_of, new_mark
from ucm_cts.harness.hosting.view import View, clean_environment

PROGRAM = "bwrap"

GIVEN_UP = "--no-sandbox was given"
"""Why there is no sandbox although there could be one."""

_NAMESPACES = (
    *("--unshare-user", "--unshare-pid", "--unshare-ipc", "--unshare-uts", "--unshare-cgroup-try"),
    *("--die-with-parent", "--new-session", "--cap-drop", "ALL"),
)
_SHARED_MEMORY = 256 << 20
_OF_THE_SYSTEM = ("sys", "sysrq-trigger", "irq", "bus", "acpi", "scsi", "fs", "driver", "mtrr", "dynamic_debug")
"""What ``/proc`` has of the whole machine. A user of a sandbox who is root outside could write to it, and ``sys`` names programs that
the system runs as root: bubblewrap protects the others only.
"""

_DEVICES = (
    *("--dev", "/dev", "--size", str(_SHARED_MEMORY), "--tmpfs", "/dev/shm"),
    *("--remount-ro", "/dev", "--proc", "/proc"),
    *(word for name in _OF_THE_SYSTEM for word in ("--ro-bind-try", f"/proc/{name}", f"/proc/{name}")),
)
MOST_TASKS = 4096
"""How many processes and threads a sandbox may have, where the system counts those of a sandbox by themselves. Root is not bound."""

_COUNTS_BY_NAMESPACE = (5, 14)
"""The version of Linux since which it does."""

_BEGIN_SECONDS = 20.0
_DEAD_SECONDS = 5.0
_SIGNALLED = 128
"""A shell, and bubblewrap, give this and the number of the signal as the exit status of what a signal has killed."""

_NO_SHARED_VIEW = ("--ro-bind", "/", "/")


class NotStarted(OSError):
    """The program could not be started; the text says why."""


@cache
def why_none() -> str:
    """Why there are no sandboxes on this machine; empty if there are. Asked once in the life of a process."""
    if shutil.which(PROGRAM) is None:
        return "bubblewrap is not installed: apt-get install bubblewrap"
    command = [PROGRAM, *_NAMESPACES, *_NO_SHARED_VIEW, *_DEVICES, "true"]
    try:
        done = subprocess.run(
            command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=_BEGIN_SECONDS, check=False
        )
    except (OSError, subprocess.SubprocessError) as error:
        return f"bubblewrap cannot be run: {error}"
    if done.returncode == 0:
        return ""
    said = (done.stderr.strip() or f"exit status {done.returncode}").splitlines()[-1].removeprefix("bwrap: ")
    return f"this machine permits no namespaces ({said[:200]})"


class Started(Protocol):
    """A program that was started, and everything that it has started in turn."""

    process: subprocess.Popen[bytes]
    """What this process has started, whose streams are those of the program."""

    @property
    def pid(self) -> int:
        """The number of the program's own process."""

    def processes(self) -> frozenset[psutil.Process]:
        """The program and all that it has started."""

    def child(self, number: int) -> int | None:
        """The number here of the program's child that the program knows by ``number``; None if there is none."""

    def end(self) -> tuple[int, dict[int, str]]:
        """Kill all of it. The exit status, negative for a signal, and what had to be searched for: command lines by numbers."""


def start(
    words: Sequence[str],
    view: View | None,
    *,
    environment: Mapping[str, str] | None = None,
    folder: Path | None = None,
    pass_fds: Iterable[int] = (),
    out: int | IO[bytes] = subprocess.PIPE,
    error: int | IO[bytes] = subprocess.PIPE,
    largest_file: int | None = None,
) -> Started:
    """Start ``words`` in a sandbox with ``view``, or without one if that is None.

    It has no standard input and no terminal. ``folder``: its current folder. ``largest_file``: in bytes. Raises ``OSError``.
    """
    given = dict(os.environ if environment is None else environment)
    if view is None:
        return _Group(words, given, folder, tuple(pass_fds), out, error, largest_file)
    return _Sandboxed(words, view, clean_environment(given), folder, tuple(pass_fds), out, error, largest_file)


class _Group:
    """Without a sandbox: a process group; those that leave it are known by a mark in their environment."""

    def __init__(
        self,
        words: Sequence[str],
        environment: Mapping[str, str],
        folder: Path | None,
        pass_fds: tuple[int, ...],
        out: int | IO[bytes],
        error: int | IO[bytes],
        largest_file: int | None,
    ) -> None:
        self._mark = new_mark()
        self.process = subprocess.Popen(
            words,
            cwd=folder,
            env={**environment, MARK: self._mark},
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=error,
            pass_fds=pass_fds,
            start_new_session=True,  # an interrupt at the terminal is for the harness
        )
        _limit(self.pid, resource.RLIMIT_FSIZE, largest_file)

    @property
    def pid(self) -> int:
        return self.process.pid

    def processes(self) -> frozenset[psutil.Process]:
        found = set(below(self.pid))
        with suppress(psutil.Error):
            found.add(psutil.Process(self.pid))
        return frozenset(found)

    def child(self, number: int) -> int | None:
        return number if is_child_of(number, self.pid) else None

    def end(self) -> tuple[int, dict[int, str]]:
        with suppress(ProcessLookupError):
            os.killpg(self.pid, signal.SIGKILL)
        status = self.process.wait()
        return status, end_marked(self.pid, self._mark)


class _Sandboxed:
    """In namespaces of its own: whatever it has started ends with them."""

    def __init__(
        self,
        words: Sequence[str],
        view: View,
        environment: Mapping[str, str],
        folder: Path | None,
        pass_fds: tuple[int, ...],
        out: int | IO[bytes],
        error: int | IO[bytes],
        largest_file: int | None,
    ) -> None:
        here = os.path.realpath(folder or os.getcwd())
        options = [*_NAMESPACES, *_NO_SHARED_VIEW, *_DEVICES, *view.mounts, "--chdir", here]
        told, tell = os.pipe()
        held, release = os.pipe()
        arguments = os.memfd_create("arguments", 0)
        try:
            options += ["--info-fd", str(tell), "--block-fd", str(held)]
            os.write(arguments, b"".join(os.fsencode(option) + b"\0" for option in options))
            os.lseek(arguments, 0, os.SEEK_SET)
            self.process = subprocess.Popen(
                [PROGRAM, "--args", str(arguments), "--", *words],
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=error,
                pass_fds=(*pass_fds, arguments, tell, held),
                start_new_session=True,
            )
            os.close(tell)
            tell = -1
            self._init = _first_process(told)
            self._ends = -1
            if self._init is not None:
                with suppress(OSError):
                    self._ends = os.pidfd_open(self._init)
                _limit(self._init, resource.RLIMIT_FSIZE, largest_file)
                _limit(self._init, resource.RLIMIT_NPROC, MOST_TASKS if _counts_by_namespace() else None)
            os.write(release, b"x")
        finally:
            for descriptor in (told, tell, held, release, arguments):
                if descriptor >= 0:
                    os.close(descriptor)

    @cached_property
    def pid(self) -> int:
        """Searched for when it is asked for: a program that has said something is there, and need not be waited for."""
        return _child_of(self._init, self.process) if self._init is not None else self.process.pid

    def processes(self) -> frozenset[psutil.Process]:
        with suppress(psutil.Error):
            if self._init is not None:
                return frozenset(psutil.Process(self._init).children(recursive=True))
        return frozenset()

    def child(self, number: int) -> int | None:
        for one in _children(self.pid):
            if _number_inside(one) == number:
                return one
        return None

    def end(self) -> tuple[int, dict[int, str]]:
        ended = self.process.poll() is not None
        if not ended:
            with suppress(subprocess.TimeoutExpired):  # it may be just about to
                self.process.wait(0 if _lives(self.pid) else _DEAD_SECONDS)
        if self._ends >= 0:
            with suppress(OSError):
                signal.pidfd_send_signal(self._ends, signal.SIGKILL)
            poll = select.poll()
            poll.register(self._ends, select.POLLIN)
            poll.poll(_DEAD_SECONDS * 1000)  # the first process of a sandbox ends after all others
            os.close(self._ends)
            self._ends = -1
        with suppress(subprocess.TimeoutExpired):
            self.process.wait(_DEAD_SECONDS)
        self.process.kill()
        return exit_status(self.process.wait()), {}


def exit_status(status: int) -> int:
    """What ``status`` of bubblewrap says of the program in it: negative for a signal."""
    number = status - _SIGNALLED
    return -number if 0 < number <= signal.SIGRTMAX else status


def _limit(pid: int, what: int, most: int | None) -> None:
    if most is not None:
        with suppress(OSError, ValueError):  # it has ended
            _, hard = resource.prlimit(pid, what)
            least = most if hard == resource.RLIM_INFINITY else min(most, hard)
            resource.prlimit(pid, what, (least, least))


def _counts_by_namespace() -> bool:
    found = re.match(r"(\d+)\.(\d+)", os.uname().release)
    return found is not None and (int(found[1]), int(found[2])) >= _COUNTS_BY_NAMESPACE


def _first_process(told: int) -> int | None:
    """The number here of the first process in a sandbox; None if it could not be made."""
    said = b""
    deadline = time.monotonic() + _BEGIN_SECONDS
    poll = select.poll()
    poll.register(told, select.POLLIN)
    while poll.poll(max(deadline - time.monotonic(), 0) * 1000):
        chunk = os.read(told, 4096)
        if not chunk:
            break
        said += chunk
        if b"}" in said:
            break
    with suppress(ValueError, KeyError):
        return int(json.loads(said)["child-pid"])
    return None


def _child_of(init: int, process: subprocess.Popen[bytes]) -> int:
    """The number of the program, which the first process of its sandbox starts."""
    deadline = time.monotonic() + _BEGIN_SECONDS
    while process.poll() is None and time.monotonic() < deadline:
        for child in _children(init):
            return child
        time.sleep(0.0005)
    return process.pid


def _children(pid: int) -> Iterator[int]:
    """The numbers of the children of process ``pid``."""
    with suppress(OSError):
        for task in os.listdir(f"/proc/{pid}/task"):
            with suppress(OSError), open(f"/proc/{pid}/task/{task}/children", "rb") as stream:
                yield from map(int, stream.read().split())


def _number_inside(pid: int) -> int | None:
    """The number of process ``pid`` in the innermost namespace that it lives in."""
    with suppress(OSError, ValueError, IndexError), open(f"/proc/{pid}/status", "rb") as stream:
        for line in stream:
            if line.startswith(b"NSpid:"):
                return int(line.split()[-1])
    return None


def _lives(pid: int) -> bool:
    with suppress(psutil.Error):
        return bool(psutil.Process(pid).status() != psutil.STATUS_ZOMBIE)
    return False
