"""Wrong containers: members of both kinds, container interfaces, and what passes between components (11.1, 11.2.2)."""

from __future__ import annotations

import os
import threading
from collections.abc import Mapping, Sequence

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.mutants.python.methods import alters, refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import Base, Proxy, breaks, is_below
from ucm_cts.adapters.mutants.python.variants.attachments import is_used_elsewhere
from ucm_cts.adapters.mutants.python.variants.phases import starts_all_at_a_time
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member, State


class _Nudge(Proxy):
    fragments = False

    def exchange(self, value: int) -> int:
        if self.member.state is State.READY and isinstance(self.member.body, pm.FragmentObject) == self.fragments:
            self.member.body.on_shutdown()
        return self.target.exchange(value)


@breaks("R-11.1.1-01")
class nudges_components(_Nudge):
    """Calls on_shutdown of a component while no operation of the container is in progress."""


@breaks("R-11.1.2-01")
class nudges_fragments(_Nudge):
    """Calls on_shutdown of a fragment while no operation of the container is in progress."""

    fragments = True


class _Changed(pm.PortElementObject):
    def __init__(self, target: pm.PortElementObject) -> None:
        self.target = target

    def exchange(self, value: int) -> int:
        return self.target.exchange(value) ^ 1


@replaces("_dependencies_of", "R-11.1.3-01")
def spoils_results_between_components(self: Base, member: Member) -> list[pm.PortConnection]:
    """Flips a bit of the result of a call between components."""
    return [
        pm.PortConnection(c.port, (c.target if _of_fragment(self, c) else _Changed(c.target),))
        for c in self._connections_from(member)
    ]


@replaces("_dependencies_of", "R-11.1.2-02")
def spoils_results_of_fragments(self: Base, member: Member) -> list[pm.PortConnection]:
    """Flips a bit of the result of a call of a fragment."""
    return [
        pm.PortConnection(c.port, (_Changed(c.target) if _of_fragment(self, c) else c.target,))
        for c in self._connections_from(member)
    ]


def _of_fragment(container: Container, connection: Connection) -> bool:
    everywhere = [container.manager, *container.manager.sub_containers]
    owners = [m for c in everywhere for m in c.members.values() if connection in c._connections_to(m)]
    return any(isinstance(m.body, pm.FragmentObject) for m in owners)


@refuses_if("_instantiate", "R-11.1.3-02")
def one_kind_a_container(self: Base, implementation: pm.Implementation) -> bool:
    """A container refuses to hold components and fragments together."""
    return any(m.implementation.fragment != implementation.fragment for m in self.members.values())


@replaces("_remove_container", "R-11.2.2.2-03")
def does_not_know_containers_in_use(self: Base, container: Container, failures: Failures) -> None:
    """remove_container ends with NOT_FOUND while components of other containers are connected to members."""
    if is_used_elsewhere(container):
        raise pm.NotFound("in use")
    self.manager._take_down([container], failures)
    self.manager.sub_containers.remove(container)


@replaces("create_container", "R-11.1.3-03")
def one_sub_container(self: Base) -> Container:
    """A second sub-container is refused."""
    if self.manager.sub_containers:
        raise pm.UcmError("one is enough")
    return ContainerManager.create_container(self.manager)


@replaces("start", "R-11.1.3-04")
def starts_the_neighbours(self: Base) -> None:
    """Starting one sub-container starts the members of all other sub-containers, too."""
    Base.start(self)
    for other in self.manager.sub_containers:
        if is_below(self) and other is not self and not other.is_started:
            for member in other.members.values():
                member.body.on_startup(other._dependencies_of(member))


@refuses_if("_instantiate", "R-11.2.2.1-01", also=("R-11.1.3-02",))
def adds_two_member_only(self: Base, *_: object) -> bool:
    """Refuses a third member."""
    return len(self.members) >= 2


@replaces("_initialise", "R-11.2.2.1-02", also=("R-11.2.1.2-05",))
def makes_two_bodies(self: Base, member: Member) -> None:
    """add_component initialises two bodies and keeps one."""
    Base._initialise(self, member)
    member.implementation.create().on_init()


