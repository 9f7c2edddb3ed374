"""Wrong frameworks, clause 10.4.1: connections that take too many servers or too few clients, kinds or types."""

from __future__ import annotations

from collections.abc import Mapping

from ucm_cts.adapters.contract.data_types import AnyType, Datum
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.methods import does_only_if, refuses_if
from ucm_cts.adapters.mutants.python.registry import REQUESTS, Base, breaks
from ucm_cts.adapters.reference.python.connectors import AnyLink
from ucm_cts.adapters.reference.python.port_links import End
from ucm_cts.adapters.reference.python.request_response import RequestResponseLink

Link = RequestResponseLink


@does_only_if("_check_room", "R-10.4.1.1-07", "R-10.4.1.1-30", clauses=REQUESTS)
def takes_any_number_of_servers(_self: Link, _end: End) -> bool:
    """A connection takes a second server, of either kind."""
    return False


@does_only_if("_check_room", "R-10.4.1.1-30", clauses=REQUESTS)
def takes_a_server_of_each_kind(self: Link, end: End) -> bool:
    """A connection takes a synchronous server and an asynchronous one."""
    server = self._server()
    return server is None or server.kind is end.kind


@does_only_if("_check_room", "R-10.4.1.1-07", clauses=REQUESTS)
def takes_servers_of_one_kind(self: Link, end: End) -> bool:
    """A connection takes two servers of the same kind."""
    server = self._server()
    return server is None or server.kind is not end.kind


@refuses_if("_check_room", "R-10.4.1.1-31", clauses=REQUESTS, also=("R-10.4.1.1-32",))
def takes_one_asking_client(self: Link, end: End) -> bool:
    """A connection refuses a second client."""
    return end.kind.side == "client" and any(one.kind.side == "client" for one in self.ends)


@refuses_if("_check_room", "R-10.4.1.1-31", clauses=REQUESTS)
def has_no_asynchronous_servers(_self: Link, end: End) -> bool:
    """A connection refuses asynchronous servers."""
    return end.kind.name == "rr_asynchronous_server"


@refuses_if("_check_room", "R-10.4.1.1-32", clauses=REQUESTS)
def takes_equal_kinds_only(self: Link, end: End) -> bool:
    """A connection refuses a client whose server is of the other kind, and clients of both kinds."""
    return any((len(one.kind.elements) == 1) != (len(end.kind.elements) == 1) for one in self.ends)


@breaks("R-10.4.1.1-31", clauses=REQUESTS)
class has_no_connector(Base):
    """There is no request-response connector."""

    def link_with_types(self, connector: str, types: Mapping[str, AnyType]) -> AnyLink:
        raise UcmError("no such connector")


@breaks("R-10.4.1.1-31", clauses=REQUESTS, also=("R-10.4.1.1-32", "R-11.2.3-06"))
class does_not_start_with_it(Base):
    """A container with a server is not started."""

    def _check_startable(self) -> None:
        super()._check_startable()
        links = [link for link in self.manager.extended_links if isinstance(link, RequestResponseLink)]
        if any(end.member in self.members.values() and end.kind.side == "server" for k in links for end in k.ends):
            raise UcmError("a server cannot be started")


@breaks("R-10.4.1.1-34", clauses=REQUESTS, also=("R-10.4.1.2-02", "R-10.4.1.2-03", "R-10.4.1.2-13"))
class response_wakes_all_who_wait(Link):
    """All synchronous clients that wait are woken by one response; those that it is not for get an error."""

    def _respond(self, response: Datum, number: Datum) -> str:
        code = super()._respond(response, number)
        for request in list(self.requests.values()):
            request.given.set()
        return code


@breaks("R-10.4.1.1-34", "R-10.4.1.1-08", clauses=REQUESTS, also=("R-10.4.1.2-05", "R-10.4.1.2-01", "R-10.4.1.2-06"))
class knows_its_first_server(Link):
    """Requests go to the first server that a connection had, also when another one has taken its place."""

    def _server(self) -> End | None:
        first: End | None = self.__dict__.setdefault("first", super()._server())
        if first is None:
            del self.__dict__["first"]
        return first

    def _check_room(self, end: End) -> None:
        if end.kind.side == "server" and super()._server() is not None:
            raise UcmError("the connection has a server already")
