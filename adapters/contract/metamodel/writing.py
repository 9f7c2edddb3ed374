"""Writes UCM models: a ``Model`` becomes XML in clause 9's spelling, or in that of a dialect."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from xml.sax.saxutils import quoteattr

import msgspec

from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.components import PortDelegation
from ucm_cts.adapters.contract.metamodel.contracts import StringType
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.spelling import SHORT_STRINGS, SPELLINGS


class Dialect(msgspec.Struct, frozen=True, kw_only=True):
    """Another way to write the same models.

    ``tags``: other tags, by the canonical ones.
    ``attributes``: other attributes, by ``Tag.attribute`` or, for all tags, ``attribute``.
    ``literals``: other words of enumerations, by the canonical ones.
    ``short_strings``: whether a string type becomes a String8 or String32.
    ``delegation_attributes``: whether a delegation names its inner port in attributes, not in a ConnectionEnd (9.5.5.8).
    """

    tags: Mapping[str, str] = {}
    attributes: Mapping[str, str] = {}
    literals: Mapping[str, str] = {}
    short_strings: bool = False
    delegation_attributes: bool = False


CANONICAL = Dialect()


def write_model(model: Model, dialect: Dialect = CANONICAL) -> bytes:
    """``model`` as a file; reading it gives an equal model, but for lines and ``delegation_attributes``. A model of one module has
    no root around it.
    """
    roots: tuple[Element, ...] = model.modules if len(model.modules) == 1 else (model,)
    lines = ['<?xml version="1.0" encoding="UTF-8"?>']
    for root in roots:
        lines += _written(root, dialect)
    return ("\n".join(lines) + "\n").encode()


def _written(outermost: Element, dialect: Dialect) -> Iterator[str]:
    """The lines of an element and all inside, however deep it is."""
    waiting: list[tuple[str, Element | None]] = [("", outermost)]
    while waiting:
        text, element = waiting.pop()
        if element is None:
            yield text
            continue
        if dialect.delegation_attributes and isinstance(element, PortDelegation):
            element = _without_end(element)
        tag, attributes = _begun(element, dialect)
        inside = [child for field in SPELLINGS[type(element)].contained for child in getattr(element, field)]
        yield f"{text}<{tag}{attributes}{'' if inside else '/'}>"
        if inside:
            waiting.append((f"{text}</{tag}>", None))
            waiting.extend((text + "  ", child) for child in reversed(inside))


def _without_end(delegation: PortDelegation) -> PortDelegation:
    """``delegation`` with its one inner port in attributes; as it is if it does not have just one, or of that one more would be
    lost than its name.
    """
    if len(delegation.ends) != 1:
        return delegation
    (end,) = delegation.ends
    if end.comments or not (end.name and end.part and end.port):
        return delegation
    return msgspec.structs.replace(delegation, internal_part=end.part, internal_port=end.port, ends=())


def _begun(element: Element, dialect: Dialect) -> tuple[str, str]:
    """The tag of ``element`` and the text of its attributes."""
    spelling = SPELLINGS[type(element)]
    canonical = tag = spelling.tag
    left_out = ""
    if dialect.short_strings and isinstance(element, StringType):
        short = next((name for name, chars in SHORT_STRINGS.items() if chars == element.char_base), None)
        if short is not None:
            tag, left_out = short, "char_base"
    written = []
    for attribute, field in spelling.attributes.items():
        value = getattr(element, field)
        default = getattr(_EMPTY[type(element)], field)
        if field == left_out or value is None or (value == default and field not in spelling.required):
            continue
        text = str(value).lower() if isinstance(value, bool) else str(value)
        if field in spelling.literals:
            text = dialect.literals.get(text, text)
        called = dialect.attributes.get(f"{canonical}.{attribute}", dialect.attributes.get(attribute, attribute))
        written.append(f" {called}={_quoted(text)}")
    return dialect.tags.get(tag, tag), "".join(written)


_EMPTY = {cls: cls() for cls in SPELLINGS}


def _quoted(text: str) -> str:
    return quoteattr(text, {"\n": "&#10;", "\t": "&#9;", "\r": "&#13;"})
