"""Tool chains that know the rules of 9.2.7 to 9.3 and look only half as far as they reach."""

from __future__ import annotations

from typing import Any

from ucm_cts.adapters.contract.metamodel.common import Named
from ucm_cts.adapters.contract.metamodel.contracts import Annotation, Interface, Method
from ucm_cts.adapters.contract.metamodel.interactions import (
    ConnectorDefinition,
    InteractionPattern,
    InteractionRole,
    ItemBinding,
    PortType,
)
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, parent_of
from ucm_cts.adapters.mutants.toolchain.registry import breaks, complaining_where
from ucm_cts.adapters.reference.toolchain.program import Program


def _only_if(program: Program, name: str, holds: Any) -> Program:
    """``program``, in which the complaints of rule ``name`` count only if ``holds(wrong, element, scope)``."""
    return complaining_where(program, name, lambda wrong, element, scope, _message: holds(wrong, element, scope))


def _is_declared(scope: Scope, reference: str) -> bool:
    return scope.find(reference, Named) is not None


@breaks("R-9.2.7.1-02", task="check")
def inherits_from_anything(program: Program) -> Program:
    """Asks only whether what is inherited is declared, not as what."""
    return _only_if(program, "inherits_from_interfaces", lambda one, _, scope: not _is_declared(scope, one.interface))


@breaks("R-9.2.7.1-02", task="check")
def inherits_from_nowhere(program: Program) -> Program:
    """Does not mind what is declared nowhere."""
    return _only_if(program, "inherits_from_interfaces", lambda one, _, scope: _is_declared(scope, one.interface))


@breaks("R-9.2.7.2-03", task="check")
def raises_anything(program: Program) -> Program:
    """Asks only whether what is raised is declared, not as what."""
    return _only_if(program, "raises_exceptions", lambda one, _, scope: not _is_declared(scope, one.exception))


@breaks("R-9.2.7.1-05", task="check")
def sees_only_interfaces_that_inherit_from_themselves(program: Program) -> Program:
    """Sees circles of one interface and no longer ones."""

    def at_once(wrong: Interface, _: Model, _scope: Scope) -> bool:
        return wrong.name in {one.interface for one in wrong.inherited_interfaces}

    return _only_if(program, "interfaces_do_not_inherit_from_themselves", at_once)


@breaks("R-9.3.3.2-06", task="check")
def sees_only_patterns_that_extend_themselves(program: Program) -> Program:
    """Sees circles of one pattern and no longer ones."""
    return _only_if(program, "patterns_do_not_extend_themselves", lambda wrong, _, _scope: wrong.extends == wrong.name)


@breaks("R-9.2.7-11", task="check")
def counts_only_neighbouring_returns(program: Program) -> Program:
    """Sees a second return value only right after the first one."""

    def neighbours(wrong: Any, method: Method, _: Scope) -> bool:
        where = next(n for n, one in enumerate(method.parameters) if one is wrong)
        return method.parameters[where - 1].direction == "RETURN"

    return _only_if(program, "at_most_one_return_value", neighbours)


@breaks("R-9.2.9.4-01", task="check")
def annotations_of_anything(program: Program) -> Program:
    """Asks only whether the definition of an annotation is declared, not as what."""

    def nowhere(wrong: Annotation, _: Annotation, scope: Scope) -> bool:
        return not _is_declared(scope, wrong.annotation_definition)

    return _only_if(program, "has_a_definition", nowhere)


@breaks("R-9.2.9.2-01", task="check")
def values_of_known_definitions(program: Program) -> Program:
    """Asks only whether the definition is there, not whether it has the parameter."""

    def nowhere(wrong: Any, _: Annotation, scope: Scope) -> bool:
        return not _is_declared(scope, wrong.configuration_parameter.rpartition(".")[0])

    return _only_if(program, "values_name_parameters", nowhere)


@breaks("R-9.3.3.2-05", task="check")
def sees_only_the_parents_roles(program: Program) -> Program:
    """Does not look at the roles of the parent's parent."""

    def of_parent(wrong: InteractionRole, pattern: InteractionPattern, scope: Scope) -> bool:
        parent = parent_of(Declared(pattern, scope))
        return parent is not None and wrong.name in {role.name for role in getattr(parent.element, "roles", ())}

    return _only_if(program, "roles_are_not_redefined", of_parent)


@breaks("R-9.3.3.3-05", task="check")
def interfaces_may_be_data(program: Program) -> Program:
    """Does not mind an interface that stands for data."""

    def of_interface(wrong: ItemBinding, _: ItemBinding, scope: Scope) -> bool:
        found = scope.member(wrong.interaction_item, InteractionPattern, "items")
        return getattr(found and found.element, "nature", "") == "INTERFACE"

    return _only_if(program, "bound_types_have_the_nature_of_the_item", of_interface)


