"""Tool chains that are wrong about interfaces, exceptions, abstract types or annotations (9.2.7 to 9.2.9)."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel.common import children
from ucm_cts.adapters.contract.metamodel.components import AbstractTypeBinding, ComponentModule
from ucm_cts.adapters.contract.metamodel.contracts import (
    AbstractDataType,
    AbstractInterface,
    Annotation,
    AnnotationDefinition,
    Attribute,
    ConfigurationParameter,
    ContractModule,
    Enumeration,
    Exception_,
    ExceptionField,
    Interface,
    Method,
    Parameter,
    PrimitiveBoolean,
    Structure,
)
from ucm_cts.adapters.contract.metamodel.interactions import ConnectorDefinition, InteractionModule
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.mutants.toolchain.registry import breaks
from ucm_cts.adapters.mutants.toolchain.strictness import overhearing, refusing
from ucm_cts.adapters.reference.toolchain.program import Program


@breaks(
    "R-9.2.7-01",
    task="check",
    also=(
        "R-9.3.4-05",
        "R-9.4.3.2-02",
        "R-9.4.3.2-12",
        "R-9.5.3.7-03",
        "R-9.5.3.7-05",
        "R-9.5.5.4-08",
        "R-9.5.5.6-05",
    ),
)
def one_interface_a_module(program: Program) -> Program:
    """Takes a model of two interfaces for an error where neither has anything inside."""

    def two_bare(model: Model, _: Scope) -> bool:
        inside = [one for module in model.modules for one in children(module)]
        return [type(one) for one in inside] == [Interface, Interface] and not any(map(tuple, map(children, inside)))

    return refusing(program, Model, two_bare)


@breaks("R-9.2.7-03", task="check")
def one_attribute_an_interface(program: Program) -> Program:
    """Takes the second attribute of an interface for an error."""
    return refusing(program, Interface, lambda interface, _: len(interface.attributes) > 1)


@breaks("R-9.2.7-08", task="check")
def one_method_an_interface(program: Program) -> Program:
    """Takes the second method of an interface for an error."""
    return refusing(program, Interface, lambda interface, _: len(interface.methods) > 1)


@breaks("R-9.2.7-09", task="check", also=("R-9.4.3.2-02",))
def methods_have_parameters(program: Program) -> Program:
    """Takes a method of several IN parameters for an error."""

    def many(method: Method, _: object) -> bool:
        return len([p for p in method.parameters if p.direction == "IN"]) > 2

    return refusing(program, Method, many)


@breaks("R-9.2.7-10", task="check")
def any_direction(program: Program) -> Program:
    """Takes any word for a direction."""
    return overhearing(program, "bad literal", "Parameter", "direction")


@breaks("R-9.2.7.3-02", task="check")
def direction_left_out(program: Program) -> Program:
    """Does without the direction of a parameter."""
    return overhearing(program, "missing attribute", "Parameter", "direction")


@breaks("R-9.2.7-14", task="check")
def single_inheritance(program: Program) -> Program:
    """Takes a second ancestor of an interface for an error, diamond or not."""
    return refusing(program, Interface, lambda interface, _: len(interface.inherited_interfaces) > 1)


@breaks("R-9.2.7-14", task="check")
def no_diamonds(program: Program) -> Program:
    """Takes an ancestor that is reached by two ways for an error."""

    def reached_twice(interface: Interface, scope: Scope) -> bool:
        ways = [set(_lineage(i.interface, scope)) for i in interface.inherited_interfaces]
        return sum(map(len, ways)) > len(set().union(*ways))

    return refusing(program, Interface, reached_twice)


def _lineage(name: str, scope: Scope, depth: int = 20) -> Iterator[str]:
    yield name
    found = _named(name, scope) if depth else None
    for inherited in found.inherited_interfaces if found is not None else ():
        yield from _lineage(inherited.interface, scope, depth - 1)


@breaks("R-9.2.7-17", task="check")
def exceptions_say_something(program: Program) -> Program:
    """Takes an exception of several fields for an error."""
    return refusing(program, Exception_, lambda exception, _: len(exception.fields) > 1)


@breaks("R-9.2.7.1-01", task="check")
def no_mutual_interfaces(program: Program) -> Program:
    """Takes it for a circle that two interfaces know each other, or one itself, by way of a parameter."""

    def mutual(interface: Interface, scope: Scope) -> bool:
        return any(interface.name in _taken(_named(t, scope)) for t in _taken(interface))

    return refusing(program, Interface, mutual)


def _taken(interface: Interface | None) -> set[str]:
    methods = interface.methods if interface is not None else ()
    return {parameter.type for method in methods for parameter in method.parameters}


def _named(name: str, scope: Scope) -> Interface | None:
    found = scope.find(name, Interface)
    return found.element if found is not None and isinstance(found.element, Interface) else None


@breaks("R-9.2.7.2-01", task="check")
def one_annotation_a_method(program: Program) -> Program:
    """Takes the second annotation of a method for an error."""
    return refusing(program, Method, lambda method, _: len(method.annotations) > 1)


@breaks("R-9.2.7.3-01", task="check", also=("R-9.2.2.5-02",))
def parameters_do_something(program: Program) -> Program:
    """Takes a parameter that is an interface without methods for an error."""

    def of_bare_interface(parameter: Parameter, scope: Scope) -> bool:
        found = scope.find(parameter.type, Interface)
        return found is not None and not any(children(found.element))

    return refusing(program, Parameter, of_bare_interface)


@breaks("R-9.2.7.4-01", task="check")
def attributes_are_simple(program: Program) -> Program:
    """Takes an attribute of a structure or enumeration for an error."""

    def complex_(attribute: Attribute, scope: Scope) -> bool:
        return scope.find(attribute.type, Structure, Enumeration) is not None and not attribute.default_value

    return refusing(program, Attribute, complex_)


@breaks("R-9.2.7.4-02", task="check", declares=("attribute-mode-absent=required",))
def mode_left_out(program: Program) -> Program:
    """Says that an attribute must have a mode, and does without."""
    return program


@breaks("R-9.2.7.4-03", task="check")
def any_mode(program: Program) -> Program:
    """Takes any word for a mode."""
    return overhearing(program, "bad literal", "Attribute", "mode")


@breaks("R-9.2.7.5-01", task="check")
def exceptions_without_hyphens(program: Program) -> Program:
    """Takes a hyphen in the name of an exception for an error."""
    return refusing(program, Exception_, lambda exception, _: "-" in exception.name)


@breaks("R-9.2.7.6-01", task="check", also=("R-9.2.2.4-04",))
def exceptions_are_flat(program: Program) -> Program:
    """Takes a field of an exception that is a structure for an error."""
    return refusing(program, ExceptionField, lambda field, scope: scope.find(field.type, Structure) is not None)


@breaks("R-9.2.8-01", task="check")
def abstract_types_are_used(program: Program) -> Program:
    """Takes a module of more than two abstract types and nothing else for an error."""

    def only_abstract(module: ContractModule, _: Scope) -> bool:
        inside = tuple(children(module))
        return len(inside) > 2 and all(isinstance(one, AbstractDataType | AbstractInterface) for one in inside)

    return refusing(program, ContractModule, only_abstract)


@breaks("R-9.2.8-02", task="check")
def abstract_types_are_not_returned(program: Program) -> Program:
    """Takes a RETURN parameter of an abstract data type for an error."""
    return refusing(
        program, Parameter, lambda p, scope: p.direction == "RETURN" and scope.find(p.type, AbstractDataType)
    )


@breaks("R-9.2.8.1-01", task="check")
def abstract_types_go_one_way(program: Program) -> Program:
    """Takes an INOUT parameter of an abstract data type for an error."""
    return refusing(
        program, Parameter, lambda p, scope: p.direction == "INOUT" and scope.find(p.type, AbstractDataType)
    )


@breaks(
    "R-9.2.8.2-01",
    task="check",
    also=(
        "R-9-01",
        "R-9.3.5.2-02",
    ),
)
def abstract_interfaces_are_required(program: Program) -> Program:
    """Takes a port type that provides an abstract interface for an error in a module without patterns."""

    def provided(module: InteractionModule, scope: Scope) -> bool:
        abstract = {i.name for c in module.contract_modules for i in c.interfaces if isinstance(i, AbstractInterface)}
        elements = [e for port_type in module.port_types for e in port_type.port_elements if not module.patterns]
        return any(e.kind == "PROVIDED" and e.interface.rpartition("::")[2] in abstract for e in elements)

    return refusing(program, InteractionModule, provided)


@breaks("R-9.2.8-04", task="check")
def actual_types_are_named_from_the_root(program: Program) -> Program:
    """Takes a binding of an abstract type for an error if the actual one is named by a relative path."""
    return refusing(
        program, AbstractTypeBinding, lambda b, _: "::" in b.actual_type.lstrip(":") and b.actual_type[0] != ":"
    )


@breaks("R-9.2.9-01", task="check", also=("R-9.3.1-11",))
def connectors_are_not_configured_by_enumerations(program: Program) -> Program:
    """Takes a configuration parameter of a connector for an error if it is an enumeration."""

    def of_enumeration(connector: ConnectorDefinition, scope: Scope) -> bool:
        return any(scope.find(p.type, Enumeration) for p in connector.configuration_parameters)

    return refusing(program, ConnectorDefinition, of_enumeration)


@breaks("R-9.2.9-02", task="check")
def components_and_their_interfaces_are_not_both_annotated(program: Program) -> Program:
    """Takes the annotation of a component type for an error if an interface beside it has one, too."""

    def both(module: ComponentModule, _: Scope) -> bool:
        interfaces = [i for c in module.contract_modules for i in c.interfaces if isinstance(i, Interface)]
        return any(i.annotations for i in interfaces) and any(t.annotations for t in module.component_types)

    return refusing(program, ComponentModule, both)


@breaks("R-9.2.9.1-01", task="check", also=("R-9.2.2.7-01",))
def parameters_are_numbers(program: Program) -> Program:
    """Takes a boolean configuration parameter with a default value for an error."""
    return refusing(
        program,
        ConfigurationParameter,
        lambda parameter, scope: parameter.default_value and scope.find(parameter.type, PrimitiveBoolean),
    )


@breaks("R-9.2.9.3-01", task="check")
def annotations_say_something(program: Program) -> Program:
    """Takes an annotation definition of several parameters for an error."""
    return refusing(program, AnnotationDefinition, lambda one, _: len(one.configuration_parameters) > 1)


@breaks("R-9.2.9.4-01", task="check")
def annotations_of_the_same_module(program: Program) -> Program:
    """Takes a definition of another module for an error."""
    return refusing(program, Annotation, lambda annotation, _: "::" in annotation.annotation_definition)
