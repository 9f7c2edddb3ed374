"""Edits of component modules, component types and ports (9.5.2 and 9.5.3)."""

from __future__ import annotations

import copy
from collections.abc import Callable, Iterable

from lxml import etree

from ucm_cts.harness.toolchains.corpus import declarations as decl
from ucm_cts.harness.toolchains.operators.operator import breaks, keeps


@keeps("R-9.5.2.1-01", at="ComponentModule")
def first_of_components_last(module: etree._Element) -> bool:
    """What is used may be declared after it, whatever kind it is of."""
    if len(module) < 2:
        return False
    module.append(module[0])
    return True


@keeps("R-9.5.2.1-02", at="ComponentModule")
def submodule_of_components(module: etree._Element) -> None:
    """A module may contain an empty one of its own kind."""
    etree.SubElement(module, "ComponentModule", name="spare_components")


@keeps("R-9.5.2.2-02", at="ComponentType")
def annotated_component_type(component: etree._Element) -> bool:
    """A component type may have an annotation."""
    return _annotated(component)


@keeps("R-9.5.3.2-07", at="Port")
def annotated_port(port: etree._Element) -> bool:
    """A port may have an annotation."""
    return _annotated(port)


def _annotated(element: etree._Element) -> bool:
    definition = decl.spare(element, "AnnotationDefinition")
    element.insert(0, etree.Element("Annotation", annotationDefinition=definition))
    return bool(definition)


@breaks("R-9.5.3.1-04", at="ComponentType")
def refines_no_component_type_known(component: etree._Element) -> bool:
    """What is refined is declared nowhere."""
    if component.get("refines"):
        return False
    component.set("refines", decl.NOWHERE)
    return True


@keeps("R-9.5.3.1-04", at="ComponentType")
def refined_component_type(component: etree._Element) -> None:
    """A component type may be refined by one that adds nothing."""
    _child(component, "refining_type")


@breaks("R-9.5.3.1-08", at="ComponentType")
def port_called_like_an_inherited_one(component: etree._Element) -> bool:
    """The ancestor has a port of that name, which is not refined."""
    return _taken_over(component, "Port")


@breaks("R-9.5.3.1-09", at="ComponentType")
def attribute_called_like_an_inherited_one(component: etree._Element) -> bool:
    """The ancestor has an attribute of that name."""
    return _taken_over(component, "Attribute")


def _taken_over(component: etree._Element, tag: str) -> bool:
    known = component.find(tag)
    if known is None:
        return False
    taken = copy.deepcopy(known)
    taken.attrib.pop("refinesPort", "")
    _child(component, "clashing_type").append(taken)
    return True


@breaks("R-9.5.3.1-11", at="ComponentType")
def refines_itself(component: etree._Element) -> None:
    """The component type is its own ancestor."""
    component.set("refines", decl.path(component))


@breaks("R-9.5.3.2-01", at="Port")
def no_specification(port: etree._Element) -> None:
    """A port without specification."""
    for spec in _specs(port):
        port.remove(spec)


@breaks("R-9.5.3.2-02", at="Port")
def second_specification(port: etree._Element) -> None:
    """A port with two specifications."""
    for spec in _specs(port):
        spec.addnext(copy.deepcopy(spec))


def _specs(port: etree._Element) -> list[etree._Element]:
    return [*port.findall("PortTypeSpec"), *port.findall("PortRoleSpec")]


@breaks("R-9.5.3.2-04", at="Port")
def refines_itself_as_a_port(port: etree._Element) -> bool:
    """The refined port belongs to the same type and to no ancestor."""
    component = port.getparent()
    if component is None or port.get("refinesPort"):
        return False
    port.set("refinesPort", f"{decl.path(component)}.{port.get('name')}")
    return True


@keeps("R-9.5.3.2-05", at="ComponentType")
def port_refined_under_its_name(component: etree._Element) -> bool:
    """A port may refine an inherited one and be called like it."""
    return _refining(component, lambda name: (name,))


@keeps("R-9.5.3.2-06", at="ComponentType")
def port_broken_down(component: etree._Element) -> bool:
    """A port may be refined by two others."""
    return _refining(component, lambda name: (f"{name}_first_half", f"{name}_second_half"))


def _refining(component: etree._Element, names: Callable[[str], Iterable[str]]) -> bool:
    port = component.find("Port")
    if port is None or port.get("refinesPort"):
        return False
    child = _child(component, "type_with_refined_port")
    for name in names(str(port.get("name"))):
        refining = copy.deepcopy(port)
        refining.set("name", name)
        refining.set("refinesPort", f"{decl.path(component)}.{port.get('name')}")
        child.append(refining)
    return True


def _child(component: etree._Element, name: str) -> etree._Element:
    child = etree.Element("ComponentType", name=name, refines=decl.path(component))
    component.addnext(child)
    return child


