"""Edits of atomic implementations and of policies on components and ports (9.5.4)."""

from __future__ import annotations

import copy

from lxml import etree

from ucm_cts.harness.toolchains.corpus.declarations import NOWHERE, path, resolved, spare_data, spare_unlike
from ucm_cts.harness.toolchains.operators.aspects import definition_of
from ucm_cts.harness.toolchains.operators.operator import breaks, keeps

POLICIES = ("ComponentTechnicalPolicy", "ComponentPortTechnicalPolicy")


@keeps("R-9.5.1-03", at="AtomicComponentImplementation")
def implementation_with_a_twin(implementation: etree._Element) -> bool:
    """A component type may have another implementation, with the same policies."""
    twin = copy.deepcopy(implementation)
    twin.set("name", "twin_implementation")
    implementation.addnext(twin)
    for used in twin.findall("TechnicalPolicy"):
        policy = resolved(used, str(used.get("name")), *POLICIES)
        if policy is None:
            return False
        policy.insert(0, etree.Element("ManagedComponent", name=path(twin)))
    return True


@breaks("R-9.5.4.2-01", at=POLICIES)
def policy_of_nobody(policy: etree._Element) -> None:
    """A policy that manages no component."""
    _without(policy, "ManagedComponent")


@breaks("R-9.5.4.2-02", at=POLICIES)
def manages_nothing_known(policy: etree._Element) -> None:
    """One of the managed components is declared nowhere."""
    policy.insert(0, etree.Element("ManagedComponent", name=NOWHERE))


@breaks("R-9.5.4.2-02", at=POLICIES)
def manages_a_component_type(policy: etree._Element) -> bool:
    """One of the managed components is a component type."""
    component = policy.getroottree().getroot().find(".//ComponentType")
    if component is None:
        return False
    policy.insert(0, etree.Element("ManagedComponent", name=path(component)))
    names = {one.get("name") for one in policy.getroottree().getroot().iter("AtomicComponentImplementation")}
    return component.get("name") not in names


@breaks("R-9.5.4.2-03", at="TechnicalPolicy", under=("one-sided-policy-links=refused",))
def named_by_the_policy_only(used: etree._Element) -> bool:
    """The policy manages an implementation that does not name it."""
    implementation = used.getparent()
    if implementation is None:
        return False
    implementation.remove(used)
    return True


@breaks("R-9.5.4.2-08", at=POLICIES)
def value_of_nothing_known(policy: etree._Element) -> None:
    """The definition has no such parameter."""
    name = f"{policy.get('technicalPolicyDefinition')}.{NOWHERE}"
    etree.SubElement(policy, "ConfigurationParameterValue", configurationParameter=name, value="1")


@breaks("R-9.5.4.2-09", at="ConfigurationParameterValue", under=("repeated-parameter-values=refused",))
def parameter_with_two_values(value: etree._Element) -> bool:
    """A parameter of a policy receives two values."""
    policy = value.getparent()
    if policy is None or policy.tag not in POLICIES or not str(value.get("value")).isdigit():
        return False
    again = copy.deepcopy(value)
    again.set("value", "2" if value.get("value") == "1" else "1")
    value.addnext(again)
    return True


@keeps("R-9.5.4.2-07", at="ConfigurationParameterValue")
def parameter_without_value(value: etree._Element) -> bool:
    """A parameter of a policy need not receive a value."""
    policy = value.getparent()
    if policy is None or policy.tag not in POLICIES:
        return False
    policy.remove(value)
    return True


@breaks("R-9.5.4.2-10", at="ComponentTechnicalPolicy")
def component_policy_for_ports(policy: etree._Element) -> bool:
    """The definition is for ports."""
    return _applicable(policy, "onPort")


@breaks("R-9.5.4.3-06", at="ComponentPortTechnicalPolicy")
def port_policy_for_components(policy: etree._Element) -> bool:
    """The definition is for components."""
    return _applicable(policy, "onComponent")


@keeps("R-9.4.3.2-15", at="ComponentTechnicalPolicy")
def component_policy_for_both(policy: etree._Element) -> bool:
    """The definition is for components and ports."""
    return _applicable(policy, "onBoth")


@keeps("R-9.4.3.2-15", at="ComponentPortTechnicalPolicy")
def port_policy_for_both(policy: etree._Element) -> bool:
    """The definition is for ports and components."""
    return _applicable(policy, "onBoth")


def _applicable(policy: etree._Element, applicability: str) -> bool:
    definition = definition_of(policy)
    if definition is None:
        return False
    definition.set("applicability", applicability)
    return True


@breaks("R-9.5.4.2-11", at="AbstractTypeBinding")
def policy_binds_to_another_kind(binding: etree._Element) -> bool:
    """In a policy, an abstract data type stands for an interface, or the other way round."""
    return _actual(binding, spare_unlike(binding, str(binding.get("actualType"))))


@breaks("R-9.5.4.2-11", at="AbstractTypeBinding")
def policy_binds_to_nothing_known(binding: etree._Element) -> bool:
    """In a policy, the actual type is declared nowhere."""
    return _actual(binding, NOWHERE)


def _actual(binding: etree._Element, value: str) -> bool:
    around = binding.getparent()
    binding.set("actualType", value)
    return around is not None and around.tag in POLICIES and bool(value)


@breaks("R-9.5.4.2-11", at="ComponentPortTechnicalPolicy")
def port_policy_binds_to_nothing_known(policy: etree._Element) -> bool:
    """A policy on ports binds a type that is declared nowhere to another."""
    other = spare_data(policy)
    if not other:
        return False
    etree.SubElement(policy, "AbstractTypeBinding", abstractType=NOWHERE, actualType=other)
    return True


@breaks("R-9.5.4.3-02", at="ComponentPortTechnicalPolicy")
def policy_of_no_port(policy: etree._Element) -> None:
    """A port policy that manages no port."""
    _without(policy, "ManagedPort")


@breaks("R-9.5.4.3-03", at="ManagedPort")
def manages_no_port_known(managed: etree._Element) -> None:
    """The component type has no such port."""
    managed.set("name", f"{str(managed.get('name')).rpartition('.')[0]}.{NOWHERE}")


@breaks("R-9.5.4.3-04", at="ManagedPort")
def manages_a_port_of_a_stranger(managed: etree._Element) -> bool:
    """The port belongs to a component type that nothing implements."""
    port = managed.getroottree().getroot().find(".//Port")
    component = port.getparent() if port is not None else None
    if port is None or component is None:
        return False
    stranger = etree.Element("ComponentType", name="unimplemented_type")
    component.addnext(stranger)
    gate = copy.deepcopy(port)
    gate.attrib.pop("refinesPort", "")
    stranger.append(gate)
    managed.set("name", f"{path(stranger)}.{gate.get('name')}")
    return True


def _without(element: etree._Element, tag: str) -> None:
    for child in element.findall(tag):
        element.remove(child)
