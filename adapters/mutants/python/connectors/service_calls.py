"""Service connectors that lose or mix up calls or waiting clients, or take too many clients or servers (10.1.5)."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence

from ucm_cts.adapters.contract.data_types import Datum, Interface, Parameter
from ucm_cts.adapters.contract.programming_model import NotFound, UcmError
from ucm_cts.adapters.contract.scenario import PROTECTED_PASSIVE, SERVICE_CONNECTOR
from ucm_cts.adapters.mutants.python.methods import alters, refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import Base, breaks, is_below
from ucm_cts.adapters.mutants.python.variants.services import replaces_servers
from ucm_cts.adapters.reference.python.connectors import Link, LinkElement, Taker
from ucm_cts.adapters.reference.python.members import HasMembers, Member

_CLAUSES = ("10.1.5",)
_CALLS, _CLIENTS, _OWN, _ONE_SERVER = "R-10.1.5.1-01", "R-10.1.5.1-03", "R-10.1.5.1-04", "R-10.1.5.1-05"
_DIRECTIONS, _INHERITED, _EXCEPTIONS, _IN_FLIGHT = "R-10.1.5.1-08", "R-10.1.5.1-09", "R-10.1.5.1-10", "R-10.1.5.1-12"
_TEMPLATE = "R-10.1.5.1-13"


class Services(Link):
    """A connector whose mutants treat calls of services in another way."""

    @property
    def server(self) -> Taker:
        return self.takers[0]

    def parameters(self, method: str) -> Sequence[Parameter]:
        """The parameters of the method that are sent back."""
        return self.interface.methods[method].results

    def nothing(self, method: str) -> list[Datum]:
        """Empty results of the method."""
        return [0 if p.of.__class__.__name__ == "Integer" else "" for p in self.parameters(method)]


# calls that go astray


@breaks(_CALLS, _CLIENTS, _INHERITED, _TEMPLATE, clauses=_CLAUSES, also=(_ONE_SERVER,))
class answers_from_memory(Services):
    """A call that was made before is answered without asking the server again."""

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)  # type: ignore[arg-type]
        self.answers: dict[str, Sequence[Datum]] = {}

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        key = f"{method}{arguments}"
        if key not in self.answers:
            self.answers[key] = super()._request(method, arguments)
        return self.answers[key]


@replaces("_request", _CALLS, clauses=_CLAUSES)
def calls_the_server_twice(self: Services, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """Every request is sent twice."""
    Services._request(self, method, arguments)
    return Services._request(self, method, arguments)


@replaces("_request", _CALLS, _INHERITED, _TEMPLATE, clauses=_CLAUSES, also=(_DIRECTIONS, _EXCEPTIONS))
def mistakes_methods_of_one_shape(self: Services, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """Of methods with the same parameter types every call reaches the last."""
    shapes = {name: [p.of for p in m.parameters] for name, m in self.interface.methods.items()}
    same = [name for name in shapes if shapes[name] == shapes[method]]
    return Services._request(self, same[-1], arguments)


@refuses_if("_request", _INHERITED, clauses=_CLAUSES)
def knows_no_inherited_methods(self: Services, method: str, *_: object) -> bool:
    """Inherited methods of an interface are refused."""
    return method in self.interface.inherited


@breaks(_TEMPLATE, clauses=_CLAUSES, also=(_CALLS,))  # a method of another interface may accept the values
class finds_methods_by_name(Services):
    """A call goes to any connection that has a method of that name."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        others = [k for k in self.manager.links if k.interface != self.interface and method in k.interface.methods]
        return super()._request(method, arguments) if not others else Link._request(others[0], method, arguments)


@alters("link", "R-10.1.5.1-01", clauses=_CLAUSES, also=("R-10.1.1-07", _TEMPLATE))
def binds_the_template_once(self: Base, link: Link, connector: str, interface: Interface) -> Link:
    """All service connectors of a runtime have the interface of the first one."""
    first = next(k for k in self.manager.links if k.connector == connector)
    link.interface = first.interface if connector == SERVICE_CONNECTOR else interface
    return link


