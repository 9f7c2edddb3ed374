"""Models as a tool chain gets them: in the spelling of its vendor, with names that are drawn anew for each run.

Names get an ending that depends on the name and the run's seed, wherever they stand: a tool chain that knows the suite's models by heart
knows none of them, and a name without declaration does not stand out. What is known by its printed name keeps it.
"""

from __future__ import annotations

import functools
import hashlib
import re
from collections.abc import Mapping
from dataclasses import dataclass

from lxml import etree

from ucm_cts.adapters.contract.metamodel.contracts import CHAR_KINDS, FLOAT_KINDS, INTEGER_RANGES
from ucm_cts.adapters.contract.metamodel.spelling import SHORT_STRINGS
from ucm_cts.adapters.contract.metamodel.writing import CANONICAL, Dialect
from ucm_cts.harness.catalogue.requirements import SUITE
from ucm_cts.harness.toolchains.corpus.declarations import REFERENCES

_NAMES = frozenset(
    (
        *REFERENCES,
        "configurationParameter",
        "enumerator",
        "internalPart",
        "internalPort",
        "item",
        "name",
        "part",
        "port",
        "refinesPort",
        "role",
        "selectorName",
    )
)
"""Attributes that hold names or references."""

_VALUES = ("value", "defaultValue")
"""Attributes that hold values, in which constants and enumerators may be named."""

_LANGUAGE = ("Language",)
_SEGMENT = re.compile(r"[^:.]+")
_IN_VALUE = re.compile(r"\"(?:[^\"\\]|\\.)*\"|'(?:[^'\\]|\\.)*'|(?<![\w.])[A-Za-z_][\w-]*(?![\w.]*\()")
_WORDS = frozenset(("TRUE", "FALSE", "true", "false", "core", *CHAR_KINDS, *FLOAT_KINDS, *INTEGER_RANGES))


@dataclass(frozen=True)
class Renaming:
    """How models are rewritten in one run: ``seed`` draws the names (None keeps them), ``dialect`` spells elements."""

    seed: int | None = None
    dialect: Dialect = CANONICAL

    def apply(self, text: str) -> str:
        """``text`` rewritten, each element in the line where it was; ``text`` itself if it is not XML."""
        if self == Renaming():
            return text
        try:
            root = etree.fromstring(text.encode())
        except (etree.XMLSyntaxError, UnicodeEncodeError):
            return text
        elements = list(root.iter(etree.Element))
        if self.seed is not None:
            for element in elements:
                _rename(element, self.seed)
        for element in elements:
            _respell(element, self.dialect)
        return etree.tostring(root, encoding="unicode")


def drawn_name(name: str, seed: int) -> str:
    """``name`` as a tool chain sees it in the run of ``seed``; those that differ in case only still do."""
    if not name.strip() or name in _WORDS or name.lower() in _printed_in_any_case():
        return name
    digest = hashlib.blake2b(f"{seed}:{name.lower()}".encode(), digest_size=4).digest()
    letters = "".join("abcdefghijklmnopqrstuvwxyz"[byte % 26] for byte in digest)
    return f"{name}_{letters}"


@functools.cache
def printed_names() -> frozenset[str]:
    """The names of core definitions (10.1) and of the standard property (10.2): a tool chain may know them."""
    models = SUITE / "models"
    found: set[str] = set()
    for path in (*sorted(models.glob("core/*.xml")), models / "extensions" / "standard_properties.xml"):
        for element in etree.parse(path).iter(etree.Element):
            found.add(str(element.get("name", "")))
    return frozenset(found)


@functools.cache
def _printed_in_any_case() -> frozenset[str]:
    return frozenset(name.lower() for name in printed_names())


def _rename(element: etree._Element, seed: int) -> None:
    for attribute, value in ((str(a), str(v)) for a, v in element.attrib.items()):
        if attribute in _NAMES and element.tag not in _LANGUAGE:
            element.set(attribute, _SEGMENT.sub(lambda match: drawn_name(match[0], seed), value))
        elif attribute in _VALUES:
            element.set(attribute, _IN_VALUE.sub(lambda match: _in_value(match[0], seed), value))


def _in_value(token: str, seed: int) -> str:
    return token if token[0] in "\"'" or token in ("e", "E", "L", "d", "D") else drawn_name(token, seed)


def _respell(element: etree._Element, dialect: Dialect) -> None:
    tag = str(element.tag)
    if dialect.delegation_attributes and tag == "PortDelegation":
        _take_end_out(element)
    elif dialect.short_strings and tag == "StringType":
        tag = _shorten(element)
    attributes: Mapping[str, str] = {str(a): str(v) for a, v in element.attrib.items()}
    element.attrib.clear()
    for attribute, value in attributes.items():
        name = dialect.attributes.get(f"{tag}.{attribute}", dialect.attributes.get(attribute, attribute))
        element.set(name, dialect.literals.get(value, value))
    element.tag = dialect.tags.get(tag, tag)


def _take_end_out(delegation: etree._Element) -> None:
    """Let ``delegation`` name its one inner port in attributes. Several ends, none, and an end of which more would be lost than
    its name, can only be written as they are.
    """
    ends = delegation.findall("ConnectionEnd")
    if len(ends) != 1 or len(ends[0]) or set(ends[0].attrib) != {"name", "part", "port"} or not all(ends[0].values()):
        return
    for attribute, internal in (("part", "internalPart"), ("port", "internalPort")):
        delegation.set(internal, str(ends[0].get(attribute)))
    delegation.remove(ends[0])


def _shorten(string: etree._Element) -> str:
    """The tag that says the characters of ``string`` by itself, and its own where no tag does."""
    chars = str(string.get("charBase", ""))
    for tag, its_chars in SHORT_STRINGS.items():
        if chars == its_chars:
            del string.attrib["charBase"]
            return tag
    return str(string.tag)
