"""Tool chains that are wrong about component types, ports, implementations, policies, composites or connections (9.5)."""

from __future__ import annotations

from collections import Counter

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import children
from ucm_cts.adapters.contract.metamodel.interactions import ConnectorDefinition
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, member_of
from ucm_cts.adapters.mutants.toolchain.checking import forgiving, overhearing, refuses
from ucm_cts.adapters.mutants.toolchain.registry import breaks
from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.adapters.reference.toolchain.rules.components.part_ports import component_type, part_called


@refuses("R-9.5.1-06")
def values_apart_from_bindings(module: mc.ComponentModule, _: Scope) -> bool:
    """Takes a module with values of parameters and bindings of ports for an error."""
    valued = any(policy.configuration_values for policy in module.technical_policies)
    return valued and any(spec.bindings for t in module.component_types for p in t.ports for spec in p.specs)


@refuses("R-9.5.2.1-01")
def modules_of_components_are_not_empty(model: Model, _: Scope) -> bool:
    """Takes a component module that is all of a model and empty for an error."""
    module = model.modules[0]
    alone = len(model.modules) == 1 and isinstance(module, mc.ComponentModule)
    return alone and not any(True for _ in children(module))


@breaks("R-9.5.2.3-02")
def types_left_out(program: Program) -> Program:
    """Does without the component type of an atomic implementation."""
    reading = overhearing(program, "missing attribute", "AtomicComponentImplementation", "type")
    return forgiving(reading, "implements_a_component_type", lambda implementation: not implementation.type)


@refuses("R-9.5.3.2-05")
def refining_ports_keep_their_name(component: mc.ComponentType, _: Scope) -> bool:
    """Takes a port that refines one of another name for an error."""
    refining = [port for port in component.ports if port.refines_port]
    twice = max(Counter(port.refines_port for port in refining).values(), default=0) > 1
    same = {port.name == port.refines_port.rpartition(".")[2] for port in refining}
    return not twice and same == {True, False}


@refuses("R-9.5.3.2-06")
def ports_are_refined_once(component: mc.ComponentType, _: Scope) -> bool:
    """Takes a second port that refines the same one for an error."""
    refined = Counter(port.refines_port for port in component.ports if port.refines_port)
    return max(refined.values(), default=0) > 1


@breaks("R-9.5.4.1-01", also=("R-9.5.4.1-02",))
def language_left_out(program: Program) -> Program:
    """Does without the language of an atomic implementation."""
    reading = overhearing(program, "missing attribute", "AtomicComponentImplementation", "language")
    return forgiving(reading, "languages_are_listed", lambda implementation: not implementation.language)


@refuses("R-9.5.4.2-05", also=("R-9.5.1-06",))
def one_component_a_policy(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> bool:
    """Takes the second component of a policy for an error if it is of another type."""
    found = (scope.find(one.name, mc.AtomicComponentImplementation) for one in policy.managed_components)
    types = {getattr(one.element, "type", "") for one in found if one is not None}
    return type(policy) is mc.ComponentTechnicalPolicy and len(types) > 1


@refuses("R-9.5.4.2-07", also=("R-9.2.2.7-01", "R-9.2.2.14-01"))
def parameters_have_values(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> bool:
    """Takes a policy that gives values to some parameters of its definition, but not to all, for an error."""
    definition = scope.find(policy.technical_policy_definition, TechnicalPolicyDefinition)
    known = len(getattr(definition and definition.element, "configuration_parameters", ()))
    return 0 < len(policy.configuration_values) < known


@refuses("R-9.5.4.3-05")
def one_component_a_port_policy(policy: mc.ComponentPortTechnicalPolicy, _: Scope) -> bool:
    """Takes the second component of a port policy for an error if it is of another type."""
    return len({managed.name.rpartition(".")[0] for managed in policy.managed_ports}) > 1


Composite = mc.CompositeComponentImplementation


@refuses("R-9.5.1-08")
def connectors_apart_from_delegations(composite: Composite, scope: Scope) -> bool:
    """Takes a composite with connectors and delegations for an error."""
    return bool(composite.delegations) and any(
        scope.find(connection.definition, ConnectorDefinition) for connection in composite.connections
    )


@refuses("R-9.5.3.1-05", also=("R-9.5.5.5-02",))
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
    own = scope.find(composite.type, mc.ComponentType)
    ports = len(getattr(own and own.element, "ports", ()))
    return 0 < len(composite.delegations) < ports


@refuses("R-9.5.5.3-04", also=("R-9.1.4.1-03", "R-9.1.4.1-01"))
def no_part_of_the_own_type(composite: Composite, scope: Scope) -> bool:
    """Takes a part of the composite's own component type for an error."""
    own = scope.find(composite.type, mc.ComponentType)
    return any(
        own is not None
        and (found := scope.find(part.instance_of, mc.ComponentType)) is not None
        and found.element is own.element
        for part in composite.parts
    )


@refuses("R-9.5.5.6-05")
def bindings_in_one_order(composite: Composite, scope: Scope) -> bool:
    """Takes a delegation between ports that bind the same in another order for an error."""
    own = scope.find(composite.type, mc.ComponentType)
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
