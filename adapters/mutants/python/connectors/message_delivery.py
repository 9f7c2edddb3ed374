"""Wrong frameworks, clause 10.1.6: messages that come too often, too late, to the wrong receiver or not at all."""

from __future__ import annotations

import itertools
import queue
import threading
import time
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

from ucm_cts.adapters.contract.data_types import Datum, Interface, Structure
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.contract.scenario import MESSAGE_CONNECTOR
from ucm_cts.adapters.mutants.python.connectors.message_receivers import Synchronous
from ucm_cts.adapters.mutants.python.methods import does_only_if, refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import Base, breaks
from ucm_cts.adapters.reference.python.connectors import OK, Link, Taker
from ucm_cts.adapters.reference.python.members import Member

_MESSAGES = ("10.1.6",)

# who gets messages


@breaks("R-10.1.6.1-03", clauses=_MESSAGES)
class refuses_a_second_emitter(Link):
    """A connection refuses a second emitter."""

    has_emitter = False

    def _attach_sender(self, member: Member, port: str) -> None:
        if self.connector == MESSAGE_CONNECTOR and self.has_emitter:
            raise UcmError("there is an emitter already")
        super()._attach_sender(member, port)
        self.has_emitter = True


@breaks("R-10.1.6.1-03", "R-10.1.2-10", clauses=_MESSAGES)
class hears_one_thread_only(Link):
    """Messages pushed by other threads than the first one are lost, and push returns ok."""

    first: int | None = None

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        thread = threading.get_ident()
        self.first = self.first or thread
        return super()._emit(method, arguments) if thread == self.first else OK


@replaces("_check_room", "R-10.1.6.1-04", clauses=_MESSAGES)
def refuses_a_second_receiver(self: Link) -> None:
    """A connection refuses a second receiver."""
    if self.takers:
        raise UcmError("there is a receiver already")


@replaces("_emit", "R-10.1.6.1-04", clauses=_MESSAGES, also=("R-10.1.6.1-08", "R-10.1.2-10"))
def takes_receivers_in_turn(self: Link, method: str, arguments: Sequence[Datum]) -> str:
    """Each message reaches only one receiver, the next message the next receiver."""
    if self.broken:
        return Link._emit(self, method, arguments)
    turns = self.__dict__.setdefault("turns", itertools.count())
    ready = [taker for taker in self.takers if taker.entrance.is_open]
    if ready:
        self._post(ready[next(turns) % len(ready)], method, self._copied(arguments))
    return OK


@does_only_if("_post", "R-10.1.6.1-04", clauses=_MESSAGES, also=("R-10.1.6.1-08", "R-10.1.2-10", "R-10.1.6.1-03"))
def reaches_one_container_only(self: Link, taker: Taker, *_: object) -> bool:
    """Receivers in other containers than the first one get nothing."""
    return taker.member.container is self.takers[0].member.container


# how often, and whose


@replaces("_post", "R-10.1.6.1-05", clauses=_MESSAGES, also=("R-10.1.6.1-06",))  # no emitter pushed the second one
def delivers_twice(self: Link, taker: Taker, method: str, arguments: list[Datum]) -> None:
    """Every message arrives twice."""
    Link._post(self, taker, method, arguments)
    Link._post(self, taker, method, self._copied(arguments))


@breaks("R-10.1.6.1-05", clauses=_MESSAGES)
class repeats_the_last_message_after_a_restart(Base):
    """A receiver that is started again gets the last message again."""

    class link_class(Link):
        def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
            for taker in self.takers:
                if taker.__dict__.get("epoch", 0) != taker.__dict__.get("last epoch", 0) and "last" in taker.__dict__:
                    self._post(taker, method, [taker.__dict__["last"]])
                taker.__dict__["last epoch"] = taker.__dict__.get("epoch", 0)
                if taker.entrance.is_open:
                    taker.__dict__["last"] = self._copied(arguments)[0]
            return super()._emit(method, arguments)

    def _open_entrances(self, member: Member) -> None:
        super()._open_entrances(member)
        for _, taker in self._takers_of(member):
            taker.__dict__["epoch"] = taker.__dict__.get("epoch", 0) + 1


class _Mixing(Link):
    def is_mixed_with(self, other: Link) -> bool:
        return other.interface == self.interface

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        for other in self.manager.links:
            if other is not self and other.connector == self.connector and self.is_mixed_with(other):
                Link._emit(other, method, arguments)
        return super()._emit(method, arguments)


@breaks("R-10.1.6.1-06", clauses=_MESSAGES)
class mixes_connections_of_one_type(_Mixing):
    """Messages come to the receivers of all connections of their type."""


@replaces("is_mixed_with", "R-10.1.6.1-06", clauses=_MESSAGES)
def mixes_connections_of_different_types(self: _Mixing, other: Link) -> bool:
    """Messages come to the receivers of all connections of other types."""
    return other.interface != self.interface


@breaks("R-10.1.6.1-06", clauses=_MESSAGES, also=("R-10.1.1-07",))  # it may look like another message that was changed
class invents_messages(Link):
    """Each third message is followed by one that no emitter pushed."""

    def _post(self, taker: Taker, method: str, arguments: list[Datum]) -> None:
        super()._post(taker, method, arguments)
        taker.__dict__["posted"] = taker.__dict__.get("posted", 0) + 1
        if taker.__dict__["posted"] % 3 == 0:
            super()._post(taker, method, [_other(arguments[0])])


def _other(value: Datum) -> Datum:
    return [_other(one) for one in value] if isinstance(value, list) else 777 if isinstance(value, int) else "invented"


# in which order


