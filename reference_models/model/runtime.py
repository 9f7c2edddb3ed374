"""The reference model of a UCM runtime: follows a trace and knows, before each operation, what may happen (clause 11).

The model is an observer. It predicts by looking up the life-cycle table and then takes over what really happened.
Where it can no longer know (after a violation, or where the text leaves the outcome open) it *suspends* the instance:
properties stay silent about it until a start or stop that succeeds shows the state again.
"""

from __future__ import annotations

from collections.abc import Container as Container_
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from ucm_cts.adapters.contract.scenario import (
    MANAGER,
    NIL,
    UNKNOWN,
    AddComponent,
    Declaration,
    Hook,
    RaiseError,
    Scenario,
)
from ucm_cts.adapters.contract.trace import MaybeReference, Reference, Skip
from ucm_cts.reference_models.model.life_cycle import State

NO_ID = 2**64
"""The id of a connection whose id is not known."""

MOST_CONNECTIONS = 4
"""So many connections of an instance are remembered one by one."""


@dataclass(slots=True, eq=False)
class Connection:
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


@dataclass(slots=True, eq=False)
class Member:
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
    connections: list[Connection] = field(default_factory=list)
    once_connected: set[str] = field(default_factory=set)
    handed_over: tuple[Connection, ...] | None = ()
    closing: bool = False
    raising: frozenset[Hook] | None = None
    late: bool = False
    phase: str = ""
    told_of_removal: bool = False
    not_undone: tuple[str, ...] = ()
    not_shut_down: bool = False

    def raises(self, *hooks: Hook) -> bool:
        """Does the plan make this body raise at one of ``hooks``?"""
        if self.raising is None:
            self.raising = raising(self.declaration)
        return bool(self.raising) and not self.raising.isdisjoint(hooks)

    def forget_repetitions(self) -> None:
        """Of many connections that are undone, forget those that were like another one: there may be any number of them."""
        if len(self.connections) <= MOST_CONNECTIONS:
            return
        kept: list[Connection] = []
        seen: set[tuple[str, MaybeReference, int, str]] = set()
        for connection in self.connections:
            like = connection.port, connection.reference, id(connection.provider), connection.provided
            is_over = connection.live is False and not connection.ambiguous and not connection.stale
            if is_over and like in seen and connection not in (self.handed_over or ()):
                continue
            if is_over:
                seen.add(like)
            kept.append(connection)
        self.connections = kept

    def leave(self) -> None:
        """It has been removed."""
        self.gone = True
        self.container.changed()

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
    def body(self) -> tuple[str, int]:
        """Its component, and the number of its instance; 0 if that is not known."""
        return self.component, self.instance or 0

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
        live = [c.port for c in self.connections if c.live]
        return all(map(live.__contains__, required))


@dataclass(slots=True, eq=False)
class Container:
    """A container.

    ``started``: None where the text leaves the outcome of a failed start or stop open.
    ``doubtful``: the text leaves the outcome of its removal open.
    ``members``: all it ever had.
    ``of_doubt``: one of its members is doubtful.
    ``failed``: the operation that left open what became of it: the step, and the events with which it began and ended.
    """

    name: str
    started: bool | None = False
    removed: bool = False
    doubtful: bool = False
    members: list[Member] = field(default_factory=list)
    startup_order: list[Member] = field(default_factory=list)
    failed_adds: int = 0
    of_doubt: bool = False
    failed: tuple[int, int, int] | None = None
    _live: tuple[Member, ...] | None = None

    def live_members(self) -> tuple[Member, ...]:
        """Members that have not been removed."""
        if self._live is None:
            self._live = tuple([m for m in self.members if not m.gone])
        return self._live

    def changed(self) -> None:
        """It has other members than before."""
        self._live = None

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


class Behind(NamedTuple):
    """What is behind a required port element: the instances it is connected to, none if that is not known, and where
    calls through it arrive: component, instance and port element. ``fragments`` says that all of them are fragments.
    """

    providers: tuple[Member, ...]
    fragments: bool
    targets: frozenset[tuple[str, int | None, str]]


