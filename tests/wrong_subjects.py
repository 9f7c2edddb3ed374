"""Frameworks with one defect each, derived from the Python reference framework; each docstring says how it lies.

``@breaks(requirement, ...)`` names what the suite must find: every named requirement fails, and no other, except those
in ``also``: requirements that are truly broken by the same defect.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ucm_cts.adapters.contract.programming_model import (
    BadParameter,
    ComponentObject,
    Connectable,
    FragmentObject,
    Implementation,
    NotFound,
    PortConnection,
    PortElementObject,
    UcmError,
)
from ucm_cts.adapters.reference_py.adapter import ReferenceAdapter
from ucm_cts.adapters.reference_py.framework import Connection, Container, ContainerManager, Failures, Member, State


@dataclass(frozen=True)
class WrongSubject:
    """A defective framework's adapter and the requirements it must fail."""

    name: str
    adapter: type[ReferenceAdapter]
    requirements: tuple[str, ...]
    also: tuple[str, ...]


SUBJECTS: dict[str, WrongSubject] = {}


def bind(name: str, mixin: type, doc: str | None = None) -> type[ReferenceAdapter]:
    """An adapter for the reference framework with ``mixin`` in front of both container classes."""
    container = type(name, (mixin, Container), {})
    manager = type(f"{name}_manager", (mixin, ContainerManager), {"container_class": container})
    return type(f"{name}_adapter", (ReferenceAdapter,), {"manager_class": manager, "product": name, "__doc__": doc})


def breaks(*requirements: str, also: tuple[str, ...] = ()) -> Callable[[type], type]:
    """Register the decorated mixin as a wrong subject."""

    def register(mixin: type) -> type:
        adapter = bind(mixin.__name__, mixin, mixin.__doc__)
        SUBJECTS[mixin.__name__] = WrongSubject(mixin.__name__, adapter, requirements, also)
        return mixin

    return register


class Base(Container):
    """Typing only: what a mixin can rely on."""


# clause 11.1


class Proxy(PortElementObject):
    """What a framework could give out instead of a body's own object."""

    def __init__(self, target: PortElementObject, member: Member) -> None:
        self.target, self.member = target, member


class GivesOutProxies(Base):
    """get_port_element gives out proxies to the test; components are connected to the bodies' own objects."""

    proxy: type[Proxy]

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(comp_instance, port_name)
        return self.proxy(element, self.members[comp_instance])

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        return super().connect(instance, port_name, to_port.target if isinstance(to_port, Proxy) else to_port)


class _Nudge(Proxy):
    fragments = False

    def exchange(self, value: int) -> int:
        if self.member.state is State.READY and isinstance(self.member.body, FragmentObject) == self.fragments:
            self.member.body.on_shutdown()
        return self.target.exchange(value)


class _NudgeFragments(_Nudge):
    fragments = True


@breaks("R-11.1.1-01")
class nudges_components(GivesOutProxies):
    """Calls on_shutdown of a component while nobody is operating the container."""

    proxy = _Nudge


@breaks("R-11.1.2-01")
class nudges_fragments(GivesOutProxies):
    """The same for fragments only."""

    proxy = _NudgeFragments


class _Changed(PortElementObject):
    def __init__(self, target: PortElementObject) -> None:
        self.target = target

    def exchange(self, value: int) -> int:
        return self.target.exchange(value) ^ 1


@breaks("R-11.1.3-01")
class spoils_results_between_components(Base):
    """Flips a bit of what one component's call of another one gives back."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        return [
            PortConnection(c.port, (c.target if _of_fragment(self, c) else _Changed(c.target),))
            for c in self._connections_from(member)
        ]


@breaks("R-11.1.2-02")
class spoils_results_of_fragments(Base):
    """The same where a fragment is called."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        return [
            PortConnection(c.port, (_Changed(c.target) if _of_fragment(self, c) else c.target,))
            for c in self._connections_from(member)
        ]


def _of_fragment(container: Container, connection: Connection) -> bool:
    everywhere = [container.manager, *container.manager.sub_containers]
    owners = [m for c in everywhere for m in c.members.values() if connection in c._connections_to(m)]
    return any(isinstance(m.body, FragmentObject) for m in owners)


