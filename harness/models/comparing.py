"""Finds the declarations of clause 10 in a framework's models and compares them, fact by fact, with those of the suite."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, MutableMapping
from dataclasses import dataclass, field
from typing import Literal

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.models.matching import candidates, is_strange, match, may_be, same, segments
from ucm_cts.harness.models.spellings import INTEGERS, KNOWN_ATTRIBUTES, KNOWN_TAGS, MODULES, Element, words

Status = Literal["kept", "broken", "absent", "left out", "unclear"]
"""``absent``: the declaration that should contain it is missing. ``left out``: it may be missing, and it
is. ``unclear``: it is missing, but something is there in a spelling that the text never prints."""


class Reading(Value, frozen=True):
    """How a declaration changes under one value of an option.

    ``option``: the option.
    ``value``: its value.
    ``attributes``: attributes that differ.
    ``missing``: the declaration may be missing.
    ``always``: holds whether or not the vendor declares it.
    ``direct``: the attributes say it themselves, not by the name of a declared type.
    ``also``: what one further child of a kind has, which there may be.
    """

    option: str
    value: str
    attributes: dict[str, str] = {}
    missing: bool = False
    always: bool = False
    direct: bool = False
    also: dict[str, dict[str, str]] = {}


class Declaration(Value, frozen=True):
    """The place of a requirement's declaration in the suite's own files.

    ``within``: the requirement speaks of everything inside, too, that no other entry names.
    ``leads_to``: the type may be any that leads to a declaration of this kind.
    """

    requirement: str
    file: str
    place: str
    optional: bool = False
    readings: tuple[Reading, ...] = ()
    beyond: dict[str, str] = {}
    within: bool = False
    leads_to: str = ""


@dataclass(frozen=True)
class Conventions:
    """How the declarations of one catalogue are compared.

    ``root_option``, ``at_root``: the option that says where modules stand, and its value for the root.
    ``general``: the requirements that speak of further children of a kind, and under "" of all others; without one the requirement
    of the declaration does.
    ``free``: kinds of which there may be further children.
    """

    root_option: str
    at_root: str
    general: Mapping[str, str]
    free: frozenset[str] = frozenset()


_CHILDREN: Mapping[str, tuple[str, ...]] = {
    "Interface": ("Method", "Attribute", "InheritedInterface"),
    "Method": ("Parameter", "RaisedException"),
    "Structure": ("StructureField",),
    "Enumeration": ("Enumerator",),
    "TechnicalPolicyDefinition": ("PortElement", "ConfigurationParameter"),
    "AnnotationDefinition": ("ConfigurationParameter",),
    "PortType": ("PortElement",),
    "InteractionPattern": ("InteractionRole", "InteractionItem"),
    "InteractionRole": ("InvolvedItem",),
    "ConnectorDefinition": ("ConnectorPort", "ItemBinding", "ConfigurationParameter"),
    "ContractModule": ("NativeType",),
}
"""Children that count: one more than the text has is too many. All others are free."""

_INHERITING = ("extends", "inheritedInterface")
_ORDERED = ("Parameter", "StructureField", "Enumerator")
_REFERENCES = words(
    "technicalAspect extends interface type item pattern portRole api interactionItem connectorItem indexType"
)


@dataclass(frozen=True)
class Fact:
    """One observed fact and the expected one."""

    status: Status
    expected: str = ""
    observed: str = ""


_KEPT = Fact("kept")


@dataclass
class Comparing:
    """One comparison of all elements of the suite's that have a declaration in ``declarations``.

    ``facts`` are filed by requirement and by what they are about; if a requirement speaks of several declarations, the path of each
    but the first stands before what its facts are about. ``claims`` has every option. ``printed`` are the paths of what the text
    declares.
    """

    declarations: Mapping[Element, Declaration]
    claims: MutableMapping[str, str]
    conventions: Conventions
    printed: frozenset[tuple[str, ...]]
    facts: dict[str, dict[str, Fact]] = field(default_factory=dict)
    readings: dict[str, set[str]] = field(default_factory=dict)
    declared: dict[tuple[str, ...], list[Element]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.compared = {element.path for element in self.declarations}
        self.first: dict[str, Element] = {}
        for element, declaration in self.declarations.items():
            self.first.setdefault(declaration.requirement, element)

    def compare(self, ours: Element, root: Element, core: Element) -> None:
        """Compare what is declared at the ``root`` and below ``core`` with ``ours``."""
        theirs = self._merged(ours, root, core)
        for element in theirs.walk():
            self.declared.setdefault(element.path, []).append(element)
        self._settle()
        for module in self._inside(ours):
            self._declaration(module, theirs)

    def _merged(self, ours: Element, root: Element, core: Element) -> Element:
        """One root for what the vendor may declare in two places."""
        option, at_root = self.conventions.root_option, self.conventions.at_root
        claim = self.claims[option]
        merged = Element("", {})
        if claim != "core":
            merged.children += root.children
        if claim != at_root:
            there = {(c.tag, c.name) for c in merged.children}
            merged.children += [c for c in core.children if (c.tag, c.name) not in there]
        for module in self._inside(ours):
            places = [
                [c for c in tree.children if (c.tag, c.name) == (module.tag, module.name)] for tree in (root, core)
            ]
            met = {(True, True): "both", (True, False): at_root, (False, True): "core"}.get(
                (bool(places[0]), bool(places[1]))
            )
            if met and claim in (met, "observed"):
                self.readings.setdefault(option, set()).add(met)
            requirement = self.declarations[module].requirement
            if all(places) and claim in ("both", "observed") and not same(places[0][0], places[1][0]):
                self._note(requirement, "place", "one declaration", f"{module.name} differs from core::{module.name}")
            elif claim == "both" and met in (at_root, "core"):
                self._note(
                    requirement, "place", "two paths to it", f"{module.name} at {places[met == 'core'][0].where} only"
                )
        return merged

    def _settle(self) -> None:
        """Take the one value of an option that shows in several declarations from where it shows best."""
        enumeration = self.declared.get(("container_services", "trace_service", "trace_api", "log_severity_t"), [])
        severities = {c.name for e in enumeration for c in e.children}
        five = "fatal" in severities and not severities & {"trace", "critical"}
        codes = [e for e in self.declared.get(("return_codes", "comm_ecode"), []) if e.tag == "Enumeration"]
        by_kind = any(e.attributes.get("indexType") in INTEGERS for e in codes)
        for option, value in (
            ("log-severity-set", "idl-5" if five else "model-6"),
            ("comm-ecode-index", "kind" if by_kind else "declared-type"),
        ):
            if self.claims[option] == "observed":
                self.claims[option] = value

    def _inside(self, ours: Element) -> list[Element]:
        return [child for child in ours.children if child in self.declarations]

    def _declaration(self, ours: Element, scope: Element | None) -> Element | None:
        """Look for ``ours`` in ``scope``, compare it and everything inside it; returns the element that was compared."""
        declaration = self.declarations[ours]
        readings = [r for r in declaration.readings if self._accepts(r)]
        names = {r.attributes.get("name", ours.name) for r in readings if not r.missing} or {ours.name}
        theirs = match(ours, scope, names) if scope is not None else None
        if theirs is None:
            self._missing(ours, scope, declaration, readings)
            for child in self._inside(ours):
                self._declaration(child, None)
            return None
        self._file(declaration.requirement, self._about(ours, "there"), _KEPT)
        self._kind(ours, theirs, declaration.requirement)
        self._attributes(ours, theirs, declaration, readings)
        pairs = [(child, self._declaration(child, theirs)) for child in self._inside(ours)]
        self._beyond(ours, theirs, declaration, pairs)
        found = [t for o, t in pairs if t is not None and _is_ordered(o)]
        if found:
            there = [c for c in theirs.children if c in found]
            expected, observed = (", ".join(e.name for e in elements) for elements in (found, there))
            self._note(
                declaration.requirement,
                self._about(ours, "order"),
                f"the order {expected}",
                f"{observed} ({theirs.where})",
                found == there,
            )
        return theirs

    def _missing(self, ours: Element, scope: Element | None, declaration: Declaration, readings: list[Reading]) -> None:
        what = f"{ours.tag} {ours.name or ours.attributes.get('item', '')}".strip()
        reading = next((r for r in readings if r.missing), None)
        if scope is None:
            fact = Fact("absent", what, "what should contain it is missing")
        elif reading is not None or declaration.optional:
            fact = Fact("left out", what, "it may be missing, and it is")
            if reading is not None:
                self._met(reading)
        else:
            inside = "::".join(scope.path) or "the models"
            strange = next((c for c in scope.children if may_be(ours, c)), None)
            status: Status = "unclear" if strange is not None else "broken"
            hint = f", but there is {strange.tag} ({strange.where})" if strange is not None else ""
            fact = Fact(status, f"{what} in {inside}", f"it is missing{hint}")
        self._file(declaration.requirement, self._about(ours, "there"), fact)

    def _kind(self, ours: Element, theirs: Element, requirement: str) -> None:
        fact = _KEPT
        if theirs.tag != ours.tag:
            status: Status = "broken" if theirs.tag in KNOWN_TAGS else "unclear"
            fact = Fact(status, f"{ours.tag} {ours.name}", f"{theirs.tag} {theirs.name} ({theirs.where})")
        self._file(requirement, self._about(ours, "is"), fact)
        assert theirs.parent is not None
        twins = [c for c in theirs.parent.children if ours.name and (c.tag, c.name) == (theirs.tag, theirs.name)]
        differing = [c for c in twins if not same(c, theirs)]
        if differing:
            observed = f"{theirs.name} is declared twice, differently ({theirs.where}, {differing[0].where})"
            self._note(requirement, self._about(ours, "twin"), "one declaration", observed)

    def _attributes(self, ours: Element, theirs: Element, declaration: Declaration, readings: list[Reading]) -> None:
        expected, direct = dict(ours.attributes), set[str]()
        for option in dict.fromkeys(r.option for r in declaration.readings if not r.also):
            touched = {a for r in declaration.readings if r.option == option for a in r.attributes}
            accepted = [r for r in readings if r.option == option and not r.missing]
            fitting = [
                r for r in accepted
                if all(self._equal(a, (ours.attributes | r.attributes).get(a, ""), ours, theirs, r.direct) for a in touched)
            ]  # fmt: skip
            if fitting:
                self._met(fitting[0])
            chosen = (fitting or accepted or [Reading("", "")])[0]
            expected |= chosen.attributes
            direct |= chosen.attributes.keys() if chosen.direct else set()
        for attribute, value in expected.items():
            if attribute == "name":
                continue
            fact, there = _KEPT, theirs.attributes.get(attribute, "")
            if not self._equal(attribute, value, ours, theirs, attribute in direct):
                strange = is_strange(attribute, value, there) if there else set(theirs.attributes) - KNOWN_ATTRIBUTES
                text = f"{attribute} {there}" if there else f"no {attribute}" if value else ""
                status: Status = "unclear" if strange or theirs.tag not in KNOWN_TAGS else "broken"
                fact = Fact(status, f"{attribute} {value}" if value else f"no {attribute}", f"{text} ({theirs.where})")
            self._file(declaration.requirement, self._about(ours, attribute), fact)

    def _equal(self, attribute: str, value: str, ours: Element, theirs: Element, direct: bool) -> bool:
        there = theirs.attributes.get(attribute, "")
        if direct or attribute not in _REFERENCES or not value or not there or there == value in INTEGERS:
            return there == value
        named = self._named(there, theirs, attribute)
        if value in INTEGERS:
            return any(
                e.tag == "PrimitiveInteger" and e.attributes.get("kind") == value
                for e in self.declared.get(named[0], [])
            )
        expected = next((p for p in candidates(value, ours) if p in self.printed), None)
        leads_to = self.declarations[ours].leads_to
        if leads_to:
            missing_elsewhere = expected in named and expected in self.compared  # a matter of its own requirement
            return missing_elsewhere or self._leads_to(leads_to, named)
        return expected in named if expected else segments(there)[-1:] == segments(value)[-1:]

    def _named(self, reference: str, element: Element, attribute: str) -> list[tuple[str, ...]]:
        """The declaration that ``reference`` means: the nearest one that can be meant, or the possible paths if there is none."""
        paths = candidates(reference, element)
        never = MODULES if attribute == "extends" else (*MODULES, "TechnicalPolicyDefinition")
        found = (p for p in paths if any(e.tag not in never for e in self.declared.get(p, ())))
        return list(itertools.islice(found, 1)) or paths

    def _leads_to(self, tag: str, named: list[tuple[str, ...]]) -> bool:
        """Is one of ``named`` declared as ``tag``, maybe by aliases?"""
        seen = set[tuple[str, ...]]()
        while named:
            seen.update(named)
            meant = [e for path in named for e in self.declared.get(path, ())]
            if any(e.tag == tag for e in meant):
                return True
            aliases = (self._named(e.attributes.get("type", ""), e, "type") for e in meant if e.tag == "Alias")
            named = [path for paths in aliases for path in paths if path not in seen]
        return False

    def _beyond(
        self, ours: Element, theirs: Element, declaration: Declaration, pairs: list[tuple[Element, Element | None]]
    ) -> None:
        place = "::".join(ours.path)
        found = [t for o, t in pairs if t is not None and not self._may_be_missing(o)]
        names = {(t.tag, t.name) for t in found if t.name}
        for tag in _CHILDREN.get(ours.tag, ()):
            if tag in self.conventions.free:
                continue
            strangers = [c for c in theirs.children if c.tag == tag and c not in found and (tag, c.name) not in names]
            strangers = self._without_permitted(tag, strangers, ours, declaration)
            wanted = sum(o.tag == tag and t is None and not self._may_be_missing(o) for o, t in pairs)
            general = self.conventions.general
            requirement = declaration.beyond.get(tag) or general.get(tag) or general.get("") or declaration.requirement
            text = ", ".join(f"{tag} {c.name} ({c.where})" for c in strangers)
            self._note(requirement, f"{place} {tag}", f"no further {tag} in {place}", text, len(strangers) <= wanted)
        if ours.tag in ("Interface", "TechnicalPolicyDefinition"):
            for attribute in (a for a in _INHERITING if a not in ours.attributes):
                parent = theirs.attributes.get(attribute, "")
                text = f"{attribute} {parent} ({theirs.where})"
                all_others = self.conventions.general.get("") or declaration.requirement
                self._note(all_others, f"{place} {attribute}", f"{place} inherits nothing", text, not parent)

    def _without_permitted(
        self, tag: str, strangers: list[Element], ours: Element, declaration: Declaration
    ) -> list[Element]:
        """``strangers`` without the one that a reading has; it must be there if the vendor declares that reading."""
        for reading in (r for r in declaration.readings if tag in r.also and self._accepts(r)):
            also = reading.also[tag]
            fitting = [s for s in strangers if all(self._equal(a, v, ours, s, False) for a, v in also.items())]
            if fitting:
                self._met(reading)
            elif self.claims[reading.option] == reading.value:
                expected = f"{tag} with {' and '.join(f'{a} {v}' for a, v in also.items())}"
                about = self._about(ours, reading.option)
                self._note(declaration.requirement, about, expected, f"it is missing in {'::'.join(ours.path)}")
            strangers = [s for s in strangers if s not in fitting[:1]]
        return strangers

    def _about(self, ours: Element, what: str) -> str:
        if self.first[self.declarations[ours].requirement] is ours:
            return what
        return f"{'::'.join(ours.path)}{ours.attributes.get('item', '')} {what}"

    def _may_be_missing(self, ours: Element) -> bool:
        return any(r.missing and self._accepts(r) for r in self.declarations[ours].readings)

    def _accepts(self, reading: Reading) -> bool:
        return reading.always or self.claims[reading.option] in (reading.value, "observed")

    def _met(self, reading: Reading) -> None:
        self.readings.setdefault(reading.option, set()).add(reading.value)

    def _note(self, requirement: str, about: str, expected: str, observed: str, kept: bool = False) -> None:
        self._file(requirement, about, _KEPT if kept else Fact("broken", expected, observed))

    def _file(self, requirement: str, about: str, fact: Fact) -> None:
        self.facts.setdefault(requirement, {})[about] = fact


def _is_ordered(element: Element) -> bool:
    return element.tag in _ORDERED and element.attributes.get("direction") != "RETURN"
