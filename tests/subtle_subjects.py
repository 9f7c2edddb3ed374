"""More frameworks with one defect each: it shows in few situations only, or far from where it happens."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from variants import adds_later, appends_connections, cascades, configures_at_any_time
from wrong_subjects import Base, GivesOutProxies, Proxy, breaks

from ucm_cts.adapters.contract.programming_model import (
    Connectable,
    FragmentObject,
    PortConnection,
    PortElementObject,
    UcmError,
)
from ucm_cts.adapters.reference_py.framework import Connection, Container, Failures, Member, State


def _below(container: Container) -> bool:
    return container is not container.manager


# business calls


class _Plain(Proxy):
    def exchange(self, value: int) -> int:
        return self.target.exchange(value)


class _HandsOver(Base):
    """Components are given proxies at start, one a reference."""

    proxy: type[Proxy] = _Plain

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = super()._dependencies_of(member)
        return [PortConnection(d.from_port, tuple(self.proxy(t, member) for t in d.to_port if t)) for d in given]


class _Twice(Proxy):
    def exchange(self, value: int) -> int:
        self.target.exchange(value)
        return self.target.exchange(value)


@breaks("R-11.1.3-01", "R-11.1.2-02")
class delivers_twice(_HandsOver):
    """A call of one component runs the other one's body twice, fragments or not."""

    proxy = _Twice


class _Remembers(Proxy):
    result: int | None = None

    def exchange(self, value: int) -> int:
        if self.result is None:
            self.result = self.target.exchange(value)
        return self.result


@breaks("R-11.1.3-01", also=("R-11.1.2-02",))
class calls_once(_HandsOver):
    """Only the first call through a connection reaches the other component; later ones get its result again."""

    proxy = _Remembers


@breaks("R-11.1.3-01", also=("R-11.1.2-02",))
class calls_the_first_provider(_HandsOver):
    """Calls through any required port element reach the provider of the first one."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = super()._dependencies_of(member)
        return [
            PortConnection(d.from_port, tuple(_Plain(given[0].to_port[0], member) for _ in d.to_port)) for d in given
        ]


class _Unsigned(Proxy):
    def exchange(self, value: int) -> int:
        return self.target.exchange(abs(value))


@breaks("R-11.1.3-01", "R-11.1.2-02")
class drops_the_sign(_HandsOver):
    """A component that is sent a negative payload by another one receives a positive one."""

    proxy = _Unsigned


class _Clipped(Proxy):
    def exchange(self, value: int) -> int:
        return self.target.exchange(max(value, 1 - 2**31))


@breaks("R-11.1.3-01", "R-11.1.2-02")
class loses_the_smallest(_HandsOver):
    """The smallest payload arrives as the second smallest."""

    proxy = _Clipped


@breaks("R-11.1.3-01", "R-11.1.2-02")
class calls_the_first_element(Base):
    """Calls between components reach the provider's first port element, whichever is connected."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = super()._dependencies_of(member)
        return [PortConnection(d.from_port, tuple(_Plain(self._first(t), member) for t in d.to_port)) for d in given]

    def _first(self, target: PortElementObject | None) -> PortElementObject:
        containers = (self.manager, *self.manager.sub_containers)
        bodies = [(m.body, m.implementation.provides) for c in containers for m in c.members.values()]
        owners = [b.get_portElement(ports[0]) for b, ports in bodies if target in map(b.get_portElement, ports)]
        element = owners[0] if owners else target
        assert element is not None
        return element


class _Cut(Proxy):
    def exchange(self, value: int) -> int:
        raise UcmError("stopped")


@breaks("R-11.2.3-03")
class is_dead_after_restart(Base):
    """What the second on_startup hands over refuses every call."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = super()._dependencies_of(member)
        if not member.__dict__.setdefault("started_before", False):
            member.__dict__["started_before"] = True
            return given
        return [PortConnection(d.from_port, tuple(_Cut(t, member) for t in d.to_port if t)) for d in given]


@breaks("R-11.2.2.1-06", also=("R-11.1.3-01", "R-11.1.2-02"))
class any_proxy_will_do(GivesOutProxies):
    """get_port_element gives a proxy of the first provided port element whatever the name; only calls show it."""

    proxy = _Plain

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        Container.get_port_element(self, comp_instance, port_name)
        member = self.members[comp_instance]
        first = member.body.get_portElement(member.implementation.provides[0])
        assert first is not None
        return _Plain(first, member)


class _Dead(PortElementObject):
    def exchange(self, value: int) -> int:
        raise UcmError("given out before")


@breaks("R-11.2.1.2-07", "R-11.2.3-03")
class gives_references_once(Base):
    """Who asks for a port element again gets a reference that refuses every call, also of components."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(comp_instance, port_name)
        given: set[tuple[int, str]] = self.__dict__.setdefault("given", set())
        if (comp_instance, port_name) in given:
            return _Dead()
        given.add((comp_instance, port_name))
        return element