@breaks("R-11.1.3-02")
class one_kind_a_container(Base):
    """Refuses to hold components and fragments together."""

    def _instantiate(self, implementation: Implementation) -> ComponentObject:
        if any(m.implementation.fragment != implementation.fragment for m in self.members.values()):
            raise UcmError("one kind only")
        return super()._instantiate(implementation)


@breaks("R-11.1.3-03")
class one_sub_container(Base):
    """Refuses a second container."""

    def create_container(self) -> Container:
        if self.manager.sub_containers:
            raise UcmError("one is enough")
        return ContainerManager.create_container(self.manager)


@breaks("R-11.1.3-04")
class starts_the_neighbours(Base):
    """Starting one sub-container starts the members of all other sub-containers, too."""

    def start(self) -> None:
        super().start()
        for other in self.manager.sub_containers:
            if self is not self.manager and other is not self and not other.is_started:
                for member in other.members.values():
                    member.body.on_startup(other._dependencies_of(member))


# clause 11.2.1


@breaks("R-11.2.1.1-01")
class fragments_cannot_be_connected(Base):
    """connect does not take the port element of a fragment."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        everywhere = [self.manager, *self.manager.sub_containers]
        fragments = [m for c in everywhere for m in c.members.values() if isinstance(m.body, FragmentObject)]
        if any(m.body.get_portElement(p) is to_port for m in fragments for p in m.implementation.provides):
            raise BadParameter("not a component's")
        return super().connect(instance, port_name, to_port)


class _ChangedValue(Proxy):
    def exchange(self, value: int) -> int:
        return self.target.exchange(value ^ 1)


@breaks("R-11.2.1.1-02")
class changes_what_is_sent(GivesOutProxies):
    """References hand the body another value than the one sent."""

    proxy = _ChangedValue


@breaks("R-11.2.1.2-01")
class starts_what_was_removed(Base):
    """A removed component stays in the list of those to start."""

    def _remove(self, member: Member, failures: Failures) -> None:
        super()._remove(member, failures)
        self.__dict__.setdefault("ghosts", []).append(member)

    def start(self) -> None:
        super().start()
        for ghost in self.__dict__.get("ghosts", []):
            Failures().attempt(ghost.body.on_startup, [])


@breaks("R-11.2.1.2-03", also=("R-11.1.3-01", "R-11.1.2-02"))
class mixes_references_up(Base):
    """Hands over the references of two port elements in reverse."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = super()._dependencies_of(member)
        targets = [d.to_port for d in reversed(given)]
        return [PortConnection(d.from_port, t) for d, t in zip(given, targets, strict=True)]


@breaks("R-11.2.1.2-04")
class initialises_at_stop(Base):
    """Calls on_init again when a component is shut down."""

    def _shut_down(self, member: Member, failures: Failures) -> None:
        super()._shut_down(member, failures)
        failures.attempt(member.body.on_init)


@breaks("R-11.2.1.2-05")
class attributes_after_init(Base):
    """Sets attributes when on_init has run."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        super()._configure(member, {})
        self._set_attributes(member, attributes)


@breaks("R-11.2.1.2-06")
class removes_silently(Base):
    """remove_component forgets on_remove."""

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


class _Deaf(Proxy):
    def exchange(self, value: int) -> int:
        raise UcmError("not operational")


@breaks("R-11.2.1.2-07")
class never_serves(GivesOutProxies):
    """References refuse every call, also of operational components."""

    proxy = _Deaf


@breaks("R-11.2.1.2-08")
class connects_while_starting(Base):
    """Repeats on_connect during start, when other members are started already."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        for connection in self._connections_from(member):
            if isinstance(member.body, Connectable):
                member.body.on_connect(connection.port, connection.target)
        return super()._start_up(member, failures)


