"""Tool chains that are wrong about composites, connections or delegations (9.5.5)."""

from __future__ import annotations

from ucm_cts.adapters.contract.metamodel.components import (
    ComponentType,
    CompositeComponentImplementation,
    Connection,
)
from ucm_cts.adapters.contract.metamodel.interactions import ConnectorDefinition
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, member_of
from ucm_cts.adapters.mutants.toolchain.registry import breaks
from ucm_cts.adapters.mutants.toolchain.strictness import overhearing, refusing, refusing_text
from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.adapters.reference.toolchain.rules.components.part_ports import component_type, part_called

Composite = CompositeComponentImplementation


@breaks("R-9.5.1-08", task="check")
def connectors_apart_from_delegations(program: Program) -> Program:
    """Takes a composite with connectors and delegations for an error."""

    def both(composite: Composite, scope: Scope) -> bool:
        return bool(composite.delegations) and any(
            scope.find(connection.definition, ConnectorDefinition) for connection in composite.connections
        )

    return refusing(program, Composite, both)


@breaks("R-9.5.3.1-05", task="check")
def inherited_ports_are_not_connected(program: Program) -> Program:
    """Takes a connection that ends at an inherited port for an error."""

    def inherited(composite: Composite, scope: Scope) -> bool:
        for end in (end for connection in composite.connections for end in connection.ends):
            part = part_called(composite, end.part, scope)
            owner = component_type(part.instance_of, scope) if part is not None else None
            if owner is not None and all(port.name != end.port for port in getattr(owner.element, "ports", ())):
                return True
        return False

    return refusing(program, Composite, inherited)


@breaks("R-9.5.5.2-01", task="check")
def all_ports_are_delegated(program: Program) -> Program:
    """Takes a composite that delegates some of its ports, but not all, for an error."""

    def some(composite: Composite, scope: Scope) -> bool:
        own = scope.find(composite.type, ComponentType)
        ports = len(getattr(own and own.element, "ports", ()))
        return 0 < len(composite.delegations) < ports

    return refusing(program, Composite, some)


@breaks("R-9.5.5.2-02", task="check")
def ports_of_composites(program: Program) -> Program:
    """Lets ports stand anywhere."""
    return overhearing(program, "misplaced element", "Port", "stand")


@breaks(
    "R-9.5.5.3-04",
    task="check",
    also=(
        "R-9.1.4.1-03",
        "R-9.1.4.1-01",
    ),
)
def no_part_of_the_own_type(program: Program) -> Program:
    """Takes a part of the composite's own component type for an error."""

    def recursive(composite: Composite, scope: Scope) -> bool:
        own = scope.find(composite.type, ComponentType)
        return any(
            own is not None
            and (found := scope.find(part.instance_of, ComponentType)) is not None
            and found.element is own.element
            for part in composite.parts
        )

    return refusing(program, Composite, recursive)


@breaks("R-9.5.5.4-03", task="check")
def three_ends_a_connection(program: Program) -> Program:
    """Takes the fourth end of a connection for an error."""
    return refusing(program, Connection, lambda connection, _: len(connection.ends) > 3)


@breaks("R-9.5.5.6-05", task="check")
def bindings_in_one_order(program: Program) -> Program:
    """Takes a delegation between ports that bind the same in another order for an error."""

    def turned(composite: Composite, scope: Scope) -> bool:
        own = scope.find(composite.type, ComponentType)
        for delegation in composite.delegations:
            for end in delegation.ends:
                part = part_called(composite, end.part, scope)
                owner = component_type(part.instance_of, scope) if part is not None else None
                outer, inner = _actual_types(own, delegation.port), _actual_types(owner, end.port)
                if outer != inner and sorted(outer) == sorted(inner):
                    return True
        return False

    return refusing(program, Composite, turned)


def _actual_types(owner: Declared | None, port_name: str) -> list[str]:
    """What a port binds to, in the order of its bindings."""
    port = member_of(owner, "ports", port_name) if owner is not None else None
    specs = getattr(port.element, "specs", ()) if port is not None else ()
    return [binding.actual_type for spec in specs for binding in spec.bindings]


@breaks("R-9.5.5.6-06", task="check")
def delegations_beside_connections(program: Program) -> Program:
    """Takes a composite with delegations and without connections for an error."""
    return refusing(program, Composite, lambda composite, _: composite.delegations and not composite.connections)


@breaks(
    "R-9.5.5.8-01",
    task="check",
    also=(
        "R-9.1.2-10",
        "R-9.1.4.1-01",
        "R-9.1.4.1-03",
    ),
)
def names_of_parts_come_first(program: Program) -> Program:
    """Takes a part that does not begin with its name for an error."""
    return refusing_text(program, rb"<Part\s+instanceOf")
