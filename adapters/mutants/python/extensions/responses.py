"""Wrong frameworks, clause 10.4.1: responses that are lost, doubled or come to somebody else, and identifiers that mislead."""

from __future__ import annotations

import threading
from dataclasses import replace

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.data_values import a_value
from ucm_cts.adapters.contract.platform_interfaces import RESPONSE, RESPONSE_DATA
from ucm_cts.adapters.mutants.python.extensions.requests import KeepsBuffers
from ucm_cts.adapters.mutants.python.methods import does_only_if, replaces
from ucm_cts.adapters.mutants.python.registry import REQUESTS, Base, breaks
from ucm_cts.adapters.reference.python.connectors import INTERNAL_ERROR, OK
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.port_links import End
from ucm_cts.adapters.reference.python.request_response import OpenRequest, RequestResponseLink

Link = RequestResponseLink


@breaks("R-10.4.1.2-03", clauses=REQUESTS, also=("R-10.4.1.2-11",))
class answers_who_waits_longest(Link):
    """A response goes to the synchronous client that has waited longest, whoever it is for."""

    def _close(self, number: Datum) -> OpenRequest | None:
        waiting = [one for one in self.requests.values() if one.client.kind.provided is None]
        mine = self.requests.get(number) if isinstance(number, int) else None
        if mine is not None and mine.client.kind.provided is None:
            return super()._close(waiting[0].number)
        return super()._close(number)


@breaks("R-10.4.1.2-13", clauses=REQUESTS, also=("R-10.4.1.2-11", "R-10.4.1.2-07"))
class answers_the_first_client(Link):
    """Responses to asynchronous clients all go to the first one."""

    def _call_back(self, opened: OpenRequest, response: Datum) -> None:
        first = next(end for end in self.ends if end.kind.name == "rr_asynchronous_client")
        assert first.taker is not None
        first.taker.enter(RESPONSE, [response, opened.number])


@breaks("R-10.4.1.2-13", clauses=REQUESTS, also=("R-10.4.1.2-07", "R-10.4.1.2-10"))
class answers_the_first_port(Link):
    """A response goes to the first port of the component that asked."""

    def _call_back(self, opened: OpenRequest, response: Datum) -> None:
        ports = [end for end in self.ends if end.member is opened.client.member and end.taker is not None]
        super()._call_back(replace(opened, client=ports[0] if ports else opened.client), response)


@breaks("R-10.4.1.2-02", clauses=REQUESTS, also=("R-10.4.1.2-03", "R-10.4.1.1-08"))
class wakes_all_who_wait(Link):
    """A response wakes all synchronous clients that wait, and all of them get it."""

    def _respond(self, response: Datum, number: Datum) -> str:
        waiting = [one for one in self.requests.values() if one.client.kind.provided is None]
        code = super()._respond(response, number)
        if any(one.number == number for one in waiting):
            for one in waiting:
                (one.response,) = self._copied([response])
                one.given.set()
        return code


@replaces("_call_back", "R-10.4.1.2-07", clauses=REQUESTS, also=("R-10.4.1.2-17",))
def calls_back_twice(self: Link, opened: OpenRequest, response: Datum) -> None:
    """Each response enters its client twice."""
    Link._call_back(self, opened, response)
    Link._call_back(self, opened, response)


@does_only_if("_call_back", "R-10.4.1.2-07", clauses=REQUESTS, also=("R-10.4.1.2-08", "R-10.4.1.2-09", "R-10.4.1.1-10"))
def forgets_the_first_response(self: Link, opened: OpenRequest, _response: object) -> bool:
    """The first response of a connection does not come."""
    return opened.number > 1


@replaces("_call_back", "R-10.4.1.2-07", clauses=REQUESTS)
def alters_responses(self: Link, opened: OpenRequest, response: Datum) -> None:
    """Small numbers among responses come back increased by seven."""
    altered = response + 7 if type(response) is int and 0 < response < 10**4 else response
    Link._call_back(self, opened, altered)


@replaces("_call_back", "R-10.4.1.1-33", clauses=REQUESTS)
def empties_structures(self: Link, opened: OpenRequest, response: Datum) -> None:
    """Structures among responses come back empty."""
    is_structure = isinstance(response, list) and len(response) == 3
    Link._call_back(self, opened, a_value(self.types[RESPONSE_DATA]) if is_structure else response)


