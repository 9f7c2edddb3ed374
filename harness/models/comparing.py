"""Finds the declarations of clause 10 in a framework's models and compares them, fact by fact, with those of the suite."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, MutableMapping
from dataclasses import dataclass, field
from typing import Any, Literal

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.models.spellings import INTEGERS, KNOWN_ATTRIBUTES, KNOWN_TAGS, Element, is_printed, words

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
    """

    option: str
    value: str
    attributes: dict[str, str] = {}
    missing: bool = False
    always: bool = False
    direct: bool = False


class Declaration(Value, frozen=True):
    """The place of a requirement's declaration in the suite's own files.

    ``within``: the requirement speaks of everything inside, too, that no other entry names.
    """

    requirement: str
    file: str
    place: str
    optional: bool = False
    readings: tuple[Reading, ...] = ()
    beyond: dict[str, str] = {}
    within: bool = False


@dataclass(frozen=True)
class Conventions:
    """How the declarations of one catalogue are compared.

    ``root_option``, ``at_root``: the option that says where modules stand, and its value for the root.
    ``general``: the requirements that speak of further children of a kind, and under "" of all others; without one the requirement
    of the declaration does.
    """

    root_option: str
    at_root: str
    general: Mapping[str, str]


_CHILDREN: Mapping[str, tuple[str, ...]] = {
    "Interface": ("Method", "Attribute"),
    "Method": ("Parameter", "RaisedException"),
    "Structure": ("StructureField",),
    "Enumeration": ("Enumerator",),
    "TechnicalPolicyDefinition": ("PortElement", "ConfigurationParameter"),
    "PortType": ("PortElement",),
    "InteractionPattern": ("InteractionRole", "InteractionItem"),
    "InteractionRole": ("InvolvedItem",),
    "ConnectorDefinition": ("ConnectorPort", "ItemBinding", "ConfigurationParameter"),
    "ContractModule": ("NativeType",),
}
"""Children that count: one more than 10.1 has is too many. All others are free."""

_INHERITING = ("extends", "inheritedInterface")
_ORDERED = ("Parameter", "StructureField", "Enumerator")
_REFERENCES = words("technicalAspect interface type item pattern portRole api interactionItem connectorItem indexType")


@dataclass(frozen=True)
class Fact:
    """One observed fact and the expected one."""

    status: Status
    expected: str = ""
    observed: str = ""


_KEPT = Fact("kept")


@dataclass
class Comparing:
    """One comparison: ``facts`` are filed by requirement and by what they are about; ``claims`` has every option.

    If a requirement speaks of several declarations, the path of each stands before what its facts are about.
    """

    declarations: Mapping[Element, Declaration]
    claims: MutableMapping[str, str]
    conventions: Conventions
    facts: dict[str, dict[str, Fact]] = field(default_factory=dict)
    readings: dict[str, set[str]] = field(default_factory=dict)
    declared: dict[tuple[str, ...], list[Element]] = field(default_factory=dict)
    printed: set[tuple[str, ...]] = field(default_factory=set)

    def __post_init__(self) -> None:
        times = Counter(d.requirement for d in self.declarations.values())
        self.shared = {requirement for requirement, number in times.items() if number > 1}

    def compare(self, ours: Element, root: Element, core: Element) -> None:
        """Compare what is declared at the ``root`` and below ``core`` with ``ours``."""
        self.printed = {e.path for e in ours.walk()}
        theirs = self._merged(ours, root, core)
        for element in theirs.walk():
            self.declared.setdefault(element.path, []).append(element)
        self._settle()
        for module in ours.children:
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
        for module in ours.children:
            places = [
                [c for c in tree.children if (c.tag, c.name) == (module.tag, module.name)] for tree in (root, core)
            ]
            met = {(True, True): "both", (True, False): at_root, (False, True): "core"}.get(
                (bool(places[0]), bool(places[1]))
            )
            if met and claim in (met, "observed"):
                self.readings.setdefault(option, set()).add(met)
            requirement = self.declarations[module].requirement
            if all(places) and claim in ("both", "observed") and not _same(places[0][0], places[1][0]):
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

    def _declaration(self, ours: Element, scope: Element | None) -> Element | None:
        """Look for ``ours`` in ``scope``, compare it and everything inside it; returns the element that was compared."""
        declaration = self.declarations[ours]
        readings = [r for r in declaration.readings if self._accepts(r)]
        theirs = _match(ours, scope, readings) if scope is not None else None
        if theirs is None:
            self._missing(ours, scope, declaration, readings)
            for child in ours.children:
                self._declaration(child, None)
            return None
        self._file(declaration.requirement, self._about(ours, "there"), _KEPT)
        self._kind(ours, theirs, declaration.requirement)
        self._attributes(ours, theirs, declaration, readings)
        pairs = [(child, self._declaration(child, theirs)) for child in ours.children]
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
            strange = next((c for c in scope.children if _may_be(ours, c)), None)
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
        differing = [c for c in twins if not _same(c, theirs)]
        if differing:
            observed = f"{theirs.name} is declared twice, differently ({theirs.where}, {differing[0].where})"
            self._note(requirement, self._about(ours, "twin"), "one declaration", observed)

    def _attributes(self, ours: Element, theirs: Element, declaration: Declaration, readings: list[Reading]) -> None:
        expected, direct = dict(ours.attributes), set[str]()
        for option in dict.fromkeys(r.option for r in declaration.readings):
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
                strange = _is_strange(attribute, value, there) if there else set(theirs.attributes) - KNOWN_ATTRIBUTES
                text = f"{attribute} {there}" if there else f"no {attribute}" if value else ""
                status: Status = "unclear" if strange or theirs.tag not in KNOWN_TAGS else "broken"
                fact = Fact(status, f"{attribute} {value}" if value else f"no {attribute}", f"{text} ({theirs.where})")
            self._file(declaration.requirement, self._about(ours, attribute), fact)

    def _equal(self, attribute: str, value: str, ours: Element, theirs: Element, direct: bool) -> bool:
        there = theirs.attributes.get(attribute, "")
        if direct or attribute not in _REFERENCES or not value or not there or there == value in INTEGERS:
            return there == value
        named = self._named(there, theirs)
        if value in INTEGERS:
            return any(
                e.tag == "PrimitiveInteger" and e.attributes.get("kind") == value
                for e in self.declared.get(named[0], [])
            )
        expected = next((p for p in _candidates(value, ours) if p in self.printed), None)
        return expected in named if expected else _segments(there)[-1:] == _segments(value)[-1:]

    def _named(self, reference: str, element: Element) -> list[tuple[str, ...]]:
        """The declaration that ``reference`` means: the nearest one, or the possible paths if there is none."""
        candidates = _candidates(reference, element)
        return [p for p in candidates if p in self.declared][:1] or candidates

    def _beyond(
        self, ours: Element, theirs: Element, declaration: Declaration, pairs: list[tuple[Element, Element | None]]
    ) -> None:
        place = "::".join(ours.path)
        found = [t for o, t in pairs if t is not None and not self._may_be_missing(o)]
        names = {(t.tag, t.name) for t in found if t.name}
        for tag in _CHILDREN.get(ours.tag, ()):
            strangers = [c for c in theirs.children if c.tag == tag and c not in found and (tag, c.name) not in names]
            wanted = sum(o.tag == tag and t is None and not self._may_be_missing(o) for o, t in pairs)
            general = self.conventions.general
            requirement = declaration.beyond.get(tag) or general.get(tag) or general.get("") or declaration.requirement
            text = ", ".join(f"{tag} {c.name} ({c.where})" for c in strangers)
            self._note(requirement, f"{place} {tag}", f"no further {tag} in {place}", text, len(strangers) <= wanted)
        if ours.tag in ("Interface", "TechnicalPolicyDefinition"):
            for attribute in _INHERITING:
                parent = theirs.attributes.get(attribute, "")
                text = f"{attribute} {parent} ({theirs.where})"
                all_others = self.conventions.general.get("") or declaration.requirement
                self._note(all_others, f"{place} {attribute}", f"{place} inherits nothing", text, not parent)

    def _about(self, ours: Element, what: str) -> str:
        if self.declarations[ours].requirement not in self.shared:
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


