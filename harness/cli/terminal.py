"""The terminal: replaces characters that it cannot show; a closed terminal does not end the run."""

from __future__ import annotations

import io
import os
import signal
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from threading import Event, Thread
from types import FrameType
from typing import IO, cast

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

LINE_EVERY = 10
"""Off a terminal, progress is a line each so many seconds."""

ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGUSR1, signal.SIGUSR2, signal.SIGXCPU)
"""What asks a run to end: a user, a closed terminal, and what batch systems send before a job's time is used up."""

_PLAIN = {
    ord(fine): plain
    for fine, plain in zip("✓✗⚡…–•●○→▶▷⇒◀×µ─╌═│┊┐┘┌└├┤┼┬┴", "+x!.-**o>>>=<xu--=||+++++++++", strict=True)
}


class Output(Console):
    """Standard output."""

    def __init__(self) -> None:
        self._stream = _Stream()
        super().__init__(file=cast(IO[str], self._stream))

    def say(self, text: str) -> None:
        """Print ``text`` as it is, without markup, as one line however long."""
        self.print(text, markup=False, soft_wrap=True)

    @property
    def error(self) -> str:
        """Why output was lost; empty if none was lost, or if the reader closed the pipe."""
        return self._stream.error


class _Stream(io.TextIOBase):
    """Writes to standard output. After the first failure it discards all text."""

    error = ""

    def __init__(self) -> None:
        self._target = sys.stdout
        self._encoding = self._target.encoding or "utf-8"

    @property
    def encoding(self) -> str:  # type: ignore[override]
        return self._encoding

    def isatty(self) -> bool:
        return self._target.isatty()

    def fileno(self) -> int:
        return self._target.fileno()

    def write(self, text: str) -> int:
        try:
            text.encode(self._encoding)
        except UnicodeEncodeError:
            text = text.translate(_PLAIN).encode(self._encoding, "replace").decode(self._encoding)
        with self._guarded():
            self._target.write(text)
        return len(text)

    def flush(self) -> None:
        with self._guarded():
            self._target.flush()

    @contextmanager
    def _guarded(self) -> Iterator[None]:
        try:
            yield
        except BrokenPipeError:
            self._give_up()
        except OSError as error:
            self.error = self.error or error.strerror or str(error)
            self._give_up()

    def _give_up(self) -> None:
        """Buffered output must not fail again when the interpreter ends."""
        with suppress(OSError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), self._target.fileno())


class Interrupts:
    """Requests to end. The first one raises ``KeyboardInterrupt``, unless they are held; later ones are ignored."""

    def __init__(self) -> None:
        self.came = False
        self._held = 0

    @contextmanager
    def held(self) -> Iterator[None]:
        """Requests are only noted, in ``came``: what is written here is not lost."""
        self._held += 1
        try:
            yield
        finally:
            self._held -= 1

    @contextmanager
    def permitted(self) -> Iterator[None]:
        """Within what is held: a request interrupts again, also one that came before."""
        if self.came:
            raise KeyboardInterrupt
        before, self._held = self._held, 0
        try:
            yield
        finally:
            self._held = before

    def note(self, number: int, frame: FrameType | None) -> None:
        """The handler of signals."""
        first, self.came = not self.came, True
        if first and not self._held:
            raise KeyboardInterrupt


@contextmanager
def ends_like_interrupts() -> Iterator[Interrupts]:
    """Treat all of ``ENDING`` as an interrupt. After the first one, all are ignored until the process ends."""
    interrupts = Interrupts()
    before = {number: signal.getsignal(number) for number in ENDING}
    ours = [number for number, handler in before.items() if handler not in (signal.SIG_IGN, None)]
    for number in ours:
        signal.signal(number, interrupts.note)
    try:
        yield interrupts
    finally:
        for number in ours:
            signal.signal(number, signal.SIG_IGN if interrupts.came else before[number])


def progress_of(console: Output, *columns: ProgressColumn) -> Progress:
    """A progress bar with ``columns`` behind it, by default the number of finished ones, the time and what is left of it; it disappears at
    the end.

    Off a terminal it is a line each ``LINE_EVERY`` seconds. The field ``far`` of a task says how far it is, where that is not how much
    of it is completed.
    """
    behind = columns or (MofNCompleteColumn(), TimeElapsedColumn(), TimeRemainingColumn())
    bar = Progress if console.is_terminal else _Lines
    return bar(TextColumn("{task.description}", markup=False), BarColumn(), *behind, console=console, transient=True)


class _Lines(Progress):
    """Progress as lines."""

    _ended: Event | None = None

    def start(self) -> None:
        """Begin to print."""
        self._ended, began = Event(), time.monotonic()
        Thread(target=self._print, args=(self._ended, began), daemon=True).start()

    def stop(self) -> None:
        """Print no more."""
        if self._ended is not None:
            self._ended.set()

    def _print(self, ended: Event, began: float) -> None:
        while not ended.wait(LINE_EVERY):
            for task in self.tasks:
                of = f"{task.completed:.0f} of {task.total:.0f}, " if task.total else ""
                of = f"{task.fields['far']}, " if "far" in task.fields else of
                left = task.time_remaining
                of += f"about {left:.0f} s more, " if left else ""
                self.console.print(
                    f"{time.monotonic() - began:.0f} s: {of}{task.description}", markup=False, soft_wrap=True
                )
                self.console.file.flush()
