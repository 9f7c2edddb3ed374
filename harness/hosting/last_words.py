"""Keeps the end of what processes print, however much that is: neither memory nor disk grows with it."""

from __future__ import annotations

import os
import select
import threading

from ucm_cts.harness.results.foreign import LONGEST_STACKS

KEPT = LONGEST_STACKS - 100
"""How many bytes are kept: with the line about the others, as many as a report shows."""

_CHUNK = 1 << 16
_AT_THE_END = 64
"""So many chunks are read when no more is wanted; somebody may go on printing."""


class LastWords:
    """The end of what was printed, as far as it was added."""

    def __init__(self) -> None:
        self._kept = bytearray()
        self._total = 0

    def __bool__(self) -> bool:
        return bool(self._kept)

    def add(self, data: bytes) -> None:
        """More was printed."""
        self._total += len(data)
        self._kept += data
        del self._kept[:-KEPT]

    def text(self) -> str:
        """The end, after a line that says how much is missing before it, if any."""
        missing = self._total - len(self._kept)
        before = f"({missing} bytes were printed before and are not kept)\n" if missing else ""
        return before + self._kept.decode(errors="replace")

    def clear(self) -> None:
        """Begin anew."""
        self._kept.clear()
        self._total = 0


class Listener:
    """A pipe to print to, which a thread empties: nobody who prints waits for somebody who reads."""

    def __init__(self) -> None:
        self._words = LastWords()
        self._source, self.target = os.pipe()
        self._enough, self._tell = os.pipe()
        os.set_blocking(self._source, False)
        self._thread = threading.Thread(target=self._listen, daemon=True)
        self._thread.start()

    def close_target(self) -> None:
        """The processes that print have got their copies of ``target``."""
        if self.target >= 0:
            os.close(self.target)
            self.target = -1

    def close(self) -> None:
        """Take what has been printed, and listen no more. What was heard can still be had."""
        if self._source < 0:
            return
        self.close_target()
        os.close(self._tell)
        self._thread.join()
        for descriptor in (self._source, self._enough):
            os.close(descriptor)
        self._source = -1

    def text(self) -> str:
        """What was heard until ``close``."""
        return self._words.text()

    def _listen(self) -> None:
        poll = select.poll()
        for descriptor in (self._source, self._enough):
            poll.register(descriptor, select.POLLIN)
        while True:
            ready = {descriptor for descriptor, _ in poll.poll()}
            if self._enough in ready:
                break
            if not self._take():
                return
        for _ in range(_AT_THE_END):
            if not self._take():
                return

    def _take(self) -> bool:
        """Read a chunk; False if there is none, or there will be no more."""
        try:
            data = os.read(self._source, _CHUNK)
        except BlockingIOError:
            return False
        self._words.add(data)
        return bool(data)
