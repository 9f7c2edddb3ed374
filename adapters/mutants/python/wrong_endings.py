"""Wrong frameworks whose defect shows when something is removed, fails or changes while it runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ucm_cts.adapters.contract.programming_model import PortConnection, PortElementObject, UcmError
from ucm_cts.adapters.mutants.python.readings import adds_later, configures_at_any_time
from ucm_cts.adapters.mutants.python.registry import Base, breaks, is_below
from ucm_cts.adapters.reference.python.framework import Connection, Failures, Member, State

# removal of containers


@breaks("R-11.2.2.2-04", also=("R-11.2.2.2-05",))
class removes_the_first_only(Base):
    """remove_container, and destroy below the manager, call on_remove on one member only."""

    def _remove_members(self, failures: Failures) -> None:
        for member in list(self.members.values())[1:] if is_below(self) else ():
            del self.members[member.id]
        super()._remove_members(failures)


# failing bodies


@breaks("R-11.2.3-09")
class leaves_the_rest_ready(Base):
    """After a failing on_shutdown the others are not shut down, and the next start starts them again."""

    def _shut_down_started(self, failures: Failures) -> None:
        while self.started and not failures.first:
            self._shut_down(self.started.pop(), failures)
        self.started.clear()
        self.is_started = False


@breaks("R-11.2.2.2-01", also=("R-11.2.3-07",))
class never_recovers_from_a_failing_stop(Base):
    """After a failing on_shutdown the container counts as started for good: stop and start return and do nothing."""

    def stop(self) -> None:
        try:
            super().stop()
        except UcmError:
            self.__dict__["stuck"] = True
            raise

    def start(self) -> None:
        if not self.__dict__.get("stuck"):
            super().start()


@breaks("R-11.2.1.2-10")
class shuts_down_what_never_started(Base):
    """After a failing on_startup every member is told on_shutdown, started or not."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        if super()._start_up(member, failures):
            return True
        self.started = list(self.members.values())
        return False


@breaks("R-12.10-22")
class starts_what_failed_to_initialise(Base):
    """A body whose on_init raised is started with the others, though it is no member."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        try:
            super()._configure(member, attributes)
        except Exception:
            self.__dict__.setdefault("ghosts", []).append(member)
            raise

    def start(self) -> None:
        again = self.is_started
        super().start()
        for ghost in self.__dict__.get("ghosts", []) if not again else ():
            Failures().attempt(ghost.body.on_startup, [])


# changes in the operational phase


@breaks("R-11.2.2.1-11")
class never_starts_late_additions(adds_later):
    """What was added to a started container and requires something is never started, not even after a stop."""

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        late = self.is_started
        identifier = super().add_component(implementation, attributes)
        self.members[identifier].__dict__["late"] = late
        return identifier

    def _start_order(self) -> Sequence[Member]:
        return [m for m in super()._start_order() if not (m.__dict__["late"] and m.implementation.requires)]


@breaks("R-11.2.1.3-02")
class connects_late_additions_silently(adds_later):
    """A component that was added to a started container is not told on_connect there."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        self.__dict__["silent"] = self.is_started
        return super().connect(instance, port_name, to_port)

    def _connect(self, connection: Connection) -> None:
        if self.__dict__["silent"]:
            self.manager.connections[connection.id] = connection
        else:
            super()._connect(connection)


@breaks("R-11.2.1.2-09")
class loses_late_connections(adds_later):
    """What was connected in a started container is not handed over at the next start."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        late = self.is_started
        identifier = super().connect(instance, port_name, to_port)
        self.__dict__.setdefault("lost", set()).update({identifier} if late else ())
        return identifier

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        lost = self.__dict__.get("lost", ())
        return [PortConnection(c.port, (c.target,)) for c in self._connections_from(member) if c.id not in lost]


@breaks("R-11.2.3-10")
class loses_connections_of_ready_components(configures_at_any_time):
    """connect of an operational component returns an id and does nothing."""

    def _connect(self, connection: Connection) -> None:
        if connection.client.state is not State.READY:
            super()._connect(connection)


@breaks("R-11.2.3-01")
class starts_late_additions_unconnected(adds_later):
    """A component added to a started container is started at once, connected or not."""

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        identifier = super().add_component(implementation, attributes)
        if self.is_started:
            self._start_up(self.members[identifier], Failures())
        return identifier
