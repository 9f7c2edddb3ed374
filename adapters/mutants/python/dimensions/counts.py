"""Frameworks that can count to some number only: components, connections, containers, restarts, look-ups, calls."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ucm_cts.adapters.contract.programming_model import (
    Implementation,
    NotFound,
    PortConnection,
    PortElementObject,
    UcmError,
)
from ucm_cts.adapters.mutants.python.methods import alters, does_only_if, replaces
from ucm_cts.adapters.mutants.python.registry import (
    CONTAINER,
    Base,
    PeerProxy,
    Row,
    breaks,
    family,
    is_below,
)
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member

# a limit for everything


class _AddsUpTo(Base):
    limit = 0

    def _instantiate(self, implementation: Implementation) -> object:  # type: ignore[override]
        if len(self.members) >= self.limit:
            raise UcmError("the container is full")
        return super()._instantiate(implementation)


class _ConnectsUpTo(Base):
    limit = 0

    def _connect_to(self, member: Member, port: str, target: PortElementObject) -> int:
        if len(self.manager.connections) >= self.limit:
            raise UcmError("no more connections")
        return super()._connect_to(member, port, target)


class _ContainsUpTo(Base):
    limit = 0

    def create_container(self) -> Container:
        if len(self.manager.sub_containers) >= self.limit:
            raise UcmError("no more containers")
        return ContainerManager.create_container(self.manager)


class _LooksUpTo(Base):
    limit = 0

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(comp_instance, port_name)
        self.__dict__["looked"] = self.__dict__.get("looked", 0) + 1
        if self.__dict__["looked"] > self.limit:
            raise NotFound("no more references")
        return element


class _StartsUpTo(Base):
    limit = 0

    def _check_startable(self) -> None:
        super()._check_startable()
        self.__dict__["starts"] = self.__dict__.get("starts", 0) + 1
        if self.__dict__["starts"] > self.limit:
            raise UcmError("worn out")


class _AddsInAllUpTo(Base):
    limit = 0

    def _instantiate(self, implementation: Implementation) -> object:  # type: ignore[override]
        self.manager.__dict__["added"] = self.manager.__dict__.get("added", 0) + 1
        if self.manager.__dict__["added"] > self.limit:
            raise UcmError("no more numbers")
        return super()._instantiate(implementation)


class _ConnectsInAllUpTo(Base):
    limit = 0

    def _connect_to(self, member: Member, port: str, target: PortElementObject) -> int:
        self.manager.__dict__["connected"] = self.manager.__dict__.get("connected", 0) + 1
        if self.manager.__dict__["connected"] > self.limit:
            raise UcmError("no more numbers")
        return super()._connect_to(member, port, target)


class _ListsUpTo(Base):
    limit = 0

    def get_components(self) -> list[int]:
        return super().get_components()[: self.limit]


_ADD, _CONNECT = ("R-11.1.3-02",), ("R-11.2.3-08", "R-11.2.1.3-01", "R-11.2.1.1-01")
for _base, _rows in {
    _AddsUpTo: {
        "holds_255_components": Row("R-11.2.2.1-01", "The 256th component of a container is refused.", 255, _ADD),
        "holds_seven_components": Row("R-11.2.2.1-01", "The eighth component of a container is refused.", 7, _ADD),
    },
    _AddsInAllUpTo: {
        "adds_256_components_in_all": Row(
            "R-11.2.2.1-01", "A runtime adds 256 components, however many have been removed.", 256, _ADD
        ),
    },
    _ConnectsUpTo: {
        "holds_255_connections": Row("R-11.2.2.1-08", "The 256th connection of a runtime is refused.", 255, _CONNECT),
        "holds_seven_connections": Row("R-11.2.2.1-08", "The eighth connection of a runtime is refused.", 7, _CONNECT),
    },
    _ConnectsInAllUpTo: {
        "connects_256_times_in_all": Row(
            "R-11.2.3-08", "A runtime connects 256 times, however often was disconnected.", 256, ("R-11.2.2.1-08",)
        ),
    },
    _ContainsUpTo: {
        "holds_seven_containers": Row("R-11.1.3-03", "The eighth sub-container is refused.", 7),
        "holds_255_containers": Row("R-11.1.3-03", "The 256th sub-container is refused.", 255),
    },
    _LooksUpTo: {
        "looks_up_256_elements": Row("R-11.2.2.1-07", "A container gives 256 references and no more.", 256),
    },
    _StartsUpTo: {
        "starts_seven_times": Row("R-11.2.3-10", "The eighth start of a container is refused.", 7, ("R-11.2.3-06",)),
        "starts_255_times": Row("R-11.2.3-10", "The 256th start of a container is refused.", 255, ("R-11.2.3-06",)),
    },
    _ListsUpTo: {
        "lists_255_components": Row("R-11.2.2.1-14", "get_components lists 255 components at most.", 255),
        "lists_seven_components": Row("R-11.2.2.1-14", "get_components lists seven components at most.", 7),
    },
}.items():
    family(_base, "limit", _rows, clauses=CONTAINER)

# numbers that come round


@breaks("R-11.2.2.1-03", also=("R-11.2.2.1-06", "R-11.2.2.1-14", "R-12.10-15", "R-11.2.1.2-06", "R-11.2.1.1-02"))
class component_ids_have_eight_bits(Base):
    """The ids of the first and the 257th component are equal."""

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        identifier = super().add_component(implementation, attributes)
        given: list[int] = self.__dict__.setdefault("given", [])
        given.append(identifier if len(given) < 256 else given[len(given) - 256])
        return given[-1]


@breaks("R-11.2.2.1-09", also=("R-11.2.2.1-10", "R-12.10-16", "R-11.2.1.3-06", "R-11.2.3-08"))
class connection_ids_have_eight_bits(Base):
    """The ids of the first and the 257th connection of a container are equal."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        identifier = super().connect(instance, port_name, to_port)
        made: list[int] = self.__dict__.setdefault("made", [])
        made.append(identifier if len(made) < 256 else made[len(made) - 256])
        return made[-1]


