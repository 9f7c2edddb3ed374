"""More conformant variants: readings combined, orders and threads of the framework's own, rarer freedoms."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from variants import (
    adds_later,
    appends_connections,
    cascades,
    configures_at_any_time,
    lets_references_dangle,
    manager_reaches_down,
    refuses_repetition,
    removes_members_one_by_one,
    replaces_connections,
    reuses_ids,
    starts_in_reverse,
    starts_late_additions,
    starts_the_unconfigured,
    starts_the_unconfigured_with_null,
    swallows_exceptions,
    variant,
)
from wrong_subjects import Base, GivesOutProxies, Proxy

from ucm_cts.adapters.contract.programming_model import (
    BadParameter,
    ComponentObject,
    FragmentObject,
    Implementation,
    NotFound,
    PortConnection,
    PortElementObject,
    UcmError,
)
from ucm_cts.adapters.reference_py.framework import Connection, Container, Failures, Member, State

# which error comes first


@variant
class looks_at_the_phase_first(Base):
    """A started container refuses connect, disconnect and remove_component before it looks at an argument."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        self._check_configuring()
        return super().connect(instance, port_name, to_port)

    def disconnect(self, connection: int) -> None:
        self._check_configuring()
        super().disconnect(connection)

    def remove_component(self, comp_instance: int) -> None:
        self._check_configuring()
        super().remove_component(comp_instance)


def _of_live_members(container: Container) -> list[PortElementObject | None]:
    everywhere = (container.manager, *container.manager.sub_containers)
    return [
        m.body.get_portElement(p) for c in everywhere for m in c.members.values() for p in m.implementation.provides
    ]


@variant
class knows_stale_references(Base):
    """The reference of a removed instance is NOT_FOUND where a component is known."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        member = self.members.get(instance)
        known = member is not None and port_name in member.implementation.requires
        if known and to_port is not None and to_port not in _of_live_members(self):
            raise NotFound("of a removed instance")
        return super().connect(instance, port_name, to_port)


@variant
class knows_stale_references_at_any_time(knows_stale_references, cascades, configures_at_any_time):
    """The same, where providers in use are removed and connections change while components are operational."""


@variant
class late_connections_are_bad_parameters(Base):
    """connect in a started container raises BAD_PARAMETER."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        if self.is_started and instance in self.members:
            raise BadParameter("late")
        return super().connect(instance, port_name, to_port)


# identifiers and lists


@variant
class numbers_slots(replaces_connections):
    """A connection's id is that of its client's port element: what replaces another connection takes over its id."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        made = self.manager.connections.pop(super().connect(instance, port_name, to_port))
        slots: dict[tuple[int, str], int] = self.manager.__dict__.setdefault("slots", {})
        slot = slots.setdefault((made.client.id, port_name), len(slots) + 1)
        self.manager.connections[slot] = Connection(slot, made.client, made.port, made.target)
        return slot


@variant
class odd_ids(Base):
    """Ids are at both ends of the 32 bits, negative, or zero."""

    def _new_id(self) -> int:
        number = super()._new_id()
        return (2**31 - number, -(2**31) + number - 1, 0 if number == 3 else -number)[number % 3]


@variant
class sorts_its_list(Base):
    """get_components lists the highest id first."""

    def get_components(self) -> list[int]:
        return sorted(super().get_components(), reverse=True)


# orders


@variant
class announces_before_replacing(appends_connections):
    """Where a connection is replaced, on_connect of the new one comes before on_disconnect of the old one."""

    def _connect(self, connection: Connection) -> None:
        old = [c for c in self._connections_from(connection.client) if c.port == connection.port]
        super()._connect(connection)
        for replaced in old:
            self._disconnect(replaced, Failures())


@variant
class starts_providers_first(Base):
    """A component is started after those it is connected to, as far as rings allow."""

    def _start_order(self) -> Sequence[Member]:
        order: list[Member] = []
        for member in super()._start_order():
            self._visit(member, order, ())
        return order

    def _visit(self, member: Member, order: list[Member], below: tuple[Member, ...]) -> None:
        if member in order or member in below:
            return
        for provider in self.members.values():
            if any(c.client is member for c in self._connections_to(provider)):
                self._visit(provider, order, (*below, member))
        order.append(member)


@variant
class alternates(Base):
    """Every second start goes the other way round."""

    def _start_order(self) -> Sequence[Member]:
        self.__dict__["backwards"] = not self.__dict__.get("backwards", True)
        return list(super()._start_order())[:: -1 if self.__dict__["backwards"] else 1]


@variant
class takes_down_in_startup_order(Base):
    """remove_container and destroy shut members down in the order of their start; only stop must reverse it."""

    def _take_down(self, containers: Sequence[Container], failures: Failures) -> None:
        for container in containers:
            container.started.reverse()
        super()._take_down(containers, failures)


@variant
class shows_the_container_after_init(Base):
    """set_container_interface comes after on_init."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        self._set_attributes(member, attributes)
        self._initialise(member)
        if isinstance(member.body, FragmentObject):
            member.body.set_container_interface(self)