@breaks("R-9.3.3.3-05", task="check")
def data_may_be_interfaces(program: Program) -> Program:
    """Does not mind a data type that stands for an interface."""

    def of_data(wrong: ItemBinding, _: ItemBinding, scope: Scope) -> bool:
        found = scope.member(wrong.interaction_item, InteractionPattern, "items")
        return getattr(found and found.element, "nature", "") == "DATA"

    return _only_if(program, "bound_types_have_the_nature_of_the_item", of_data)


@breaks("R-9.3.3.4-04", task="check")
def compares_with_one_only(program: Program) -> Program:
    """Compares multiplicities only where the upper one is 1."""
    return _only_if(program, "multiplicities_are_a_range", lambda role, *_: role.upper_multiplicity == 1)


@breaks("R-9.3.3.4-04", task="check", declares=("negative-multiplicities=refused",))
def looks_at_lower_multiplicities_only(program: Program) -> Program:
    """Says that it refuses negative multiplicities, and takes any negative number for an upper one."""
    return _only_if(program, "multiplicities_are_not_negative", lambda role, *_: (role.lower_multiplicity or 0) < 0)


@breaks("R-9.3.3.4-04", task="check", declares=("negative-multiplicities=refused",))
def looks_at_upper_multiplicities_only(program: Program) -> Program:
    """Says that it refuses negative multiplicities, and takes any number for a lower one."""
    return _only_if(program, "multiplicities_are_not_negative", lambda role, *_: (role.upper_multiplicity or 0) < -1)


@breaks("R-9.3.3.4-06", task="check")
def involves_items_of_any_pattern(program: Program) -> Program:
    """Asks only whether some pattern of the module has the item that a role involves."""

    def nowhere(wrong: Any, _: InteractionPattern, scope: Scope) -> bool:
        patterns = [d.element for known in scope.members.values() for d in known]
        return wrong.item not in {item.name for pattern in patterns for item in getattr(pattern, "items", ())}

    return _only_if(program, "roles_involve_items_of_the_pattern", nowhere)


@breaks("R-9.3.4-03", task="check")
def plays_roles_of_any_pattern(program: Program) -> Program:
    """Asks only whether the role of a connector port is there, not of which pattern it is."""

    def nowhere(wrong: Any, _: ConnectorDefinition, scope: Scope) -> bool:
        return scope.member(wrong.port_role, InteractionPattern, "roles") is None

    return _only_if(program, "ports_play_roles_of_the_pattern", nowhere)


@breaks("R-9.3.4.6-02", task="check")
def binds_items_of_any_pattern(program: Program) -> Program:
    """Asks only whether the item of a binding is there, not of which pattern it is."""

    def nowhere(wrong: Any, _: ConnectorDefinition, scope: Scope) -> bool:
        return scope.member(wrong.interaction_item, InteractionPattern, "items") is None

    return _only_if(program, "bindings_are_of_items_of_the_pattern", nowhere)


@breaks("R-9.3.4-01", task="check")
def refines_anything(program: Program) -> Program:
    """Asks only whether what a connector refines is declared, not as what."""

    def nowhere(wrong: ConnectorDefinition, _: ConnectorDefinition, scope: Scope) -> bool:
        return not _is_declared(scope, wrong.pattern)

    return _only_if(program, "refines_a_pattern", nowhere)


@breaks("R-9.3.4.4-01", task="check")
def anything_is_an_api(program: Program) -> Program:
    """Asks only whether the API of a connector port is declared, not as what."""
    return _only_if(program, "apis_are_port_types", lambda wrong, _, scope: not _is_declared(scope, wrong.api))


@breaks("R-9.3.4.6-03", task="check")
def binds_items_to_anything(program: Program) -> Program:
    """Asks only whether what an item is bound to is declared, not as what."""
    return _only_if(
        program, "items_are_bound_to_types", lambda wrong, _, scope: not _is_declared(scope, wrong.connector_item)
    )


@breaks("R-9.3.5.2-02", task="check")
def port_elements_have_anything(program: Program) -> Program:
    """Asks only whether the interface of a port element is declared, not as what."""

    def nowhere(wrong: Any, _: PortType, scope: Scope) -> bool:
        return not _is_declared(scope, wrong.interface)

    return _only_if(program, "port_elements_have_interfaces", nowhere)


@breaks("R-9.3.3.4-07", task="check")
def only_the_first_port_handles_items(program: Program) -> Program:
    """Does not mind a later port that does not handle the type of an item."""

    def first(wrong: Any, connector: ConnectorDefinition, _: Scope) -> bool:
        return wrong is connector.ports[0]

    return _only_if(program, "ports_of_an_item_handle_its_type", first)
