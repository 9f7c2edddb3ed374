"""When components with an execution policy of 10.5 are executed: offsets, periods and least distances.

All times are seconds of the monotonic clock. Variants replace ``Pace`` and ``PacedExecutor``.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, TypeVar

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract import scenario as s

T = TypeVar("T")

_SECOND = 1_000_000
_PRIORITIES = range(256)


class Pace:
    """The instants at which one component may be executed in one operational phase.

    ``policy``: the policy of 10.5. ``origin``: when the phase began.
    """

    def __init__(self, policy: s.Policy, origin: float) -> None:
        self.policy = policy
        self.offset = policy.settings.get(s.OFFSET.get(policy.definition, ""), 0) / _SECOND
        self.period = policy.settings.get(s.PERIOD.get(policy.definition, ""), 0) / _SECOND
        self.first = origin + self.offset
        self.entered_at = -math.inf
        self.left_at = -math.inf

    def tick(self, number: int) -> float:
        """The instant ``number`` of the grid, from 0."""
        return self.first + number * self.period

    def tick_from(self, moment: float) -> int:
        """The number of the first instant that is not before ``moment``."""
        return max(0, math.ceil((moment - self.first) / self.period))

    def after_run(self, number: int) -> int:
        """The number of the instant for the run after that of instant ``number``: none is left out."""
        return number + 1

    def due(self, asked: float) -> float:
        """When an invocation that came at ``asked`` may be executed."""
        if self.policy.definition == s.SPORADIC_ACTIVE:
            return max(asked, self._since() + self.period)
        return self.tick(max(self._next_tick(), self.tick_from(asked)))

    def _since(self) -> float:
        """From when the least distance counts."""
        return self.entered_at

    def _next_tick(self) -> int:
        """One invocation for each instant."""
        if self.entered_at < self.first:
            return 0
        latest = math.floor((self.entered_at - self.first) / self.period)
        return latest + (2 if self.tick(latest + 1) <= self.entered_at else 1)  # the quotient is rounded


@dataclass(frozen=True)
class Invocation:
    """A call that waits: through which port element, since when, and what to do with it."""

    port: str
    asked: float
    work: Callable[[], None]
    fail: Callable[[BaseException], None]


class PacedExecutor:
    """The thread of a paced active component. It lives from one start to the next stop."""

    def __init__(self, pace_of: Callable[[str], Pace]) -> None:
        self._pace_of = pace_of
        self._changed = threading.Condition()
        self._waiting: list[Invocation] = []
        self._is_open = True
        self._running = threading.RLock()
        threading.Thread(target=self._serve, daemon=True).start()

    def execute(self, port: str, work: Callable[[], T]) -> T:
        """Have ``work`` done when it is due and wait for its outcome. Raises ``UcmError`` if the phase ends before."""
        outcome: Future[T] = Future()

        def call() -> None:
            try:
                outcome.set_result(work())
            except BaseException as error:  # noqa: BLE001 - the caller gets any exception
                outcome.set_exception(error)

        with self._changed:
            self._admit(Invocation(port, time.monotonic(), call, outcome.set_exception))
            self._changed.notify()
        return outcome.result()

    def end(self) -> None:
        """Execute no more; the callers that wait get ``UcmError``. An execution that has begun is waited for."""
        with self._changed:
            self._is_open = False
            refused, self._waiting = self._waiting, []
            self._changed.notify()
        for invocation in refused:
            invocation.fail(pm.UcmError("the component is being stopped"))
        with self._running:
            pass

    def _admit(self, invocation: Invocation) -> None:
        if not self._is_open:
            raise pm.UcmError("the component is not operational")
        self._waiting.append(invocation)

    def _choose(self) -> Invocation:
        """The one to execute next."""
        return min(self._waiting, key=self._due)

    def _due(self, invocation: Invocation) -> float:
        return self._pace_of(invocation.port).due(invocation.asked)

    def _serve(self) -> None:
        while invocation := self._next():
            with self._running:
                if self._is_open:
                    invocation.work()
                else:
                    invocation.fail(pm.UcmError("the component is being stopped"))

    def _next(self) -> Invocation | None:
        """The next invocation, when it is due; None at the end."""
        with self._changed:
            while self._is_open:
                if not self._waiting:
                    self._changed.wait()
                    continue
                first = self._choose()
                remaining = self._due(first) - time.monotonic()
                if remaining <= 0:
                    self._waiting.remove(first)
                    return first
                self._changed.wait(remaining)
        return None


def check_settings(policy: s.Policy) -> None:
    """Raises ``UcmError`` unless each parameter of a policy of 10.5 has a value that it can have."""
    tables: tuple[Any, ...] = (s.PERIOD, s.OFFSET, s.PRIORITY)
    due = {table[policy.definition] for table in tables if policy.definition in table}
    if set(policy.settings) != due:
        raise pm.UcmError(f"{policy.definition!r} needs values for {', '.join(sorted(due)) or 'no parameter'}")
    for name, value in policy.settings.items():
        if name == s.PRIORITY[policy.definition]:
            is_right = value in _PRIORITIES
        else:
            is_right = value > 0 or (value == 0 and name == s.OFFSET.get(policy.definition))
        if not is_right:
            raise pm.UcmError(f"{value} is no value of {name!r}")
