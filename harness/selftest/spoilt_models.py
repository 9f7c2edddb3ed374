"""Mutants of core models: every way to spoil one element of the suite's models, and the requirement that it breaks."""

from __future__ import annotations

import copy
import functools
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from lxml import etree

from ucm_cts.harness.models.comparing import Declaration
from ucm_cts.harness.models.core_models import CORE, ModelResult, Statement, compare, core_catalogue

PRINTED = {
    "kind": "BYTE SHORT LONG ULONG PROVIDED REQUIRED",
    "direction": "IN OUT INOUT RETURN",
    "nature": "DATA INTERFACE",
    "applicability": "onComponent onPort onBoth",
    "multiplicity": "anyNumber atMostOne exactlyOne atLeastOne",
    "indexType": "SHORT LONG nothing_such",
    "lowerMultiplicity": "0 2 -1",
    "upperMultiplicity": "0 2",
    "value": "7 -1",
}
ALLOWED = {
    ("R-10.1.4.2-30", "applicability", "onComponent"),
    ("R-10.1.5.2-15", "api", None),
    ("R-10.1.5.2-16", "api", None),
}
"""Changes that are readings."""

CHILDREN = {
    "Interface": "Method Attribute",
    "Method": "Parameter RaisedException",
    "Structure": "StructureField",
    "Enumeration": "Enumerator",
    "TechnicalPolicyDefinition": "PortElement ConfigurationParameter",
    "TemplatedPort": "PortElement",
    "InteractionPattern": "InteractionRole InteractionItem",
    "InteractionRole": "InvolvedItem",
    "ConnectorDefinition": "ConnectorPortDefinition ItemBinding ConfigurationParameter",
    "ContractModule": "NativeType",
}
IN_GENERAL = {"Attribute": "R-10.1.1-05", "ConfigurationParameter": "R-10.1-02", "NativeType": "R-10.1.1-02"}
IN_PARTICULAR = {
    ("comm_ecode", "Enumerator"): "R-10.1.2-04",
    ("log_severity_t", "Enumerator"): "R-10.1.4.2-38",
    ("run", "Parameter"): "R-10.1.3.1-10",
    ("run", "RaisedException"): "R-10.1.3.1-10",
    ("protected_active_component", "PortElement"): "R-10.1.3.1-07",
    ("protected_passive_component", "PortElement"): "R-10.1.3.2-18",
    ("unprotected_passive_component", "PortElement"): "R-10.1.3.2-22",
    ("port_trace", "PortElement"): "R-10.1.4.2-30",
    ("clock_service_intf", "Method"): "R-10.1.4.1-07",
    ("service_interaction_pattern", "InteractionRole"): "R-10.1.5.1-02",
    ("message_interaction_pattern", "InteractionRole"): "R-10.1.6.1-02",
    ("simple_message_connector", "ConnectorPortDefinition"): "R-10.1.6.1-11",
    ("message_emitter_port", "PortElement"): "R-10.1.6.1-13",
    ("message_receiver_port", "PortElement"): "R-10.1.6.1-15",
    ("message_intf", "Method"): "R-10.1.6.1-18",
}


@dataclass
class Mutation:
    """``change`` spoils an element; this breaks ``requirement``, and leaves it unclear if it is not ``clear``."""

    what: str
    requirement: str
    change: Callable[[etree._Element], object]
    clear: bool = True


