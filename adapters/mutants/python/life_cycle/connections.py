"""Wrong frameworks that lose, mix up or keep connections in few situations only."""

from __future__ import annotations

from ucm_cts.adapters.contract.programming_model import Connectable, FragmentObject, PortConnection
from ucm_cts.adapters.mutants.python.methods import alters, replaces
from ucm_cts.adapters.mutants.python.registry import Base, breaks, is_below
from ucm_cts.adapters.mutants.python.variants.readings import appends_connections, cascades
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member

# what on_startup gets


@replaces("_dependencies_of", "R-11.2.1.2-03", "R-11.1.3-01", also=("R-11.1.2-02",))
def mixes_twins_up(self: Base, member: Member) -> list[PortConnection]:
    """Of two clients of one implementation the second is given the first one's references, and so calls the wrong one."""
    twin = next(m for m in self.members.values() if m.implementation is member.implementation)
    return Base._dependencies_of(self, twin)


@replaces("_dependencies_of", "R-11.2.3-10")
def forgets_a_port_at_restart(self: Base, member: Member) -> list[PortConnection]:
    """From the second start on, only the first connection's reference is handed over."""
    starts = member.__dict__["starts"] = member.__dict__.get("starts", 0) + 1
    return Base._dependencies_of(self, member)[: None if starts == 1 else 1]


@replaces("_dependencies_of", "R-11.2.1.2-09", also=("R-11.2.3-10",))
def serves_one_client(self: Base, member: Member) -> list[PortConnection]:
    """Of two clients of one provider the second is not given its reference."""
    every = self.manager.connections.values()
    given = Base._dependencies_of(self, member)
    return [d for d in given if next(c for c in every if c.target is d.to_port[0]).client is member]


@alters("_dependencies_of", "R-11.2.1.2-09", also=("R-11.2.3-10",))
def fragments_get_nothing(_self: Base, given: list[PortConnection], member: Member) -> list[PortConnection]:
    """on_startup hands no references over to fragments."""
    return [] if isinstance(member.body, FragmentObject) else given


@replaces("_initialise", "R-11.2.3-02")
def tries_new_components(self: Base, member: Member) -> None:
    """add_component calls the new body once."""
    Base._initialise(self, member)
    for port in member.implementation.provides:
        element = member.body.get_portElement(port)
        if element is not None:
            element.exchange(0)


@alters("_dependencies_of", "R-11.2.1.2-09")
def appends_in_vain(_self: appends_connections, given: list[PortConnection], member: Member) -> list[PortConnection]:
    """Takes a second connection of a port element and hands over the first one only."""
    return [PortConnection(d.from_port, d.to_port[:1]) for d in given]


# connections


@replaces("_connect", "R-11.2.1.3-04")
def announces_the_first_port(self: Base, connection: Connection) -> None:
    """on_connect names the port element that was connected first."""
    earlier = self._connections_from(connection.client)
    if not (earlier and isinstance(connection.client.body, Connectable)):
        Base._connect(self, connection)
        return
    connection.client.body.on_connect(earlier[0].port, connection.target)
    self.manager.connections[connection.id] = connection


@replaces("_disconnect_members", "R-11.2.1.3-05")
def destroys_connections_of_one_container(self: Base, failures: Failures) -> None:
    """Destroying a runtime with sub-containers undoes the connections of the first one, and forgets all others."""
    first = next(iter(self.manager.sub_containers), self)
    if self is first or not all(container.members for container in (first, self)):
        Base._disconnect_members(self, failures)


@replaces("_disconnect", "R-11.2.1.3-05", also=("R-11.1.3-04",))
def tells_providers_too(self: Base, connection: Connection, failures: Failures) -> None:
    """on_disconnect also comes to the component that provided the port element, if it is Connectable."""
    for container in (self.manager, *self.manager.sub_containers):
        for member in container.members.values():
            if isinstance(member.body, Connectable) and connection in container._connections_to(member):
                failures.attempt(member.body.on_disconnect, connection.port)
    Base._disconnect(self, connection, failures)


@breaks("R-11.2.1.3-06")
class misnames_in_cascades(cascades):
    """Where remove_component undoes several connections, each on_disconnect names the client's first port element."""

    def remove_component(self, comp_instance: int) -> None:
        self.__dict__["cascading"] = True
        try:
            super().remove_component(comp_instance)
        finally:
            self.__dict__["cascading"] = False

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        first = connection.client.implementation.requires[0]
        if self.__dict__.get("cascading"):
            self.manager.connections[connection.id] = connection = Connection(
                connection.id, connection.client, first, connection.target
            )
        super()._disconnect(connection, failures)


@replaces("disconnect", "R-12.10-16")
def forgives_disconnecting_twice(self: Base, connection: int) -> None:
    """disconnect of a connection that it has undone returns."""
    if connection not in self.__dict__.setdefault("undone", set()):
        Base.disconnect(self, connection)
        self.__dict__["undone"].add(connection)


@breaks("R-12.10-16")
class remembers_cascaded_connections(cascades):
    """disconnect of a connection that was undone with a removed component returns."""

    def remove_component(self, comp_instance: int) -> None:
        before = set(self.manager.connections)
        super().remove_component(comp_instance)
        self.__dict__.setdefault("undone", set()).update(before.difference(self.manager.connections))

    def disconnect(self, connection: int) -> None:
        if connection not in self.__dict__.get("undone", ()):
            super().disconnect(connection)


@alters("_connections_to", "R-11.2.3-14")
def forgets_clients_elsewhere(self: cascades, given: list[Connection], member: Member) -> list[Connection]:
    """Removing a provider undoes its connections to clients of its own container only."""
    return [c for c in given if c.client.container is self]


@alters("_connections_to", "R-11.2.3-14")
def forgets_the_second_client(_self: cascades, found: list[Connection], *_: object) -> list[Connection]:
    """Removing a provider undoes the connections of one client only."""
    return [c for c in found if c.client is found[0].client]


@alters("_connections_of_members", "R-11.2.3-14")
def keeps_connections_to_removed_containers(self: Base, own: list[Connection]) -> list[Connection]:
    """remove_container leaves clients elsewhere connected to what it removes."""
    return [c for c in own if c.client.container is self] if is_below(self) else own


@replaces("_disconnect", "R-11.2.2.1-10", "R-11.2.3-10", also=("R-11.2.1.3-05", "R-11.2.3-06"))
def drops_both_connections(self: appends_connections, connection: Connection, failures: Failures) -> None:
    """Undoing one of two connections of a port element undoes both, the other one without on_disconnect."""
    if connection.id in self.manager.connections:
        appends_connections._disconnect(self, connection, failures)
    for other in self._connections_from(connection.client):
        if other.port == connection.port:
            del self.manager.connections[other.id]


@replaces("stop", "R-11.2.3-06", also=("R-11.2.1.3-05", "R-11.2.2.1-10", "R-11.2.3-10"))
def loses_connections_when_idle(self: Base) -> None:
    """stop of a container that is not started loses the connections of its members, without on_disconnect."""
    for member in () if self.is_started else self.members.values():
        for connection in self._connections_from(member):
            del self.manager.connections[connection.id]
    Base.stop(self)
