"""Tool chains that apply rules of clause 9 only partly: to the first of several elements, to some types, to outermost modules."""

from __future__ import annotations

from typing import Any

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel import interactions as mi
from ucm_cts.adapters.contract.metamodel.common import Element, Named
from ucm_cts.adapters.contract.metamodel.components import (
    ComponentPortTechnicalPolicy,
    ComponentTechnicalPolicy,
    ComponentType,
    PortTypeSpec,
)
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, parent_of
from ucm_cts.adapters.mutants.toolchain.checking import complains_only_where
from ucm_cts.adapters.mutants.toolchain.registry import Holds, breaks, complaining_where, named
from ucm_cts.adapters.reference.toolchain.rules.contracts.actual_types import actual_type


def _is_declared(scope: Scope, reference: str) -> bool:
    return scope.find(reference, Named) is not None


@complains_only_where("inherits_from_interfaces", "R-9.2.7.1-02")
def inherits_from_nowhere(one: Any, _: Any, scope: Scope) -> bool:
    """Accepts what is declared nowhere."""
    return _is_declared(scope, one.interface)


@complains_only_where("interfaces_do_not_inherit_from_themselves", "R-9.2.7.1-05")
def sees_only_interfaces_that_inherit_from_themselves(wrong: c.Interface, _: Model, _scope: Scope) -> bool:
    """Sees circles of one interface and no longer ones."""
    return wrong.name in {one.interface for one in wrong.inherited_interfaces}


@complains_only_where("patterns_do_not_extend_themselves", "R-9.3.3.2-06")
def sees_only_patterns_that_extend_themselves(wrong: Any, _: Any, _scope: Scope) -> bool:
    """Sees circles of one pattern and no longer ones."""
    return bool(wrong.extends == wrong.name)


@complains_only_where("at_most_one_return_value", "R-9.2.7-11")
def counts_only_neighbouring_returns(wrong: Any, method: c.Method, _: Scope) -> bool:
    """Sees a second return value only right after the first one."""
    where = next(n for n, one in enumerate(method.parameters) if one is wrong)
    return method.parameters[where - 1].direction == "RETURN"


@complains_only_where("values_name_parameters", "R-9.2.9.2-01")
def values_of_known_definitions(wrong: Any, _: c.Annotation, scope: Scope) -> bool:
    """Asks only whether the definition is there, not whether it has the parameter."""
    return not _is_declared(scope, wrong.configuration_parameter.rpartition(".")[0])


@complains_only_where("roles_are_not_redefined", "R-9.3.3.2-05")
def sees_only_the_parents_roles(wrong: mi.InteractionRole, pattern: mi.InteractionPattern, scope: Scope) -> bool:
    """Ignores the roles of the parent's parent."""
    parent = parent_of(Declared(pattern, scope))
    return parent is not None and wrong.name in {role.name for role in getattr(parent.element, "roles", ())}


@complains_only_where("bound_types_have_the_nature_of_the_item", "R-9.3.3.3-05")
def interfaces_may_be_data(wrong: mi.ItemBinding, _: mi.ItemBinding, scope: Scope) -> bool:
    """Accepts an interface that stands for data."""
    found = scope.member(wrong.interaction_item, mi.InteractionPattern, "items")
    return getattr(found and found.element, "nature", "") == "INTERFACE"


@complains_only_where("bound_types_have_the_nature_of_the_item", "R-9.3.3.3-05")
def data_may_be_interfaces(wrong: mi.ItemBinding, _: mi.ItemBinding, scope: Scope) -> bool:
    """Accepts a data type that stands for an interface."""
    found = scope.member(wrong.interaction_item, mi.InteractionPattern, "items")
    return getattr(found and found.element, "nature", "") == "DATA"


@complains_only_where("multiplicities_are_a_range", "R-9.3.3.4-04")
def compares_with_one_only(role: Any, _: Any, _scope: Scope) -> bool:
    """Compares multiplicities only where the upper one is 1."""
    return bool(role.upper_multiplicity == 1)


@complains_only_where("multiplicities_are_a_range", "R-9.3.3.4-04")
def zero_means_that_there_is_no_most(role: Any, _: Any, _scope: Scope) -> bool:
    """Takes an upper multiplicity of 0 as one that is not given."""
    return bool(role.upper_multiplicity != 0)


@complains_only_where("ports_bind_to_types", "R-9.5.3.7-03")
def looks_at_the_first_port_of_a_type(_: Any, spec: PortTypeSpec, scope: Scope) -> bool:
    """Once a port of a port type was looked at, what further ones of the component type bind to does not count."""
    owners = [d.element for known in scope.members.values() for d in known if isinstance(d.element, ComponentType)]
    alike = [
        [one for port in owner.ports for one in port.specs if isinstance(one, PortTypeSpec) and one.type == spec.type]
        for owner in owners
    ]
    return not any(spec is one for specs in alike for one in specs[1:])


@complains_only_where("multiplicities_are_not_negative", "R-9.3.3.4-04", declares=("negative-multiplicities=refused",))
def looks_at_lower_multiplicities_only(role: Any, _: Any, _scope: Scope) -> bool:
    """Says that it refuses negative multiplicities, and takes any negative number for an upper one."""
    return (role.lower_multiplicity or 0) < 0


