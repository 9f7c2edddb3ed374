"""Edits of modules, names and paths (9.1), and of what refers to types (9.2.1, 9.2.2)."""

from __future__ import annotations

import re

from lxml import etree

from ucm_cts.harness.toolchains.corpus.declarations import NOWHERE
from ucm_cts.harness.toolchains.operators.interfaces import beside
from ucm_cts.harness.toolchains.operators.operator import breaks, keeps

ELSEWHERE = ("declarations-elsewhere=refused",)
_DATA_TYPES = ("PrimitiveInteger", "PrimitiveFloat", "PrimitiveChar", "PrimitiveBoolean", "StringType")
MODULES = (
    "ApplicationModule",
    "PlatformModule",
    "ContractModule",
    "InteractionModule",
    "NonfunctionalAspectModule",
    "ComponentModule",
)
DECLARED = (
    *(*_DATA_TYPES, "Alias", "Array", "Enumeration", "NativeType", "Sequence", "Structure", "Union"),
    *("AbstractDataType", "AbstractInterface", "AnnotationDefinition", "Constant", "Exception", "Interface"),
    *("ConnectorDefinition", "InteractionPattern", "PortType"),
    *("Language", "TechnicalAspect", "TechnicalPolicyDefinition"),
    *("AtomicComponentImplementation", "ComponentType", "CompositeComponentImplementation"),
    *("ComponentPortTechnicalPolicy", "ComponentTechnicalPolicy"),
)
MEMBERS = (
    *("Attribute", "Enumerator", "ExceptionField", "Method", "Parameter"),
    *("ConfigurationParameter", "InteractionItem", "InteractionRole", "Part", "Port", "PortElement"),
)
NAMED = (*DECLARED, *MEMBERS)
"""What certainly has a name, besides modules, fields of structures and cases of unions, whose names have requirements of their own."""

OF_DATA_TYPES = (
    *("Alias", "Array", "Constant", "Sequence"),
    *("ConfigurationParameter", "ExceptionField", "StructureField", "UnionCase"),
)
OF_TYPES = ("Attribute", "Parameter")


def module_of(element: etree._Element) -> etree._Element:
    """The nearest module around ``element``."""
    return next(around for around in element.iterancestors() if around.tag in MODULES)


def in_the_same_module(element: etree._Element, name: str, *tags: str) -> etree._Element | None:
    """The declaration called ``name`` in the module around ``element``, if it is one of ``tags``."""
    return next((one for one in module_of(element) if one.tag in tags and one.get("name") == name), None)


@breaks("R-9.1.4.1-01", at=NAMED)
def without_name(element: etree._Element) -> bool:
    """It has no name."""
    if _is_named_elsewhere(element) or is_returned(element):
        return False
    del element.attrib["name"]
    return True


@breaks("R-9.1.4.1-01", at=NAMED)
def with_an_empty_name(element: etree._Element) -> bool:
    """Its name is empty."""
    if _is_named_elsewhere(element) or is_returned(element):
        return False
    element.set("name", "")
    return True


def _is_named_elsewhere(element: etree._Element) -> bool:
    """Whether another element may mean it, so that two things would be wrong without its name."""
    name = str(element.get("name"))
    others = (one for one in element.getroottree().iter() if one is not element)
    return any(name in re.split(r"[^\w-]+", str(value)) for one in others for value in one.attrib.values())


def is_returned(element: etree._Element) -> bool:
    """What a method returns is its only parameter of that direction."""
    return str(element.get("direction")).lower() == "return"


@breaks("R-9.1.4.1-02", at="PrimitiveInteger")
def integer_and_boolean_of_one_name(integer: etree._Element) -> None:
    """The module has two data types of one name, although of two sorts."""
    beside(integer, "PrimitiveBoolean", name=str(integer.get("name")))


@keeps("R-9.1.4.1-03", at="PrimitiveInteger")
def same_name_in_a_module_of_its_own(integer: etree._Element) -> None:
    """Another module may declare a data type of the same name."""
    module = beside(integer, "ContractModule", name="another_place")
    etree.SubElement(module, "PrimitiveBoolean", name=str(integer.get("name")))


@breaks("R-9.1.4.4-01", at=MODULES)
def module_without_name(module: etree._Element) -> bool:
    """A module has no name."""
    if _is_named_elsewhere(module):
        return False
    del module.attrib["name"]
    return True


@breaks("R-9.1.4.4-01", at=MODULES)
def module_with_an_empty_name(module: etree._Element) -> bool:
    """A module has an empty name."""
    if _is_named_elsewhere(module):
        return False
    module.set("name", "")
    return True


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
    modules = [str(around.get("name")) for around in field.iterancestors() if around.tag in MODULES]
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


@breaks("R-9.2.2.4-02", at=OF_DATA_TYPES)
def of_no_type(element: etree._Element) -> None:
    """It has no type."""
    del element.attrib["type"]


@breaks("R-9.2.2.4-03", at=OF_DATA_TYPES)
def of_a_data_type_not_known(element: etree._Element) -> None:
    """Its type is declared nowhere."""
    element.set("type", NOWHERE)


@breaks("R-9.2.2.4-04", at=OF_DATA_TYPES)
def of_an_interface(element: etree._Element) -> bool:
    """Its type is an interface, where a data type is asked for."""
    return _change_type(element, "Interface")


@breaks("R-9.2.1-07", at=OF_DATA_TYPES)
def of_an_exception(element: etree._Element) -> bool:
    """Its type is an exception."""
    return _change_type(element, "Exception")


@breaks("R-9.2.2.5-02", at=OF_TYPES)
def of_what_is_no_type(element: etree._Element) -> bool:
    """Its type is an exception."""
    return _change_type(element, "Exception")


def _change_type(element: etree._Element, tag: str) -> bool:
    """Make a declaration of this kind the type of ``element``, if there may be one beside it."""
    module = module_of(element)
    if module.tag != "ContractModule":
        return False
    etree.SubElement(module, tag, name=f"another_{tag.lower()}")
    element.set("type", f"another_{tag.lower()}")
    return True
