"""Tool chains that are wrong about component modules, component types, ports, implementations or policies (9.5.1 to 9.5.4)."""

from __future__ import annotations

from collections import Counter

from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import children
from ucm_cts.adapters.contract.metamodel.components import (
    AtomicComponentImplementation,
    ComponentModule,
    ComponentPortTechnicalPolicy,
    ComponentTechnicalPolicy,
    ComponentType,
    PortTypeSpec,
)
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.mutants.toolchain.registry import breaks
from ucm_cts.adapters.mutants.toolchain.strictness import refuses, refusing_text
from ucm_cts.adapters.mutants.toolchain.tolerance import forgiving, overhearing
from ucm_cts.adapters.reference.toolchain.program import Program


@refuses("R-9.5.1-06")
def values_apart_from_bindings(module: ComponentModule, _: Scope) -> bool:
    """Takes a module with values of parameters and bindings of ports for an error."""
    valued = any(policy.configuration_values for policy in module.technical_policies)
    return valued and any(spec.bindings for t in module.component_types for p in t.ports for spec in p.specs)


@refuses("R-9.5.2.1-01")
def modules_of_components_are_not_empty(model: Model, _: Scope) -> bool:
    """Takes a component module that is all of a model and empty for an error."""
    module = model.modules[0]
    alone = len(model.modules) == 1 and isinstance(module, ComponentModule)
    return alone and not any(True for _ in children(module))


@breaks("R-9.5.2.3-02")
def types_left_out(program: Program) -> Program:
    """Does without the component type of an atomic implementation."""
    reading = overhearing(program, "missing attribute", "AtomicComponentImplementation", "type")
    return forgiving(reading, "implements_a_component_type", lambda implementation: not implementation.type)


@refuses("R-9.5.3.2-05")
def refining_ports_keep_their_name(component: ComponentType, _: Scope) -> bool:
    """Takes a port that refines one of another name for an error."""
    refining = [port for port in component.ports if port.refines_port]
    twice = max(Counter(port.refines_port for port in refining).values(), default=0) > 1
    same = {port.name == port.refines_port.rpartition(".")[2] for port in refining}
    return not twice and same == {True, False}


@refuses("R-9.5.3.2-06")
def ports_are_refined_once(component: ComponentType, _: Scope) -> bool:
    """Takes a second port that refines the same one for an error."""
    refined = Counter(port.refines_port for port in component.ports if port.refines_port)
    return max(refined.values(), default=0) > 1


@refuses("R-9.5.3.9-01")
def one_binding_a_port(spec: PortTypeSpec, _: Scope) -> object:
    """Takes the second binding of a port for an error."""
    return len(spec.bindings) > 1


@breaks("R-9.5.4.1-01", also=("R-9.5.4.1-02",))
def language_left_out(program: Program) -> Program:
    """Does without the language of an atomic implementation."""
    reading = overhearing(program, "missing attribute", "AtomicComponentImplementation", "language")
    return forgiving(reading, "languages_are_listed", lambda implementation: not implementation.language)


@breaks("R-9.5.4.5-01", also=("R-9-01", "R-9.1.2-10", "R-9.2.2.14-01"))
def names_of_implementations_come_first(program: Program) -> Program:
    """Takes an atomic implementation that begins with its language for an error."""
    return refusing_text(program, rb"<AtomicComponentImplementation\s+language")


@refuses("R-9.5.4.2-05", also=("R-9.5.1-06",))
def one_component_a_policy(policy: ComponentTechnicalPolicy, scope: Scope) -> bool:
    """Takes the second component of a policy for an error if it is of another type."""
    found = (scope.find(one.name, AtomicComponentImplementation) for one in policy.managed_components)
    types = {getattr(one.element, "type", "") for one in found if one is not None}
    return type(policy) is ComponentTechnicalPolicy and len(types) > 1


@refuses("R-9.5.4.2-07", also=("R-9.2.2.7-01", "R-9.2.2.14-01"))
def parameters_have_values(policy: ComponentTechnicalPolicy, scope: Scope) -> bool:
    """Takes a policy that gives values to some parameters of its definition, but not to all, for an error."""
    definition = scope.find(policy.technical_policy_definition, TechnicalPolicyDefinition)
    known = len(getattr(definition and definition.element, "configuration_parameters", ()))
    return 0 < len(policy.configuration_values) < known


@refuses("R-9.5.4.3-05")
def one_component_a_port_policy(policy: ComponentPortTechnicalPolicy, _: Scope) -> bool:
    """Takes the second component of a port policy for an error if it is of another type."""
    return len({managed.name.rpartition(".")[0] for managed in policy.managed_ports}) > 1