def _match(ours: Element, scope: Element, readings: list[Reading]) -> Element | None:
    """The child of ``scope`` that is meant to be ``ours``: by kind and name, else by a name that nothing else has."""
    same_kind = [c for c in scope.children if c.tag == ours.tag]
    if not ours.name:
        return _match_nameless(ours, same_kind)
    names = {r.attributes.get("name", ours.name) for r in readings if not r.missing} or {ours.name}
    assert ours.parent is not None
    siblings = {(o.tag, o.name) for o in ours.parent.children}
    others = [c for c in scope.children if (c.tag, c.name) not in siblings]
    return next((c for c in (*same_kind, *others) if c.name in names), None)


def _match_nameless(ours: Element, same_kind: list[Element]) -> Element | None:
    """The one about the same item; else the first that is about no item that ``ours`` has in another element of this kind."""
    assert ours.parent is not None
    about = {_item_of(o) for o in ours.parent.children if o.tag == ours.tag}
    meant = [c for c in same_kind if _item_of(c) == _item_of(ours)]
    others = [c for c in same_kind if len(about) == 1 or _item_of(c) not in about]
    return next(iter((*meant, *others)), None)


def _item_of(element: Element) -> str:
    """The item that a nameless element is about, by its own name."""
    reference = element.attributes.get("item") or element.attributes.get("interactionItem", "")
    return (_segments(reference) or ("",))[-1]


def _may_be(ours: Element, child: Element) -> bool:
    """Is ``child`` spelled in a way that the text never prints, so that it could be ``ours``?"""
    nameless = child.tag == ours.tag and bool(ours.name) and not child.name
    return child.tag not in KNOWN_TAGS or (nameless and bool(set(child.attributes) - KNOWN_ATTRIBUTES))


def _is_strange(attribute: str, value: str, there: str) -> bool:
    """Is ``there`` written as the text never writes it: another word, or a role or an item without its pattern?"""
    bare = attribute in ("portRole", "interactionItem") and (there,) == _segments(value)[-1:]
    return bare or not is_printed(attribute, there)


def _same(one: Element, other: Element) -> bool:
    return _form(one) == _form(other)


def _form(element: Element) -> tuple[Any, ...]:
    """The declarations, in any order."""
    return element.tag, tuple(sorted(element.attributes.items())), tuple(sorted(map(_form, element.children)))


def _segments(reference: str) -> tuple[str, ...]:
    return tuple(part for part in reference.replace(".", "::").split("::") if part)


def _candidates(reference: str, element: Element) -> list[tuple[str, ...]]:
    """The paths that ``reference`` can mean at ``element``, the nearest first."""
    segments = _segments(reference)
    if reference.startswith("::") or element.parent is None:
        return [segments[1:] if segments[:1] == ("core",) else segments]
    scope = element.parent.path
    paths = [scope[:depth] + segments for depth in range(len(scope), -1, -1)]
    return [*paths, segments[1:]] if segments[:1] == ("core",) else paths