@breaks("R-11.2.1.2-09", also=("R-11.2.3-10",))
class names_dependencies_differently(Base):
    """on_startup uses a spelling of its own for port element names."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        return [PortConnection(d.from_port.upper(), d.to_port) for d in super()._dependencies_of(member)]


@breaks("R-11.2.1.2-10")
class shuts_down_at_every_stop(Base):
    """stop calls on_shutdown on members that were never started."""

    def stop(self) -> None:
        idle = [] if self.is_started else list(self.members.values())
        super().stop()
        for member in idle:
            Failures().attempt(member.body.on_shutdown)


@breaks("R-11.2.1.3-01", also=("R-11.2.2.1-08",))
class demands_connectable(Base):
    """connect refuses bodies that are not Connectable."""

    def _connect(self, connection: Connection) -> None:
        if not isinstance(connection.client.body, Connectable):
            raise UcmError("not Connectable")
        super()._connect(connection)


@breaks("R-11.2.1.3-02")
class connects_silently(Base):
    """connect forgets on_connect."""

    def _connect(self, connection: Connection) -> None:
        self.manager.connections[connection.id] = connection


@breaks("R-11.2.1.3-03")
class announces_refused_connections(Base):
    """A connect that is refused because the container is started still calls on_connect."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        member = self.members.get(instance)
        known = member is not None and port_name in member.implementation.requires and to_port is not None
        if known and member is not None and self.is_started and isinstance(member.body, Connectable):
            member.body.on_connect(port_name, to_port)
        return super().connect(instance, port_name, to_port)


@breaks("R-11.2.1.3-04")
class on_connect_without_reference(Base):
    """on_connect gets a null reference."""

    def _connect(self, connection: Connection) -> None:
        if isinstance(connection.client.body, Connectable):
            failures = Failures()
            failures.attempt(connection.client.body.on_connect, connection.port, None)
            failures.report()
        self.manager.connections[connection.id] = connection


@breaks("R-11.2.1.3-05")
class disconnects_silently(Base):
    """on_disconnect is never called."""

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        del self.manager.connections[connection.id]


@breaks("R-11.2.1.3-06")
class misnames_disconnected_ports(Base):
    """on_disconnect is given the connection's number instead of the port element's name."""

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        del self.manager.connections[connection.id]
        if isinstance(connection.client.body, Connectable):
            failures.attempt(connection.client.body.on_disconnect, str(connection.id))


@breaks("R-11.2.1.4-01", also=("R-11.2.1.2-01",))
class leaves_fragments_uninitialised(Base):
    """Fragments do not get on_init."""

    def _initialise(self, member: Member) -> None:
        if not isinstance(member.body, FragmentObject):
            super()._initialise(member)


@breaks("R-11.2.1.4-02", also=("R-11.2.1.4-03",))
class hides_the_container(Base):
    """Fragments are never given their container."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        self._set_attributes(member, attributes)
        self._initialise(member)


@breaks("R-11.2.1.4-03")
class shows_fragments_nothing(Base):
    """The container interface that fragments get lists no members."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        self._set_attributes(member, attributes)
        if isinstance(member.body, FragmentObject):
            member.body.set_container_interface(_Blind())
        self._initialise(member)


class _Blind:
    def get_components(self) -> list[int]:
        return []


# clause 11.2.2


@breaks("R-11.2.2.1-01", also=("R-11.1.3-02",))
class adds_two_member_only(Base):
    """Refuses a third member."""

    def _instantiate(self, implementation: Implementation) -> ComponentObject:
        if len(self.members) >= 2:
            raise UcmError("full")
        return super()._instantiate(implementation)


@breaks("R-11.2.2.1-02", also=("R-11.2.1.2-05",))
class makes_two_bodies(Base):
    """add_component initialises two bodies and keeps one."""

    def _initialise(self, member: Member) -> None:
        super()._initialise(member)
        member.implementation.create().on_init()


@breaks("R-11.2.2.1-03", also=("R-11.2.2.1-06",))
class same_id_for_all(Base):
    """A second instance of an implementation is given the id of the first."""

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        twins = [m.id for m in self.members.values() if m.implementation.name == implementation]
        identifier = super().add_component(implementation, attributes)
        return twins[0] if twins else identifier


