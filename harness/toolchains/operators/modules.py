"""Edits of modules, names and paths (9.1), and of what refers to types (9.2.1, 9.2.2)."""

from __future__ import annotations

import re

from lxml import etree

from ucm_cts.harness.toolchains.corpus.declarations import NOWHERE
from ucm_cts.harness.toolchains.operators.operator import breaks, keeps

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
    *(
        "Attribute",
        "Connection",
        "ConnectionEnd",
        "ConnectorPort",
        "Enumerator",
        "ExceptionField",
        "Method",
        "Parameter",
    ),
    *("ConfigurationParameter", "InteractionItem", "InteractionRole", "Part", "Port", "PortElement"),
)
NAMED = (*DECLARED, *MEMBERS)
"""What certainly has a name, besides modules, fields of structures and cases of unions, whose names have requirements of their own."""


def module_of(element: etree._Element) -> etree._Element:
    """The nearest module around ``element``."""
    return next(around for around in element.iterancestors() if around.tag in MODULES)


def in_the_same_module(element: etree._Element, name: str, *tags: str) -> etree._Element | None:
    """The declaration called ``name`` in the module around ``element``, if it is one of ``tags``."""
    return next((one for one in module_of(element) if one.tag in tags and one.get("name") == name), None)


def without(element: etree._Element, tag: str) -> None:
    """Remove all children of ``tag``; what is left ends in the line of the last child, which shows where something is missing."""
    for child in element.findall(tag):
        element.remove(child)
    if len(element):
        element[-1].tail = None
    else:
        element.text = None


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