@variant
class shows_the_container_at_start(Base):
    """set_container_interface comes right before the first on_startup."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        self._set_attributes(member, attributes)
        self._initialise(member)

    def _start_up(self, member: Member, failures: Failures) -> bool:
        if isinstance(member.body, FragmentObject) and not member.__dict__.get("shown"):
            member.__dict__["shown"] = True
            if not failures.attempt(member.body.set_container_interface, self):
                return False
        return super()._start_up(member, failures)


# what on_startup gets


@variant
class one_entry_a_connection(appends_connections):
    """Two connections of a port element make two entries of the list, the later one first."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        return [PortConnection(c.port, (c.target,)) for c in reversed(self._connections_from(member))]


@variant
class lists_unconnected_ports(starts_the_unconfigured):
    """What is not connected has an entry without references; entries come in an order of their own."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = {d.from_port: d for d in super()._dependencies_of(member)}
        return [given.get(port, PortConnection(port, ())) for port in reversed(member.implementation.requires)]


class _Plain(Proxy):
    def exchange(self, value: int) -> int:
        return self.target.exchange(value)


@variant
class proxies_between_components(Base):
    """Components are given proxies at start; what get_port_element and on_connect give is the body's own object."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = super()._dependencies_of(member)
        return [PortConnection(d.from_port, tuple(self._proxy(t, member) for t in d.to_port)) for d in given]

    def _proxy(self, target: PortElementObject | None, member: Member) -> PortElementObject | None:
        return None if target is None else _Plain(target, member)


@variant
class proxies_of_appended(proxies_between_components, appends_connections):
    """The same, with any number of connections a port element."""


class _ReplacesAtAnyTime(replaces_connections, configures_at_any_time):
    def _connect(self, connection: Connection) -> None:
        for old in self._connections_from(connection.client):
            if old.port == connection.port:
                self._disconnect(old, Failures())
        configures_at_any_time._connect(self, connection)


@variant
class proxies_of_replaced(proxies_between_components, _ReplacesAtAnyTime):
    """The same, with connections that replace each other at any time."""


class _Reserved(Proxy):
    def exchange(self, value: int) -> int:
        if self.member.state is not State.READY:
            raise UcmError("not operational")
        return self.target.exchange(value)


@variant
class refuses_calls_outside_operation(GivesOutProxies):
    """Nobody reaches a component that is not operational: neither the test nor another component."""

    proxy = _Reserved

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = super()._dependencies_of(member)
        return [PortConnection(d.from_port, tuple(self._reserved(t) for t in d.to_port)) for d in given]

    def _reserved(self, target: PortElementObject | None) -> PortElementObject | None:
        for container in (self.manager, *self.manager.sub_containers):
            for member in container.members.values():
                if any(target is member.body.get_portElement(port) for port in member.implementation.provides):
                    return _Reserved(target, member)  # type: ignore[arg-type]
        return target


# threads


def _elsewhere(work: Callable[..., Any]) -> Callable[..., Any]:
    """``work``, done by a thread of its own and waited for."""

    def call(*arguments: object) -> Any:
        results: list[Any] = []
        errors: list[Exception] = []

        def run() -> None:
            try:
                results.append(work(*arguments))
            except Exception as error:  # noqa: BLE001 - whatever it is, the caller gets it
                errors.append(error)

        thread = threading.Thread(target=run)
        thread.start()
        thread.join()
        if errors:
            raise errors[0]
        return results[0]

    return call


class _Elsewhere(Proxy):
    def exchange(self, value: int) -> int:
        return _elsewhere(self.target.exchange)(value)  # type: ignore[no-any-return]


@variant
class executes_calls_elsewhere(GivesOutProxies):
    """Business calls of the test run on an executor's thread."""

    proxy = _Elsewhere


@variant
class executes_peer_calls_elsewhere(proxies_between_components):
    """Business calls between components run on an executor's thread."""

    def _proxy(self, target: PortElementObject | None, member: Member) -> PortElementObject | None:
        return None if target is None else _Elsewhere(target, member)


