"""Wrong frameworks, clause 10.4.2: values that are set, published and cancelled otherwise, and connections that cannot be had."""

from __future__ import annotations

from collections.abc import Mapping

from ucm_cts.adapters.contract.data_types import AnyType, Datum
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.methods import alters, does_only_if, refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import SHARED, Base, breaks
from ucm_cts.adapters.mutants.python.variants.shared_data import publishes_again, readers_disagree
from ucm_cts.adapters.reference.python.connectors import COMM_ERROR, INTERNAL_ERROR, OK, AnyLink
from ucm_cts.adapters.reference.python.port_links import End
from ucm_cts.adapters.reference.python.shared_data import Published, SharedDataLink

Link = SharedDataLink


@breaks(
    "R-10.4.2-01",
    clauses=SHARED,
    also=(
        "R-10.4-04",
        "R-10.4.2.2-02",
        "R-10.4.2.2-06",
        "R-10.4.2.2-09",
        "R-10.4.2.2-12",
        "R-10.4.2.2-17",
        "R-10.4.2-05",
    ),
)
class hears_the_first_writer_only(Link):
    """What other writers than the first one publish is lost, and gives ok."""

    def publish(self, end: End) -> str:
        first = next(one for one in self.ends if one.kind.side == "writer")
        return super().publish(end) if end is first else OK


@breaks("R-10.4.2-04", "R-10.4.2.2-16", clauses=SHARED, also=("R-10.4.2.2-03", "R-10.4.2.2-02"))
class publishes_the_first_write(Link):
    """Of several values that are set the first one is published, and there is a notification for each."""

    def write(self, end: End, value: Datum) -> str:
        self.__dict__.setdefault("writes", {}).setdefault(end, []).append(value)
        return super().write(end, self.__dict__["writes"][end][0])

    def cancel(self, end: End) -> str:
        self.__dict__.setdefault("writes", {}).pop(end, None)
        return super().cancel(end)

    def _send(self, value: Published) -> None:
        super()._send(value)
        for writes in self.__dict__["writes"].values():
            for _ in writes[1:]:
                for reader in [one for one in self.ends if one.kind.side == "reader"]:
                    self._notify(reader)
        self.__dict__["writes"].clear()


@breaks("R-10.4.2.2-16", clauses=SHARED)
class keeps_the_first_write(Link):
    """A value that is set does not replace one that was set and not published."""

    def write(self, end: End, value: Datum) -> str:
        return OK if end in self.pending else super().write(end, value)


@breaks("R-10.4.2.2-15", clauses=SHARED, also=("R-10.4.2.2-18", "R-10.4.2.2-09", "R-10.4.2.2-22", "R-10.4.2.2-07"))
class sends_when_it_writes(Link):
    """A value is sent as soon as it is set; readers are notified when it is published."""

    def write(self, end: End, value: Datum) -> str:
        code = super().write(end, value)
        with self.lock:
            for reader in [one for one in self.ends if one.kind.side == "reader"]:
                self._update(reader, Published(value))
        return code


@breaks(
    "R-10.4.2.2-17",
    clauses=SHARED,
    also=("R-10.4-04", "R-10.4.2.2-02", "R-10.4.2.2-06", "R-10.4.2-01", "R-10.4.2.2-09", "R-10.4.2.2-12"),
    readings={"publication": "before-return"},
)
class loses_the_second_publication(Link):
    """The second publication of a connection is lost, and gives ok."""

    count = 0

    def _send(self, value: Published) -> None:
        self.count += 1
        if self.count != 2:
            super()._send(value)


@breaks(
    "R-10.4.2.2-17",
    clauses=SHARED,
    also=("R-10.4-04", "R-10.4.2.2-06", "R-10.4.2.2-08", "R-10.4.2-01", "R-10.4.2.2-09", "R-10.4.2.2-12"),
    readings={"publication": "before-return"},
)
class updates_nobody_now_and_then(Link):
    """Of the third publication readers are only told."""

    count = 0

    def _send(self, value: Published) -> None:
        self.count += 1
        super()._send(value)

    def _update(self, reader: End, value: Published) -> None:
        if self.count != 3:
            super()._update(reader, value)


@replaces("cancel", "R-10.4.2.2-18", clauses=SHARED, also=("R-10.4.2.2-19", "R-10.4.2.2-03"))
def cancels_nothing(_self: Link, _end: End) -> str:
    """A value that was cancelled is published all the same."""
    return OK


@breaks("R-10.4.2.2-19", clauses=SHARED, also=("R-10.4.2.2-03",))
class notifies_of_nothing(Link):
    """A publication of nothing notifies the readers."""

    def publish(self, end: End) -> str:
        if end not in self.pending and not self.broken:
            for reader in [one for one in self.ends if one.kind.side == "reader"]:
                self._notify(reader)
        return super().publish(end)


