"""Conformant frameworks that read the unclear places of 10.4.1 in other ways."""

from __future__ import annotations

import functools
import itertools
import threading
import time
from collections.abc import Callable
from typing import Any

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.platform_interfaces import RESPONSE
from ucm_cts.adapters.mutants.python.methods import refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import REQUESTS, variant_of
from ucm_cts.adapters.reference.python.connectors import INTERNAL_ERROR, OK, Taker
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.port_links import End
from ucm_cts.adapters.reference.python.request_response import OpenRequest, RequestResponseLink

Link = RequestResponseLink


@variant_of(*REQUESTS, readings={"mixed-clients": "mixed", "mixed-pairings": "all", "repeated-answer": "dropped"})
class declares_what_it_does(Link):
    """As the reference framework, and declares so."""


@refuses_if("_check_room", clauses=REQUESTS, readings={"mixed-clients": "one-kind"})
def takes_clients_of_one_kind(self: Link, end: End) -> bool:
    """A connection has clients of one kind."""
    clients = [one for one in self.ends if one.kind.side == "client"]
    return end.kind.side == "client" and any(one.kind is not end.kind for one in clients)


@refuses_if("_check_room", clauses=REQUESTS, readings={"mixed-pairings": "same-kind", "mixed-clients": "one-kind"})
def takes_ends_of_one_kind(self: Link, end: End) -> bool:
    """All ends of a connection are of one kind."""
    others = [one for one in self.ends if (len(one.kind.elements) == 1) != (len(end.kind.elements) == 1)]
    return bool(others) and not (end.kind.side == "server" and any(o.kind.side == "server" for o in others))


@variant_of(*REQUESTS, readings={"request-return": "taken"})
class returns_when_the_server_did(Link):
    """The request of an asynchronous client comes back when the server's method has."""

    def _post(self, end: End, work: Callable[[], object]) -> None:
        if end.kind.side == "server":
            try:
                work()
            except Exception:  # noqa: BLE001 - the server's, which its client does not get
                return
        else:
            super()._post(end, work)


@variant_of(*REQUESTS)
class refuses_a_ninth_open_request(Link):
    """A client that has eight open requests gets internal_error for a further one."""

    def _request(self, client: End, request: Datum) -> list[Datum]:
        is_full = not self.broken and sum(one.client is client for one in self.requests.values()) >= 8
        return [0, INTERNAL_ERROR] if is_full else super()._request(client, request)


@variant_of(*REQUESTS, readings={"request-ids": "translated"})
class has_numbers_of_its_own_for_servers(Link):
    """Client and server know a request by different numbers."""

    def _enter(self, server: End, opened: OpenRequest, request: list[Datum]) -> None:
        assert server.taker is not None
        try:
            server.taker.enter("request", [*request, opened.number + 100])
        except Exception:
            self._drop(opened)
            raise

    def _respond(self, response: Datum, number: Datum) -> str:
        server = self._server()
        is_translated = server is not None and server.kind.required is not None
        own = number - 100 if is_translated and isinstance(number, int) else number
        return super()._respond(response, own)


@variant_of(*REQUESTS, readings={"response-order": "unordered"})
class calls_back_on_threads_of_their_own(Link):
    """Responses come on threads of their own, the later ones first where they can."""

    def _post(self, end: End, work: Callable[[], object]) -> None:
        if end.kind.side == "server":
            super()._post(end, work)
            return
        waiting: list[Callable[[], object]] = self.__dict__.setdefault("waiting", [])
        waiting.append(work)
        timer = threading.Timer(0.02, self._call_back_last)
        timer.daemon = True
        timer.start()

    def _call_back_last(self) -> None:
        try:
            self.__dict__["waiting"].pop()()
        except Exception:  # noqa: BLE001 - the client's
            return


@variant_of(*REQUESTS, readings={"response-order": "unordered"})
class serves_the_latest_request_first(Link):
    """Of requests that wait for the server the latest is served first."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.waiting: list[Callable[[], object]] = []

    def _post(self, end: End, work: Callable[[], object]) -> None:
        if end.kind.side == "server":
            self.waiting.append(work)
            super()._post(end, self._serve_latest)
        else:
            super()._post(end, work)

    def _serve_latest(self) -> None:
        time.sleep(0.01)  # until there are several
        self.waiting.pop()()


@replaces("_respond", clauses=REQUESTS, readings={"unknown-id": "ignored"})
def ignores_unknown_numbers(self: Link, response: Datum, number: Datum) -> str:
    """A response with a number that is not open gives ok, and goes nowhere."""
    code = Link._respond(self, response, number)
    return code if self.broken or code != INTERNAL_ERROR else OK


@variant_of(*REQUESTS, readings={"repeated-answer": "delivered"})
class delivers_second_answers(Link):
    """A second response to a request comes to its client, too."""

    def _close(self, number: Datum) -> OpenRequest | None:
        opened = super()._close(number)
        answered: dict[object, OpenRequest] = self.__dict__.setdefault("answered", {})
        if opened is not None:
            answered[number] = opened
            return opened
        again = answered.get(number)
        return again if again is not None and again.client.kind.provided is not None else None


@variant_of(*REQUESTS, readings={"request-code": "dropped"})
class drops_the_servers_code(Link):
    """A synchronous client gets ok whatever code its server gave."""

    def _request_and_wait(self, client: End, request: Datum) -> list[Datum]:
        server = self._server()
        given = super()._request_and_wait(client, request)
        was_served = not self.broken and server is not None and server.kind.required is None
        is_open = server is not None and server.taker is not None and server.taker.entrance.is_open
        return [given[0], OK] if was_served and is_open else given


@variant_of(*REQUESTS, readings={"outstanding-at-stop": "kept"})
class keeps_requests_over_a_stop(Link):
    """Open requests of asynchronous clients stay open when all is stopped and started again."""

    def abandon(self, member: Member) -> None:
        kept = {n: one for n, one in self.requests.items() if one.client.kind.provided is not None}
        for request in [one for n, one in self.requests.items() if n not in kept]:
            if request.client.member is member or self._server_is(member):
                self._drop(request)

    def _call_back(self, opened: OpenRequest, response: Datum) -> None:
        taker: Taker | None = opened.client.taker
        if taker is not None and opened.client in self.ends:
            taker.enter(RESPONSE, [response, opened.number])


@variant_of(*REQUESTS)
class uses_numbers_again(Link):
    """The number of a request is the lowest one of which no request is open, and no response is on its way."""

    def _number(self, client: End) -> int:
        return next(number for number in itertools.count(1) if number not in self.requests and number not in self._held)

    def _respond(self, response: Datum, number: Datum) -> str:
        opened = self.requests.get(number) if isinstance(number, int) else None
        if opened is not None and opened.client.kind.provided is not None:
            self._held.add(opened.number)
        return super()._respond(response, number)

    def _call_back(self, opened: OpenRequest, response: Datum) -> None:
        super()._call_back(opened, response)
        self._held.discard(opened.number)

    @functools.cached_property
    def _held(self) -> set[int]:
        return set()
