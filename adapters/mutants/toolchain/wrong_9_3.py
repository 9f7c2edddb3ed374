"""Tool chains that are wrong about interaction modules, patterns, connectors or port types (9.3)."""

from __future__ import annotations

from collections import Counter

from ucm_cts.adapters.contract.metamodel.components import CompositeComponentImplementation
from ucm_cts.adapters.contract.metamodel.contracts import AbstractDataType
from ucm_cts.adapters.contract.metamodel.interactions import (
    ConnectorDefinition,
    InteractionModule,
    InteractionPattern,
    InteractionRole,
    PortType,
)
from ucm_cts.adapters.contract.metamodel.modules import Model, PlatformModule
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.mutants.toolchain.registry import breaks
from ucm_cts.adapters.mutants.toolchain.strictness import overhearing, refusing, refusing_text
from ucm_cts.adapters.reference.toolchain.program import Program


@breaks("R-9.3.1-04", task="check", also=("R-9.3.3.4-05",))
def an_item_is_for_one_role(program: Program) -> Program:
    """Takes an item that two roles involve for an error in a module without connectors."""

    def shared(module: InteractionModule, _: object) -> bool:
        return not module.connectors and any(_is_shared(pattern) for pattern in module.patterns)

    return refusing(program, InteractionModule, shared)


def _is_shared(pattern: InteractionPattern) -> bool:
    return max(Counter(i.item for role in pattern.roles for i in role.involved_items).values(), default=0) > 1


@breaks(
    "R-9.3.1-05",
    task="check",
    also=(
        "R-9.5.5.4-02",
        "R-9.5.5.4-04",
        "R-9.3.3.1-01",
        "R-9.5.5.4-03",
    ),
)
def a_connector_has_ports_of_one_role(program: Program) -> Program:
    """Takes the port of a second role of a connector for an error if there are no items."""

    def several(connector: ConnectorDefinition, _: object) -> bool:
        return len({port.port_role for port in connector.ports}) > 1 and not connector.item_bindings

    return refusing(program, ConnectorDefinition, several)


@breaks("R-9.3.1-06", task="check", also=("R-9.2.2.7-01",))
def connectors_with_ports_are_hardly_configured(program: Program) -> Program:
    """Takes the second configuration parameter of a connector that has several ports for an error."""
    return refusing(program, ConnectorDefinition, lambda one, _: len(one.ports) > 1 < len(one.configuration_parameters))


@breaks("R-9.3.1-07", task="check", also=("R-9.5.5.4-07",))
def three_are_not_exactly_so_many(program: Program) -> Program:
    """Takes a role for exactly three for an error."""
    return refusing(program, InteractionRole, lambda role, _: role.lower_multiplicity == 3 == role.upper_multiplicity)


@breaks("R-9.3.1-11", task="check")
def defaults_are_not_enumerators(program: Program) -> Program:
    """Takes a configuration parameter beside item bindings for an error."""
    return refusing(
        program,
        ConnectorDefinition,
        lambda connector, _: connector.item_bindings and connector.configuration_parameters,
    )


@breaks("R-9.3.1-12", task="check", also=("R-9.5.5.6-04",))
def an_interface_is_for_one_side(program: Program) -> Program:
    """Takes an interface that one port type provides and the other one requires for an error where there are no patterns."""

    def on_both_sides(module: InteractionModule, _: object) -> bool:
        first = {(e.interface, e.kind) for port_type in module.port_types[:1] for e in port_type.port_elements}
        second = {(e.interface, e.kind) for port_type in module.port_types[1:] for e in port_type.port_elements}
        other = {"PROVIDED": "REQUIRED", "REQUIRED": "PROVIDED"}
        return not module.patterns and any((interface, other[kind]) in second for interface, kind in first)

    return refusing(program, InteractionModule, on_both_sides)


