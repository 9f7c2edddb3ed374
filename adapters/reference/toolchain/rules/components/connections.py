"""Rules of 9.5.5.4 and 9.5.5.5: connections of composites, and what their ends are."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Iterator
from operator import attrgetter
from typing import NamedTuple

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel import interactions as mi
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, lineage
from ucm_cts.adapters.reference.toolchain.checking import Complaint, rule
from ucm_cts.adapters.reference.toolchain.rules.components import part_ports

DEFINITIONS = (mi.ConnectorDefinition, mi.InteractionPattern)
"""What a connection may be an instance of (9.3.3.1)."""

Composite = mc.CompositeComponentImplementation


@rule("R-9.5.5.4-01", mc.Connection, judged_by=attrgetter("definition"))
def connections_have_a_definition(connection: mc.Connection, scope: Scope) -> Iterator[Complaint]:
    """A connection is an instance of a connector or a pattern that is there."""
    if scope.find(connection.definition, *DEFINITIONS) is None:
        yield (
            connection,
            f"connection {connection.name} is a '{connection.definition}', which is no connector or pattern; declare it",
        )


@rule("R-9.5.5.5-01", mc.CompositeComponentImplementation)
def ends_are_at_parts(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    """The part of an end is one of the same composite."""
    for connection in _not_wholly_joined(composite, scope):
        for end in connection.ends:
            if part_ports.part_called(composite, end.part, scope) is None:
                yield end, f"'{end.part}' is no part of composite {composite.name}; name one of those"


@rule("R-9.5.5.5-02", mc.CompositeComponentImplementation)
def ends_are_at_ports_of_their_part(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    """The port of an end is one of its part's component type."""
    for connection in _not_wholly_joined(composite, scope):
        for end in connection.ends:
            if part_ports.port_of_end(composite, end, scope) is not None:
                continue
            part = part_ports.part_called(composite, end.part, scope)
            if part is not None and part_ports.component_type(part.instance_of, scope) is not None:
                yield end, f"'{end.port}' is no port of part {end.part}; name one of those"


class Definition(NamedTuple):
    """What a connection is an instance of: a connector, with the roles that each of its port types plays, or a pattern."""

    connector: Declared | None
    pattern: Declared | None
    apis: dict[int, list[mi.InteractionRole]]
    roles: list[mi.InteractionRole]


class Joined(NamedTuple):
    """An end of a connection, and what the specification of its port means."""

    end: mc.ConnectionEnd
    meaning: part_ports.Specified


class Joint(NamedTuple):
    """A connection, what it is an instance of, and those of its ends whose port is there and specified."""

    connection: mc.Connection
    definition: Definition
    joined: list[Joined]


def _joints(composite: Composite, scope: Scope) -> list[Joint]:
    return scope.remembered_last("joints", id(composite), functools.partial(_find_joints, composite, scope))


def _find_joints(composite: Composite, scope: Scope) -> list[Joint]:
    found = []
    meanings = {
        part.name: part_ports.meanings_of_component(part.instance_of, scope) for part in reversed(composite.parts)
    }
    definitions: dict[str, Definition] = {}
    for connection in composite.connections:
        joined = []
        for end in connection.ends:
            of_part = meanings.get(end.part)
            meaning = of_part.get(end.port) if of_part is not None else None
            if meaning is not None:
                joined.append(Joined(end, meaning))
        definition = definitions.get(connection.definition)
        if definition is None:
            definition = definitions[connection.definition] = _definition(connection.definition, scope)
        found.append(Joint(connection, definition, joined))
    return found


def _not_wholly_joined(composite: Composite, scope: Scope) -> list[mc.Connection]:
    """The connections with an end whose port is not there, or not specified."""
    return [one.connection for one in _joints(composite, scope) if len(one.joined) < len(one.connection.ends)]


def _definition(reference: str, scope: Scope) -> Definition:
    return scope.remembered(("definition", reference), functools.partial(_find_definition, reference, scope))


def _find_definition(reference: str, scope: Scope) -> Definition:
    connector = scope.find(reference, mi.ConnectorDefinition)
    if connector is None:
        pattern = scope.find(reference, mi.InteractionPattern)
        return Definition(None, pattern, {}, _roles(pattern) if pattern is not None else [])
    assert isinstance(connector.element, mi.ConnectorDefinition)
    refined = connector.scope.find(connector.element.pattern, mi.InteractionPattern)
    return Definition(connector, None, _apis(connector), _roles(refined) if refined is not None else [])


