"""Conformant variants that remove what is attached to a connector, or in use elsewhere, in their own way (11.2.2.2, 11.2.3)."""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.mutants.python.methods import refuses_if
from ucm_cts.adapters.mutants.python.registry import Base, variant_of
from ucm_cts.adapters.reference.python.connectors import COMM_ERROR, Link
from ucm_cts.adapters.reference.python.framework import Container
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member, State

_CLAUSES = ("10.1.2", "10.1.5", "10.1.6")


def _senders_of(link: Link) -> list[Connection]:
    """The connections of the clients or emitters of ``link``."""
    return [c for c in link.manager.connections.values() if link._is_behind(c.target)]


@refuses_if(
    "_check_removable",
    clauses=_CLAUSES,
    readings={"remove-while-connected": "refuse", "remove-provider-in-use": "refuse"},
)
def keeps_what_is_attached(self: Base, member: Member) -> bool:
    """remove_component refuses what is connected or attached to a connector."""
    return bool(self._connections_from(member) or self._takers_of(member))


@refuses_if(
    "_check_removable",
    clauses=_CLAUSES,
    readings={"remove-while-connected": "cascade", "remove-provider-in-use": "refuse"},
)
def keeps_what_connectors_use(self: Base, member: Member) -> bool:
    """remove_component refuses what is attached to a connector, also a client or an emitter; what is connected without one is disconnected."""
    targets = [connection.target for connection in self._connections_from(member)]
    return bool(self._takers_of(member)) or any(link._is_behind(t) for link in self.manager.links for t in targets)


@variant_of(*_CLAUSES)
class disconnects_senders_without_takers(Base):
    """When the last server or receiver of a connection is removed its clients or emitters are disconnected."""

    def _leave_links(self, member: Member) -> None:
        links = [link for link, _ in self._takers_of(member)]
        super()._leave_links(member)
        for link in links:
            for sender in _senders_of(link) if not link.takers else ():
                sender.client.container._undo(sender)


@variant_of("10.1.2", "10.1.6", readings={"remove-while-ready": "cascade"})
class reports_ends_that_were_not_detached(Base):
    """Once a receiver that is operational, and cannot be detached, has been removed, push gives comm_error."""

    class link_class(Link):
        is_maimed = False

        def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
            code = super()._emit(method, arguments)
            return COMM_ERROR if self.is_maimed else code

    def _check_removable(self, member: Member) -> None:
        state, member.state = member.state, State.CONFIGURING
        try:
            super()._check_removable(member)
        finally:
            member.state = state
        if member in self.started:
            self.started.remove(member)
            self._shut_down(member, Failures())
            for link, _ in self._takers_of(member):
                link.__dict__["is_maimed"] = True


@refuses_if("_remove_container", readings={"remove-container-in-use": "refuse"})
def keeps_containers_in_use(self: Base, container: Container, _failures: Failures) -> bool:
    """remove_container refuses while components of other containers are connected to members."""
    return is_used_elsewhere(container)


def is_used_elsewhere(container: Container) -> bool:
    """Is a component of another container connected to a member?"""
    members = list(container.members.values())
    connections = [c for member in members for c in container._connections_to(member)]
    for link, _ in (one for member in members for one in container._takers_of(member)):
        connections += _senders_of(link)
    return any(c.client.container is not container for c in connections)