class Runtime:
    """All containers, instances, connections and references of one scenario.

    ``members``, ``connections``, ``references``: what variables hold now.
    ``present``: the instances in the order in which they were added, without those that have been removed without a trace.
    ``with_policies``: an instance had policies; ``knows_policies``: a component of the scenario has an execution
    policy; otherwise it is one of profile container, which knows none.
    ``shares_bodies``: two instances seemed to have the same body.
    ``startups``: when the last on_startup of each body began (``n``), and on which thread.
    ``starting``: bodies whose on_startup has returned during the operation in progress.
    ``starting_up``: bodies inside on_startup because their container is being started, each with its thread.
    ``in_vain``: gates that were waited for until patience ran out; ``opened``: those that were opened without that.
    ``inside``: the bodies in which each thread carries out business methods or run, the innermost last.
    ``not_offered``: operations that the adapter does not offer.
    ``shows_missing``: a start refused, or left out, what was never connected; so a reference that it gives is one of a connection.
    ``behind``: what executions.behind has found since anything ``changed``; ``changes``: how often that was so.
    """

    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.containers: dict[str, Container] = {MANAGER: Container(MANAGER)}
        self.members: dict[str, Member] = {}
        self.present: list[Member] = []
        self.with_policies = False
        self.knows_policies = False
        self.shares_bodies = False
        self.bodies: dict[tuple[str, int], Member] = {}
        self.discarded: set[tuple[str, int]] = set()
        self.startups: dict[tuple[str, int], tuple[int, int]] = {}
        self.starting: set[tuple[str, int]] = set()
        self.starting_up: dict[tuple[str, int], int] = {}
        self.in_vain: set[str] = set()
        self.opened: set[str] = set()
        self.inside: dict[int, list[tuple[str, int]]] = {}
        self.not_offered: list[Skip] = []
        self.connections: dict[str, Connection] = {}
        self.references: dict[str, tuple[MaybeReference, Member | None]] = {}
        self.ports: dict[str, str] = {}
        self.destroyed = False
        self.shares_ids = False
        self.shows_missing = False
        self.replaces_servers = False
        self.changes = 0
        self.behind: dict[tuple[tuple[str, int], str], Behind] = {}

    def changed(self) -> None:
        """What is behind the port elements of instances may have changed."""
        self.changes += 1
        if self.behind:
            self.behind.clear()

    def enrol(self, member: Member) -> None:
        """An instance has been added."""
        member.container.members.append(member)
        member.container.changed()
        self.members[member.name] = member
        self.present.append(member)
        self.with_policies = self.with_policies or bool(member.declaration.policies)
        if member.instance is not None:
            self.shares_bodies = self.shares_bodies or member.body in self.bodies
            self.bodies[member.body] = member

    def let_go(self, member: Member) -> None:
        """An instance has been removed. Its connections matter no more, unless they are unclear."""
        member.leave()
        if member in self.present and not any(c.live is not False or c.ambiguous for c in member.connections):
            self.present.remove(member)

    def provider_of(self, reference: MaybeReference) -> Member | None:
        """The instance that a recognised reference belongs to."""
        return self.bodies.get((reference.component, reference.instance)) if isinstance(reference, Reference) else None

    def may_run(self, member: Member) -> bool:
        """Has its last on_startup returned, and the stop that follows not?"""
        return member.operational or member.body in self.starting

    def find_member(self, container: Container, variable: str) -> tuple[Member | None, str]:
        """The live instance that the id in ``variable`` designates in ``container``, else None and why.

        The manager may know the members of its sub-containers, and every container those of all if ids are shared.
        """
        if variable == UNKNOWN or variable not in self.members:
            return None, "never existed"
        wanted = self.members[variable]
        for member in container.live_members():
            if member.id == wanted.id:
                return member, ""
        if wanted.gone:
            return None, "already removed"
        known = container.name == MANAGER or self.shares_ids
        return (wanted, "") if known else (None, "of another container")

    def find_connection(self, container: Container, variable: str) -> tuple[Connection | None, str]:
        """The connection, perhaps undone already, that the id in ``variable`` designates in ``container``, else None and why.

        The manager may know the connections of its sub-containers, and every container all of them if ids are shared.
        """
        if variable == UNKNOWN or variable not in self.connections:
            return None, "never existed"
        wanted = self.connections[variable]
        of_that_id = [c for c in self.all_connections() if c.live is not False and c.id == wanted.id]
        for connection in (wanted, *of_that_id):
            if connection.live is not False and connection.client.container is container:
                return connection, ""
        if wanted.live is False:
            return None, "already undone"
        known = container.name == MANAGER or self.shares_ids
        return (wanted, "") if known else (None, "of another container")

    def all_connections(self) -> Iterator[Connection]:
        """Every connection, but for those of removed instances that are undone."""
        return (connection for member in self.present for connection in member.connections)

    def clients_of(self, providers: Iterable[Member]) -> Iterator[tuple[Member, list[Connection]]]:
        """Each other instance that has live connections to one of ``providers``, with these connections."""
        wanted = {id(p) for p in providers}
        for member in self.present:
            if member.gone or id(member) in wanted:
                continue
            used = [c for c in member.connections if c.live and c.leads_to(wanted)]
            if used:
                yield member, used

    def reference(self, variable: str) -> tuple[MaybeReference, Member | None]:
        """What a reference variable holds and whose port element it is."""
        return (None, None) if variable == NIL else self.references.get(variable, (None, None))
