"""Further hosts, which run scenarios ahead of the pipeline: those that mostly wait can wait side by side."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import CancelledError, Future
from contextlib import suppress
from itertools import count
from queue import Empty, PriorityQueue

import msgspec

from ucm_cts.adapters.contract import messages as m
from ucm_cts.harness.hosting.host_watch import Limits
from ucm_cts.harness.hosting.hosts import Answer, Hosts
from ucm_cts.harness.hosting.locate import Endpoint
from ucm_cts.harness.hosting.pace import Pace

_Work = Callable[[Hosts], Answer]

_OVER, _DUE, _NOT_DUE = range(3)
"""In this order work is begun; ``_OVER`` ends a thread."""


class SideHosts:
    """``number`` places, each with a host of its own, which are started when they are needed. Close it: nothing stays behind.

    ``welcome``: what every host must say of the product. The hosts share the processors, and the ``pace`` of the product.
    ``wanted``: no more places than that are used; it may be raised.
    """

    def __init__(self, endpoint: Endpoint, limits: Limits, number: int, welcome: m.Welcome, pace: Pace) -> None:
        self.number = self.wanted = number
        self._places = [Hosts(endpoint, limits, welcome, core, pace) for core in range(1, number + 1)]
        self._threads: list[threading.Thread] = []
        self._work: PriorityQueue[tuple[int, int, Future[Answer], _Work]] = PriorityQueue()
        self._numbers = count()
        self._busy: set[int] = set()
        self._unfinished = 0
        self._lock = threading.Lock()
        self._is_closed = False

    def submit(self, run: m.Run, is_due: bool = True) -> Future[Answer]:
        """Run it as soon as a place is free; if it ``is_due``, before all that is not. The future raises whatever keeps a host from
        answering.
        """
        return self._submit(lambda hosts: next(hosts.run([run])), _DUE if is_due else _NOT_DUE)

    def submit_again(self, run: m.Run, one_core: bool, first: Sequence[m.Run]) -> Future[Answer]:
        """The same with ``run_again`` of ``Hosts``, not streamed."""
        return self._submit(lambda hosts: hosts.run_again(run, one_core, stream=False, first=first), _DUE)

    @property
    def left_behind(self) -> Counter[str]:
        """As of ``Hosts``, of all places."""
        return sum((hosts.left_behind for hosts in self._places), Counter())

    def close(self) -> None:
        """End all hosts, those at work at once. What is not done by then will not be done."""
        with self._lock:
            self._is_closed = True
            busy = tuple(self._busy)
        with suppress(Empty):
            while True:
                self._work.get_nowait()[2].cancel()
        for place in busy:
            self._places[place].end_all()
        for _ in self._threads:
            self._put(_OVER, Future(), _nothing)
        for thread in self._threads:
            thread.join()
        for hosts in self._places:
            with suppress(OSError):
                hosts.close()

    def _put(self, order: int, future: Future[Answer], work: _Work) -> None:
        self._work.put((order, next(self._numbers), future, work))

    def _submit(self, work: _Work, order: int) -> Future[Answer]:
        future: Future[Answer] = Future()
        with self._lock:
            if self._is_closed:
                future.cancel()
                return future
            self._unfinished += 1
            if self._unfinished > (place := len(self._threads)) and place < min(self.wanted, self.number):
                thread = threading.Thread(target=self._serve, args=(place,), name=f"side host {place}", daemon=True)
                self._threads.append(thread)
                thread.start()
            self._put(order, future, work)
        return future

    def _serve(self, place: int) -> None:
        while True:
            order, _, future, work = self._work.get()
            if order == _OVER:
                return
            if future.set_running_or_notify_cancel():
                try:
                    future.set_result(self._in_place(place, work))
                except BaseException as error:  # noqa: BLE001 - whoever waits for it gets it
                    future.set_exception(error)
            with self._lock:
                self._unfinished -= 1

    def _in_place(self, place: int, work: _Work) -> Answer:
        with self._lock:
            if self._is_closed:
                raise CancelledError
            self._busy.add(place)
        try:
            answer = work(self._places[place])
        finally:
            with self._lock:
                self._busy.discard(place)
        if self._is_closed:  # it may have been killed
            raise CancelledError
        # no two hosts of all places, nor of the pipeline, have the same number
        return msgspec.structs.replace(answer, host=-(answer.host * self.number + place))


def _nothing(hosts: Hosts) -> Answer:
    raise CancelledError
