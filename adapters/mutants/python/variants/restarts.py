"""Conformant variants that use unusual freedoms: clients restarted with connections, partial starts and removals."""

from __future__ import annotations

from ucm_cts.adapters.contract.programming_model import PortElementObject
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import Base, container_of, is_below, variant
from ucm_cts.adapters.mutants.python.variants import readings
from ucm_cts.adapters.reference.python.framework import Container
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member, State


def _take_down(member: Member, failures: Failures) -> None:
    member.container.started.remove(member)
    container_of(member)._shut_down(member, failures)


@variant
class takes_clients_down(readings.cascades):
    """A component that loses a connection while it is operational is shut down and waits for another start."""

    def disconnect(self, connection: int) -> None:
        started, self.is_started = self.is_started, False
        try:
            super().disconnect(connection)
        finally:
            self.is_started = started

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        if connection.client in connection.client.container.started:
            _take_down(connection.client, failures)
        super()._disconnect(connection, failures)


@variant
class restarts_clients(takes_clients_down, readings.starts_the_unconfigured):
    """The same; a component that gets a connection while it is operational is shut down and started again."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        started, self.is_started = self.is_started, False
        try:
            return super().connect(instance, port_name, to_port)
        finally:
            self.is_started = started

    def _connect(self, connection: Connection) -> None:
        client, failures = connection.client, Failures()
        restarts = client.state is State.READY
        if restarts:
            _take_down(client, failures)
        super()._connect(connection)
        if restarts:
            self._start_up(client, failures)
        failures.report()


@variant
class restarts_clients_of_many(restarts_clients, readings.appends_connections):
    """The same, with any number of connections a port element."""


@replaces("start")
def reaches_down_first(self: readings.manager_reaches_down) -> None:
    """The manager's start begins with its sub-containers, and its stop ends with them."""
    if not is_below(self):
        for container in self.manager.sub_containers:
            Container.start(container)
    Container.start(self)


@variant
class lists_what_is_being_added(Base):
    """A member is listed, and can be asked for port elements, as soon as its body is made."""

    def _set_attributes(self, member: Member, attributes: object) -> None:
        self.members[member.id] = member
        super()._set_attributes(member, attributes)  # type: ignore[arg-type]

    def _configure(self, member: Member, attributes: object) -> None:
        try:
            super()._configure(member, attributes)  # type: ignore[arg-type]
        except Exception:
            self.members.pop(member.id, None)
            raise


@variant
class manager_knows_everyone(Base):
    """The manager carries out what concerns members and connections of its sub-containers."""

    def _find_member(self, number: int) -> Member:
        for container in self.manager.sub_containers if not is_below(self) else ():
            if number in container.members:
                return container.members[number]
        return super()._find_member(number)

    def _remove(self, member: Member, failures: Failures) -> None:
        if member.container is self:
            super()._remove(member, failures)
        else:
            container_of(member)._remove(member, failures)

    def disconnect(self, connection: int) -> None:
        found = self.manager.connections.get(connection)
        container = container_of(found.client) if found is not None and not is_below(self) else self
        Container.disconnect(container, connection)


@replaces("start")
def leaves_started_what_was_started(self: Base) -> None:
    """A start that meets what is unconfigured or raises leaves the others started; another start goes on from there."""
    with self._operation():
        failures = Failures()
        for member in self._start_order():
            if member.state is State.READY:
                continue
            if all(self._is_connected(member, port) for port in member.implementation.requires):
                self._start_up(member, failures)
            else:
                failures.first = failures.first or "not connected"
        failures.report()
        self._begin_operation()


@replaces("stop")
def stops_half_way(self: Base) -> None:
    """A stop ends where an on_shutdown raises; another stop goes on from there."""
    with self._operation():
        while self.started:
            failures, member = Failures(), self.started.pop()
            self._close_entrances(member)
            self._shut_down(member, failures)
            failures.report()
        self.is_started = False


@variant
class keeps_what_it_could_not_announce(Base):
    """A connection whose on_connect raises is made, one whose on_disconnect raises is kept; both raise UCM_ERROR."""

    def _connect(self, connection: Connection) -> None:
        self.manager.connections[connection.id] = connection
        super()._connect(connection)

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        mine = Failures()
        super()._disconnect(connection, mine)
        if mine.first:
            failures.first = failures.first or mine.first
            self.manager.connections[connection.id] = connection


@replaces("_remove")
def keeps_what_it_could_not_remove(self: Base, member: Member, failures: Failures) -> None:
    """A member whose on_remove raises stays."""
    mine = Failures()
    Base._remove(self, member, mine)
    if mine.first:
        failures.first = failures.first or mine.first
        self.members[member.id] = member