@breaks("R-11.2.2.1-05")
class cannot_remove(Base):
    """Refuses to remove what is neither connected nor operational."""

    def _check_removable(self, member: Member) -> None:
        raise UcmError("never")


@breaks("R-11.2.2.1-06")
class any_port_element_will_do(Base):
    """get_port_element gives the first provided port element whatever the name."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(comp_instance, port_name)
        member = self.members[comp_instance]
        return member.body.get_portElement(member.implementation.provides[0]) or element


@breaks("R-11.2.2.1-07")
class no_references_while_ready(Base):
    """get_port_element is refused while the component is operational."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        if self.is_started and comp_instance in self.members:
            raise NotFound("busy")
        return super().get_port_element(comp_instance, port_name)


@breaks("R-11.2.2.1-08")
class refuses_to_connect_across(Base):
    """connect takes only references of its own container."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        own = [m.body.get_portElement(p) for m in self.members.values() for p in m.implementation.provides]
        elsewhere = [c for c in (self.manager, *self.manager.sub_containers) if c is not self]
        foreign = [
            m.body.get_portElement(p) for c in elsewhere for m in c.members.values() for p in m.implementation.provides
        ]
        if to_port is not None and to_port in foreign and to_port not in own:
            raise BadParameter("foreign")
        return super().connect(instance, port_name, to_port)


@breaks("R-11.2.2.1-09", also=("R-11.2.1.3-06",))
class same_id_for_connections(Base):
    """Every connection of a client gets the id of its first one."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        known = [c.id for c in self.manager.connections.values() if c.client.id == instance]
        identifier = super().connect(instance, port_name, to_port)
        return known[0] if known else identifier


@breaks("R-11.2.2.1-10")
class refuses_to_disconnect(Base):
    """disconnect of a live connection is refused."""

    def disconnect(self, connection: int) -> None:
        found = self.manager.connections.get(connection)
        if found is not None and found.client.container is self and not self.is_started:
            raise UcmError("never")
        super().disconnect(connection)


@breaks("R-11.2.2.1-10")
class hands_over_undone_connections(Base):
    """A reference that was disconnected is handed over beside the new one."""

    def disconnect(self, connection: int) -> None:
        kept = self.manager.connections.get(connection)
        super().disconnect(connection)
        if kept is not None:
            self.__dict__.setdefault("undone", []).append(kept)

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = super()._dependencies_of(member)
        alive = [m.body.get_portElement(p) for m in self.members.values() for p in m.implementation.provides]
        for old in self.__dict__.get("undone", []):
            if old.client is member and old.target in alive and old.target not in [t for d in given for t in d.to_port]:
                given = [PortConnection(d.from_port, (*d.to_port, old.target)) for d in given]
        return given


@breaks("R-11.2.2.1-11", also=("R-11.2.1.4-01",))
class forgets_the_last(Base):
    """start leaves the last of several members out."""

    def _start_order(self) -> Sequence[Member]:
        order = list(super()._start_order())
        return order[:-1] if len(order) > 1 else order


@breaks("R-11.2.2.1-12", also=("R-11.2.3-09",))
class forgets_to_stop_the_first(Base):
    """stop leaves out the member that was started first, if there are several."""

    def stop(self) -> None:
        if len(self.started) > 1:
            self.started[0].state = State.CONFIGURING
            del self.started[0]
        super().stop()


@breaks("R-11.2.2.1-13")
class stops_in_startup_order(Base):
    """stop shuts members down in the order they were started in."""

    def _shut_down_started(self, failures: Failures) -> None:
        self.started.reverse()
        super()._shut_down_started(failures)


@breaks("R-11.2.2.1-14", also=("R-12.10-22",))
class lists_a_stranger(Base):
    """get_components lists one id too many."""

    def get_components(self) -> list[int]:
        listed = super().get_components()
        return [*listed, 987654] if self._is_outside() else listed

    def _is_outside(self) -> bool:
        return not self.is_started


