"""Wrong frameworks, clause 10.4.1: requests that are lost or mixed up in one situation: many, at once, in callbacks, later."""

from __future__ import annotations

import threading
import time

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.mutants.python.registry import REQUESTS, breaks
from ucm_cts.adapters.reference.python.connectors import INTERNAL_ERROR, OK
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.port_links import End
from ucm_cts.adapters.reference.python.request_response import OpenRequest, RequestResponseLink

_MOMENT = 0.001
_ANSWERED = ("R-10.4.1.2-03", "R-10.4.1.2-07", "R-10.4.1.2-10", "R-10.4.1.2-11")


@breaks("R-10.4.1.2-12", clauses=REQUESTS, also=_ANSWERED)
class numbers_requests_by_a_byte(RequestResponseLink):
    """The 257th open request has the identifier of the first, and its place."""

    def _number(self, client: End) -> int:
        return super()._number(client) % 2**8


@breaks("R-10.4.1.2-14", clauses=REQUESTS)
class sends_eight_open_requests(RequestResponseLink):
    """A client that has eight open requests gets ok for a further one, which is not sent."""

    def _request(self, client: End, request: Datum) -> list[Datum]:
        is_full = not self.broken and sum(one.client is client for one in self.requests.values()) >= 8
        return [self._number(client), OK] if is_full else super()._request(client, request)


@breaks("R-10.4.1.2-15", clauses=REQUESTS)
class lets_one_client_wait(RequestResponseLink):
    """While a synchronous client waits for an asynchronous server, the request of another one is not sent."""

    def _request_and_wait(self, client: End, request: Datum) -> list[Datum]:
        server = self._server()
        if server is None or server.kind.required is None:
            return super()._request_and_wait(client, request)
        with self.__dict__.setdefault("one at a time", threading.Lock()):
            return super()._request_and_wait(client, request)


@breaks("R-10.4.1.2-01", clauses=REQUESTS, also=_ANSWERED)
class mixes_up_requests_made_at_once(RequestResponseLink):
    """A request that follows at once is given to an asynchronous server in place of the one before."""

    def _enter(self, server: End, opened: OpenRequest, request: list[Datum]) -> None:
        self.__dict__["latest request"] = request
        time.sleep(_MOMENT)
        super()._enter(server, opened, self.__dict__["latest request"])


@breaks("R-10.4.1.2-10", clauses=REQUESTS, also=_ANSWERED)
class mixes_up_responses_given_at_once(RequestResponseLink):
    """A response that follows at once is given to a client in place of the one before."""

    def _respond(self, response: Datum, number: Datum) -> str:
        self.__dict__["latest response"] = response
        time.sleep(_MOMENT)
        return super()._respond(self.__dict__["latest response"], number)


@breaks("R-10.4.1.2-11", clauses=REQUESTS, also=_ANSWERED)
class forgets_requests_of_callbacks(RequestResponseLink):
    """What a client asks in the callback of a response is never answered."""

    def _call_back(self, opened: OpenRequest, response: Datum) -> None:
        self.__dict__["calling back"] = threading.get_ident()
        super()._call_back(opened, response)
        self.__dict__["calling back"] = None

    def _open(self, client: End) -> OpenRequest:
        opened = super()._open(client)
        if self.__dict__.get("calling back") == threading.get_ident():
            self._close(opened.number)
        return opened


@breaks("R-10.4.1.2-11", clauses=REQUESTS, also=_ANSWERED)
class forgets_old_requests(RequestResponseLink):
    """A request that is open for two seconds cannot be answered any more."""

    def _open(self, client: End) -> OpenRequest:
        opened = super()._open(client)
        self.__dict__.setdefault("made", {})[opened.number] = time.monotonic()
        return opened

    def _respond(self, response: Datum, number: Datum) -> str:
        if time.monotonic() - self.__dict__.get("made", {}).get(number, time.monotonic()) < 2:
            return super()._respond(response, number)
        self._close(number)
        return INTERNAL_ERROR


@breaks("R-10.4.1.2-11", clauses=REQUESTS, also=(*_ANSWERED, "R-10.4.1.2-02", "R-11.2.3-03", "R-11.2.3-04"))
class answers_in_two_phases(RequestResponseLink):
    """When an asynchronous server has been stopped twice, its responses are refused."""

    def abandon(self, member: Member) -> None:
        if self._server_is(member):
            self.__dict__["stops"] = self.__dict__.get("stops", 0) + 1
        super().abandon(member)

    def _respond(self, response: Datum, number: Datum) -> str:
        return super()._respond(response, number) if self.__dict__.get("stops", 0) < 2 else INTERNAL_ERROR


@breaks("R-10.4.1.1-34", clauses=REQUESTS, readings={"request-code": "passed"})
class drops_codes_against_what_is_declared(RequestResponseLink):
    """A synchronous client gets ok, whatever code its server gives; it is declared that codes are passed on."""

    def _request_and_wait(self, client: End, request: Datum) -> list[Datum]:
        response, code = super()._request_and_wait(client, request)
        server = self._server()
        is_served = server is not None and server.taker is not None and server.taker.entrance.is_open
        return [response, OK if is_served and not self.broken else code]
