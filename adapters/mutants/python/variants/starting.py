"""Conformant variants that start, hand over, thread and make bodies in their own way; and many readings at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.mutants.python.methods import alters, replaces
from ucm_cts.adapters.mutants.python.registry import Base, GivesOutProxies, Proxy, variant
from ucm_cts.adapters.mutants.python.variants import readings
from ucm_cts.adapters.reference.python.framework import Container
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member, State

# what on_startup gets


@replaces("_dependencies_of")
def one_entry_a_connection(self: readings.appends_connections, member: Member) -> list[pm.PortConnection]:
    """Two connections of a port element make two entries of the list, the later one first."""
    connections = reversed(self._connections_from(member))
    return self._with_services(member, [pm.PortConnection(c.port, (c.target,)) for c in connections])


@replaces("_dependencies_of")
def lists_unconnected_ports(self: readings.starts_the_unconfigured, member: Member) -> list[pm.PortConnection]:
    """Unconnected port elements have an entry without references; entries are in reverse order."""
    given = {d.from_port: d for d in readings.starts_the_unconfigured._dependencies_of(self, member)}
    required = [given.pop(port, pm.PortConnection(port, ())) for port in reversed(member.implementation.requires)]
    return [*required, *given.values()]


class _Entrance(pm.PortElementObject):
    """Closed until all members of a container have been started."""

    def __init__(self, target: pm.PortElementObject | None, container: Container) -> None:
        self.target, self.container = target, container

    def exchange(self, value: int) -> int:
        if self.target is None or not self.container.is_started:
            raise pm.UcmError("components may not be called yet")
        return self.target.exchange(value)


@variant
class refuses_calls_while_it_starts(Base):
    """A call of another component in on_startup is refused: ports open when all members have been started."""

    def _dependencies_of(self, member: Member) -> list[pm.PortConnection]:
        return [
            pm.PortConnection(d.from_port, tuple(_Entrance(target, self) for target in d.to_port))
            for d in super()._dependencies_of(member)
        ]


@variant
class proxies_between_components(Base):
    """Components are given proxies at start; what get_port_element and on_connect give is the body's own object."""

    def _dependencies_of(self, member: Member) -> list[pm.PortConnection]:
        given = super()._dependencies_of(member)
        return [pm.PortConnection(d.from_port, tuple(self._proxy(t, member) for t in d.to_port)) for d in given]

    def _proxy(self, target: pm.PortElementObject | None, member: Member) -> pm.PortElementObject | None:
        return None if target is None else Proxy(target, member)


@variant
class proxies_of_appended(proxies_between_components, readings.appends_connections):
    """The same, with any number of connections a port element."""


class _ReplacesAtAnyTime(readings.replaces_connections, readings.configures_at_any_time):
    def _connect(self, connection: Connection) -> None:
        for old in self._connections_from(connection.client):
            if old.port == connection.port:
                self._disconnect(old, Failures())
        readings.configures_at_any_time._connect(self, connection)


@variant
class proxies_of_replaced(proxies_between_components, _ReplacesAtAnyTime):
    """The same, with connections that replace each other at any time."""


class _Reserved(Proxy):
    def exchange(self, value: int) -> int:
        if self.member.state is not State.READY:
            raise pm.UcmError("not operational")
        return self.target.exchange(value)


@variant
class refuses_calls_outside_operation(GivesOutProxies):
    """A component that is not operational cannot be called, neither by the test nor by another component."""

    proxy = _Reserved

    def _dependencies_of(self, member: Member) -> list[pm.PortConnection]:
        given = super()._dependencies_of(member)
        return [pm.PortConnection(d.from_port, tuple(self._reserved(t) for t in d.to_port)) for d in given]

    def _reserved(self, target: pm.PortElementObject | None) -> pm.PortElementObject | None:
        for container in (self.manager, *self.manager.sub_containers):
            for member in container.members.values():
                if any(target is member.body.get_portElement(port) for port in member.implementation.provides):
                    return _Reserved(target, member)  # type: ignore[arg-type]
        return target


# threads


def _elsewhere(work: Callable[..., Any]) -> Callable[..., Any]:
    """``work``, done by a thread of its own and waited for."""

    def call(*arguments: object) -> Any:
        with ThreadPoolExecutor(1) as executor:
            return executor.submit(work, *arguments).result()

    return call


class _Elsewhere(Proxy):
    def exchange(self, value: int) -> int:
        return _elsewhere(self.target.exchange)(value)  # type: ignore[no-any-return]


@variant
class executes_calls_elsewhere(_Elsewhere):
    """Business calls of the test run on an executor's thread."""


@variant
class executes_peer_calls_elsewhere(proxies_between_components):
    """Business calls between components run on an executor's thread."""

    def _proxy(self, target: pm.PortElementObject | None, member: Member) -> pm.PortElementObject | None:
        return None if target is None else _Elsewhere(target, member)


