"""Gates: probes wait there until the scenario opens them."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Callable

from ucm_cts.adapters.sdk.python.seal import KeptClass


class Gates(metaclass=KeptClass):
    """The gates of one scenario, by name. ``patience`` is the longest wait in seconds."""

    def __init__(self, patience: float) -> None:
        self._patience = patience
        self._changed = threading.Condition()
        self._arrivals: Counter[str] = Counter()
        self._opened: set[str] = set()
        self._all_open = False
        self._holding: dict[int | None, str] = {}

    def hold(self, gate: str, record: Callable[[], None]) -> None:
        """A probe arrives: wait until ``gate`` is open. ``record`` is called before anybody can learn of the arrival."""
        with self._changed:
            record()
            self._arrivals[gate] += 1
            self._changed.notify_all()
            thread = threading.get_ident()
            self._holding[thread] = gate
            self._changed.wait_for(lambda: self._is_open(gate), self._patience)
            del self._holding[thread]

    def is_held(self, thread: threading.Thread) -> bool:
        """Is ``thread`` in a probe that waits at a closed gate?"""
        with self._changed:
            gate = self._holding.get(thread.ident)
            return gate is not None and not self._is_open(gate)

    def reach(self, gate: str, more: int = 0, total: int = 0) -> bool:
        """Wait until a probe has arrived at ``gate``, or ``more`` have from now on, or ``total`` in all.

        False when patience runs out.
        """
        with self._changed:
            enough = max(self._arrivals[gate] + more if more > 0 else 1, total)
            return self._changed.wait_for(lambda: self._arrivals[gate] >= enough, self._patience)

    def open(self, gate: str, record: Callable[[], None]) -> None:
        """Open ``gate`` for good. ``record`` is called before anybody goes through."""
        with self._changed:
            record()
            self._opened.add(gate)
            self._changed.notify_all()

    def open_all(self) -> None:
        """Open every gate, known or not, for good."""
        with self._changed:
            self._all_open = True
            self._changed.notify_all()

    def _is_open(self, gate: str) -> bool:
        return self._all_open or gate in self._opened
