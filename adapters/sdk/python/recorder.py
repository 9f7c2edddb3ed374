"""Recorder: puts the events of one scenario into one total order."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable
from time import monotonic_ns as now  # an adapter may change what the module has, not this
from typing import Any

from ucm_cts.adapters.contract.trace import Event
from ucm_cts.adapters.sdk.python.seal import Kept

Sink = Callable[[Event], None]


class Recorder(Kept):
    """Collects the events of one scenario; any thread may record.

    The thread that makes the recorder is number 0, others are numbered at their first event. After ``stop`` nothing is
    recorded any more. ``sink``, if given, receives each event as it happens, in order. Only the recorder sets its
    slots: the count, which only increases, shows whether the list still has all events.
    """

    __slots__ = ("_complaint", "_count", "_events", "_lock", "_numbers", "_sink", "_threads", "recording")

    def __init__(self, sink: Sink | None = None) -> None:
        self._sink = sink
        self._lock = threading.Lock()
        self._numbers = threading.local()
        self._numbers.own = 0
        self._threads = 1
        self._count = itertools.count(1)
        self._events: list[Event] = []
        self._complaint = ""
        self.recording = True

    def record(self, kind: Callable[..., Event], **fields: Any) -> None:
        """Add an event of type ``kind``; number, time and thread are filled in here."""
        with self._lock:
            if not self.recording:
                return
            number: int | None = getattr(self._numbers, "own", None)
            if number is None:
                number = self._numbers.own = self._threads
                self._threads += 1
            event = kind(n=next(self._count), t=now(), thread=number, **fields)
            self._events.append(event)
            if self._sink:
                self._sink(event)

    def complain(self, problem: str) -> None:
        """The adapter broke the contract, so there is no trace; the first problem counts."""
        with self._lock:
            if self.recording and not self._complaint:
                self._complaint = problem

    @property
    def complaint(self) -> str:
        """How the adapter broke the contract; empty if it did not."""
        return self._complaint

    def stop(self) -> tuple[Event, ...]:
        """End the recording and return all events."""
        with self._lock:
            self.recording = False
            if next(self._count) != len(self._events) + 1:
                self._complaint = self._complaint or "events have been taken away from the recorder, or added"
            return tuple(self._events)
