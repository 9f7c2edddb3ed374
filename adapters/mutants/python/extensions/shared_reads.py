"""Wrong frameworks, clause 10.4.2: readers that get other values than those published last."""

from __future__ import annotations

import threading
from collections.abc import Sequence

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.data_values import a_value
from ucm_cts.adapters.contract.platform_interfaces import READ
from ucm_cts.adapters.contract.platform_interfaces import SHARED as TYPE
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.registry import SHARED, breaks
from ucm_cts.adapters.reference.python.connectors import INTERNAL_ERROR, OK
from ucm_cts.adapters.reference.python.port_links import End
from ucm_cts.adapters.reference.python.shared_data import Published, SharedDataLink

Link = SharedDataLink


@breaks(
    "R-10.4-04",
    clauses=SHARED,
    also=(
        "R-10.4.2.2-12",
        "R-10.4.2.2-06",
        "R-10.4.2.2-08",
        "R-10.4.2.2-09",
        "R-10.4.2.2-10",
        "R-10.4.2.2-17",
        "R-10.4.2-05",
        "R-10.4.2-02",
    ),
)
class queues_publications(Link):
    """A reader reads one publication after the other, and the last one again and again."""

    def _update(self, reader: End, value: Published) -> None:
        if reader in self.__dict__.setdefault("unread", {}) and not self._view(reader).frozen:
            self.__dict__["unread"][reader].append(value)
        else:
            super()._update(reader, value)
            self.__dict__["unread"][reader] = []

    def read(self, end: End) -> list[Datum]:
        given = super().read(end)
        waiting = self.__dict__.setdefault("unread", {}).pop(end, [])
        if waiting:
            self._view(end).current = waiting[0]
            self.__dict__["unread"][end] = waiting[1:]
        return given


@breaks("R-10.4.2-08", clauses=SHARED)
class hands_out_its_own_value(Link):
    """What a reader does with the value that it got changes what it and others read."""

    def carry_out(self, end: End, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        return self.read(end) if method == READ else super().carry_out(end, method, arguments)


@breaks(
    "R-10.4.2-02",
    clauses=SHARED,
    also=("R-10.4.2.2-06", "R-10.4.2.2-08", "R-10.4.2.2-09", "R-10.4.2.2-12", "R-10.4.2-01", "R-10.4-04"),
)
class serves_the_first_reader_only(Link):
    """Readers that were attached after the first one are told of publications and never get them."""

    def read(self, end: End) -> list[Datum]:
        first = next(one for one in self.ends if one.kind.side == "reader")
        if end is first or not self.views.get(first):
            return super().read(end)
        value = self.__dict__.setdefault("early", {}).setdefault(end, self._view(end).current)
        return super().read(end) if value is None else [value.value, OK]


@breaks("R-10.4.2-03", clauses=SHARED, also=("R-10.4.2.2-07",))
class reads_once_a_publication(Link):
    """A second read of the same publication waits for the next one."""

    def read(self, end: End) -> list[Datum]:
        given = super().read(end)
        last = self.__dict__.setdefault("given", {})
        view = self._view(end)
        while view.current is not None and last.get(end) is view.current and not view.frozen and self._is_open(end):
            threading.Event().wait(0.01)
        last[end] = view.current
        return given

    def _is_open(self, end: End) -> bool:
        return end.taker is not None and end.taker.entrance.is_open


@breaks(
    "R-10.4.2.2-06",
    clauses=SHARED,
    also=("R-10.4.2.2-07", "R-10.4.2-03", "R-10.4.2-02", "R-10.4.2.2-17", "R-10.4.2.2-12", "R-10.4.2-01"),
    readings={"publication": "before-return"},
)
class gives_an_old_value_now_and_then(Link):
    """Every fourth read of a reader gives the value before the last one."""

    def _update(self, reader: End, value: Published) -> None:
        self.__dict__.setdefault("old", {})[reader] = self._view(reader).current
        super()._update(reader, value)

    def read(self, end: End) -> list[Datum]:
        counts = self.__dict__.setdefault("counts", {})
        counts[end] = counts.get(end, 0) + 1
        old = self.__dict__.setdefault("old", {}).get(end)
        if counts[end] % 4 == 0 and old is not None and not self._view(end).frozen:
            return [old.value, OK]
        return super().read(end)


@breaks("R-10.4.2.2-07", clauses=SHARED, also=("R-10.4.2-03", "R-10.4.2.1-22", "R-10.4.2.2-09"))
class reads_only_once(Link):
    """A value that was read is gone: the next read gives internal_error."""

    def read(self, end: End) -> list[Datum]:
        given = super().read(end)
        last = self.__dict__.setdefault("given", {})
        if given[1] == OK and last.get(end) == given[0] and not self._view(end).frozen:
            return [a_value(self.types[TYPE]), INTERNAL_ERROR]
        last[end] = given[0] if given[1] == OK else None
        return given


@breaks(
    "R-10.4.2.2-07",
    clauses=SHARED,
    also=(
        "R-10.4.2-03",
        "R-10.4.2-02",
        "R-10.4.2.2-06",
        "R-10.4.2-05",
        "R-10.4.2.2-17",
        "R-10.4.2.2-12",
        "R-10.4.2-01",
    ),
)
class forgets_what_was_read(Link):
    """What was read twice becomes the value before."""

    def _update(self, reader: End, value: Published) -> None:
        self.__dict__.setdefault("old", {})[reader] = self._view(reader).current
        self.__dict__.setdefault("reads", {})[reader] = 0
        super()._update(reader, value)

    def read(self, end: End) -> list[Datum]:
        reads = self.__dict__.setdefault("reads", {})
        reads[end] = reads.get(end, 0) + 1
        old = self.__dict__.setdefault("old", {}).get(end)
        if reads[end] > 1 and old is not None and not self._view(end).frozen:
            return [old.value, OK]
        return super().read(end)


@breaks("R-10.4.2.2-15", clauses=SHARED, also=("R-10.4.2.2-09", "R-10.4.2-02"))
class reads_what_its_writer_has_set(Link):
    """A component that is a writer, too, reads what it has set and not published."""

    def read(self, end: End) -> list[Datum]:
        own = [value for writer, value in self.pending.items() if writer.member is end.member]
        return [own[0].value, OK] if own else super().read(end)


@breaks("R-10.4.2.2-01", clauses=SHARED, also=("R-10.4.2.2-12",))
class cannot_release(Link):
    """release_data raises an exception."""

    def release(self, end: End) -> str:
        raise UcmError("not supported")


@breaks("R-10.4.2.1-22", clauses=SHARED, also=("R-10.4.2.2-07",))
class reads_with_an_unknown_code(Link):
    """read_data gives a code that is none of the three."""

    def read(self, end: End) -> list[Datum]:
        value, code = super().read(end)
        return [value, "fine" if code == OK else code]


@breaks("R-10.4.2-03", clauses=SHARED, readings={"unpublished-read": "ok"})
class reads_nothing_with_an_error(Link):
    """A read before the first publication gives internal_error, against what is declared."""