@breaks("R-11.2.2.2-01")
class manager_forgets_its_own(Base):
    """start of the manager starts sub-containers instead of its own members."""

    def _start_order(self) -> Sequence[Member]:
        return [] if self.manager is self else super()._start_order()


@breaks("R-11.2.2.2-02")
class makes_no_containers(Base):
    """create_container is always refused."""

    def create_container(self) -> Container:
        raise UcmError("not supported")


@breaks("R-11.2.2.2-03")
class keeps_full_containers(Base):
    """remove_container is refused while there are members."""

    def _remove_container(self, container: Container, failures: Failures) -> None:
        if container.members:
            raise UcmError("not empty")
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


@breaks("R-11.2.2.2-05")
class destroys_without_shutdown(Base):
    """destroy forgets on_shutdown."""

    def destroy(self) -> None:
        for container in (self.manager, *self.manager.sub_containers):
            container.started.clear()
        ContainerManager.destroy(self.manager)


@breaks("R-11.2.2.2-06")
class refuses_to_end(Base):
    """destroy is refused while any container is started."""

    def destroy(self) -> None:
        if any(c.is_started for c in (self.manager, *self.manager.sub_containers)):
            raise UcmError("still running")
        ContainerManager.destroy(self.manager)


# clause 11.2.3


@breaks("R-11.2.3-01", "R-11.2.3-02", also=("R-11.2.1.2-10", "R-11.2.2.1-11", "R-11.2.2.2-01"))
class starts_when_connected(Base):
    """A component is started as soon as its last required port element is connected."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        identifier = super().connect(instance, port_name, to_port)
        member = self.members[instance]
        if all(self._is_connected(member, p) for p in member.implementation.requires):
            member.body.on_startup(self._dependencies_of(member))
            member.__dict__["early"] = True
        return identifier

    def _start_up(self, member: Member, failures: Failures) -> bool:
        if not member.__dict__.pop("early", False):
            return super()._start_up(member, failures)
        member.state = State.READY
        self.started.append(member)
        return True


class _Unreachable(PortElementObject):
    def exchange(self, value: int) -> int:
        raise UcmError("no")


@breaks("R-11.2.3-03")
class refuses_calls_between_components(Base):
    """References handed to components refuse every call."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        return [PortConnection(d.from_port, (_Unreachable(),)) for d in super()._dependencies_of(member)]


@breaks("R-11.2.3-05", also=("R-11.2.1.2-01", "R-11.2.1.2-08"))
class initialises_at_start(Base):
    """on_init of components comes with start instead of add_component."""

    def _initialise(self, member: Member) -> None:
        if isinstance(member.body, FragmentObject):
            super()._initialise(member)

    def _start_up(self, member: Member, failures: Failures) -> bool:
        if not isinstance(member.body, FragmentObject) and not member.__dict__.get("initialised"):
            member.__dict__["initialised"] = True
            if not failures.attempt(member.body.on_init):
                return False
        return super()._start_up(member, failures)


@breaks("R-11.2.3-06", also=("R-11.2.3-10",))
class does_not_start_loners(Base):
    """start is refused while a component requires nothing."""

    def _check_startable(self) -> None:
        if any(not m.implementation.requires for m in self.members.values()) and len(self.members) == 1:
            raise UcmError("a component without connections")
        super()._check_startable()


@breaks("R-11.2.3-07")
class starts_a_part(Base):
    """start leaves unconfigured members out and reports success."""

    def _check_startable(self) -> None:
        pass

    def _start_order(self) -> Sequence[Member]:
        return [m for m in super()._start_order() if all(self._is_connected(m, p) for p in m.implementation.requires)]


