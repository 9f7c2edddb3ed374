"""Wrong frameworks that misdirect business calls in few situations only."""

from __future__ import annotations

import time

from ucm_cts.adapters.contract.programming_model import PortConnection, PortElementObject, UcmError
from ucm_cts.adapters.mutants.python.methods import alters, replaces
from ucm_cts.adapters.mutants.python.registry import Base, GivesOutProxies, HandsOverProxies, PeerProxy, Proxy, breaks
from ucm_cts.adapters.reference.python.framework import Container
from ucm_cts.adapters.reference.python.members import Failures, Member


@replaces("exchange", "R-11.1.3-01", "R-11.1.2-02")
def runs_bodies_twice(self: PeerProxy, value: int) -> int:
    """A call between components runs the called body twice."""
    self.target.exchange(value)
    return self.target.exchange(value)


@breaks("R-11.1.3-01", also=("R-11.1.2-02",))
class calls_once(PeerProxy):
    """Only the first call through a connection reaches the other component; later ones get its result again."""

    result: int | None = None

    def exchange(self, value: int) -> int:
        if self.result is None:
            self.result = self.target.exchange(value)
        return self.result


@alters("_dependencies_of", "R-11.1.3-01", also=("R-11.1.2-02",))
def calls_the_first_provider(
    _self: HandsOverProxies, given: list[PortConnection], member: Member
) -> list[PortConnection]:
    """Calls through any required port element reach the provider of the first one."""
    first = given[0].to_port[0] if given else None
    if first is None:
        return given
    return [PortConnection(d.from_port, tuple(Proxy(first, member) for _ in d.to_port)) for d in given]


@replaces("exchange", "R-11.1.3-01", "R-11.1.2-02")
def drops_the_sign(self: PeerProxy, value: int) -> int:
    """A component that is sent a negative payload by another one receives a positive one."""
    return self.target.exchange(abs(value))


@replaces("exchange", "R-11.1.3-01", "R-11.1.2-02")
def loses_the_smallest(self: PeerProxy, value: int) -> int:
    """The smallest payload arrives as the second smallest."""
    return self.target.exchange(max(value, 1 - 2**31))


@breaks("R-11.1.3-01", "R-11.1.2-02")
class calls_the_first_element(Base):
    """Calls between components reach the provider's first port element, whichever is connected."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = super()._dependencies_of(member)
        return [PortConnection(d.from_port, tuple(Proxy(self._first(t), member) for t in d.to_port)) for d in given]

    def _first(self, target: PortElementObject | None) -> PortElementObject:
        containers = (self.manager, *self.manager.sub_containers)
        bodies = [(m.body, m.implementation.provides) for c in containers for m in c.members.values()]
        owners = [b.get_portElement(ports[0]) for b, ports in bodies if target in map(b.get_portElement, ports)]
        element = owners[0] if owners else target
        assert element is not None
        return element


class _Cut(Proxy):
    def exchange(self, value: int) -> int:
        raise UcmError("stopped")


@alters("_dependencies_of", "R-11.2.3-03")
def is_dead_after_restart(_self: Base, given: list[PortConnection], member: Member) -> list[PortConnection]:
    """References handed over by the second on_startup refuse every call."""
    if not member.__dict__.setdefault("started_before", False):
        member.__dict__["started_before"] = True
        return given
    return [PortConnection(d.from_port, tuple(_Cut(t, member) for t in d.to_port if t)) for d in given]


@breaks("R-11.2.2.1-06", also=("R-11.1.3-01", "R-11.1.2-02"))
class any_proxy_will_do(GivesOutProxies):
    """get_port_element ignores the name and returns a proxy of the first provided port element."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        Container.get_port_element(self, comp_instance, port_name)
        member = self.members[comp_instance]
        first = member.body.get_portElement(member.implementation.provides[0])
        assert first is not None
        return Proxy(first, member)


class _Dead(PortElementObject):
    def exchange(self, value: int) -> int:
        raise UcmError("given out before")


@alters("get_port_element", "R-11.2.1.2-07", "R-11.2.3-03")
def gives_references_once(
    self: Base, element: PortElementObject, comp_instance: int, port_name: str
) -> PortElementObject:
    """The second reference that get_port_element returns for a port element refuses every call."""
    given: set[tuple[int, str]] = self.__dict__.setdefault("given", set())
    if (comp_instance, port_name) in given:
        return _Dead()
    given.add((comp_instance, port_name))
    return element


@breaks("R-11.2.2.1-06")
class confuses_twins_after_removals(Base):
    """Once a component was removed, get_port_element gives that of the first instance of the implementation."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(comp_instance, port_name)
        wanted = self.members[comp_instance].implementation
        twin = next(m for m in self.members.values() if m.implementation is wanted)
        return (twin.body.get_portElement(port_name) or element) if self.__dict__.get("removed") else element

    def _remove(self, member: Member, failures: Failures) -> None:
        super()._remove(member, failures)
        self.__dict__["removed"] = True


@breaks("R-11.2.1.2-07", also=("R-11.1.3-01", "R-11.2.3-14"))
class any_twin_will_do(GivesOutProxies):
    """get_port_element gives a proxy of the first instance of the implementation."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = Container.get_port_element(self, comp_instance, port_name)
        wanted = self.members[comp_instance].implementation
        twin = next(m for m in self.members.values() if m.implementation is wanted)
        return Proxy(twin.body.get_portElement(port_name) or element, twin)


class _OpenUnlessAnotherStops(Proxy):
    def exchange(self, value: int) -> int:
        own = self.member.container
        if any(container is not own for container in own.manager.__dict__.get("stopping", ())):
            raise UcmError("a container is being stopped")
        return super().exchange(value)


@breaks("R-11.2.1.2-07")
class serves_no_call_while_another_container_stops(GivesOutProxies):
    """A call of the test is refused while another container than that of the component is being stopped."""

    proxy = _OpenUnlessAnotherStops

    def stop(self) -> None:
        stopping: list[Container] = self.manager.__dict__.setdefault("stopping", [])
        stopping.append(self)
        time.sleep(0.05)
        try:
            super().stop()
        finally:
            stopping.remove(self)
