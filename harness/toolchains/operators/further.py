"""Edits of the last of several elements: a tool chain that checks only the first ones accepts them."""

from __future__ import annotations

import copy

from lxml import etree

from ucm_cts.adapters.contract.metamodel.contracts import INTEGER_RANGES
from ucm_cts.harness.toolchains.corpus.declarations import NOWHERE
from ucm_cts.harness.toolchains.operators.modules import DECLARED, MEMBERS, is_returned, module_of
from ucm_cts.harness.toolchains.operators.operator import breaks

NOT_AGAIN = ("Language", "Enumerator", "Method", "ExceptionField")
"""Whose names have requirements of their own, or none."""


@breaks("R-9.1.4.1-02", at=tuple(tag for tag in DECLARED if tag not in NOT_AGAIN))
def declared_again(element: etree._Element) -> None:
    """Two declarations of one kind have one name."""
    element.addnext(copy.deepcopy(element))


@breaks("R-9.1.4.1-02", at=tuple(tag for tag in MEMBERS if tag not in NOT_AGAIN))
def member_again(element: etree._Element) -> bool:
    """Two members of one kind have one name."""
    if is_returned(element):
        return False
    element.addnext(copy.deepcopy(element))
    return True


@breaks("R-9.2.7.2-03", at="Method")
def further_exception_of_nothing_known(method: etree._Element) -> bool:
    """A method raises two more exceptions, the last of which is declared nowhere."""
    module = module_of(method)
    if module.tag != "ContractModule":
        return False
    etree.SubElement(module, "Exception", name="further_exception")
    etree.SubElement(method, "RaisedException", exception="further_exception")
    etree.SubElement(method, "RaisedException", exception=NOWHERE)
    return True


@breaks("R-9.2.4.11-03", at="Array")
def third_dimension_beyond_its_index(array: etree._Element) -> None:
    """The array has two more dimensions, and the size of the last is more than its index type holds."""
    etree.SubElement(array, "ArrayDimension", indexType="UBYTE", size="2")
    etree.SubElement(array, "ArrayDimension", indexType="UBYTE", size="256")


@breaks("R-9.2.4.8-03", at="Enumeration")
def further_enumerator_beyond_its_index(enumeration: etree._Element) -> bool:
    """The enumeration has one more enumerator, whose value is more than the index type holds."""
    kind = str(enumeration.get("indexType"))
    if kind not in INTEGER_RANGES or len(enumeration.findall("Enumerator")) < 2:
        return False
    value = str(INTEGER_RANGES[kind][1] + 1)
    etree.SubElement(enumeration, "Enumerator", name="enumerator_too_far", value=value)
    return True


@breaks("R-9.1.4.1-02", at="CompositeComponentImplementation")
def last_parts_of_one_name(composite: etree._Element) -> bool:
    """The third part and the fourth have one name."""
    return _two_more_of_one_name(composite, "Part")


@breaks("R-9.1.4.1-02", at="ComponentType")
def last_ports_of_one_name(component: etree._Element) -> bool:
    """The third port and the fourth have one name."""
    return _two_more_of_one_name(component, "Port")


def _two_more_of_one_name(owner: etree._Element, tag: str) -> bool:
    members = owner.findall(tag)
    if len(members) < 2:
        return False
    for _ in range(2):
        again = copy.deepcopy(members[-1])
        again.attrib.pop("refinesPort", "")
        again.set("name", "of_one_name")
        members[-1].addnext(again)
    return True


@breaks("R-9.3.4-01", at="InteractionModule")
def nested_connector_of_nothing_known(module: etree._Element) -> None:
    """A connector in a module of the module implements a pattern that is declared nowhere."""
    nested = etree.SubElement(module, "InteractionModule", name="nested_module")
    etree.SubElement(nested, "ConnectorDefinition", name="nested_connector", pattern=NOWHERE)


@breaks("R-9.5.3.1-11", at="ComponentModule")
def nested_type_refines_itself(module: etree._Element) -> None:
    """A component type in a module of the module refines itself."""
    nested = etree.SubElement(module, "ComponentModule", name="nested_module")
    etree.SubElement(nested, "ComponentType", name="nested_type", refines="nested_type")


@breaks("R-9.4.3.2-03", at="NonfunctionalAspectModule")
def nested_definition_of_nothing_known(module: etree._Element) -> None:
    """A policy definition in a module of the module has an aspect that is declared nowhere."""
    nested = etree.SubElement(module, "NonfunctionalAspectModule", name="nested_module")
    definition = etree.SubElement(nested, "TechnicalPolicyDefinition", name="nested_definition")
    definition.set("technicalAspect", NOWHERE)
    definition.set("applicability", "onComponent")


@breaks(
    "R-9.2.4.3-06",
    at=("ContractModule", "InteractionModule", "NonfunctionalAspectModule", "ComponentModule", "PlatformModule"),
)
def nested_structure_of_itself(module: etree._Element) -> None:
    """A structure in a contract module of the module contains itself."""
    nested = etree.SubElement(module, "ContractModule", name="nested_contracts")
    structure = etree.SubElement(nested, "Structure", name="nested_structure")
    etree.SubElement(structure, "StructureField", name="itself", type="nested_structure")
