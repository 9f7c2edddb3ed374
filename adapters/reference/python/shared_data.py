"""The shared-data connector (10.4.2).

Each writer has a value of its own that it sets and has not published yet. Readers have the published value when ``publish_data``
returns, but for those that are frozen: they get the last one at their release. Each publication notifies each reader, on the
thread of its end. A value that was not published, and a freeze, end when their component is stopped.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ucm_cts.adapters.contract import platform_interfaces as platform
from ucm_cts.adapters.contract.data_types import AnyType, Datum
from ucm_cts.adapters.contract.data_values import a_value
from ucm_cts.adapters.contract.platform_interfaces import NOTIFY
from ucm_cts.adapters.reference.python.connectors import INTERNAL_ERROR, OK, UsesConnectors
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.port_links import End, PortLink


@dataclass(frozen=True)
class Published:
    """A value that was published."""

    value: Datum


@dataclass(eq=False)
class View:
    """What a reader reads; while it is frozen that stays, and ``missed`` is what it would read otherwise."""

    current: Published | None = None
    missed: Published | None = None
    frozen: bool = False


class SharedDataLink(PortLink):
    """A connection with a shared-data connector."""

    connector = platform.SHARED_DATA

    def __init__(self, manager: UsesConnectors, types: Mapping[str, AnyType]) -> None:
        super().__init__(manager, types)
        self.current: Published | None = None
        self.views: dict[End, View] = {}
        self.pending: dict[End, Published] = {}

    def abandon(self, member: Member) -> None:
        with self.lock:
            for end in [end for end in self.ends if end.member is member]:
                self._forget(end)

    def carry_out(self, end: End, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        """Of a writer or a reader."""
        match method:
            case platform.WRITE:
                return [self.write(end, *self._copied(arguments))]
            case platform.PUBLISH:
                return [self.publish(end)]
            case platform.CANCEL:
                return [self.cancel(end)]
            case platform.FREEZE:
                return [self.freeze(end)]
            case platform.RELEASE:
                return [self.release(end)]
            case _:
                return self._copied(self.read(end))

    # writers

    def write(self, end: End, value: Datum) -> str:
        """``write_data``."""
        with self.lock:
            self.pending[end] = Published(value)
        return OK

    def cancel(self, end: End) -> str:
        """``cancel_data``."""
        with self.lock:
            self.pending.pop(end, None)
        return OK

    def publish(self, end: End) -> str:
        """``publish_data``; without a value it does nothing."""
        if self.broken:
            return self._code_of_fault()
        with self.lock:
            value = self.pending.pop(end, None)
            if value is not None:
                self._send(value)
        return OK

    def _send(self, value: Published) -> None:
        """To all readers, which are told."""
        self.current = value
        for reader in [one for one in self.ends if one.kind.side == "reader"]:
            self._update(reader, value)
            self._notify(reader)

    def _update(self, reader: End, value: Published) -> None:
        view = self._view(reader)
        if view.frozen:
            view.missed = value
        else:
            view.current = value

    def _notify(self, reader: End) -> None:
        taker = reader.taker
        assert taker is not None
        self._post(reader, lambda: taker.enter(NOTIFY, []))

    # readers

    def read(self, end: End) -> list[Datum]:
        """``read_data``: value and code; before the first publication a value that means nothing."""
        with self.lock:
            value = self._view(end).current
        if value is None:
            return [a_value(self.types[platform.SHARED]), INTERNAL_ERROR]
        return [value.value, OK]

    def freeze(self, end: End) -> str:
        """``freeze_data``; a second one changes nothing."""
        with self.lock:
            self._view(end).frozen = True
        return OK

    def release(self, end: End) -> str:
        """``release_data``; without a freeze it changes nothing."""
        with self.lock:
            view = self._view(end)
            view.frozen = False
            view.current, view.missed = view.missed or view.current, None
        return OK

    # state

    def _view(self, end: End) -> View:
        """Of a reader; one that is new sees what was published last."""
        return self.views.setdefault(end, View(self.current))

    def _forget(self, end: End) -> None:
        self.views.pop(end, None)
        self.pending.pop(end, None)
