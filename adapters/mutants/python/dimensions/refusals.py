"""Operations that are refused and yet change something: the instance, its neighbours or the container (12.10)."""

from __future__ import annotations

from collections.abc import Mapping

from ucm_cts.adapters.contract.programming_model import (
    BadParameter,
    NotFound,
    PortConnection,
    PortElementObject,
    UcmError,
)
from ucm_cts.adapters.mutants.python.registry import Base, breaks, is_below
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member, State

_REFUSED = (UcmError, NotFound, BadParameter)


# connect


class _RefusedConnect(Base):
    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        try:
            return super().connect(instance, port_name, to_port)
        except _REFUSED as error:
            self._refused(error, instance, port_name, to_port)
            raise

    def _refused(self, error: Exception, instance: int, port_name: str, to_port: PortElementObject | None) -> None:
        raise NotImplementedError


@breaks("R-11.2.2.1-08", also=("R-12.10-24", "R-11.2.3-08"))
class takes_ports_for_connected_that_were_refused_nothing(_RefusedConnect):
    """A port that a null reference was refused for cannot be connected any more."""

    def _refused(self, error: Exception, instance: int, port_name: str, to_port: PortElementObject | None) -> None:
        if to_port is None and instance in self.members:
            self.__dict__.setdefault("taken", set()).add((instance, port_name))

    def _connect_to(self, member: Member, port: str, target: PortElementObject) -> int:
        if (member.id, port) in self.__dict__.get("taken", ()):
            raise UcmError("connected already")
        return super()._connect_to(member, port, target)


@breaks("R-11.2.3-06", also=("R-11.2.2.1-10", "R-11.2.3-10", "R-11.2.1.3-05", "R-12.10-24", "R-12.10-16"))
class second_connect_loses_the_first(_RefusedConnect):
    """A second connect is refused, and the first connection is lost."""

    def _refused(self, error: Exception, instance: int, port_name: str, to_port: PortElementObject | None) -> None:
        if instance in self.members and to_port is not None:
            for connection in self._connections_from(self.members[instance]):
                if connection.port == port_name and not self.is_started:
                    del self.manager.connections[connection.id]


@breaks("R-11.2.1.2-03", also=("R-11.2.3-10", "R-11.1.3-01", "R-12.10-25"))
class second_connect_takes_effect(_RefusedConnect):
    """A second connect is refused, and its reference is handed over at start."""

    def _refused(self, error: Exception, instance: int, port_name: str, to_port: PortElementObject | None) -> None:
        if instance in self.members and to_port is not None:
            for old in self._connections_from(self.members[instance]):
                if old.port == port_name:
                    self.manager.connections[old.id] = Connection(old.id, old.client, old.port, to_port)


@breaks("R-11.2.1.3-03")
class tells_of_second_connections(_RefusedConnect):
    """A second connect is refused, and the body gets on_connect all the same."""

    def _refused(self, error: Exception, instance: int, port_name: str, to_port: PortElementObject | None) -> None:
        member = self.members.get(instance)
        is_told = member is not None and member.implementation.connectable and not self.is_started
        if member is not None and is_told and self._is_connected(member, port_name):
            Failures().attempt(member.body.on_connect, port_name, to_port)  # type: ignore[attr-defined]


@breaks("R-11.2.2.1-07", also=("R-12.10-15",))
class loses_clients_of_unknown_ports(_RefusedConnect):
    """After connect of an unknown port, get_port_element does not find the component's port elements."""

    def _refused(self, error: Exception, instance: int, port_name: str, to_port: PortElementObject | None) -> None:
        if instance in self.members and port_name not in self.members[instance].implementation.requires:
            self.__dict__.setdefault("lost", set()).add(instance)

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(comp_instance, port_name)
        if comp_instance in self.__dict__.get("lost", ()):
            raise NotFound("lost")
        return element


@breaks("R-11.2.2.1-08", also=("R-11.2.3-08", "R-11.2.1.3-01", "R-11.2.1.1-01"))
class keeps_references_that_nobody_took(_RefusedConnect):
    """A reference that was to be connected to an unknown component is refused from then on."""

    def _refused(self, error: Exception, instance: int, port_name: str, to_port: PortElementObject | None) -> None:
        if instance not in self.members and to_port is not None:
            self.__dict__.setdefault("spent", []).append(to_port)

    def _connect_to(self, member: Member, port: str, target: PortElementObject) -> int:
        if any(target is spent for spent in self.__dict__.get("spent", ())):
            raise UcmError("in use")
        return super()._connect_to(member, port, target)


