"""Edits of data types and constants (9.2.3 to 9.2.6)."""

from __future__ import annotations

from lxml import etree

from ucm_cts.adapters.contract.metamodel.contracts import INTEGER_RANGES
from ucm_cts.harness.toolchains.operators.interfaces import beside
from ucm_cts.harness.toolchains.operators.modules import in_the_same_module, module_of, without
from ucm_cts.harness.toolchains.operators.operator import breaks, keeps


def _integer(element: etree._Element, attribute: str = "type") -> str | None:
    """The kind of the integer type that an attribute of ``element`` names, if it is in the same module."""
    found = in_the_same_module(element, str(element.get(attribute)), "PrimitiveInteger")
    return found.get("kind") if found is not None else None


@breaks("R-9.2.4.7-02", at="Enumeration")
def enumeration_without_enumerators(enumeration: etree._Element) -> bool:
    """The enumeration has no enumerator."""
    if _is_referred_to(enumeration):
        return False
    without(enumeration, "Enumerator")
    return True


def _is_referred_to(declaration: etree._Element) -> bool:
    name = str(declaration.get("name"))
    referring = ("type", "selectorType")
    return any(
        str(element.get(attribute, "")).rpartition("::")[2] == name
        for element in declaration.getroottree().iter(etree.Element)
        for attribute in referring
    )


@breaks("R-9.2.4.8-03", at="Enumerator")
def enumerator_beyond_its_index(enumerator: etree._Element) -> bool:
    """The index value is one more than the index type holds."""
    kind = _index_kind(enumerator)
    if kind is None:
        return False
    enumerator.set("value", str(INTEGER_RANGES[kind][1] + 1))
    return True


@keeps("R-9.2.4.8-03", at="Enumerator")
def enumerator_at_the_bound(enumerator: etree._Element) -> bool:
    """The index value may be the greatest that the index type holds."""
    kind = _index_kind(enumerator)
    most = str(INTEGER_RANGES[kind][1]) if kind in ("BYTE", "UBYTE", "SHORT", "USHORT", "LONG") else ""
    owner = enumerator.getparent()
    if not most or owner is None or any(other.get("value") == most for other in owner):
        return False
    enumerator.set("value", most)
    return True


def _index_kind(part: etree._Element) -> str | None:
    owner = part.getparent() if part.tag == "Enumerator" else part
    kind = str(owner.get("indexType")) if owner is not None else ""
    return kind if kind in INTEGER_RANGES else None


@breaks("R-9.2.4.8-04", at="Enumeration")
def enumerator_again(enumeration: etree._Element) -> bool:
    """Two enumerators have one name."""
    enumerators = enumeration.findall("Enumerator")
    if len(enumerators) < 2 or _is_referred_to(enumeration):
        return False
    enumerators[-1].set("name", str(enumerators[0].get("name")))
    return True


@breaks("R-9.2.4.11-03", at="ArrayDimension")
def dimension_beyond_its_index(dimension: etree._Element) -> bool:
    """The size is one more than the index type holds."""
    kind = _index_kind(dimension)
    if kind is None:
        return False
    dimension.set("size", str(INTEGER_RANGES[kind][1] + 1))
    return True


@breaks("R-9.2.6.1-04", at="PrimitiveInteger")
def constant_beyond_its_type(integer: etree._Element) -> bool:
    """The value of a constant is one more than its type holds."""
    return _constant(integer, 1)


@keeps("R-9.2.6.1-02", at="PrimitiveInteger")
def constant_at_the_bound(integer: etree._Element) -> bool:
    """A constant may have the greatest value that its type holds."""
    return _constant(integer, 0)


def _constant(integer: etree._Element, beyond: int) -> bool:
    """Give a type a constant; another module than a contract module has none."""
    if module_of(integer).tag != "ContractModule":
        return False
    value = INTEGER_RANGES[str(integer.get("kind"))][1] + beyond
    beside(integer, "Constant", name="another_constant", type=str(integer.get("name")), value=str(value))
    return True


@breaks("R-9.2.2.7-01", at="ConfigurationParameter")
def default_beyond_its_type(parameter: etree._Element) -> bool:
    """The default value is one more than the parameter's type holds."""
    kind = _integer(parameter)
    if kind is None:
        return False
    parameter.set("defaultValue", str(INTEGER_RANGES[kind][1] + 1))
    return True
