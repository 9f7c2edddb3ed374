"""Moments at which this machine, or this process, stood still: what depends on time is not held against anybody then.

A thread beside the run sleeps again and again for a short while and looks how long that took. Events of traces carry the
same monotonic clock, as long as the host runs on this machine; of the stalls of another machine nothing is known.
"""

from __future__ import annotations

import threading
import time
import weakref
from collections import deque
from collections.abc import Callable

from ucm_cts.adapters.contract.trace import Trace

NAP = 0.02
"""Seconds that the thread sleeps at a time."""

LATE = 0.1
"""Seconds. Who wakes up so much later than asked has stood still."""

REMEMBERED = 10_000
"""So many stalls are kept, the latest ones."""

_MILLISECOND = 1_000_000
_LONGEST_NAP = int((NAP + LATE) * 1000 * _MILLISECOND)


class StallWatch:
    """Notes stalls from now on, until it is closed or nobody holds it any more."""

    def __init__(self, clock: Callable[[], int] = time.monotonic_ns) -> None:
        self._clock = clock
        self._stalls: deque[tuple[int, int]] = deque(maxlen=REMEMBERED)
        self._awake = [clock()]
        over = threading.Event()
        self._end = weakref.finalize(self, over.set)
        arguments = self._stalls, self._awake, over, clock
        threading.Thread(target=_watch, args=arguments, name="stall watch", daemon=True).start()

    def close(self) -> None:
        """Watch no longer."""
        self._end()

    def longest(self, trace: Trace) -> int:
        """Milliseconds of the longest stall while ``trace`` came about; 0 if there was none."""
        times = [event.t for event in trace]
        asleep = (self._awake[0], self._clock())  # it may still be too late to have woken up
        naps = (*tuple(self._stalls), asleep) if asleep[1] - asleep[0] > _LONGEST_NAP else tuple(self._stalls)
        met = (end - begin for begin, end in naps if times and begin < max(times) and min(times) < end)
        return max(met, default=0) // _MILLISECOND


def _watch(stalls: deque[tuple[int, int]], awake: list[int], over: threading.Event, clock: Callable[[], int]) -> None:
    while not over.wait(NAP):
        now = clock()
        if now - awake[0] > _LONGEST_NAP:
            stalls.append((awake[0], now))
        awake[0] = now
