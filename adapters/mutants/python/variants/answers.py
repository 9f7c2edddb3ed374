"""Conformant variants with answers, identifiers and orders of their own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ucm_cts.adapters.contract.programming_model import BadParameter, FragmentObject, NotFound, PortElementObject
from ucm_cts.adapters.mutants.python.methods import alters, replaces
from ucm_cts.adapters.mutants.python.registry import Base, variant
from ucm_cts.adapters.mutants.python.variants import readings
from ucm_cts.adapters.reference.python.framework import Container
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member

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
class knows_stale_references_at_any_time(knows_stale_references, readings.cascades, readings.configures_at_any_time):
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
class numbers_slots(readings.replaces_connections):
    """A connection's id is that of its client's port element: what replaces another connection takes over its id."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        made = self.manager.connections.pop(super().connect(instance, port_name, to_port))
        slots: dict[tuple[int, str], int] = self.manager.__dict__.setdefault("slots", {})
        slot = slots.setdefault((made.client.id, port_name), len(slots) + 1)
        self.manager.connections[slot] = Connection(slot, made.client, made.port, made.target)
        return slot


@alters("_new_id")
def odd_ids(_self: Base, number: int) -> int:
    """Ids are at both ends of the 32 bits, negative, or zero."""
    return (2**31 - number, -(2**31) + number - 1, 0 if number == 3 else -number)[number % 3]


@alters("get_components")
def sorts_its_list(_self: Base, given: list[int]) -> list[int]:
    """get_components lists the highest id first."""
    return sorted(given, reverse=True)


# orders


@replaces("_connect")
def announces_before_replacing(self: readings.appends_connections, connection: Connection) -> None:
    """Where a connection is replaced, on_connect of the new one comes before on_disconnect of the old one."""
    old = [c for c in self._connections_from(connection.client) if c.port == connection.port]
    readings.appends_connections._connect(self, connection)
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


@replaces("_start_order")
def alternates(self: Base) -> Sequence[Member]:
    """Every second start goes the other way round."""
    self.__dict__["backwards"] = not self.__dict__.get("backwards", True)
    return list(Base._start_order(self))[:: -1 if self.__dict__["backwards"] else 1]


@replaces("_take_down")
def takes_down_in_startup_order(self: Base, containers: Sequence[Container], failures: Failures) -> None:
    """remove_container and destroy shut members down in the order of their start; only stop must reverse it."""
    for container in containers:
        container.started.reverse()
    Base._take_down(self, containers, failures)


@replaces("_configure")
def shows_the_container_after_init(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """set_container_interface comes after on_init."""
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
