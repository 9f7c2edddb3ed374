"""Edits of modules, names and paths (9.1), and of what refers to types (9.2.1, 9.2.2)."""

from __future__ import annotations

import copy

from lxml import etree

from ucm_cts.harness.toolchains.declarations import NOWHERE
from ucm_cts.harness.toolchains.operators import breaks, keeps
from ucm_cts.harness.toolchains.operators_interfaces import beside

ELSEWHERE = ("declarations-elsewhere=refused",)
_DATA_TYPES = ("PrimitiveInteger", "PrimitiveFloat", "PrimitiveChar", "PrimitiveBoolean", "StringType")
_MODULES = (
    "ApplicationModule",
    "PlatformModule",
    "ContractModule",
    "InteractionModule",
    "NonfunctionalAspectModule",
    "ComponentModule",
)


def module_of(element: etree._Element) -> etree._Element:
    """The nearest module around ``element``."""
    return next(around for around in element.iterancestors() if around.tag in _MODULES)


def in_the_same_module(element: etree._Element, name: str, *tags: str) -> etree._Element | None:
    """The declaration called ``name`` in the module around ``element``, if it is one of ``tags``."""
    return next((one for one in module_of(element) if one.tag in tags and one.get("name") == name), None)


@breaks("R-9.1.4.1-01", at="Enumerator")
def enumerator_without_name(enumerator: etree._Element) -> None:
    """An enumerator has no name."""
    del enumerator.attrib["name"]


@breaks("R-9.1.4.1-01", at="Interface")
def interface_with_an_empty_name(interface: etree._Element) -> None:
    """An interface has an empty name."""
    interface.set("name", "")


@breaks("R-9.1.4.1-01", at="ComponentType")
def component_type_without_name(component_type: etree._Element) -> None:
    """A component type has no name."""
    del component_type.attrib["name"]


@breaks("R-9.1.4.1-02", at="Enumeration")
def enumeration_again(enumeration: etree._Element) -> None:
    """The module has two enumerations of one name."""
    enumeration.addnext(copy.deepcopy(enumeration))


@breaks("R-9.1.4.1-02", at="PrimitiveInteger")
def integer_and_boolean_of_one_name(integer: etree._Element) -> None:
    """The module has two data types of one name, although of two sorts."""
    beside(integer, "PrimitiveBoolean", name=str(integer.get("name")))


@breaks("R-9.1.4.1-02", at="TechnicalPolicyDefinition")
def policy_definition_again(definition: etree._Element) -> None:
    """The module has two policy definitions of one name."""
    definition.addnext(copy.deepcopy(definition))


@breaks("R-9.1.4.1-02", at="ConfigurationParameter")
def configuration_parameter_again(parameter: etree._Element) -> None:
    """The owner has two configuration parameters of one name."""
    parameter.addnext(copy.deepcopy(parameter))


@breaks("R-9.1.4.1-02", at="Port")
def port_again(port: etree._Element) -> None:
    """The component type has two ports of one name."""
    port.addnext(copy.deepcopy(port))


@keeps("R-9.1.4.1-03", at="PrimitiveInteger")
def same_name_in_a_module_of_its_own(integer: etree._Element) -> None:
    """Another module may declare a data type of the same name."""
    module = beside(integer, "ContractModule", name="another_place")
    etree.SubElement(module, "PrimitiveBoolean", name=str(integer.get("name")))


@breaks("R-9.1.4.4-01", at="ContractModule")
def contract_module_without_name(module: etree._Element) -> None:
    """A contract module has no name."""
    del module.attrib["name"]


@breaks("R-9.1.4.4-01", at="ComponentModule")
def component_module_with_an_empty_name(module: etree._Element) -> None:
    """A component module has an empty name."""
    module.set("name", "")


@breaks("R-9.1.4.4-05", at="StructureField")
def path_through_no_module(field: etree._Element) -> None:
    """The path to the type leads through a module that is not there."""
    field.set("type", f"::{NOWHERE}::{str(field.get('type')).rpartition('::')[2]}")


@keeps("R-9.1.4.4-05", at="StructureField")
def path_from_the_root(field: etree._Element) -> bool:
    """A type of the same module may be named from the root."""
    name = str(field.get("type"))
    if in_the_same_module(field, name, *_DATA_TYPES) is None:
        return False
    modules = [str(around.get("name")) for around in field.iterancestors() if around.tag in _MODULES]
    field.set("type", "".join(f"::{module}" for module in (*reversed(modules), name)))
    return True


