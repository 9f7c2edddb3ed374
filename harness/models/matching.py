"""Which declaration of a framework is meant by one of the suite's, and which path by a reference."""

from __future__ import annotations

from typing import Any

from ucm_cts.harness.models.spellings import KNOWN_ATTRIBUTES, KNOWN_TAGS, Element, is_printed


def match(ours: Element, scope: Element, names: set[str]) -> Element | None:
    """The child of ``scope`` that is meant to be ``ours``, which may have one of ``names``: by kind and name, else by a name that
    nothing else has.
    """
    same_kind = [c for c in scope.children if c.tag == ours.tag]
    if not ours.name:
        return _match_nameless(ours, same_kind)
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
    return (segments(reference) or ("",))[-1]


def may_be(ours: Element, child: Element) -> bool:
    """Is ``child`` spelled in a way that the text never prints, so that it could be ``ours``?"""
    nameless = child.tag == ours.tag and bool(ours.name) and not child.name
    return child.tag not in KNOWN_TAGS or (nameless and bool(set(child.attributes) - KNOWN_ATTRIBUTES))


def is_strange(attribute: str, value: str, there: str) -> bool:
    """Is ``there`` written as the text never writes it: another word, or a role or an item without its pattern?"""
    bare = attribute in ("portRole", "interactionItem") and (there,) == segments(value)[-1:]
    return bare or not is_printed(attribute, there)


def same(one: Element, other: Element) -> bool:
    """Do both declare the same, in any order?"""
    return _form(one) == _form(other)


def _form(element: Element) -> tuple[Any, ...]:
    """The declarations, in any order."""
    return element.tag, tuple(sorted(element.attributes.items())), tuple(sorted(map(_form, element.children)))


def segments(reference: str) -> tuple[str, ...]:
    """The names in ``reference``."""
    return tuple(part for part in reference.replace(".", "::").split("::") if part)


def candidates(reference: str, element: Element) -> list[tuple[str, ...]]:
    """The paths that ``reference`` can mean at ``element``, the nearest first."""
    names = segments(reference)
    if reference.startswith("::") or element.parent is None:
        return [names[1:] if names[:1] == ("core",) else names]
    scope = element.parent.path
    paths = [scope[:depth] + names for depth in range(len(scope), -1, -1)]
    return [*paths, names[1:]] if names[:1] == ("core",) else paths