@breaks("R-9.3.1-13", task="check")
def items_of_many_are_concrete(program: Program) -> Program:
    """Takes an item that is bound to an abstract data type for an error if its one port provides."""

    def bound(module: InteractionModule, _: object) -> bool:
        abstract = {t.name for c in module.contract_modules for t in c.data_types if isinstance(t, AbstractDataType)}
        kinds = {e.kind for port_type in module.port_types for e in port_type.port_elements}
        bindings = [b for connector in module.connectors for b in connector.item_bindings]
        return kinds == {"PROVIDED"} and any(b.connector_item.rpartition("::")[2] in abstract for b in bindings)

    return refusing(program, InteractionModule, bound)


@breaks("R-9.3.2.1-01", task="check")
def contracts_come_first(program: Program) -> Program:
    """Takes a contract module after a connector for an error."""

    def late(module: InteractionModule, _: object) -> bool:
        return any(c.line >= connector.line for c in module.contract_modules for connector in module.connectors)

    return refusing(program, InteractionModule, late)


@breaks("R-9.3.2.1-05", task="check")
def one_interaction_module_a_platform(program: Program) -> Program:
    """Takes the second interaction module of a platform module for an error."""

    def several(module: PlatformModule, _: object) -> bool:
        return len([m for m in module.submodules if isinstance(m, InteractionModule)]) > 1

    return refusing(program, PlatformModule, several)


@breaks("R-9.3.2.2-01", task="check")
def modules_are_not_empty(program: Program) -> Program:
    """Takes an interaction module that is all of a model and empty for an error."""

    def empty(model: Model, _: object) -> bool:
        return model.modules == (InteractionModule(line=1, name=model.modules[0].name),)

    return refusing(program, Model, empty)


@breaks("R-9.3.2.2-02", task="check", also=("R-9-01",))
def names_of_bound_items_come_first(program: Program) -> Program:
    """Takes an item binding that begins with its connector item for an error."""
    return refusing_text(program, rb"<ItemBinding\s+connectorItem")


@breaks("R-9.3.2.2-03", task="check", declares=("module-extension=refused",))
def modules_extend_modules(program: Program) -> Program:
    """Says that modules do not extend modules, and takes no notice of it."""
    return program


@breaks("R-9.3.3-02", task="check")
def two_roles_a_pattern(program: Program) -> Program:
    """Takes the third role of a pattern for an error."""
    return refusing(program, InteractionPattern, lambda pattern, _: len(pattern.roles) > 2)


@breaks("R-9.3.3.1-01", task="check")
def connections_are_of_one_kind(program: Program) -> Program:
    """Takes a composite with connections both by a pattern and by a connector for an error."""

    def of_both(composite: CompositeComponentImplementation, scope: Scope) -> bool:
        by_pattern = [scope.find(c.definition, InteractionPattern) is not None for c in composite.connections]
        return any(by_pattern) and not all(by_pattern)

    return refusing(program, CompositeComponentImplementation, of_both)


@breaks("R-9.3.3.1-02", task="check", also=("R-9.3.3.2-04",))
def patterns_without_hyphens(program: Program) -> Program:
    """Takes a hyphen in the name of a pattern without items for an error."""
    return refusing(program, InteractionPattern, lambda pattern, _: "-" in pattern.name and not pattern.items)


@breaks("R-9.3.3.2-01", task="check")
def roles_are_unlimited_or_single(program: Program) -> Program:
    """Takes patterns whose roles are all for exactly one for an error if there are two of them and no items."""

    def only_singles(pattern: InteractionPattern, _: object) -> bool:
        singles = [role for role in pattern.roles if role.upper_multiplicity == 1]
        return len(singles) == 2 == len(pattern.roles) and not pattern.items

    return refusing(program, InteractionPattern, only_singles)


@breaks("R-9.3.3.2-02", task="check")
def one_item_a_pattern(program: Program) -> Program:
    """Takes the second item of a pattern for an error."""
    return refusing(program, InteractionPattern, lambda pattern, _: len(pattern.items) > 1)


