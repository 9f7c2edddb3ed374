"""The request-response connector (10.4.1).

A connection has one server. Requests of synchronous clients to a synchronous server are calls of it; all others get a number,
which client and server know them by, until they are answered. What a component gets without waiting for it comes on the thread
of its end, one after the other. A request that is open when its client or server is stopped is dropped.
"""

from __future__ import annotations

import itertools
import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from ucm_cts.adapters.contract import platform_interfaces as platform
from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract.data_types import AnyType, Datum
from ucm_cts.adapters.contract.data_values import a_value
from ucm_cts.adapters.contract.platform_interfaces import REQUEST, RESPONSE
from ucm_cts.adapters.reference.python.connectors import INTERNAL_ERROR, OK, UsesConnectors
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.port_links import End, PortLink


@dataclass(eq=False)
class OpenRequest:
    """A request that waits for its ``response``; ``given`` is set when it has it, or when it will never have it."""

    number: int
    client: End
    given: threading.Event = field(default_factory=threading.Event)
    response: Datum | None = None


class RequestResponseLink(PortLink):
    """A connection with a request-response connector."""

    connector = platform.REQUEST_RESPONSE

    def __init__(self, manager: UsesConnectors, types: Mapping[str, AnyType]) -> None:
        super().__init__(manager, types)
        self.requests: dict[int, OpenRequest] = {}
        self.numbers = itertools.count(1)

    def abandon(self, member: Member) -> None:
        for request in list(self.requests.values()):
            if request.client.member is member or self._server_is(member):
                self._drop(request)

    def _check_room(self, end: End) -> None:
        if end.kind.side == "server" and self._server() is not None:
            raise pm.UcmError("the connection has a server already")

    def _server(self) -> End | None:
        return next((end for end in self.ends if end.kind.side == "server"), None)

    def _server_is(self, member: Member) -> bool:
        server = self._server()
        return server is not None and server.member is member

    # requests

    def carry_out(self, end: End, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        """Of a client, or of an asynchronous server."""
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
