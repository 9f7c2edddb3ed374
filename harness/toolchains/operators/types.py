"""Edits of data types and constants (9.2.3 to 9.2.6)."""

from __future__ import annotations

from lxml import etree

from ucm_cts.adapters.contract.metamodel.contracts import INTEGER_RANGES
from ucm_cts.harness.toolchains.operators.modules import without
from ucm_cts.harness.toolchains.operators.operator import breaks, keeps


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
