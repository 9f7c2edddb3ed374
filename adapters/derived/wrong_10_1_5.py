"""Wrong frameworks, clause 10.1.5: service connectors that lose, mix up or alter calls, take too much or leave clients waiting."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from typing import ClassVar, TypeVar

from ucm_cts.adapters.contract.data_types import Datum, Interface, Parameter
from ucm_cts.adapters.contract.programming_model import DeclaredException, NotFound, UcmError
from ucm_cts.adapters.contract.scenario import PROTECTED_PASSIVE, SERVICE_CONNECTOR
from ucm_cts.adapters.derived.registry import Base, breaks, is_below
from ucm_cts.adapters.reference_py.connectors import Link, LinkElement, Taker
from ucm_cts.adapters.reference_py.framework import Container, Member

T = TypeVar("T")

_CLAUSES = ("10.1.5",)
_CALLS, _CLIENTS, _OWN, _ONE_SERVER = "R-10.1.5.1-01", "R-10.1.5.1-03", "R-10.1.5.1-04", "R-10.1.5.1-05"
_DIRECTIONS, _INHERITED, _EXCEPTIONS = "R-10.1.5.1-08", "R-10.1.5.1-09", "R-10.1.5.1-10"
_BLOCKING, _IN_FLIGHT, _TEMPLATE = "R-10.1.5.1-11", "R-10.1.5.1-12", "R-10.1.5.1-13"


class _Services(Link):
    """Does something else with the calls of services."""

    @property
    def server(self) -> Taker:
        return self.takers[0]

    def parameters(self, method: str) -> Sequence[Parameter]:
        """Of the method, those that are sent back."""
        return self.interface.methods[method].results

    def nothing(self, method: str) -> list[Datum]:
        """Results that no server gave."""
        return [0 if p.of.__class__.__name__ == "Integer" else "" for p in self.parameters(method)]


# calls that go astray


class _Remembers(_Services):
    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)  # type: ignore[arg-type]
        self.answers: dict[str, Sequence[Datum]] = {}

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        key = f"{method}{arguments}"
        if key not in self.answers:
            self.answers[key] = super()._request(method, arguments)
        return self.answers[key]


@breaks(_CALLS, _CLIENTS, _INHERITED, _TEMPLATE, clauses=_CLAUSES, also=(_ONE_SERVER,))
class answers_from_memory(Base):
    """A call that was made before is answered without asking the server again."""

    link_class = _Remembers


class _Twice(_Services):
    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        super()._request(method, arguments)
        return super()._request(method, arguments)


@breaks(_CALLS, clauses=_CLAUSES)
class calls_the_server_twice(Base):
    """Every request is sent again, to be sure."""

    link_class = _Twice


class _ByShape(_Services):
    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        shapes = {name: [p.of for p in m.parameters] for name, m in self.interface.methods.items()}
        same = [name for name in shapes if shapes[name] == shapes[method]]
        return super()._request(same[-1], arguments)


@breaks(_CALLS, _INHERITED, _TEMPLATE, clauses=_CLAUSES, also=(_DIRECTIONS, _EXCEPTIONS))
class mistakes_methods_of_one_shape(Base):
    """Of methods with the same types of parameters the last one is called."""

    link_class = _ByShape


class _OwnMethodsOnly(_Services):
    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if method in self.interface.inherited:
            raise UcmError(f"no method {method!r}")
        return super()._request(method, arguments)


@breaks(_INHERITED, clauses=_CLAUSES)
class knows_no_inherited_methods(Base):
    """Only the methods that an interface itself declares are known."""

    link_class = _OwnMethodsOnly


class _ToTheFirst(_Services):
    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        others = [k for k in self.manager.links if k.interface != self.interface and method in k.interface.methods]
        return super()._request(method, arguments) if not others else Link._request(others[0], method, arguments)


@breaks(_TEMPLATE, clauses=_CLAUSES)
class finds_methods_by_name(Base):
    """A call goes to whatever connection has a method of that name."""

    link_class = _ToTheFirst


@breaks(_TEMPLATE, clauses=_CLAUSES, also=("R-10.1.1-07",))
class binds_the_template_once(Base):
    """All service connectors of a runtime have the interface of the first one."""

    def link(self, connector: str, interface: Interface) -> Link:
        link = super().link(connector, interface)
        first = next(k for k in self.manager.links if k.connector == connector)
        link.interface = first.interface if connector == SERVICE_CONNECTOR else interface
        return link


@breaks(_TEMPLATE, clauses=_CLAUSES)
class has_one_interface(Base):
    """There are connectors for one interface only."""

    def link(self, connector: str, interface: Interface) -> Link:
        if any(k.interface != interface for k in self.manager.links if k.connector == connector):
            raise UcmError("the connector is bound to another interface")
        return super().link(connector, interface)


# clients


class _FirstClientOnly(_Services):
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


@breaks(_CLIENTS, clauses=_CLAUSES, also=("R-10.1.5.1-01",))
class attaches_one_client(Base):
    """Clients after the first are attached to nothing."""

    link_class = _FirstClientOnly


class _OneClient(_Services):
    def _attach_sender(self, member: Member, port: str) -> None:
        if self.connector == SERVICE_CONNECTOR and self.manager.connections:
            raise UcmError("the connection has a client")
        super()._attach_sender(member, port)


@breaks(_CLIENTS, clauses=_CLAUSES, also=(_CALLS,))
class takes_one_client(Base):
    """A second client is refused."""

    link_class = _OneClient


class _Busy(_Services):
    busy = 0

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if self.busy:
            raise UcmError("the server is busy")
        self.busy += 1
        try:
            return super()._request(method, arguments)
        finally:
            self.busy -= 1


@breaks(_CLIENTS, clauses=_CLAUSES, also=("R-10.1.5.1-01",))
class refuses_while_the_server_is_busy(Base):
    """Who calls while another client is served is sent away."""

    link_class = _Busy


class _ShortQueue(_Services):
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


@breaks(_CLIENTS, clauses=_CLAUSES, also=("R-10.1.3.2-17",))
class forgets_the_third_in_the_queue(Base):
    """If two clients wait for a protected server, the third one waits for ever."""

    link_class = _ShortQueue


class _OneSlot(_Services):
    last: Sequence[Datum] = ()

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        own = super()._request(method, arguments)
        self.last = own
        time.sleep(0.01)
        return self.last if len(self.last) == len(own) else own


@breaks(_OWN, clauses=_CLAUSES, also=(_IN_FLIGHT, "R-10.1.5.1-01"))
class keeps_results_in_one_slot(Base):
    """Who comes back from the server last overwrites the results of those who are on their way."""

    link_class = _OneSlot


# servers


class _Replaces(_Services):
    def _check_room(self) -> None:
        if self.connector == SERVICE_CONNECTOR:
            self.takers.clear()


@breaks(_ONE_SERVER, clauses=_CLAUSES, also=(_CALLS,))
class replaces_the_server(Base):
    """A second server takes the place of the first."""

    link_class = _Replaces


class _AtHome(_Services):
    def _attach_taker(self, member: Member, port: str) -> None:
        if self.connector == SERVICE_CONNECTOR and is_below(member.container):
            raise UcmError("servers are in the root container")
        super()._attach_taker(member, port)


@breaks(_CALLS, clauses=_CLAUSES)
class takes_servers_of_the_root_container(Base):
    """A server in a sub-container is refused."""

    link_class = _AtHome


class _Adds(_Services):
    def _check_room(self) -> None:
        pass


@breaks(_ONE_SERVER, clauses=_CLAUSES)
class takes_servers_in_reserve(Base):
    """There may be several servers; the first is called."""

    link_class = _Adds


class _RefusesOddly(_Services):
    def _check_room(self) -> None:
        if self.connector == SERVICE_CONNECTOR and self.takers:
            raise NotFound("no port for another server")


@breaks(_ONE_SERVER, clauses=_CLAUSES)
class finds_no_place_for_a_server(Base):
    """A second server is NOT_FOUND."""

    link_class = _RefusesOddly


class _DropsBoth(_Services):
    def _check_room(self) -> None:
        if self.connector == SERVICE_CONNECTOR and self.takers:
            self.takers[0].port = "nothing"
            raise UcmError("the connection has a server already")


@breaks(_ONE_SERVER, clauses=_CLAUSES, also=(_CALLS,))
class loses_the_server_to_a_second_one(Base):
    """A second server is refused, and the first serves no more."""

    link_class = _DropsBoth


@breaks(_ONE_SERVER, clauses=_CLAUSES, readings={"second-server": "at-start"})
class refuses_the_second_server_at_once(Base):
    """It was declared to do so when it is started."""


# values


class _Keeps(_Services):
    direction: ClassVar[str]

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        results = list(super()._request(method, arguments))
        sent = {p.name: value for p, value in zip(self.interface.methods[method].arguments, arguments, strict=True)}
        for index, parameter in enumerate(self.parameters(method)):
            if parameter.direction == self.direction and index < len(results):
                results[index] = sent.get(parameter.name, results[index] if index == 0 else results[0])
        return results


class _KeepsInout(_Keeps):
    direction = "INOUT"


@breaks(_DIRECTIONS, clauses=_CLAUSES)
class passes_inout_one_way(Base):
    """INOUT parameters come back as they were sent."""

    link_class = _KeepsInout


class _KeepsOut(_Keeps):
    direction = "OUT"


@breaks(_DIRECTIONS, clauses=_CLAUSES)
class passes_one_out_parameter(Base):
    """All OUT parameters have the value of the first result."""

    link_class = _KeepsOut


class _ResultFirst(_Services):
    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        results = list(super()._request(method, arguments))
        directions = [p.direction for p in self.parameters(method)]
        if "RETURN" in directions and len(results) == len(directions):
            results.insert(0, results.pop(directions.index("RETURN")))
        return results


@breaks(_DIRECTIONS, clauses=_CLAUSES)
class puts_the_result_first(Base):
    """The result comes before the other values, wherever it was declared."""

    link_class = _ResultFirst


class _SendsInOnly(_Services):
    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        sent = [
            value if p.direction == "IN" else 0 if isinstance(value, int) else ""
            for p, value in zip(self.interface.methods[method].arguments, arguments, strict=True)
        ]
        return super()._request(method, sent)


@breaks(_DIRECTIONS, clauses=_CLAUSES)
class sends_no_inout_values(Base):
    """INOUT parameters have no value when the server gets them."""

    link_class = _SendsInOnly


# exceptions


class _Catches(_Services):
    """What becomes of an exception that the server raised."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        try:
            return super()._request(method, arguments)
        except DeclaredException as error:
            return self.caught(method, error)

    def caught(self, method: str, error: DeclaredException) -> Sequence[Datum]:
        raise NotImplementedError