@replaces("add_component", "R-11.2.2.1-03", also=("R-11.2.2.1-06",))
def same_id_for_all(self: Base, implementation: str, attributes: Mapping[str, str]) -> int:
    """A second instance of an implementation is given the id of the first."""
    twins = [m.id for m in self.members.values() if m.implementation.name == implementation]
    identifier = Base.add_component(self, implementation, attributes)
    return twins[0] if twins else identifier


@replaces("_check_removable", "R-11.2.2.1-05")
def cannot_remove(_self: Base, *_: object) -> None:
    """remove_component is refused even if the component is neither connected nor operational."""
    raise pm.UcmError("never")


@alters("get_port_element", "R-11.2.2.1-06")
def any_port_element_will_do(
    self: Base, element: pm.PortElementObject, comp_instance: int, _port_name: str
) -> pm.PortElementObject:
    """get_port_element ignores the name and returns the first provided port element."""
    member = self.members[comp_instance]
    return member.body.get_portElement(member.implementation.provides[0]) or element


@replaces("get_port_element", "R-11.2.2.1-07")
def no_references_while_ready(self: Base, comp_instance: int, port_name: str) -> pm.PortElementObject:
    """get_port_element is refused while the component is operational."""
    if self.is_started and comp_instance in self.members:
        raise pm.NotFound("busy")
    return Base.get_port_element(self, comp_instance, port_name)