@breaks("R-9.5.3.4-01", at="PortRoleSpec")
def role_of_nothing_known(spec: etree._Element) -> None:
    """The pattern has no such role."""
    spec.set("role", f"{str(spec.get('role')).rpartition('.')[0]}.{decl.NOWHERE}")


@breaks("R-9.5.3.4-02", at="InteractionItemBinding", under=("partial-role-bindings=refused",))
def item_without_type(binding: etree._Element) -> bool:
    """An item that the role involves is not bound."""
    spec = binding.getparent()
    role = (
        decl.member(spec, str(spec.get("role")), "InteractionPattern", "InteractionRole") if spec is not None else None
    )
    item = str(binding.get("item")).rpartition(".")[2]
    if spec is None or role is None or role.find(f"InvolvedItem[@item='{item}']") is None:
        return False
    spec.remove(binding)
    return True


@breaks("R-9.5.3.5-01", at="InteractionItemBinding")
def item_of_nothing_known(binding: etree._Element) -> None:
    """The pattern has no such item."""
    again = copy.deepcopy(binding)
    again.set("item", f"{str(binding.get('item')).rpartition('.')[0]}.{decl.NOWHERE}")
    binding.addnext(again)


@breaks("R-9.5.3.5-03", at="InteractionItemBinding", under=("abstract-actual-types=refused",))
def item_stands_for_something_abstract(binding: etree._Element) -> bool:
    """The actual type is abstract."""
    interface = decl.is_interface(binding, str(binding.get("actualType")))
    return _with(binding, "actualType", decl.spare(binding, "AbstractInterface" if interface else "AbstractDataType"))


@breaks("R-9.5.3.5-04", at="InteractionItemBinding")
def item_stands_for_another_nature(binding: etree._Element) -> bool:
    """A data item stands for an interface, or the other way round."""
    return _with(binding, "actualType", decl.spare_unlike(binding, str(binding.get("actualType"))))


@breaks("R-9.5.3.5-05", at="InteractionItemBinding", under=("repeated-item-bindings=refused",))
def item_stands_for_two_types(binding: etree._Element) -> bool:
    """One item has two actual types."""
    return _again(binding)


@breaks("R-9.5.3.6-02", at="AbstractTypeBinding", under=("missing-type-bindings=check",))
def nothing_stands_for_an_abstract_type(binding: etree._Element) -> bool:
    """An abstract type of the port is not bound."""
    spec = binding.getparent()
    if spec is None or spec.tag != "PortTypeSpec":
        return False
    spec.remove(binding)
    return True


@breaks("R-9.5.3.7-01", at="AbstractTypeBinding")
def binds_no_abstract_type(binding: etree._Element) -> bool:
    """What is bound is concrete."""
    return _in_port(binding) and _with(
        binding, "abstractType", decl.spare_like(binding, str(binding.get("abstractType")))
    )


@breaks("R-9.5.3.7-02", at="PortTypeSpec", under=("unused-bindings=refused",))
def binds_an_abstract_type_of_nobody(spec: etree._Element) -> bool:
    """The port type does not use what is bound."""
    abstract, actual = decl.spare(spec, "AbstractInterface"), decl.spare(spec, "Interface")
    etree.SubElement(spec, "AbstractTypeBinding", abstractType=abstract, actualType=actual)
    return bool(actual)


@breaks("R-9.5.3.7-03", at="AbstractTypeBinding")
def stands_for_nothing_known(binding: etree._Element) -> bool:
    """The actual type is declared nowhere."""
    return _in_port(binding) and _with(binding, "actualType", decl.NOWHERE)


@breaks("R-9.5.3.7-04", at="AbstractTypeBinding")
def stands_for_another_kind(binding: etree._Element) -> bool:
    """An abstract data type stands for an interface, or the other way round."""
    return _in_port(binding) and _with(
        binding, "actualType", decl.spare_unlike(binding, str(binding.get("actualType")))
    )


@breaks("R-9.5.3.7-05", at="AbstractTypeBinding")
def stands_for_two_types(binding: etree._Element) -> bool:
    """One abstract type has two actual types."""
    return _in_port(binding) and _again(binding)


def _in_port(binding: etree._Element) -> bool:
    around = binding.getparent()
    return around is not None and around.tag == "PortTypeSpec"


def _with(binding: etree._Element, attribute: str, value: str) -> bool:
    binding.set(attribute, value)
    return bool(value)


def _again(binding: etree._Element) -> bool:
    """Bind the same to another type of the same kind."""
    other = decl.spare_like(binding, str(binding.get("actualType")))
    again = copy.deepcopy(binding)
    again.set("actualType", other)
    binding.addnext(again)
    return bool(other)