@breaks("R-9.3.3.3-01", task="check", also=("R-9.3.3.4-05",))
def items_are_involved(program: Program) -> Program:
    """Takes an item that no role of its pattern involves for an error where there are roles."""

    def idle(pattern: InteractionPattern, _: object) -> bool:
        involved = {i.item for role in pattern.roles for i in role.involved_items}
        return bool(involved) and any(item.name not in involved for item in pattern.items)

    return refusing(program, InteractionPattern, idle)


@breaks("R-9.3.3.3-03", task="check")
def nature_left_out(program: Program) -> Program:
    """Does without the nature of an item."""
    return overhearing(program, "missing attribute", "InteractionItem", "nature")


@breaks("R-9.3.3.3-04", task="check")
def any_nature(program: Program) -> Program:
    """Takes any word for a nature."""
    return overhearing(program, "bad literal", "InteractionItem", "nature")


@breaks("R-9.3.3.4-01", task="check")
def roles_without_hyphens(program: Program) -> Program:
    """Takes a hyphen in the name of a role for an error."""
    return refusing(program, InteractionRole, lambda role, _: "-" in role.name)


@breaks("R-9.3.3.4-02", task="check")
def lower_multiplicity_left_out(program: Program) -> Program:
    """Does without the lower multiplicity of a role."""
    return overhearing(program, "missing attribute", "InteractionRole", "lowerMultiplicity")


@breaks("R-9.3.3.4-03", task="check")
def any_upper_multiplicity(program: Program) -> Program:
    """Takes any word for an upper multiplicity."""
    return overhearing(program, "bad number", "InteractionRole", "upperMultiplicity")


@breaks("R-9.3.3.4-05", task="check")
def one_item_a_role(program: Program) -> Program:
    """Takes the second item that a role involves for an error."""
    return refusing(program, InteractionRole, lambda role, _: len(role.involved_items) > 1)


@breaks("R-9.3.3.6-01", task="check")
def roles_come_first(program: Program) -> Program:
    """Takes an item before a role for an error."""

    def early(pattern: InteractionPattern, _: object) -> bool:
        return any(item.line < role.line for item in pattern.items for role in pattern.roles)

    return refusing(program, InteractionPattern, early)


@breaks("R-9.3.4.6-01", task="check")
def one_binding_a_connector(program: Program) -> Program:
    """Takes the second item binding of a connector for an error."""
    return refusing(program, ConnectorDefinition, lambda connector, _: len(connector.item_bindings) > 1)


@breaks(
    "R-9.3.5.1-01",
    task="check",
    also=(
        "R-9.3.5.2-04",
        "R-9.5.3.6-02",
    ),
)
def one_element_a_port_type(program: Program) -> Program:
    """Takes a port type that provides and requires for an error."""
    return refusing(
        program, PortType, lambda port_type, _: {e.kind for e in port_type.port_elements} == {"PROVIDED", "REQUIRED"}
    )


@breaks("R-9.3.5.2-01", task="check")
def an_interface_is_provided_once(program: Program) -> Program:
    """Takes two port elements of one interface for an error."""

    def twice(port_type: PortType, _: object) -> bool:
        return max(Counter((e.interface, e.kind) for e in port_type.port_elements).values(), default=0) > 1

    return refusing(program, PortType, twice)


@breaks("R-9.3.5.2-03", task="check")
def kind_left_out(program: Program) -> Program:
    """Does without the kind of a port element."""
    return overhearing(program, "missing attribute", "PortElement", "kind")


@breaks("R-9.3.5.2-04", task="check")
def any_kind(program: Program) -> Program:
    """Takes any word for the kind of a port element."""
    return overhearing(program, "bad literal", "PortElement", "kind")


@breaks(
    "R-9.3.5.4-01",
    task="check",
    also=(
        "R-9-01",
        "R-9.1.4.1-01",
        "R-9.1.4.1-03",
        "R-9.2.2.15-05",
        "R-9.3.2.2-02",
        "R-9.4.3.4-01",
        "R-9.5.3.9-01",
    ),
)
def names_of_port_elements_come_first(program: Program) -> Program:
    """Takes a port element whose first attribute is not its name for an error."""
    return refusing_text(program, rb"<PortElement\s+(?!name)")
