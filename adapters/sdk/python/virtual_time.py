"""Serves a Python adapter in virtual time: ``python -m ucm_cts.adapters.sdk.python.virtual_time ADAPTER``.

Waits take no time. While a thread of the process runs, its clocks nearly stand still; when all threads wait, they jump to the
earliest moment that one of them waits for. So what depends on time is exact, and does not depend on the machine.

Neither the adapter nor its framework is changed. What they take from the modules ``time``, ``threading`` and ``queue`` is
replaced before they are loaded: clocks, ``sleep``, locks and what is built from them, and threads. What waits elsewhere, for
example for a socket, or in threads of an extension module, is not known here and counts as running; ``datetime`` shows real time.
"""

from __future__ import annotations

import _thread
import functools
import heapq
import itertools
import os
import queue
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any, cast

READING = 10_000
"""Clocks go on by so many nanoseconds with each reading, so that a thread that waits by reading them comes to an end, and when a
released lock wakes a thread."""

_ACQUIRING = 1_000
"""Nanoseconds that it takes to get a lock that is free, or to find it held."""

_FEW = 1_000
"""So many waits are kept before those that are over are looked for."""

_NANOSECONDS = 1_000_000_000
_FOREVER = -1


class _Waiter:
    """One wait of one thread. ``is_over``: the thread may go on; ``is_late``: because its time has come. ``process``: where it waits."""

    __slots__ = ("is_late", "is_over", "process", "wake")

    def __init__(self) -> None:
        self.wake = _real_lock()
        self.wake.acquire()
        self.is_over = False
        self.is_late = False
        self.process = TIME.process


