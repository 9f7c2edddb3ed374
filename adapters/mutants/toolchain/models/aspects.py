"""Tool chains that are wrong about nonfunctional aspect modules, policy definitions or languages (9.4)."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel import aspects as ma
from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel.common import children
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope
from ucm_cts.adapters.mutants.toolchain.checking import refuses, replaces_rule
from ucm_cts.adapters.reference.toolchain.checking import Complaint
from ucm_cts.adapters.reference.toolchain.rules.components.policy_use import aspect_of, uses


@refuses("R-9.4.1-02", also=("R-9-01", "R-9.4.1-06", "R-9.4.3.2-05", "R-9.4.3.2-11", "R-9.4.2.1-02", "R-9.5.1-06"))
def apis_for_all_or_none(module: ma.NonfunctionalAspectModule, _: Scope) -> bool:
    """Takes definitions with and without port elements side by side for an error."""
    return len({bool(definition.port_elements) for definition in module.policy_definitions}) > 1


@refuses("R-9.4.1-03", declares=("policies-on-ports-counted=with-the-component",))
def policies_on_ports_do_not_count(_: Model, root: Scope) -> bool:
    """Takes an implementation whose one policy of an aspect is on its ports for an error."""
    return any(
        isinstance(policy.element, mc.ComponentPortTechnicalPolicy) and _multiplicity(policy) == "exactlyOne"
        for use in uses(root)
        for policy in use.named.values()
    )


def _multiplicity(policy: Declared) -> str:
    aspect = aspect_of(policy)
    return getattr(aspect.element, "multiplicity", "") if aspect is not None else ""


@refuses("R-9.4.1-06", also=("R-9.4.4.1-01", "R-9.5.1-06"))
def languages_apart_from_policies(module: ma.NonfunctionalAspectModule, _: Scope) -> bool:
    """Takes a module that lists three languages and defines policies for an error."""
    several = any(len(languages.languages) == 3 for languages in module.supported_languages)
    return several and bool(module.policy_definitions)


@refuses("R-9.4.2.1-01")
def modules_of_aspects_are_not_empty(model: Model, _: Scope) -> bool:
    """Takes a nonfunctional aspect module that is all of a model and empty for an error."""
    module = model.modules[0]
    alone = len(model.modules) == 1 and isinstance(module, ma.NonfunctionalAspectModule)
    return alone and not any(True for _ in children(module))


@refuses("R-9.4.3.1-04", also=("R-9.5.4.5-01", "R-9.5.4.1-03"))
def any_number_is_one(_: Model, root: Scope) -> bool:
    """Takes a second policy of an aspect that allows any number for an error."""
    return any(
        len(policies) > 1 and _multiplicity(policies[0]) == "anyNumber"
        for use in uses(root)
        for policies in use.of_aspects().values()
    )


@refuses("R-9.4.3.2-03")
def aspects_stand_beside_their_policies(definition: ma.TechnicalPolicyDefinition, scope: Scope) -> bool:
    """Takes a definition of an aspect of another outermost module for an error."""
    aspect = scope.find(definition.technical_aspect, ma.TechnicalAspect)
    return aspect is not None and not definition.extends and _outermost(aspect.scope) is not _outermost(scope)


def _outermost(scope: Scope) -> Scope:
    while scope.around is not None and scope.around.around is not None:
        scope = scope.around
    return scope


@refuses("R-9.4.3.2-10", declares=("inherited-member-names=heir",))
def parameters_are_not_inherited(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> bool:
    """Takes a value of a parameter that the definition only inherits for an error."""
    definition = scope.find(policy.technical_policy_definition, ma.TechnicalPolicyDefinition)
    own = {one.name for one in getattr(definition and definition.element, "configuration_parameters", ())}
    return any(v.configuration_parameter.rpartition(".")[2] not in own for v in policy.configuration_values)


@refuses("R-9.4.3.2-11")
def port_elements_are_not_inherited(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> bool:
    """Takes bindings for a definition that only inherits port elements for an error."""
    definition = scope.find(policy.technical_policy_definition, ma.TechnicalPolicyDefinition)
    return bool(policy.bindings) and not getattr(definition and definition.element, "port_elements", ())


@refuses("R-9.4.3.4-02", also=("R-9.4.2.1-02", "R-9.4.2.1-03"))
def languages_do_not_come_first(module: ma.NonfunctionalAspectModule, _: Scope) -> bool:
    """Takes a list of languages before all else in its module for an error."""
    lines = [child.line for child in children(module) if not isinstance(child, ma.ProgrammingLanguages)]
    return any(languages.line < min(lines, default=0) for languages in module.supported_languages)


@refuses("R-9.4.3.4-04")
def parameters_come_first(definition: ma.TechnicalPolicyDefinition, _: Scope) -> bool:
    """Takes a port element before a parameter for an error."""
    return any(e.line < p.line for e in definition.port_elements for p in definition.configuration_parameters)


@refuses("R-9.4.4-01", also=("R-9-01", "R-9.5.4.1-02"))
def languages_are_not_alone(module: ma.NonfunctionalAspectModule, scope: Scope) -> bool:
    """Takes a module that has a list of languages and nothing else and is in another module for an error."""
    return scope.around is not None and [type(child) for child in children(module)] == [ma.ProgrammingLanguages]


@replaces_rule("has_the_one_policy_only", "R-9.4.1-04", declares=("policies-on-ports-counted=with-the-component",))
def counts_policies_on_components_only(_model: Model, root: Scope) -> Iterator[Complaint]:
    """Says that policies on ports count with those on the component, and counts only the latter."""
    for use in uses(root):
        mine = [policy.element for policy in use.named.values() if _multiplicity(policy) == "exactlyOne"]
        if sum(not isinstance(policy, mc.ComponentPortTechnicalPolicy) for policy in mine) > 1:
            yield use.implementation, f"{use.implementation.name} has two policies"
