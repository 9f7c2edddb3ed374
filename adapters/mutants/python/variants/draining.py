"""Conformant variants in which calls meet a stop: it waits for those in progress (stop-drain = wait), or they are refused."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import PortElementObject, UcmError
from ucm_cts.adapters.mutants.python.registry import CONTAINER, POLICIES, Base, GivesOutProxies, Proxy, variant_of
from ucm_cts.adapters.reference.python.members import Failures, Member


class _Inside:
    """The threads that are inside one component."""

    def __init__(self) -> None:
        self._threads: list[int] = []
        self._change = threading.Condition()

    @contextmanager
    def entered(self) -> Iterator[None]:
        """One call of the calling thread."""
        with self._change:
            self._threads.append(threading.get_ident())
        try:
            yield
        finally:
            with self._change:
                self._threads.remove(threading.get_ident())
                self._change.notify_all()

    def wait_until_left(self) -> None:
        """Wait until no other thread is inside."""
        own = threading.get_ident()
        with self._change:
            self._change.wait_for(lambda: all(thread == own for thread in self._threads))


class _Counted(Proxy):
    """Calls are known as long as they are inside the component."""

    def __init__(self, target: PortElementObject, member: Member) -> None:
        super().__init__(target, member)
        self.inside: _Inside = _of(member)

    def exchange(self, value: int) -> int:
        with self.inside.entered():
            return super().exchange(value)

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        with self.inside.entered():
            return super().call(method, arguments)


def _of(member: Member) -> _Inside:
    return member.__dict__.setdefault("inside", _Inside())  # type: ignore[no-any-return]


@variant_of(*CONTAINER, readings={"stop-drain": "wait"})
class waits_for_calls_at_stop(Base):
    """stop returns when the calls in progress have ended; calls that come from the thread that stops are not waited for."""

    def _reference_to(self, member: Member, port: str) -> PortElementObject | None:
        element = super()._reference_to(member, port)
        if element is None:
            return None
        known = member.__dict__.setdefault("counted", {})
        counted = known.get(port)
        if counted is None or counted.target is not element:
            counted = known[port] = _Counted(element, member)
        return counted  # type: ignore[no-any-return]

    def _shut_down_started(self, failures: Failures) -> None:
        stopped = tuple(self.started)
        super()._shut_down_started(failures)
        for member in stopped:
            _of(member).wait_until_left()


class _Closed(Proxy):
    def exchange(self, value: int) -> int:
        if self.member.container.__dict__.get("is_stopping"):
            raise UcmError("the container is being stopped")
        return super().exchange(value)


@variant_of(*CONTAINER, *POLICIES)
class serves_no_call_once_stop_is_called(GivesOutProxies):
    """Calls of the test that come while a stop is in progress are refused, also before on_shutdown."""

    proxy = _Closed

    def stop(self) -> None:
        self.__dict__["is_stopping"] = True
        time.sleep(0.05)
        try:
            super().stop()
        finally:
            self.__dict__["is_stopping"] = False
