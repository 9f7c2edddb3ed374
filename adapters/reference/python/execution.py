"""How one component is executed (10.1.3): its lock, the thread of an active component, the trigger of a self-executing one."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from typing import TypeVar

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.reference.python.pacing import Pace, PacedExecutor

PROTECTED = {s.SELF_EXECUTING, s.ACTIVE, s.PROTECTED_PASSIVE}
POLICIES = {*PROTECTED, s.UNPROTECTED_PASSIVE, *s.EXTENDED}
"""The execution policies of 10.1.3 and 10.5."""

T = TypeVar("T")


def is_active(policy: s.Policy) -> bool:
    """Has the container threads of its own behind the port that ``policy`` manages?"""
    return s.EXTENDED.get(policy.definition, policy.definition) == s.ACTIVE


class Execution:
    """How one component is executed: what its policies say, and the lock and threads it takes.

    ``definition``: the policy of 10.1.3 that holds, itself or because it is extended.
    ``extended``: the policies of 10.5.
    ``paces``: their instants in this operational phase, by port element.
    """

    def __init__(self, policies: Sequence[s.Policy]) -> None:
        applied = next((p.definition for p in policies if p.definition in POLICIES), "")
        self.definition = s.EXTENDED.get(applied, applied)
        self.managed = {policy.port for policy in policies if is_active(policy)}
        self.extended = [policy for policy in policies if policy.definition in s.EXTENDED]
        self.paces: dict[str | None, Pace] = {}
        self.paced_executor: PacedExecutor | None = None
        self.lock = threading.RLock()
        self.thread_inside: int | None = None
        self.executor = Executor()
        self.trigger: Trigger | None = None
        self.references: dict[str, pm.PortElementObject] = {}

    @property
    def is_inside(self) -> bool:
        """Is the calling thread in the component?"""
        return self.thread_inside == threading.get_ident()


class Executor:
    """The thread of an active component; it is started by the first call."""

    def __init__(self) -> None:
        self._calls: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._is_running = False
        self._is_closed = False

    def execute(self, work: Callable[[], T]) -> T:
        """Have ``work`` done by the thread and wait for its outcome, which may be an exception."""
        outcome: Future[T] = Future()

        def call() -> None:
            try:
                outcome.set_result(work())
            except BaseException as error:  # noqa: BLE001 - the caller gets any exception
                outcome.set_exception(error)

        with self._lock:
            if self._is_closed:
                raise pm.UcmError("the component has been removed")
            if not self._is_running:
                threading.Thread(target=self._serve, daemon=True).start()
                self._is_running = True
            self._calls.put(call)
        return outcome.result()

    def close(self) -> None:
        """End the thread, once the calls that are waiting have been served."""
        with self._lock:
            self._is_closed = True
            self._calls.put(None)

    def _serve(self) -> None:
        while call := self._calls.get():
            call()


class Trigger:
    """What makes a self-executing component run, from one start to the next stop."""

    def __init__(self) -> None:
        self.ended = threading.Event()
        self._running = threading.RLock()

    def run(self, run: Callable[[], None]) -> None:
        """Run, unless it has ended."""
        with self._running:
            if not self.ended.is_set():
                run()

    def end(self) -> None:
        """Run no more; a run that has begun is waited for."""
        self.ended.set()
        with self._running:
            pass
