"""The terminal: replaces characters that it cannot show; a closed terminal does not end the run."""

from __future__ import annotations

import io
import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import IO, NoReturn, cast

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, ProgressColumn, TextColumn, TimeElapsedColumn

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


@contextmanager
def ends_like_interrupts() -> Iterator[None]:
    """Treat a request to end, or a closed terminal, as one interrupt; later ones are ignored."""
    before = {number: signal.getsignal(number) for number in (signal.SIGTERM, signal.SIGHUP)}
    ours = [number for number, handler in before.items() if handler is not signal.SIG_IGN]

    def interrupt(number: int, frame: FrameType | None) -> NoReturn:
        for each in ours:
            signal.signal(each, signal.SIG_IGN)
        raise KeyboardInterrupt

    for number in ours:
        signal.signal(number, interrupt)
    try:
        yield
    finally:
        for number in ours:
            signal.signal(number, before[number])


def progress_of(console: Output, *columns: ProgressColumn) -> Progress:
    """A progress bar with ``columns`` behind it, by default the number of finished ones; it disappears at the end."""
    behind = columns or (MofNCompleteColumn(), TimeElapsedColumn())
    return Progress(
        TextColumn("{task.description}", markup=False), BarColumn(), *behind, console=console, transient=True
    )
