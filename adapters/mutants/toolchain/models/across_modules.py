"""Tool chains that look at one module or one generation only, and some that compare names where elements count."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel import interactions as mi
from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, parent_of
from ucm_cts.adapters.mutants.toolchain.checking import complains_only_where, refusing
from ucm_cts.adapters.mutants.toolchain.registry import breaks, complaining_where, named
from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.adapters.reference.toolchain.rules.components.policy_use import uses

References = Callable[[Any], Iterator[str]]
"""What an element refers to, and what may therefore lead back to it."""

_CIRCLES: tuple[tuple[str, str, References], ...] = (
    ("aliases_lead_to_other_types", "R-9.2.4.2-03", lambda one: iter((one.type,))),
    ("structures_are_finite", "R-9.2.4.3-06", lambda one: (field.type for field in one.fields)),
    ("arrays_are_finite", "R-9.2.4.9-01", lambda one: iter((one.type,))),
    (
        "interfaces_do_not_inherit_from_themselves",
        "R-9.2.7.1-05",
        lambda one: (inherited.interface for inherited in one.inherited_interfaces),
    ),
    ("patterns_do_not_extend_themselves", "R-9.3.3.2-06", lambda one: iter((one.extends,))),
    ("definitions_do_not_extend_themselves", "R-9.4.3.2-14", lambda one: iter((one.extends,))),
    ("types_do_not_refine_themselves", "R-9.5.3.1-11", lambda one: iter((one.refines,))),
    ("composites_do_not_contain_themselves", "R-9.5.5.3-04", lambda one: (part.instance_of for part in one.parts)),
)


def _only_inside(rule: str, requirement: str, references: References) -> None:
    def derive(program: Program) -> Program:
        return complaining_where(program, rule, lambda wrong, *_: not any("::" in name for name in references(wrong)))

    breaks(requirement)(named(derive, f"inside_one_module_{rule}", "Sees circles inside one module only."))


for _rule, _requirement, _references in _CIRCLES:
    _only_inside(_rule, _requirement, _references)


@complains_only_where("roles_are_not_redefined", "R-9.3.3.2-05")
def roles_of_parents_elsewhere(_: mi.InteractionRole, pattern: mi.InteractionPattern, _scope: Scope) -> bool:
    """Ignores the roles of a parent that another module declares."""
    return "::" not in pattern.extends


@complains_only_where("port_elements_are_not_redefined", "R-9.4.3.2-12")
def port_elements_of_parents_elsewhere(_: Any, definition: TechnicalPolicyDefinition, _scope: Scope) -> bool:
    """Ignores the port elements of an ancestor that another module declares."""
    return "::" not in definition.extends


@complains_only_where("parameters_are_not_redefined", "R-9.4.3.2-13")
def parameters_of_parents_elsewhere(_: Any, definition: TechnicalPolicyDefinition, _scope: Scope) -> bool:
    """Ignores the parameters of an ancestor that another module declares."""
    return "::" not in definition.extends


@complains_only_where("ports_play_roles_of_the_pattern", "R-9.3.4-03")
def roles_by_their_names(port: mi.ConnectorPort, connector: mi.ConnectorDefinition, scope: Scope) -> bool:
    """Takes a role of another pattern for the connector's own one of the same name."""
    pattern = scope.find(connector.pattern, mi.InteractionPattern)
    own = getattr(pattern and pattern.element, "roles", ())
    return port.port_role.rpartition(".")[2] not in {role.name for role in own}


@complains_only_where("has_at_most_one_policy", "R-9.4.3.1-05")
def counts_definitions(implementation: mc.AtomicComponentImplementation, _: Any, root: Scope) -> bool:
    """Counts the definitions of the policies of an aspect, not the policies."""
    of_aspects = [
        alike for use in uses(root) if use.implementation is implementation for alike in use.of_aspects().values()
    ]
    return any(len({policy.element.technical_policy_definition for policy in alike}) > 1 for alike in of_aspects)  # type: ignore[attr-defined]


@breaks("R-9.5.5.4-06", declares=("inherited-member-names=heir",))
def limits_of_own_roles(program: Program) -> Program:
    """Ignores how many may play a role that the pattern inherits."""

    def holds(connection: mc.Connection, _: Any, scope: Scope, message: str) -> bool:
        pattern = scope.find(connection.definition, mi.InteractionPattern)
        own = getattr(pattern and pattern.element, "roles", ())
        return pattern is None or any(f" role {role.name} of " in message for role in own)

    return complaining_where(program, "roles_are_not_played_too_often", holds)


@breaks("R-9.2.6.1-03", declares=("value-syntax=expressions",))
@refusing
def operands_are_of_one_module(constant: c.Constant, _: Scope) -> bool:
    """Does not know constants of other modules in expressions."""
    return " + " in constant.value and "::" in constant.value


@breaks("R-9.4.3.2-10", also=("R-9.5.4.2-08",), declares=("inherited-member-names=owner",))
@refusing
def parameters_of_the_parent(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> bool:
    """Knows the parameters of the definition and of its parent, not those of earlier generations."""
    definition = scope.find(policy.technical_policy_definition, TechnicalPolicyDefinition)
    parent = parent_of(definition) if definition is not None else None
    near = {one.name for one in _parameters(definition)} | {one.name for one in _parameters(parent)}
    return any(value.configuration_parameter.rpartition(".")[2] not in near for value in policy.configuration_values)


def _parameters(definition: Declared | None) -> tuple[c.ConfigurationParameter, ...]:
    """What ``definition`` declares itself."""
    return getattr(definition and definition.element, "configuration_parameters", ())
