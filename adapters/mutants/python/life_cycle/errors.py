"""Wrong frameworks, clause 12.10: errors and ranges."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.mutants.python.methods import alters, does_only_if, refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import Base, breaks
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager
from ucm_cts.adapters.reference.python.members import Connection, Member


@alters("add_component", "R-12.10-02")
def wide_component_ids(self: Base, identifier: int, _implementation: str, _attributes: Mapping[str, str]) -> int:
    """Component ids exceed 32 bits."""
    self.members[identifier + 2**40] = self.members.pop(identifier)
    self.members[identifier + 2**40].id = identifier + 2**40
    return identifier + 2**40


@alters("connect", "R-12.10-03")
def wide_connection_ids(
    self: Base, identifier: int, _instance: int, _port_name: str, _to_port: pm.PortElementObject | None
) -> int:
    """Connection ids exceed 32 bits."""
    connection = self.manager.connections.pop(identifier)
    wide = Connection(identifier + 2**40, connection.client, connection.port, connection.target)
    self.manager.connections[wide.id] = wide
    return wide.id


def _undeclared(operation: str) -> type:
    """A mixin whose ``operation`` turns UCM_ERROR, NOT_FOUND and BAD_PARAMETER into something undeclared."""

    def call(self: Any, *arguments: Any) -> Any:
        try:
            return getattr(super(mixin, self), operation)(*arguments)
        except (pm.UcmError, pm.NotFound, pm.BadParameter) as error:
            raise RuntimeError("internal error") from error

    mixin = type(f"undeclared_in_{operation}", (), {operation: call, "__doc__": f"{operation} raises RuntimeError."})
    return mixin


for _operation, _requirement in {
    "add_component": "R-12.10-04",
    "remove_component": "R-12.10-05",
    "get_port_element": "R-12.10-06",
    "connect": "R-12.10-07",
    "disconnect": "R-12.10-08",
    "start": "R-12.10-09",
    "stop": "R-12.10-10",
    "remove_container": "R-12.10-13",
}.items():
    breaks(_requirement)(_undeclared(_operation))


def _always_undeclared(operation: str) -> type:
    def call(self: Any, *arguments: Any) -> Any:
        raise RuntimeError("not implemented")

    return type(f"lacks_{operation}", (), {operation: call, "__doc__": f"{operation} always raises RuntimeError."})


breaks("R-12.10-11", also=("R-11.2.1.4-03",))(_always_undeclared("get_components"))
breaks("R-12.10-12")(_always_undeclared("create_container"))
breaks("R-12.10-14")(_always_undeclared("destroy"))


@refuses_if("_find_member", "R-12.10-15")
def unknown_components_are_errors(self: Base, number: int) -> bool:
    """Unknown component ids are answered with UCM_ERROR."""
    return number not in self.members


@does_only_if("disconnect", "R-12.10-16")
def unknown_connections_are_ignored(self: Base, connection: int) -> bool:
    """disconnect of an unknown connection returns."""
    return connection in self.manager.connections


@replaces("remove_container", "R-12.10-17")
def unknown_containers_are_ignored(self: Base, sub_container: Container | None) -> None:
    """remove_container of a removed container returns."""
    if sub_container in self.manager.sub_containers:
        ContainerManager.remove_container(self.manager, sub_container)


@replaces("connect", "R-12.10-18")
def connects_any_name(self: Base, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
    """connect to a port element that does not exist returns an id."""
    known = instance in self.members and not self.is_started
    if known and to_port is not None and port_name not in self.members[instance].implementation.requires:
        return self._new_id()
    return Base.connect(self, instance, port_name, to_port)


@replaces("connect", "R-12.10-19")
def connects_to_nothing(self: Base, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
    """connect to a null reference returns an id."""
    known = instance in self.members and port_name in self.members[instance].implementation.requires
    if to_port is None and known and not self.is_started:
        return self._new_id()
    return Base.connect(self, instance, port_name, to_port)


@replaces("get_port_element", "R-12.10-20")
def any_name_gives_nothing(self: Base, comp_instance: int, port_name: str) -> pm.PortElementObject:
    """get_port_element of an unknown name returns a null reference."""
    if comp_instance in self.members and port_name not in self.members[comp_instance].implementation.provides:
        return None  # type: ignore[return-value]
    return Base.get_port_element(self, comp_instance, port_name)


@replaces("add_component", "R-12.10-21")
def adds_nothing(self: Base, implementation: str, attributes: Mapping[str, str]) -> int:
    """add_component of an unknown implementation returns an id."""
    if implementation not in self.manager.implementations and not self.is_started:
        return self._new_id()
    return Base.add_component(self, implementation, attributes)


@replaces("_configure", "R-12.10-22", also=("R-11.2.3-06",))
def keeps_failed_components(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """A component whose on_init raised is listed although add_component was refused."""
    self.members[member.id] = member
    Base._configure(self, member, attributes)


@replaces("remove_component", "R-12.10-23")
def failing_removal_is_not_found(self: Base, comp_instance: int) -> None:
    """remove_component raises NOT_FOUND when on_remove raised."""
    known = comp_instance in self.members
    try:
        Base.remove_component(self, comp_instance)
    except pm.UcmError as error:
        if known and comp_instance not in self.members:
            raise pm.NotFound("gone") from error
        raise


@breaks("R-12.10-24")
class second_connection_is_not_found(Base):
    """A second connection of a port element is answered with NOT_FOUND."""

    def connect(self, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
        member = self.members.get(instance)
        if member is not None and not self.is_started and to_port is not None and self._is_connected(member, port_name):
            raise pm.NotFound("taken")
        return super().connect(instance, port_name, to_port)


@alters("_dependencies_of", "R-12.10-25", also=("R-11.2.3-10",))
def hands_references_over_twice(
    _self: Base, given: list[pm.PortConnection], _member: Member
) -> list[pm.PortConnection]:
    """on_startup gets each reference twice."""
    return [pm.PortConnection(d.from_port, (*d.to_port, *d.to_port)) for d in given]


@refuses_if("get_components", "R-12.10-26", also=("R-11.2.1.4-03",))
def no_list_while_ready(self: Base) -> bool:
    """get_components is refused while the container is started."""
    return self.is_started


# names that mean nothing


@replaces("connect", "R-12.10-18")
def unknown_required_names_are_errors(
    self: Base, instance: int, port_name: str, to_port: pm.PortElementObject | None
) -> int:
    """connect raises UCM_ERROR for an unknown name, which its vendor does not declare."""
    if port_name not in self._find_member(instance).implementation.requires:
        raise pm.UcmError(f"no required port element {port_name!r}")
    return Base.connect(self, instance, port_name, to_port)


@replaces("get_port_element", "R-12.10-20")
def unknown_provided_names_are_errors(self: Base, comp_instance: int, port_name: str) -> pm.PortElementObject:
    """get_port_element raises UCM_ERROR for an unknown name, which its vendor does not declare."""
    if port_name not in self._find_member(comp_instance).implementation.provides:
        raise pm.UcmError(f"no provided port element {port_name!r}")
    return Base.get_port_element(self, comp_instance, port_name)


@breaks("R-12.10-18", "R-12.10-20", readings={"unknown-names": "ucm-error"})
class unknown_names_are_not_found(Base):
    """The vendor declares UCM_ERROR for names that mean nothing; the framework raises other exceptions."""
