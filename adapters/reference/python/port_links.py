"""Connections with the connectors of 10.4, which join ports as a whole: their ends, and what comes to an end without being waited for."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass

from ucm_cts.adapters.contract import platform_interfaces as platform
from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract.data_types import AnyType, Datum
from ucm_cts.adapters.contract.platform_interfaces import CONNECTOR_PORTS, ConnectorPort, Element
from ucm_cts.adapters.reference.python.connectors import COMM_ERROR, INTERNAL_ERROR, AnyLink, Taker, UsesConnectors
from ucm_cts.adapters.reference.python.members import HasMembers, Member


@dataclass(eq=False)
class End:
    """A port of a component, attached to a connector port."""

    member: Member
    port: str
    kind: ConnectorPort
    taker: Taker | None = None

    def name_of(self, element: Element) -> str:
        """How the framework spells the name of that port element."""
        return f"{self.port}_{element.name}"


class ConnectorElement(pm.PortElementObject):
    """The port element of the connector that ``end`` requires."""

    def __init__(self, link: PortLink, end: End, methods: Sequence[str]) -> None:
        self.link, self.end, self.methods = link, end, methods

    def exchange(self, value: int) -> int:
        raise pm.UcmError("the port element has another interface")

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if method not in self.methods:
            raise pm.UcmError(f"the interface has no method {method!r}")
        return self.link.carry_out(self.end, method, arguments)


class PortLink(AnyLink):
    """A connection that joins ports. One concern a method, for connectors and variants to override."""

    connector = ""

    def __init__(self, manager: UsesConnectors, types: Mapping[str, AnyType]) -> None:
        super().__init__(manager)
        self.types = types
        self.interfaces = platform.interfaces_of(types)
        self.ends: list[End] = []
        self.lock = threading.Lock()

    # operations of the adapter

    def attach(self, role: str, container: HasMembers, comp_instance: int, port: str) -> None:
        with container._operation():
            member = container._find_member(comp_instance)
            kind = CONNECTOR_PORTS.get(role)
            if kind is None or kind.connector != self.connector:
                raise pm.BadParameter(f"the connector has no port {role!r}")
            end = End(member, port, kind)
            container._check_configuring()
            self._check_elements(end)
            self._check_room(end)
            self._add(end)

    def detach(self, container: HasMembers, comp_instance: int, port: str) -> None:
        with container._operation():
            member = container._find_member(comp_instance)
            ends = [end for end in self.ends if (end.member, end.port) == (member, port)]
            if not ends:
                raise pm.NotFound(f"{port!r} of component {comp_instance} is no end of this connection")
            container._check_configuring()
            for end in ends:
                self._leave(end)
                for connection in container._connections_from(member):
                    if isinstance(connection.target, ConnectorElement) and connection.target.end is end:
                        container._undo(connection)

    def leave(self, member: Member) -> None:
        for end in [end for end in self.ends if end.member is member]:
            self._leave(end)

    # ends

    def _check_elements(self, end: End) -> None:
        for element in end.kind.elements:
            name, implementation = end.name_of(element), end.member.implementation
            if name not in (implementation.provides if element.provided else implementation.requires):
                raise pm.NotFound(f"no port element {name!r}")
            if implementation.interfaces.get(name) != self.interfaces[element.interface]:
                raise pm.BadParameter(f"{name!r} has another interface than the connection")
            if not element.provided and end.member.container._is_connected(end.member, name):
                raise pm.UcmError(f"{name!r} is connected already")

    def _check_room(self, end: End) -> None:
        """Raises ``UcmError`` if the connection has no room for it."""

    def _add(self, end: End) -> None:
        if end.kind.provided is not None:
            end.taker = Taker(end.member, end.name_of(end.kind.provided))
            self.takers.append(end.taker)
        self.ends.append(end)
        if end.kind.required is not None:
            methods = tuple(self.interfaces[end.kind.required.interface].methods)
            element = ConnectorElement(self, end, methods)
            end.member.container._connect_to(end.member, end.name_of(end.kind.required), element)

    def _leave(self, end: End) -> None:
        self.ends.remove(end)
        if end.taker is not None:
            self.remove(end.taker)

    # what happens

    def carry_out(self, end: End, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        """A component calls ``method`` of the port element that it requires of the connector at ``end``."""
        raise NotImplementedError

    def _code_of_fault(self) -> str:
        return COMM_ERROR if self.broken == "transport" else INTERNAL_ERROR

    def _post(self, end: End, work: Callable[[], object]) -> None:
        """Do ``work`` on the thread of ``end``, after what was posted before."""
        taker = end.taker
        assert taker is not None
        with taker.lock:
            if taker.entrance.is_open:
                taker.messages.put(work)
                if taker.thread is None:
                    taker.thread = threading.Thread(target=self._work, args=(taker,), daemon=True)
                    taker.thread.start()

    def _work(self, taker: Taker) -> None:
        while (work := taker.messages.get()) is not None:
            with suppress(Exception):  # nobody waits for it
                work()
