"""Runs one command within limits of time, memory, output and files."""

from __future__ import annotations

import os
import select
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from ucm_cts.harness.hosting.process_tree import resident
from ucm_cts.harness.hosting.sandbox import Started, start, why_none
from ucm_cts.harness.hosting.view import View, view_of
from ucm_cts.harness.results.values import Incident

NO_END = "no end after"
"""How the problem begins of what ran longer than it may."""

_SAMPLE_SECONDS = 0.05
_FILES_SAMPLE_SECONDS = 0.2
_RARELY = 10
"""A sample of the files is taken after so many times the time that the last one took."""

MOST_PROCESSES = 512
"""How many processes a run may have at a time."""

MOST_FILES, MOST_BYTES = 20_000, 256 << 20
"""How many files a run may write in its folder, and how many bytes in all of them."""

_LEAST_FREE = 1 << 20
"""With fewer free bytes than this a run cannot write what it would."""

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


def view_for(
    needed: Iterable[str | Path], mebibytes: int, *, sandbox: bool = True, network: bool = True
) -> View | None:
    """What a program sees that reads the vendor's files: ``needed``, and the system; None for no sandbox, if none is to be had.

    ``mebibytes``: how much it may write in temporary folders. ``sandbox``: whether it is to have one. ``network``: whether there is one
    in the sandbox.
    """
    if not sandbox or why_none():
        return None
    view = view_of(needed, mebibytes=mebibytes)
    return view if network else view.without_network()


def run(
    words: Sequence[str],
    folder: Path,
    limits: Limits,
    *,
    kept: int = 1 << 18,
    flood: int = 1 << 24,
    apart: bool = False,
    environment: Mapping[str, str] | None = None,
    view: View | None = None,
    own_statuses: Collection[int] = (),
) -> Ended:
    """Run a command in a sandbox with ``view``, or in a process group of its own, and end all its processes afterwards.

    Without a sandbox, a process that has left the group is found by its environment; one that has left both is not. Never raises
    for what the command does.

    ``words``: the command and its arguments.
    ``folder``: the working directory.
    ``limits``: the time and memory that it may use.
    ``kept``: the bytes of output that are returned, from the first.
    ``flood``: the bytes of output that end the run. Files in ``folder`` beyond ``MOST_FILES`` and ``MOST_BYTES`` end it as well.
    ``apart``: whether errors are returned apart from output.
    ``environment``: the environment; that of this process if None.
    ``view``: what the command sees besides ``folder``; everything, and without a sandbox, if None.
    ``own_statuses``: exit statuses that are the command's own although a shell gives them to what a signal has killed.
    """
    if view is not None and not _can_be_run(words[0], folder, environment):
        return _not_run(words, "No such file or directory, or not executable")
    try:
        started = start(
            words,
            view.writing(folder) if view is not None else None,
            environment=environment,
            folder=folder,
            error=subprocess.PIPE if apart else subprocess.STDOUT,
            largest_file=MOST_BYTES,
        )
    except OSError as error:
        return _not_run(words, str(error.strerror))
    with started.process as process:
        supervisor = _Supervisor(started, limits, kept, flood, folder)
        try:
            incident = supervisor.until_the_end() or supervisor.excess_of_files()
        finally:
            status, _ = started.end()
            said = process.returncode
    if view is not None and status < 0 and said in own_statuses:
        status = said
    if incident is None and status == -signal.SIGXFSZ:
        incident = _too_much()
    if incident is None and shutil.disk_usage(folder).free < _LEAST_FREE:
        incident = Incident(
            "unreachable", f"no room is left in {folder.parent}; free some, or set TMPDIR to another folder"
        )
    return Ended(status if incident is None else None, *supervisor.printed, incident)


def _not_run(words: Sequence[str], why: str) -> Ended:
    return Ended(None, "", incident=Incident("unreachable", f"{words[0]} cannot be run: {why}"))


def _can_be_run(program: str, folder: Path, environment: Mapping[str, str] | None) -> bool:
    path = (os.environ if environment is None else environment).get("PATH")
    return shutil.which(program if "/" not in program else str(folder / program), path=path) is not None


def _too_much() -> Incident:
    return Incident("flood", f"more than {MOST_BYTES // _MIB} MiB of files")


class _Supervisor:
    def __init__(self, started: Started, limits: Limits, kept: int, flood: int, folder: Path) -> None:
        process = started.process
        self._started, self._process, self._limits, self._folder = started, process, limits, folder
        self._kept, self._flood, self._total = kept, flood, 0
        self._sampled = time.monotonic()
        self._deadline = self._sampled + limits.seconds
        self._sample_files_at = self._sampled + _FILES_SAMPLE_SECONDS
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
                return Incident("hang", f"{NO_END} {self._limits.seconds:g} s")
            if (excess := self._excess_of_memory()) is not None:
                return excess
            if time.monotonic() > self._sample_files_at and (excess := self.excess_of_files()) is not None:
                return excess
        return None

    def excess_of_files(self) -> Incident | None:
        """What is too much of the files in the folder of the run."""
        begun = time.monotonic()
        size = 0
        for files, entry in enumerate(_entries(self._folder), 1):
            with suppress(OSError):
                size += entry.stat(follow_symlinks=False).st_blocks * _BLOCK
            if size > MOST_BYTES or files > MOST_FILES:
                return _too_much() if size > MOST_BYTES else Incident("flood", f"more than {MOST_FILES} files")
        now = time.monotonic()
        self._sample_files_at = now + max(_FILES_SAMPLE_SECONDS, _RARELY * (now - begun))
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

    def _excess_of_memory(self) -> Incident | None:
        """What is too much of memory or of processes."""
        now = time.monotonic()
        if now < self._sampled + _SAMPLE_SECONDS:
            return None
        self._sampled = now
        if self._process.poll() is not None:
            return None
        tree = self._started.processes()
        if len(tree) > MOST_PROCESSES:
            return Incident("memory", f"more than {MOST_PROCESSES} processes")
        if resident(tree, self._limits.memory) > self._limits.memory:
            return Incident("memory", f"more than {self._limits.memory} MiB of memory")
        return None


_BLOCK = 512
"""Bytes of a block, as the system counts them."""


def _entries(folder: Path) -> Iterator[os.DirEntry[str]]:
    """Everything below ``folder``; links are not followed."""
    waiting = [str(folder)]
    while waiting:
        with suppress(OSError), os.scandir(waiting.pop()) as inside:
            for entry in inside:
                yield entry
                if entry.is_dir(follow_symlinks=False):
                    waiting.append(entry.path)


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