@breaks("R-11.2.2.1-06")
class confuses_twins_after_removals(Base):
    """Once a component was removed, get_port_element gives that of the first instance of the implementation."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(comp_instance, port_name)
        wanted = self.members[comp_instance].implementation
        twin = next(m for m in self.members.values() if m.implementation is wanted)
        return (twin.body.get_portElement(port_name) or element) if self.__dict__.get("removed") else element

    def _remove(self, member: Member, failures: Failures) -> None:
        super()._remove(member, failures)
        self.__dict__["removed"] = True


@breaks("R-11.2.1.2-07", also=("R-11.1.3-01", "R-11.2.3-14"))
class any_twin_will_do(GivesOutProxies):
    """get_port_element gives a proxy of the first instance of the implementation."""

    proxy = _Plain

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = Container.get_port_element(self, comp_instance, port_name)
        wanted = self.members[comp_instance].implementation
        twin = next(m for m in self.members.values() if m.implementation is wanted)
        return _Plain(twin.body.get_portElement(port_name) or element, twin)


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


@breaks("R-11.2.1.2-09")
class serves_one_client(Base):
    """Of two clients of one provider the second is not given its reference."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        every = self.manager.connections.values()
        given = super()._dependencies_of(member)
        return [d for d in given if next(c for c in every if c.target is d.to_port[0]).client is member]


@breaks("R-11.2.1.2-09")
class fragments_get_nothing(Base):
    """Fragments are handed no references over."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        return [] if isinstance(member.body, FragmentObject) else super()._dependencies_of(member)


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


# members, listed, started and stopped


@breaks("R-11.2.2.1-11")
class forgets_the_fourth_below(Base):
    """start leaves out the fourth member of a sub-container."""

    def _start_order(self) -> Sequence[Member]:
        order = list(super()._start_order())
        return [*order[:3], *order[4:]] if _below(self) else order


@breaks("R-11.2.2.1-11", also=("R-11.2.1.4-01",))
class forgets_the_fifth(Base):
    """start leaves out the fifth member, be it a fragment or not."""

    def _start_order(self) -> Sequence[Member]:
        order = list(super()._start_order())
        return [*order[:4], *order[5:]]


@breaks("R-11.2.2.1-11", also=("R-11.2.1.4-01",))
class starts_sixteen(Base):
    """start reaches sixteen members and no more."""

    def _start_order(self) -> Sequence[Member]:
        return list(super()._start_order())[:16]


@breaks("R-11.2.2.1-13")
class swaps_the_last_two(Base):
    """Of three or more members the two started last are shut down in the order of their start."""

    def stop(self) -> None:
        if len(self.started) >= 3:
            self.started[-1], self.started[-2] = self.started[-2], self.started[-1]
        super().stop()


@breaks("R-11.2.2.1-13")
class fragments_turn_the_order(Base):
    """Where a fragment is among the members, stop goes in the order of their start."""

    def stop(self) -> None:
        if any(isinstance(m.body, FragmentObject) for m in self.started):
            self.started.reverse()
        super().stop()


@breaks("R-11.2.2.1-13")
class stops_in_order_once(Base):
    """Only the first stop of a container goes in reverse."""

    def stop(self) -> None:
        stops = self.__dict__["stops"] = self.__dict__.get("stops", 0) + 1
        if stops > 1:
            self.started.reverse()
        super().stop()


@breaks("R-11.2.2.1-14")
class caches_the_list(Base):
    """While a sub-container is started, get_components lists what was there when it was first asked so."""

    def get_components(self) -> list[int]:
        listed = super().get_components()
        if not (_below(self) and self.is_started):
            return listed
        return self.__dict__.setdefault("listed", listed)  # type: ignore[no-any-return]


@breaks("R-12.10-15")
class confuses_removed_ids(Base):
    """get_port_element for a removed component's id gives that of the member added last."""

    def remove_component(self, comp_instance: int) -> None:
        super().remove_component(comp_instance)
        self.__dict__.setdefault("removed", []).append(comp_instance)

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        if comp_instance in self.__dict__.get("removed", []) and comp_instance not in self.members and self.members:
            comp_instance = list(self.members)[-1]
        return super().get_port_element(comp_instance, port_name)