@refuses_if("link", _TEMPLATE, clauses=_CLAUSES)
def has_one_interface(self: Base, connector: str, interface: Interface) -> bool:
    """There are connectors for one interface only."""
    return any(k.interface != interface for k in self.manager.links if k.connector == connector)


# clients


@breaks(_CLIENTS, clauses=_CLAUSES, also=("R-10.1.5.1-01",))
class attaches_one_client(Services):
    """Only the first client is connected to the server."""

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)  # type: ignore[arg-type]
        self.first: int | None = None

    def _attach_sender(self, member: Member, port: str) -> None:
        super()._attach_sender(member, port)
        self.first = self.first or member.id
        if self.connector == SERVICE_CONNECTOR and member.id != self.first:
            connection = member.container._connections_from(member)[-1]
            assert isinstance(connection.target, LinkElement)
            connection.target.link = Link(self.manager, self.connector, self.interface)


@refuses_if("_attach_sender", _CLIENTS, clauses=_CLAUSES, also=(_CALLS,))
def takes_one_client(self: Services, *_: object) -> bool:
    """A second client is refused."""
    return self.connector == SERVICE_CONNECTOR and bool(self.manager.connections)


@breaks(_CLIENTS, clauses=_CLAUSES, also=("R-10.1.5.1-01",))
class refuses_while_the_server_is_busy(Services):
    """A call is refused while another client is served."""

    busy = 0

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if self.busy:
            raise UcmError("the server is busy")
        self.busy += 1
        try:
            return super()._request(method, arguments)
        finally:
            self.busy -= 1


@breaks(_CLIENTS, clauses=_CLAUSES, also=("R-10.1.3.2-17",))
class forgets_the_third_in_the_queue(Services):
    """If two clients wait for a protected server, the third one waits for ever."""

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)  # type: ignore[arg-type]
        self.queue: list[int] = []

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if len(self.queue) > 1 and self.server.member.execution.definition == PROTECTED_PASSIVE:
            threading.Event().wait()
        self.queue.append(threading.get_ident())
        try:
            return super()._request(method, arguments)
        finally:
            self.queue.remove(threading.get_ident())


@breaks(_OWN, clauses=_CLAUSES, also=(_IN_FLIGHT, "R-10.1.5.1-01"))
class keeps_results_in_one_slot(Services):
    """All calls in progress on a connection share one place for their results."""

    last: Sequence[Datum] = ()

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        own = super()._request(method, arguments)
        self.last = own
        time.sleep(0.01)
        return self.last if len(self.last) == len(own) else own


# servers


@replaces("_check_room", _ONE_SERVER, clauses=_CLAUSES, also=(_CALLS,))
def replaces_the_server(self: Services) -> None:
    """A second server replaces the first."""
    if self.connector == SERVICE_CONNECTOR:
        self.takers.clear()


@refuses_if("_attach_taker", _CALLS, clauses=_CLAUSES)
def takes_servers_of_the_root_container(self: Services, member: Member, *_: object) -> bool:
    """A server in a sub-container is refused."""
    return self.connector == SERVICE_CONNECTOR and is_below(member.container)


@replaces("_check_room", _ONE_SERVER, clauses=_CLAUSES)
def takes_servers_in_reserve(_self: Services) -> None:
    """Several servers can be attached; calls reach the first."""


@replaces("_check_room", _ONE_SERVER, clauses=_CLAUSES)
def finds_no_place_for_a_server(self: Services) -> None:
    """Attaching a second server raises NOT_FOUND."""
    if self.connector == SERVICE_CONNECTOR and self.takers:
        raise NotFound("no port for another server")


@replaces("_check_room", _ONE_SERVER, clauses=_CLAUSES, also=(_CALLS,))
def loses_the_server_to_a_second_one(self: Services) -> None:
    """Attaching a second server is refused, and the first server is lost."""
    if self.connector == SERVICE_CONNECTOR and self.takers:
        self.takers[0].port = "nothing"
        raise UcmError("the connection has a server already")


@breaks(_ONE_SERVER, clauses=_CLAUSES, readings={"second-server": "at-start"})
class refuses_the_second_server_at_once(Base):
    """The vendor declares that a second server is refused at start; it is refused when it is attached."""


