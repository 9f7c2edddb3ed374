"""Reads UCM models in any printed spelling as plain trees in one spelling.

Models come from others and may be hostile: size is bounded, document types and so entities are refused.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from lxml import etree

from ucm_cts.adapters.contract.metamodel.contracts import INTEGER_RANGES
from ucm_cts.adapters.contract.metamodel.spelling import LITERALS, SPELLINGS, TAGS
from ucm_cts.harness.catalogue.documents import DocumentError, read_text

MODULES = ("ContractModule", "InteractionModule", "NonfunctionalAspectModule")

_IMPLIED = {
    "String8": {"charBase": "CHAR8", "maxSize": "-1"},
    "String32": {"charBase": "CHAR32", "maxSize": "-1"},
    "StringType": {"maxSize": "-1"},
}


def words(text: str) -> tuple[str, ...]:
    """The words of ``text``, for lists without quotes."""
    return tuple(text.split())


KNOWN_TAGS = frozenset(spelling.tag for spelling in SPELLINGS.values())
"""Spellings that the text prints or that follow from its meta-model, after those that mean the same were made one."""

KNOWN_ATTRIBUTES = frozenset(a for spelling in SPELLINGS.values() for a in spelling.attributes) | {"inheritedInterface"}

INTEGERS = tuple(INTEGER_RANGES)


def _words() -> dict[str, tuple[str, ...]]:
    """The permitted words of an attribute, in canonical spelling."""
    found: dict[str, tuple[str, ...]] = {}
    for cls, fields in LITERALS.items():
        for held, meanings in fields.items():
            attribute = SPELLINGS[cls].attribute(held)
            found[attribute] = tuple(dict.fromkeys((*found.get(attribute, ()), *meanings.values())))
    return found


_WORDS = _words()
_NUMBERS = words("value lowerMultiplicity upperMultiplicity maxSize")
_NUMBER = re.compile("[-+]?[0-9]{1,18}")
_SAME_WORD = {"anynumer": "anyNumber"} | {word.lower(): word for printed in _WORDS.values() for word in printed}


@dataclass(eq=False)
class Element:
    """One element of a model, in canonical spelling.

    ``tag``: the name of its class.
    ``attributes``: by name.
    ``parent``: None for the root.
    ``children``: in order.
    ``source``: the XML element it was read from.
    ``where``: file and line, for messages.
    """

    tag: str
    attributes: dict[str, str]
    parent: Element | None = None
    children: list[Element] = field(default_factory=list)
    source: etree._Element | None = None
    where: str = ""

    @property
    def name(self) -> str:
        return self.attributes.get("name", "")

    @property
    def path(self) -> tuple[str, ...]:
        """The names from the root to here."""
        return (*self.parent.path, self.name) if self.parent is not None else ()

    def walk(self) -> Iterator[Element]:
        """This element and all inside it."""
        yield self
        for child in self.children:
            yield from child.walk()


def is_printed(attribute: str, value: str) -> bool:
    """Is ``value`` written as the text writes values of this attribute: one of its words, or a number in digits?"""
    if attribute in _NUMBERS:
        return bool(_NUMBER.fullmatch(value))
    return value in _WORDS.get(attribute, (value,))


def read_models(paths: list[Path]) -> tuple[Element, Element]:
    """What the files at ``paths`` declare at the root, and below a root module ``core``. Raises ``DocumentError``.

    A module that is written in several pieces becomes one.
    """
    root, core = Element("", {}), Element("", {})
    for path in paths:
        for element in _modules(_parse(path)):
            below_core = _name(element) == "core"
            for one in element if below_core else (element,):
                if isinstance(one.tag, str):
                    _add(core if below_core else root, one, path)
    return root, core


def _modules(element: etree._Element) -> Iterator[etree._Element]:
    """The outermost modules, inside the elements that a tool may wrap around them; other elements stay as they are."""
    inside = [e for e in element.iterdescendants() if isinstance(e.tag, str) and _tag(e) in MODULES]
    if _tag(element) in (*MODULES, "ComponentModule") or not inside or _name(element):
        yield element
    else:
        for child in element:
            if isinstance(child.tag, str):
                yield from _modules(child)


def _add(parent: Element, source: etree._Element, path: Path) -> None:
    tag = _tag(source)
    attributes = dict(_IMPLIED.get(_local(source), {}))
    for key, value in source.attrib.items():
        if not str(key).startswith("{"):
            name = _attribute(tag, str(key))
            attributes[name] = _value(name, str(value).strip())
    if _name(source):
        attributes["name"] = _name(source)
    element = None
    if tag in MODULES:
        element = next((c for c in parent.children if (c.tag, c.name) == (tag, attributes.get("name"))), None)
    if element is None:
        element = Element(tag, attributes, parent, source=source, where=f"{path.name}:{source.sourceline}")
        parent.children.append(element)
    for child in source:
        if isinstance(child.tag, str):
            _add(element, child, path)


def _value(attribute: str, value: str) -> str:
    if attribute in _WORDS:
        return _SAME_WORD.get(value.lower(), value)
    return str(int(value)) if _NUMBER.fullmatch(value) and attribute != "name" else value


def _name(element: etree._Element) -> str:
    """The name, called identifier in 9.1.4.1; a named element may have any further identifier."""
    return str(element.get("name", element.get("identifier", ""))).strip()


def _tag(element: etree._Element) -> str:
    cls = TAGS.get(_local(element))
    return SPELLINGS[cls].tag if cls is not None else _local(element)


def _attribute(tag: str, key: str) -> str:
    """The canonical name of an attribute of elements with a canonical ``tag``."""
    spelling = SPELLINGS[TAGS[tag]] if tag in TAGS else None
    field = spelling.other_attributes.get(key) if spelling is not None else None
    return spelling.attribute(field) if spelling is not None and field is not None else key


def _local(element: etree._Element) -> str:
    return str(etree.QName(element).localname)


_BEFORE_DOCTYPE = re.compile(r"\ufeff?(?>(?:<\?.*?\?>|<!--.*?-->|\s+))*+(?=<!DOCTYPE)", re.DOTALL)
_ENCODING = re.compile(r"\ufeff?<\?xml[^>]*?\sencoding\s*=\s*[\"']([^\"']*)[\"']")


def _parse(path: Path) -> etree._Element:
    text = read_text(path)
    encoding = _ENCODING.match(text)
    if encoding and encoding.group(1).lower() not in ("utf-8", "us-ascii"):
        raise DocumentError(path, 1, f"is said to be '{encoding.group(1)[:40]}'; save it as UTF-8")
    doctype = _BEFORE_DOCTYPE.match(text)
    if doctype:
        line = text.count("\n", 0, doctype.end()) + 1
        raise DocumentError(path, line, "has a document type, which may hold entities; take the DOCTYPE out")
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False)
    try:
        return etree.fromstring(text.encode(), parser)
    except etree.XMLSyntaxError as error:
        problem = " ".join(str(error.msg).split())
        raise DocumentError(path, error.lineno or 1, f"is not XML: {problem}; mend it there") from None
