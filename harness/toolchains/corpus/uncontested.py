"""Legal models without what only some readings of clause 9 accept.

Models for generators hold values, names, index types and cases that one reading of the specification accepts and another one refuses.
A tool chain that has not declared the accepting one may refuse such a model; it is asked for the same model without them.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from lxml import etree

from ucm_cts.adapters.contract.metamodel.contracts import INTEGER_RANGES
from ucm_cts.adapters.contract.metamodel.spelling import TAGS
from ucm_cts.harness.toolchains.corpus.declarations import REFERENCES, path, resolved

PREFIX = "uncontested_"
"""How the names of such models begin; the rest is the name of the model as it is."""

_VALUES = ("value", "defaultValue")
_TEXT = r"""L?"(?:[^"\\]|\\.)*"|L?'(?:[^'\\]|\\.)*'"""
_LITERAL = re.compile(rf"-?(?:0[xX][0-9a-fA-F]+|\d+|\d+\.\d*(?:[eE][+-]?\d+)?|\d+[eE][+-]?\d+)|TRUE|FALSE|{_TEXT}")
_NAME = re.compile(r"[A-Za-z][\w-]*")
_LONGEST_CHAIN = 100


@dataclass(frozen=True)
class Contested:
    """Something that ``reading`` (``option=value``) accepts and others may refuse; ``without`` takes it out of a model and says whether it was there.

    Who declares ``taken_otherwise`` means something else by it, and is not asked about it at all.
    """

    reading: str
    interpretation: str
    without: Callable[[etree._Element], bool]
    taken_otherwise: str = ""


def uncontested(text: str, meets: Callable[[str], bool]) -> tuple[str, tuple[str, ...]]:
    """The model ``text`` without what its vendor may refuse, who ``meets`` readings, and the interpretations that allow that; none if
    nothing of it is contested.
    """
    root = etree.fromstring(text.encode())
    allowed_by = [one.interpretation for one in CONTESTED if not meets(one.reading) and one.without(root)]
    return etree.tostring(root, encoding="unicode"), tuple(allowed_by)


def understood(text: str, meets: Callable[[str], bool]) -> str:
    """The model ``text`` without what its vendor, who ``meets`` readings, takes for something else; ``text`` itself if there is none."""
    root = etree.fromstring(text.encode())
    others = [one for one in CONTESTED if one.taken_otherwise and meets(one.taken_otherwise)]
    changed = [one for one in others if one.without(root)]
    return etree.tostring(root, encoding="unicode") if changed else text


def _without_texts(root: etree._Element) -> bool:
    return _without_values(root, lambda _, value: not re.search(_TEXT, value))


def _without_expressions(root: etree._Element) -> bool:
    return _without_values(root, _is_literal)


def _is_literal(element: etree._Element, value: str) -> bool:
    """Is ``value`` one literal, or the bare name of an enumerator?"""
    if _NAME.fullmatch(value) and value not in ("TRUE", "FALSE"):
        return resolved(element, value, "Constant") is None
    return _LITERAL.fullmatch(value) is not None


def _without_values(root: etree._Element, stays: Callable[[etree._Element, str], bool]) -> bool:
    """Take out what has a value that does not stay, or that names a constant that goes: constants and parameters as a whole, defaults of
    attributes by themselves.
    """
    valued = [
        (element, attribute, str(element.get(attribute)).strip())
        for element in root.iter("Constant", "Attribute", "ConfigurationParameterValue")
        for attribute in _VALUES
        if attribute in element.attrib
    ]
    going = {one for one in valued if not stays(one[0], one[2])}
    known = -1
    while known < len(going):
        known, gone = len(going), {element for element, _, _ in going}
        going |= {one for one in valued if resolved(one[0], one[2], "Constant") in gone}
    for element, attribute, _ in (one for one in valued if one in going):
        parent = element.getparent()
        if attribute == "value" and parent is not None:
            parent.remove(element)
        else:
            del element.attrib[attribute]
    return bool(going)


def _with_names_of_its_own(root: etree._Element) -> bool:
    """Write names in full that begin outside of the module they stand in."""
    changed = False
    for element in root.iter(etree.Element):
        for attribute in (a for a in REFERENCES if a in element.attrib):
            reference, dot, rest = str(element.get(attribute)).partition(".")
            first = reference.partition("::")[0]
            if not first or _is_of_its_module(element, first):
                continue
            found = resolved(element, reference, *TAGS)
            if found is not None:
                element.set(attribute, f"{path(found)}{dot}{rest}")
                changed = True
    return changed


def _with_kinds_of_indices(root: etree._Element) -> bool:
    """Name the kind of integers where an index type is one by name."""
    changed = False
    for element in root.iter(etree.Element):
        kind = _kind(element, str(element.get("indexType", "")))
        if kind is not None:
            element.set("indexType", kind)
            changed = True
    return changed


def _kind(element: etree._Element, name: str) -> str | None:
    """The kind of the integer type that is called ``name`` at ``element``; None if that is a kind itself, or nothing."""
    if not name or name in INTEGER_RANGES:
        return None
    found = _actual(element, name)
    return str(found.get("kind")) if found is not None and found.tag == "PrimitiveInteger" else None


def _with_values_of_default_cases(root: etree._Element) -> bool:
    """Let default cases name a value that no other case names."""
    changed = False
    for union in root.iter("Union"):
        selector = _actual(union, str(union.get("selectorType", "")))
        named = {str(value.get("enumerator")).rpartition("::")[2] for value in union.iter("SelectorValue")}
        known = [] if selector is None else [str(one.get("name")) for one in selector.iter("Enumerator")]
        left = [name for name in known if name not in named]
        for case in union.iter("UnionCase"):
            if case.get("defaultCase") == "true" and case.find("SelectorValue") is None and left:
                etree.SubElement(case, "SelectorValue", enumerator=left[0])
                changed = True
    return changed


def _with_modes(root: etree._Element) -> bool:
    """Let attributes without mode say what that means."""
    changed = False
    for attribute in root.iter("Attribute"):
        if "mode" not in attribute.attrib:
            attribute.set("mode", "READWRITE")
            changed = True
    return changed


def _actual(element: etree._Element, name: str) -> etree._Element | None:
    """The declaration that ``name`` means at ``element``, behind aliases."""
    found = resolved(element, name, *TAGS)
    for _ in range(_LONGEST_CHAIN):
        if found is None or found.tag != "Alias":
            break
        found = resolved(found, str(found.get("type", "")), *TAGS)
    return found


def _is_of_its_module(element: etree._Element, name: str) -> bool:
    """Does the innermost module around ``element`` declare ``name``?"""
    module = next((one for one in element.iterancestors() if str(one.tag).endswith("Module")), None)
    return module is not None and any(one.get("name") == name for one in module)


CONTESTED = (
    Contested("value-syntax=expressions", "value-syntax", _without_expressions),
    Contested("text-values=quoted", "text-values", _without_texts, taken_otherwise="text-values=bare"),
    Contested("relative-names=outward", "relative-names", _with_names_of_its_own),
    Contested("index-types=kinds-and-types", "index-types", _with_kinds_of_indices),
    Contested("default-case-values=optional", "default-cases", _with_values_of_default_cases),
    Contested("attribute-mode-absent=readwrite", "attribute-mode", _with_modes),
)
"""What some vendors may refuse of legal models, in the order in which it is taken out."""
