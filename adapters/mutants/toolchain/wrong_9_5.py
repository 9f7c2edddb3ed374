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
from ucm_cts.adapters.mutants.toolchain.strictness import overhearing, refusing, refusing_text
from ucm_cts.adapters.mutants.toolchain.tolerance import forgiving
from ucm_cts.adapters.reference.toolchain.program import Program


@breaks("R-9.5.1-06", task="check")
def values_apart_from_bindings(program: Program) -> Program:
    """Takes a module with values of parameters and bindings of ports for an error."""

    def both(module: ComponentModule, _: object) -> bool:
        valued = any(policy.configuration_values for policy in module.technical_policies)
        return valued and any(spec.bindings for t in module.component_types for p in t.ports for spec in p.specs)

    return refusing(program, ComponentModule, both)


@breaks("R-9.5.2.1-01", task="check")
def modules_of_components_are_not_empty(program: Program) -> Program:
    """Takes a component module that is all of a model and empty for an error."""

    def empty(model: Model, _: object) -> bool:
        module = model.modules[0]
        alone = len(model.modules) == 1 and isinstance(module, ComponentModule)
        return alone and not any(True for _ in children(module))

    return refusing(program, Model, empty)


@breaks(
    "R-9.5.2.1-04",
    task="check",
    also=(
        "R-9.1.4.8-02",
        "R-9.2.2.15-03",
    ),
)
def aspects_among_components(program: Program) -> Program:
    """Lets technical aspects stand anywhere."""
    return overhearing(program, "misplaced element", "TechnicalAspect", "stand")


@breaks("R-9.5.2.3-02", task="check")
def types_left_out(program: Program) -> Program:
    """Does without the component type of an atomic implementation."""
    reading = overhearing(program, "missing attribute", "AtomicComponentImplementation", "type")
    return forgiving(reading, "implements_a_component_type", lambda implementation: not implementation.type)


@breaks("R-9.5.3.2-05", task="check")
def refining_ports_keep_their_name(program: Program) -> Program:
    """Takes a port that refines one of another name for an error."""

    def renamed(component: ComponentType, _: object) -> bool:
        refining = [port for port in component.ports if port.refines_port]
        twice = max(Counter(port.refines_port for port in refining).values(), default=0) > 1
        same = {port.name == port.refines_port.rpartition(".")[2] for port in refining}
        return not twice and same == {True, False}

    return refusing(program, ComponentType, renamed)


@breaks("R-9.5.3.2-06", task="check")
def ports_are_refined_once(program: Program) -> Program:
    """Takes a second port that refines the same one for an error."""

    def twice(component: ComponentType, _: object) -> bool:
        refined = Counter(port.refines_port for port in component.ports if port.refines_port)
        return max(refined.values(), default=0) > 1

    return refusing(program, ComponentType, twice)


@breaks("R-9.5.3.9-01", task="check")
def one_binding_a_port(program: Program) -> Program:
    """Takes the second binding of a port for an error."""
    return refusing(program, PortTypeSpec, lambda spec, _: len(spec.bindings) > 1)


@breaks("R-9.5.4.1-01", task="check", also=("R-9.5.4.1-02",))
def language_left_out(program: Program) -> Program:
    """Does without the language of an atomic implementation."""
    reading = overhearing(program, "missing attribute", "AtomicComponentImplementation", "language")
    return forgiving(reading, "languages_are_listed", lambda implementation: not implementation.language)


@breaks(
    "R-9.5.4.5-01",
    task="check",
    also=("R-9-01", "R-9.1.2-10", "R-9.2.2.14-01"),
)
def names_of_implementations_come_first(program: Program) -> Program:
    """Takes an atomic implementation that begins with its language for an error."""
    return refusing_text(program, rb"<AtomicComponentImplementation\s+language")


@breaks("R-9.5.4.2-05", task="check", also=("R-9.5.1-06",))
def one_component_a_policy(program: Program) -> Program:
    """Takes the second component of a policy for an error if it is of another type."""

    def two_types(policy: ComponentTechnicalPolicy, scope: Scope) -> bool:
        found = (scope.find(one.name, AtomicComponentImplementation) for one in policy.managed_components)
        types = {getattr(one.element, "type", "") for one in found if one is not None}
        return type(policy) is ComponentTechnicalPolicy and len(types) > 1

    return refusing(program, ComponentTechnicalPolicy, two_types)


@breaks(
    "R-9.5.4.2-07",
    task="check",
    also=(
        "R-9.2.2.7-01",
        "R-9.2.2.14-01",
    ),
)
def parameters_have_values(program: Program) -> Program:
    """Takes a policy that gives values to some parameters of its definition, but not to all, for an error."""

    def some(policy: ComponentTechnicalPolicy, scope: Scope) -> bool:
        definition = scope.find(policy.technical_policy_definition, TechnicalPolicyDefinition)
        known = len(getattr(definition and definition.element, "configuration_parameters", ()))
        return 0 < len(policy.configuration_values) < known

    return refusing(program, ComponentTechnicalPolicy, some)


@breaks("R-9.5.4.3-05", task="check")
def one_component_a_port_policy(program: Program) -> Program:
    """Takes the second component of a port policy for an error if it is of another type."""

    def several(policy: ComponentPortTechnicalPolicy, _: object) -> bool:
        return len({managed.name.rpartition(".")[0] for managed in policy.managed_ports}) > 1

    return refusing(program, ComponentPortTechnicalPolicy, several)
