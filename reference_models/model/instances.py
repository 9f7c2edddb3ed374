"""Component instances, their connections and containers, as far as a trace has shown them."""

from __future__ import annotations

from collections.abc import Container as Container_
from collections.abc import Sequence

import msgspec

from ucm_cts.adapters.contract.scenario import AddComponent, Declaration, Hook, RaiseError
from ucm_cts.adapters.contract.trace import MaybeReference
from ucm_cts.reference_models.model.changing import Changing
from ucm_cts.reference_models.model.life_cycle import State

NO_ID = 2**64
"""The id of a connection whose id is not known."""

MOST_CONNECTIONS = 4
"""So many connections of an instance are remembered one by one."""


class Connection(Changing):
    """A connection of ``port`` to ``provider``'s port element ``provided``.

    ``live`` is None where the text leaves open whether it still stands.
    ``takers``: with a connector: the instances attached at its other side, live or removed.

    ``stale`` connections were made to a reference whose instance had been removed before; ``ambiguous`` ones share their
    id with another live one.
    """

    name: str
    id: int
    client: Member
    port: str
    reference: MaybeReference
    provider: Member | None
    provided: str = ""
    live: bool | None = True
    stale: bool = False
    ambiguous: bool = False
    takers: tuple[Member, ...] = ()

    def leads_to(self, members: Container_[int]) -> bool:
        """Is one of ``members``, given by ``id()``, behind it?"""
        return (self.provider is not None and id(self.provider) in members) or any(
            id(taker) in members for taker in self.takers
        )


_LIFE: tuple[Hook, ...] = (
    "on_init",
    "set_container_interface",
    "on_connect",
    "on_disconnect",
    "on_startup",
    "on_shutdown",
    "on_remove",
)


class Member(Changing):
    """A component instance as far as the trace has shown it.

    ``suspended``: its state is not known, so properties are silent about it.
    ``doubtful``: it is not even known whether it is a member.
    ``leaving``: a removal of it failed half-way.
    ``lingering``: its on_shutdown raised, and with it the operation, so that it may still be operational.
    ``handed_over``: the connections that its last on_startup gave it; None while that is not known.
    ``closing``: on_shutdown has come since.
    ``raising``: where its plan makes it raise; None until it is needed.
    ``late``: it was added when its container was, or may have been, started.
    ``phase``: on_startup or on_shutdown, whichever came last; empty before both.
    ``told_of_removal``: on_remove has come.
    ``body``: its component, and the number of its instance; 0 if that is not known.
    ``place``: its place in the order in which all instances were added.
    ``not_undone``, ``not_shut_down``: what a removal of its container that failed has left out: on_disconnect of these
    ports, and on_shutdown.
    """

    name: str
    component: str
    declaration: Declaration
    container: Container
    id: int
    instance: int | None
    operational: bool = False
    suspended: bool = False
    doubtful: bool = False
    leaving: bool = False
    lingering: bool = False
    gone: bool = False
    startups: int = 0
    served: bool = False
    connections: list[Connection] = []
    once_connected: set[str] = set()
    handed_over: tuple[Connection, ...] | None = ()
    closing: bool = False
    raising: frozenset[Hook] | None = None
    late: bool = False
    phase: str = ""
    told_of_removal: bool = False
    not_undone: tuple[str, ...] = ()
    not_shut_down: bool = False
    body: tuple[str, int] = ("", 0)
    place: int = 0

    def __post_init__(self) -> None:
        self.body = self.component, self.instance or 0

    def raises(self, *hooks: Hook) -> bool:
        """Does the plan make this body raise at one of ``hooks``?"""
        if self.raising is None:
            self.raising = raising(self.declaration)
        return bool(self.raising) and not self.raising.isdisjoint(hooks)

    def forget_repetitions(self) -> list[Connection]:
        """Of many connections that are undone, forget those that were like another one: there may be any number of them. Returns these."""
        forgotten: list[Connection] = []
        if len(self.connections) <= MOST_CONNECTIONS:
            return forgotten
        kept: list[Connection] = []
        seen: set[tuple[str, MaybeReference, int, str]] = set()
        for connection in self.connections:
            like = connection.port, connection.reference, id(connection.provider), connection.provided
            is_over = connection.live is False and not connection.ambiguous and not connection.stale
            if is_over and like in seen and connection not in (self.handed_over or ()):
                forgotten.append(connection)
                continue
            if is_over:
                seen.add(like)
            kept.append(connection)
        self.connections = kept
        return forgotten

    def serve(self) -> None:
        """Its business method is called while it is operational."""
        self.served = True
        self.container.served[self] = None

    def mark_doubtful(self) -> None:
        """It is open whether it still is a member."""
        self.doubtful = self.container.of_doubt = True

    @property
    def is_sound(self) -> bool:
        """Is it known, and raises its body nowhere in its life?"""
        return self.instance is not None and not self.raises(*_LIFE)

    def live_connections(self, port: str | None = None) -> list[Connection]:
        """Its own connections that certainly stand, of ``port`` or of all required port elements."""
        if not self.connections:
            return []
        return [c for c in self.connections if c.live and (port is None or c.port == port)]

    @property
    def serving(self) -> bool:
        """Is it certain that it is operational at this moment, during any operation in progress?"""
        return self.operational and not self.closing and not self.suspended

    @property
    def lane(self) -> str:
        """The instance's name in findings and diagrams."""
        return lane(self.component, self.instance or 1)

    @property
    def state(self) -> State:
        """Where it stands in the life cycle of 11.2.3."""
        if self.gone:
            return "absent"
        if self.operational:
            return "ready"
        return "configured" if self.connected else "initialized"

    @property
    def connected(self) -> bool:
        """Is every required port element certainly connected?"""
        required = self.declaration.requires
        if not required:
            return True
        if not self.connections:
            return False
        live = [c.port for c in self.connections if c.live]
        return all(map(live.__contains__, required))


