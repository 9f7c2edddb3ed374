"""Models by hypothesis: trees of every class with anything in them, bytes that are nearly models, and how to spoil one that is.

Such models keep the spelling of clause 9, but not its rules; ``legal_models`` has those that keep all.
"""

from __future__ import annotations

import copy
from typing import Any

import msgspec
from hypothesis import strategies as st
from lxml import etree

from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Model
from ucm_cts.adapters.contract.metamodel.spelling import SPELLINGS, TAGS, Spelling, contained

_TEXTS = st.text(st.sampled_from("aZ_9 -:.\t\n\r&<>\"'é\u0661\u2028\U0001f600"), max_size=6)
_NUMBERS = st.integers(-(2**63), 2**64 - 1)

_HOLDERS = {
    cls: st.sampled_from([outer for outer in SPELLINGS if cls in contained(outer)])
    for cls in SPELLINGS
    if cls is not Model
}
"""In what an element of each class may stand."""

_CHILDREN = {cls: st.lists(st.sampled_from(tuple(contained(cls))), max_size=2) for cls in SPELLINGS if contained(cls)}
"""What stands in an element of each class, if anything can."""


@st.composite
def models(draw: st.DrawFn, *classes: type[Element]) -> Model:
    """Models that the schema allows, around an element of one of ``classes``, or of any; what names refer to is chance."""
    element = _element(draw, draw(st.sampled_from(classes or tuple(SPELLINGS))), 2)
    while not isinstance(element, Model):
        outermost = isinstance(element, MODULES) and draw(st.booleans())
        outer = Model if outermost else draw(_HOLDERS[type(element)])
        field = contained(outer)[type(element)]
        element = msgspec.structs.replace(_element(draw, outer, 1), **{field: (element,)})
    return element


def _element(draw: st.DrawFn, cls: type[Element], deep: int) -> Element:
    """An element with children, their children, and so on, ``deep`` times."""
    spelling = SPELLINGS[cls]
    fields: dict[str, Any] = {}
    for field in spelling.attributes.values():
        if field not in spelling.required and draw(st.booleans()):
            continue
        fields[field] = draw(_VALUES_OF[cls, field])
    if deep and cls in _CHILDREN:
        for inner in draw(_CHILDREN[cls]):
            field = contained(cls)[inner]
            fields[field] = (*fields.get(field, ()), _element(draw, inner, deep - 1))
    return cls(**fields)


def _values(spelling: Spelling, field: str) -> st.SearchStrategy[Any]:
    if field in spelling.literals:
        return st.sampled_from(sorted(set(spelling.literals[field].values())))
    if field in spelling.numbers:
        return _NUMBERS
    return st.booleans() if field in spelling.truths else _TEXTS


_VALUES_OF = {
    (spelling.cls, field): _values(spelling, field)
    for spelling in SPELLINGS.values()
    for field in spelling.attributes.values()
}


# spoiling

_TAGS = st.sampled_from([*(spelling.tag for spelling in SPELLINGS.values()), "zork", "Zork", "Structures"])
_ATTRIBUTES = st.sampled_from(
    [*sorted({a for spelling in SPELLINGS.values() for a in spelling.attributes}), "zork", "line", "fields"]
)
_WORDS = "0 -1 +7 007 1_0 1.5 true 0 TRUE LONG CHAR8 IN READ DATA PROVIDED anyNumber onBoth ::a::b a.b é \u0661"
_VALUES = st.sampled_from(["", " 1", "9" * 21, *_WORDS.split()])


@st.composite
def spoilt(draw: st.DrawFn, legal: st.SearchStrategy[bytes]) -> bytes:
    """A model with a few edits of its tree, each of which may break it, or not. Other printed spellings are not used."""
    root = etree.fromstring(draw(legal))
    for _ in range(draw(st.integers(1, 4))):
        elements = [element for element in root.iter() if isinstance(element.tag, str)]
        element = elements[draw(st.integers(0, len(elements) - 1))]
        draw(st.sampled_from(_EDITS))(draw, element)
    for element in root.iter(etree.Element):
        _drop_other_spellings(element)
    return etree.tostring(root, encoding="UTF-8", xml_declaration=True)


