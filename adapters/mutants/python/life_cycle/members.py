"""Wrong frameworks whose defect concerns some members or some situations: listing, start, removal, failure (11.2)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ucm_cts.adapters.contract.programming_model import FragmentObject, PortConnection, PortElementObject, UcmError
from ucm_cts.adapters.mutants.python.methods import alters, does_only_if, replaces
from ucm_cts.adapters.mutants.python.registry import Base, breaks, container_of, is_below
from ucm_cts.adapters.mutants.python.variants.readings import adds_later, configures_at_any_time
from ucm_cts.adapters.reference.python.framework import Container
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member, State

# members, listed, started and stopped


@replaces("_start_order", "R-11.2.2.1-11", also=("R-11.2.1.4-01",))
def forgets_the_fourth_below(self: Base) -> Sequence[Member]:
    """start leaves out the fourth member of a sub-container."""
    order = list(Base._start_order(self))
    return [*order[:3], *order[4:]] if is_below(self) else order


@replaces("_start_order", "R-11.2.2.1-11", also=("R-11.2.1.4-01",))
def forgets_the_fifth(self: Base) -> Sequence[Member]:
    """start leaves out the fifth member."""
    order = list(Base._start_order(self))
    return [*order[:4], *order[5:]]


@alters("_start_order", "R-11.2.2.1-11", also=("R-11.2.1.4-01",))
def starts_sixteen(_self: Base, given: Sequence[Member]) -> Sequence[Member]:
    """start reaches sixteen members and no more."""
    return list(given)[:16]


@replaces("stop", "R-11.2.2.1-13")
def swaps_the_last_two(self: Base) -> None:
    """stop shuts the two members started last down in the order of their start, if there are at least three."""
    if len(self.started) >= 3:
        self.started[-1], self.started[-2] = self.started[-2], self.started[-1]
    Base.stop(self)


@replaces("stop", "R-11.2.2.1-13")
def fragments_turn_the_order(self: Base) -> None:
    """If a member is a fragment, stop shuts members down in the order of their start."""
    if any(isinstance(m.body, FragmentObject) for m in self.started):
        self.started.reverse()
    Base.stop(self)


@replaces("stop", "R-11.2.2.1-13")
def stops_in_order_once(self: Base) -> None:
    """Only the first stop of a container goes in reverse."""
    stops = self.__dict__["stops"] = self.__dict__.get("stops", 0) + 1
    if stops > 1:
        self.started.reverse()
    Base.stop(self)


@alters("get_components", "R-11.2.2.1-14")
def caches_the_list(self: Base, listed: list[int]) -> list[int]:
    """While a sub-container is started, get_components returns the list of the first call."""
    if not (is_below(self) and self.is_started):
        return listed
    return self.__dict__.setdefault("listed", listed)  # type: ignore[no-any-return]


@breaks("R-12.10-15")
class confuses_removed_ids(Base):
    """get_port_element for the id of a removed component returns that of the member added last."""

    def remove_component(self, comp_instance: int) -> None:
        super().remove_component(comp_instance)
        self.__dict__.setdefault("removed", []).append(comp_instance)

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        if comp_instance in self.__dict__.get("removed", []) and comp_instance not in self.members and self.members:
            comp_instance = list(self.members)[-1]
        return super().get_port_element(comp_instance, port_name)


@breaks("R-12.10-15", also=("R-11.1.3-04",))
class finds_members_elsewhere(Base):
    """Every container accepts the component ids of all containers of the runtime."""

    def _find_member(self, number: int) -> Member:
        for container in (self.manager, *self.manager.sub_containers):
            if number in container.members:
                return container.members[number]
        return super()._find_member(number)

    def _remove(self, member: Member, failures: Failures) -> None:
        if member.container is self:
            super()._remove(member, failures)
        else:
            container_of(member)._remove(member, failures)


@replaces("disconnect", "R-12.10-16", also=("R-11.1.3-04",))
def undoes_connections_elsewhere(self: Base, connection: int) -> None:
    """Every container accepts the connection ids of all containers of the runtime."""
    found = self.manager.connections.get(connection)
    container = container_of(found.client) if found is not None else self
    Container.disconnect(container, connection)


# attributes and fragments


@does_only_if("_set_attributes", "R-11.2.1.2-05")
def fragments_have_no_attributes(_self: Base, member: Member, _attributes: Mapping[str, str]) -> bool:
    """Attributes of fragments are not set."""
    return not isinstance(member.body, FragmentObject)


@replaces("_set_attributes", "R-11.2.1.2-05")
def sets_attributes_once(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """Attributes are set for the first instance of an implementation only."""
    known: set[str] = self.manager.__dict__.setdefault("known", set())
    if member.implementation.name not in known:
        Base._set_attributes(self, member, attributes)
    known.add(member.implementation.name)


@replaces("_set_attributes", "R-11.2.3-19")
def names_its_components(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """Every body is given an attribute 'name', which its type does not have."""
    Base._set_attributes(self, member, {**attributes, "name": str(member.id)})


@replaces("_set_attributes", "R-11.2.3-19")
def hands_attributes_on(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """A body is given the attributes of all components that were added before, too."""
    known: dict[str, str] = self.manager.__dict__.setdefault("all attributes", {})
    known.update(attributes)
    Base._set_attributes(self, member, known)


@does_only_if("_set_attributes", "R-11.2.1.2-05")
def no_attributes_below(self: Base, _member: Member, _attributes: Mapping[str, str]) -> bool:
    """Attributes are set in the manager only."""
    return not is_below(self)


@replaces("_configure", "R-11.2.1.4-03")
def shows_fragments_the_manager(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """Fragments of sub-containers are given the manager instead of their own container."""
    self._set_attributes(member, attributes)
    if isinstance(member.body, FragmentObject):
        member.body.set_container_interface(self.manager)
    self._initialise(member)


class _Remembered:
    """Repeats the first list of a container."""

    def __init__(self, container: Container) -> None:
        self.container = container
        self.listed: list[int] | None = None

    def get_components(self) -> list[int]:
        if self.listed is None:
            self.listed = self.container.get_components()
        return self.listed


@replaces("_configure", "R-11.2.1.4-03")
def shows_fragments_the_past(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """The container interface of a fragment repeats its first answer for ever."""
    self._set_attributes(member, attributes)
    if isinstance(member.body, FragmentObject):
        member.body.set_container_interface(_Remembered(self))
    self._initialise(member)


@replaces("_start_up", "R-11.2.1.4-02")
def shows_fragments_their_container_again(self: Base, member: Member, failures: Failures) -> bool:
    """set_container_interface comes again with the second start."""
    starts = member.__dict__["starts"] = member.__dict__.get("starts", 0) + 1
    if starts == 2 and isinstance(member.body, FragmentObject):
        member.body.set_container_interface(self)
    return Base._start_up(self, member, failures)


# removal of containers


@replaces("_remove_members", "R-11.2.2.2-04", also=("R-11.2.2.2-05",))
def removes_the_first_only(self: Base, failures: Failures) -> None:
    """remove_container, and destroy below the manager, call on_remove on one member only."""
    for member in list(self.members.values())[1:] if is_below(self) else ():
        del self.members[member.id]
    Base._remove_members(self, failures)


# failing bodies


@replaces("_shut_down_started", "R-11.2.3-09")
def leaves_the_rest_ready(self: Base, failures: Failures) -> None:
    """After a failing on_shutdown the other members are not shut down; the next start starts them again."""
    while self.started and not failures.first:
        self._shut_down(self.started.pop(), failures)
    self.started.clear()
    self.is_started = False


@breaks("R-11.2.2.2-01", also=("R-11.2.3-07",))
class never_recovers_from_a_failing_stop(Base):
    """After a failing on_shutdown stop and start return and do nothing."""

    def stop(self) -> None:
        try:
            super().stop()
        except UcmError:
            self.__dict__["stuck"] = True
            raise

    def start(self) -> None:
        if not self.__dict__.get("stuck"):
            super().start()


@replaces("_start_up", "R-11.2.1.2-10")
def shuts_down_what_never_started(self: Base, member: Member, failures: Failures) -> bool:
    """After a failing on_startup every member gets on_shutdown, also those that were not started."""
    if Base._start_up(self, member, failures):
        return True
    self.started = list(self.members.values())
    return False


@breaks("R-12.10-22")
class starts_what_failed_to_initialise(Base):
    """start starts a body whose on_init raised, although it is no member."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        try:
            super()._configure(member, attributes)
        except Exception:
            self.__dict__.setdefault("failed", []).append(member)
            raise

    def start(self) -> None:
        again = self.is_started
        super().start()
        for member in self.__dict__.get("failed", []) if not again else ():
            Failures().attempt(member.body.on_startup, [])


