"""Finds and adds declarations in a model of lxml elements in canonical spelling: what operators need to know of names."""

from __future__ import annotations

from collections.abc import Iterator

from lxml import etree

NOWHERE = "declared_nowhere"
"""A name that no model has."""

SPARE = "spare_contracts"
"""The outermost module that ``spare`` adds to."""


REFERENCES = (
    "abstractType",
    "actualType",
    "annotationDefinition",
    "api",
    "connectorItem",
    "definition",
    "exception",
    "extends",
    "indexType",
    "instanceOf",
    "interactionItem",
    "interface",
    "pattern",
    "portRole",
    "refines",
    "selectorType",
    "technicalAspect",
    "technicalPolicyDefinition",
    "type",
)
"""Attributes that name what a module declares, or a part of that behind a dot."""


def resolved(element: etree._Element, reference: str, *tags: str) -> etree._Element | None:
    """What ``reference`` means where ``element`` stands, if it has one of ``tags``; None if there is no such thing."""
    parts = reference.split("::")
    if not parts[0]:
        return next(_below(_outermost(element), parts[1:], tags), None)
    for module in element.iterancestors():
        if str(module.tag).endswith("Module"):
            found = next(_below(list(module), parts, tags), None)
            if found is not None:
                return found
    return next(_below(_outermost(element), parts, tags), None)


def member(element: etree._Element, reference: str, owner: str, tag: str) -> etree._Element | None:
    """What ``owner.member`` means where ``element`` stands: an element ``tag`` of the owner itself."""
    name, _, wanted = reference.rpartition(".")
    found = resolved(element, name, owner)
    return found.find(f"{tag}[@name='{wanted}']") if found is not None else None


def path(declaration: etree._Element) -> str:
    """The name of ``declaration`` from the root."""
    around = [a for a in declaration.iterancestors() if str(a.tag).endswith("Module")]
    return "".join(f"::{one.get('name')}" for one in (*reversed(around), declaration))


def spare(element: etree._Element, tag: str, **attributes: str) -> str:
    """The name, from the root, of a new contract of its own; empty where the model has no room for another outermost module."""
    root = element.getroottree().getroot()
    if root.tag != "Model":
        return ""
    module = root.find(f"ContractModule[@name='{SPARE}']")
    if module is None:
        module = etree.SubElement(root, "ContractModule", name=SPARE)
    name = f"spare_{tag.lower()}_{len(module)}"
    etree.SubElement(module, tag, {"name": name, **attributes})
    return f"::{SPARE}::{name}"


def spare_like(element: etree._Element, reference: str) -> str:
    """Another type of the kind that ``reference`` means where ``element`` stands: an interface or a data type."""
    return spare_interface(element) if is_interface(element, reference) else spare_data(element)


def spare_unlike(element: etree._Element, reference: str) -> str:
    """A type of the other kind."""
    return spare_data(element) if is_interface(element, reference) else spare_interface(element)


def spare_interface(element: etree._Element) -> str:
    """A new interface."""
    return spare(element, "Interface")


def spare_data(element: etree._Element) -> str:
    """A new data type."""
    return spare(element, "PrimitiveBoolean")


def is_interface(element: etree._Element, reference: str) -> bool:
    """Whether ``reference`` means an interface where ``element`` stands."""
    return resolved(element, reference, "Interface", "AbstractInterface") is not None


def _outermost(element: etree._Element) -> list[etree._Element]:
    root = element.getroottree().getroot()
    return list(root) if root.tag == "Model" else [root]


def _below(elements: list[etree._Element], parts: list[str], tags: tuple[str, ...]) -> Iterator[etree._Element]:
    for one in elements:
        if one.get("name") != parts[0]:
            continue
        if len(parts) == 1:
            if one.tag in tags:
                yield one
        elif str(one.tag).endswith("Module"):
            yield from _below(list(one), parts[1:], tags)