@breaks("R-12.10-15", also=("R-11.1.3-04",))
class finds_members_elsewhere(Base):
    """Component ids work with every container of the runtime."""

    def _find_member(self, number: int) -> Member:
        for container in (self.manager, *self.manager.sub_containers):
            if number in container.members:
                return container.members[number]
        return super()._find_member(number)

    def _remove(self, member: Member, failures: Failures) -> None:
        if member.container is self:
            super()._remove(member, failures)
        else:
            member.container._remove(member, failures)


@breaks("R-12.10-16", also=("R-11.1.3-04",))
class undoes_connections_elsewhere(Base):
    """Connection ids work with every container of the runtime."""

    def disconnect(self, connection: int) -> None:
        found = self.manager.connections.get(connection)
        container = found.client.container if found is not None else self
        Container.disconnect(container, connection)


# attributes and fragments


@breaks("R-11.2.1.2-05")
class fragments_have_no_attributes(Base):
    """Attributes of fragments are not set."""

    def _set_attributes(self, member: Member, attributes: Mapping[str, str]) -> None:
        if not isinstance(member.body, FragmentObject):
            super()._set_attributes(member, attributes)


@breaks("R-11.2.1.2-05")
class sets_attributes_once(Base):
    """Attributes are set for the first instance of an implementation only."""

    def _set_attributes(self, member: Member, attributes: Mapping[str, str]) -> None:
        known: set[str] = self.manager.__dict__.setdefault("known", set())
        if member.implementation.name not in known:
            super()._set_attributes(member, attributes)
        known.add(member.implementation.name)


@breaks("R-11.2.1.2-05")
class no_attributes_below(Base):
    """Attributes are set in the manager only."""

    def _set_attributes(self, member: Member, attributes: Mapping[str, str]) -> None:
        if not _below(self):
            super()._set_attributes(member, attributes)


@breaks("R-11.2.1.4-03")
class shows_fragments_the_manager(Base):
    """Fragments of sub-containers are given the manager instead of their own container."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        self._set_attributes(member, attributes)
        if isinstance(member.body, FragmentObject):
            member.body.set_container_interface(self.manager)
        self._initialise(member)


class _Remembered:
    """What a container listed when it was first asked."""

    def __init__(self, container: Container) -> None:
        self.container = container
        self.listed: list[int] | None = None

    def get_components(self) -> list[int]:
        if self.listed is None:
            self.listed = self.container.get_components()
        return self.listed


@breaks("R-11.2.1.4-03")
class shows_fragments_the_past(Base):
    """What a fragment once learnt of its container's members it is told ever after."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        self._set_attributes(member, attributes)
        if isinstance(member.body, FragmentObject):
            member.body.set_container_interface(_Remembered(self))
        self._initialise(member)


@breaks("R-11.2.1.4-02")
class shows_fragments_their_container_again(Base):
    """set_container_interface comes again with the second start."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        starts = member.__dict__["starts"] = member.__dict__.get("starts", 0) + 1
        if starts == 2 and isinstance(member.body, FragmentObject):
            member.body.set_container_interface(self)
        return super()._start_up(member, failures)


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


@breaks("R-11.2.3-14")
class keeps_connections_to_removed_containers(Base):
    """remove_container leaves clients elsewhere connected to what it removes."""

    def _connections_of_members(self) -> list[Connection]:
        own = super()._connections_of_members()
        return [c for c in own if c.client.container is self] if _below(self) else own


@breaks("R-11.2.2.1-10", "R-11.2.3-10", also=("R-11.2.1.3-05", "R-11.2.3-06"))
class drops_both_connections(appends_connections):
    """Undoing one of a port element's two connections undoes both; for the other one on_disconnect never comes."""

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        if connection.id in self.manager.connections:
            super()._disconnect(connection, failures)
        for other in self._connections_from(connection.client):
            if other.port == connection.port:
                del self.manager.connections[other.id]


