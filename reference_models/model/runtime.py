"""The reference model of a UCM runtime: follows a trace and knows, before each operation, what may happen (clause 11).

The model is an observer. It predicts by looking up the life-cycle table and then takes over what really happened.
Where it can no longer know (after a violation, or where the text leaves the outcome open) it *suspends* the instance:
properties stay silent about it until a start or stop that succeeds shows the state again.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import NamedTuple

from ucm_cts.adapters.contract.scenario import MANAGER, NIL, UNKNOWN, Scenario
from ucm_cts.adapters.contract.trace import MaybeReference, Reference, Skip
from ucm_cts.reference_models.model.connection_index import ConnectionIndex
from ucm_cts.reference_models.model.instances import (
    NO_ID,
    Connection,
    Container,
    Member,
    has_meaningless_values,
    lane,
    raises,
)

__all__ = [
    "NO_ID",
    "Behind",
    "Connection",
    "Container",
    "Member",
    "Runtime",
    "has_meaningless_values",
    "lane",
    "raises",
]


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
    ``inhabited``: the containers that have members.
    ``with_policies``: an instance had policies; ``knows_policies``: a component of the scenario has an execution
    policy; otherwise it is one of profile container, which knows none.
    ``shares_bodies``: two instances seemed to have the same body.
    ``remembered``: the connections among ``all_connections``, by id, by what they lead to and by container.
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
        self.present: dict[Member, None] = {}
        self.inhabited: dict[Container, None] = {}
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
        self.remembered = ConnectionIndex()
        self._enrolled = 0
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
        member.place = self._enrolled = self._enrolled + 1
        member.container.admit(member)
        self.inhabited[member.container] = None
        self.members[member.name] = member
        self.present[member] = None
        self.with_policies = self.with_policies or bool(member.declaration.policies)
        if member.instance is not None:
            self.shares_bodies = self.shares_bodies or member.body in self.bodies
            self.bodies[member.body] = member

    def let_go(self, member: Member) -> None:
        """An instance has been removed. Its connections matter no more, unless they are unclear."""
        self.leave(member)
        if member in self.present and not any(c.live is not False or c.ambiguous for c in member.connections):
            del self.present[member]
            for connection in member.connections:
                self.remembered.forget(connection)

    def leave(self, member: Member) -> None:
        """An instance has been removed."""
        if not member.gone:
            member.gone = True
            member.container.dismiss(member)
            if not member.container.present.members:
                del self.inhabited[member.container]

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
        of_that_id = container.present.with_id(wanted.id)
        if of_that_id:
            return of_that_id[0], ""
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
        of_that_id = [c for c in self.remembered.with_id(wanted.id) if c.live is not False]
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

    def connect(self, connection: Connection) -> None:
        """A connection has been made, or perhaps."""
        connection.client.connections.append(connection)
        self.remembered.add(connection)

    def forget_repetitions(self, member: Member) -> None:
        """Keep one of many connections of ``member`` that are alike."""
        for connection in member.forget_repetitions():
            self.remembered.forget(connection)

    def elsewhere(self, container: Container) -> Iterator[Member]:
        """The members of other containers."""
        for other in self.inhabited:
            if other is not container:
                yield from other.present.members

    def clients_of(self, providers: Collection[Member]) -> list[tuple[Member, list[Connection]]]:
        """Each other instance that has live connections to one of ``providers``, with these connections."""
        wanted = {id(p) for p in providers}
        clients = {c.client for c in self.remembered.leading_to(providers) if c.live and not c.client.gone}
        return [
            (client, [c for c in client.connections if c.live and c.leads_to(wanted)])
            for client in sorted(clients, key=lambda client: client.place)
            if id(client) not in wanted
        ]

    def reference(self, variable: str) -> tuple[MaybeReference, Member | None]:
        """What a reference variable holds and whose port element it is."""
        return (None, None) if variable == NIL else self.references.get(variable, (None, None))
