"""Edits of nonfunctional aspect modules, technical aspects, policy definitions and languages (9.4)."""

from __future__ import annotations

import copy

from lxml import etree

from ucm_cts.harness.toolchains.corpus.declarations import NOWHERE, path, resolved
from ucm_cts.harness.toolchains.operators.operator import breaks, keeps

ELSEWHERE = ("declarations-elsewhere=refused",)


@keeps("R-9.4.2.1-02", at="NonfunctionalAspectModule")
def submodule_of_aspects(module: etree._Element) -> None:
    """A module may contain an empty one of its own kind."""
    etree.SubElement(module, "NonfunctionalAspectModule", name="spare_aspects")


@keeps("R-9.4.2.1-03", at="NonfunctionalAspectModule")
def submodule_of_contracts(module: etree._Element) -> None:
    """A module may contain another contract module."""
    etree.SubElement(module, "ContractModule", name="spare_contracts_of_aspects")


@keeps("R-9.4.3.4-02", at="NonfunctionalAspectModule")
def first_of_aspects_last(module: etree._Element) -> bool:
    """What is used may be declared after it, whatever kind it is of."""
    if len(module) < 2:
        return False
    module.append(module[0])
    return True


@breaks("R-9.4.2.1-04", at="ProgrammingLanguages")
def second_list_of_languages(languages: etree._Element) -> None:
    """The module has two lists of languages."""
    again = etree.Element("ProgrammingLanguages")
    etree.SubElement(again, "Language", name="Fortran")
    languages.addnext(again)


@breaks("R-9.4.1-03", at="TechnicalAspect", under=("missing-policies=check",))
def nothing_where_one_is_wanted(aspect: etree._Element) -> bool:
    """An implementation has no policy of an aspect that wants exactly one."""
    return aspect.get("multiplicity") == "exactlyOne" and _bare_implementation(aspect)


@breaks("R-9.4.3.1-06", at="TechnicalAspect", under=("missing-policies=check",))
def nothing_where_some_are_wanted(aspect: etree._Element) -> bool:
    """An implementation has no policy of an aspect that wants at least one."""
    return aspect.get("multiplicity") == "atLeastOne" and _bare_implementation(aspect)


def _bare_implementation(aspect: etree._Element) -> bool:
    known = aspect.getroottree().getroot().find(".//AtomicComponentImplementation")
    if known is None:
        return False
    bare = etree.Element(
        "AtomicComponentImplementation",
        name="bare_implementation",
        type=str(known.get("type")),
        language=str(known.get("language")),
    )
    known.addnext(bare)
    return True


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


@breaks("R-9.4.3.2-09", at="TechnicalPolicyDefinition")
def definition_extends_nothing_known(definition: etree._Element) -> bool:
    """What is extended is declared nowhere."""
    if definition.get("extends"):
        return False
    definition.set("extends", NOWHERE)
    return True


@keeps("R-9.4.3.2-09", at="TechnicalPolicyDefinition")
def definition_with_a_child(definition: etree._Element) -> None:
    """A policy definition may be extended by one that adds nothing."""
    _child(definition, "child_definition")


@breaks("R-9.4.3.2-12", at="TechnicalPolicyDefinition")
def redefined_port_element(definition: etree._Element) -> bool:
    """The ancestor has that port element already."""
    return _redefined(definition, "PortElement")


@breaks("R-9.4.3.2-13", at="TechnicalPolicyDefinition")
def redefined_parameter(definition: etree._Element) -> bool:
    """The ancestor has that parameter already."""
    return _redefined(definition, "ConfigurationParameter")


def _redefined(definition: etree._Element, tag: str) -> bool:
    known = definition.find(tag)
    if known is None:
        return False
    _child(definition, "redefining_definition").append(copy.deepcopy(known))
    return True


def _child(definition: etree._Element, name: str) -> etree._Element:
    child = etree.Element("TechnicalPolicyDefinition", name=name, extends=path(definition))
    for attribute in ("technicalAspect", "applicability"):
        child.set(attribute, str(definition.get(attribute)))
    definition.addnext(child)
    return child


@breaks("R-9.4.3.2-14", at="TechnicalPolicyDefinition")
def definition_extends_itself(definition: etree._Element) -> None:
    """The definition is its own ancestor."""
    definition.set("extends", path(definition))


@keeps("R-9.4.3.4-04", at="TechnicalPolicyDefinition")
def port_elements_before_parameters(definition: etree._Element) -> bool:
    """The order of port elements and parameters means nothing."""
    if definition.find("PortElement") is None or definition.find("ConfigurationParameter") is None:
        return False
    for parameter in definition.findall("ConfigurationParameter"):
        definition.append(parameter)
    return True


@breaks("R-9.4.4.1-01", at="ProgrammingLanguages")
def no_language_at_all(languages: etree._Element) -> None:
    """The list of languages is empty."""
    for language in languages.findall("Language"):
        languages.remove(language)


@keeps("R-9.4.4.1-01", at="ProgrammingLanguages")
def one_more_language(languages: etree._Element) -> None:
    """A language may be listed that no implementation uses."""
    etree.SubElement(languages, "Language", name="Fortran")