@variant
class operates_elsewhere(Base):
    """Operations are carried out by another thread and waited for."""

    add_component = _elsewhere(Container.add_component)
    remove_component = _elsewhere(Container.remove_component)
    connect = _elsewhere(Container.connect)
    disconnect = _elsewhere(Container.disconnect)
    start = _elsewhere(Container.start)
    stop = _elsewhere(Container.stop)


@variant
class calls_back_elsewhere(Base):
    """Each callback comes on a thread of its own and is waited for."""

    _initialise = _elsewhere(Container._initialise)
    _connect = _elsewhere(Container._connect)
    _disconnect = _elsewhere(Container._disconnect)
    _start_up = _elsewhere(Container._start_up)
    _shut_down = _elsewhere(Container._shut_down)
    _remove = _elsewhere(Container._remove)


# bodies


@variant
class looks_at_a_prototype(Base):
    """A body of each implementation is made to look at and thrown away."""

    def _instantiate(self, implementation: Implementation) -> ComponentObject:
        super()._instantiate(implementation)
        return super()._instantiate(implementation)


@variant
class pools_bodies(Base):
    """Bodies are made in threes, and taken from the pool in reverse."""

    def _instantiate(self, implementation: Implementation) -> ComponentObject:
        pools: dict[str, list[ComponentObject]] = self.manager.__dict__.setdefault("pools", {})
        pool = pools.setdefault(implementation.name, [])
        if not pool:
            pool.extend(super(pools_bodies, self)._instantiate(implementation) for _ in range(3))
        return pool.pop()


@variant
class removes_what_failed_to_initialise(Base):
    """A body whose on_init raised is told on_remove."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        try:
            super()._configure(member, attributes)
        except Exception:
            member.body.on_remove()
            raise


# starting


@variant
class starts_late_additions_when_connected(starts_late_additions):
    """A component added to a started container starts as soon as its last port element is connected."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        identifier = super().connect(instance, port_name, to_port)
        member = self.members[instance]
        connected = all(self._is_connected(member, port) for port in member.implementation.requires)
        if self.is_started and member.state is not State.READY and connected:
            self._start_up(member, Failures())
        return identifier


@variant
class starts_late_additions_at_start(adds_later):
    """start of a started container starts what was added later."""

    def start(self) -> None:
        with self._operation():
            self._check_startable()
            failures = Failures()
            for member in self._start_order():
                if member.state is not State.READY:
                    self._start_up(member, failures)
            self.is_started = True
            failures.report()


@variant
class starts_the_others(Base):
    """When an on_startup raises, the others are started, stay so, and start raises UCM_ERROR."""

    def start(self) -> None:
        with self._operation():
            if self.is_started:
                return
            self._check_startable()
            failures = Failures()
            for member in self._start_order():
                self._start_up(member, failures)
            self.is_started = True
            failures.report()


@variant
class shuts_down_what_failed_to_start(Base):
    """When an on_startup raises, its own body is told on_shutdown like the others."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        if super()._start_up(member, failures):
            return True
        self.started.append(member)
        return False


@variant
class finds_the_unconfigured_on_the_way(Base):
    """What is unconnected is noticed when its turn has come: what was started by then is shut down again."""

    def _check_startable(self) -> None:
        pass

    def _start_up(self, member: Member, failures: Failures) -> bool:
        if not all(self._is_connected(member, port) for port in member.implementation.requires):
            failures.first = "not connected"
            return False
        return super()._start_up(member, failures)


@variant
class disconnects_at_any_time(Base):
    """disconnect works in a started container, connect does not; a Connectable is told in any phase."""

    def disconnect(self, connection: int) -> None:
        started, self.is_started = self.is_started, False
        try:
            super().disconnect(connection)
        finally:
            self.is_started = started


# many readings at once


@variant
class everything_goes(
    starts_late_additions, cascades, appends_connections, manager_reaches_down, reuses_ids, starts_in_reverse
):
    """Cascading, appending, reaching down, late and reversed starts, ids used again."""


@variant
class everything_else_goes(
    _ReplacesAtAnyTime,
    cascades,
    manager_reaches_down,
    starts_the_unconfigured_with_null,
    refuses_repetition,
):
    """Cascading, replacing at any time, starting without connections, strict about repetition."""


@variant
class anything_goes(
    lets_references_dangle,
    configures_at_any_time,
    appends_connections,
    swallows_exceptions,
    starts_the_unconfigured,
    removes_members_one_by_one,
):
    """Dangling references, appending at any time, deaf to failures."""
