"""Circles of four: whatever must not lead back to itself must not do so by way of three others either."""

from __future__ import annotations

from collections.abc import Iterator

from lxml import etree

from ucm_cts.harness.toolchains.operators.operator import breaks

AROUND = ("first", "second", "third", "fourth")


def _declared(module: etree._Element, tag: str, **attributes: str) -> Iterator[tuple[etree._Element, str]]:
    """Four new declarations, each with the name of the next, the last with that of the first."""
    for at, name in enumerate(AROUND):
        new = etree.SubElement(module, tag, name=f"{name}_in_a_circle", attrib=attributes)
        yield new, f"{AROUND[(at + 1) % len(AROUND)]}_in_a_circle"


@breaks("R-9.2.4.2-03", at="ContractModule")
def aliases_in_a_circle(module: etree._Element) -> None:
    """Four aliases name each other in a circle."""
    for alias, following in _declared(module, "Alias"):
        alias.set("type", following)


@breaks("R-9.2.4.3-06", at="ContractModule")
def structures_in_a_circle(module: etree._Element) -> None:
    """Four structures contain each other in a circle."""
    for structure, following in _declared(module, "Structure"):
        etree.SubElement(structure, "StructureField", name="field", type=following)


@breaks("R-9.2.4.9-01", at="ContractModule")
def arrays_in_a_circle(module: etree._Element) -> None:
    """Four arrays have each other as elements in a circle."""
    for array, following in _declared(module, "Array"):
        array.set("type", following)
        etree.SubElement(array, "ArrayDimension", indexType="ULONG", size="2")


@breaks("R-9.2.7.1-05", at="ContractModule")
def interfaces_in_a_circle(module: etree._Element) -> None:
    """Four interfaces inherit from each other in a circle."""
    for interface, following in _declared(module, "Interface"):
        etree.SubElement(interface, "InheritedInterface", interface=following)


@breaks("R-9.3.3.2-06", at="InteractionModule")
def patterns_in_a_circle(module: etree._Element) -> None:
    """Four patterns extend each other in a circle."""
    for pattern, following in _declared(module, "InteractionPattern"):
        pattern.set("extends", following)
        role = etree.SubElement(pattern, "InteractionRole", name=f"role_beside_{following}")
        role.set("lowerMultiplicity", "0")
        role.set("upperMultiplicity", "-1")


@breaks("R-9.4.3.2-14", at="TechnicalPolicyDefinition")
def definitions_in_a_circle(definition: etree._Element) -> None:
    """Four policy definitions extend each other in a circle."""
    module = definition.getparent()
    assert module is not None
    shared = {key: str(definition.get(key)) for key in ("technicalAspect", "applicability") if definition.get(key)}
    for new, following in _declared(module, "TechnicalPolicyDefinition", **shared):
        new.set("extends", following)


@breaks("R-9.5.3.1-11", at="ComponentModule")
def types_in_a_circle(module: etree._Element) -> None:
    """Four component types refine each other in a circle."""
    for component, following in _declared(module, "ComponentType"):
        component.set("refines", following)


@breaks("R-9.5.5.3-04", at="ComponentModule")
def composites_in_a_circle(module: etree._Element) -> None:
    """Four composites are parts of each other in a circle."""
    etree.SubElement(module, "ComponentType", name="of_all_in_the_circle")
    for composite, following in _declared(module, "CompositeComponentImplementation", type="of_all_in_the_circle"):
        etree.SubElement(composite, "Part", name="part", instanceOf=following)