def _drop_other_spellings(element: Any) -> None:
    """Take out attributes that are canonical elsewhere and another spelling here, as ``size`` is of strings."""
    if element.tag in TAGS:
        for attribute in SPELLINGS[TAGS[element.tag]].other_attributes:
            element.attrib.pop(attribute, None)


def _retag(draw: st.DrawFn, element: Any) -> None:
    element.tag = draw(_TAGS)


def _set(draw: st.DrawFn, element: Any) -> None:
    element.set(draw(_ATTRIBUTES), draw(_VALUES))


def _reset(draw: st.DrawFn, element: Any) -> None:
    if element.attrib:
        element.set(draw(st.sampled_from(sorted(element.attrib))), draw(_VALUES))


def _unset(draw: st.DrawFn, element: Any) -> None:
    if element.attrib:
        del element.attrib[draw(st.sampled_from(sorted(element.attrib)))]


def _write(draw: st.DrawFn, element: Any) -> None:
    element.text = draw(st.sampled_from([" ", "\n", "text", "\u00a0", "<&>"]))


def _comment(_draw: st.DrawFn, element: Any) -> None:
    element.insert(0, etree.Comment("said"))


def _add(draw: st.DrawFn, element: Any) -> None:
    element.append(etree.Element(draw(_TAGS), name="n"))


def _repeat(draw: st.DrawFn, element: Any) -> None:
    if len(element):
        element.append(copy.deepcopy(element[draw(st.integers(0, len(element) - 1))]))


def _drop(_draw: st.DrawFn, element: Any) -> None:
    if element.getparent() is not None:
        element.getparent().remove(element)


def _lift(_draw: st.DrawFn, element: Any) -> None:
    """Put an element where its parent is."""
    parent = element.getparent()
    if parent is not None and parent.getparent() is not None:
        parent.addnext(element)


_EDITS = (_retag, _set, _reset, _unset, _write, _comment, _add, _repeat, _drop, _lift)


# bytes

_PIECES = (
    *(
        b"<ContractModule name='m'>",
        b"</ContractModule>",
        b"<Structure name='s'/>",
        b"<!DOCTYPE m [<!ENTITY a 'b'>]>",
        b"&a;",
    ),
    *(
        b"<!--",
        b"-->",
        b"<![CDATA[",
        b"]]>",
        b"<?xml version='1.0' encoding='utf-16'?>",
        b"<?xml version='1.0'?>",
        b"<?p?>",
    ),
    *(
        b"\xff\xfe",
        b"\xfe\xff",
        b"\xef\xbb\xbf",
        b"\0",
        b"\xe9",
        b"<",
        b">",
        b"&#0;",
        b"&#x10ffff;",
        b"'",
        b" xmlns='u'",
        b"x:",
    ),
    *(b"\xed\xa0\x80", b"<a" * 9, b"<a>" * 300, b"9" * 30, b"]]>", b"&lt;", b"encoding='latin-1'"),
)


@st.composite
def nearly_models(draw: st.DrawFn, legal: st.SearchStrategy[bytes]) -> bytes:
    """Bytes of a model in which pieces were cut, repeated, exchanged and put in, perhaps in another encoding."""
    text = bytearray(draw(legal))
    for _ in range(draw(st.integers(0, 5))):
        begin = draw(st.integers(0, len(text)))
        end = draw(st.integers(begin, min(len(text), begin + 40)))
        text[begin:end] = draw(st.sampled_from(_PIECES) | st.binary(max_size=4) | st.just(bytes(text[begin:end] * 2)))
    encoding = draw(st.sampled_from(["", "", "", "utf-16", "utf-16-be", "utf-32", "latin-1", "utf-7"]))
    cut = text[: draw(st.integers(0, len(text)))] if draw(st.booleans()) else text
    return bytes(cut).decode("utf-8", "replace").encode(encoding, "replace") if encoding else bytes(cut)
