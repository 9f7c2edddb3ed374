"""Connectors that fail inside other interactions, keep detached ends, or are not offered (10.1, 10.1.5, 10.1.6)."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from contextlib import suppress
from typing import ClassVar

from ucm_cts.adapters.contract.adapter import NotOffered
from ucm_cts.adapters.contract.data_types import Datum, Interface
from ucm_cts.adapters.contract.programming_model import (
    BadParameter,
    DeclaredException,
    NotFound,
    PortElementObject,
    UcmError,
)
from ucm_cts.adapters.contract.scenario import MESSAGE_CONNECTOR, SERVICE_CONNECTOR
from ucm_cts.adapters.mutants.python.methods import alters, does_only_if, refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import Base, breaks
from ucm_cts.adapters.mutants.python.variants.readings import cascades
from ucm_cts.adapters.reference.python.connectors import COMM_ERROR, OK, Link, Taker
from ucm_cts.adapters.reference.python.members import HasMembers, Member

_CALLS, _EXCEPTIONS = "R-10.1.5.1-01", "R-10.1.5.1-10"
_ARRIVES = "R-10.1.2-10"

# interactions inside others


class _CountsInteractions(Link):
    """Knows of each thread how many calls it is serving, and whether it receives messages."""

    here: ClassVar[threading.local] = threading.local()

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        self.here.served = getattr(self.here, "served", 0) + 1
        try:
            return super()._request(method, arguments)
        finally:
            self.here.served -= 1

    def _deliver(self, taker: Taker, method: str) -> None:
        self.here.receives = True
        super()._deliver(taker, method)


_INTERFACES, _REFUSED = ("11.2.3",), {"incompatible-ends": "refused"}


@refuses_if("_request", _CALLS, clauses=("10.1.5",), also=("R-10.1.5.1-03",))
def refuses_calls_of_servers(self: _CountsInteractions, *_: object) -> bool:
    """A server that is handling a call can call no server."""
    return bool(getattr(self.here, "served", 0))


@refuses_if("_request", _CALLS, clauses=("10.1.5",))
def refuses_calls_of_receivers(self: _CountsInteractions, *_: object) -> bool:
    """A receiver that is handling a message can call no server."""
    return getattr(self.here, "receives", False)


@replaces("_emit", _ARRIVES, clauses=("10.1.2",))
def loses_what_servers_push(self: _CountsInteractions, method: str, arguments: Sequence[Datum]) -> str:
    """Messages pushed while a call is being served are lost, and push returns ok."""
    return OK if getattr(self.here, "served", 0) else _CountsInteractions._emit(self, method, arguments)


@replaces("_emit", _ARRIVES, clauses=("10.1.2",))
def loses_what_receivers_push(self: _CountsInteractions, method: str, arguments: Sequence[Datum]) -> str:
    """Messages pushed while a message is being received are lost, and push returns ok."""
    return OK if getattr(self.here, "receives", False) else _CountsInteractions._emit(self, method, arguments)


# restarts


class _Stale(Link):
    is_stale = False

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if self.is_stale:
            raise UcmError("the server is not the one that you know")
        return super()._request(method, arguments)


@breaks(_CALLS, clauses=("10.1.5",))
class knows_servers_until_they_are_restarted(Base):
    """A restarted server is out of reach until its clients have been restarted, too."""

    link_class = _Stale

    def _close_entrances(self, member: Member) -> None:
        for link, _ in self._takers_of(member):
            link.__dict__["is_stale"] = True
        super()._close_entrances(member)

    def _start_up(self, member: Member, failures: object) -> bool:
        if member.implementation.requires:
            for link in self.manager.links:
                link.__dict__["is_stale"] = False
        return super()._start_up(member, failures)  # type: ignore[arg-type]


# exceptions


@replaces("_request", _EXCEPTIONS, clauses=("10.1.5",), readings={"exception-transport": "full"})
def loses_exceptions_of_inherited_methods(self: Link, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """An exception that an inherited method declares arrives as an error of the framework."""
    try:
        return Link._request(self, method, arguments)
    except DeclaredException:
        if method in self.interface.inherited:
            raise UcmError("something went wrong") from None
        raise


@replaces("_request", _EXCEPTIONS, clauses=("10.1.5",), readings={"exception-transport": "full"})
def loses_the_second_field_of_exceptions(self: Link, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """All fields of an exception but the first arrive empty."""
    try:
        return Link._request(self, method, arguments)
    except DeclaredException as error:
        fields = [*error.fields[:1], *(0 if isinstance(f, int) else f for f in error.fields[1:])]
        raise DeclaredException(error.name, fields) from None


_CALLS, _ORIGIN = "R-10.1.5.1-01", "R-10.1.6.1-06"


@breaks("R-11.2.3-10", clauses=("10.1.5",), also=(_CALLS, "R-10.1.5.1-03"))
class detaches_all_ports_of_a_client(Link):
    """detach undoes the connections of all port elements of the component to that connector."""

    def detach(self, container: HasMembers, comp_instance: int, port: str) -> None:
        super().detach(container, comp_instance, port)
        with container._operation():
            member = container._find_member(comp_instance)
            for connection in container._connections_from(member):
                if self._is_behind(connection.target):
                    container._undo(connection)


class _KeepsDetached(Link):
    """Keeps the ends that have been detached."""

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)  # type: ignore[arg-type]
        self.detached: list[Taker] = []

    def remove(self, taker: Taker) -> None:
        super().remove(taker)
        self.detached.append(taker)

    def _call_detached(self, method: str, arguments: Sequence[Datum]) -> None:
        for taker in self.detached:
            element = taker.member.body.get_portElement(taker.port)
            with suppress(Exception):
                element.call(method, self._copied(arguments))  # type: ignore[union-attr]


@alters("_emit", _ORIGIN, clauses=("10.1.6",))
def delivers_to_those_who_are_gone(self: _KeepsDetached, code: str, method: str, arguments: Sequence[Datum]) -> str:
    """Receivers get messages after they have been detached or removed."""
    self._call_detached(method, arguments)
    return code


@replaces("_request", _CALLS, clauses=("10.1.5",))
def is_served_by_those_who_are_gone(self: _KeepsDetached, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """A detached server still serves calls, unless another server has been attached."""
    if self.connector == SERVICE_CONNECTOR and not self.takers and self.detached:
        element = self.detached[-1].member.body.get_portElement(self.detached[-1].port)
        return self._copied(element.call(method, self._copied(arguments)))  # type: ignore[union-attr]
    return _KeepsDetached._request(self, method, arguments)


@replaces("_check_removable", "R-11.2.3-11", clauses=("10.1.5", "10.1.6"))
def does_not_know_attached_components(self: Base, member: Member) -> None:
    """remove_component of what is attached to a connector ends with NOT_FOUND."""
    if self._takers_of(member):
        raise NotFound("attached")
    Base._check_removable(self, member)


@alters("_emit", "R-10.1.2-09", clauses=("10.1.2", "10.1.6"), also=("R-10.1.6.1-04",))
def counts_detached_receivers(self: _KeepsDetached, code: str, _method: str, _arguments: Sequence[Datum]) -> str:
    """When a receiver has been detached push gives comm_error."""
    return COMM_ERROR if self.detached else code


_CORE = "R-10.1-01"


@replaces("link", _CORE, clauses=("10.1.5",))
def has_no_services(self: Base, connector: str, interface: Interface) -> Link:
    """The adapter does not offer the service connector."""
    if connector == SERVICE_CONNECTOR:
        raise NotOffered
    return Base.link(self, connector, interface)


@replaces("link", _CORE, clauses=("10.1.6",))
def has_no_messages(self: Base, connector: str, interface: Interface) -> Link:
    """The adapter does not offer the message connector."""
    if connector == MESSAGE_CONNECTOR:
        raise NotOffered
    return Base.link(self, connector, interface)


@replaces("break_link", _CORE, clauses=("10.1.2",), readings={"transport-fault": "hook", "connector-fault": "hook"})
def never_breaks_a_transport(self: Link, where: str) -> None:
    """The vendor claims that the transport can be broken; the adapter does not offer it."""
    if where == "transport":
        raise NotOffered
    Link.break_link(self, where)


@replaces("read_log", _CORE, clauses=("10.1.4",), readings={"trace-sink": "hook"})
def keeps_its_log(_self: Base) -> list[tuple[str, str]]:
    """The vendor claims that the trace can be read back; the adapter does not offer it."""
    raise NotOffered


# ends with different interfaces


@replaces("_check_compatible", "R-11.2.3-18", clauses=_INTERFACES, readings=_REFUSED)
def connects_any_interfaces(_self: Base, *_: object) -> None:
    """connect does not compare the interfaces of the two port elements."""


@replaces("_check_compatible", "R-11.2.3-18", clauses=_INTERFACES, readings=_REFUSED)
def compares_names_of_methods(self: Base, member: Member, port: str, target: PortElementObject) -> None:
    """connect asks only whether both port elements have methods of the same names."""
    own = member.implementation.interfaces.get(port)
    provided = self._interfaces_of(target)
    if provided and _names_of(own) not in map(_names_of, provided):
        raise BadParameter("the reference has other methods")


def _names_of(interface: Interface | None) -> list[str]:
    return sorted(interface.methods) if interface is not None else []


@alters("_interfaces_of", "R-11.2.3-18", clauses=_INTERFACES, readings=_REFUSED)
def compares_interfaces_within_a_container_only(
    self: Base, found: list[Interface | None], target: PortElementObject
) -> list[Interface | None]:
    """connect does not compare interfaces if the reference is of another container."""
    own = [self._reference_to(m, port) for m in self.members.values() for port in m.implementation.provides]
    return found if any(element is target for element in own) else []


@replaces("_check_compatible", "R-11.2.3-18", clauses=_INTERFACES, readings=_REFUSED)
def attaches_any_interfaces(_self: Link, *_: object) -> None:
    """A connector takes port elements of any interface as its ends."""


@does_only_if("_check_compatible", "R-11.2.3-18", clauses=_INTERFACES, readings=_REFUSED)
def attaches_any_receivers(self: Link, *_: object) -> bool:
    """A message connector takes port elements of any interface as its ends."""
    return self.connector != MESSAGE_CONNECTOR


@breaks(
    "R-11.2.3-11",
    clauses=("10.1.2", "10.1.5", "10.1.6"),
    readings={
        "remove-while-connected": "cascade",
        "remove-provider-in-use": "cascade",
        "remove-while-ready": "cascade",
    },
)
class keeps_attached_clients(cascades):
    """A client or emitter that is attached to a connector is not removed; whatever else is connected is."""

    def remove_component(self, comp_instance: int) -> None:
        targets = [connection.target for connection in self._connections_from(self._find_member(comp_instance))]
        if any(link._is_behind(target) for link in self.manager.links for target in targets):
            raise UcmError("the component is attached")
        super().remove_component(comp_instance)