class _Swallows(_Catches):
    def caught(self, method: str, error: DeclaredException) -> Sequence[Datum]:
        return self.nothing(method)


@breaks(_EXCEPTIONS, clauses=_CLAUSES)
class loses_exceptions(Base):
    """A method that ends with an exception returns nothing in particular."""

    link_class = _Swallows


class _LosesFields(_Catches):
    def caught(self, method: str, error: DeclaredException) -> Sequence[Datum]:
        raise DeclaredException(error.name, ["" if isinstance(f, str) else 0 for f in error.fields])


@breaks(_EXCEPTIONS, clauses=_CLAUSES, also=("R-10.1.1-07",), readings={"exception-transport": "full"})
class loses_the_fields_of_exceptions(Base):
    """Exceptions arrive, with nothing in their fields."""

    link_class = _LosesFields


class _Mistakes(_Catches):
    def caught(self, method: str, error: DeclaredException) -> Sequence[Datum]:
        last = self.interface.methods[method].raises[-1]
        raise DeclaredException(last.name, error.fields[: len(last.fields)])


@breaks(_EXCEPTIONS, clauses=_CLAUSES, readings={"exception-transport": "full"})
class mistakes_exceptions(Base):
    """The last exception that a method declares arrives, whichever was raised."""

    link_class = _Mistakes


