"""Checks a host's clock from answer to answer. The times of a replayed trace are old, or do not fit the harness's clock.

Events of one host have times of one monotonic clock (trace.py), so that a later scenario has later times. And where the harness
starts the host their clocks run alike: no event comes before its scenario was sent, and none after its answer.
"""

from __future__ import annotations

import bisect

from ucm_cts.adapters.contract.trace import Trace

GRAIN = 50_000_000
"""Nanoseconds by which two clocks may seem to differ at any time."""

DRIFT = 0.001
"""The part of the elapsed time by which the clocks may drift apart, if the process started here is a proxy of a remote host."""


class HostClock:
    """The clock of one host. ``is_near`` if the harness has started it; ``in_order`` if its answers are examined in their order."""

    def __init__(self, is_near: bool, in_order: bool = True) -> None:
        self._is_near = is_near
        self._in_order = in_order
        self._spans: list[tuple[int, int]] = []
        self._first: int | None = None
        self._last: int | None = None
        self._ahead: int | None = None

    def contradiction(self, trace: Trace, sent: int, received: int) -> str | None:
        """Why ``trace`` cannot be this host's next answer, or another one of its answers if they are in no order; None if it can.

        ``sent`` and ``received`` are when the harness sent the scenario and got the answer, in nanoseconds of its own
        monotonic clock.
        """
        if not trace:
            return None
        first, last = trace[0].t, max(event.t for event in trace)
        before = self._end_before(first, last)
        if before is not None and first < before:
            return f"it begins {before - first} ns before the end of this host's last answer: a replayed trace"
        if not self._is_near:
            return None
        least = sent - first  # the host's clock is behind the harness's by so much at least, since it was sent before
        self._ahead = least if self._ahead is None else max(self._ahead, least)
        self._first = first if self._first is None else min(self._first, first)
        too_much = last + self._ahead - received
        if too_much > GRAIN + DRIFT * (last - self._first):
            return f"it spans {too_much / 1e6:.0f} ms more than have passed since the host got the scenario"
        return None

    def _end_before(self, first: int, last: int) -> int | None:
        """When the answer before ended: the last one; without an order one that overlaps a trace from ``first`` to ``last``, or ended
        before it.
        """
        if self._in_order:
            before, self._last = self._last, last
            return before
        place = bisect.bisect(self._spans, (first, last))
        beside = self._spans[max(place - 1, 0) : place + 1]
        self._spans.insert(place, (first, last))
        return max((end for begin, end in beside if begin < last), default=None)
