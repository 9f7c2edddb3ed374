"""The request-response connector (10.4.1).

A connection has one server. Requests of synchronous clients to a synchronous server are calls of it; all others get a number,
which client and server know them by, until they are answered. What a component gets without waiting for it comes on the thread
of its end, one after the other. A request that is open when its client or server is stopped is dropped.
"""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field

from ucm_cts.adapters.contract import platform_interfaces as platform
from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract.data_types import AnyType, Datum
from ucm_cts.adapters.contract.data_values import a_value
from ucm_cts.adapters.contract.platform_interfaces import CONNECTOR_PORTS, REQUEST, RESPONSE, ConnectorPort, Element
from ucm_cts.adapters.reference.python.connectors import (
    COMM_ERROR,
    INTERNAL_ERROR,
    OK,
    AnyLink,
    Taker,
    UsesConnectors,
)
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


@dataclass(eq=False)
class OpenRequest:
    """A request that waits for its ``response``; ``given`` is set when it has it, or when it will never have it."""

    number: int
    client: End
    given: threading.Event = field(default_factory=threading.Event)
    response: Datum | None = None


class RequestElement(pm.PortElementObject):
    """The port element of the connector that ``end`` requires."""

    def __init__(self, link: RequestResponseLink, end: End, method: str) -> None:
        self.link, self.end, self.method = link, end, method

    def exchange(self, value: int) -> int:
        raise pm.UcmError("the port element has another interface")

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if method != self.method:
            raise pm.UcmError(f"the interface has no method {method!r}")
        return self.link.send(self.end, arguments)


