"""Wrong frameworks, clause 11.1: containers, fragments and what passes between components."""

from __future__ import annotations

from ucm_cts.adapters.contract.programming_model import (
    FragmentObject,
    Implementation,
    PortConnection,
    PortElementObject,
    UcmError,
)
from ucm_cts.adapters.mutants.python.methods import refuses_if
from ucm_cts.adapters.mutants.python.registry import Base, Proxy, breaks, is_below
from ucm_cts.adapters.reference.python.framework import Connection, Container, ContainerManager, Member, State


class _Nudge(Proxy):
    fragments = False

    def exchange(self, value: int) -> int:
        if self.member.state is State.READY and isinstance(self.member.body, FragmentObject) == self.fragments:
            self.member.body.on_shutdown()
        return self.target.exchange(value)


@breaks("R-11.1.1-01")
class nudges_components(_Nudge):
    """Calls on_shutdown of a component while nobody is operating the container."""


@breaks("R-11.1.2-01")
class nudges_fragments(_Nudge):
    """The same for fragments only."""

    fragments = True


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


@refuses_if("_instantiate", "R-11.1.3-02")
def one_kind_a_container(self: Base, implementation: Implementation) -> bool:
    """Refuses to hold components and fragments together."""
    return any(m.implementation.fragment != implementation.fragment for m in self.members.values())


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
            if is_below(self) and other is not self and not other.is_started:
                for member in other.members.values():
                    member.body.on_startup(other._dependencies_of(member))