@breaks("R-11.2.3-08", also=("R-11.2.2.1-08",))
class connects_only_once(Base):
    """A port element that was disconnected cannot be connected again."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        spent = self.__dict__.setdefault("spent", set())
        if (instance, port_name) in spent and not self.is_started and to_port is not None:
            raise UcmError("used up")
        return super().connect(instance, port_name, to_port)

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        self.__dict__.setdefault("spent", set()).add((connection.client.id, connection.port))
        super()._disconnect(connection, failures)


@breaks("R-11.2.3-09")
class starts_twice(Base):
    """start of a started container calls on_startup again."""

    def start(self) -> None:
        ready = [m for m in self.started if self.is_started]
        super().start()
        for member in ready:
            member.body.on_startup(self._dependencies_of(member))


@breaks("R-11.2.3-10")
class starts_once_only(Base):
    """A container that was stopped cannot be started again."""

    def _check_startable(self) -> None:
        super()._check_startable()
        if self.__dict__.get("stopped") and self.members:
            raise UcmError("once only")

    def stop(self) -> None:
        self.__dict__["stopped"] = self.is_started and bool(self.members)
        super().stop()


@breaks("R-11.2.3-10")
class forgets_connections_at_stop(Base):
    """At a second start the references are missing."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        before = member.__dict__.setdefault("before", 0)
        member.__dict__["before"] = before + 1
        return super()._dependencies_of(member) if not before else []


@breaks("R-11.2.3-11")
class ready_is_not_found(Base):
    """remove_component of an operational component raises NOT_FOUND."""

    def _check_removable(self, member: Member) -> None:
        if member.state is State.READY:
            raise NotFound("busy")
        super()._check_removable(member)


@breaks("R-11.2.3-12")
class removes_without_shutdown(Base):
    """remove_component of an operational component forgets on_shutdown."""

    def _check_removable(self, member: Member) -> None:
        if member.state is not State.READY:
            super()._check_removable(member)

    def _remove(self, member: Member, failures: Failures) -> None:
        if member in self.started:
            self.started.remove(member)
        for connection in self._connections_to(member):
            if connection.client is not member:
                self._disconnect(connection, failures)
        super()._remove(member, failures)


@breaks("R-11.2.3-12")
class disconnects_after_removal(Base):
    """remove_component calls on_remove first and on_disconnect later."""

    def remove_component(self, comp_instance: int) -> None:
        member = self.members.get(comp_instance)
        own = self._connections_from(member) if member is not None and not self.is_started else []
        if member is None or not own or self._connections_to(member):
            super().remove_component(comp_instance)
            return
        failures = Failures()
        self._remove(member, failures)
        for connection in own:
            self._disconnect(connection, failures)
        failures.report()


@breaks("R-11.2.3-13")
class late_add_is_not_found(Base):
    """add_component to a started container is answered by an id, and by nothing else."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        member = self.members.get(instance) if self.is_started and to_port is not None else None
        if member is not None and port_name in member.implementation.requires:
            raise NotFound("too late")
        return super().connect(instance, port_name, to_port)


@breaks("R-11.2.3-14")
class hands_out_removed_providers(Base):
    """A removed provider stays connected to its client."""

    def _check_removable(self, member: Member) -> None:
        if member.state is State.READY:
            raise UcmError("ready")

    def _remove(self, member: Member, failures: Failures) -> None:
        super()._remove(member, failures)


@breaks("R-11.2.3-15")
class second_start_restarts(Base):
    """start of a started container shuts its members down and starts them again."""

    def start(self) -> None:
        if self.is_started:
            self.stop()
        super().start()


@breaks("R-11.2.3-17")
class runs_stopped_components(Base):
    """After stop the framework still runs a component that served before."""

    def get_components(self) -> list[int]:
        if not self.is_started:
            for member in self.__dict__.get("ran", []):
                for port in member.implementation.provides:
                    element = member.body.get_portElement(port)
                    if element is not None:
                        element.exchange(12345)
        return super().get_components()

    def stop(self) -> None:
        self.__dict__["ran"] = [m for m in self.started if m.id in self.members and self.is_started]
        super().stop()


# clause 12.10


@breaks("R-12.10-02")
class wide_component_ids(Base):
    """Component ids exceed 32 bits."""

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        identifier = super().add_component(implementation, attributes)
        self.members[identifier + 2**40] = self.members.pop(identifier)
        self.members[identifier + 2**40].id = identifier + 2**40
        return identifier + 2**40


@breaks("R-12.10-03")
class wide_connection_ids(Base):
    """Connection ids exceed 32 bits."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        identifier = super().connect(instance, port_name, to_port)
        connection = self.manager.connections.pop(identifier)
        wide = Connection(identifier + 2**40, connection.client, connection.port, connection.target)
        self.manager.connections[wide.id] = wide
        return wide.id