@breaks("R-10.4.2.2-18", "R-10.4.2.2-19", clauses=SHARED, also=("R-10.4.2.2-03",))
class cancels_late(Link):
    """A cancellation has an effect after the next publication."""

    def cancel(self, end: End) -> str:
        self.__dict__.setdefault("late", set()).add(end)
        return OK

    def write(self, end: End, value: Datum) -> str:
        self.__dict__.setdefault("late", set()).discard(end)
        return super().write(end, value)


@breaks(
    "R-10.4.2.2-20",
    clauses=SHARED,
    also=("R-10.4.2.2-02", "R-10.4.2.2-06", "R-10.4.2.2-17", "R-10.4.2-04", "R-10.4.2.1-22"),
)
class writes_no_more_after_cancelling(Link):
    """A value that is set after a cancellation is lost, and gives ok."""

    def cancel(self, end: End) -> str:
        self.__dict__.setdefault("spent", set()).add(end)
        return super().cancel(end)

    def write(self, end: End, value: Datum) -> str:
        if end in self.__dict__.get("spent", ()):
            self.__dict__["spent"].discard(end)
            return OK
        return super().write(end, value)


@breaks("R-10.4.2.2-21", clauses=SHARED, also=("R-10.4.2.2-07", "R-10.4.2.1-22"))
class recalls_what_was_published(Link):
    """A cancellation without a value that is set takes the last publication back."""

    before: Published | None = None

    def _send(self, value: Published) -> None:
        self.before = self.current
        super()._send(value)

    def cancel(self, end: End) -> str:
        if end not in self.pending and self.before is not None:
            for view in self.views.values():
                view.current = self.before
        return super().cancel(end)


@breaks(
    "R-10.4.2.2-22", clauses=SHARED, also=("R-10.4.2.2-17", "R-10.4.2.2-15"), readings={"pending-value": "per-writer"}
)
class has_one_pending_value(Link):
    """Writers replace the values that other writers have set, against what is declared."""

    def write(self, end: End, value: Datum) -> str:
        code = super().write(end, value)
        for other in self.pending:
            self.pending[other] = Published(value)
        return code


@breaks(
    "R-10.4.2.2-22",
    clauses=SHARED,
    also=("R-10.4.2.2-02", "R-10.4.2.2-17", "R-10.4.2.2-06"),
    readings={"pending-value": "per-writer"},
)
class cancels_for_all(Link):
    """A cancellation takes the values of all writers, against what is declared."""

    def cancel(self, end: End) -> str:
        self.pending.clear()
        return super().cancel(end)


@breaks("R-10.4.2-05", clauses=SHARED, readings={"concurrent-publications": "agree", "pending-value": "per-writer"})
class disagrees_on_publications_at_once(readers_disagree):
    """Of two publications at once one reader keeps the first and the others the second, against what is declared."""


@breaks("R-10.4.2.2-03", clauses=SHARED, readings={"publish-twice": "nothing"})
class publishes_again_against_what_is_declared(publishes_again):
    """A second publication without a new value notifies the readers again, against what is declared."""


@breaks("R-10.4.2-04", clauses=SHARED, readings={"publish-twice": "again"})
class publishes_once_against_what_is_declared(Link):
    """A second publication without a new value does nothing, against what is declared."""


@alters("_copied", "R-10.4.2-06", clauses=SHARED, also=("R-10.4.2.2-15", "R-10.4.2.2-09", "R-10.4.2-08"))
def adds_seven_to_data(_self: Link, copied: list[Datum], *_: object) -> list[Datum]:
    """Numbers below ten thousand are read increased by seven."""
    return [value + 7 if type(value) is int and 0 < value < 10**4 else value for value in copied]


@alters("_copied", "R-10.4.2-08", clauses=SHARED)
def cuts_texts_of_data(_self: Link, copied: list[Datum], *_: object) -> list[Datum]:
    """Long texts lose their end."""
    return [value[:16] if isinstance(value, str) and " " in value else value for value in copied]


@alters("_copied", "R-10.4.2-08", clauses=SHARED)
def shortens_sequences_of_data(_self: Link, copied: list[Datum], *_: object) -> list[Datum]:
    """Sequences lose what follows the sixteenth element."""
    return [value[:16] if isinstance(value, list) else value for value in copied]


@breaks("R-10.4.2-07", clauses=SHARED, also=("R-10.4.2.2-03", "R-10.4.2.2-09"))
class publishes_everywhere(Link):
    """A publication reaches the readers of all connections."""

    def _send(self, value: Published) -> None:
        super()._send(value)
        for other in self.manager.extended_links:
            if isinstance(other, SharedDataLink) and other is not self:
                SharedDataLink._send(other, value)


