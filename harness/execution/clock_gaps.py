"""Clock gaps: moments at which this machine, or this process, stood still, and those at which it had too few processors.

A finding that depends on time gives no verdict if a gap may have caused it.

A thread beside the run sleeps for a short while, again and again, measures how long that took, and asks the system how long
threads have waited for a processor. Events of traces have times of the same monotonic clock as long as the host runs on this
machine; gaps of another machine are not known.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Self

from ucm_cts.adapters.contract.trace import Trace

NAP = 0.02
"""Seconds that the thread sleeps at a time."""

LATE = 0.1
"""Seconds. A thread that wakes up so much later than asked has met a gap."""

REMEMBERED = 10_000
"""How many gaps are kept, the latest ones, and how many measurements of contention: those of some minutes."""

_PRESSURE = Path("/proc/pressure/cpu")
_MILLISECOND = 1_000_000
_LONGEST_NAP = int((NAP + LATE) * 1000 * _MILLISECOND)


def processor_pressure() -> int:
    """Milliseconds for which at least one thread of this machine has waited for a processor; 0 where the system does not tell."""
    with suppress(OSError, ValueError, IndexError):
        return int(_PRESSURE.read_text().split("\n", 1)[0].rpartition("total=")[2]) // 1000
    return 0


class ClockGaps:
    """Notes clock gaps and contention while it is open: from ``with``, or ``start``, until ``close``."""

    def __init__(
        self, clock: Callable[[], int] = time.monotonic_ns, pressure: Callable[[], int] = processor_pressure
    ) -> None:
        """``clock`` gives nanoseconds of the clock that hosts on this machine use, ``pressure`` is ``processor_pressure``."""
        self._clock = clock
        self._pressure = pressure
        self._pressures: deque[tuple[int, int]] = deque(maxlen=REMEMBERED)
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

    def contended(self, trace: Trace) -> int:
        """Milliseconds for which threads of this machine waited for a processor while ``trace`` came about."""
        times = [event.t for event in trace]
        measured = [*self._pressures, (self._clock(), self._pressure())]
        if not times:
            return 0
        before = [waited for at, waited in measured if at <= min(times)] or [measured[0][1]]
        after = [waited for at, waited in measured if at >= max(times)] or [measured[-1][1]]
        return max(0, min(after[0] - before[-1], (max(times) - min(times)) // _MILLISECOND))

    def _measure(self) -> None:
        while not self._over.wait(NAP):
            now = self._clock()
            self._pressures.append((now, self._pressure()))
            if now - self._awake > _LONGEST_NAP:
                self._gaps.append((self._awake, now))
            self._awake = now