def _undeclared(operation: str) -> type:
    """A mixin whose ``operation`` turns UCM_ERROR, NOT_FOUND and BAD_PARAMETER into something undeclared."""

    def call(self: Any, *arguments: Any) -> Any:
        try:
            return getattr(super(mixin, self), operation)(*arguments)
        except (UcmError, NotFound, BadParameter) as error:
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


@breaks("R-12.10-15")
class unknown_components_are_errors(Base):
    """Unknown component ids are answered with UCM_ERROR."""

    def _find_member(self, number: int) -> Member:
        if number not in self.members:
            raise UcmError("which?")
        return super()._find_member(number)


@breaks("R-12.10-16")
class unknown_connections_are_ignored(Base):
    """disconnect of an unknown connection returns."""

    def disconnect(self, connection: int) -> None:
        if connection in self.manager.connections:
            super().disconnect(connection)


@breaks("R-12.10-17")
class unknown_containers_are_ignored(Base):
    """remove_container of a removed container returns."""

    def remove_container(self, sub_container: Container | None) -> None:
        if sub_container in self.manager.sub_containers:
            ContainerManager.remove_container(self.manager, sub_container)


@breaks("R-12.10-18")
class connects_any_name(Base):
    """connect to a port element that does not exist returns an id."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        known = instance in self.members and not self.is_started
        if known and to_port is not None and port_name not in self.members[instance].implementation.requires:
            return self._new_id()
        return super().connect(instance, port_name, to_port)


@breaks("R-12.10-19")
class connects_to_nothing(Base):
    """connect to a null reference returns an id."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        known = instance in self.members and port_name in self.members[instance].implementation.requires
        if to_port is None and known and not self.is_started:
            return self._new_id()
        return super().connect(instance, port_name, to_port)


@breaks("R-12.10-20")
class any_name_gives_nothing(Base):
    """get_port_element of an unknown name returns a null reference."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        if comp_instance in self.members and port_name not in self.members[comp_instance].implementation.provides:
            return None  # type: ignore[return-value]
        return super().get_port_element(comp_instance, port_name)


@breaks("R-12.10-21")
class adds_nothing(Base):
    """add_component of an unknown implementation returns an id."""

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        if implementation not in self.manager.implementations and not self.is_started:
            return self._new_id()
        return super().add_component(implementation, attributes)


@breaks("R-12.10-22", also=("R-11.2.3-06",))
class keeps_failed_components(Base):
    """A component whose on_init raised is listed although add_component was refused."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        self.members[member.id] = member
        super()._configure(member, attributes)


@breaks("R-12.10-23")
class failing_removal_is_not_found(Base):
    """remove_component raises NOT_FOUND when on_remove raised."""

    def remove_component(self, comp_instance: int) -> None:
        known = comp_instance in self.members
        try:
            super().remove_component(comp_instance)
        except UcmError as error:
            if known and comp_instance not in self.members:
                raise NotFound("gone") from error
            raise


@breaks("R-12.10-24")
class second_connection_is_not_found(Base):
    """A second connection of a port element is answered with NOT_FOUND."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        member = self.members.get(instance)
        if member is not None and not self.is_started and to_port is not None and self._is_connected(member, port_name):
            raise NotFound("taken")
        return super().connect(instance, port_name, to_port)


@breaks("R-12.10-25", also=("R-11.2.3-10",))
class hands_references_over_twice(Base):
    """on_startup gets each reference twice."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        return [PortConnection(d.from_port, (*d.to_port, *d.to_port)) for d in super()._dependencies_of(member)]


@breaks("R-12.10-26", also=("R-11.2.1.4-03",))
class no_list_while_ready(Base):
    """get_components is refused while the container is started."""

    def get_components(self) -> list[int]:
        if self.is_started:
            raise UcmError("busy")
        return super().get_components()
