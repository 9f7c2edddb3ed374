"""Conformant variants, one for each reading that the interpretations permit."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import (
    CONTAINER,
    Base,
    GivesOutProxies,
    HandsOverProxies,
    Proxy,
    is_below,
    variant,
    variant_of,
)
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member, State


@variant_of(*CONTAINER, readings={"remove-while-ready": "cascade", "remove-provider-in-use": "cascade"})
class cascades(Base):
    """remove_component shuts down and disconnects as much as necessary."""

    def _check_removable(self, member: Member) -> None:
        pass

    def remove_component(self, comp_instance: int) -> None:
        with self._operation():
            member = self._find_member(comp_instance)
            failures = Failures()
            if member in self.started:
                self.started.remove(member)
                self._shut_down(member, failures)
            for connection in {c.id: c for c in self._connections_from(member) + self._connections_to(member)}.values():
                self._disconnect(connection, failures)
            self._remove(member, failures)
            failures.report()


@variant_of(*CONTAINER, readings={"remove-while-ready": "cascade", "remove-provider-in-use": "dangling-tolerated"})
class lets_references_dangle(cascades):
    """The client of a removed provider keeps its reference, unconnected, without on_disconnect."""

    def remove_component(self, comp_instance: int) -> None:
        member = self.members.get(comp_instance)
        for connection in self._connections_to(member) if member is not None else ():
            if connection.client is not member:
                del self.manager.connections[connection.id]
        super().remove_component(comp_instance)


@variant_of(*CONTAINER, readings={"late-add": "deferred"})
class adds_later(Base):
    """add_component to a started container initialises; the component waits for the next start."""

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        started, self.is_started = self.is_started, False
        try:
            return super().add_component(implementation, attributes)
        finally:
            self.is_started = started

    def connect(self, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
        ready = instance in self.members and self.members[instance].state is State.READY
        started, self.is_started = self.is_started, self.is_started and ready
        try:
            return super().connect(instance, port_name, to_port)
        finally:
            self.is_started = started


@variant_of(*CONTAINER, readings={"late-add": "start-immediately"})
class starts_late_additions(adds_later):
    """add_component to a started container starts at once what requires nothing."""

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        identifier = super().add_component(implementation, attributes)
        member = self.members[identifier]
        if self.is_started and not member.implementation.requires:
            self._start_up(member, Failures())
        return identifier


@variant_of(*CONTAINER, readings={"late-connect": "allowed", "late-disconnect": "allowed"})
class configures_at_any_time(Base):
    """connect and disconnect work on operational components; callbacks belong to configuration and do not come."""

    def _check_configuring(self) -> None:
        pass

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        if self.is_started:
            raise pm.UcmError("no additions now")
        return super().add_component(implementation, attributes)

    def _connect(self, connection: Connection) -> None:
        if connection.client.state is State.READY:
            self.manager.connections[connection.id] = connection
        else:
            super()._connect(connection)


class _EndsWithItsConnection(Proxy):
    def exchange(self, value: int) -> int:
        connections = self.member.container.manager.connections.values()
        if not any(c.client is self.member and c.target is self.target for c in connections):
            raise pm.UcmError("the connection has been undone")
        return self.target.exchange(value)


@variant_of(*CONTAINER, readings={"late-connect": "allowed", "late-disconnect": "allowed"})
class breaks_what_it_undoes(HandsOverProxies, configures_at_any_time):
    """The same, and what a body was given at its start ends with its connection."""

    proxy = _EndsWithItsConnection


@variant_of(*CONTAINER, readings={"start-unconfigured": "tolerate", "late-connect": "refuse"})
class starts_the_unconfigured(Base):
    """start does not check that port elements are connected."""

    def _check_startable(self) -> None:
        pass


@variant
class starts_the_unconfigured_with_null(starts_the_unconfigured):
    """The same, with null references for what is not connected."""

    def _dependencies_of(self, member: Member) -> list[pm.PortConnection]:
        given = {d.from_port: d for d in super()._dependencies_of(member)}
        required = [given.pop(p, pm.PortConnection(p, (None,))) for p in member.implementation.requires]
        return [*required, *given.values()]


class LeadsNowhere(pm.PortElementObject):
    """Leads to what was removed, or undone, or was never there: calls are refused."""

    def exchange(self, value: int) -> int:
        raise pm.UcmError("there is nothing behind it")


@variant_of(
    *CONTAINER,
    readings={
        "remove-while-ready": "cascade",
        "remove-provider-in-use": "dangling-tolerated",
        "start-unconfigured": "tolerate",
        "late-connect": "refuse",
    },
)
class cuts_dangling_references_late(HandsOverProxies, lets_references_dangle):
    """Components are given a proxy for each required port element, connected or not; the client of a removed provider gets on_disconnect
    when the container of the provider is removed.
    """

    def _check_startable(self) -> None:
        pass

    def _dependencies_of(self, member: Member) -> list[pm.PortConnection]:
        given = {d.from_port: d for d in super()._dependencies_of(member)}
        nothing: dict[str, pm.PortConnection] = {
            port: pm.PortConnection(port, (LeadsNowhere(),))
            for port in member.implementation.requires
            if port not in given
        }
        return [*given.values(), *nothing.values()]

    def remove_component(self, comp_instance: int) -> None:
        member = self.members.get(comp_instance)
        found = self._connections_to(member) if member is not None else []
        super().remove_component(comp_instance)
        left = self.__dict__.setdefault("dangling", [])
        left += [c for c in found if c.client.container is not self and c.client.implementation.connectable]

    def _remove_container(self, container: Container, failures: Failures) -> None:
        for connection in container.__dict__.get("dangling", ()):
            client = connection.client
            is_there = client.id in client.container.members
            if is_there and not client.container._is_connected(client, connection.port):
                failures.attempt(client.body.on_disconnect, connection.port)
        super()._remove_container(container, failures)  # type: ignore[misc]  # the manager's


@variant_of(*CONTAINER, readings={"second-connect": "append or replace"})
class appends_connections(Base):
    """A port element takes any number of connections."""

    def connect(self, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
        self.__dict__["connecting"] = True
        try:
            return super().connect(instance, port_name, to_port)
        finally:
            self.__dict__["connecting"] = False

    def _is_connected(self, member: Member, port: str) -> bool:
        return not self.__dict__.get("connecting") and super()._is_connected(member, port)

    def _dependencies_of(self, member: Member) -> list[pm.PortConnection]:
        by_port: dict[str, list[pm.PortElementObject | None]] = {}
        for connection in self._connections_from(member):
            by_port.setdefault(connection.port, []).append(connection.target)
        return self._with_services(member, [pm.PortConnection(port, targets) for port, targets in by_port.items()])


@variant
class replaces_connections(appends_connections):
    """A second connection of a port element takes the place of the first."""

    def _connect(self, connection: Connection) -> None:
        for old in self._connections_from(connection.client):
            if old.port == connection.port:
                self._disconnect(old, Failures())
        super()._connect(connection)


@variant_of(*CONTAINER, readings={"id-scope": "container"})
class reuses_ids(Base):
    """The smallest free number is the next id; components and connections count separately in each container."""

    def _new_id(self) -> int:
        return next(n for n in range(-3, 10**6) if n not in self.members and n not in self.manager.connections)


@variant_of(*CONTAINER, readings={"double-start": "error", "stop-when-stopped": "error"})
class refuses_repetition(Base):
    """start when started and stop when stopped raise UCM_ERROR."""

    def start(self) -> None:
        if self.is_started:
            raise pm.UcmError("started")
        super().start()

    def stop(self) -> None:
        if not self.is_started:
            raise pm.UcmError("stopped")
        super().stop()


class _Deaf(Failures):
    def report(self) -> None:
        pass


@variant_of(*CONTAINER, readings={"callback-failure": "swallowed"})
class swallows_exceptions(Base):
    """Exceptions of bodies are ignored."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        self._set_attributes(member, attributes)
        if isinstance(member.body, pm.FragmentObject):
            _Deaf().attempt(member.body.set_container_interface, self)
        _Deaf().attempt(self._initialise, member)

    def _start_up(self, member: Member, failures: Failures) -> bool:
        super()._start_up(member, _Deaf()) or self._count_as_started(member)
        return True

    def _count_as_started(self, member: Member) -> bool:
        member.state = State.READY
        self.started.append(member)
        return True

    def _shut_down(self, member: Member, failures: Failures) -> None:
        super()._shut_down(member, _Deaf())

    def _remove(self, member: Member, failures: Failures) -> None:
        super()._remove(member, _Deaf())

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        super()._disconnect(connection, _Deaf())

    def _connect(self, connection: Connection) -> None:
        self.manager.connections[connection.id] = connection
        if isinstance(connection.client.body, pm.Connectable):
            _Deaf().attempt(connection.client.body.on_connect, connection.port, connection.target)