class _RaisesItsOwn(_Catches):
    def caught(self, method: str, error: DeclaredException) -> Sequence[Datum]:
        raise UcmError(error.name)


@breaks(_EXCEPTIONS, clauses=_CLAUSES, readings={"exception-transport": "full"})
class raises_its_own_exceptions(Base):
    """Exceptions arrive as one of the framework's; they were declared to arrive as they are."""

    link_class = _RaisesItsOwn


@breaks(_EXCEPTIONS, clauses=_CLAUSES, readings={"exception-transport": "full"})
class raises_its_own_exceptions_on_threads_of_components(Base):
    """What a method raises on the thread of its active component becomes an exception of the framework's own."""

    def _execute_on_own_thread(self, member: Member, work: Callable[[], T]) -> T:
        try:
            return super()._execute_on_own_thread(member, work)
        except DeclaredException as error:
            raise UcmError(error.name) from None


class _SwallowsOthers(_Services):
    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        try:
            return super()._request(method, arguments)
        except (DeclaredException, UcmError):
            raise
        except Exception:  # noqa: BLE001 - a body may raise anything
            return self.nothing(method)


@breaks(_EXCEPTIONS, clauses=_CLAUSES)
class swallows_what_is_not_declared(Base):
    """A server that fails in its own way seems to have answered."""

    link_class = _SwallowsOthers