@breaks("R-11.2.3-08", also=("R-11.2.2.1-08",))
class connects_late_for_ever(_RefusedConnect):
    """A port that was to be connected while its container ran cannot be connected after the stop."""

    def _refused(self, error: Exception, instance: int, port_name: str, to_port: PortElementObject | None) -> None:
        if self.is_started:
            self.__dict__.setdefault("late", set()).add((instance, port_name))

    def _connect_to(self, member: Member, port: str, target: PortElementObject) -> int:
        if (member.id, port) in self.__dict__.get("late", ()):
            raise UcmError("the container is started")
        return super()._connect_to(member, port, target)


# disconnect


@breaks("R-11.2.3-10", also=("R-11.2.3-06", "R-11.2.2.1-10", "R-12.10-16"))
class late_disconnect_takes_effect(Base):
    """A disconnect that is refused because the container runs has lost the connection after the stop."""

    def disconnect(self, connection: int) -> None:
        if self.is_started and connection in self.manager.connections:
            self.__dict__.setdefault("late", set()).add(connection)
        super().disconnect(connection)

    def stop(self) -> None:
        super().stop()
        for connection in self.__dict__.pop("late", ()):
            self.manager.connections.pop(connection, None)


@breaks("R-11.2.3-06", also=("R-11.2.2.1-10", "R-11.2.3-10", "R-12.10-16", "R-11.2.3-08"))
class unknown_disconnect_hits_the_last(Base):
    """disconnect of an unknown connection is refused, and the connection made last is lost."""

    def disconnect(self, connection: int) -> None:
        if connection not in self.manager.connections and self.manager.connections and not self.is_started:
            self.manager.connections.popitem()
        super().disconnect(connection)


@breaks("R-11.2.1.3-05")
class tells_of_late_disconnections(Base):
    """A disconnect that is refused because the container runs brings on_disconnect."""

    def disconnect(self, connection: int) -> None:
        found = self.manager.connections.get(connection)
        if self.is_started and found is not None and found.client.implementation.connectable:
            Failures().attempt(found.client.body.on_disconnect, found.port)  # type: ignore[attr-defined]
        super().disconnect(connection)


# start and stop


@breaks("R-11.2.2.1-08", also=("R-11.2.3-08", "R-11.2.2.1-01", "R-11.2.2.1-11", "R-11.2.3-06"))
class refused_start_ends_configuration(Base):
    """After a start that was refused because of a missing connection, connect is refused."""

    def _check_startable(self) -> None:
        try:
            super()._check_startable()
        except UcmError:
            self.__dict__["is closed"] = True
            raise

    def _connect_to(self, member: Member, port: str, target: PortElementObject) -> int:
        if self.__dict__.get("is closed"):
            raise UcmError("the container has been started")
        return super()._connect_to(member, port, target)


@breaks("R-11.2.2.1-05", also=("R-11.2.3-11",))
class refused_start_holds_the_loners(Base):
    """After a start that was refused, components that require nothing cannot be removed."""

    def _check_startable(self) -> None:
        try:
            super()._check_startable()
        except UcmError:
            for member in self.members.values():
                member.__dict__["is held"] = not member.implementation.requires
            raise

    def _check_removable(self, member: Member) -> None:
        super()._check_removable(member)
        if member.__dict__.get("is held"):
            raise UcmError("it is starting")


@breaks("R-11.2.2.1-12", also=("R-11.2.3-09", "R-11.2.1.2-10"))
class second_start_takes_two_stops(Base):
    """A container that was started twice is stopped by the second stop only."""

    def start(self) -> None:
        self.__dict__["again"] = self.is_started
        super().start()

    def stop(self) -> None:
        if self.__dict__.pop("again", False) and self.is_started:
            return
        super().stop()


@breaks("R-11.2.3-06", also=("R-11.2.3-10", "R-11.2.2.1-10", "R-11.2.3-08", "R-12.10-16"))
class second_stop_loses_connections(Base):
    """stop of a container that is not started loses its connections."""

    def stop(self) -> None:
        if not self.is_started:
            for connection in self._connections_of_members():
                del self.manager.connections[connection.id]
        super().stop()


@breaks("R-11.2.3-06", also=("R-11.2.2.1-11", "R-11.2.3-10"))
class early_stop_prevents_the_start(Base):
    """A container that was stopped before its first start refuses the start."""

    def stop(self) -> None:
        self.__dict__.setdefault("is spoilt", not self.is_started)
        super().stop()

    def start(self) -> None:
        self.__dict__.setdefault("is spoilt", False)
        if self.__dict__["is spoilt"] and self.members:
            self._check_startable()
            raise UcmError("it has been stopped")
        super().start()


# remove


@breaks("R-11.2.2.1-14", also=("R-12.10-15", "R-11.2.3-11", "R-11.2.2.1-07"))
class refused_removal_hides_the_server(Base):
    """A component that cannot be removed because others use it is not listed from then on."""

    def _check_removable(self, member: Member) -> None:
        try:
            super()._check_removable(member)
        except UcmError:
            self.__dict__.setdefault("hidden", set()).add(member.id)
            raise

    def get_components(self) -> list[int]:
        return [number for number in super().get_components() if number not in self.__dict__.get("hidden", ())]


