"""Wrong frameworks, clause 10.4.2: freezes that hold too little, too much or too long."""

from __future__ import annotations

import threading

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import SHARED, breaks
from ucm_cts.adapters.reference.python.connectors import OK
from ucm_cts.adapters.reference.python.port_links import End
from ucm_cts.adapters.reference.python.shared_data import Published, SharedDataLink

Link = SharedDataLink


@replaces("freeze", "R-10.4.2.2-09", clauses=SHARED, also=("R-10.4.2.2-13",))
def freezes_nothing(_self: Link, _end: End) -> str:
    """freeze_data does nothing."""
    return OK


@breaks("R-10.4.2.2-09", clauses=SHARED, also=("R-10.4.2.2-13",))
class thaws_at_the_second_publication(Link):
    """A reader that is frozen misses one publication and gets the second one."""

    def _update(self, reader: End, value: Published) -> None:
        view = self._view(reader)
        if view.frozen and view.missed is not None:
            view.current = value
        super()._update(reader, value)


@breaks("R-10.4.2.2-09", clauses=SHARED)
class freezes_no_state_without_value(Link):
    """A reader that was frozen before the first publication gets it all the same."""

    def _update(self, reader: End, value: Published) -> None:
        view = self._view(reader)
        if view.frozen and view.current is None:
            view.current = value
        super()._update(reader, value)


@breaks(
    "R-10.4.2.2-10",
    clauses=SHARED,
    also=("R-10.4.2.2-12", "R-10.4.2.2-06", "R-10.4.2-05", "R-10.4.2.2-13", "R-10.4.2.2-09", "R-10.4.2-02"),
)
class freezes_all_readers(Link):
    """A freeze of one reader holds all of them, until it is released."""

    def freeze(self, end: End) -> str:
        for reader in [one for one in self.ends if one.kind.side == "reader"]:
            self._view(reader).frozen = True
        return OK

    def release(self, end: End) -> str:
        for reader in [one for one in self.ends if one.kind.side == "reader"]:
            super().release(reader)
        return OK


@breaks("R-10.4.2.2-10", clauses=SHARED, also=("R-10.4.2.2-09",))
class freezes_components(Link):
    """A freeze holds all ports of its component, until one of them is released."""

    def freeze(self, end: End) -> str:
        for reader in self._readers_of(end):
            self._view(reader).frozen = True
        return OK

    def release(self, end: End) -> str:
        for reader in self._readers_of(end):
            super().release(reader)
        return OK

    def _readers_of(self, end: End) -> list[End]:
        return [one for one in self.ends if one.kind.side == "reader" and one.member is end.member]


@breaks("R-10.4.2.2-06", clauses=SHARED, also=("R-10.4.2.2-07",))
class gets_again_what_it_missed(Link):
    """With each release a reader gets what it missed when it was frozen before."""

    def release(self, end: End) -> str:
        with self.lock:
            view = self._view(end)
            view.frozen = False
            view.current = view.missed or view.current
        return OK


@breaks("R-10.4.2.2-11", clauses=SHARED, also=("R-10.4.2.2-10", "R-10.4.2.2-14"))
class waits_for_readers(Link):
    """A publication waits until no reader is frozen."""

    def publish(self, end: End) -> str:
        while any(view.frozen for view in list(self.views.values())):
            threading.Event().wait(0.01)
        return super().publish(end)


@breaks("R-10.4.2.2-11", clauses=SHARED, also=("R-10.4.2.2-10", "R-10.4.2.1-22"))
class raises_at_frozen_readers(Link):
    """A publication raises an exception while a reader is frozen."""

    def publish(self, end: End) -> str:
        if any(view.frozen for view in self.views.values()):
            raise RuntimeError("a reader is frozen")
        return super().publish(end)


@breaks("R-10.4.2.2-12", clauses=SHARED, also=("R-10.4.2.2-13", "R-10.4.2-05", "R-10.4.2-02"))
class never_releases(Link):
    """A reader that was frozen once stays so."""

    def release(self, end: End) -> str:
        return OK


@breaks("R-10.4.2.2-12", clauses=SHARED, also=("R-10.4.2-05",))
class releases_to_the_first_missed(Link):
    """After its release a reader has the first publication that it missed."""

    def _update(self, reader: End, value: Published) -> None:
        view = self._view(reader)
        missed = view.missed
        super()._update(reader, value)
        if view.frozen and missed is not None:
            view.missed = missed


@breaks("R-10.4.2.2-12", clauses=SHARED, readings={"value-after-release": "latest", "publication": "before-return"})
class releases_to_the_next(Link):
    """After its release a reader waits for the next publication, against what is declared."""

    def release(self, end: End) -> str:
        self._view(end).missed = None
        return super().release(end)


@breaks("R-10.4.2.2-13", clauses=SHARED, also=("R-10.4.2.2-09",))
class freezes_once(Link):
    """A second freeze of the same reader, after its release, does nothing."""

    def freeze(self, end: End) -> str:
        spent = self.__dict__.setdefault("spent", set())
        if end in spent:
            return OK
        return super().freeze(end)

    def release(self, end: End) -> str:
        self.__dict__.setdefault("spent", set()).add(end)
        return super().release(end)


@breaks("R-10.4.2.2-13", clauses=SHARED, also=("R-10.4.2.2-09",))
class freezes_to_the_first_freeze(Link):
    """A reader that is frozen again reads what it had kept the first time."""

    def freeze(self, end: End) -> str:
        view = self._view(end)
        self.__dict__.setdefault("first", {}).setdefault(end, view.current)
        return super().freeze(end)

    def read(self, end: End) -> list[Datum]:
        first = self.__dict__.get("first", {}).get(end)
        if self._view(end).frozen and first is not None:
            return [first.value, OK]
        return super().read(end)


@breaks("R-10.4.2.1-22", clauses=SHARED, readings={"nested-freeze": "flat"})
class refuses_nested_freezes(Link):
    """A second freeze gives internal_error, against what is declared."""

    def freeze(self, end: End) -> str:
        was_frozen = self._view(end).frozen
        code = super().freeze(end)
        return "internal_error" if was_frozen else code