@replaces("_deliver", "R-10.1.6.1-07", clauses=_MESSAGES, readings={"message-order": "fifo"})
def delivers_in_pairs_the_wrong_way_round(_self: Link, taker: Taker, method: str) -> None:
    """Of two messages pushed shortly after each other the second arrives first; fifo was declared."""
    while (message := taker.messages.get()) is not None:
        waiting = [message]
        with suppress(queue.Empty):
            following = taker.messages.get(timeout=0.01)
            if following is None:
                taker.messages.put(None)  # keep the end mark
            else:
                waiting.insert(0, following)
        for one in dict.fromkeys(map(str, waiting)):
            with suppress(Exception):
                taker.enter(method, [next(m for m in waiting if str(m) == one)])


# what the connector is


@breaks("R-10.1.6.1-10", clauses=_MESSAGES)
class has_no_message_connector(Link):
    """The framework has no message connector."""

    def __init__(self, manager: Any, connector: str, interface: Interface) -> None:
        if connector == MESSAGE_CONNECTOR:
            raise UcmError("no such connector")
        super().__init__(manager, connector, interface)


@refuses_if("_attach_sender", "R-10.1.6.1-10", clauses=_MESSAGES)
def joins_within_one_container_only(self: Link, member: Member, *_: object) -> bool:
    """Emitters must be in the container of the receivers."""
    return any(taker.member.container is not member.container for taker in self.takers)


@replaces("_check_startable", "R-10.1.6.1-10", clauses=_MESSAGES, also=("R-11.2.3-06", "R-11.2.3-10"))
def cannot_start_emitters(self: Base) -> None:
    """start takes the port element of an emitter for unconnected."""
    Base._check_startable(self)
    links = [link for link in self.manager.links if link.connector == MESSAGE_CONNECTOR]
    for member in self.members.values():
        if any(link._is_behind(c.target) for c in self._connections_from(member) for link in links):
            raise UcmError(f"component {member.id} is not connected")


@breaks("R-10.1.6.1-20", clauses=_MESSAGES, also=("R-10.1.1-18",))
class knows_one_type_of_messages(Link):
    """All message connections of a runtime have one type."""

    def __init__(self, manager: Any, connector: str, interface: Interface) -> None:
        others = [link for link in manager.links if link.connector == connector == MESSAGE_CONNECTOR]
        if any(other.interface != interface for other in others):
            raise UcmError("messages have another type here")
        super().__init__(manager, connector, interface)


@replaces("_emit", "R-10.1.6.1-20", "R-10.1.2-10", clauses=_MESSAGES)
def loses_structures(self: Link, method: str, arguments: Sequence[Datum]) -> str:
    """Messages that are structures are lost, and push returns ok."""
    is_structure = isinstance(self.interface.methods[method].parameters[0].of, Structure)
    return OK if is_structure else Link._emit(self, method, arguments)


# values


@breaks("R-10.1.6.1-19", clauses=_MESSAGES, also=("R-10.1.1-13",))
class delivers_the_emitters_buffer(Link):
    """Receivers get the emitter's own buffer, 5 ms later."""

    def _post(self, taker: Taker, method: str, arguments: list[Datum]) -> None:
        time.sleep(0)
        super()._post(taker, method, arguments)

    def _copied(self, values: Sequence[Datum]) -> list[Datum]:
        return values if isinstance(values, list) else list(values)

    def _deliver(self, taker: Taker, method: str) -> None:
        while (message := taker.messages.get()) is not None:
            time.sleep(0.005)
            with suppress(Exception):
                taker.enter(method, [message])


@replaces("_emit", "R-10.1.6.1-19", clauses=_MESSAGES, also=("R-10.1.1-13",))
def makes_one_copy_for_all_receivers(self: Synchronous, method: str, arguments: Sequence[Datum]) -> str:
    """Receivers share one copy of each message."""
    if self.broken:
        return Synchronous._emit(self, method, arguments)
    copy = self._copied(arguments)
    for taker in self.takers:
        if taker.entrance.is_open:
            self._hand_over(taker, method, copy)
    return OK


# bursts


@replaces("_post", "R-10.1.6.1-05", clauses=("10.1.2",))
def repeats_every_thousandth_message(self: Link, taker: Taker, method: str, arguments: list[Datum]) -> None:
    """Every thousandth message of a receiver comes twice."""
    Link._post(self, taker, method, arguments)
    taker.__dict__["posted"] = taker.__dict__.get("posted", 0) + 1
    if taker.__dict__["posted"] % 1000 == 0:
        Link._post(self, taker, method, arguments)


@replaces("_post", "R-10.1.6.1-06", clauses=("10.1.2",))
def counts_on_after_bursts(self: Link, taker: Taker, method: str, arguments: list[Datum]) -> None:
    """Every ten-thousandth message of a receiver is followed by one that no emitter pushed."""
    Link._post(self, taker, method, arguments)
    taker.__dict__["posted"] = taker.__dict__.get("posted", 0) + 1
    if taker.__dict__["posted"] % 10_000 == 0:
        Link._post(self, taker, method, [2**30 + taker.__dict__["posted"]])


@replaces("_post", "R-10.1.6.1-07", clauses=("10.1.2",), readings={"message-order": "fifo"})
def shuffles_bursts(self: Link, taker: Taker, method: str, arguments: list[Datum]) -> None:
    """Every hundredth message of a receiver arrives after the next one; fifo was declared."""
    taker.__dict__["posted"] = taker.__dict__.get("posted", 0) + 1
    if taker.__dict__["posted"] % 100 == 50:
        taker.__dict__["aside"] = arguments
        return
    Link._post(self, taker, method, arguments)
    if "aside" in taker.__dict__:
        Link._post(self, taker, method, taker.__dict__.pop("aside"))
