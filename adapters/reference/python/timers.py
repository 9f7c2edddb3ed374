"""The timers of one component (10.3): set and cancelled by number, from one start of its container to the next stop.

One thread calls back, one timer after the other. All times are seconds of the monotonic clock. Variants replace ``Timers``.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import BadParameter
from ucm_cts.adapters.reference.python.execution import Trigger


@dataclass(frozen=True)
class Timer:
    """A timer that waits: its number, when it is due, and after how long again; ``asked`` is what its callback tells."""

    number: int
    due: float
    rate: float | None
    asked: list[Datum]


class Timers:
    """The timers of one component in one operational phase.

    ``call_back(timer)`` calls the component. ``seconds(time_out)`` is how long a time-out lasts from now.
    """

    def __init__(self, call_back: Callable[[Timer], None], seconds: Callable[[Sequence[Any]], float]) -> None:
        self._call_back, self._seconds = call_back, seconds
        self._changed = threading.Condition()
        self._waiting: dict[int, Timer] = {}
        self._cancelled: set[int] = set()
        self._is_serving = False
        self.trigger = Trigger()

    # the methods of the service

    def start_periodic_scheduler(self, number: int, delay: Sequence[Any], rate: Sequence[Any]) -> None:
        if rate[0] <= 0:
            raise BadParameter("a rate of nothing")
        self._start(Timer(number, self._due(delay), float(rate[0]), list(delay)))

    def start_sporadic_scheduler(self, number: int, time_out: Sequence[Any]) -> None:
        self._start(Timer(number, self._due(time_out), None, list(time_out)))

    def cancel_timer(self, number: int) -> None:
        with self._changed:
            if self._waiting.pop(number, None) is not None:
                self._cancelled.add(number)

    def is_canceled(self, number: int) -> bool:
        return number in self._cancelled

    # their phase

    def begin(self) -> None:
        """The component is operational: timers may call back."""
        if not self._is_serving:
            self._is_serving = True
            threading.Thread(target=self._serve, daemon=True).start()

    def end(self) -> None:
        """Call back no more; a callback that has begun is waited for."""
        with self._changed:
            self.trigger.ended.set()
            self._changed.notify()
        self.trigger.end()

    # one concern each, for variants to override

    def _due(self, time_out: Sequence[Any]) -> float:
        return time.monotonic() + self._seconds(time_out)

    def _start(self, timer: Timer) -> None:
        with self._changed:
            self._cancelled.discard(timer.number)
            self._waiting[timer.number] = timer
            self._changed.notify()

    def _serve(self) -> None:
        while timer := self._next():
            self._call_back(timer)

    def _next(self) -> Timer | None:
        """The next timer that is due, when it is; None at the end."""
        with self._changed:
            while not self.trigger.ended.is_set():
                first = min(self._waiting.values(), key=lambda timer: timer.due, default=None)
                remaining = None if first is None else first.due - time.monotonic()
                if first is not None and remaining is not None and remaining <= 0:
                    return first
                self._changed.wait(remaining)
        return None

    def take(self, timer: Timer) -> bool:
        """The component is free for ``timer``: does it still wait? Sets its next time."""
        with self._changed:
            if self._waiting.get(timer.number) is not timer:
                return False
            following = self._following(timer)
            if following is None:
                del self._waiting[timer.number]
            else:
                self._waiting[timer.number] = following
            return True

    def _following(self, timer: Timer) -> Timer | None:
        """What waits after ``timer`` was taken; None if nothing does."""
        return None if timer.rate is None else replace(timer, due=self._next_due(timer, timer.rate))

    def _next_due(self, timer: Timer, rate: float) -> float:
        """A fixed grid; callbacks that were missed are caught up."""
        return timer.due + rate
