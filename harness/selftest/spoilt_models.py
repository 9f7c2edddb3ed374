"""Mutants of models: every way to spoil one element of the suite's models, and the requirement that it breaks."""

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

from ucm_cts.harness.catalogue.requirements import claims_of, load_requirements
from ucm_cts.harness.models.core_models import CORE, CORE_MODELS, OWN_MODELS, ModelResult, Models, Statement, compare

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
    "mode": "READ READWRITE",
    "charBase": "CHAR8 CHAR32",
    "maxSize": "255",
}
ALLOWED = {
    ("R-10.1.4.2-30", "applicability", "onComponent"),
    ("R-10.1.5.2-15", "api", None),
    ("R-10.1.5.2-16", "api", None),
    ("R-10.2-04", "maxSize", None),
    ("R-10.3.1-08", "maxSize", None),
}
"""Changes that are readings."""

CHILDREN = {
    "Interface": "Method Attribute InheritedInterface",
    "Method": "Parameter RaisedException",
    "Structure": "StructureField",
    "Enumeration": "Enumerator",
    "TechnicalPolicyDefinition": "PortElement ConfigurationParameter",
    "PropertyDefinition": "ConfigurationParameter",
    "TemplatedPort": "PortElement",
    "InteractionPattern": "InteractionRole InteractionItem",
    "InteractionRole": "InvolvedItem",
    "ConnectorDefinition": "ConnectorPortDefinition ItemBinding ConfigurationParameter",
    "ContractModule": "NativeType",
}
IN_CORE = {"Attribute": "R-10.1.1-05", "ConfigurationParameter": "R-10.1-02", "NativeType": "R-10.1.1-02"}
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
    ("ott_timer", "PortElement"): "R-10.3.1-05",
    ("ott_timer", "Attribute"): "R-10.3.1-11",
    ("itt_timer", "PortElement"): "R-10.3.2-06",
    ("periodic_self-executing_component", "PortElement"): "R-10.5.1-18",
    ("background_self-executing_component", "PortElement"): "R-10.5.1-18",
    ("sporadic_protected_active_component", "PortElement"): "R-10.5.1-18",
    ("periodic_protected_active_component", "PortElement"): "R-10.5.1-18",
}
"""Who speaks of further children of a kind: in general of those of 10.1, and in particular. Otherwise it is the requirement itself."""


@dataclass(frozen=True)
class Place:
    """Where one element of the suite's ``models`` stands: a ``path`` in a ``file``. It may be missing if it is ``optional``."""

    models: Models
    file: str
    path: str
    optional: bool = False

    @property
    def element(self) -> etree._Element:
        """The element there."""
        return _at(_tree_of(self.models.folder / self.file), self.path)


@dataclass
class Mutation:
    """``change`` spoils an element; this breaks ``requirement``, and leaves it unclear if it is not ``clear``."""

    what: str
    requirement: str
    change: Callable[[etree._Element], object]
    clear: bool = True


def mutations(place: Place, requirement: str) -> Iterator[Mutation]:
    """All ways to spoil the element at ``place``, which is the matter of ``requirement``."""
    element, is_core = place.element, place.models is CORE_MODELS
    if not place.optional:
        yield Mutation("dropped", requirement, drop)
        yield Mutation("Union", requirement, lambda e: setattr(e, "tag", "Union"))
        yield Mutation("Oddity", requirement, lambda e: setattr(e, "tag", "Oddity"), clear=False)
    for attribute in map(str, element.attrib):
        if attribute == "name" and place.optional:
            continue
        values = PRINTED.get(attribute, "nothing_such ::clock_api::clock").split()
        for value in (None, *values):
            same = value == element.get(attribute) or (requirement, attribute, value) in ALLOWED
            if not same:
                yield Mutation(f"{attribute}={value}", requirement, partial(put, attribute=attribute, value=value))
        if attribute in ("kind", "direction", "nature", "applicability", "multiplicity", "mode", "charBase"):
            odd = partial(put, attribute=attribute, value="oddity")
            yield Mutation(f"{attribute}=oddity", requirement, odd, clear=False)
    general = "R-10.1-03" if is_core else requirement
    for tag in CHILDREN.get(str(element.tag), "").split():
        if is_core or tag != "NativeType":
            owner = IN_PARTICULAR.get((str(element.get("name", "")), tag)) or (is_core and IN_CORE.get(tag)) or general
            yield Mutation(f"with {tag}", owner, partial(add, tag=tag))
    if element.tag in ("Interface", "TechnicalPolicyDefinition") and "extends" not in element.attrib:
        yield Mutation("extends", general, lambda e: e.set("extends", "::more"))
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


def spoilt(folder: Path, place: Place, change: Callable[[etree._Element], object]) -> Sequence[Path]:
    """A copy in ``folder`` of the file with ``place``, with the element there changed, and the files that it refers to."""
    tree = etree.parse(place.models.folder / place.file)
    change(_at(tree, place.path))
    tree.write(folder / place.file)
    return (folder / place.file, *(path for path in sorted(CORE.glob("*.xml")) if path.name != place.file))


@functools.cache
def declarations() -> Mapping[str, tuple[Place, ...]]:
    """Where the declarations that each requirement speaks of stand."""
    found: dict[str, list[Place]] = {}
    for models in OWN_MODELS:
        for element, declaration in models.declarations.items():
            assert element.source is not None
            path = str(element.source.getroottree().getpath(element.source))
            place = Place(models, declaration.file, path, declaration.optional)
            found.setdefault(declaration.requirement, []).append(place)
    return {requirement: tuple(places) for requirement, places in found.items()}


@functools.cache
def statements() -> Mapping[str, Statement]:
    """What clause 10 says of several declarations, by the requirements that say it."""
    return {s.requirement: s for models in OWN_MODELS for s in models.catalogue.statements if s.of}


@functools.cache
def repeating(requirement: str) -> frozenset[str]:
    """The statements that repeat ``requirement``."""
    return frozenset(by for by, statement in statements().items() if requirement in statement.of)


@functools.cache
def spoilt_results(requirement: str) -> Sequence[tuple[Place, Mutation, Mapping[str, ModelResult]]]:
    """Every way to spoil the declarations of ``requirement``, with its results for the parts that the file is about."""
    outcomes = []
    with TemporaryDirectory() as folder:
        for place in declarations()[requirement]:
            for mutation in mutations(place, requirement):
                compared = compare(spoilt(Path(folder), place, mutation.change), parts=_parts_in(place.file))
                outcomes.append((place, mutation, {r.requirement: r for r in compared.results}))
    return outcomes


@functools.cache
def _parts_in(file: str) -> frozenset[str]:
    """The parts of 10.2 to 10.5 that ``file`` declares; none for one of 10.1."""
    there = {requirement for requirement, places in declarations().items() if any(p.file == file for p in places)}
    return frozenset(part for r in load_requirements() if r.id in there and r.part for part in claims_of(r.part))


def _at(tree: etree._ElementTree, place: str) -> etree._Element:
    found: Any = tree.xpath(place)
    (element,) = found
    assert isinstance(element, etree._Element)
    return element


@functools.cache
def _tree_of(path: Path) -> etree._ElementTree:
    return etree.parse(path)
