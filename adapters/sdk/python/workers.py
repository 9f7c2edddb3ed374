"""Workers: the threads that a scenario names, and their states."""

from __future__ import annotations

import re
import threading
from collections import deque
from collections.abc import Callable
from time import monotonic, sleep  # an adapter may change what the module has, not these
from typing import Literal

from ucm_cts.adapters.sdk.python.seal import KeptClass

Task = Callable[[], None]

Where = Literal["done", "held", "blocked", "running"]

_SAMPLES = 5
"""How often a thread must be found asleep, without having been awake in between, to count as blocked."""

_BETWEEN_SAMPLES = 0.0005
"""Seconds. The sampling thread releases the interpreter's lock meanwhile, so that a thread that only waits for that lock wakes up."""

FAREWELL = 0.4
"""Seconds that workers have at least to end, in all: on a busy machine a thread may need longer than a short patience."""

_ASLEEP = re.compile(r"^State:\s+S.*^voluntary_ctxt_switches:\s+(\d+)", re.MULTILINE | re.DOTALL)


class _Worker:
    def __init__(self, name: str) -> None:
        self._tasks: deque[Task] = deque()
        self._changed = threading.Condition()
        self._busy = False
        self._quitting = False
        self.thread = threading.Thread(target=self._work, name=f"worker {name}", daemon=True)
        self.thread.start()

    def _work(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._tasks or self._quitting)
                if not self._tasks:
                    return
                task = self._tasks.popleft()
                self._busy = True
            task()
            with self._changed:
                self._busy = False
                self._changed.notify_all()

    def queue(self, task: Task) -> None:
        with self._changed:
            self._tasks.append(task)
            self._changed.notify_all()

    def wait_until_idle(self, seconds: float) -> bool:
        with self._changed:
            return self._changed.wait_for(lambda: not self._tasks and not self._busy, max(seconds, 0))

    def quit(self) -> None:
        with self._changed:
            self._quitting = True
            self._changed.notify_all()


class Workers(metaclass=KeptClass):
    """Threads by name, each made when its first task is queued, each doing its tasks in order.

    Tasks must not raise. ``patience`` is the longest wait in seconds.
    """

    def __init__(self, patience: float) -> None:
        self._patience = patience
        self._workers: dict[str, _Worker] = {}
        self._lock = threading.Lock()

    def queue(self, name: str, task: Task) -> None:
        """Give worker ``name`` one more task; returns at once."""
        with self._lock:
            if name not in self._workers:
                self._workers[name] = _Worker(name)
            self._workers[name].queue(task)

    def join(self, name: str) -> bool:
        """Wait until worker ``name``, if there is one, has done all it was given; False when patience runs out."""
        with self._lock:
            worker = self._workers.get(name)
        return worker is None or worker.wait_until_idle(self._patience)

    def settle(self, name: str, is_held: Callable[[threading.Thread], bool]) -> Where:
        """Wait until worker ``name`` is done, held or blocked by the operating system; ``running`` when patience runs out.

        Where the operating system does not report it, no worker is found to be blocked.
        """
        with self._lock:
            worker = self._workers.get(name)
        deadline = monotonic() + self._patience
        before, samples = None, 0
        while worker and not worker.wait_until_idle(0):
            if is_held(worker.thread):
                return "held"
            sleeps = _sleeps(worker.thread)
            samples = samples + 1 if sleeps is not None and sleeps == before else 1
            before = sleeps
            if before is not None and samples >= _SAMPLES:
                return "blocked"
            if monotonic() >= deadline:
                return "running"
            sleep(_BETWEEN_SAMPLES)
        return "done"

    def finish(self) -> tuple[str, ...]:
        """End all workers; returns the names of those that did not come back in time. Queue nothing afterwards."""
        deadline = monotonic() + max(self._patience, FAREWELL)
        stuck = []
        for name, worker in self._workers.items():
            worker.quit()
            if not worker.wait_until_idle(deadline - monotonic()):
                stuck.append(name)
        return tuple(stuck)


def _sleeps(thread: threading.Thread) -> int | None:
    """How often ``thread`` has gone to sleep, if it sleeps now; None if it does not, or it is unknown."""
    try:
        with open(f"/proc/self/task/{thread.native_id}/status") as stream:
            status = stream.read()
    except OSError:
        return None
    found = _ASLEEP.search(status)
    return int(found[1]) if found else None