@variant_of(*CONTAINER, readings={"manager-start": "cascade", "manager-get-components": "recursive"})
class manager_reaches_down(Base):
    """The manager's start, stop and get_components include sub-containers."""

    def start(self) -> None:
        self._also(super().start, Container.start)

    def stop(self) -> None:
        self._also(super().stop, Container.stop)

    def get_components(self) -> list[int]:
        below = self.manager.sub_containers if not is_below(self) else []
        return super().get_components() + [i for c in below for i in Container.get_components(c)]

    def _also(self, own: Callable[[], None], below: Callable[[Container], None]) -> None:
        own()
        if not is_below(self):
            for container in self.manager.sub_containers:
                below(container)


@replaces("connect")
def other_errors(self: Base, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
    """Unknown port elements of connect are NOT_FOUND, null references UCM_ERROR, a taken one BAD_PARAMETER."""
    member = self.members.get(instance)
    if member is not None:
        if port_name not in member.implementation.requires:
            raise pm.NotFound(port_name)
        if to_port is None:
            raise pm.UcmError("nil")
        if self._is_connected(member, port_name):
            raise pm.BadParameter(port_name)
    return Base.connect(self, instance, port_name, to_port)


@variant
class starts_in_reverse(Base):
    """The last added is started first."""

    def _start_order(self) -> Sequence[Member]:
        return list(reversed(list(super()._start_order())))


@variant
class hands_out_proxies(GivesOutProxies):
    """All references are proxies, never the body's own object."""

    def connect(self, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
        return super(GivesOutProxies, self).connect(instance, port_name, to_port)

    def _connections_to(self, member: Member) -> list[Connection]:
        return [
            c for c in self.manager.connections.values() if isinstance(c.target, Proxy) and c.target.member is member
        ]


@variant
class removes_members_one_by_one(Base):
    """remove_container and destroy finish with each member before the next, last added first."""

    def _disconnect_members(self, failures: Failures) -> None:
        pass

    def _remove_members(self, failures: Failures) -> None:
        for member in reversed(list(self.members.values())):
            for connection in self._connections_to(member) + self._connections_from(member):
                if connection.id in self.manager.connections:
                    self._disconnect(connection, failures)
            self._remove(member, failures)


_ = ContainerManager


@variant_of(*CONTAINER, readings={"unknown-names": "ucm-error"})
class calls_unknown_names_an_error(Base):
    """connect and get_port_element raise UCM_ERROR for names that are no required or provided port element."""

    def connect(self, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
        if port_name not in self._find_member(instance).implementation.requires:
            raise pm.UcmError(f"no required port element {port_name!r}")
        return super().connect(instance, port_name, to_port)

    def get_port_element(self, comp_instance: int, port_name: str) -> pm.PortElementObject:
        if port_name not in self._find_member(comp_instance).implementation.provides:
            raise pm.UcmError(f"no provided port element {port_name!r}")
        return super().get_port_element(comp_instance, port_name)


@variant_of(*CONTAINER, readings={"container-interface": "repeated"})
class gives_the_container_at_each_start(Base):
    """A fragment gets its container's interface when it is added and again at each start."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        if isinstance(member.body, pm.FragmentObject):
            member.body.set_container_interface(self)
        return super()._start_up(member, failures)


@variant_of(*CONTAINER, readings={"id-scope": "runtime"})
class takes_ids_of_the_whole_runtime(Base):
    """Every container takes the ids of components and connections of all containers."""

    def _owner(self, comp_instance: int) -> Container:
        all_containers: list[Container] = [self, self.manager, *self.manager.sub_containers]
        return next((c for c in all_containers if comp_instance in c.members), self)

    def remove_component(self, comp_instance: int) -> None:
        Container.remove_component(self._owner(comp_instance), comp_instance)

    def get_port_element(self, comp_instance: int, port_name: str) -> pm.PortElementObject:
        return Container.get_port_element(self._owner(comp_instance), comp_instance, port_name)

    def connect(self, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
        return Container.connect(self._owner(instance), instance, port_name, to_port)

    def disconnect(self, connection: int) -> None:
        found = self.manager.connections.get(connection)
        owner = found.client.container if found is not None else self
        assert isinstance(owner, Container)
        Container.disconnect(owner, connection)
