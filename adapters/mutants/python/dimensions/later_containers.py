"""What was given out long ago: containers and ends of connectors after removal, restart and replacement."""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import (
    UcmError,
)
from ucm_cts.adapters.mutants.python.registry import Base, breaks, is_below
from ucm_cts.adapters.reference.python.connectors import Link, Taker
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager
from ucm_cts.adapters.reference.python.members import Failures, Member

# containers


@breaks("R-12.10-17")
class removes_containers_by_place(Base):
    """remove_container of a removed container removes the one that was created last."""

    def remove_container(self, sub_container: Container | None) -> None:
        if sub_container is not None and sub_container.is_removed and self.manager.sub_containers:
            sub_container = self.manager.sub_containers[-1]
        ContainerManager.remove_container(self.manager, sub_container)


@breaks("R-12.10-17", also=("R-12.10-13",))
class removes_containers_twice_if_others_are_left(Base):
    """remove_container of a removed container returns if there are other sub-containers."""

    def remove_container(self, sub_container: Container | None) -> None:
        if sub_container is not None and sub_container.is_removed and self.manager.sub_containers:
            return
        ContainerManager.remove_container(self.manager, sub_container)


@breaks("R-11.2.2.1-14", also=("R-11.2.2.1-01", "R-11.2.2.1-03"))
class new_containers_have_old_members(Base):
    """A container that is created after another was removed lists the members of that one."""

    def remove_container(self, sub_container: Container | None) -> None:
        old = list(sub_container.members) if sub_container is not None else []
        ContainerManager.remove_container(self.manager, sub_container)
        self.__dict__["old"] = old

    def create_container(self) -> Container:
        container = ContainerManager.create_container(self.manager)
        container.__dict__["old"] = self.__dict__.get("old", [])
        return container

    def get_components(self) -> list[int]:
        old = self.__dict__.get("old", []) if is_below(self) else []
        return [*old, *super().get_components()]


@breaks("R-11.2.2.2-05")
class destroys_the_oldest_container_only(Base):
    """destroy leaves out members of all sub-containers but the first."""

    def destroy(self) -> None:
        for container in self.manager.sub_containers[1:]:
            container.members.clear()
            container.started.clear()
        ContainerManager.destroy(self.manager)


@breaks("R-11.2.2.2-05")
class destroys_without_shutting_down_below(Base):
    """destroy does not shut down the members of sub-containers that run."""

    def destroy(self) -> None:
        for container in self.manager.sub_containers:
            container.started.clear()
        ContainerManager.destroy(self.manager)


@breaks("R-11.2.2.2-05")
class destroys_without_shutting_down_after_a_restart(Base):
    """destroy does not shut down members that have been started more than once."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        member.__dict__["lives"] = member.__dict__.get("lives", 0) + 1
        return super()._start_up(member, failures)

    def destroy(self) -> None:
        for container in (self.manager, *self.manager.sub_containers):
            container.started = [m for m in container.started if m.__dict__.get("lives", 0) < 2]
        ContainerManager.destroy(self.manager)


@breaks("R-11.2.2.2-04")
class removes_restarted_containers_without_shutdown(Base):
    """remove_container does not shut down members that have been started more than once."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        member.__dict__["lives"] = member.__dict__.get("lives", 0) + 1
        return super()._start_up(member, failures)

    def remove_container(self, sub_container: Container | None) -> None:
        if sub_container is not None:
            sub_container.started = [m for m in sub_container.started if m.__dict__.get("lives", 0) < 2]
        ContainerManager.remove_container(self.manager, sub_container)


# ends of connectors


class _Session(Link):
    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if self.takers and self.takers[0].member.__dict__.get("starts", 0) > 2:
            raise UcmError("the session has ended")
        return super()._request(method, arguments)


@breaks("R-10.1.5.1-01", clauses=("10.1.5",), also=("R-10.1.5.1-03",))
class knows_servers_for_two_phases(Base):
    """A server that is started a third time serves nobody."""

    link_class = _Session

    def _start_up(self, member: Member, failures: Failures) -> bool:
        member.__dict__["starts"] = member.__dict__.get("starts", 0) + 1
        return super()._start_up(member, failures)


@breaks("R-10.1.5.1-01", clauses=("10.1.5",), also=("R-10.1.5.1-05", "R-10.1.5.1-03"))
class does_not_serve_after_detaching(Link):
    """A connection whose server was detached serves nobody, although another server has been attached."""

    has_lost_one = False

    def remove(self, taker: Taker) -> None:
        super().remove(taker)
        self.has_lost_one = True

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if self.has_lost_one:
            raise UcmError("there is no server")
        return super()._request(method, arguments)


@breaks("R-10.1.2-10", clauses=("10.1.2",), also=("R-10.1.6.1-04", "R-10.1.6.1-03"))
class drops_messages_after_a_removal(Link):
    """Once a receiver was removed from a connection, the others get nothing, and push returns ok."""

    def remove(self, taker: Taker) -> None:
        super().remove(taker)
        self.__dict__["has lost one"] = True

    def _post(self, taker: Taker, method: str, arguments: list[Datum]) -> None:
        if not self.__dict__.get("has lost one"):
            super()._post(taker, method, arguments)


class _KnowsWhoLeft(Link):
    def remove(self, taker: Taker) -> None:
        super().remove(taker)
        self.__dict__.setdefault("left", []).append((taker.member, taker.port))

    def _has_left(self, taker: Taker) -> bool:
        return (taker.member, taker.port) in self.__dict__.get("left", [])


@breaks("R-10.1.6.1-05", clauses=("10.1.6",))
class serves_twice_who_comes_back(_KnowsWhoLeft):
    """A receiver that is detached and attached again gets each message twice."""

    def _post(self, taker: Taker, method: str, arguments: list[Datum]) -> None:
        super()._post(taker, method, arguments)
        if self._has_left(taker):
            super()._post(taker, method, arguments)


@breaks("R-10.1.6.1-04", clauses=("10.1.6",), also=("R-10.1.2-10", "R-10.1.6.1-03"))
class serves_nobody_who_comes_back(_KnowsWhoLeft):
    """A receiver that is detached and attached again gets no messages, and push returns ok."""

    def _post(self, taker: Taker, method: str, arguments: list[Datum]) -> None:
        if not self._has_left(taker):
            super()._post(taker, method, arguments)
