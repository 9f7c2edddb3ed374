"""Constructs of clause 9 whose XML spelling the specification does not print.

A tool chain that accepts no model with such a construct is not failed for the spelling of the suite, which uses the name of the
class or field.

A vendor whose dialect says how the construct is spelled is held to that; so is a vendor who declares support for native types or
simple comments, because models with those go to no other vendor.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

_ELEMENTS = (
    "AbstractInterface",
    "Alias",
    "Annotation",
    "AnnotationDefinition",
    "ApplicationModule",
    "Array",
    "ArrayDimension",
    "ComponentPortTechnicalPolicy",
    "CompositeComponentImplementation",
    "Constant",
    "Exception",
    "ExceptionField",
    "InheritedInterface",
    "InteractionItemBinding",
    "ManagedPort",
    "PlatformModule",
    "PortRoleSpec",
    "PrimitiveChar",
    "PrimitiveFloat",
    "RaisedException",
    "SelectorValue",
    "Sequence",
    "Union",
    "UnionCase",
)

_ATTRIBUTES = (
    ("ComponentType", "refines"),
    ("InteractionPattern", "extends"),
    ("Port", "refinesPort"),
    ("StringType", "maxSize"),
)

CONSTRUCTS: Mapping[str, re.Pattern[str]] = {
    "root around several outermost modules": re.compile(r"\A(?:\s|<\?.*?\?>|<!--.*?-->)*<Model\b", re.DOTALL),
    **{f"element {tag}": re.compile(rf"<{tag}\b") for tag in _ELEMENTS},
    **{f"attribute {a} of {tag}": re.compile(rf"<{tag}\b[^>]*\s{a}\s*=") for tag, a in _ATTRIBUTES},
    "attribute of a component type": re.compile(
        r"<ComponentType\b[^>]*(?<!/)>(?:(?!</ComponentType>).)*<Attribute\b", re.DOTALL
    ),
}
"""Each construct, and the pattern that finds it in the text of a model."""


def refused_for_spelling(texts: Mapping[str, str], accepted: Mapping[str, bool | None]) -> Mapping[str, str]:
    """The models that may have been refused only for an unspecified spelling, and why.

    ``texts`` are models by name, and ``accepted`` says of each whether it was; None stands for no answer.
    """
    refused = [name for name, answer in accepted.items() if answer is False]
    known = [name for name, answer in accepted.items() if answer]
    found: dict[str, str] = {}
    for construct, pattern in CONSTRUCTS.items():
        having = [name for name in refused if pattern.search(texts[name])]
        if having and not any(pattern.search(texts[name]) for name in known):
            why = f"the specification prints no {construct}, and no model with one was accepted"
            found |= {name: why for name in having if name not in found}
    return found
