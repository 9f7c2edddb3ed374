"""Tool chains that are wrong about composites, connections or delegations (9.5.5)."""

from __future__ import annotations

from ucm_cts.adapters.contract.metamodel.components import ComponentType, CompositeComponentImplementation, Connection
from ucm_cts.adapters.contract.metamodel.interactions import ConnectorDefinition
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, member_of
from ucm_cts.adapters.mutants.toolchain.registry import breaks
from ucm_cts.adapters.mutants.toolchain.strictness import refuses, refusing_text
from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.adapters.reference.toolchain.rules.components.part_ports import component_type, part_called

Composite = CompositeComponentImplementation


@refuses("R-9.5.1-08")
def connectors_apart_from_delegations(composite: Composite, scope: Scope) -> bool:
    """Takes a composite with connectors and delegations for an error."""
    return bool(composite.delegations) and any(
        scope.find(connection.definition, ConnectorDefinition) for connection in composite.connections
    )


@refuses("R-9.5.3.1-05")
def inherited_ports_are_not_connected(composite: Composite, scope: Scope) -> bool:
    """Takes a connection that ends at an inherited port for an error."""
    for end in (end for connection in composite.connections for end in connection.ends):
        part = part_called(composite, end.part, scope)
        owner = component_type(part.instance_of, scope) if part is not None else None
        if owner is not None and all(port.name != end.port for port in getattr(owner.element, "ports", ())):
            return True
    return False


@refuses("R-9.5.5.2-01")
def all_ports_are_delegated(composite: Composite, scope: Scope) -> bool:
    """Takes a composite that delegates some of its ports, but not all, for an error."""
    own = scope.find(composite.type, ComponentType)
    ports = len(getattr(own and own.element, "ports", ()))
    return 0 < len(composite.delegations) < ports


@refuses("R-9.5.5.3-04", also=("R-9.1.4.1-03", "R-9.1.4.1-01"))
def no_part_of_the_own_type(composite: Composite, scope: Scope) -> bool:
    """Takes a part of the composite's own component type for an error."""
    own = scope.find(composite.type, ComponentType)
    return any(
        own is not None
        and (found := scope.find(part.instance_of, ComponentType)) is not None
        and found.element is own.element
        for part in composite.parts
    )


@refuses("R-9.5.5.4-03")
def three_ends_a_connection(connection: Connection, _: Scope) -> object:
    """Takes the fourth end of a connection for an error."""
    return len(connection.ends) > 3


@refuses("R-9.5.5.6-05")
def bindings_in_one_order(composite: Composite, scope: Scope) -> bool:
    """Takes a delegation between ports that bind the same in another order for an error."""
    own = scope.find(composite.type, ComponentType)
    for delegation in composite.delegations:
        for end in delegation.ends:
            part = part_called(composite, end.part, scope)
            owner = component_type(part.instance_of, scope) if part is not None else None
            outer, inner = _actual_types(own, delegation.port), _actual_types(owner, end.port)
            if outer != inner and sorted(outer) == sorted(inner):
                return True
    return False


def _actual_types(owner: Declared | None, port_name: str) -> list[str]:
    """What a port binds to, in the order of its bindings."""
    port = member_of(owner, "ports", port_name) if owner is not None else None
    specs = getattr(port.element, "specs", ()) if port is not None else ()
    return [binding.actual_type for spec in specs for binding in spec.bindings]


@refuses("R-9.5.5.6-06")
def delegations_beside_connections(composite: Composite, _: Scope) -> object:
    """Takes a composite with delegations and without connections for an error."""
    return composite.delegations and not composite.connections


@breaks("R-9.5.5.8-01", also=("R-9.1.2-10", "R-9.1.4.1-01", "R-9.1.4.1-03"))
def names_of_parts_come_first(program: Program) -> Program:
    """Takes a part that does not begin with its name for an error."""
    return refusing_text(program, rb"<Part\s+instanceOf")