@breaks("R-10.4.1.1-33", clauses=REQUESTS)
class keeps_the_servers_buffer(KeepsBuffers):
    """What an asynchronous server does with its response after the call reaches its client."""

    def _respond(self, response: Datum, number: Datum) -> str:
        self.__dict__["sent"] = response
        return super()._respond(response, number)


@breaks("R-10.4.1.2-08", "R-10.4.1.1-10", clauses=REQUESTS, also=("R-10.4.1.2-09",))
class takes_answers_inside_requests_only(Link):
    """A response is taken while the server is inside ``request``; a later one is lost, and gives ok."""

    def _enter(self, server: End, opened: OpenRequest, request: list[Datum]) -> None:
        super()._enter(server, opened, request)
        opened.__dict__["is_late"] = True

    def _respond(self, response: Datum, number: Datum) -> str:
        opened = self.requests.get(number) if isinstance(number, int) else None
        is_callback = opened is not None and opened.client.kind.provided is not None and not self.broken
        if is_callback and opened.__dict__.get("is_late"):
            self._close(number)
            return OK
        return super()._respond(response, number)


@breaks("R-10.4.1.2-09", clauses=REQUESTS)
class wants_answers_in_order(Link):
    """A response that is given before one to an earlier request is lost, and gives ok."""

    def _respond(self, response: Datum, number: Datum) -> str:
        opened = self.requests.get(number) if isinstance(number, int) else None
        is_callback = opened is not None and opened.client.kind.provided is not None and not self.broken
        if is_callback and number != min(self.requests):
            self._close(number)
            return OK
        return super()._respond(response, number)


@replaces("_call_back", "R-10.4.1.2-10", clauses=REQUESTS)
def calls_back_with_another_number(self: Link, opened: OpenRequest, response: Datum) -> None:
    """A response has the number after that of its request."""
    taker = opened.client.taker
    assert taker is not None
    taker.enter(RESPONSE, [response, opened.number + 1])


@replaces("_call_back", "R-10.4.1.2-10", clauses=REQUESTS)
def calls_back_with_zero(self: Link, opened: OpenRequest, response: Datum) -> None:
    """All responses have the number 0."""
    taker = opened.client.taker
    assert taker is not None
    taker.enter(RESPONSE, [response, 0])


@breaks("R-10.4.1.2-11", clauses=REQUESTS, readings={"request-ids": "translated"})
class tells_the_server_another_number(Link):
    """The server is told a number that it cannot answer with."""

    def _enter(self, server: End, opened: OpenRequest, request: list[Datum]) -> None:
        if opened.client.kind.provided is None:
            super()._enter(server, opened, request)
        elif server.taker is not None:
            server.taker.enter("request", [*request, opened.number + 1000])

    def _respond(self, response: Datum, number: Datum) -> str:
        is_told = isinstance(number, int) and 1000 < number < 2000
        return INTERNAL_ERROR if is_told and not self.broken else super()._respond(response, number)


@breaks(
    "R-10.4.1.2-12",
    clauses=REQUESTS,
    also=("R-10.4.1.2-08", "R-10.4.1.2-09", "R-10.4.1.2-11", "R-10.4.1.2-13", "R-10.4.1.1-10", "R-10.4.1.2-10"),
    readings={"unknown-id": "observed"},
)
class numbers_requests_modulo_two(Link):
    """Numbers are used again after two requests, answered or not."""

    def _number(self, client: End) -> int:
        return super()._number(client) % 2


@breaks(
    "R-10.4.1.2-12",
    clauses=REQUESTS,
    also=(
        *("R-10.4.1.2-08", "R-10.4.1.2-09", "R-10.4.1.2-11", "R-10.4.1.2-13", "R-10.4.1.1-10", "R-10.4.1.2-10"),
        *("R-10.4.1.2-02", "R-10.4.1.2-03", "R-10.4.1.2-21"),
    ),
    readings={"unknown-id": "observed"},
)
class numbers_the_requests_of_each_client(Link):
    """Each client has numbers from 1, and the server is told no more."""

    def _number(self, client: End) -> int:
        numbers: dict[int, int] = self.__dict__.setdefault("own", {})
        numbers[id(client)] = numbers.get(id(client), 0) + 1
        return numbers[id(client)]


