"""Recorder: puts what happens during one scenario into one total order."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

from ucm_cts.adapters.contract.trace import Event

Sink = Callable[[Event], None]


class Recorder:
    """Collects the events of one scenario; any thread may record.

    The thread that makes the recorder is number 0, others are numbered at their first event. After ``stop`` nothing is
    recorded any more. ``sink``, if given, receives each event as it happens, in order.
    """

    def __init__(self, sink: Sink | None = None) -> None:
        self._sink = sink
        self._lock = threading.Lock()
        self._numbers = threading.local()
        self._numbers.own = 0
        self._threads = 1
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
            event = kind(n=len(self._events) + 1, t=time.monotonic_ns(), thread=number, **fields)
            self._events.append(event)
            if self._sink:
                self._sink(event)

    def complain(self, problem: str) -> None:
        """The adapter broke the contract, so the trace cannot be told; the first problem counts."""
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
            return tuple(self._events)
