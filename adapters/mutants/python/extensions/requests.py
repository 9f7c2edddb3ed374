"""Wrong frameworks, clause 10.4.1: requests that are lost, doubled, altered or held up."""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.data_values import a_value
from ucm_cts.adapters.contract.platform_interfaces import REQUEST, RESPONSE_DATA
from ucm_cts.adapters.mutants.python.methods import alters, does_only_if, replaces
from ucm_cts.adapters.mutants.python.registry import REQUESTS, breaks
from ucm_cts.adapters.reference.python.connectors import COMM_ERROR, INTERNAL_ERROR, OK
from ucm_cts.adapters.reference.python.port_links import End
from ucm_cts.adapters.reference.python.request_response import OpenRequest, RequestResponseLink

Link = RequestResponseLink


@breaks("R-10.4.1.2-01", "R-10.4.1.2-06", clauses=REQUESTS, also=("R-10.4.1.2-04", "R-10.4.1.2-11"))
class doubles_requests(Link):
    """Each request enters the server twice."""

    def _request_and_wait(self, client: End, request: Datum) -> list[Datum]:
        server = self._server()
        if server is not None and server.kind.required is None and server.taker is not None and not self.broken:
            server.taker.enter(REQUEST, self._copied([request]))
        return super()._request_and_wait(client, request)

    def _enter(self, server: End, opened: OpenRequest, request: list[Datum]) -> None:
        super()._enter(server, opened, request)
        super()._enter(server, opened, request)


@breaks("R-10.4.1.2-06", clauses=REQUESTS)
class loses_the_first_request(Link):
    """The first request of asynchronous clients is lost, and gives ok."""

    is_lost = False

    def _enter(self, server: End, opened: OpenRequest, request: list[Datum]) -> None:
        if opened.client.kind.provided is None or self.is_lost:
            super()._enter(server, opened, request)
        self.is_lost = True