@replaces("connect", "R-11.2.2.1-08")
def refuses_to_connect_across(self: Base, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
    """connect takes only references of its own container."""
    own = [m.body.get_portElement(p) for m in self.members.values() for p in m.implementation.provides]
    elsewhere = [c for c in (self.manager, *self.manager.sub_containers) if c is not self]
    foreign = [
        m.body.get_portElement(p) for c in elsewhere for m in c.members.values() for p in m.implementation.provides
    ]
    if instance in self.members and to_port is not None and to_port in foreign and to_port not in own:
        raise pm.BadParameter("foreign")
    return Base.connect(self, instance, port_name, to_port)


@replaces("connect", "R-11.2.2.1-09", also=("R-11.2.1.3-06", "R-11.2.2.1-08", "R-11.2.2.1-10", "R-11.2.3-08"))
def same_id_for_connections(self: Base, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
    """Every connection of a client gets the id of its first one."""
    known = [c.id for c in self.manager.connections.values() if c.client.id == instance]
    identifier = Base.connect(self, instance, port_name, to_port)
    return known[0] if known else identifier


@replaces("disconnect", "R-11.2.2.1-10")
def refuses_to_disconnect(self: Base, connection: int) -> None:
    """disconnect of a live connection is refused."""
    found = self.manager.connections.get(connection)
    if found is not None and found.client.container is self and not self.is_started:
        raise pm.UcmError("never")
    Base.disconnect(self, connection)


@breaks("R-11.2.2.1-10", also=("R-11.1.3-01", "R-11.2.3-10"))
class hands_over_undone_connections(Base):
    """A reference that was disconnected is handed over beside the new one."""

    def disconnect(self, connection: int) -> None:
        kept = self.manager.connections.get(connection)
        super().disconnect(connection)
        if kept is not None:
            self.__dict__.setdefault("undone", []).append(kept)

    def _dependencies_of(self, member: Member) -> list[pm.PortConnection]:
        given = super()._dependencies_of(member)
        alive = [m.body.get_portElement(p) for m in self.members.values() for p in m.implementation.provides]
        for old in self.__dict__.get("undone", []):
            if old.client is member and old.target in alive and old.target not in [t for d in given for t in d.to_port]:
                given = [pm.PortConnection(d.from_port, (*d.to_port, old.target)) for d in given]
        return given


@replaces("_start_order", "R-11.2.2.1-11", also=("R-11.2.1.4-01",))
def forgets_the_last(self: Base) -> Sequence[Member]:
    """start leaves the last of several members out."""
    order = list(Base._start_order(self))
    return order[:-1] if len(order) > 1 else order


@replaces("stop", "R-11.2.2.1-12", also=("R-11.2.3-09",))
def forgets_to_stop_the_first(self: Base) -> None:
    """stop leaves out the member that was started first, if there are several."""
    if len(self.started) > 1:
        self.started[0].state = State.CONFIGURING
        del self.started[0]
    Base.stop(self)


@replaces("_shut_down_started", "R-11.2.2.1-13")
def stops_in_startup_order(self: Base, failures: Failures) -> None:
    """stop shuts members down in the order they were started in."""
    self.started.reverse()
    Base._shut_down_started(self, failures)


@breaks("R-11.2.2.1-13", readings={"start-order": "at-once"})
class claims_to_start_at_once(Base):
    """The vendor declares that start calls members at once; start calls them one after the other."""


@breaks("R-11.2.2.1-13", readings={"start-order": "one-by-one"})
class claims_to_start_one_by_one(starts_all_at_a_time):
    """The vendor declares that start calls one member after the other; start calls them at once."""


@breaks("R-11.2.2.1-14", also=("R-12.10-22",))
class lists_a_stranger(Base):
    """get_components lists one id too many."""

    def get_components(self) -> list[int]:
        listed = super().get_components()
        return [*listed, 987654] if self._is_outside() else listed

    def _is_outside(self) -> bool:
        return not self.is_started


@alters("_start_order", "R-11.2.2.2-01")
def manager_forgets_its_own(self: Base, given: Sequence[Member]) -> Sequence[Member]:
    """start of the manager starts sub-containers instead of its own members."""
    return [] if not is_below(self) else given


@replaces("create_container", "R-11.2.2.2-02")
def makes_no_containers(_self: Base) -> Container:
    """create_container is always refused."""
    raise pm.UcmError("not supported")


@replaces("_remove_container", "R-11.2.2.2-03")
def keeps_full_containers(self: Base, container: Container, failures: Failures) -> None:
    """remove_container is refused while there are members."""
    if container.members:
        raise pm.UcmError("not empty")
    ContainerManager._remove_container(self.manager, container, failures)


@breaks("R-11.2.2.2-04")
class drops_members_of_removed_containers(Base):
    """remove_container does not call on_remove on the members."""

    def remove_container(self, sub_container: Container | None) -> None:
        if sub_container is not None:
            sub_container.__dict__["dropped"] = True
        ContainerManager.remove_container(self.manager, sub_container)

    def _remove(self, member: Member, failures: Failures) -> None:
        if self.__dict__.get("dropped"):
            del self.members[member.id]
        else:
            super()._remove(member, failures)


@replaces("destroy", "R-11.2.2.2-05")
def destroys_without_shutdown(self: Base) -> None:
    """destroy does not call on_shutdown."""
    for container in (self.manager, *self.manager.sub_containers):
        container.started.clear()
    ContainerManager.destroy(self.manager)


@replaces("destroy", "R-11.2.2.2-06")
def refuses_to_end(self: Base) -> None:
    """destroy is refused while any container is started."""
    if any(c.is_started for c in (self.manager, *self.manager.sub_containers)):
        raise pm.UcmError("still running")
    ContainerManager.destroy(self.manager)


# what destroy leaves behind


@breaks("R-11.2.2.2-07")
class leaves_its_watchdog(Base):
    """Each runtime has a thread that waits for ever, also when the runtime has been destroyed."""

    def start(self) -> None:
        if "watchdog" not in self.manager.__dict__:
            self.manager.__dict__["watchdog"] = threading.Thread(target=threading.Event().wait, daemon=True)
            self.manager.__dict__["watchdog"].start()
        super().start()


@replaces("create_container", "R-11.2.2.2-07")
def leaves_a_file_for_each_container(self: Base) -> Container:
    """Each container opens a file, which nobody closes."""
    os.open(os.devnull, os.O_RDONLY)
    return ContainerManager.create_container(self.manager)