@keeps("R-9.1.4.7-01", at="ApplicationModule")
def empty_application_module_inside(module: etree._Element) -> None:
    """Application modules may be nested, and empty."""
    etree.SubElement(module, "ApplicationModule", name="nothing_inside")


@keeps("R-9.1.4.8-01", at="PlatformModule")
def empty_platform_module_inside(module: etree._Element) -> None:
    """Platform modules may be nested, and empty."""
    etree.SubElement(module, "PlatformModule", name="nothing_inside")


@breaks("R-9.1.4.7-02", at="ApplicationModule", under=ELSEWHERE)
def platform_in_an_application(module: etree._Element) -> None:
    """An application module holds a module of a platform."""
    etree.SubElement(module, "InteractionModule", name="nothing_inside")


@breaks("R-9.1.4.8-02", at="PlatformModule", under=ELSEWHERE)
def application_in_a_platform(module: etree._Element) -> None:
    """A platform module holds a module of an application."""
    etree.SubElement(module, "ComponentModule", name="nothing_inside")


@breaks("R-9.2.2.15-03", at="ContractModule", under=ELSEWHERE)
def component_type_among_contracts(module: etree._Element) -> None:
    """A contract module holds a component type."""
    etree.SubElement(module, "ComponentType", name="nothing_inside")


@keeps("R-9.2.2.15-02", at="ContractModule")
def contract_module_inside(module: etree._Element) -> None:
    """Contract modules may be nested."""
    inner = etree.SubElement(module, "ContractModule", name="further_inside")
    etree.SubElement(inner, "PrimitiveBoolean", name="inner_truth")


@breaks("R-9.1.2-05", at="Interface", under=ELSEWHERE)
def parameter_of_an_interface(interface: etree._Element) -> bool:
    """An interface has a configuration parameter."""
    known = next((one for one in module_of(interface) if one.tag in _DATA_TYPES), None)
    if known is None:
        return False
    etree.SubElement(interface, "ConfigurationParameter", name="setting", type=str(known.get("name")))
    return True


@breaks("R-9.2.2.8-02", at="Enumerator", under=ELSEWHERE)
def enumerator_with_an_annotation(enumerator: etree._Element) -> bool:
    """An enumerator carries an annotation."""
    known = module_of(enumerator).find("AnnotationDefinition")
    if known is None:
        return False
    etree.SubElement(enumerator, "Annotation", annotationDefinition=str(known.get("name")))
    return True


@breaks("R-9.2.2.4-02", at="StructureField")
def field_without_type(field: etree._Element) -> None:
    """A field has no type."""
    del field.attrib["type"]


@breaks("R-9.2.2.4-03", at="StructureField")
def field_of_nothing_known(field: etree._Element) -> None:
    """The type of a field is declared nowhere."""
    field.set("type", NOWHERE)


@breaks("R-9.2.2.4-03", at="ConfigurationParameter")
def parameter_of_nothing_known(parameter: etree._Element) -> None:
    """The type of a configuration parameter is declared nowhere."""
    parameter.set("type", NOWHERE)


@breaks("R-9.2.2.4-04", at="StructureField")
def field_of_an_interface(field: etree._Element) -> None:
    """The type of a field is an interface."""
    field.set("type", str(_new(field, "Interface").get("name")))


@breaks("R-9.2.1-07", at="StructureField")
def field_of_an_exception(field: etree._Element) -> None:
    """The type of a field is an exception."""
    field.set("type", str(_new(field, "Exception").get("name")))


@breaks("R-9.2.2.5-01", at="Parameter")
def argument_of_nothing_known(parameter: etree._Element) -> None:
    """The type of a method's parameter is declared nowhere."""
    parameter.set("type", NOWHERE)


@breaks("R-9.2.2.5-02", at="Parameter")
def argument_of_an_exception(parameter: etree._Element) -> None:
    """The type of a method's parameter is an exception."""
    parameter.set("type", str(_new(parameter, "Exception").get("name")))


def _new(element: etree._Element, tag: str) -> etree._Element:
    """A declaration of this kind, new in the module around ``element``."""
    return etree.SubElement(module_of(element), tag, name=f"another_{tag.lower()}")