# changes in the operational phase


@breaks("R-11.2.2.1-11")
class never_starts_late_additions(adds_later):
    """A component added to a started container is never started if it requires something."""

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        late = self.is_started
        identifier = super().add_component(implementation, attributes)
        self.members[identifier].__dict__["late"] = late
        return identifier

    def _start_order(self) -> Sequence[Member]:
        return [m for m in super()._start_order() if not (m.__dict__["late"] and m.implementation.requires)]


@breaks("R-11.2.1.3-02")
class connects_late_additions_silently(adds_later):
    """A component added to a started container gets no on_connect there."""

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
    """Connections made in a started container are not handed over at the next start."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        late = self.is_started
        identifier = super().connect(instance, port_name, to_port)
        self.__dict__.setdefault("lost", set()).update({identifier} if late else ())
        return identifier

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        lost = self.__dict__.get("lost", ())
        return [PortConnection(c.port, (c.target,)) for c in self._connections_from(member) if c.id not in lost]


@does_only_if("_connect", "R-11.2.3-10")
def loses_connections_of_ready_components(_self: configures_at_any_time, connection: Connection) -> bool:
    """connect of an operational component returns an id and does nothing."""
    return connection.client.state is not State.READY


@alters("add_component", "R-11.2.3-01")
def starts_late_additions_unconnected(self: adds_later, identifier: int, *_: object) -> int:
    """A component added to a started container is started at once, connected or not."""
    if self.is_started:
        self._start_up(self.members[identifier], Failures())
    return identifier