@breaks("R-10.4.1.2-01", "R-10.4.1.2-06", clauses=REQUESTS, also=("R-10.4.1.2-13", "R-10.4.1.2-10"))
class adds_seven_to_requests(Link):
    """Small numbers among requests reach the server increased by seven."""

    def carry_out(self, end: End, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        value = arguments[0]
        if end.kind.side == "client" and type(value) is int and 0 < value < 1000:
            return super().carry_out(end, method, [value + 7])
        return super().carry_out(end, method, arguments)


class KeepsBuffers(Link):
    """Does not copy the value that is remembered as ``sent``."""

    def _copied(self, values: Sequence[Datum]) -> list[Datum]:
        is_sent = len(values) == 1 and values[0] is self.__dict__.get("sent")
        return list(values) if is_sent else super()._copied(values)


@breaks("R-10.4.1.1-33", clauses=REQUESTS)
class keeps_the_clients_buffer(KeepsBuffers):
    """What an asynchronous client does with its request after the call reaches the server."""

    def _request(self, client: End, request: Datum) -> list[Datum]:
        self.__dict__["sent"] = request
        return super()._request(client, request)


@breaks("R-10.4.1.1-33", clauses=REQUESTS)
class truncates_texts(Link):
    """Texts among requests lose their last character."""

    def carry_out(self, end: End, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        value = arguments[0]
        if end.kind.side == "client" and isinstance(value, str) and len(value) > 4 and value.isalpha():
            return super().carry_out(end, method, [value[:-1]])
        return super().carry_out(end, method, arguments)


@breaks("R-10.4.1.2-02", clauses=REQUESTS, also=("R-10.4.1.2-03", "R-10.4.1.2-21"))
class does_not_wait_for_answers(Link):
    """A synchronous client gets an empty response, and ok, before its asynchronous server has answered."""

    def _request_and_wait(self, client: End, request: Datum) -> list[Datum]:
        server = self._server()
        if self.broken or server is None or server.kind.required is None:
            return super()._request_and_wait(client, request)
        opened = self._open(client)
        self._enter(server, opened, self._copied([request]))
        given = opened.given.is_set() and opened.response is not None
        return [opened.response if given else a_value(self.types[RESPONSE_DATA]), OK]  # type: ignore[list-item]


@breaks("R-10.4.1.2-05", clauses=REQUESTS, also=("R-10.4.1.2-14", "R-10.4.1.2-06"))
class waits_for_the_response(Link):
    """The request of an asynchronous client comes back when the server has answered."""

    def _request(self, client: End, request: Datum) -> list[Datum]:
        number, code = super()._request(client, request)
        opened = self.requests.get(number) if isinstance(number, int) else None
        if opened is not None:
            opened.given.wait()
        return [number, code]

    def _respond(self, response: Datum, number: Datum) -> str:
        opened = self.requests.get(number) if isinstance(number, int) else None
        code = super()._respond(response, number)
        if opened is not None:
            opened.given.set()
        return code


@breaks("R-10.4.1.2-05", clauses=REQUESTS, readings={"request-return": "sent"})
class waits_although_it_sends(Link):
    """An asynchronous client waits until the server's method returned, against what is declared."""

    def _request(self, client: End, request: Datum) -> list[Datum]:
        self.__dict__["waits"] = True
        return super()._request(client, request)

    def _post(self, end: End, work: object) -> None:
        if end.kind.side == "server":
            work()  # type: ignore[operator]
        else:
            super()._post(end, work)  # type: ignore[arg-type]


@breaks("R-10.4.1.2-14", clauses=REQUESTS)
class holds_back_a_clients_next_request(Link):
    """A request reaches the server when the earlier ones of its client are answered."""

    def _enter(self, server: End, opened: OpenRequest, request: list[Datum]) -> None:
        own = [one for one in self.requests.values() if one.client is opened.client and one.number < opened.number]
        if opened.client.kind.provided is None or not own:
            super()._enter(server, opened, request)


@breaks("R-10.4.1.2-15", clauses=REQUESTS, also=("R-10.4.1.1-08", "R-10.4.1.2-14"))
class holds_back_other_clients(Link):
    """A request reaches the server when those of all other clients are answered."""

    def _enter(self, server: End, opened: OpenRequest, request: list[Datum]) -> None:
        before = [one for one in self.requests.values() if one.number < opened.number]
        others = [one for one in before if one.client is not opened.client]
        if opened.client.kind.provided is None or not others:
            super()._enter(server, opened, request)


@breaks("R-10.4.1.1-08", clauses=REQUESTS, also=("R-10.4.1.2-15",))
class serves_the_first_client_only(Link):
    """Requests of all clients but the first are lost, and give ok."""

    def carry_out(self, end: End, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        clients = [one for one in self.ends if one.kind.side == "client"]
        if end.kind.side == "client" and end is not clients[0] and not self.broken:
            empty = a_value(self.types[RESPONSE_DATA]) if end.kind.provided is None else next(self.numbers)
            return [empty, OK]
        return super().carry_out(end, method, arguments)


@replaces("_request", "R-10.4.1.1-34", clauses=REQUESTS)
def gives_an_unknown_code(self: Link, client: End, request: Datum) -> list[Datum]:
    """The request of an asynchronous client gives a code that is none of the three."""
    number, code = Link._request(self, client, request)
    return [number, "done" if code == OK else code]


@replaces("_request", "R-10.4.1.1-34", clauses=REQUESTS, also=("R-10.4.1.1-35",))
def is_never_content(self: Link, client: End, request: Datum) -> list[Datum]:
    """The request of an asynchronous client gives internal_error although it is carried out."""
    number, code = Link._request(self, client, request)
    return [number, INTERNAL_ERROR if code == OK else code]


@alters("_request_and_wait", "R-10.4.1.1-34", clauses=REQUESTS, also=("R-10.4.1.1-35",))
def blames_the_transport(_self: Link, given: list[Datum], *_: object) -> list[Datum]:
    """The request of a synchronous client gives comm_error although it was answered."""
    return [given[0], COMM_ERROR]


@breaks("R-10.4.1.1-35", clauses=REQUESTS)
class notices_no_fault(Link):
    """Nothing tells that the connection is broken: requests give ok and are lost."""

    def _request_and_wait(self, client: End, request: Datum) -> list[Datum]:
        return [a_value(self.types[RESPONSE_DATA]), OK] if self.broken else super()._request_and_wait(client, request)

    def _request(self, client: End, request: Datum) -> list[Datum]:
        return [next(self.numbers), OK] if self.broken else super()._request(client, request)


@does_only_if("mend_link", "R-10.4.1.1-35", clauses=REQUESTS)
def keeps_requests_broken(_self: Link) -> bool:
    """A connection that was broken once stays so."""
    return False


@breaks("R-10.4.1.2-04", clauses=REQUESTS)
class swallows_exceptions_of_servers(Link):
    """A client whose server raises an exception gets an empty response, and ok."""

    def _request_and_wait(self, client: End, request: Datum) -> list[Datum]:
        try:
            return super()._request_and_wait(client, request)
        except Exception:  # noqa: BLE001 - whatever the body raises
            return [a_value(self.types[RESPONSE_DATA]), OK]


@breaks(
    "R-10.4.1.2-20",
    clauses=REQUESTS,
    also=("R-10.4.1.2-07", "R-10.4.1.2-10", "R-10.4.1.2-11", "R-10.4.1.2-13", "R-10.4.1.2-16", "R-10.4.1.2-17"),
)
class asks_the_server_of_another_connection(Link):
    """Requests of asynchronous clients go to the server of the connection that was made first."""

    def _enter(self, server: End, opened: OpenRequest, request: list[Datum]) -> None:
        first = self.manager.extended_links[0]
        if isinstance(first, RequestResponseLink) and opened.client.kind.provided is not None:
            server = next((end for end in first.ends if end.kind.side == "server"), server)
        super()._enter(server, opened, request)


@breaks("R-10.4.1.1-08", clauses=REQUESTS)
class serves_one_waiting_client(Link):
    """While a synchronous client waits, requests of others get internal_error."""

    def _request_and_wait(self, client: End, request: Datum) -> list[Datum]:
        waiting = [one for one in self.requests.values() if one.client.kind.provided is None]
        if waiting:
            return [a_value(self.types[RESPONSE_DATA]), INTERNAL_ERROR]
        return super()._request_and_wait(client, request)