def _all_elsewhere(name: str, lie: str, *methods: str) -> None:
    """Register the variant whose ``methods`` are carried out by threads of their own."""
    variant(type(name, (Base,), {"__doc__": lie} | {m: _elsewhere(getattr(Container, m)) for m in methods}))


_all_elsewhere(
    "operates_elsewhere",
    "Operations are carried out by another thread and waited for.",
    *("add_component", "remove_component", "connect", "disconnect", "start", "stop"),
)
_all_elsewhere(
    "calls_back_elsewhere",
    "Each callback comes on a thread of its own and is waited for.",
    *("_initialise", "_connect", "_disconnect", "_start_up", "_shut_down", "_remove"),
)


# bodies


@replaces("_instantiate")
def looks_at_a_prototype(self: Base, implementation: pm.Implementation) -> pm.ComponentObject:
    """Of each implementation one more body is made, looked at and dropped."""
    Base._instantiate(self, implementation)
    return Base._instantiate(self, implementation)


@variant
class pools_bodies(Base):
    """Bodies are made in threes, and taken from the pool in reverse."""

    def _instantiate(self, implementation: pm.Implementation) -> pm.ComponentObject:
        pools: dict[str, list[pm.ComponentObject]] = self.manager.__dict__.setdefault("pools", {})
        pool = pools.setdefault(implementation.name, [])
        if not pool:
            pool.extend(super(pools_bodies, self)._instantiate(implementation) for _ in range(3))
        return pool.pop()


@replaces("_configure")
def removes_what_failed_to_initialise(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """A body whose on_init raised gets on_remove."""
    try:
        Base._configure(self, member, attributes)
    except Exception:
        member.body.on_remove()
        raise


# starting


@alters("connect")
def starts_late_additions_when_connected(
    self: readings.starts_late_additions, identifier: int, instance: int, *_: object
) -> int:
    """A component added to a started container starts as soon as its last port element is connected."""
    member = self.members[instance]
    connected = all(self._is_connected(member, port) for port in member.implementation.requires)
    if self.is_started and member.state is not State.READY and connected:
        self._start_up(member, Failures())
    return identifier


@replaces("start")
def starts_late_additions_at_start(self: readings.adds_later) -> None:
    """start of a started container starts what was added later."""
    with self._operation():
        self._check_startable()
        failures = Failures()
        for member in self._start_order():
            if member.state is not State.READY:
                self._start_up(member, failures)
        self._begin_operation()
        failures.report()


@replaces("start")
def starts_the_others(self: Base) -> None:
    """After a failing on_startup the other members are started and stay so, and start raises UCM_ERROR."""
    with self._operation():
        if self.is_started:
            return
        self._check_startable()
        failures = Failures()
        for member in self._start_order():
            self._start_up(member, failures)
        self._begin_operation()
        failures.report()


@replaces("_start_up")
def shuts_down_what_failed_to_start(self: Base, member: Member, failures: Failures) -> bool:
    """A body whose on_startup raises gets on_shutdown like the others."""
    if Base._start_up(self, member, failures):
        return True
    self.started.append(member)
    return False


@variant
class finds_the_unconfigured_on_the_way(Base):
    """start finds an unconnected member when it reaches it, and shuts the started ones down again."""

    def _check_startable(self) -> None:
        pass

    def _start_up(self, member: Member, failures: Failures) -> bool:
        if not all(self._is_connected(member, port) for port in member.implementation.requires):
            failures.first = "not connected"
            return False
        return super()._start_up(member, failures)


@replaces("disconnect")
def disconnects_at_any_time(self: Base, connection: int) -> None:
    """disconnect works in a started container, connect does not; on_disconnect comes in every phase."""
    started, self.is_started = self.is_started, False
    try:
        Base.disconnect(self, connection)
    finally:
        self.is_started = started


# many readings at once


@variant
class everything_goes(
    readings.starts_late_additions,
    readings.cascades,
    readings.appends_connections,
    readings.manager_reaches_down,
    readings.reuses_ids,
    readings.starts_in_reverse,
):
    """Cascading, appending, reaching down, late and reversed starts, ids used again."""


@variant
class everything_else_goes(
    _ReplacesAtAnyTime,
    readings.cascades,
    readings.manager_reaches_down,
    readings.starts_the_unconfigured_with_null,
    readings.refuses_repetition,
):
    """Cascading, replacing at any time, starting without connections, strict about repetition."""


@variant
class anything_goes(
    readings.lets_references_dangle,
    readings.configures_at_any_time,
    readings.appends_connections,
    readings.swallows_exceptions,
    readings.starts_the_unconfigured,
    readings.removes_members_one_by_one,
):
    """Dangling references, appending at any time, exceptions ignored."""
