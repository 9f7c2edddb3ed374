"""The connectors of 10.1.5 and 10.1.6, which join the port elements at the ends of a connection.

Every value is copied on its way. Only a broken transport loses values, and then the sender gets an error. Each receiver has a
queue of messages and a thread that delivers them one by one; a receiver that is not operational gets no messages. A component
that is being stopped finishes the calls in progress and accepts no others.
"""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract.data_types import Datum, Interface
from ucm_cts.adapters.contract.scenario import MESSAGE_CONNECTOR, SERVICE_CONNECTOR
from ucm_cts.adapters.reference.python.members import HasMembers, Member

OK, INTERNAL_ERROR, COMM_ERROR = "ok", "internal_error", "comm_error"
"""The return codes of 10.1.2."""

SENDERS = {SERVICE_CONNECTOR: "client", MESSAGE_CONNECTOR: "emitter"}
TAKERS = {SERVICE_CONNECTOR: "server", MESSAGE_CONNECTOR: "receiver"}


class Entrance:
    """The way into one provided port element: open while the component is operational."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._is_open = False
        self._inside = 0

    @property
    def is_open(self) -> bool:
        """Can calls enter now?"""
        return self._is_open

    def open(self) -> None:
        """Let calls in."""
        self._is_open = True

    def close(self) -> None:
        """Let no more calls in, and wait until those that are inside have left."""
        with self._changed:
            self._is_open = False
            self._changed.wait_for(lambda: not self._inside)

    def visit(self, work: Callable[[], Sequence[Datum]]) -> Sequence[Datum]:
        """Do ``work`` inside. Raises ``UcmError`` if the component is not operational."""
        with self._changed:
            if not self._is_open:
                raise pm.UcmError("the component is not operational")
            self._inside += 1
        try:
            return work()
        finally:
            with self._changed:
                self._inside -= 1
                self._changed.notify_all()


@dataclass(eq=False)
class Taker:
    """A provided port element at the end of a link: a server's or a receiver's."""

    member: Member
    port: str
    entrance: Entrance = field(default_factory=Entrance)
    messages: queue.SimpleQueue[Any] = field(default_factory=queue.SimpleQueue)
    thread: threading.Thread | None = None
    lock: threading.Lock = field(default_factory=threading.Lock)

    def enter(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        """Call the body, which may be protected."""

        def work() -> Sequence[Datum]:
            element = self.member.container._reference_to(self.member, self.port)
            if element is None:
                raise pm.UcmError(f"the body gives no port element {self.port!r}")
            return element.call(method, arguments)

        return self.entrance.visit(work)

    def close(self) -> None:
        """Accept no more calls and messages, and drop the messages that wait."""
        self.entrance.close()
        with self.lock:
            self.forget()
            thread, self.thread = self.thread, None
            if thread is not None:
                self.messages.put(None)
                thread.join()

    def forget(self) -> None:
        """Drop the messages that wait."""
        with suppress(queue.Empty):
            while True:
                self.messages.get_nowait()


class LinkElement(pm.PortElementObject):
    """The port element that a client or an emitter is connected to."""

    def __init__(self, link: Link) -> None:
        self.link = link

    def exchange(self, value: int) -> int:
        raise pm.UcmError("the port element has another interface")

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if method not in self.link.interface.methods:
            raise pm.UcmError(f"the interface has no method {method!r}")
        return self.link.send(method, arguments)


class AnyLink:
    """A connection and its connector, whichever that is: what all of them have."""

    def __init__(self, manager: UsesConnectors) -> None:
        self.manager = manager
        self.takers: list[Taker] = []
        self.broken = ""

    def break_link(self, where: str) -> None:
        self.broken = where

    def mend_link(self) -> None:
        self.broken = ""

    def abandon(self, member: Member) -> None:
        """``member`` is about to be stopped: end what it waits for, and what waits for it, in the connector."""

    def leave(self, member: Member) -> None:
        """``member`` is being removed."""
        for taker in [taker for taker in self.takers if taker.member is member]:
            self.remove(taker)

    def remove(self, taker: Taker) -> None:
        """Detach ``taker``."""
        self.takers.remove(taker)
        taker.close()

    def _copied(self, values: Sequence[Datum]) -> list[Datum]:
        return [_copy(value) for value in values]


class Link(AnyLink):
    """A connection of 10.1. One concern a method, for variants to override."""

    def __init__(self, manager: UsesConnectors, connector: str, interface: Interface) -> None:
        super().__init__(manager)
        self.connector = connector
        self.interface = interface

    # operations of the adapter

    def attach(self, role: str, container: HasMembers, comp_instance: int, port: str) -> None:
        with container._operation():
            member = container._find_member(comp_instance)
            if role == TAKERS[self.connector]:
                self._attach_taker(member, port)
            elif role == SENDERS[self.connector]:
                self._attach_sender(member, port)
            else:
                raise pm.BadParameter(f"{self.connector} has no role {role!r}")

    def detach(self, container: HasMembers, comp_instance: int, port: str) -> None:
        with container._operation():
            member = container._find_member(comp_instance)
            takers = [taker for taker in self.takers if (taker.member, taker.port) == (member, port)]
            senders = [c for c in container._connections_from(member) if c.port == port and self._is_behind(c.target)]
            if not (takers or senders):
                raise pm.NotFound(f"{port!r} of component {comp_instance} is no end of this connection")
            container._check_configuring()
            for taker in takers:
                self.remove(taker)
            for sender in senders:
                container._undo(sender)

    # ends

    def _attach_sender(self, member: Member, port: str) -> None:
        container = member.container
        if port not in member.implementation.requires:
            raise pm.NotFound(f"no required port element {port!r}")
        container._check_configuring()
        if container._is_connected(member, port):
            raise pm.UcmError(f"{port!r} is connected already")
        self._check_compatible(member, port)
        container._connect_to(member, port, LinkElement(self))

    def _attach_taker(self, member: Member, port: str) -> None:
        if port not in member.implementation.provides:
            raise pm.NotFound(f"no provided port element {port!r}")
        member.container._check_configuring()
        self._check_compatible(member, port)
        self._check_room()
        self.takers.append(Taker(member, port))

    def _check_compatible(self, member: Member, port: str) -> None:
        if member.implementation.interfaces.get(port) != self.interface:
            raise pm.BadParameter(f"{port!r} has another interface than the connection")

    def _check_room(self) -> None:
        if self.connector == SERVICE_CONNECTOR and self.takers:
            raise pm.UcmError("the connection has a server already")

    def _is_behind(self, target: pm.PortElementObject) -> bool:
        return isinstance(target, LinkElement) and target.link is self

    # calls and messages

    def send(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        """Carry out the call of a client or an emitter."""
        if self.connector == SERVICE_CONNECTOR:
            return self._request(method, arguments)
        return [self._emit(method, arguments)]

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if self.broken:
            raise pm.UcmError(f"the {self.broken} is broken")
        if not self.takers:
            raise pm.UcmError("there is no server")
        try:
            return self._copied(self.takers[0].enter(method, self._copied(arguments)))
        except pm.DeclaredException as error:
            raise pm.DeclaredException(error.name, self._copied(error.fields)) from None

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        if self.broken:
            return COMM_ERROR if self.broken == "transport" else INTERNAL_ERROR
        for taker in self.takers:
            if taker.entrance.is_open:
                self._post(taker, method, self._copied(arguments))
        return OK

    def _post(self, taker: Taker, method: str, arguments: list[Datum]) -> None:
        with taker.lock:
            if taker.entrance.is_open:
                taker.messages.put(arguments[0])
                if taker.thread is None:
                    taker.thread = threading.Thread(target=self._deliver, args=(taker, method), daemon=True)
                    taker.thread.start()

    def _deliver(self, taker: Taker, method: str) -> None:
        while (message := taker.messages.get()) is not None:
            with suppress(Exception):  # push has returned, so no caller gets the exception
                taker.enter(method, [message])


def _copy(value: Datum) -> Datum:
    return [_copy(one) for one in value] if isinstance(value, list) else value


class UsesConnectors(HasMembers):
    """The part of a container that has to do with connectors."""

    manager: UsesConnectors
    links: list[Link]
    """Those with a connector of 10.1. The manager keeps all connections with a connector."""

    extended_links: list[AnyLink]
    """Those with a connector of 10.4, likewise."""

    link_class: type[Link] = Link

    def link(self, connector: str, interface: Interface) -> Link:
        """A connection without ends, with a connector of that name. Raises ``UcmError`` if there is no such connector."""
        with self._operation():
            if connector not in SENDERS:
                raise pm.UcmError(f"no connector {connector!r}")
            link = self.link_class(self.manager, connector, interface)
            self.manager.links.append(link)
            return link

    def _takers_of(self, member: Member) -> list[tuple[Link, Taker]]:
        return [(link, taker) for link in self.manager.links for taker in link.takers if taker.member is member]

    def _extended_takers_of(self, member: Member) -> list[Taker]:
        return [taker for link in self.manager.extended_links for taker in link.takers if taker.member is member]

    def _open_entrances(self, member: Member) -> None:
        for _, taker in self._takers_of(member):
            taker.entrance.open()
        for taker in self._extended_takers_of(member):
            taker.entrance.open()

    def _close_entrances(self, member: Member) -> None:
        for link in self.manager.extended_links:
            link.abandon(member)
        for _, taker in self._takers_of(member):
            taker.close()
        for taker in self._extended_takers_of(member):
            taker.close()

    def _leave_links(self, member: Member) -> None:
        for link, taker in self._takers_of(member):
            link.remove(taker)
        for other in self.manager.extended_links:
            other.leave(member)