@breaks("R-10.4.2-07", clauses=SHARED, also=("R-10.4.2.2-03",))
class notifies_everywhere(Link):
    """A publication notifies the readers of all connections."""

    def _send(self, value: Published) -> None:
        super()._send(value)
        for other in self.manager.extended_links:
            if isinstance(other, SharedDataLink) and other is not self:
                for reader in [one for one in other.ends if one.kind.side == "reader"]:
                    other._notify(reader)


@refuses_if("_check_room", "R-10.4.2.1-21", clauses=SHARED, also=("R-10.4.2-01",))
def has_room_for_one_writer(self: Link, end: End) -> bool:
    """A connection refuses a second writer."""
    return end.kind.side == "writer" and any(one.kind.side == "writer" for one in self.ends)


@refuses_if("_check_room", "R-10.4.2.1-21", clauses=SHARED, also=("R-10.4.2-02",))
def has_room_for_two_readers(self: Link, end: End) -> bool:
    """A connection refuses a third reader."""
    return end.kind.side == "reader" and sum(one.kind.side == "reader" for one in self.ends) > 1


@breaks("R-10.4.2.1-21", clauses=SHARED)
class has_no_shared_data(Base):
    """There is no shared-data connector."""

    def link_with_types(self, connector: str, types: Mapping[str, AnyType]) -> AnyLink:
        raise UcmError("no such connector")


@breaks("R-10.4.2.1-21", clauses=SHARED, also=("R-11.2.3-06",))
class does_not_start_readers(Base):
    """A container with a reader is not started."""

    def _check_startable(self) -> None:
        super()._check_startable()
        links = [link for link in self.manager.extended_links if isinstance(link, SharedDataLink)]
        if any(end.member in self.members.values() and end.kind.side == "reader" for k in links for end in k.ends):
            raise UcmError("a reader cannot be started")


@alters("publish", "R-10.4.2.1-22", clauses=SHARED, also=("R-10.4.2.1-23",))
def is_never_content_with_publications(_self: Link, code: str, *_: object) -> str:
    """A publication gives internal_error although it is carried out."""
    return INTERNAL_ERROR if code == OK else code


@alters("write", "R-10.4.2.1-22", clauses=SHARED)
def blames_the_transport_for_writes(_self: Link, _code: str, *_: object) -> str:
    """write_data gives comm_error."""
    return COMM_ERROR


@alters("freeze", "R-10.4.2.1-22", clauses=SHARED, also=("R-10.4.2.2-13",))
def gives_an_unknown_code_for_freezes(_self: Link, _code: str, *_: object) -> str:
    """freeze_data gives a code that is none of the three."""
    return "frozen"


@replaces("cancel", "R-10.4.2.1-22", clauses=SHARED)
def blames_the_transport_for_nothing(self: Link, end: End) -> str:
    """cancel_data gives comm_error when there is nothing to cancel."""
    is_idle = end not in self.pending
    code = SharedDataLink.cancel(self, end)
    return COMM_ERROR if is_idle and not self.broken else code


@breaks("R-10.4.2.1-23", clauses=SHARED)
class notices_no_fault_of_publications(Link):
    """A publication gives ok while the connection is broken, and is lost."""

    def publish(self, end: End) -> str:
        return OK if self.broken else super().publish(end)


@does_only_if("mend_link", "R-10.4.2.1-23", clauses=SHARED)
def keeps_shared_data_broken(_self: Link) -> bool:
    """A connection that was broken once stays so."""
    return False


@breaks("R-10.4.2.2-14", clauses=SHARED, also=("R-10.4.2.2-20", "R-10.4.2.2-11"))
class cannot_cancel(Link):
    """cancel_data raises an exception."""

    def cancel(self, end: End) -> str:
        raise UcmError("not supported")


@breaks(
    "R-10.4.2.2-02",
    clauses=SHARED,
    also=("R-10.4-04", "R-10.4.2.2-06", "R-10.4.2.2-17", "R-10.4.2-01", "R-10.4.2.2-12"),
)
class sends_nothing_after_a_restart(Base):
    """Publications are lost once the container was stopped and started again."""

    def stop(self) -> None:
        super().stop()
        for link in self.manager.extended_links:
            if isinstance(link, SharedDataLink):
                link.__dict__["_send"] = lambda value: None


@breaks("R-10.4.2.2-22", clauses=SHARED, also=("R-10.4.2.2-02",))
class has_one_value_for_a_component(Link):
    """Ports of one component that are writers set one value, and publish or cancel that."""

    def write(self, end: End, value: Datum) -> str:
        return super().write(self._first_port(end), value)

    def publish(self, end: End) -> str:
        return super().publish(self._first_port(end))

    def cancel(self, end: End) -> str:
        return super().cancel(self._first_port(end))

    def _first_port(self, end: End) -> End:
        return next(one for one in self.ends if one.member is end.member and one.kind.side == "writer")
