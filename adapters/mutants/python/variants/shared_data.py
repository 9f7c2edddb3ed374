"""Conformant frameworks, clause 10.4.2: what the text leaves open about shared data."""

from __future__ import annotations

import threading

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.data_values import a_value
from ucm_cts.adapters.contract.platform_interfaces import NOTIFY
from ucm_cts.adapters.contract.platform_interfaces import SHARED as TYPE
from ucm_cts.adapters.mutants.python.registry import SHARED, variant_of
from ucm_cts.adapters.reference.python.connectors import INTERNAL_ERROR, OK
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.port_links import End
from ucm_cts.adapters.reference.python.shared_data import Published, SharedDataLink, View

Link = SharedDataLink


@variant_of(
    *SHARED,
    readings={
        "pending-value": "per-writer",
        "publication": "before-return",
        "unpublished-read": "error",
        "publish-twice": "nothing",
        "notifications": "each",
        "frozen-notification": "at-once",
        "freeze-scope": "reader",
        "value-after-release": "latest",
        "nested-freeze": "flat",
        "concurrent-publications": "agree",
        "late-reader": "sees",
    },
)
class declares_its_shared_data(Link):
    """The reference framework, with all that it does declared."""


@variant_of(*SHARED, readings={"pending-value": "shared"})
class writers_share_a_value(Link):
    """All writers of a connection set one value."""

    def write(self, end: End, value: Datum) -> str:
        self.pending.clear()
        return super().write(end, value)

    def publish(self, end: End) -> str:
        for other in [one for one in self.pending if one is not end]:
            self.pending[end] = self.pending.pop(other)
        return super().publish(end)

    def cancel(self, end: End) -> str:
        self.pending.clear()
        return super().cancel(end)


@variant_of(*SHARED, readings={"publish-twice": "again"})
class publishes_again(Link):
    """A second publication without a new value sends the value again."""

    def publish(self, end: End) -> str:
        last = self.__dict__.setdefault("last", {})
        if end not in self.pending and end in last:
            self.pending[end] = last[end]
        elif end in self.pending:
            last[end] = self.pending[end]
        return super().publish(end)

    def cancel(self, end: End) -> str:
        self.__dict__.setdefault("last", {}).pop(end, None)
        return super().cancel(end)


@variant_of(*SHARED, readings={"unpublished-read": "ok"})
class reads_something_at_first(Link):
    """A read before the first publication gives a value of the type, and ok."""

    def read(self, end: End) -> list[Datum]:
        value, code = super().read(end)
        return [a_value(self.types[TYPE]), OK] if code == INTERNAL_ERROR else [value, code]


class Later(Link):
    """A publication reaches readers some milliseconds after it has returned, one after the other."""

    delay = 0.005

    def _update(self, reader: End, value: Published) -> None:
        self._view(reader)
        self.__dict__.setdefault("coming", {}).setdefault(reader, []).append(value)

    def _notify(self, reader: End) -> None:
        taker = reader.taker
        if taker is not None and not taker.entrance.is_open:
            self._arrive(reader)
        else:
            self._post(reader, lambda: self._bring(reader))

    def _bring(self, reader: End) -> None:
        threading.Event().wait(self.delay)
        with self.lock:
            self._arrive(reader)
        if reader.taker is not None:
            reader.taker.enter(NOTIFY, [])

    def _arrive(self, reader: End) -> None:
        coming = self.__dict__.get("coming", {}).get(reader, [])
        if coming:
            super()._update(reader, coming.pop(0))

    def _forget(self, end: End) -> None:
        self.__dict__.get("coming", {}).pop(end, None)
        super()._forget(end)


@variant_of(*SHARED, readings={"publication": "within"})
class publishes_in_a_while(Later):
    """Readers have a value, and are notified of it, some milliseconds after it was published."""


@variant_of(*SHARED, readings={"concurrent-publications": "free", "pending-value": "per-writer"})
class readers_disagree(Link):
    """Of two publications at once the last reader keeps the first one, and the others have the second one."""

    ongoing = 0
    first: Published | None = None

    def publish(self, end: End) -> str:
        self.ongoing += 1
        try:
            if len(self.pending) > 1:
                threading.Event().wait(0.05)
            return super().publish(end)
        finally:
            self.ongoing -= 1
            self.first = self.first if self.ongoing else None

    def _send(self, value: Published) -> None:
        super()._send(value)
        if self.first is not None:
            self._update([one for one in self.ends if one.kind.side == "reader"][-1], self.first)
        elif self.ongoing > 1:
            self.first = value


