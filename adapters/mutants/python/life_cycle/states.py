"""Wrong frameworks, clause 11.2.3: the life cycle."""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.mutants.python.methods import alters, refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import Base, HandsOverProxies, breaks
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member, State


@breaks("R-11.2.3-01", "R-11.2.3-02", also=("R-11.2.1.2-10", "R-11.2.2.1-11", "R-11.2.2.2-01"))
class starts_when_connected(Base):
    """A component is started as soon as its last required port element is connected."""

    def connect(self, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
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


class _Unreachable(pm.PortElementObject):
    def exchange(self, value: int) -> int:
        raise pm.UcmError("no")


@alters("_dependencies_of", "R-11.2.3-03")
def refuses_calls_between_components(
    _self: Base, given: list[pm.PortConnection], _member: Member
) -> list[pm.PortConnection]:
    """References handed to components refuse every call."""
    return [pm.PortConnection(d.from_port, (_Unreachable(),)) for d in given]


@breaks("R-11.2.3-05", also=("R-11.2.1.2-01", "R-11.2.1.2-08"))
class initialises_at_start(Base):
    """start calls on_init of components; add_component does not."""

    def _initialise(self, member: Member) -> None:
        if isinstance(member.body, pm.FragmentObject):
            super()._initialise(member)

    def _start_up(self, member: Member, failures: Failures) -> bool:
        if not isinstance(member.body, pm.FragmentObject) and not member.__dict__.get("initialised"):
            member.__dict__["initialised"] = True
            if not failures.attempt(member.body.on_init):
                return False
        return super()._start_up(member, failures)


@refuses_if("_check_startable", "R-11.2.3-06", also=("R-11.2.3-10",))
def does_not_start_loners(self: Base) -> bool:
    """start is refused if the only member requires nothing."""
    return any(not m.implementation.requires for m in self.members.values()) and len(self.members) == 1


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

    def connect(self, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
        spent = self.__dict__.setdefault("spent", set())
        if (instance, port_name) in spent and not self.is_started and to_port is not None:
            raise pm.UcmError("used up")
        return super().connect(instance, port_name, to_port)

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        self.__dict__.setdefault("spent", set()).add((connection.client.id, connection.port))
        super()._disconnect(connection, failures)


@replaces("start", "R-11.2.3-09")
def starts_twice(self: Base) -> None:
    """start of a started container calls on_startup again."""
    ready = [m for m in self.started if self.is_started]
    Base.start(self)
    for member in ready:
        member.body.on_startup(self._dependencies_of(member))


@breaks("R-11.2.3-10")
class starts_once_only(Base):
    """A container that was stopped cannot be started again."""

    def _check_startable(self) -> None:
        super()._check_startable()
        if self.__dict__.get("stopped") and self.members:
            raise pm.UcmError("once only")

    def stop(self) -> None:
        self.__dict__["stopped"] = self.is_started and bool(self.members)
        super().stop()


@replaces("_dependencies_of", "R-11.2.3-10")
def forgets_connections_at_stop(self: Base, member: Member) -> list[pm.PortConnection]:
    """At a second start the references are missing."""
    before = member.__dict__.setdefault("before", 0)
    member.__dict__["before"] = before + 1
    return Base._dependencies_of(self, member) if not before else []


@replaces("_check_removable", "R-11.2.3-11")
def ready_is_not_found(self: Base, member: Member) -> None:
    """remove_component of an operational component raises NOT_FOUND."""
    if member.state is State.READY:
        raise pm.NotFound("busy")
    Base._check_removable(self, member)


@breaks("R-11.2.1.2-10")
class removes_without_shutdown(Base):
    """remove_component of an operational component does not call on_shutdown."""

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


@replaces("remove_component", "R-11.2.3-12")
def disconnects_after_removal(self: Base, comp_instance: int) -> None:
    """remove_component calls on_remove first and on_disconnect later."""
    member = self.members.get(comp_instance)
    own = self._connections_from(member) if member is not None and not self.is_started else []
    if member is None or not own or self._connections_to(member):
        Base.remove_component(self, comp_instance)
        return
    failures = Failures()
    self._remove(member, failures)
    for connection in own:
        self._disconnect(connection, failures)
    failures.report()


@replaces("connect", "R-11.2.3-13")
def late_add_is_not_found(self: Base, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
    """add_component to a started container returns an id; connect of that component raises NOT_FOUND."""
    member = self.members.get(instance) if self.is_started and to_port is not None else None
    if member is not None and port_name in member.implementation.requires:
        raise pm.NotFound("too late")
    return Base.connect(self, instance, port_name, to_port)


@breaks("R-11.2.3-14")
class hands_out_removed_providers(Base):
    """The client of a removed provider stays connected to it."""

    def _check_removable(self, member: Member) -> None:
        if member.state is State.READY:
            raise pm.UcmError("ready")

    def _remove(self, member: Member, failures: Failures) -> None:
        super()._remove(member, failures)


@breaks("R-11.2.3-14")
class hands_out_proxies_of_removed_providers(HandsOverProxies, hands_out_removed_providers):
    """The client of a removed provider is given a proxy of it, which does not show that."""


@replaces("start", "R-11.2.3-15")
def second_start_restarts(self: Base) -> None:
    """start of a started container shuts its members down and starts them again."""
    if self.is_started:
        self.stop()
    Base.start(self)


@breaks("R-11.2.3-17")
class runs_stopped_components(Base):
    """After stop the framework calls a component once more."""

    def get_components(self) -> list[int]:
        if not self.is_started:
            for member in self.__dict__.pop("ran", []):  # the called component may call get_components
                for port in member.implementation.provides:
                    element = member.body.get_portElement(port)
                    if element is not None:
                        element.exchange(12345)
        return super().get_components()

    def stop(self) -> None:
        self.__dict__["ran"] = [m for m in self.started if m.id in self.members and self.is_started]
        super().stop()


@breaks("R-11.2.3-07", readings={"start-unconfigured": "refuse"})
class checks_only_the_first_start(Base):
    """Once a container was started, start does not ask any more whether all components are configured."""

    def start(self) -> None:
        super().start()
        self.__dict__["was_started"] = True

    def _check_startable(self) -> None:
        if not self.__dict__.get("was_started"):
            super()._check_startable()
