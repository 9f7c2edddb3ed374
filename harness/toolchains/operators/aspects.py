"""Edits of nonfunctional aspect modules, technical aspects, policy definitions and languages (9.4)."""

from __future__ import annotations

from lxml import etree

from ucm_cts.harness.toolchains.corpus.declarations import path, resolved
from ucm_cts.harness.toolchains.operators.operator import breaks


@breaks("R-9.4.1-04", at="AtomicComponentImplementation")
def two_where_one_is_wanted(implementation: etree._Element) -> bool:
    """An implementation has two policies of an aspect that wants exactly one."""
    return _second_policy(implementation, "exactlyOne")


@breaks("R-9.4.3.1-05", at="AtomicComponentImplementation")
def two_where_one_is_allowed(implementation: etree._Element) -> bool:
    """An implementation has two policies of an aspect that allows one."""
    return _second_policy(implementation, "atMostOne")


def _second_policy(implementation: etree._Element, multiplicity: str) -> bool:
    """Give ``implementation`` a policy of another definition of an aspect of which it has one already."""
    for used in implementation.findall("TechnicalPolicy"):
        policy = resolved(used, str(used.get("name")), "ComponentTechnicalPolicy", "ComponentPortTechnicalPolicy")
        definition = definition_of(policy) if policy is not None else None
        aspect = (
            resolved(definition, str(definition.get("technicalAspect")), "TechnicalAspect")
            if definition is not None
            else None
        )
        if policy is None or definition is None or aspect is None or aspect.get("multiplicity") != multiplicity:
            continue
        other = etree.Element(
            "TechnicalPolicyDefinition",
            name="another_definition",
            technicalAspect=path(aspect),
            applicability="onComponent",
        )
        definition.addnext(other)
        second = etree.Element("ComponentTechnicalPolicy", name="another_policy", technicalPolicyDefinition=path(other))
        etree.SubElement(second, "ManagedComponent", name=path(implementation))
        policy.addnext(second)
        used.addnext(etree.Element("TechnicalPolicy", name=path(second)))
        return True
    return False


def definition_of(policy: etree._Element) -> etree._Element | None:
    """The policy definition that a policy on components or ports uses."""
    return resolved(policy, str(policy.get("technicalPolicyDefinition")), "TechnicalPolicyDefinition")