# waiting


class _GivesUp(_Services):
    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        outcome: list[Sequence[Datum]] = []
        raised: list[Exception] = []

        def ask() -> None:
            try:
                outcome.append(Link._request(self, method, arguments))
            except Exception as error:  # noqa: BLE001 - whatever it is, the caller gets it
                raised.append(error)

        asking = threading.Thread(target=ask, daemon=True)
        asking.start()
        asking.join(0.005)
        if raised:
            raise raised[0]
        return outcome[0] if outcome else self.nothing(method)


@breaks(_BLOCKING, clauses=_CLAUSES, also=(_IN_FLIGHT, _OWN))
class does_not_wait_long(Base):
    """Who waits too long for a server gets zeros."""

    link_class = _GivesUp


class _HangsWhenStopped(_Services):
    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        server = self.server if self.takers else None
        results = super()._request(method, arguments)
        if server is not None and not server.entrance.is_open and self.is_crowded(server):
            threading.Event().wait()
        return results

    def is_crowded(self, server: Taker) -> bool:
        """In some of the scenarios only: waiting in vain takes time."""
        return len(self.manager.connections) > 1 and not server.member.execution.definition


@breaks(_IN_FLIGHT, clauses=_CLAUSES)
class forgets_clients_of_stopped_servers(Base):
    """When a server is being stopped, the results it still gives reach nobody."""

    link_class = _HangsWhenStopped


class _InventsWhenStopped(_Services):
    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        server = self.server if self.takers else None
        results = super()._request(method, arguments)
        return results if server is None or server.entrance.is_open else self.nothing(method)


@breaks(_IN_FLIGHT, clauses=_CLAUSES)
class invents_results_of_stopped_servers(Base):
    """When a server is being stopped, clients get zeros."""

    link_class = _InventsWhenStopped


@breaks(_IN_FLIGHT, clauses=_CLAUSES, also=("R-12.10-10",))
class never_stops_what_was_called(Base):
    """stop does not end if a server was executing several calls when it came."""

    def _close_entrances(self, member: Member) -> None:
        for _, taker in self._takers_of(member):
            several = taker.entrance._inside > 1
            taker.entrance.close()
            if several and not member.execution.definition:
                threading.Event().wait()


class _Undone(_Services):
    """May be undone while everything is started."""

    undone = False

    def detach(self, container: Container, comp_instance: int, port: str) -> None:
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


class _HangsWhenUndone(_Undone):
    def answer_undone(self) -> None:
        if not self.server.member.execution.definition and len(self.manager.connections) > 1:
            threading.Event().wait()


@breaks(_IN_FLIGHT, clauses=_CLAUSES, also=(_CALLS, _CLIENTS))
class forgets_clients_of_undone_connections(Base):
    """A connection may be undone at any time, and who is just calling waits for ever."""

    link_class = _HangsWhenUndone


class _AbortsWhenUndone(_Undone):
    def answer_undone(self) -> None:
        raise UcmError("the connection has been undone")


@breaks(_IN_FLIGHT, clauses=_CLAUSES, also=(_CALLS, _CLIENTS), readings={"call-in-flight": "finishes"})
class aborts_calls_of_undone_connections(Base):
    """Calls whose connection is undone end with an exception; they were declared to finish."""

    link_class = _AbortsWhenUndone