def mutations(element: etree._Element, requirement: str) -> Iterator[Mutation]:
    """All ways to spoil ``element``, which is the matter of ``requirement``."""
    if element.get("name") != "log_severity_enumerator_t":
        yield Mutation("dropped", requirement, drop)
        yield Mutation("Union", requirement, lambda e: setattr(e, "tag", "Union"))
        yield Mutation("Oddity", requirement, lambda e: setattr(e, "tag", "Oddity"), clear=False)
    for attribute in map(str, element.attrib):
        if attribute == "name" and element.get("name") == "log_severity_enumerator_t":
            continue
        values = PRINTED.get(attribute, "nothing_such ::clock_api::clock").split()
        for value in (None, *values):
            same = value == element.get(attribute) or (requirement, attribute, value) in ALLOWED
            if not same:
                yield Mutation(f"{attribute}={value}", requirement, partial(put, attribute=attribute, value=value))
        if attribute in ("kind", "direction", "nature", "applicability", "multiplicity"):
            odd = partial(put, attribute=attribute, value="oddity")
            yield Mutation(f"{attribute}=oddity", requirement, odd, clear=False)
    for tag in CHILDREN.get(str(element.tag), "").split():
        owner = IN_PARTICULAR.get((str(element.get("name", "")), tag)) or IN_GENERAL.get(tag, "R-10.1-03")
        yield Mutation(f"with {tag}", owner, partial(add, tag=tag))
    if element.tag in ("Interface", "TechnicalPolicyDefinition"):
        yield Mutation("extends", "R-10.1-03", lambda e: e.set("extends", "::more"))
    if len(_ordered(element)) > 1:
        yield Mutation("turned round", requirement, turn_round)
    if element.getparent() is not None and element.tag == "Method":
        yield Mutation("twice", requirement, twice)


def _ordered(element: etree._Element) -> list[etree._Element]:
    return [e for e in element if e.tag in ("StructureField", "Enumerator") or e.get("direction") == "IN"]


def add(element: etree._Element, tag: str) -> None:
    element.append(etree.Element(tag, name="more"))


def turn_round(element: etree._Element) -> None:
    element.append(_ordered(element)[0])


def drop(element: etree._Element) -> None:
    parent = element.getparent()
    if parent is not None:
        parent.remove(element)
    else:
        element.tag = "ComponentModule"
        element.clear()


def put(element: etree._Element, attribute: str, value: str | None) -> None:
    if value is None:
        del element.attrib[attribute]
    else:
        element.set(attribute, value)


def twice(element: etree._Element) -> None:
    other = copy.deepcopy(element)
    other.append(etree.Element("Constant", name="more"))
    element.addnext(other)


def spoilt(folder: Path, file: str, place: str, change: Callable[[etree._Element], object]) -> Path:
    """A copy of our models in ``folder`` with one element changed."""
    for path in CORE.glob("*.xml"):
        tree = etree.parse(path)
        if path.name == file:
            change(_at(tree, place))
        tree.write(folder / path.name)
    return folder


@functools.cache
def declarations() -> Mapping[str, Declaration]:
    """The declarations of clause 10.1, by requirement."""
    return {declaration.requirement: declaration for declaration in core_catalogue().declarations}


def statements() -> Mapping[str, Statement]:
    """What clause 10.1 says of several declarations, by the requirements that say it."""
    return {statement.requirement: statement for statement in core_catalogue().statements if statement.of}


def element_of(declaration: Declaration) -> etree._Element:
    """Where it stands in our own models."""
    return _at(_tree_of(declaration.file), declaration.place)


def repeating(requirement: str) -> set[str]:
    """The statements that repeat ``requirement``."""
    return {statement.requirement for statement in core_catalogue().statements if requirement in statement.of}


@functools.cache
def spoilt_results(requirement: str) -> Sequence[tuple[Mutation, Mapping[str, ModelResult]]]:
    """Every way to spoil the declaration of ``requirement``, with its results."""
    declaration = declarations()[requirement]
    outcomes = []
    with TemporaryDirectory() as folder:
        for mutation in mutations(element_of(declaration), requirement):
            path = spoilt(Path(folder), declaration.file, declaration.place, mutation.change)
            outcomes.append((mutation, {r.requirement: r for r in compare([path]).results}))
    return outcomes


def _at(tree: etree._ElementTree, place: str) -> etree._Element:
    found: Any = tree.xpath(place)
    (element,) = found
    assert isinstance(element, etree._Element)
    return element


@functools.cache
def _tree_of(file: str) -> etree._ElementTree:
    return etree.parse(CORE / file)
