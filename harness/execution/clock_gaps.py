"""Clock gaps: moments at which this machine, or this process, stood still.

A finding that depends on time gives no verdict if a gap may have caused it.

A thread beside the run sleeps for a short while, again and again, and measures how long that took. Events of traces have
times of the same monotonic clock as long as the host runs on this machine; gaps of another machine are not known.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from typing import Self

from ucm_cts.adapters.contract.trace import Trace

NAP = 0.02
"""Seconds that the thread sleeps at a time."""

LATE = 0.1
"""Seconds. A thread that wakes up so much later than asked has met a gap."""

REMEMBERED = 10_000
"""How many gaps are kept, the latest ones."""

_MILLISECOND = 1_000_000
_LONGEST_NAP = int((NAP + LATE) * 1000 * _MILLISECOND)


class ClockGaps:
    """Notes clock gaps while it is open: from ``with``, or ``start``, until ``close``."""

    def __init__(self, clock: Callable[[], int] = time.monotonic_ns) -> None:
        """``clock`` gives nanoseconds of the clock that hosts on this machine use."""
        self._clock = clock
        self._gaps: deque[tuple[int, int]] = deque(maxlen=REMEMBERED)
        self._awake = clock()
        self._over = threading.Event()
        self._thread: threading.Thread | None = None

    def __enter__(self) -> Self:
        return self.start()

    def __exit__(self, *error: object) -> None:
        self.close()

    def start(self) -> Self:
        """Start the thread that measures."""
        self._awake = self._clock()
        self._thread = threading.Thread(target=self._measure, name="clock gaps", daemon=True)
        self._thread.start()
        return self

    def close(self) -> None:
        """End the thread. The gaps that are known stay."""
        self._over.set()
        if self._thread is not None:
            self._thread.join()

    def longest(self, trace: Trace) -> int:
        """Milliseconds of the longest gap while ``trace`` came about; 0 if there was none."""
        times = [event.t for event in trace]
        current = (self._awake, self._clock())  # the thread may still be asleep
        gaps = tuple(self._gaps)
        if self._thread is not None and current[1] - current[0] > _LONGEST_NAP:
            gaps = (*gaps, current)
        met = (end - begin for begin, end in gaps if times and begin < max(times) and min(times) < end)
        return max(met, default=0) // _MILLISECOND

    def _measure(self) -> None:
        while not self._over.wait(NAP):
            now = self._clock()
            if now - self._awake > _LONGEST_NAP:
                self._gaps.append((self._awake, now))
            self._awake = now
