"""Edits of data types and constants (9.2.3 to 9.2.6)."""

from __future__ import annotations

import copy

from lxml import etree

from ucm_cts.adapters.contract.metamodel.contracts import INTEGER_RANGES
from ucm_cts.harness.toolchains.operators.interfaces import beside
from ucm_cts.harness.toolchains.operators.modules import in_the_same_module, module_of
from ucm_cts.harness.toolchains.operators.operator import breaks, keeps


def _integer(element: etree._Element, attribute: str = "type") -> str | None:
    """The kind of the integer type that an attribute of ``element`` names, if it is in the same module."""
    found = in_the_same_module(element, str(element.get(attribute)), "PrimitiveInteger")
    return found.get("kind") if found is not None else None


def _without(element: etree._Element, tag: str) -> None:
    """Remove all children of ``tag``; what is left ends in the line of the last child, which shows where something is missing."""
    for child in element.findall(tag):
        element.remove(child)
    if len(element):
        element[-1].tail = None
    else:
        element.text = None


@keeps("R-9.2.5.1-03", at="StringType")
def unbounded_string(string: etree._Element) -> bool:
    """A string may be unbounded."""
    if any(constant.get("type") == string.get("name") for constant in module_of(string).findall("Constant")):
        return False
    string.set("maxSize", "-1")
    return True


@breaks("R-9.2.4.2-03", at="Alias")
def alias_of_itself(alias: etree._Element) -> None:
    """The alias names itself."""
    alias.set("type", str(alias.get("name")))


@keeps("R-9.2.4.2-02", at="StructureField")
def field_by_way_of_an_alias(field: etree._Element) -> None:
    """An alias may stand for a field's type."""
    etree.SubElement(module_of(field), "Alias", name="by_another_name", type=str(field.get("type")))
    field.set("type", "by_another_name")


@breaks("R-9.2.4.3-02", at="Structure")
def structure_without_fields(structure: etree._Element) -> None:
    """The structure has no field."""
    _without(structure, "StructureField")


@breaks("R-9.2.4.3-05", at="StructureField")
def field_again(field: etree._Element) -> None:
    """The structure has two fields of one name."""
    field.addnext(copy.deepcopy(field))


@breaks("R-9.2.4.3-06", at="Structure")
def structure_of_itself(structure: etree._Element) -> None:
    """The structure contains itself."""
    etree.SubElement(structure, "StructureField", name="itself", type=str(structure.get("name")))


@keeps("R-9.2.4.3-01", at="Structure")
def structure_of_a_further_type(structure: etree._Element) -> None:
    """A structure may have one more field, of a type that is declared last."""
    etree.SubElement(module_of(structure), "PrimitiveBoolean", name="further_truth")
    etree.SubElement(structure, "StructureField", name="further_field", type="further_truth")


@breaks("R-9.2.4.5-02", at="Union")
def union_without_cases(union: etree._Element) -> None:
    """The union has no case."""
    _without(union, "UnionCase")


@breaks("R-9.2.4.5-05", at="Union")
def selector_of_a_boolean(union: etree._Element) -> None:
    """The selector is no enumeration."""
    etree.SubElement(module_of(union), "PrimitiveBoolean", name="selecting_truth")
    union.set("selectorType", "selecting_truth")


@breaks("R-9.2.4.6-02", at="Union")
def case_again(union: etree._Element) -> bool:
    """Two cases have one name."""
    cases = union.findall("UnionCase")
    if len(cases) < 2:
        return False
    cases[-1].set("name", str(cases[0].get("name")))
    return True


@breaks("R-9.2.4.6-03", at="UnionCase")
def case_without_selector_value(case: etree._Element) -> bool:
    """A case that is not the default has no selector value."""
    if case.get("defaultCase") == "true":
        return False
    _without(case, "SelectorValue")
    return True


@breaks("R-9.2.4.6-05", at="Union", under=("repeated-selector-values=refused",))
def selector_value_again(union: etree._Element) -> bool:
    """Two cases have one selector value."""
    values = [value for case in union.findall("UnionCase")[:2] for value in case.findall("SelectorValue")[:1]]
    if len(values) < 2:
        return False
    values[1].set("enumerator", str(values[0].get("enumerator")))
    return True


@breaks("R-9.2.4.6-08", at="Union")
def two_default_cases(union: etree._Element) -> bool:
    """Two cases are the default."""
    cases = union.findall("UnionCase")[:2]
    for case in cases:
        case.set("defaultCase", "true")
    return len(cases) == 2


@breaks("R-9.2.4.7-02", at="Enumeration")
def enumeration_without_enumerators(enumeration: etree._Element) -> bool:
    """The enumeration has no enumerator."""
    if _is_referred_to(enumeration):
        return False
    _without(enumeration, "Enumerator")
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


@breaks("R-9.2.4.9-02", at="Array")
def array_without_dimensions(array: etree._Element) -> None:
    """The array has no dimension."""
    _without(array, "ArrayDimension")


@keeps("R-9.2.4.9-04", at="Array")
def array_of_a_further_dimension(array: etree._Element) -> None:
    """An array may have one more dimension, of another index type."""
    etree.SubElement(array, "ArrayDimension", indexType="UBYTE", size="2")


@breaks("R-9.2.4.9-01", at="Array")
def array_of_itself(array: etree._Element) -> None:
    """The array is its own element."""
    array.set("type", str(array.get("name")))


@breaks("R-9.2.4.11-03", at="ArrayDimension")
def dimension_beyond_its_index(dimension: etree._Element) -> bool:
    """The size is one more than the index type holds."""
    kind = _index_kind(dimension)
    if kind is None:
        return False
    dimension.set("size", str(INTEGER_RANGES[kind][1] + 1))
    return True


@keeps("R-9.2.5.4-03", at="Sequence")
def unbounded_sequence(sequence: etree._Element) -> None:
    """A sequence may be unbounded."""
    sequence.set("maxSize", "-1")


@breaks("R-9.2.6.1-03", at="Constant")
def constant_of_no_syntax(constant: etree._Element) -> bool:
    """The value is nothing that IDL could write."""
    if _integer(constant) is None:
        return False
    constant.set("value", "0x")
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
