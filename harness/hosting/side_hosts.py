"""Further hosts, which run scenarios ahead of the pipeline: those that mostly wait can wait side by side."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor
from contextlib import suppress

import msgspec

from ucm_cts.adapters.contract import messages as m
from ucm_cts.harness.hosting.host_watch import Limits
from ucm_cts.harness.hosting.hosts import Answer, Hosts
from ucm_cts.harness.hosting.locate import Endpoint


class SideHosts:
    """``number`` places, each with a host of its own, which are started when they are needed. Close it: nothing stays behind.

    ``welcome``: what every host must say of the product. The hosts share the processors, so scenarios that compute do not belong here.
    """

    def __init__(self, endpoint: Endpoint, limits: Limits, number: int, welcome: m.Welcome) -> None:
        self.number = number
        self._places = [Hosts(endpoint, limits, welcome, core) for core in range(1, number + 1)]
        self._free = list(range(number))
        self._lock = threading.Lock()
        self._pool = ThreadPoolExecutor(number, "side host")
        self._is_closed = False

    def submit(self, run: m.Run) -> Future[Answer]:
        """Run it as soon as a place is free. The future raises whatever keeps a host from answering."""
        return self._pool.submit(self._in_place, lambda hosts: next(hosts.run([run])))

    def submit_again(self, run: m.Run, one_core: bool, first: Sequence[m.Run]) -> Future[Answer]:
        """The same with ``run_again`` of ``Hosts``, not streamed."""
        return self._pool.submit(
            self._in_place, lambda hosts: hosts.run_again(run, one_core, stream=False, first=first)
        )

    @property
    def left_behind(self) -> Counter[str]:
        """As of ``Hosts``, of all places."""
        return sum((hosts.left_behind for hosts in self._places), Counter())

    def close(self) -> None:
        """End all hosts, those at work at once. What is not done by then will not be done."""
        self._is_closed = True
        self._pool.shutdown(wait=False, cancel_futures=True)
        with self._lock:
            busy = [hosts for place, hosts in enumerate(self._places) if place not in self._free]
        for hosts in busy:
            hosts.end_all()
        self._pool.shutdown()
        for hosts in self._places:
            with suppress(OSError):
                hosts.close()

    def _in_place(self, work: Callable[[Hosts], Answer]) -> Answer:
        with self._lock:
            if self._is_closed:
                raise CancelledError
            place = self._free.pop()
        try:
            answer = work(self._places[place])
        finally:
            with self._lock:
                self._free.append(place)
        if self._is_closed:  # it may have been killed
            raise CancelledError
        # no two hosts of all places, nor of the pipeline, have the same number
        return msgspec.structs.replace(answer, host=-(answer.host * self.number + place))
