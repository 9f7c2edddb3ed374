"""Edits of atomic implementations and of policies on components and ports (9.5.4)."""

from __future__ import annotations

import copy

from lxml import etree

from ucm_cts.harness.toolchains.corpus.declarations import path, resolved
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


@breaks("R-9.5.4.2-01", at="ComponentPortTechnicalPolicy")
def port_policy_of_no_component(policy: etree._Element) -> None:
    """A policy on ports has no managed component, which it inherits from policies on components, and no implementation names it."""
    for managed in policy.findall("ManagedComponent"):
        policy.remove(managed)
    for used in list(policy.getroottree().iter("TechnicalPolicy")):
        around = used.getparent()
        if around is not None and resolved(used, str(used.get("name")), str(policy.tag)) is policy:
            around.remove(used)
