"""Runs one command within limits of time, memory and output."""

from __future__ import annotations

import os
import secrets
import select
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from ucm_cts.harness.results.values import Incident

_SAMPLE_SECONDS = 0.05
_PAGE = os.sysconf("SC_PAGE_SIZE")
_MIB = 1 << 20


class Limits(Protocol):
    """How long a run may take, and how many MiB of memory all its processes may hold together."""

    @property
    def seconds(self) -> float: ...

    @property
    def memory(self) -> int: ...


@dataclass(frozen=True)
class Ended:
    """The end of a run.

    ``status``: the exit status; None if the command could not be run or exceeded a limit.
    ``output``: what it printed.
    ``errors``: what it printed as errors, if these are kept apart.
    ``incident``: the limit that it exceeded, or why it could not be run.
    """

    status: int | None
    output: str
    errors: str = ""
    incident: Incident | None = None

    @property
    def problem(self) -> str:
        """The limit that it exceeded, or why it could not be run; empty if it ended by itself."""
        return self.incident.detail if self.incident else ""


def run(
    words: Sequence[str],
    folder: Path,
    limits: Limits,
    *,
    kept: int = 1 << 18,
    flood: int = 1 << 24,
    apart: bool = False,
    environment: Mapping[str, str] | None = None,
) -> Ended:
    """Run a command in a process group of its own, and end all its processes afterwards.

    A process that has left the group is found by its environment; one that has left both is not. Never raises for what
    the command does.

    ``words``: the command and its arguments.
    ``folder``: the working directory.
    ``limits``: the time and memory that it may use.
    ``kept``: the bytes of output that are returned, from the first.
    ``flood``: the bytes of output that end the run.
    ``apart``: whether errors are returned apart from output.
    ``environment``: the environment; that of this process if None.
    """
    mark = secrets.token_hex(16)
    try:
        process = subprocess.Popen(
            words,
            cwd=folder,
            env={**(os.environ if environment is None else environment), _MARK: mark},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE if apart else subprocess.STDOUT,
            start_new_session=True,
        )
    except OSError as error:
        return Ended(None, "", incident=Incident("unreachable", f"{words[0]} cannot be run: {error.strerror}"))
    with process:
        supervisor = _Supervisor(process, limits, kept, flood)
        try:
            incident = supervisor.until_the_end()
        finally:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            status = process.wait()
            _end_strays(process.pid, mark)
    return Ended(status if incident is None else None, *supervisor.printed, incident)


class _Supervisor:
    def __init__(self, process: subprocess.Popen[bytes], limits: Limits, kept: int, flood: int) -> None:
        self._process, self._limits = process, limits
        self._kept, self._flood, self._total = kept, flood, 0
        self._sampled = time.monotonic()
        self._deadline = self._sampled + limits.seconds
        self._poll = select.poll()
        streams = [stream for stream in (process.stdout, process.stderr) if stream is not None]
        self._texts = {stream.fileno(): bytearray() for stream in streams}
        self._open = set(self._texts)
        for source in self._texts:
            self._poll.register(source, select.POLLIN)

    @property
    def printed(self) -> tuple[str, str]:
        """Output and errors."""
        texts = [text.decode(errors="replace") for text in self._texts.values()]
        return texts[0], texts[1] if len(texts) > 1 else ""

    def until_the_end(self) -> Incident | None:
        """Wait until the process ends or goes too far."""
        while not self._is_over():
            self._read()
            if self._total > self._flood:
                return Incident("flood", f"more than {self._flood // _MIB} MiB of output")
            if time.monotonic() > self._deadline:
                return Incident("hang", f"no end after {self._limits.seconds:g} s")
            if self._exceeds_memory():
                return Incident("memory", f"more than {self._limits.memory} MiB of memory")
        return None

    def _is_over(self) -> bool:
        """The process has ended, and all was read that it printed; a child that it left behind may hold the pipe."""
        return self._process.poll() is not None and not (self._open and self._poll.poll(0))

    def _read(self) -> None:
        if not self._open:
            with suppress(subprocess.TimeoutExpired):
                self._process.wait(_SAMPLE_SECONDS)
            return
        for source, _ in self._poll.poll(_SAMPLE_SECONDS * 1000):
            chunk = os.read(source, 1 << 16)
            self._total += len(chunk)
            text = self._texts[source]
            text += chunk[: max(0, self._kept - len(text))]
            if not chunk:
                self._poll.unregister(source)
                self._open.remove(source)

    def _exceeds_memory(self) -> bool:
        now = time.monotonic()
        if now < self._sampled + _SAMPLE_SECONDS:
            return False
        self._sampled = now
        return _resident(self._process.pid) > self._limits.memory * _MIB


_MARK = "UCM_CTS_RUN"
"""The variable in the environment by which all processes of a run are known."""

_ROUNDS = 50
"""How many times strays are searched for, because they may start others while they are ended."""


def _end_strays(first: int, mark: str) -> None:
    """End the processes with ``mark`` in their environment, all of which began after the one with the number ``first``."""
    wanted = f"{_MARK}={mark}".encode()
    for _ in range(_ROUNDS):
        strays = [number for number in _since(first) if wanted in _environment_of(number)]
        if not strays:
            return
        for number in strays:
            with suppress(OSError):
                os.kill(number, signal.SIGKILL)
        time.sleep(0.001)


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


@contextmanager
def own_folder() -> Iterator[Path]:
    """A new folder for a run, of which nothing is left afterwards, however deep the run has nested it."""
    folder = Path(tempfile.mkdtemp(prefix="ucm-cts-"))
    try:
        yield folder
    finally:
        try:
            shutil.rmtree(folder)
        except (OSError, RecursionError):
            for command in (("chmod", "-R", "u+rwx"), ("rm", "-rf")):
                subprocess.run([*command, "--", str(folder)], stderr=subprocess.DEVNULL, check=False)


def _resident(group: int) -> int:
    """Bytes that all processes of the group hold together, as far as the system reports."""
    used = 0
    for entry in os.scandir("/proc"):
        if entry.name.isdecimal():
            with suppress(OSError, IndexError, ValueError):
                with open(f"/proc/{entry.name}/stat", "rb") as stream:
                    fields = stream.read().rpartition(b") ")[2].split()
                if int(fields[2]) == group:
                    used += int(fields[21]) * _PAGE
    return used
