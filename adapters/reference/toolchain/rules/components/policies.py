"""Rules of 9.5.4.2 and 9.5.4.3: technical policies on components and on ports."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.contracts import ConfigurationParameterValue
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, lineage
from ucm_cts.adapters.reference.toolchain.checking import Complaint, rule
from ucm_cts.adapters.reference.toolchain.rules.components import bindings
from ucm_cts.adapters.reference.toolchain.rules.components.policy_use import uses


@rule("R-9.5.4.2-01", mc.ComponentTechnicalPolicy)
def manages_some_component(policy: mc.ComponentTechnicalPolicy, _scope: Scope) -> Iterator[Complaint]:
    """A policy manages at least one component; that field is inherited by policies on ports (9.5.4.3)."""
    if not policy.managed_components:
        yield policy, f"policy {policy.name} manages no component; add a ManagedComponent"


@rule("R-9.5.4.2-02", mc.ComponentTechnicalPolicy)
def manages_atomic_implementations(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> Iterator[Complaint]:
    """What a policy manages are atomic implementations that are there."""
    for managed in policy.managed_components:
        if scope.find(managed.name, mc.AtomicComponentImplementation) is None:
            yield (
                managed,
                f"policy {policy.name} manages '{managed.name}', which is no atomic implementation; declare it",
            )


@rule("R-9.5.4.2-03", Model, under="one-sided-policy-links=refused")
def implementations_and_policies_name_each_other(_model: Model, root: Scope) -> Iterator[Complaint]:
    """An implementation and a policy name each other."""
    for use in uses(root):
        name = use.implementation.name
        for identity in use.named.keys() - use.naming.keys():
            policy = use.named[identity].element
            yield use.implementation, f"policy {policy.name} does not manage implementation {name}; say so there, too"
        for identity in use.naming.keys() - use.named.keys():
            policy = use.naming[identity].element
            yield (
                use.implementation,
                f"implementation {name} does not name policy {policy.name}, which manages it; add it",
            )


@rule("R-9.5.4.2-04", mc.ComponentTechnicalPolicy)
def policy_has_a_definition(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> Iterator[Complaint]:
    """The definition of a policy is a policy definition that is there."""
    if _definition(policy, scope) is None:
        yield (
            policy,
            f"policy {policy.name} is a '{policy.technical_policy_definition}', which is no policy definition; declare it",
        )


@rule("R-9.5.4.2-08", mc.ComponentTechnicalPolicy)
def values_are_of_parameters_of_the_definition(
    policy: mc.ComponentTechnicalPolicy, scope: Scope
) -> Iterator[Complaint]:
    """What receives a value is a parameter of the definition or of what it extends."""
    definition = _definition(policy, scope)
    if definition is None or not policy.configuration_values:
        return
    own = {id(one) for up in lineage(definition) for one in getattr(up.element, "configuration_parameters", ())}
    for value in policy.configuration_values:
        parameter = _parameter(value, scope)
        if parameter is None or id(parameter.element) not in own:
            name = policy.technical_policy_definition
            yield value, f"'{value.configuration_parameter}' is no parameter of {name}; say definition.parameter"


@rule("R-9.5.4.2-09", mc.ComponentTechnicalPolicy, under="repeated-parameter-values=refused")
def parameters_receive_one_value(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> Iterator[Complaint]:
    """No parameter receives two values."""
    seen: set[int] = set()
    for value in policy.configuration_values:
        parameter = _parameter(value, scope)
        if parameter is None:
            continue
        if id(parameter.element) in seen:
            yield (
                value,
                f"policy {policy.name} has a value for {value.configuration_parameter} already; keep one of both",
            )
        seen.add(id(parameter.element))


@rule("R-9.5.4.2-10", mc.ComponentTechnicalPolicy)
def component_policies_are_for_components(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> Iterator[Complaint]:
    """The definition of a policy on components is not for ports only."""
    if not isinstance(policy, mc.ComponentPortTechnicalPolicy) and _applicability(policy, scope) == "onPort":
        yield (
            policy,
            f"{policy.technical_policy_definition} is for ports; make policy {policy.name} a ComponentPortTechnicalPolicy",
        )


@rule("R-9.5.4.2-11", mc.ComponentTechnicalPolicy)
def policies_bind_abstract_types(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> Iterator[Complaint]:
    """What is bound is an abstract type."""
    return bindings.no_abstract_type(policy.bindings, scope)


@rule("R-9.5.4.2-11", mc.ComponentTechnicalPolicy)
def policies_bind_to_types(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> Iterator[Complaint]:
    """What stands for an abstract type is a type."""
    return bindings.no_actual_type(policy.bindings, scope)


@rule("R-9.5.4.2-11", mc.ComponentTechnicalPolicy, under="abstract-actual-types=refused")
def policies_bind_to_concrete_types(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> Iterator[Complaint]:
    """What stands for an abstract type is not abstract."""
    return bindings.still_abstract(policy.bindings, scope)


@rule("R-9.5.4.2-11", mc.ComponentTechnicalPolicy)
def policies_bind_to_types_of_the_same_kind(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> Iterator[Complaint]:
    """Data types stand for data types, interfaces for interfaces."""
    return bindings.of_another_kind(policy.bindings, scope)


@rule("R-9.5.4.2-11", mc.ComponentTechnicalPolicy)
def policies_bind_to_one_type(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> Iterator[Complaint]:
    """No abstract type stands for two types."""
    return bindings.bound_twice(policy.bindings, scope)


@rule("R-9.5.4.2-11", mc.ComponentTechnicalPolicy, under="unused-bindings=refused")
def policies_bind_what_they_use(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> Iterator[Complaint]:
    """What is bound is an abstract type that the definition uses."""
    return bindings.not_used(policy.bindings, scope, _apis(policy, scope))


@rule("R-9.5.4.2-11", mc.ComponentTechnicalPolicy, under="missing-type-bindings=check")
def abstract_types_of_policies_are_bound(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> Iterator[Complaint]:
    """Something stands for each abstract type of the definition."""
    return bindings.not_bound(policy, policy.bindings, scope, _apis(policy, scope))


@rule("R-9.5.4.3-02", mc.ComponentPortTechnicalPolicy)
def manages_some_port(policy: mc.ComponentPortTechnicalPolicy, _scope: Scope) -> Iterator[Complaint]:
    """A policy on ports manages at least one."""
    if not policy.managed_ports:
        yield policy, f"policy {policy.name} manages no port; add a ManagedPort"


@rule("R-9.5.4.3-03", mc.ComponentPortTechnicalPolicy)
def manages_ports(policy: mc.ComponentPortTechnicalPolicy, scope: Scope) -> Iterator[Complaint]:
    """What a policy on ports manages are ports that are there."""
    for managed in policy.managed_ports:
        if scope.member(managed.name, mc.ComponentType, "ports") is None:
            yield managed, f"policy {policy.name} manages '{managed.name}', which is no port; say type.port"


@rule("R-9.5.4.3-04", mc.ComponentPortTechnicalPolicy)
def manages_ports_of_its_components(policy: mc.ComponentPortTechnicalPolicy, scope: Scope) -> Iterator[Complaint]:
    """The managed ports are ports of the managed components, where these are named."""
    own = {
        id(port)
        for managed in policy.managed_components
        for up in _types_of(scope.find(managed.name, mc.AtomicComponentImplementation))
        for port in getattr(up.element, "ports", ())
    }
    for managed in policy.managed_ports if policy.managed_components else ():
        port = scope.member(managed.name, mc.ComponentType, "ports")
        if port is not None and id(port.element) not in own:
            yield managed, f"{managed.name} is a port of no component that {policy.name} manages; add that component"


@rule("R-9.5.4.3-06", mc.ComponentPortTechnicalPolicy)
def port_policies_are_for_ports(policy: mc.ComponentPortTechnicalPolicy, scope: Scope) -> Iterator[Complaint]:
    """The definition of a policy on ports is not for components only."""
    if _applicability(policy, scope) == "onComponent":
        yield (
            policy,
            f"{policy.technical_policy_definition} is for components; make policy {policy.name} a ComponentTechnicalPolicy",
        )


def _definition(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> Declared | None:
    return scope.find(policy.technical_policy_definition, TechnicalPolicyDefinition)


def _applicability(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> str:
    definition = _definition(policy, scope)
    return getattr(definition.element, "applicability", "") if definition is not None else ""


def _apis(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> list[Declared]:
    """The definition and its ancestors, which all have port elements."""
    definition = _definition(policy, scope)
    return lineage(definition) if definition is not None else []


def _parameter(value: ConfigurationParameterValue, scope: Scope) -> Declared | None:
    return scope.member(value.configuration_parameter, TechnicalPolicyDefinition, "configuration_parameters")


def _types_of(implementation: Declared | None) -> list[Declared]:
    """The component type of an implementation and its ancestors."""
    if implementation is None:
        return []
    found = implementation.scope.find(getattr(implementation.element, "type", ""), mc.ComponentType)
    return lineage(found) if found is not None else []
