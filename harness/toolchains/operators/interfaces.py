"""Edits of interfaces, methods, abstract types and annotations (9.2.7 to 9.2.9)."""

from __future__ import annotations

import copy

from lxml import etree

from ucm_cts.harness.toolchains.operators.operator import breaks, keeps


def named(element: etree._Element, tag: str, name: str) -> etree._Element | None:
    """The declaration of this kind and name beside or around ``element``'s owner: in the next enclosing element that has one."""
    around = element.getparent()
    while around is not None:
        for child in around.findall(tag):
            if child.get("name") == name:
                return child
        around = around.getparent()
    return None


def beside(element: etree._Element, tag: str, **attributes: str) -> etree._Element:
    """A new element right after ``element``, in the same owner."""
    new = etree.Element(tag, attributes)
    element.addnext(new)
    return new


@keeps("R-9.2.7-11", at="Method")
def return_first(method: etree._Element) -> bool:
    """The return value may come before all parameters."""
    known, first = method.find("Parameter[@direction='RETURN']"), method.find("Parameter")
    if known is None or first is None or known is first:
        return False
    first.addprevious(known)
    return True


@breaks("R-9.2.7.1-04", at="InheritedInterface", under=("inherited-names=refused",))
def declares_an_inherited_name(inherited: etree._Element) -> bool:
    """The ancestor has a method of that name."""
    owner = inherited.getparent()
    ancestor = named(owner, "Interface", str(inherited.get("interface"))) if owner is not None else None
    theirs = ancestor.find("Method") if ancestor is not None else None
    if owner is None or theirs is None:
        return False
    etree.SubElement(owner, "Method", name=str(theirs.get("name")))
    return True


@keeps("R-9.2.7-12", at="Method")
def raises_a_further_exception(method: etree._Element) -> bool:
    """A method may raise any number of exceptions."""
    interface = method.getparent()
    if interface is None or interface.tag != "Interface":
        return False
    beside(interface, "Exception", name="further_exception")
    etree.SubElement(method, "RaisedException", exception="further_exception")
    return True


@breaks("R-9.2.8-03", at="StructureField", under=("abstract-types-elsewhere=refused",))
def field_of_an_abstract_type(field: etree._Element) -> bool:
    """A field of a type that nothing binds."""
    structure = field.getparent()
    if structure is None:
        return False
    beside(structure, "AbstractDataType", name="never_bound_t")
    field.set("type", "never_bound_t")
    return True


@breaks("R-9.2.9.4-02", at="Annotation")
def value_of_a_strange_parameter(annotation: etree._Element) -> bool:
    """The parameter is one of another definition."""
    known = named(annotation, "AnnotationDefinition", str(annotation.get("annotationDefinition")))
    parameter = known.find("ConfigurationParameter") if known is not None else None
    if known is None or parameter is None:
        return False
    strange = beside(known, "AnnotationDefinition", name="strange_annotation")
    strange.append(copy.deepcopy(parameter))
    name = f"strange_annotation.{parameter.get('name')}"
    values = annotation.findall("ConfigurationParameterValue")
    if not values:
        return False
    values[0].set("configurationParameter", name)
    return True
