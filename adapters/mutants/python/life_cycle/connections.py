"""Wrong frameworks that lose, mix up or keep connections in few situations only."""

from __future__ import annotations

from ucm_cts.adapters.contract.programming_model import Connectable, FragmentObject, PortConnection
from ucm_cts.adapters.mutants.python.methods import alters
from ucm_cts.adapters.mutants.python.registry import Base, breaks, is_below
from ucm_cts.adapters.mutants.python.variants.readings import appends_connections, cascades
from ucm_cts.adapters.reference.python.framework import Connection, Failures, Member

# what on_startup gets


@breaks("R-11.2.1.2-03", "R-11.1.3-01", also=("R-11.1.2-02",))
class mixes_twins_up(Base):
    """Of two clients of one implementation the second is given the first one's references, and so calls the wrong one."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        twin = next(m for m in self.members.values() if m.implementation is member.implementation)
        return super()._dependencies_of(twin)


@breaks("R-11.2.3-10")
class forgets_a_port_at_restart(Base):
    """From the second start on, only the first connection's reference is handed over."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        starts = member.__dict__["starts"] = member.__dict__.get("starts", 0) + 1
        return super()._dependencies_of(member)[: None if starts == 1 else 1]


@breaks("R-11.2.1.2-09", also=("R-11.2.3-10",))
class serves_one_client(Base):
    """Of two clients of one provider the second is not given its reference."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        every = self.manager.connections.values()
        given = super()._dependencies_of(member)
        return [d for d in given if next(c for c in every if c.target is d.to_port[0]).client is member]


@alters("_dependencies_of", "R-11.2.1.2-09", also=("R-11.2.3-10",))
def fragments_get_nothing(_self: Base, given: list[PortConnection], member: Member) -> list[PortConnection]:
    """Fragments are handed no references over."""
    return [] if isinstance(member.body, FragmentObject) else given


@breaks("R-11.2.3-02")
class tries_new_components(Base):
    """add_component calls the new body once, to see that it answers."""

    def _initialise(self, member: Member) -> None:
        super()._initialise(member)
        for port in member.implementation.provides:
            element = member.body.get_portElement(port)
            if element is not None:
                element.exchange(0)


@breaks("R-11.2.1.2-09")
class appends_in_vain(appends_connections):
    """Takes a second connection of a port element and hands over the first one only."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        return [PortConnection(d.from_port, d.to_port[:1]) for d in super()._dependencies_of(member)]


# connections


@breaks("R-11.2.1.3-04")
class announces_the_first_port(Base):
    """on_connect names the port element that was connected first."""

    def _connect(self, connection: Connection) -> None:
        earlier = self._connections_from(connection.client)
        if not (earlier and isinstance(connection.client.body, Connectable)):
            super()._connect(connection)
            return
        connection.client.body.on_connect(earlier[0].port, connection.target)
        self.manager.connections[connection.id] = connection


@breaks("R-11.2.1.3-05")
class destroys_connections_of_one_container(Base):
    """Destroying a runtime with sub-containers undoes the connections of the first one, and forgets all others."""

    def _disconnect_members(self, failures: Failures) -> None:
        first = next(iter(self.manager.sub_containers), self)
        if self is first or not all(container.members for container in (first, self)):
            super()._disconnect_members(failures)


@breaks("R-11.2.1.3-05", also=("R-11.1.3-04",))
class tells_providers_too(Base):
    """on_disconnect also comes to the component that provided, if it is Connectable."""

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        for container in (self.manager, *self.manager.sub_containers):
            for member in container.members.values():
                if isinstance(member.body, Connectable) and connection in container._connections_to(member):
                    failures.attempt(member.body.on_disconnect, connection.port)
        super()._disconnect(connection, failures)


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


@breaks("R-12.10-16")
class forgives_disconnecting_twice(Base):
    """disconnect of a connection that it has undone returns."""

    def disconnect(self, connection: int) -> None:
        if connection not in self.__dict__.setdefault("undone", set()):
            super().disconnect(connection)
            self.__dict__["undone"].add(connection)


@breaks("R-12.10-16")
class remembers_cascaded_connections(cascades):
    """disconnect of a connection that went with a removed component returns."""

    def remove_component(self, comp_instance: int) -> None:
        before = set(self.manager.connections)
        super().remove_component(comp_instance)
        self.__dict__.setdefault("undone", set()).update(before.difference(self.manager.connections))

    def disconnect(self, connection: int) -> None:
        if connection not in self.__dict__.get("undone", ()):
            super().disconnect(connection)


@breaks("R-11.2.3-14")
class forgets_clients_elsewhere(cascades):
    """Removing a provider undoes its connections to clients of its own container only."""

    def _connections_to(self, member: Member) -> list[Connection]:
        return [c for c in super()._connections_to(member) if c.client.container is self]


@breaks("R-11.2.3-14")
class forgets_the_second_client(cascades):
    """Removing a provider undoes the connections of one client only."""

    def _connections_to(self, member: Member) -> list[Connection]:
        found = super()._connections_to(member)
        return [c for c in found if c.client is found[0].client]


@alters("_connections_of_members", "R-11.2.3-14")
def keeps_connections_to_removed_containers(self: Base, own: list[Connection]) -> list[Connection]:
    """remove_container leaves clients elsewhere connected to what it removes."""
    return [c for c in own if c.client.container is self] if is_below(self) else own


@breaks("R-11.2.2.1-10", "R-11.2.3-10", also=("R-11.2.1.3-05", "R-11.2.3-06"))
class drops_both_connections(appends_connections):
    """Undoing one of a port element's two connections undoes both; for the other one on_disconnect never comes."""

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        if connection.id in self.manager.connections:
            super()._disconnect(connection, failures)
        for other in self._connections_from(connection.client):
            if other.port == connection.port:
                del self.manager.connections[other.id]


@breaks("R-11.2.3-06", also=("R-11.2.1.3-05", "R-11.2.2.1-10", "R-11.2.3-10"))
class loses_connections_when_idle(Base):
    """stop of a container that is not started loses the connections of its members, without on_disconnect."""

    def stop(self) -> None:
        for member in () if self.is_started else self.members.values():
            for connection in self._connections_from(member):
                del self.manager.connections[connection.id]
        super().stop()
