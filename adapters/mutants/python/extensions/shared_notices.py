"""Wrong frameworks, clause 10.4.2: notifications that are missing, superfluous, early or out of place."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.platform_interfaces import NOTIFY
from ucm_cts.adapters.mutants.python.methods import does_only_if, replaces
from ucm_cts.adapters.mutants.python.registry import SHARED, breaks
from ucm_cts.adapters.reference.python.connectors import OK
from ucm_cts.adapters.reference.python.port_links import End
from ucm_cts.adapters.reference.python.shared_data import Published, SharedDataLink

Link = SharedDataLink


def readers_of(link: Link) -> list[End]:
    """The readers of a connection."""
    return [one for one in link.ends if one.kind.side == "reader"]


@does_only_if("_notify", "R-10.4.2.2-02", clauses=SHARED)
def notifies_the_first_reader(self: Link, reader: End) -> bool:
    """Readers that were attached after the first one are not notified."""
    return reader is readers_of(self)[0]


@breaks("R-10.4.2.2-02", clauses=SHARED)
class notifies_once(Link):
    """A reader is notified of the first publication only."""

    def _notify(self, reader: End) -> None:
        told = self.__dict__.setdefault("told", set())
        if reader not in told:
            super()._notify(reader)
        told.add(reader)


@breaks("R-10.4.2.2-02", clauses=SHARED, readings={"notifications": "each"})
class coalesces_against_what_is_declared(Link):
    """A notification is left out while another one waits, against what is declared."""

    def _notify(self, reader: End) -> None:
        last = self.__dict__.setdefault("last", {})
        now = time.monotonic()
        if now - last.get(reader, 0) > 0.01:
            super()._notify(reader)
        last[reader] = now


@breaks("R-10.4.2.2-02", clauses=SHARED, readings={"frozen-notification": "none"})
class notifies_frozen_readers(Link):
    """A reader that is frozen is notified, against what is declared."""


@replaces("_notify", "R-10.4.2.2-03", clauses=SHARED, also=("R-10.4.2-04", "R-10.4.2.2-19", "R-10.4.2-07"))
def notifies_twice(self: Link, reader: End) -> None:
    """Each publication notifies each reader twice."""
    SharedDataLink._notify(self, reader)
    SharedDataLink._notify(self, reader)


@breaks("R-10.4.2.2-03", clauses=SHARED, also=("R-10.4.2-04", "R-10.4.2-07", "R-10.4.2.2-19"))
class notifies_of_writes(Link):
    """Readers are notified when a value is set, too."""

    def write(self, end: End, value: object) -> str:
        for reader in readers_of(self):
            self._notify(reader)
        return super().write(end, value)  # type: ignore[arg-type]


@breaks("R-10.4.2.2-03", clauses=SHARED, also=("R-10.4.2-04", "R-10.4.2-07", "R-10.4.2.2-19"))
class notifies_of_cancellations(Link):
    """Readers are notified when a value is cancelled."""

    def cancel(self, end: End) -> str:
        for reader in readers_of(self):
            self._notify(reader)
        return super().cancel(end)


@breaks("R-10.4.2.2-04", clauses=SHARED, also=("R-10.4.2.2-03",))
class notifies_stopped_readers(Link):
    """Readers that are not operational are notified, too."""

    def _notify(self, reader: End) -> None:
        taker = reader.taker
        if taker is not None and not taker.entrance.is_open:
            element = reader.member.body.get_portElement(taker.port)
            if element is not None:
                element.call(NOTIFY, [])
        super()._notify(reader)


@breaks("R-10.4.2.2-05", clauses=SHARED, also=("R-10.1.3.2-13", "R-10.1.3.2-16", "R-10.1.3.2-10"))
class notifies_without_protection(Link):
    """A notification enters its reader whatever is executed there."""

    def _notify(self, reader: End) -> None:
        taker = reader.taker
        assert taker is not None
        element = taker.member.body.get_portElement(taker.port)
        if element is not None and taker.entrance.is_open:
            self._post(reader, lambda: element.call(NOTIFY, []))


@breaks(
    "R-10.4.2.2-08",
    clauses=SHARED,
    also=("R-10.4.2.2-06", "R-10.4.2.2-17", "R-10.4.2-02", "R-10.4.2-05", "R-10.4.2.1-22"),
)
class notifies_before_it_updates(Link):
    """Readers are notified twenty milliseconds before they have the value."""

    def _send(self, value: Published) -> None:
        self.current = value
        for reader in readers_of(self):
            self._view(reader)
            self._notify(reader)
        self.lock.release()
        time.sleep(0.02)
        self.lock.acquire()
        for reader in readers_of(self):
            self._update(reader, value)


@does_only_if("_notify", "R-10.4.2.2-02", clauses=SHARED)
def notifies_three_times_in_all(self: Link, _reader: End) -> bool:
    """After three notifications there are no more."""
    self.__dict__["count"] = self.__dict__.get("count", 0) + 1
    return bool(self.__dict__["count"] <= 3)


@breaks("R-10.4.2.2-02", clauses=SHARED)
class notifies_those_that_have_read(Link):
    """A reader that has not read yet is not notified."""

    def read(self, end: End) -> list[Datum]:
        self.__dict__.setdefault("have read", set()).add(end)
        return super().read(end)

    def _notify(self, reader: End) -> None:
        if reader in self.__dict__.get("have read", ()):
            super()._notify(reader)


@breaks("R-10.4.2.2-02", clauses=SHARED)
class tells_of_other_values_only(Link):
    """A value that is equal to the one before is not published."""

    def _send(self, value: Published) -> None:
        if self.current is None or self.current.value != value.value:
            super()._send(value)


@breaks("R-10.4.2.2-20", clauses=SHARED, also=("R-10.4.2.2-02",))
class takes_equal_values_once(Link):
    """A value that is equal to the one that was set before, and cancelled, is not set."""

    def write(self, end: End, value: Datum) -> str:
        latest = self.__dict__.setdefault("latest", {})
        before, latest[end] = latest.get(end), value
        return super().write(end, value) if before != value else OK


@breaks("R-10.4.2.2-02", clauses=SHARED)
class publishes_nothing_in_notifications(Link):
    """What a component publishes while it is notified is not sent."""

    def _post(self, end: End, work: Callable[[], object]) -> None:
        def notify() -> None:
            thread = threading.current_thread()
            thread.__dict__["is notified"] = True
            try:
                work()
            finally:
                thread.__dict__["is notified"] = False

        super()._post(end, notify)

    def publish(self, end: End) -> str:
        return OK if threading.current_thread().__dict__.get("is notified") else super().publish(end)