class VirtualTime:
    """The time of one process. ``now``: nanoseconds of its monotonic clock. ``process``: it is another one after a fork.

    Hold ``mutex`` to change anything. A finalizer may come while the thread holds it, so it is recursive.
    """

    def __init__(self) -> None:
        self.now = time.monotonic_ns()
        self.process = 0
        self.mutex = _real_recursive_lock()
        self._running = 1
        self._waking = 0
        self._order = itertools.count()
        self._moments: list[tuple[int, int, _Waiter]] = []
        self._pushed = 0

    def read(self) -> int:
        """The time now, in nanoseconds. Threads whose time has come go on; none passes until they do."""
        with self.mutex:
            self.pass_by(READING)
            return self.now

    def pass_by(self, nanoseconds: int) -> None:
        """So much time passes, unless a thread is about to go on. The caller holds the mutex."""
        if not self._waking:
            self.now += nanoseconds
            if self._moments and self._moments[0][0] <= self.now:
                self._wake_first()

    def sleep(self, seconds: float) -> None:
        """As ``time.sleep``."""
        if seconds < 0:
            raise ValueError("sleep length must be non-negative")
        waiter, nanoseconds = _Waiter(), max(_in_nanoseconds(seconds), READING)
        with self.mutex:
            self.park(waiter, self.now + nanoseconds)

    def park(self, waiter: _Waiter, moment: int | None) -> None:
        """The calling thread waits, until ``moment`` at most. It holds the mutex before and afterwards."""
        if moment is not None:
            heapq.heappush(self._moments, (moment, next(self._order), waiter))
            self._forget_what_is_over()
        self._running -= 1
        self._go_on()
        held = self.mutex._release_save()  # type: ignore[attr-defined]
        waiter.wake.acquire()
        self.mutex._acquire_restore(held)  # type: ignore[attr-defined]
        self._waking -= 1

    def wake(self, waiter: _Waiter) -> bool:
        """Let the thread go on that waits there; False if it has gone on already. The caller holds the mutex."""
        if waiter.is_over or waiter.process != self.process:
            return False
        waiter.is_over = True
        self._running += 1
        self._waking += 1
        waiter.wake.release()
        return True

    def begin_thread(self) -> None:
        """One more thread runs."""
        with self.mutex:
            self._running += 1

    def end_thread(self) -> None:
        """The calling thread ends."""
        with self.mutex:
            self._running -= 1
            self._go_on()

    def forget_threads(self) -> None:
        """In a forked process: only the calling thread is there."""
        self.process += 1
        self.mutex = _real_recursive_lock()
        self._running = 1
        self._waking = 0
        self._moments = []

    def _go_on(self) -> None:
        while self._running <= 0 and self._moments:  # less than none: a thread that has ended still finalizes
            self._wake_first()

    def _forget_what_is_over(self) -> None:
        """Drop waits that ended before their time, when most are such."""
        self._pushed += 1
        if self._pushed > max(_FEW, len(self._moments) // 2):
            self._pushed = 0
            self._moments = [one for one in self._moments if not one[2].is_over]
            heapq.heapify(self._moments)

    def _wake_first(self) -> None:
        moment, _, waiter = heapq.heappop(self._moments)
        if not waiter.is_over:
            self.now = max(self.now, moment)
            waiter.is_late = self.wake(waiter)


class _Lock:
    """As ``threading.Lock``; threads that wait try again in the order in which they came, when it is released."""

    __slots__ = ("__weakref__", "_is_held", "_waiters")

    def __init__(self) -> None:
        self._is_held = False
        self._waiters: deque[_Waiter] = deque()

    def acquire(self, blocking: bool = True, timeout: float = _FOREVER) -> bool:
        if not blocking and timeout != _FOREVER:
            raise ValueError("can't specify a timeout for a non-blocking call")
        if timeout < 0 and timeout != _FOREVER:
            raise ValueError("timeout value must be a non-negative number")
        nanoseconds = None if timeout == _FOREVER else _in_nanoseconds(timeout)
        may_wait = blocking and nanoseconds != 0
        waiter = _Waiter() if self._is_held and may_wait else None  # this may start finalizers
        moment: int | None = None
        while True:
            with TIME.mutex:
                if not self._is_held or not may_wait:
                    is_free, self._is_held = not self._is_held, True
                    TIME.pass_by(_ACQUIRING)
                    return is_free
                if waiter is not None:
                    if nanoseconds is not None and moment is None:
                        moment = TIME.now + nanoseconds
                    self._waiters.append(waiter)
                    TIME.park(waiter, moment)
                    if waiter.is_late:
                        with suppress(ValueError):  # a release has passed it over
                            self._waiters.remove(waiter)
                        return False
            waiter = _Waiter()

    def release(self) -> None:
        with TIME.mutex:
            if not self._is_held:
                raise RuntimeError("release unlocked lock")
            self._is_held = False
            if self._waiters:
                TIME.pass_by(READING)
            while self._waiters:
                if TIME.wake(self._waiters.popleft()):
                    return

    def locked(self) -> bool:
        return self._is_held

    def __enter__(self) -> bool:
        return self.acquire()

    def __exit__(self, *error: object) -> None:
        self.release()

    def _at_fork_reinit(self) -> None:
        self._is_held = False
        self._waiters.clear()


def _in_nanoseconds(seconds: float) -> int:
    """Raises ``OverflowError`` and ``ValueError`` for what is no time."""
    if seconds > threading.TIMEOUT_MAX:
        raise OverflowError("timestamp too large to convert to C _PyTime_t")
    return int(seconds * _NANOSECONDS)


_real_lock = _thread.allocate_lock
_real_recursive_lock = _thread.RLock
_real_join = threading.Thread.join
_ends = "_ucm_cts_end"

TIME = VirtualTime()


def _counted(start: Callable[..., Any]) -> Callable[..., Any]:
    """``start``, which starts a thread, so that the thread is counted while it runs."""

    def start_thread(function: Callable[..., Any], *others: Any, **named: Any) -> Any:
        end = _Lock()
        end.acquire()
        owner = getattr(function, "__self__", None)
        is_its_own = isinstance(owner, threading.Thread) and function == owner._bootstrap  # type: ignore[attr-defined]
        if is_its_own:
            setattr(owner, _ends, (TIME.process, end))

        def run(*given: Any, **more: Any) -> None:
            try:
                function(*given, **more)
            finally:
                end.release()
                TIME.end_thread()

        TIME.begin_thread()
        try:
            return start(run, *others, **named)
        except BaseException:
            TIME.end_thread()
            if is_its_own:
                delattr(owner, _ends)
            raise

    return start_thread


def _join(thread: threading.Thread, timeout: float | None = None) -> None:
    process, end = cast(tuple[int, _Lock | None], getattr(thread, _ends, (0, None)))
    if end is not None and process == TIME.process and thread is not threading.current_thread():
        if not end.acquire(timeout=_FOREVER if timeout is None else max(timeout, 0)):
            return
        end.release()
        timeout = None
    _real_join(thread, timeout)


def _replace(module: object, replacements: Mapping[str, object]) -> None:
    for name, replacement in replacements.items():
        if hasattr(module, name):
            setattr(module, name, replacement)


def install() -> None:
    """Put this process into virtual time, for good. Its only thread calls this before anything else is loaded."""
    offset = time.time_ns() - time.monotonic_ns()

    def seconds() -> float:
        return TIME.read() / _NANOSECONDS

    def calendar_ns() -> int:
        return TIME.read() + offset

    clocks = {"monotonic_ns": TIME.read, "perf_counter_ns": TIME.read, "monotonic": seconds, "perf_counter": seconds}
    calendar = {"time_ns": calendar_ns, "time": lambda: calendar_ns() / _NANOSECONDS}
    starts = {
        name: _counted(getattr(_thread, name))
        for name in ("start_new_thread", "start_joinable_thread")
        if hasattr(_thread, name)
    }
    _replace(time, {**clocks, **calendar, "sleep": TIME.sleep})
    _replace(_thread, {"allocate_lock": _Lock, "allocate": _Lock, "RLock": threading._PyRLock, **starts})  # type: ignore[attr-defined]
    _replace(_thread, {"start_new": starts["start_new_thread"]})
    _replace(functools, {"RLock": threading._PyRLock})  # type: ignore[attr-defined]
    _replace(threading, {"Lock": _Lock, "_allocate_lock": _Lock, "_CRLock": None, "_time": seconds})
    _replace(threading, {f"_{name}": start for name, start in starts.items()})
    _replace(threading.Thread, {"join": _join})
    _replace(queue, {"SimpleQueue": queue._PySimpleQueue, "time": seconds})  # type: ignore[attr-defined]
    os.register_at_fork(
        before=lambda: TIME.mutex.acquire(),
        after_in_parent=lambda: TIME.mutex.release(),
        after_in_child=TIME.forget_threads,
    )


if __name__ == "__main__":
    install()
    from ucm_cts.adapters.sdk.python.host import main

    main()