@breaks("R-10.4.1.2-16", clauses=REQUESTS, readings={"unknown-id": "ignored"})
class passes_on_unknown_answers(Link):
    """A response with a number that was never given out goes to the first asynchronous client."""

    def _respond(self, response: Datum, number: Datum) -> str:
        code = super()._respond(response, number)
        first = next((end for end in self.ends if end.kind.name == "rr_asynchronous_client"), None)
        if code == INTERNAL_ERROR and isinstance(number, int) and number > 10**6:
            if first is not None:
                stray = OpenRequest(number, first)
                self._post(first, lambda: self._call_back(stray, response))
            return OK
        return code


@replaces("_respond", "R-10.4.1.2-16", clauses=REQUESTS, readings={"unknown-id": "refused"})
def takes_unknown_answers(self: Link, response: Datum, number: Datum) -> str:
    """A response with a number that is not open gives ok, although it is declared to be refused."""
    code = Link._respond(self, response, number)
    return code if self.broken else OK


@breaks("R-10.4.1.2-17", clauses=REQUESTS)
class passes_on_second_answers(Link):
    """A second response to a request comes to its client, too."""

    def _close(self, number: Datum) -> OpenRequest | None:
        opened = super()._close(number)
        answered: dict[object, OpenRequest] = self.__dict__.setdefault("answered", {})
        if opened is not None:
            answered[number] = opened
            return opened
        again = answered.get(number)
        return again if again is not None and again.client.kind.provided is not None else None


@replaces("_call_back", "R-10.4.1.2-18", clauses=REQUESTS, also=("R-10.1.3.2-13", "R-10.1.3.2-16", "R-10.1.3.2-10"))
def calls_back_without_protection(self: Link, opened: OpenRequest, response: Datum) -> None:
    """A response enters its client whatever is executed there."""
    taker = opened.client.taker
    assert taker is not None
    element = taker.member.body.get_portElement(taker.port)
    if element is not None and taker.entrance.is_open:
        element.call(RESPONSE, [response, opened.number])


@breaks("R-10.4.1.2-19", clauses=REQUESTS, also=("R-10.4.1.2-07",))
class answers_stopped_clients(Base):
    """A client that has been stopped gets an empty response to each of its open requests."""

    def stop(self) -> None:
        links = [link for link in self.manager.extended_links if isinstance(link, RequestResponseLink)]
        still = [(one, a_value(link.types[RESPONSE_DATA])) for link in links for one in link.requests.values()]
        super().stop()
        for one, nothing in still:
            taker = one.client.taker
            element = taker.member.body.get_portElement(taker.port) if taker is not None else None
            if element is not None:
                threading.Timer(0.01, element.call, (RESPONSE, [nothing, one.number])).start()


@breaks("R-10.4.1.2-11", clauses=REQUESTS)
class drops_all_with_one_client(Link):
    """What is open for any client is dropped when one of them is stopped."""

    def abandon(self, member: Member) -> None:
        if any(end.member is member for end in self.ends):
            for request in list(self.requests.values()):
                self._drop(request)


@breaks("R-10.4.1.2-08", "R-10.4.1.1-10", clauses=REQUESTS, also=("R-10.4.1.2-07", "R-10.4.1.2-09"))
class calls_back_nobody_after_a_stop(Link):
    """When one client has been stopped, responses to others are taken and do not come."""

    has_stopped = False

    def abandon(self, member: Member) -> None:
        super().abandon(member)
        self.has_stopped |= any(end.member is member for end in self.ends)

    def _call_back(self, opened: OpenRequest, response: Datum) -> None:
        if not self.has_stopped:
            super()._call_back(opened, response)


@breaks("R-10.4.1.2-21", clauses=REQUESTS)
class leaves_clients_hanging(Link):
    """A synchronous client whose server stops waits for ever."""

    def _drop(self, request: OpenRequest) -> None:
        self._close(request.number)
        if request.client.kind.provided is not None:
            request.given.set()


@breaks("R-10.4.1.2-21", clauses=REQUESTS)
class invents_responses(Link):
    """A synchronous client whose server stops gets an empty response, and ok."""

    def _request_and_wait(self, client: End, request: Datum) -> list[Datum]:
        response, code = super()._request_and_wait(client, request)
        return [response, OK if code == INTERNAL_ERROR and not self.broken else code]


@breaks("R-10.4.1.1-34", clauses=REQUESTS)
class takes_nothing_for_no_response(Link):
    """A response of 0, false or nothing at all gives a synchronous client internal_error."""

    def _request_and_wait(self, client: End, request: Datum) -> list[Datum]:
        response, code = super()._request_and_wait(client, request)
        return [response, code if response else INTERNAL_ERROR]