@variant_of(*SHARED, readings={"notifications": "coalesced"})
class coalesces_notifications(Link):
    """A reader is notified once of publications that follow each other within some milliseconds."""

    def _notify(self, reader: End) -> None:
        waiting = self.__dict__.setdefault("waiting", set())
        if reader in waiting or reader.taker is None or not reader.taker.entrance.is_open:
            return
        waiting.add(reader)
        self._post(reader, lambda: self._tell(reader))

    def _tell(self, reader: End) -> None:
        threading.Event().wait(0.02)
        with self.lock:
            self.__dict__["waiting"].discard(reader)
        taker = reader.taker
        if taker is not None and taker.entrance.is_open:
            taker.enter(NOTIFY, [])

    def _forget(self, end: End) -> None:
        self.__dict__.setdefault("waiting", set()).discard(end)
        super()._forget(end)


@variant_of(*SHARED, readings={"frozen-notification": "at-release"})
class notifies_at_release(Link):
    """A reader that is frozen is notified once, at its release, if it has missed something."""

    def _notify(self, reader: End) -> None:
        if not self._view(reader).frozen:
            super()._notify(reader)

    def release(self, end: End) -> str:
        missed = self._view(end).missed
        code = super().release(end)
        if missed is not None:
            super()._notify(end)
        return code


@variant_of(*SHARED, readings={"frozen-notification": "none"})
class notifies_no_frozen_reader(Link):
    """A reader is not notified of what is published while it is frozen."""

    def _notify(self, reader: End) -> None:
        if not self._view(reader).frozen:
            super()._notify(reader)


@variant_of(*SHARED, readings={"freeze-scope": "connection"})
class freezes_the_connection(Link):
    """A reader that is frozen holds the value of all readers; they get the last one when none is frozen any more."""

    def _send(self, value: Published) -> None:
        if not any(view.frozen for view in self.views.values()):
            super()._send(value)
        else:
            self.__dict__["held"] = value
            for reader in [one for one in self.ends if one.kind.side == "reader"]:
                self._notify(reader)

    def release(self, end: End) -> str:
        code = super().release(end)
        held = self.__dict__.get("held")
        with self.lock:
            if held is not None and not any(view.frozen for view in self.views.values()):
                self.__dict__["held"] = None
                self.current = held
                for reader in [one for one in self.ends if one.kind.side == "reader"]:
                    self._update(reader, held)
        return code

    def abandon(self, member: Member) -> None:
        self.__dict__["held"] = None
        super().abandon(member)


@variant_of(*SHARED, readings={"value-after-release": "next"})
class waits_for_the_next_publication(Link):
    """After its release a reader has what it had kept, until the next publication."""

    def release(self, end: End) -> str:
        self._view(end).missed = None
        return super().release(end)


@variant_of(*SHARED, readings={"nested-freeze": "counted"})
class counts_freezes(Link):
    """A reader is frozen until it was released as many times as it was frozen."""

    def freeze(self, end: End) -> str:
        depths = self.__dict__.setdefault("depths", {})
        depths[end] = depths.get(end, 0) + 1
        return super().freeze(end)

    def release(self, end: End) -> str:
        depths = self.__dict__.setdefault("depths", {})
        depths[end] = max(depths.get(end, 0) - 1, 0)
        return OK if depths[end] else super().release(end)

    def _forget(self, end: End) -> None:
        self.__dict__.setdefault("depths", {}).pop(end, None)
        super()._forget(end)


@variant_of(*SHARED, readings={"nested-freeze": "refused"})
class refuses_a_second_freeze(Link):
    """A second freeze gives internal_error, and so does a release without one."""

    def freeze(self, end: End) -> str:
        return INTERNAL_ERROR if self._view(end).frozen else super().freeze(end)

    def release(self, end: End) -> str:
        return super().release(end) if self._view(end).frozen else INTERNAL_ERROR


@variant_of(*SHARED, readings={"late-reader": "empty"})
class shows_late_readers_nothing(Link):
    """A reader has a value when something is published after its start."""

    def _view(self, end: End) -> View:
        return self.views.setdefault(end, View())

    def _update(self, reader: End, value: Published) -> None:
        if reader.taker is not None and reader.taker.entrance.is_open:
            super()._update(reader, value)


@variant_of(*SHARED)
class has_errors_for_nothing(Link):
    """What has nothing to do gives internal_error: to cancel or publish nothing, and to release what is not frozen."""

    def cancel(self, end: End) -> str:
        return super().cancel(end) if end in self.pending else INTERNAL_ERROR

    def publish(self, end: End) -> str:
        return super().publish(end) if end in self.pending or self.broken else INTERNAL_ERROR

    def release(self, end: End) -> str:
        return super().release(end) if self._view(end).frozen else INTERNAL_ERROR


@variant_of(*SHARED)
class keeps_freezes_over_a_stop(Link):
    """A stop changes nothing: neither a value that is set, nor a freeze, nor the value that is read."""

    def abandon(self, member: Member) -> None:
        """Nothing is dropped."""


@variant_of(*SHARED)
class forgets_all_at_a_stop(Link):
    """When one of its components is stopped a connection forgets what was published."""

    def abandon(self, member: Member) -> None:
        super().abandon(member)
        if any(end.member is member for end in self.ends):
            self.current = None
            self.views.clear()