@rule("R-9.5.5.4-04", mc.CompositeComponentImplementation)
def connectors_have_the_apis_of_their_ends(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    """A connector has a port for the port type of each end; ends with a role are not checked."""
    for connection, definition, joined in _joints(composite, scope):
        if definition.connector is None:
            continue
        for end, meaning in joined:
            if meaning.kind is mc.PortTypeSpec and id(meaning.target) not in definition.apis:
                yield (
                    end,
                    f"{connection.definition} has no port with the port type of {end.part}.{end.port}; use another one",
                )


@rule("R-9.5.5.4-05", mc.CompositeComponentImplementation)
def patterns_have_the_roles_of_their_ends(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    """A pattern has the role of each end; ends with a port type are not checked."""
    for connection, definition, joined in _joints(composite, scope):
        if definition.pattern is None:
            continue
        roles = {id(role) for role in definition.roles}
        for end, meaning in joined:
            if meaning.kind is mc.PortRoleSpec and id(meaning.target) not in roles:
                yield (
                    end,
                    f"{connection.definition} has no role like that of {end.part}.{end.port}; use another pattern",
                )


@rule("R-9.5.5.4-06", mc.CompositeComponentImplementation)
def roles_are_not_played_too_often(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    """No more ends play a role than it allows."""
    for connection, role, number in _played(composite, scope):
        most = role.upper_multiplicity
        if most is not None and 0 <= most < number:
            name = f"role {role.name} of {connection.definition}"
            yield connection, f"{number} ends of {connection.name} play {name}, which {most} may; take some out"


@rule("R-9.5.5.4-07", mc.CompositeComponentImplementation, under="role-minimum=check")
def roles_are_played_often_enough(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    """No fewer ends play a role than it asks for."""
    for connection, role, number in _played(composite, scope):
        if role.lower_multiplicity is not None and number < role.lower_multiplicity:
            name = f"role {role.name} of {connection.definition}"
            yield (
                connection,
                f"{number} ends of {connection.name} play {name}, which wants {role.lower_multiplicity}; add some",
            )


@rule("R-9.5.5.4-08", mc.CompositeComponentImplementation, under="connected-types=check")
def connected_ports_bind_alike(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    """The same stands for an abstract type or an item at all ends."""
    for _, _, joined in _joints(composite, scope):
        seen: dict[int, Declared] = {}
        for end, meaning in joined:
            for identity, actual in meaning.bound.items():
                if seen.setdefault(identity, actual).element is not actual.element:
                    other = seen[identity].path
                    yield (
                        end,
                        f"{end.part}.{end.port} has {actual.path} where another end has {other}; connect what fits",
                    )


def _roles(pattern: Declared) -> list[mi.InteractionRole]:
    return [role for ancestor in lineage(pattern) for role in getattr(ancestor.element, "roles", ())]


def _apis(connector: Declared) -> dict[int, list[mi.InteractionRole]]:
    """The roles that each port type of a connector plays, by the identity of the port type."""
    assert isinstance(connector.element, mi.ConnectorDefinition)
    found: dict[int, list[mi.InteractionRole]] = {}
    for port in connector.element.ports:
        api = connector.scope.find(port.api, mi.PortType) if port.api else None
        role = connector.scope.member(port.port_role, mi.InteractionPattern, "roles")
        if api is not None:
            roles = found.setdefault(id(api.element), [])
            if role is not None and isinstance(role.element, mi.InteractionRole):
                roles.append(role.element)
    return found


Playing = tuple[mc.Connection, mi.InteractionRole, int]


def _played(composite: Composite, scope: Scope) -> Iterator[Playing]:
    """Each role of each connection and how many ends play it; nothing of one whose ends may play several roles or none."""
    known = scope.remembered("roles that ends play", dict[tuple[int, ...], Numbers])
    for connection, definition, joined in _joints(composite, scope):
        if len(joined) < len(connection.ends):
            continue
        key = (id(definition), *(id(meaning.target) for _, meaning in joined))
        numbers = known.get(key)
        if numbers is None:
            numbers = known[key] = _count(definition, [meaning for _, meaning in joined])
        for role, number in numbers:
            yield connection, role, number


Numbers = list[tuple[mi.InteractionRole, int]]
"""How many ends play each role."""


def _count(definition: Definition, meanings: Iterable[part_ports.Specified]) -> Numbers:
    """How often each role of ``definition`` is played by ends that mean this; nothing if one may play several roles or none."""
    numbers: dict[int, int] = {}
    for meaning in meanings:
        player = meaning.target
        if meaning.kind is mc.PortTypeSpec:
            candidates = definition.apis.get(id(meaning.target), ())
            if len(candidates) != 1:
                return []
            player = candidates[0]
        numbers[id(player)] = numbers.get(id(player), 0) + 1
    return [(role, numbers.get(id(role), 0)) for role in definition.roles]
