"""The order of steps: which steps of a scenario run on which thread of a trace, and in which order."""

from __future__ import annotations

from array import array
from bisect import bisect_left
from collections.abc import Callable, Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Scenario


class StepOrder:
    """The steps of each worker, by number, and the threads on which they run. ``None`` is the main thread."""

    def __init__(self, scenario: Scenario) -> None:
        self.steps: dict[str | None, array[int]] = {None: array("q")}
        for number, step in enumerate(scenario.steps):
            self.steps.setdefault(step.thread, array("q")).append(number)
        self._scenario = scenario
        self._threads: dict[str | None, int] = {None: 0}
        self._next: dict[str | None, int] = {}
        self._passed: Sequence[int] = ()

    def begin(self, number: int, thread: int) -> str | None:
        """Note that step ``number`` begins on ``thread``. Returns why it cannot."""
        worker = self._scenario.steps[number].thread
        known = self._threads.get(worker)
        if known is not None and thread != known:
            if worker is None:
                return f"step {number} runs on thread {thread}, not on the scenario's own"
            return f"step {number} runs on thread {thread}, others of '{worker}' on thread {known}"
        if known is None and thread in self._threads.values():
            return f"step {number} of '{worker}' runs on thread {thread}, which is another one's"
        self._threads[worker] = thread
        first = self._next.get(worker, 0)
        steps = self.steps[worker]
        place = first if first < len(steps) and steps[first] == number else bisect_left(steps, number)
        if place < first:
            return f"step {number} comes after step {steps[first - 1]}"
        self._passed = steps[first:place] if place > first else ()
        self._next[worker] = place + 1
        return None

    @property
    def passed(self) -> Sequence[int]:
        """The steps between the one that began last and the one before it on the same thread."""
        return self._passed

    def next_open(self, gate: str, thread: int) -> int | None:
        """The step that can have opened ``gate`` on ``thread``, waits apart the next one there."""
        return self._next_step(lambda step: isinstance(step, s.OpenGate) and step.gate == gate, thread)

    def next_settle(self, worker: str, thread: int) -> int | None:
        """The step that can have waited for ``worker`` on ``thread``, waits apart the next one there."""
        return self._next_step(lambda step: isinstance(step, s.Settle) and step.worker == worker, thread)

    def _next_step(self, wanted: Callable[[s.Step], bool], thread: int) -> int | None:
        for worker in self.steps:
            if self._threads.get(worker, thread) != thread or (worker not in self._threads and thread == 0):
                continue
            steps = self.steps[worker]
            for place in range(self._next.get(worker, 0), len(steps)):
                number = steps[place]
                step = self._scenario.steps[number]
                if wanted(step):
                    return number
                if step.ends_with:
                    break
        return None