@complains_only_where("multiplicities_are_not_negative", "R-9.3.3.4-04", declares=("negative-multiplicities=refused",))
def looks_at_upper_multiplicities_only(role: Any, _: Any, _scope: Scope) -> bool:
    """Says that it refuses negative multiplicities, and takes any number for a lower one."""
    return (role.upper_multiplicity or 0) < -1


@complains_only_where("roles_involve_items_of_the_pattern", "R-9.3.3.4-06")
def involves_items_of_any_pattern(wrong: Any, _: mi.InteractionPattern, scope: Scope) -> bool:
    """Asks only whether some pattern of the module has the item that a role involves."""
    patterns = [d.element for known in scope.members.values() for d in known]
    return wrong.item not in {item.name for pattern in patterns for item in getattr(pattern, "items", ())}


@complains_only_where("ports_play_roles_of_the_pattern", "R-9.3.4-03")
def plays_roles_of_any_pattern(wrong: Any, _: mi.ConnectorDefinition, scope: Scope) -> bool:
    """Asks only whether the role of a connector port is there, not of which pattern it is."""
    return scope.member(wrong.port_role, mi.InteractionPattern, "roles") is None


@complains_only_where("bindings_are_of_items_of_the_pattern", "R-9.3.4.6-02")
def binds_items_of_any_pattern(wrong: Any, _: mi.ConnectorDefinition, scope: Scope) -> bool:
    """Asks only whether the item of a binding is there, not of which pattern it is."""
    return scope.member(wrong.interaction_item, mi.InteractionPattern, "items") is None


@complains_only_where("ports_of_an_item_handle_its_type", "R-9.3.3.4-07")
def only_the_first_port_handles_items(wrong: Any, connector: mi.ConnectorDefinition, _: Scope) -> bool:
    """Accepts a later port that does not handle the type of an item."""
    return wrong is connector.ports[0]


@complains_only_where("values_are_of_parameters_of_the_definition", "R-9.5.4.2-08")
def anything_for_policies_on_ports(_: Any, policy: ComponentTechnicalPolicy, _scope: Scope) -> bool:
    """Accepts any parameter in a policy on ports."""
    return not isinstance(policy, ComponentPortTechnicalPolicy)


def _partial(name: str, says: str, requirement: str, rule: str, holds: Holds, *also: str) -> None:
    """Register a mutant in which the complaints of ``rule`` count only where ``holds``."""
    derive = named(lambda program: complaining_where(program, rule, holds), name, says)
    breaks(requirement, also=also)(derive)


def _is_not_of(kind: str) -> Holds:
    def holds(wrong: Any, _element: Element, scope: Scope, _message: str) -> bool:
        found = actual_type(wrong.type, scope)
        return not (found is not None and getattr(found.element, "kind", None) == kind)

    return holds


for _kind in c.INTEGER_RANGES:
    _partial(
        f"any_default_of_{_kind.lower()}",
        f"Checks defaults of all types but {_kind}.",
        "R-9.2.2.7-01",
        "defaults_are_values_of_their_types",
        _is_not_of(_kind),
        "R-9.2.2.6-02",
    )


def _is_no(kind: type[Element]) -> Holds:
    def holds(wrong: Any, _element: Element, scope: Scope, _message: str) -> bool:
        found = actual_type(wrong.type, scope)
        return not (found is not None and isinstance(found.element, kind))

    return holds


_DEFAULTS = "defaults_are_values_of_their_types"
_partial("any_default_of_floats", "Ignores floats.", "R-9.2.2.7-01", _DEFAULTS, _is_no(c.PrimitiveFloat))
_partial(
    "any_default_by_alias",
    "Does not follow aliases.",
    "R-9.2.2.7-01",
    _DEFAULTS,
    lambda wrong, _element, scope, _message: scope.find(wrong.type, c.Alias) is None,
)
_partial(
    "any_default_of_components",
    "Ignores the attributes of component types.",
    "R-9.2.2.7-01",
    _DEFAULTS,
    lambda _wrong, _element, scope, _message: not scope.path.startswith("::comp"),
)
_partial(
    "neighbouring_defaults",
    "Sees a second default case right after the first case only.",
    "R-9.2.4.6-08",
    "one_case_is_the_default",
    lambda wrong, union, _scope, _message: wrong is union.cases[1],
)
_partial(
    "attributes_of_components_of_one_name",
    "Ignores the attributes of component types.",
    "R-9.1.4.1-02",
    "attributes_differ",
    lambda _wrong, owner, _scope, _message: not isinstance(owner, ComponentType),
)


def _is_not_nested(_wrong: Any, _element: Any, scope: Scope, _message: str) -> bool:
    return scope.path.count("::") < 2


_partial(
    "outermost_connectors_only",
    "Ignores connectors in modules of modules.",
    "R-9.3.4-01",
    "refines_a_pattern",
    _is_not_nested,
)
_partial(
    "outermost_definitions_only",
    "Ignores policy definitions in modules of modules.",
    "R-9.4.3.2-03",
    "specifies_an_aspect",
    _is_not_nested,
)


_partial(
    "binds_only_in_policies_on_components",
    "Checks the bindings of policies on components, not on ports.",
    "R-9.5.4.2-11",
    "policies_bind_abstract_types",
    lambda _wrong, policy, _scope, _message: not isinstance(policy, ComponentPortTechnicalPolicy),
)