class Membership(Changing):
    """The members of one container that have not been removed, in the order in which they were added. It follows from what the members
    themselves say; a container keeps it up.

    ``fragments``: how many of them are fragments.
    """

    members: dict[Member, None] = {}
    fragments: int = 0
    _by_id: dict[int, list[Member]] = {}

    def add(self, member: Member) -> None:
        """An instance has been added."""
        self.members[member] = None
        self._by_id.setdefault(member.id, []).append(member)
        self.fragments += member.declaration.fragment

    def remove(self, member: Member) -> None:
        """An instance has been removed."""
        del self.members[member]
        of_that_id = self._by_id[member.id]
        of_that_id.remove(member)
        if not of_that_id:
            del self._by_id[member.id]
        self.fragments -= member.declaration.fragment

    def with_id(self, number: int) -> Sequence[Member]:
        """The members that have this id."""
        return self._by_id.get(number, ())

    def has_other_kind(self, fragment: bool) -> bool:
        """Is a member a fragment, or, if ``fragment``, none?"""
        return self.fragments < len(self.members) if fragment else self.fragments > 0


class Container(Changing):
    """A container.

    ``started``: None where the text leaves the outcome of a failed start or stop open.
    ``doubtful``: the text leaves the outcome of its removal open.
    ``members``: all it ever had; ``present``: those that have not been removed; ``startup_order``: those that are started, in the order in which they were.
    ``served``: those of ``present`` that have served calls.
    ``of_doubt``: one of its members is doubtful.
    ``failed``: the operation that left open what became of it: the step, and the events with which it began and ended.
    """

    name: str
    started: bool | None = False
    removed: bool = False
    doubtful: bool = False
    members: list[Member] = []
    startup_order: dict[Member, None] = {}
    served: dict[Member, None] = {}
    failed_adds: int = 0
    of_doubt: bool = False
    failed: tuple[int, int, int] | None = None
    present: Membership = msgspec.field(default_factory=Membership)
    _live: tuple[Member, ...] | None = ()

    def live_members(self) -> tuple[Member, ...]:
        """Members that have not been removed."""
        if self._live is None:
            self._live = tuple(self.present.members)
        return self._live

    def has_certain_member(self) -> bool:
        """Is it certain of a live member that it is one?"""
        members = self.present.members
        return any(not member.doubtful for member in members) if self.of_doubt else bool(members)

    def admit(self, member: Member) -> None:
        """It has a new member."""
        self.members.append(member)
        self.present.add(member)
        self._live = None

    def dismiss(self, member: Member) -> None:
        """A member has been removed."""
        self.present.remove(member)
        self.served.pop(member, None)
        self._live = None

    def replace(self, members: list[Member]) -> None:
        """It has these members instead of others."""
        self.members, self.present, self._live = members, Membership(), None
        self.served = {}
        for member in members:
            if not member.gone:
                self.present.add(member)
                if member.served:
                    self.served[member] = None

    def suspend(self) -> None:
        """The outcome was left open: be silent about this container until a start or stop succeeds."""
        self.started = None
        for member in self.members:
            member.suspended = True


def lane(component: str, instance: int) -> str:
    """How findings and diagrams name the ``instance``-th body of ``component``."""
    return component if instance == 1 else f"{component}#{instance}"


def has_meaningless_values(declaration: Declaration, step: AddComponent) -> bool:
    """Is a value given for an attribute that the implementation does not have? It may be refused, or left alone."""
    return not step.attributes.keys() <= {*declaration.attributes, *declaration.defaults}


def raises(declaration: Declaration, *hooks: Hook) -> bool:
    """Does the plan of ``declaration`` raise at one of ``hooks``?"""
    return bool(declaration.plan) and not raising(declaration).isdisjoint(hooks)


def raising(declaration: Declaration) -> frozenset[Hook]:
    """The hooks at which the plan of ``declaration`` raises."""
    plan = declaration.plan
    return frozenset([hook for hook, actions in plan.items() if _RAISE in actions]) if plan else _NOWHERE


_RAISE = RaiseError()
_NOWHERE: frozenset[Hook] = frozenset()
