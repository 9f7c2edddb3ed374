"""Operators as data: edits of attributes, children and neighbours of an element, in ``suite/models/edits.yaml``."""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping
from typing import Any

import msgspec
from lxml import etree

from ucm_cts.adapters.contract.metamodel.contracts import INTEGER_RANGES
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import read
from ucm_cts.harness.catalogue.requirements import SUITE
from ucm_cts.harness.toolchains.corpus import declarations as decl
from ucm_cts.harness.toolchains.operators.modules import module_of, without
from ucm_cts.harness.toolchains.operators.operator import Change, breaks, keeps

EDITS = SUITE / "models" / "edits.yaml"

Attributes = dict[str, str | dict[str, str] | None]
"""A value is a text, or one of ``VALUES`` by its name with its argument; None takes the attribute out."""


class New(msgspec.Struct, frozen=True, array_like=True):
    """A new element with attributes and children."""

    tag: str
    """Or ``=`` and the XPath of the element that is copied; its copy has other ``attributes`` then."""
    attributes: Attributes
    children: tuple[New, ...] = ()


class Edit(Value, frozen=True):
    """An edit at an element with the tag ``at``, or one of them, that breaks a requirement or keeps it (one of both is given).

    It applies if all values can be had, ``where`` holds and ``of`` finds something.
    """

    at: str | tuple[str, ...]
    name: str
    because: str
    breaks: str = ""
    keeps: str = ""
    where: str = ""
    """XPath condition on the element."""
    of: str = "."
    """XPath of the elements that are edited, from the element."""
    remove: str = ""
    """XPath of what is taken out."""
    without: str = ""
    """The tag of children that are all taken out; then what is left ends in the line of the last child."""
    last: str = ""
    """XPath of the children that become the last ones."""
    again: Attributes | None = None
    """The attributes in which a copy right after the element differs."""
    first: tuple[New, ...] = ()
    """New first children, the last one foremost."""
    add: tuple[New, ...] = ()
    """New last children."""
    beside: tuple[New, ...] = ()
    """New elements right after the element."""
    in_module: tuple[New, ...] = ()
    """New last declarations of the nearest module around."""
    set: Attributes = {}
    """Attributes of the element."""
    under: tuple[str, ...] = ()
    """The readings (``option=value``) that must be declared."""


class _NoValue(Exception):
    """A value cannot be had in this model."""


def _found(element: etree._Element, expression: str) -> Any:
    return element.xpath(expression, extensions={(None, "resolved"): _resolved})


def _resolved(context: Any, reference: list[str], tag: str) -> list[etree._Element]:
    """XPath function: the declaration ``tag`` that an attribute of the element names."""
    found = decl.resolved(context.context_node, str(reference[0]), tag) if reference else None
    return [] if found is None else [found]


def _member(member: etree._Element) -> str:
    return f"{decl.path(next(member.iterancestors()))}.{member.get('name')}"


def _above(element: etree._Element, expression: str, by: int) -> str:
    kind = str(_found(element, f"string({expression})"))
    return str(INTEGER_RANGES[kind][1] + by) if kind in INTEGER_RANGES else ""


VALUES: Mapping[str, Callable[[etree._Element, str], str]] = {
    "xpath": lambda element, expression: str(_found(element, f"string({expression})")),
    "path": lambda element, expression: decl.path(_found(element, expression)[0]),
    "member": lambda element, expression: _member(_found(element, expression)[0]),
    "most": lambda element, expression: _above(element, expression, 0),
    "beyond": lambda element, expression: _above(element, expression, 1),
    "spare": decl.spare,
    "like": lambda element, attribute: decl.spare_like(element, str(element.get(attribute))),
    "unlike": lambda element, attribute: decl.spare_unlike(element, str(element.get(attribute))),
    "stranger": lambda element, attribute: f"{str(element.get(attribute)).rpartition('.')[0]}.{decl.NOWHERE}",
}
"""Values that depend on the element. ``xpath``: the text of an XPath; ``path`` and ``member``: the name, from the root, of the
declaration or the member that an XPath finds; ``most`` and ``beyond``: the greatest number of the integer kind that an XPath yields,
and one more; ``spare``: the name of a new contract of a tag; ``like`` and ``unlike``: a new type of
the kind that an attribute names, or of the other kind; ``stranger``: a member that the owner named by an attribute does not have.
"""


def _put(element: etree._Element, attributes: Attributes, of: etree._Element) -> None:
    """Set attributes of ``element`` to values that are computed at ``of``."""
    for attribute, value in attributes.items():
        if value is None:
            element.attrib.pop(attribute, "")
            continue
        if not isinstance(value, str):
            ((function, argument),) = value.items()
            value = VALUES[function](of, argument)
            if not value:
                raise _NoValue
        element.set(attribute, value)


def _made(new: New, of: etree._Element) -> etree._Element:
    element = copy.deepcopy(_found(of, new.tag[1:])[0]) if new.tag[0] == "=" else etree.Element(new.tag)
    _put(element, new.attributes, of)
    element.extend([_made(child, of) for child in new.children])
    return element


def _edit(edit: Edit, element: etree._Element) -> None:
    for one in edit.first:
        element.insert(0, _made(one, element))
    for one in edit.in_module:
        module_of(element).append(_made(one, element))
    for one in edit.add:
        element.append(_made(one, element))
    for one in edit.beside:
        element.addnext(_made(one, element))
    if edit.again is not None:
        again = copy.deepcopy(element)
        _put(again, edit.again, element)
        element.addnext(again)
    element.extend(_found(element, edit.last) if edit.last else ())
    for unwanted in _found(element, edit.remove) if edit.remove else ():
        unwanted.getparent().remove(unwanted)
    if edit.without:
        without(element, edit.without)
    _put(element, edit.set, element)


def _change(edit: Edit) -> Change:
    def change(element: etree._Element) -> bool:
        if edit.where and not _found(element, f"boolean({edit.where})"):
            return False
        edited = _found(element, edit.of)
        try:
            for one in edited:
                _edit(edit, one)
        except _NoValue:
            return False
        return bool(edited)

    change.__name__, change.__doc__ = edit.name, edit.because
    return change


for _one in read(EDITS, list[Edit]):
    _register = breaks if _one.breaks else keeps
    _register(_one.breaks or _one.keeps, _one.at, _one.under)(_change(_one))