class RequestResponseLink(AnyLink):
    """A connection with a request-response connector. One concern a method, for variants to override."""

    def __init__(self, manager: UsesConnectors, types: Mapping[str, AnyType]) -> None:
        super().__init__(manager)
        self.types = types
        self.interfaces = platform.interfaces_of(types)
        self.ends: list[End] = []
        self.requests: dict[int, OpenRequest] = {}
        self.numbers = itertools.count(1)
        self.lock = threading.Lock()

    # operations of the adapter

    def attach(self, role: str, container: HasMembers, comp_instance: int, port: str) -> None:
        with container._operation():
            member = container._find_member(comp_instance)
            kind = CONNECTOR_PORTS.get(role)
            if kind is None or kind.connector != platform.REQUEST_RESPONSE:
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
                    if isinstance(connection.target, RequestElement) and connection.target.end is end:
                        container._undo(connection)

    def abandon(self, member: Member) -> None:
        for request in list(self.requests.values()):
            if request.client.member is member or self._server_is(member):
                self._drop(request)

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
        if end.kind.side == "server" and self._server() is not None:
            raise pm.UcmError("the connection has a server already")

    def _add(self, end: End) -> None:
        if end.kind.provided is not None:
            end.taker = Taker(end.member, end.name_of(end.kind.provided))
            self.takers.append(end.taker)
        self.ends.append(end)
        if end.kind.required is not None:
            method = REQUEST if end.kind.side == "client" else RESPONSE
            element = RequestElement(self, end, method)
            end.member.container._connect_to(end.member, end.name_of(end.kind.required), element)

    def _leave(self, end: End) -> None:
        self.ends.remove(end)
        if end.taker is not None:
            self.remove(end.taker)

    def _server(self) -> End | None:
        return next((end for end in self.ends if end.kind.side == "server"), None)

    def _server_is(self, member: Member) -> bool:
        server = self._server()
        return server is not None and server.member is member

    # requests

    def send(self, end: End, arguments: Sequence[Datum]) -> Sequence[Datum]:
        """Carry out the call of a client, or of an asynchronous server."""
        if end.kind.side == "server":
            return [self._respond(*arguments)]
        if end.kind.provided is None:
            return self._request_and_wait(end, arguments[0])
        return self._request(end, arguments[0])

    def _request_and_wait(self, client: End, request: Datum) -> list[Datum]:
        """Of a synchronous client: response and code."""
        nothing = a_value(self.types[platform.RESPONSE_DATA])
        if self.broken:
            return [nothing, self._code_of_fault()]
        server = self._server()
        if server is None or server.taker is None or not server.taker.entrance.is_open:
            return [nothing, INTERNAL_ERROR]
        if server.kind.required is None:
            return self._copied(server.taker.enter(REQUEST, self._copied([request])))
        opened = self._open(client)
        self._enter(server, opened, self._copied([request]))
        opened.given.wait()
        return [nothing, INTERNAL_ERROR] if opened.response is None else [opened.response, OK]

    def _request(self, client: End, request: Datum) -> list[Datum]:
        """Of an asynchronous client: identifier and code."""
        if self.broken:
            return [0, self._code_of_fault()]
        server = self._server()
        if server is None or server.taker is None or not server.taker.entrance.is_open:
            return [0, INTERNAL_ERROR]
        opened, copied = self._open(client), self._copied([request])
        if server.kind.required is not None:
            self._post(server, lambda: self._enter(server, opened, copied))
        else:
            self._post(server, lambda: self._enter_and_respond(server, copied, opened))
        return [opened.number, OK]

    def _enter(self, server: End, opened: OpenRequest, request: list[Datum]) -> None:
        """Give a request to an asynchronous server. One that raises will not answer."""
        assert server.taker is not None
        try:
            server.taker.enter(REQUEST, [*request, opened.number])
        except Exception:
            self._drop(opened)
            raise

    def _enter_and_respond(self, server: End, request: list[Datum], opened: OpenRequest) -> None:
        """A synchronous server answers when its method returns."""
        assert server.taker is not None
        try:
            response, _ = server.taker.enter(REQUEST, request)
        except Exception:
            self._drop(opened)
            raise
        self._respond(response, opened.number)

    def _respond(self, response: Datum, number: Datum) -> str:
        """Give a response to the client that asked; returns the code for the server."""
        if self.broken:
            return self._code_of_fault()
        opened = self._close(number)
        if opened is None:
            return INTERNAL_ERROR
        (copied,) = self._copied([response])
        if opened.client.kind.provided is None:
            opened.response = copied
            opened.given.set()
        else:
            self._post(opened.client, lambda: self._call_back(opened, copied))
        return OK

    def _call_back(self, opened: OpenRequest, response: Datum) -> None:
        taker = opened.client.taker
        if taker is not None:
            taker.enter(RESPONSE, [response, opened.number])

    def _open(self, client: End) -> OpenRequest:
        with self.lock:
            opened = OpenRequest(self._number(client), client)
            self.requests[opened.number] = opened
            return opened

    def _number(self, client: End) -> int:
        return next(self.numbers) % 2**32

    def _close(self, number: Datum) -> OpenRequest | None:
        """The open request of that number, which is open no more."""
        with self.lock:
            return self.requests.pop(number, None) if isinstance(number, int) else None

    def _drop(self, request: OpenRequest) -> None:
        self._close(request.number)
        request.given.set()

    def _code_of_fault(self) -> str:
        return COMM_ERROR if self.broken == "transport" else INTERNAL_ERROR

    def _post(self, end: End, work: Callable[[], None]) -> None:
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


class UsesRequestResponse(UsesConnectors):
    """The part of a container that has to do with connectors of 10.4."""

    request_response_class: type[RequestResponseLink] = RequestResponseLink

    def link_with_types(self, connector: str, types: Mapping[str, AnyType]) -> AnyLink:
        """A connection without ends, with a connector of 10.4. Raises ``UcmError`` if there is no such connector."""
        with self._operation():
            if platform.connector_of(types) != connector or connector != platform.REQUEST_RESPONSE:
                raise pm.UcmError(f"no connector {connector!r} for {', '.join(types)}")
            link = self.request_response_class(self.manager, types)
            self.manager.extended_links.append(link)
            return link
