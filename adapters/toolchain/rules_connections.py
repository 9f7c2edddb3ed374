"""Rules of 9.5.5.4 and 9.5.5.5: connections of composites, and what their ends are."""

from __future__ import annotations

import functools
from collections.abc import Iterator
from typing import NamedTuple

from ucm_cts.adapters.contract.metamodel.components import (
    CompositeComponentImplementation,
    Connection,
    ConnectionEnd,
    PortRoleSpec,
    PortTypeSpec,
)
from ucm_cts.adapters.contract.metamodel.interactions import (
    ConnectorDefinition,
    InteractionPattern,
    InteractionRole,
    PortType,
)
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, lineage
from ucm_cts.adapters.toolchain.checking import Complaint, rule
from ucm_cts.adapters.toolchain.part_ports import Specified, component_type, part_called, port_of_end, specified

DEFINITIONS = (ConnectorDefinition, InteractionPattern)
"""What a connection may be an instance of (9.3.3.1)."""

Composite = CompositeComponentImplementation


@rule("R-9.5.5.4-01", Connection)
def connections_have_a_definition(connection: Connection, scope: Scope) -> Iterator[Complaint]:
    """A connection is an instance of a connector or a pattern that is there."""
    if scope.find(connection.definition, *DEFINITIONS) is None:
        yield (
            connection,
            f"connection {connection.name} is a '{connection.definition}', which is no connector or pattern; declare it",
        )