# the third, the eighth, the 256th


@alters("_start_order", "R-11.2.2.1-11", also=("R-11.2.1.4-01",))
def starts_the_256th_never(_self: Base, order: Sequence[Member]) -> Sequence[Member]:
    """start leaves out the 256th member."""
    return [*order[:255], *order[256:]]


@replaces("stop", "R-11.2.2.1-13")
def stops_many_in_order(self: Base) -> None:
    """stop goes in the order of start if there are more than 16 members."""
    if len(self.started) > 16:
        self.started.reverse()
    Base.stop(self)


@alters("_dependencies_of", "R-11.2.1.2-09", also=("R-11.2.3-10",))
def hands_over_two_ports(_self: Base, given: list[PortConnection], _member: Member) -> list[PortConnection]:
    """on_startup names two required port elements at most."""
    return given[:2]


@alters("_dependencies_of", "R-11.2.1.2-09", also=("R-11.2.3-10",))
def hands_over_seven_ports(_self: Base, given: list[PortConnection], _member: Member) -> list[PortConnection]:
    """on_startup names seven required port elements at most."""
    return given[:7]


@alters("get_port_element", "R-11.2.2.1-07")
def finds_two_elements_of_a_component(
    self: Base, element: PortElementObject, comp_instance: int, port_name: str
) -> PortElementObject:
    """get_port_element finds the first two provided port elements of a component."""
    if port_name in list(self.members[comp_instance].implementation.provides)[2:]:
        raise NotFound("no such port element")
    return element


@replaces("_set_attributes", "R-11.2.1.2-05")
def sets_two_attributes(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """Of more than two attributes the third is not set."""
    Base._set_attributes(self, member, dict(list(attributes.items())[:2] + list(attributes.items())[3:]))


@replaces("_set_attributes", "R-11.2.1.2-05")
def sets_seven_attributes(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """The eighth attribute of a component is not set."""
    Base._set_attributes(self, member, dict(list(attributes.items())[:7]))


@does_only_if("_connect", "R-11.2.1.3-02", also=("R-11.2.3-06",))
def connects_silently_from_the_eighth(self: Base, connection: Connection) -> bool:
    """The eighth connection of a container and all that follow bring no on_connect."""
    made = self.__dict__["made"] = self.__dict__.get("made", 0) + 1
    if made >= 8:
        self.manager.connections[connection.id] = connection
    return bool(made < 8)


@breaks("R-11.2.1.3-05")
class disconnects_silently_from_the_third(Base):
    """The third disconnection of a container and all that follow bring no on_disconnect."""

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        undone = self.__dict__["undone"] = self.__dict__.get("undone", 0) + 1
        if undone >= 3:
            del self.manager.connections[connection.id]
        else:
            super()._disconnect(connection, failures)


@breaks("R-11.2.1.2-06", also=("R-11.2.2.2-04", "R-11.2.2.2-05"))
class removes_silently_from_the_eighth(Base):
    """The eighth component that is removed from a container, and all that follow, get no on_remove."""

    def _remove(self, member: Member, failures: Failures) -> None:
        removed = self.__dict__["removed"] = self.__dict__.get("removed", 0) + 1
        if removed >= 8:
            del self.members[member.id]
        else:
            super()._remove(member, failures)


@replaces("exchange", "R-11.1.3-01", also=("R-11.1.2-02",))
def calls_a_peer_twice(self: PeerProxy, value: int) -> int:
    """From the third call on a reference returns what it returned before."""
    results = self.__dict__.setdefault("results", [])
    if len(results) < 2:
        results.append(self.target.exchange(value))
    return int(results[-1])


@replaces("exchange", "R-11.1.3-01", also=("R-11.1.2-02",))
def calls_a_peer_255_times(self: PeerProxy, value: int) -> int:
    """Each 256th call through a reference returns 0 and calls nobody."""
    calls = self.__dict__["calls"] = self.__dict__.get("calls", 0) + 1
    return self.target.exchange(value) if calls % 256 else 0


@breaks("R-11.2.1.4-03")
class shows_fragments_three_members(Base):
    """Fragments see three members of their container at most."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        if member.implementation.fragment:
            self._set_attributes(member, attributes)
            member.body.set_container_interface(_FirstThree(self))  # type: ignore[attr-defined]
            self._initialise(member)
        else:
            super()._configure(member, attributes)


class _FirstThree:
    def __init__(self, container: Container) -> None:
        self.container = container

    def get_components(self) -> list[int]:
        """Three ids at most."""
        return self.container.get_components()[:3]


@breaks("R-11.2.2.2-04")
class removes_three_members_with_their_container(Base):
    """remove_container calls on_remove on three members and drops the others."""

    def _remove_members(self, failures: Failures) -> None:
        for number, member in enumerate(reversed(list(self.members.values()))):
            if number < 3 or not is_below(self):
                self._remove(member, failures)
        self.members.clear()


@breaks("R-11.2.2.2-05")
class destroys_seven_members(Base):
    """destroy calls on_remove on seven members of a container and drops the others."""

    def destroy(self) -> None:
        for container in (self.manager, *self.manager.sub_containers):
            container.members = dict(list(container.members.items())[:7])
        ContainerManager.destroy(self.manager)
