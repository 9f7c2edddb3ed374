"""Conformant variants that carry out calls of services in their own way (10.1.5)."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from typing import TypeVar

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import DeclaredException, PortConnection, PortElementObject, UcmError
from ucm_cts.adapters.contract.scenario import SERVICE_CONNECTOR
from ucm_cts.adapters.mutants.python.methods import alters, elsewhere, replaces
from ucm_cts.adapters.mutants.python.registry import Base, variant_of
from ucm_cts.adapters.reference.python.connectors import Link, LinkElement, Taker
from ucm_cts.adapters.reference.python.execution import Executor
from ucm_cts.adapters.reference.python.members import HasMembers, Member

T = TypeVar("T")

_CLAUSES = ("10.1.1", "10.1.5")
_service_variant = variant_of(*_CLAUSES)

# threads


@_service_variant
class serves_on_one_thread(Link):
    """Each connection has a thread that carries out its calls one by one."""

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)  # type: ignore[arg-type]
        self.executor = Executor()

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        return self.executor.execute(lambda: super(serves_on_one_thread, self)._request(method, arguments))


class _ClientElement(LinkElement):
    """Has a thread of its own."""

    def __init__(self, link: Link) -> None:
        super().__init__(link)
        self.executor = Executor()

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        call = super().call
        return self.executor.execute(lambda: call(method, arguments))


@replaces("_attach_sender", clauses=_CLAUSES)
def queues_for_each_client(self: Link, member: Member, port: str) -> None:
    """The calls of each client wait in a queue and are made by a thread of it."""
    Link._attach_sender(self, member, port)
    connections = member.container.manager.connections
    last = max(connections)
    object.__setattr__(connections[last], "target", _ClientElement(self))


@replaces("_request", clauses=_CLAUSES)
def serves_each_call_on_a_new_thread(self: Link, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """Each call of a service is served by a new thread."""
    return elsewhere(lambda: Link._request(self, method, arguments)).result()


# servers


@variant_of(
    *_CLAUSES, readings={"second-server": "at-connect", "call-in-flight": "finishes", "exception-transport": "full"}
)
class declares_its_services(Base):
    """The reference framework; its vendor declares what it does with servers and calls."""


class _TakesAll(Link):
    def _check_room(self) -> None:
        pass

    @property
    def is_overfull(self) -> bool:
        return self.connector == SERVICE_CONNECTOR and len(self.takers) > 1


@variant_of(*_CLAUSES, readings={"second-server": "at-start"})
class refuses_two_servers_at_start(Base):
    """A second server can be attached; the container that has it does not start."""

    link_class = _TakesAll

    def _check_startable(self) -> None:
        super()._check_startable()
        for link in self.manager.links:
            takers = [taker for taker in link.takers if taker.member.container is self]
            if isinstance(link, _TakesAll) and link.is_overfull and takers:
                raise UcmError("a connection has two servers")


@_service_variant
class refuses_clients_without_server(Base):
    """A client of a connection without server is not started."""

    def _check_startable(self) -> None:
        super()._check_startable()
        targets = [c.target for m in self.members.values() for c in self._connections_from(m)]
        links = [target.link for target in targets if isinstance(target, LinkElement)]
        if any(link.connector == SERVICE_CONNECTOR and not link.takers for link in links):
            raise UcmError("a client has no server")


# exceptions


@replaces("_request", clauses=_CLAUSES, readings={"exception-transport": "system-error"})
def raises_system_errors(self: Link, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """Every exception of a server arrives as an error of the framework, as the vendor declares."""
    try:
        return Link._request(self, method, arguments)
    except DeclaredException as error:
        raise UcmError(f"the server raised {error.name}") from None


# calls in flight


class _Aborts(Link):
    """``abort`` ends all calls in progress with an exception; later results of the server are dropped."""

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)  # type: ignore[arg-type]
        self.aborted: Future[Sequence[Datum]] = Future()

    def abort(self) -> None:
        self.aborted.set_exception(UcmError("the call has been aborted"))
        self.aborted = Future()

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        aborted = self.aborted
        if not self.takers or not self.takers[0].entrance.is_open:
            raise UcmError("there is no server")
        outcome = elsewhere(lambda: super(_Aborts, self)._request(method, arguments))
        wait((outcome, aborted), return_when=FIRST_COMPLETED)
        return outcome.result() if outcome.done() else aborted.result()


@_service_variant
class aborts_calls_of_stopped_servers(Base):
    """stop does not wait for servers; calls in progress fail at once."""

    link_class = _Aborts

    def _close_entrances(self, member: Member) -> None:
        for link, taker in self._takers_of(member):
            if link.connector == SERVICE_CONNECTOR and isinstance(link, _Aborts):
                taker.entrance._is_open = False
                link.abort()
            else:
                taker.entrance.close()


class _AbortedElement(LinkElement):
    """Ends the calls of its client with an exception when it is told to."""

    def __init__(self, link: Link) -> None:
        super().__init__(link)
        self.aborted: Future[Sequence[Datum]] = Future()

    def abort(self) -> None:
        self.aborted.set_exception(UcmError("the call has been aborted"))
        self.aborted = Future()

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        aborted = self.aborted
        if self.link.connector == SERVICE_CONNECTOR and not any(t.entrance.is_open for t in self.link.takers):
            raise UcmError("there is no server")
        outcome = elsewhere(lambda: super(_AbortedElement, self).call(method, arguments))
        wait((outcome, aborted), return_when=FIRST_COMPLETED)
        return aborted.result() if aborted.done() else outcome.result()


class _AbortsEach(Link):
    def _attach_sender(self, member: Member, port: str) -> None:
        super()._attach_sender(member, port)
        connections = member.container.manager.connections
        element = _AbortedElement(self)
        object.__setattr__(connections[max(connections)], "target", element)
        self.__dict__.setdefault("elements", []).append(element)


@variant_of(*_CLAUSES, readings={"call-in-flight": "aborted"})
class aborts_calls_in_flight(Base):
    """stop ends the calls of the clients and to the servers that it stops; what a server returns later is dropped."""

    link_class = _AbortsEach

    def _close_entrances(self, member: Member) -> None:
        for connection in self._connections_from(member):
            if isinstance(connection.target, _AbortedElement):
                connection.target.abort()
        for link, taker in self._takers_of(member):
            if link.connector == SERVICE_CONNECTOR:
                taker.entrance._is_open = False
                for element in link.__dict__.get("elements", ()):
                    element.abort()
            else:
                taker.entrance.close()


@_service_variant
class undoes_connections_at_any_time(Link):
    """Ends may be detached while everything is started; calls in progress finish, and no more are made."""

    def detach(self, container: HasMembers, comp_instance: int, port: str) -> None:
        if self.connector != SERVICE_CONNECTOR or not container.is_started:
            super().detach(container, comp_instance, port)
            return
        with container._operation():
            member = container._find_member(comp_instance)
            for taker in [taker for taker in self.takers if (taker.member, taker.port) == (member, port)]:
                self.let_go(taker)
            for sender in container._connections_from(member):
                if sender.port == port and self._is_behind(sender.target):
                    container._undo(sender)
                    self.let_go(None)

    def let_go(self, taker: Taker | None) -> None:
        if taker is not None:
            self.takers.remove(taker)


@_service_variant
class undoes_connections_at_once(undoes_connections_at_any_time, _Aborts):
    """Ends may be detached while everything is started; the calls that a server is executing then end with an exception."""

    def let_go(self, taker: Taker | None) -> None:
        super().let_go(taker)
        if taker is not None:
            self.abort()


# connections without a connector


@alters("_dependencies_of", clauses=("10.1.5",))
def wires_clients_to_servers(_self: Base, given: list[PortConnection], *_: object) -> list[PortConnection]:
    """Clients get the reference of the server itself; no connector is between them."""
    return [PortConnection(d.from_port, tuple(map(_server_behind, d.to_port))) for d in given]


def _server_behind(target: PortElementObject | None) -> PortElementObject | None:
    link = target.link if isinstance(target, LinkElement) else None
    if link is None or link.connector != SERVICE_CONNECTOR or not link.takers:
        return target
    server = link.takers[0].member
    return server.container._reference_to(server, link.takers[0].port)


@variant_of("10.1.5", "11.2.3", readings={"incompatible-ends": "refused"})
class compares_interfaces_at_start(Base):
    """connect takes any reference; a container does not start if a port element is connected to another interface."""

    def _check_compatible(self, member: Member, port: str, target: PortElementObject) -> None:
        pass

    def _check_startable(self) -> None:
        super()._check_startable()
        for member in self.members.values():
            for connection in self._connections_from(member):
                provided = self._interfaces_of(connection.target)
                if provided and member.implementation.interfaces.get(connection.port) not in provided:
                    raise UcmError(f"{connection.port!r} is connected to another interface")


class _Replacing(Link):
    def _check_room(self) -> None:
        if self.connector == SERVICE_CONNECTOR and self.takers:
            self.remove(self.takers[0])


@variant_of(*_CLAUSES, readings={"second-server": "replace"})
class replaces_servers(Base):
    """A second server takes the place of the first."""

    link_class: type[Link] = _Replacing