@rule("R-9.5.5.5-01", CompositeComponentImplementation)
def ends_are_at_parts(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    """The part of an end is one of the same composite."""
    for connection in composite.connections:
        for end in connection.ends:
            if part_called(composite, end.part, scope) is None:
                yield end, f"'{end.part}' is no part of composite {composite.name}; name one of those"


@rule("R-9.5.5.5-02", CompositeComponentImplementation)
def ends_are_at_ports_of_their_part(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    """The port of an end is one of its part's component type."""
    for connection in composite.connections:
        for end in connection.ends:
            if port_of_end(composite, end, scope) is not None:
                continue
            part = part_called(composite, end.part, scope)
            if part is not None and component_type(part.instance_of, scope) is not None:
                yield end, f"'{end.port}' is no port of part {end.part}; name one of those"


class Joined(NamedTuple):
    """An end of a connection, and what the specification of its port means."""

    end: ConnectionEnd
    meaning: Specified


def _joined(composite: Composite, connection: Connection, scope: Scope) -> list[Joined]:
    """The ends whose port is there and specified."""
    return scope.remembered(("joined", id(connection)), functools.partial(_find_joined, composite, connection, scope))


def _find_joined(composite: Composite, connection: Connection, scope: Scope) -> list[Joined]:
    found = []
    for end in connection.ends:
        port = port_of_end(composite, end, scope)
        meaning = specified(port) if port is not None else None
        if meaning is not None:
            found.append(Joined(end, meaning))
    return found


@rule("R-9.5.5.4-04", CompositeComponentImplementation)
def connectors_have_the_apis_of_their_ends(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    """A connector has a port for the port type of each end; ends with a role are not looked at."""
    for connection in composite.connections:
        connector = scope.find(connection.definition, ConnectorDefinition)
        if connector is None:
            continue
        apis = _apis(connector)
        for end, meaning in _joined(composite, connection, scope):
            if meaning.kind is PortTypeSpec and id(meaning.target) not in apis:
                yield (
                    end,
                    f"{connection.definition} has no port with the port type of {end.part}.{end.port}; use another one",
                )


@rule("R-9.5.5.4-05", CompositeComponentImplementation)
def patterns_have_the_roles_of_their_ends(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    """A pattern has the role of each end; ends with a port type are not looked at."""
    for connection in composite.connections:
        pattern = _pattern(connection, scope)
        if pattern is None:
            continue
        roles = {id(role) for role in _roles(pattern)}
        for end, meaning in _joined(composite, connection, scope):
            if meaning.kind is PortRoleSpec and id(meaning.target) not in roles:
                yield (
                    end,
                    f"{connection.definition} has no role like that of {end.part}.{end.port}; use another pattern",
                )


@rule("R-9.5.5.4-06", CompositeComponentImplementation)
def roles_are_not_played_too_often(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    """No more ends play a role than it allows."""
    for connection in composite.connections:
        for role, number in _played(composite, connection, scope):
            most = role.upper_multiplicity
            if most is not None and 0 <= most < number:
                name = f"role {role.name} of {connection.definition}"
                yield connection, f"{number} ends of {connection.name} play {name}, which {most} may; take some out"


@rule("R-9.5.5.4-07", CompositeComponentImplementation, under="role-minimum=check")
def roles_are_played_often_enough(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    """No fewer ends play a role than it asks for."""
    for connection in composite.connections:
        for role, number in _played(composite, connection, scope):
            if role.lower_multiplicity is not None and number < role.lower_multiplicity:
                name = f"role {role.name} of {connection.definition}"
                yield (
                    connection,
                    f"{number} ends of {connection.name} play {name}, which wants {role.lower_multiplicity}; add some",
                )


@rule("R-9.5.5.4-08", CompositeComponentImplementation, under="connected-types=check")
def connected_ports_bind_alike(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    """The same stands for an abstract type or an item at all ends."""
    for connection in composite.connections:
        seen: dict[int, Declared] = {}
        for end, meaning in _joined(composite, connection, scope):
            for identity, actual in meaning.bound.items():
                if seen.setdefault(identity, actual).element is not actual.element:
                    other = seen[identity].path
                    yield (
                        end,
                        f"{end.part}.{end.port} has {actual.path} where another end has {other}; connect what fits",
                    )


def _pattern(connection: Connection, scope: Scope) -> Declared | None:
    """The pattern that a connection is an instance of, if it is not one of a connector."""
    if scope.find(connection.definition, ConnectorDefinition) is not None:
        return None
    return scope.find(connection.definition, InteractionPattern)


def _roles(pattern: Declared) -> list[InteractionRole]:
    return pattern.scope.remembered(
        ("roles", id(pattern.element)),
        lambda: [role for ancestor in lineage(pattern) for role in getattr(ancestor.element, "roles", ())],
    )


def _apis(connector: Declared) -> dict[int, list[InteractionRole]]:
    """The roles that each port type of a connector plays, by the identity of the port type."""
    return connector.scope.remembered(("apis", id(connector.element)), functools.partial(_find_apis, connector))


def _find_apis(connector: Declared) -> dict[int, list[InteractionRole]]:
    assert isinstance(connector.element, ConnectorDefinition)
    found: dict[int, list[InteractionRole]] = {}
    for port in connector.element.ports:
        api = connector.scope.find(port.api, PortType) if port.api else None
        role = connector.scope.member(port.port_role, InteractionPattern, "roles")
        if api is not None:
            roles = found.setdefault(id(api.element), [])
            if role is not None and isinstance(role.element, InteractionRole):
                roles.append(role.element)
    return found


def _played(composite: Composite, connection: Connection, scope: Scope) -> list[tuple[InteractionRole, int]]:
    """Each role of a connection and how many ends play it; nothing if an end may play several roles or none."""
    count = functools.partial(_count_played, composite, connection, scope)
    return scope.remembered(("played", id(connection)), lambda: list(count()))


def _count_played(composite: Composite, connection: Connection, scope: Scope) -> Iterator[tuple[InteractionRole, int]]:
    connector, pattern = scope.find(connection.definition, ConnectorDefinition), _pattern(connection, scope)
    joined = _joined(composite, connection, scope)
    if len(joined) < len(connection.ends):
        return
    if connector is not None:
        apis = _apis(connector)
        wanted = getattr(connector.element, "pattern", "")
        pattern = connector.scope.find(wanted, InteractionPattern)
        if any(meaning.kind is PortTypeSpec and len(apis.get(id(meaning.target), ())) != 1 for _, meaning in joined):
            return
        players = [
            apis[id(meaning.target)][0] if meaning.kind is PortTypeSpec else meaning.target for _, meaning in joined
        ]
    elif any(meaning.kind is PortTypeSpec for _, meaning in joined):
        return
    else:
        players = [meaning.target for _, meaning in joined]
    numbers: dict[int, int] = {}
    for player in players:
        numbers[id(player)] = numbers.get(id(player), 0) + 1
    for role in _roles(pattern) if pattern is not None else ():
        yield role, numbers.get(id(role), 0)
