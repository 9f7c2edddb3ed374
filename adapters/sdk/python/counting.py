"""Counters that replace events: messages of a burst, and overlapping executions under stress."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from time import monotonic, sleep  # an adapter may change what the module has, not these

from ucm_cts.adapters.sdk.python.seal import KeptClass

_BLOCK = 2**20
"""The size of the block of numbers that one emitter uses."""

_OFTEN = 1e-6
"""Seconds between two switches of threads, as far as the interpreter can: under its lock, overlap is rare otherwise."""

_SLOTS = 100
"""Slots of a second. In every other one visitors stay on purpose, which detects locks that are sometimes missing; in the
others they leave at once, which detects locks that are checked first and taken afterwards.
"""

_WORK = 20


@dataclass
class Count:
    """What one body has counted of the messages pushed to it."""

    received: int = 0
    disordered: int = 0
    seen: set[int] = field(default_factory=set)
    greatest: dict[int, int] = field(default_factory=dict)

    def add(self, value: int) -> None:
        """One more message."""
        block = value // _BLOCK
        self.received += 1
        self.seen.add(value)
        if value < self.greatest.get(block, value):
            self.disordered += 1
        else:
            self.greatest[block] = value


class MessageCounts(metaclass=KeptClass):
    """The counts of all bodies, by component and instance. ``patience`` is the longest wait in seconds."""

    def __init__(self, patience: float) -> None:
        self._patience = patience
        self._changed = threading.Condition()
        self._counts: dict[tuple[str, int], Count] = {}
        self._wanted = sys.maxsize

    def add(self, component: str, instance: int, value: int) -> None:
        """A message has been pushed to that body."""
        with self._changed:
            count = self._counts.setdefault((component, instance), Count())
            count.add(value)
            if count.received >= self._wanted:
                self._changed.notify_all()

    def wait(self, component: str, instance: int, messages: int) -> dict[str, int]:
        """Wait until the body has counted so many; returns the counts, as fields of the event."""
        with self._changed:
            count = self._counts.setdefault((component, instance), Count())
            self._wanted = messages
            self._changed.wait_for(lambda: count.received >= messages, self._patience)
            self._wanted = sys.maxsize
            return {
                "received": count.received,
                "distinct": len(count.seen),
                "disordered": count.disordered,
                "least": min(count.seen, default=0),
                "greatest": max(count.seen, default=0),
            }


class Occupancy(metaclass=KeptClass):
    """Counts threads inside one body. Python's own lock hides races: an unprotected control shows whether any can be seen."""

    def __init__(self) -> None:
        self._inside: object = None
        self.overlaps = 0

    def visit(self) -> None:
        """Enter, stay for a moment, count it if another thread came, and leave."""
        own = object()
        met = self._inside is not None
        self._inside = own
        if int(monotonic() * _SLOTS) % 2:
            sleep(0)  # releases the interpreter's lock, so that another thread can enter
        else:
            for _ in range(_WORK):
                pass
        if met or self._inside is not own:
            self.overlaps += 1
        self._inside = None


@contextmanager
def switching_often() -> Iterator[None]:
    """Switch between threads as often as possible."""
    usual = sys.getswitchinterval()
    sys.setswitchinterval(_OFTEN)
    try:
        yield
    finally:
        sys.setswitchinterval(usual)


class Storm(metaclass=KeptClass):
    """Calls as many as possible until it is over: ``calls`` came back, ``failed`` raised."""

    def __init__(self, visits: Sequence[Callable[[], object]], milliseconds: int) -> None:
        self._visits = visits
        self._seconds = milliseconds / 1000
        self._together = threading.Barrier(len(visits))
        self._lock = threading.Lock()
        self.calls = 0
        self.failed = 0

    def tasks(self) -> list[Callable[[], None]]:
        """What each thread does; none of them begins before all have come."""
        return [lambda visit=visit: self._keep_visiting(visit) for visit in self._visits]  # type: ignore[misc]

    def _keep_visiting(self, visit: Callable[[], object]) -> None:
        calls = failed = 0
        self._together.wait()
        end = monotonic() + self._seconds
        while monotonic() < end:
            try:
                visit()
                calls += 1
            except Exception:  # noqa: BLE001 - the framework may raise anything
                failed += 1
        with self._lock:
            self.calls += calls
            self.failed += failed
