"""Tool chains that are wrong about interaction modules, patterns, connectors or port types (9.3)."""

from __future__ import annotations

from collections import Counter

from ucm_cts.adapters.contract.metamodel import interactions as mi
from ucm_cts.adapters.contract.metamodel.components import CompositeComponentImplementation
from ucm_cts.adapters.contract.metamodel.contracts import AbstractDataType
from ucm_cts.adapters.contract.metamodel.modules import Model, PlatformModule
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.mutants.toolchain.checking import refuses


@refuses("R-9.3.1-04", also=("R-9.3.3.4-05",))
def an_item_is_for_one_role(module: mi.InteractionModule, _: Scope) -> bool:
    """Takes an item that two roles involve for an error in a module without connectors."""
    return not module.connectors and any(_is_shared(pattern) for pattern in module.patterns)


def _is_shared(pattern: mi.InteractionPattern) -> bool:
    return max(Counter(i.item for role in pattern.roles for i in role.involved_items).values(), default=0) > 1


@refuses("R-9.3.1-05", also=("R-9.5.5.4-02", "R-9.5.5.4-04", "R-9.3.3.1-01", "R-9.5.5.4-03"))
def a_connector_has_ports_of_one_role(connector: mi.ConnectorDefinition, _: Scope) -> bool:
    """Takes the port of a second role of a connector for an error if there are no items."""
    return len({port.port_role for port in connector.ports}) > 1 and not connector.item_bindings


@refuses("R-9.3.1-12", also=("R-9.5.5.6-04",))
def an_interface_is_for_one_side(module: mi.InteractionModule, _: Scope) -> bool:
    """Takes an interface that one port type provides and the other one requires for an error where there are no patterns."""
    first = {(e.interface, e.kind) for port_type in module.port_types[:1] for e in port_type.port_elements}
    second = {(e.interface, e.kind) for port_type in module.port_types[1:] for e in port_type.port_elements}
    other = {"PROVIDED": "REQUIRED", "REQUIRED": "PROVIDED"}
    return not module.patterns and any((interface, other[kind]) in second for interface, kind in first)


@refuses("R-9.3.1-13")
def items_of_many_are_concrete(module: mi.InteractionModule, _: Scope) -> bool:
    """Takes an item that is bound to an abstract data type for an error if its one port provides."""
    abstract = {t.name for c in module.contract_modules for t in c.data_types if isinstance(t, AbstractDataType)}
    kinds = {e.kind for port_type in module.port_types for e in port_type.port_elements}
    bindings = [b for connector in module.connectors for b in connector.item_bindings]
    return kinds == {"PROVIDED"} and any(b.connector_item.rpartition("::")[2] in abstract for b in bindings)


@refuses("R-9.3.2.1-01")
def contracts_come_first(module: mi.InteractionModule, _: Scope) -> bool:
    """Takes a contract module after a connector for an error."""
    return any(c.line >= connector.line for c in module.contract_modules for connector in module.connectors)


@refuses("R-9.3.2.1-05")
def one_interaction_module_a_platform(module: PlatformModule, _: Scope) -> bool:
    """Takes the second interaction module of a platform module for an error."""
    return len([m for m in module.submodules if isinstance(m, mi.InteractionModule)]) > 1


@refuses("R-9.3.2.2-01")
def modules_are_not_empty(model: Model, _: Scope) -> bool:
    """Takes an interaction module that is all of a model and empty for an error."""
    return model.modules == (mi.InteractionModule(line=1, name=model.modules[0].name),)


@refuses("R-9.3.3.1-01")
def connections_are_of_one_kind(composite: CompositeComponentImplementation, scope: Scope) -> bool:
    """Takes a composite with connections both by a pattern and by a connector for an error."""
    by_pattern = [scope.find(c.definition, mi.InteractionPattern) is not None for c in composite.connections]
    return any(by_pattern) and not all(by_pattern)


@refuses("R-9.3.3.2-01")
def roles_are_unlimited_or_single(pattern: mi.InteractionPattern, _: Scope) -> bool:
    """Takes patterns whose roles are all for exactly one for an error if there are two of them and no items."""
    singles = [role for role in pattern.roles if role.upper_multiplicity == 1]
    return len(singles) == 2 == len(pattern.roles) and not pattern.items


@refuses("R-9.3.3.3-01", also=("R-9.3.3.4-05",))
def items_are_involved(pattern: mi.InteractionPattern, _: Scope) -> bool:
    """Takes an item that no role of its pattern involves for an error where there are roles."""
    involved = {i.item for role in pattern.roles for i in role.involved_items}
    return bool(involved) and any(item.name not in involved for item in pattern.items)


@refuses("R-9.3.3.6-01")
def roles_come_first(pattern: mi.InteractionPattern, _: Scope) -> bool:
    """Takes an item before a role for an error."""
    return any(item.line < role.line for item in pattern.items for role in pattern.roles)


@refuses("R-9.3.5.1-01", also=("R-9.3.5.2-04", "R-9.5.3.6-02"))
def one_element_a_port_type(port_type: mi.PortType, _: Scope) -> object:
    """Takes a port type that provides and requires for an error."""
    return {e.kind for e in port_type.port_elements} == {"PROVIDED", "REQUIRED"}


@refuses("R-9.3.5.2-01")
def an_interface_is_provided_once(port_type: mi.PortType, _: Scope) -> bool:
    """Takes two port elements of one interface for an error."""
    return max(Counter((e.interface, e.kind) for e in port_type.port_elements).values(), default=0) > 1
