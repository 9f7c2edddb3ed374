"""A small UCM framework: containers of components with the life cycle of clause 11.2 and the API of 12.10.

It knows nothing of the test suite but the interfaces of clause 11 that bodies implement. Where the specification leaves
a choice it takes the strictest one: it refuses what it does not support, and a refused operation changes nothing.

Operations that change something are carried out one after the other, on any thread, and are refused if a callback of a
body calls them; ``get_port_element`` and ``get_components`` may be called at any time.
"""

from __future__ import annotations

import itertools
import threading
from collections.abc import Mapping, Sequence

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract.data_types import Interface
from ucm_cts.adapters.reference.python.connectors import AnyLink, Link
from ucm_cts.adapters.reference.python.container_services import Record
from ucm_cts.adapters.reference.python.extensions import UsesExtensions
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member, State
from ucm_cts.adapters.reference.python.object_timers import SchedulesTimers


class Container(SchedulesTimers, UsesExtensions):
    """Members with a common life cycle (11.2.2.1)."""

    manager: ContainerManager

    def __init__(self, manager: ContainerManager | None) -> None:
        self.manager = manager or self  # type: ignore[assignment]  # the manager is its own
        self.members: dict[int, Member] = {}
        self.started: list[Member] = []
        self.is_started = False
        self.is_removed = False

    # the Container API of 12.10

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        with self._operation():
            self._check_configuring()
            found = self._find_implementation(implementation, attributes)
            member = Member(self._new_id(), found, self._instantiate(found), self)
            failures = Failures()
            failures.attempt(self._configure, member, attributes)
            failures.report()
            self.members[member.id] = member
            return member.id

    def remove_component(self, comp_instance: int) -> None:
        with self._operation():
            member = self._find_member(comp_instance)
            self._check_removable(member)
            failures = Failures()
            for connection in self._connections_from(member):
                self._disconnect(connection, failures)
            self._remove(member, failures)
            failures.report()

    def get_port_element(self, comp_instance: int, port_name: str) -> pm.PortElementObject:
        self._check_alive()
        member = self._find_member(comp_instance)
        if port_name not in member.implementation.provides:
            raise pm.NotFound(f"no provided port element {port_name!r}")
        element = self._reference_to(member, port_name)
        if element is None:
            raise pm.NotFound(f"the body gives no port element {port_name!r}")
        return element

    def connect(self, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
        with self._operation():
            member = self._find_member(instance)
            if port_name not in member.implementation.requires:
                raise pm.BadParameter(f"no required port element {port_name!r}")
            if to_port is None:
                raise pm.BadParameter("the reference to connect is null")
            self._check_configuring()
            if self._is_connected(member, port_name):
                raise pm.UcmError(f"{port_name!r} is connected already")
            self._check_compatible(member, port_name, to_port)
            return self._connect_to(member, port_name, to_port)

    def disconnect(self, connection: int) -> None:
        with self._operation():
            found = self.manager.connections.get(connection)
            if found is None or found.client.container is not self:
                raise pm.NotFound(f"no connection {connection}")
            self._check_configuring()
            self._undo(found)

    def start(self) -> None:
        with self._operation():
            if self.is_started:
                return
            self._check_startable()
            failures = Failures()
            for member in self._start_order():
                if not self._start_up(member, failures):
                    self._shut_down_started(failures)
                    failures.report()
            self._begin_operation()

    def stop(self) -> None:
        with self._operation():
            failures = Failures()
            self._shut_down_started(failures)
            failures.report()

    def get_components(self) -> list[int]:
        self._check_alive()
        return list(self.members)

    # one concern each, for variants to override

    def _find_implementation(self, name: str, attributes: Mapping[str, str]) -> pm.Implementation:
        implementation = self.manager.implementations.get(name)
        if implementation is None:
            raise pm.UcmError(f"no implementation {name!r}")
        unknown = set(attributes).difference(implementation.attributes)
        if unknown:
            raise pm.UcmError(f"{name!r} has no attribute {min(unknown)!r}")
        self._check_policies(implementation)
        return implementation

    def _check_compatible(self, member: Member, port: str, target: pm.PortElementObject) -> None:
        """Both ends of a connection have the same interface (11.2.3)."""
        provided = self._interfaces_of(target)
        if provided and member.implementation.interfaces.get(port) not in provided:
            raise pm.BadParameter(f"the reference has another interface than {port!r}")

    def _interfaces_of(self, target: pm.PortElementObject) -> list[Interface | None]:
        """The interface of a provided port element, None for the usual one; nothing for an unknown reference."""
        return [
            member.implementation.interfaces.get(port)
            for container in (self.manager, *self.manager.sub_containers)
            for member in container.members.values()
            for port in member.implementation.provides
            if self._reference_to(member, port) is target
        ]

    def _check_startable(self) -> None:
        """A container starts only if all its members are configured, so that it never starts a part of them."""
        for member in self.members.values():
            for port in member.implementation.requires:
                if not self._is_connected(member, port):
                    raise pm.UcmError(f"{port!r} of component {member.id} is not connected")

    def _check_removable(self, member: Member) -> None:
        if member.state is State.READY:
            raise pm.UcmError(f"component {member.id} is ready; stop its container first")
        if any(connection.client is not member for connection in self._connections_to(member)):
            raise pm.UcmError(f"another component is connected to component {member.id}")

    def _instantiate(self, implementation: pm.Implementation) -> pm.ComponentObject:
        try:
            return implementation.create()
        except Exception as error:
            raise pm.UcmError(f"{implementation.name!r} cannot be instantiated: {error}") from error

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        self._set_attributes(member, attributes)
        if isinstance(member.body, pm.FragmentObject):
            member.body.set_container_interface(self)
        self._check_body(member)
        self._initialise(member)

    def _set_attributes(self, member: Member, attributes: Mapping[str, str]) -> None:
        for name, value in {**member.implementation.defaults, **attributes}.items():
            member.body.set_attribute(name, value)

    def _initialise(self, member: Member) -> None:
        member.body.on_init()

    def _start_order(self) -> Sequence[Member]:
        return list(self.members.values())

    def _start_up(self, member: Member, failures: Failures) -> bool:
        if not failures.attempt(member.body.on_startup, self._dependencies_of(member)):
            return False
        member.state = State.READY
        self.started.append(member)
        return True

    def _dependencies_of(self, member: Member) -> list[pm.PortConnection]:
        connections = self._connections_from(member)
        return self._with_services(member, [pm.PortConnection(c.port, (c.target,)) for c in connections])

    def _begin_operation(self) -> None:
        """All members have been started."""
        self.is_started = True
        for member in self.started:
            self._open_entrances(member)
        for member in self.started:  # they may call and push at once
            self._begin_execution(member)

    def _shut_down_started(self, failures: Failures) -> None:
        """Shut down, last started first, what has been started."""
        for member in self.started:
            self._close_entrances(member)
            self._end_execution(member)
        while self.started:
            self._shut_down(self.started.pop(), failures)
        self.is_started = False

    def _shut_down(self, member: Member, failures: Failures) -> None:
        self._end_execution(member)
        member.state = State.CONFIGURING
        failures.attempt(member.body.on_shutdown)

    def _remove(self, member: Member, failures: Failures) -> None:
        self._leave_links(member)
        failures.attempt(member.body.on_remove)
        member.execution.executor.close()
        del self.members[member.id]

    def _take_down(self, containers: Sequence[Container], failures: Failures) -> None:
        """Shut down, disconnect and remove all members, each step for all before the next (11.2.3)."""
        for container in containers:
            container._shut_down_started(failures)
        for container in containers:
            container._disconnect_members(failures)
        for container in containers:
            container._remove_members(failures)
            container.is_removed = True

    def _disconnect_members(self, failures: Failures) -> None:
        for connection in reversed(self._connections_of_members()):
            self._disconnect(connection, failures)

    def _remove_members(self, failures: Failures) -> None:
        for member in reversed(list(self.members.values())):
            self._remove(member, failures)

    # looking up connections

    def _connections_to(self, member: Member) -> list[Connection]:
        elements = [self._reference_to(member, port) for port in member.implementation.provides]
        return [c for c in self.manager.connections.values() if any(c.target is element for element in elements)]

    def _connections_of_members(self) -> list[Connection]:
        touched = {c.id for m in self.members.values() for c in self._connections_from(m) + self._connections_to(m)}
        return [c for c in self.manager.connections.values() if c.id in touched]


class ContainerManager(Container):
    """The root container, which is the runtime (11.2.2.2)."""

    container_class: type[Container] = Container

    def __init__(self, implementations: Sequence[pm.Implementation]) -> None:
        super().__init__(None)
        self.implementations = {implementation.name: implementation for implementation in implementations}
        self.sub_containers: list[Container] = []
        self.connections: dict[int, Connection] = {}
        self.links: list[Link] = []
        self.extended_links: list[AnyLink] = []
        self.log: list[Record] = []
        self.numbers = itertools.count(1)
        self.lock = threading.Lock()
        self.busy_thread: int | None = None

    def create_container(self) -> Container:
        with self._operation():
            container = self.container_class(self)
            self.sub_containers.append(container)
            return container

    def remove_container(self, sub_container: Container | None) -> None:
        with self._operation():
            if sub_container is None or sub_container not in self.sub_containers:
                raise pm.NotFound("no such container")
            failures = Failures()
            self._remove_container(sub_container, failures)
            failures.report()

    def read_log(self) -> list[Record]:
        """All records of the trace, oldest first (10.1.4.2)."""
        return list(self.log)

    def destroy(self) -> None:
        with self._operation():
            failures = Failures()
            self._take_down([*self.sub_containers, self], failures)
            failures.report()

    def _remove_container(self, container: Container, failures: Failures) -> None:
        self._take_down([container], failures)
        self.sub_containers.remove(container)
