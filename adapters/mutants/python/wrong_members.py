"""Wrong frameworks that mistreat some of their members, or some of the time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ucm_cts.adapters.contract.programming_model import FragmentObject, PortElementObject
from ucm_cts.adapters.mutants.python.methods import alters, does_only_if
from ucm_cts.adapters.mutants.python.registry import Base, breaks, is_below
from ucm_cts.adapters.reference.python.framework import Container, Failures, Member

# members, listed, started and stopped


@breaks("R-11.2.2.1-11", also=("R-11.2.1.4-01",))
class forgets_the_fourth_below(Base):
    """start leaves out the fourth member of a sub-container, be it a fragment or not."""

    def _start_order(self) -> Sequence[Member]:
        order = list(super()._start_order())
        return [*order[:3], *order[4:]] if is_below(self) else order


@breaks("R-11.2.2.1-11", also=("R-11.2.1.4-01",))
class forgets_the_fifth(Base):
    """start leaves out the fifth member, be it a fragment or not."""

    def _start_order(self) -> Sequence[Member]:
        order = list(super()._start_order())
        return [*order[:4], *order[5:]]


@alters("_start_order", "R-11.2.2.1-11", also=("R-11.2.1.4-01",))
def starts_sixteen(_self: Base, given: Sequence[Member]) -> Sequence[Member]:
    """start reaches sixteen members and no more."""
    return list(given)[:16]


@breaks("R-11.2.2.1-13")
class swaps_the_last_two(Base):
    """Of three or more members the two started last are shut down in the order of their start."""

    def stop(self) -> None:
        if len(self.started) >= 3:
            self.started[-1], self.started[-2] = self.started[-2], self.started[-1]
        super().stop()


@breaks("R-11.2.2.1-13")
class fragments_turn_the_order(Base):
    """Where a fragment is among the members, stop goes in the order of their start."""

    def stop(self) -> None:
        if any(isinstance(m.body, FragmentObject) for m in self.started):
            self.started.reverse()
        super().stop()


@breaks("R-11.2.2.1-13")
class stops_in_order_once(Base):
    """Only the first stop of a container goes in reverse."""

    def stop(self) -> None:
        stops = self.__dict__["stops"] = self.__dict__.get("stops", 0) + 1
        if stops > 1:
            self.started.reverse()
        super().stop()


@alters("get_components", "R-11.2.2.1-14")
def caches_the_list(self: Base, listed: list[int]) -> list[int]:
    """While a sub-container is started, get_components lists what was there when it was first asked so."""
    if not (is_below(self) and self.is_started):
        return listed
    return self.__dict__.setdefault("listed", listed)  # type: ignore[no-any-return]


@breaks("R-12.10-15")
class confuses_removed_ids(Base):
    """get_port_element for a removed component's id gives that of the member added last."""

    def remove_component(self, comp_instance: int) -> None:
        super().remove_component(comp_instance)
        self.__dict__.setdefault("removed", []).append(comp_instance)

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        if comp_instance in self.__dict__.get("removed", []) and comp_instance not in self.members and self.members:
            comp_instance = list(self.members)[-1]
        return super().get_port_element(comp_instance, port_name)


@breaks("R-12.10-15", also=("R-11.1.3-04",))
class finds_members_elsewhere(Base):
    """Component ids work with every container of the runtime."""

    def _find_member(self, number: int) -> Member:
        for container in (self.manager, *self.manager.sub_containers):
            if number in container.members:
                return container.members[number]
        return super()._find_member(number)

    def _remove(self, member: Member, failures: Failures) -> None:
        if member.container is self:
            super()._remove(member, failures)
        else:
            member.container._remove(member, failures)


@breaks("R-12.10-16", also=("R-11.1.3-04",))
class undoes_connections_elsewhere(Base):
    """Connection ids work with every container of the runtime."""

    def disconnect(self, connection: int) -> None:
        found = self.manager.connections.get(connection)
        container = found.client.container if found is not None else self
        Container.disconnect(container, connection)


# attributes and fragments


@does_only_if("_set_attributes", "R-11.2.1.2-05")
def fragments_have_no_attributes(_self: Base, member: Member, _attributes: Mapping[str, str]) -> bool:
    """Attributes of fragments are not set."""
    return not isinstance(member.body, FragmentObject)


@breaks("R-11.2.1.2-05")
class sets_attributes_once(Base):
    """Attributes are set for the first instance of an implementation only."""

    def _set_attributes(self, member: Member, attributes: Mapping[str, str]) -> None:
        known: set[str] = self.manager.__dict__.setdefault("known", set())
        if member.implementation.name not in known:
            super()._set_attributes(member, attributes)
        known.add(member.implementation.name)


@does_only_if("_set_attributes", "R-11.2.1.2-05")
def no_attributes_below(self: Base, _member: Member, _attributes: Mapping[str, str]) -> bool:
    """Attributes are set in the manager only."""
    return not is_below(self)


@breaks("R-11.2.1.4-03")
class shows_fragments_the_manager(Base):
    """Fragments of sub-containers are given the manager instead of their own container."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        self._set_attributes(member, attributes)
        if isinstance(member.body, FragmentObject):
            member.body.set_container_interface(self.manager)
        self._initialise(member)


class _Remembered:
    """What a container listed when it was first asked."""

    def __init__(self, container: Container) -> None:
        self.container = container
        self.listed: list[int] | None = None

    def get_components(self) -> list[int]:
        if self.listed is None:
            self.listed = self.container.get_components()
        return self.listed


@breaks("R-11.2.1.4-03")
class shows_fragments_the_past(Base):
    """What a fragment once learnt of its container's members it is told ever after."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        self._set_attributes(member, attributes)
        if isinstance(member.body, FragmentObject):
            member.body.set_container_interface(_Remembered(self))
        self._initialise(member)


@breaks("R-11.2.1.4-02")
class shows_fragments_their_container_again(Base):
    """set_container_interface comes again with the second start."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        starts = member.__dict__["starts"] = member.__dict__.get("starts", 0) + 1
        if starts == 2 and isinstance(member.body, FragmentObject):
            member.body.set_container_interface(self)
        return super()._start_up(member, failures)