_CALLS, _CLIENTS, _OWN, _BLOCKING = "R-10.1.5.1-01", "R-10.1.5.1-03", "R-10.1.5.1-04", "R-10.1.5.1-11"
_IN_FLIGHT = "R-10.1.5.1-12"


@replaces("_request", _BLOCKING, clauses=_CLAUSES, also=(_IN_FLIGHT, _OWN, _CALLS, "R-10.1.3.2-17"))
def does_not_wait_long(self: Services, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """A client that waits for more than 5 ms gets zeros as results."""
    outcome: list[Sequence[Datum]] = []
    raised: list[Exception] = []

    def ask() -> None:
        try:
            outcome.append(Link._request(self, method, arguments))
        except Exception as error:  # noqa: BLE001 - the caller gets any exception
            raised.append(error)

    asking = threading.Thread(target=ask, daemon=True)
    asking.start()
    asking.join(0.005)
    if raised:
        raise raised[0]
    return outcome[0] if outcome else self.nothing(method)


@breaks(_IN_FLIGHT, clauses=_CLAUSES)
class forgets_clients_of_stopped_servers(Services):
    """A client whose server is being stopped gets no result and waits for ever."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        server = self.server if self.takers else None
        results = super()._request(method, arguments)
        if server is not None and not server.entrance.is_open and self.is_crowded(server):
            threading.Event().wait()
        return results

    def is_crowded(self, server: Taker) -> bool:
        """The defect appears in a part of the scenarios only, because each appearance takes the time limit."""
        return len(self.manager.connections) > 1 and not server.member.execution.definition


@replaces("_request", _IN_FLIGHT, clauses=_CLAUSES)
def invents_results_of_stopped_servers(self: Services, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """When a server is being stopped, clients get zeros."""
    server = self.server if self.takers else None
    results = Services._request(self, method, arguments)
    return results if server is None or server.entrance.is_open else self.nothing(method)


@replaces("_close_entrances", _IN_FLIGHT, clauses=_CLAUSES, also=("R-12.10-10",))
def never_stops_what_was_called(self: Base, member: Member) -> None:
    """stop does not end if a server was executing several calls when it came."""
    for _, taker in self._takers_of(member):
        several = taker.entrance._inside > 1
        taker.entrance.close()
        if several and not member.execution.definition:
            threading.Event().wait()


class _Undone(Services):
    """The connection can be undone while all containers are started."""

    undone = False

    def detach(self, container: HasMembers, comp_instance: int, port: str) -> None:
        if not container.is_started:
            super().detach(container, comp_instance, port)
            return
        self.undone = True

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        results = super()._request(method, arguments)
        if self.undone:
            self.answer_undone()
        return results

    def answer_undone(self) -> None:
        raise NotImplementedError


@replaces("answer_undone", _IN_FLIGHT, clauses=_CLAUSES, also=(_CALLS, _CLIENTS))
def forgets_clients_of_undone_connections(self: _Undone) -> None:
    """A connection can be undone at any time; a client that is just calling then waits for ever."""
    if not self.server.member.execution.definition and len(self.manager.connections) > 1:
        threading.Event().wait()


@breaks(_IN_FLIGHT, clauses=_CLAUSES, also=(_CALLS, _CLIENTS), readings={"call-in-flight": "finishes"})
class aborts_calls_of_undone_connections(_Undone):
    """Calls whose connection is undone end with an exception; they were declared to finish."""

    def answer_undone(self) -> None:
        raise UcmError("the connection has been undone")


class _Staying(Link):
    def _check_room(self) -> None:
        pass


@breaks(_CALLS, clauses=_CLAUSES, readings={"second-server": "replace"})
class stays_with_the_first_server(replaces_servers):
    """The vendor declares that a second server replaces the first; calls still enter the first."""

    link_class = _Staying


@breaks(_ONE_SERVER, clauses=_CLAUSES, readings={"second-server": "replace"})
class refuses_the_server_that_was_to_replace_another(Link):
    """The vendor declares that a second server replaces the first; it is refused."""