@breaks("R-11.2.1.2-10", also=("R-11.2.3-11",))
class refused_removal_shuts_down(Base):
    """A running component gets on_shutdown when its removal is refused."""

    def _check_removable(self, member: Member) -> None:
        if member.state is State.READY:
            Failures().attempt(member.body.on_shutdown)
        super()._check_removable(member)


@breaks("R-11.2.3-10", also=("R-11.2.3-06", "R-11.2.1.3-05", "R-11.2.2.1-10", "R-12.10-16"))
class refused_removal_disconnects(Base):
    """A running component loses its connections when its removal is refused."""

    def _check_removable(self, member: Member) -> None:
        if member.state is State.READY:
            for connection in self._connections_from(member):
                del self.manager.connections[connection.id]
        super()._check_removable(member)


@breaks("R-11.2.1.2-06", also=("R-12.10-15", "R-11.2.2.1-14", "R-11.2.1.2-01"))
class unknown_removal_hits_the_last(Base):
    """remove_component of an unknown component is NOT_FOUND, and the member added last gets on_remove."""

    def remove_component(self, comp_instance: int) -> None:
        if comp_instance not in self.members and self.members and not self.is_started:
            Failures().attempt(list(self.members.values())[-1].body.on_remove)
        super().remove_component(comp_instance)


@breaks("R-11.2.2.2-02", also=("R-11.1.3-03",))
class refused_removal_of_nothing_ends_creation(Base):
    """After remove_container of nothing, create_container is refused."""

    def remove_container(self, sub_container: Container | None) -> None:
        self.__dict__["is spoilt"] = self.__dict__.get("is spoilt") or sub_container is None
        ContainerManager.remove_container(self.manager, sub_container)

    def create_container(self) -> Container:
        if self.__dict__.get("is spoilt"):
            raise UcmError("no more containers")
        return ContainerManager.create_container(self.manager)


@breaks("R-11.2.2.1-01", also=("R-11.2.2.1-08", "R-11.2.2.1-05", "R-11.2.3-06", "R-11.2.2.1-10", "R-11.1.3-02"))
class second_removal_ends_the_manager(Base):
    """After remove_container of a removed container the manager refuses add_component."""

    def remove_container(self, sub_container: Container | None) -> None:
        self.__dict__["is spoilt"] = sub_container is not None and sub_container.is_removed
        ContainerManager.remove_container(self.manager, sub_container)

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        if self.__dict__.get("is spoilt"):
            raise UcmError("it is gone")
        return super().add_component(implementation, attributes)


# add_component and get_port_element


@breaks("R-11.2.2.1-14")
class lists_what_it_could_not_add(Base):
    """get_components lists a number for each implementation that is unknown."""

    def _find_implementation(self, name: str, attributes: Mapping[str, str]) -> object:  # type: ignore[override]
        try:
            return super()._find_implementation(name, attributes)
        except UcmError:
            self.__dict__.setdefault("ghosts", []).append(self._new_id())
            raise

    def get_components(self) -> list[int]:
        return [*super().get_components(), *self.__dict__.get("ghosts", [])]


@breaks("R-11.2.2.1-14", also=("R-11.2.1.4-03",))
class lists_late_additions_after_the_stop(Base):
    """What could not be added to a running container is listed after the stop."""

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        if self.is_started:
            self.__dict__.setdefault("late", []).append(self._new_id())
        return super().add_component(implementation, attributes)

    def get_components(self) -> list[int]:
        late = self.__dict__.get("late", [])
        return [*super().get_components(), *(late if not self.is_started else [])]


@breaks("R-11.2.2.1-07")
class asks_once_for_unknown_names(Base):
    """Once get_port_element was asked for a name that a component does not have, it finds no element of it."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        member = self.members.get(comp_instance)
        if member is not None and member.__dict__.get("was misread"):
            raise NotFound("no such port element")
        if member is not None and port_name not in member.implementation.provides:
            member.__dict__["was misread"] = True
        return super().get_port_element(comp_instance, port_name)


@breaks("R-11.2.3-10", also=("R-11.2.1.2-09",))
class early_look_up_spoils_the_start(Base):
    """A component of a sub-container whose required port element was asked for is given nothing at start."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        member = self.members.get(comp_instance)
        if member is not None and port_name in member.implementation.requires and is_below(self):
            member.__dict__["is spoilt"] = True
        return super().get_port_element(comp_instance, port_name)

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        return [] if member.__dict__.get("is spoilt") else super()._dependencies_of(member)
