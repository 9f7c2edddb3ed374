"""Wrong frameworks, clause 11.2.1: component interfaces."""

from __future__ import annotations

from collections.abc import Mapping

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.mutants.python.methods import alters, does_only_if, refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import Base, Proxy, breaks
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member


@breaks("R-11.2.1.1-01")
class fragments_cannot_be_connected(Base):
    """connect does not take the port element of a fragment."""

    def connect(self, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
        everywhere = [self.manager, *self.manager.sub_containers]
        fragments = [m for c in everywhere for m in c.members.values() if isinstance(m.body, pm.FragmentObject)]
        if any(m.body.get_portElement(p) is to_port for m in fragments for p in m.implementation.provides):
            raise pm.BadParameter("not a component's")
        return super().connect(instance, port_name, to_port)


@replaces("exchange", "R-11.2.1.1-02")
def changes_what_is_sent(self: Proxy, value: int) -> int:
    """References hand the body another value than the one sent."""
    return self.target.exchange(value ^ 1)


@breaks("R-11.2.1.2-01")
class starts_what_was_removed(Base):
    """start starts components that have been removed."""

    def _remove(self, member: Member, failures: Failures) -> None:
        super()._remove(member, failures)
        self.__dict__.setdefault("removed", []).append(member)

    def start(self) -> None:
        super().start()
        for member in self.__dict__.get("removed", []):
            Failures().attempt(member.body.on_startup, [])


@alters("_dependencies_of", "R-11.2.1.2-03", also=("R-11.1.3-01", "R-11.1.2-02", "R-11.2.3-10"))
def mixes_references_up(_self: Base, given: list[pm.PortConnection], _member: Member) -> list[pm.PortConnection]:
    """on_startup hands the references of port elements over in reverse order."""
    targets = [d.to_port for d in reversed(given)]
    return [pm.PortConnection(d.from_port, t) for d, t in zip(given, targets, strict=True)]


@replaces("_shut_down", "R-11.2.1.2-04")
def initialises_at_stop(self: Base, member: Member, failures: Failures) -> None:
    """on_init comes again when a component is shut down."""
    Base._shut_down(self, member, failures)
    failures.attempt(member.body.on_init)


@replaces("_configure", "R-11.2.1.2-05")
def attributes_after_init(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """Sets attributes when on_init has run."""
    Base._configure(self, member, {})
    self._set_attributes(member, attributes)


@breaks("R-11.2.1.2-06")
class removes_silently(Base):
    """remove_component does not call on_remove."""

    def remove_component(self, comp_instance: int) -> None:
        self.__dict__["silent"] = True
        try:
            super().remove_component(comp_instance)
        finally:
            self.__dict__["silent"] = False

    def _remove(self, member: Member, failures: Failures) -> None:
        if self.__dict__.get("silent"):
            del self.members[member.id]
        else:
            super()._remove(member, failures)


@replaces("exchange", "R-11.2.1.2-07")
def never_serves(_self: Proxy, *_: object) -> int:
    """References refuse every call, even while the component is operational."""
    raise pm.UcmError("not operational")


@replaces("_start_up", "R-11.2.1.2-08")
def connects_while_starting(self: Base, member: Member, failures: Failures) -> bool:
    """Repeats on_connect during start, when other members are started already."""
    for connection in self._connections_from(member):
        if isinstance(member.body, pm.Connectable):
            member.body.on_connect(connection.port, connection.target)
    return Base._start_up(self, member, failures)


@alters("_dependencies_of", "R-11.2.1.2-09", also=("R-11.2.3-10",))
def names_dependencies_differently(
    _self: Base, given: list[pm.PortConnection], _member: Member
) -> list[pm.PortConnection]:
    """on_startup spells the names of port elements in capitals."""
    return [pm.PortConnection(d.from_port.upper(), d.to_port) for d in given]


@replaces("stop", "R-11.2.1.2-10")
def shuts_down_at_every_stop(self: Base) -> None:
    """stop calls on_shutdown on members that were never started."""
    idle = [] if self.is_started else list(self.members.values())
    Base.stop(self)
    for member in idle:
        Failures().attempt(member.body.on_shutdown)


@refuses_if("_connect", "R-11.2.1.3-01", also=("R-11.2.2.1-08",))
def demands_connectable(_self: Base, connection: Connection) -> bool:
    """connect refuses bodies that are not Connectable."""
    return not isinstance(connection.client.body, pm.Connectable)


@replaces("_connect", "R-11.2.1.3-02")
def connects_silently(self: Base, connection: Connection) -> None:
    """connect does not call on_connect."""
    self.manager.connections[connection.id] = connection


@breaks("R-11.2.1.3-03")
class announces_refused_connections(Base):
    """A connect that is refused because the container is started still calls on_connect."""

    def connect(self, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
        member = self.members.get(instance)
        known = member is not None and port_name in member.implementation.requires and to_port is not None
        if known and member is not None and self.is_started and isinstance(member.body, pm.Connectable):
            member.body.on_connect(port_name, to_port)
        return super().connect(instance, port_name, to_port)


@replaces("_connect", "R-11.2.1.3-04")
def on_connect_without_reference(self: Base, connection: Connection) -> None:
    """on_connect gets a null reference."""
    if isinstance(connection.client.body, pm.Connectable):
        failures = Failures()
        failures.attempt(connection.client.body.on_connect, connection.port, None)
        failures.report()
    self.manager.connections[connection.id] = connection


@replaces("_disconnect", "R-11.2.1.3-05")
def disconnects_silently(self: Base, connection: Connection, *_: object) -> None:
    """on_disconnect is never called."""
    del self.manager.connections[connection.id]


@replaces("_disconnect", "R-11.2.1.3-06")
def misnames_disconnected_ports(self: Base, connection: Connection, failures: Failures) -> None:
    """on_disconnect is given the connection's number instead of the port element's name."""
    del self.manager.connections[connection.id]
    if isinstance(connection.client.body, pm.Connectable):
        failures.attempt(connection.client.body.on_disconnect, str(connection.id))


@does_only_if("_initialise", "R-11.2.1.4-01", also=("R-11.2.1.2-01",))
def leaves_fragments_uninitialised(_self: Base, member: Member) -> bool:
    """Fragments do not get on_init."""
    return not isinstance(member.body, pm.FragmentObject)


@replaces("_configure", "R-11.2.1.4-02", also=("R-11.2.1.4-03",))
def hides_the_container(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """Fragments do not get set_container_interface."""
    self._set_attributes(member, attributes)
    self._initialise(member)


@replaces("_configure", "R-11.2.1.4-03")
def shows_fragments_nothing(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """The container interface that fragments get lists no members."""
    self._set_attributes(member, attributes)
    if isinstance(member.body, pm.FragmentObject):
        member.body.set_container_interface(_Blind())
    self._initialise(member)


class _Blind:
    def get_components(self) -> list[int]:
        return []