@breaks("R-11.2.3-06", also=("R-11.2.2.1-10", "R-11.2.3-10"))
class loses_connections_when_idle(Base):
    """stop of a container that is not started loses the connections of its members, and tells nobody."""

    def stop(self) -> None:
        for member in () if self.is_started else self.members.values():
            for connection in self._connections_from(member):
                del self.manager.connections[connection.id]
        super().stop()


# removal of containers


@breaks("R-11.2.2.2-04", also=("R-11.2.2.2-05",))
class removes_the_first_only(Base):
    """remove_container, and destroy below the manager, call on_remove on one member only."""

    def _remove_members(self, failures: Failures) -> None:
        for member in list(self.members.values())[1:] if _below(self) else ():
            del self.members[member.id]
        super()._remove_members(failures)


# failing bodies


@breaks("R-11.2.3-09")
class leaves_the_rest_ready(Base):
    """After a failing on_shutdown the others are not shut down, and the next start starts them again."""

    def _shut_down_started(self, failures: Failures) -> None:
        while self.started and not failures.first:
            self._shut_down(self.started.pop(), failures)
        self.started.clear()
        self.is_started = False


@breaks("R-11.2.2.2-01", also=("R-11.2.3-07",))
class never_recovers_from_a_failing_stop(Base):
    """After a failing on_shutdown the container counts as started for good: stop and start return and do nothing."""

    def stop(self) -> None:
        try:
            super().stop()
        except UcmError:
            self.__dict__["stuck"] = True
            raise

    def start(self) -> None:
        if not self.__dict__.get("stuck"):
            super().start()


@breaks("R-11.2.1.2-10")
class shuts_down_what_never_started(Base):
    """After a failing on_startup every member is told on_shutdown, started or not."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        if super()._start_up(member, failures):
            return True
        self.started = list(self.members.values())
        return False


@breaks("R-12.10-22")
class starts_what_failed_to_initialise(Base):
    """A body whose on_init raised is started with the others, though it is no member."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        try:
            super()._configure(member, attributes)
        except Exception:
            self.__dict__.setdefault("ghosts", []).append(member)
            raise

    def start(self) -> None:
        again = self.is_started
        super().start()
        for ghost in self.__dict__.get("ghosts", []) if not again else ():
            Failures().attempt(ghost.body.on_startup, [])


# changes in the operational phase


@breaks("R-11.2.2.1-11")
class never_starts_late_additions(adds_later):
    """What was added to a started container and requires something is never started, not even after a stop."""

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        late = self.is_started
        identifier = super().add_component(implementation, attributes)
        self.members[identifier].__dict__["late"] = late
        return identifier

    def _start_order(self) -> Sequence[Member]:
        return [m for m in super()._start_order() if not (m.__dict__["late"] and m.implementation.requires)]


@breaks("R-11.2.1.3-02")
class connects_late_additions_silently(adds_later):
    """A component that was added to a started container is not told on_connect there."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        self.__dict__["silent"] = self.is_started
        return super().connect(instance, port_name, to_port)

    def _connect(self, connection: Connection) -> None:
        if self.__dict__["silent"]:
            self.manager.connections[connection.id] = connection
        else:
            super()._connect(connection)


@breaks("R-11.2.1.2-09")
class loses_late_connections(adds_later):
    """What was connected in a started container is not handed over at the next start."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        late = self.is_started
        identifier = super().connect(instance, port_name, to_port)
        self.__dict__.setdefault("lost", set()).update({identifier} if late else ())
        return identifier

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        lost = self.__dict__.get("lost", ())
        return [PortConnection(c.port, (c.target,)) for c in self._connections_from(member) if c.id not in lost]


@breaks("R-11.2.3-10")
class loses_connections_of_ready_components(configures_at_any_time):
    """connect of an operational component returns an id and does nothing."""

    def _connect(self, connection: Connection) -> None:
        if connection.client.state is not State.READY:
            super()._connect(connection)


@breaks("R-11.2.3-01")
class starts_late_additions_unconnected(adds_later):
    """A component added to a started container is started at once, connected or not."""

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        identifier = super().add_component(implementation, attributes)
        if self.is_started:
            self._start_up(self.members[identifier], Failures())
        return identifier
