"""The connections of all instances, by id, by what they lead to and by container: a removal takes no longer beside a thousand other components."""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator, Mapping, Sequence

from ucm_cts.reference_models.model.instances import Connection, Container, Member


class ConnectionIndex:
    """The connections that instances remember. It follows from these; the runtime keeps it up."""

    def __init__(self) -> None:
        self._with_id: dict[int, list[Connection]] = {}
        self._to: dict[Member, dict[Connection, None]] = {}
        self._by_connectors: dict[Connection, None] = {}
        self._in: dict[Container, dict[Connection, None]] = {}

    def add(self, connection: Connection) -> None:
        """A connection has been made, or perhaps. Its provider stays."""
        self._with_id.setdefault(connection.id, []).append(connection)
        if connection.provider is not None:
            self._to.setdefault(connection.provider, {})[connection] = None
        self._in.setdefault(connection.client.container, {})[connection] = None

    def attach(self, connection: Connection) -> None:
        """A port element has been attached to a connector. What the connection leads to changes with the connector's ends."""
        self._by_connectors[connection] = None
        self._in.setdefault(connection.client.container, {})[connection] = None

    def forget(self, connection: Connection) -> None:
        """It is not remembered any more."""
        self._in[connection.client.container].pop(connection, None)
        if connection in self._by_connectors:
            del self._by_connectors[connection]
            return
        of_that_id = self._with_id[connection.id]
        of_that_id.remove(connection)
        if not of_that_id:
            del self._with_id[connection.id]
        if connection.provider is not None:
            del self._to[connection.provider][connection]

    def with_id(self, number: int) -> Sequence[Connection]:
        """The connections that have this id, in the order of their clients."""
        found = self._with_id.get(number, ())
        return found if len(found) < 2 else sorted(found, key=lambda c: (c.client.place, c.client.connections.index(c)))

    def newest_in(self, container: Container) -> Iterator[Connection]:
        """The connections of the members of ``container`` that stand, or may, the newest ones first."""
        there = self._in.get(container, {})
        for connection in [*itertools.takewhile(_is_undone, reversed(there))]:
            del there[connection]  # it is undone for good: nobody passes it over twice
        return (connection for connection in reversed(there) if connection.live is not False)

    def leading_to(self, providers: Collection[Member]) -> Iterator[Connection]:
        """The connections that lead to one of ``providers``, in any order."""
        for provider in providers:
            yield from self._to.get(provider, ())
        if self._by_connectors:
            wanted = {id(provider) for provider in providers}
            yield from (connection for connection in self._by_connectors if connection.leads_to(wanted))

    def copied(
        self,
        containers: Mapping[int, Container],
        members: Mapping[int, Member],
        connections: Mapping[int, Connection],
    ) -> ConnectionIndex:
        """The same of copies, which are given by the ``id()`` of what they are copies of."""
        other = ConnectionIndex()
        other._with_id = {number: [connections[id(c)] for c in alike] for number, alike in self._with_id.items()}
        other._to = {members[id(m)]: {connections[id(c)]: None for c in to} for m, to in self._to.items()}
        other._by_connectors = {connections[id(c)]: None for c in self._by_connectors}
        other._in = {containers[id(c)]: {connections[id(k)]: None for k in own} for c, own in self._in.items()}
        return other


def _is_undone(connection: Connection) -> bool:
    return connection.live is False
