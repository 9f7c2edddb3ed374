"""What clause 9 has and the text prints no XML of: who accepts no model with such a thing is not failed for our spelling of it.

Our models then call it by the name of its class or field. A vendor who says in his dialect how it is spelled is held to that;
so is one who declares that he reads native types or simple comments, of which models are sent to nobody else.
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
"""Each of them, and how it is found in the text of a model that a tool chain gets."""


def refused_for_spelling(texts: Mapping[str, str], accepted: Mapping[str, bool | None]) -> Mapping[str, str]:
    """The names in ``accepted`` of models that may have been refused for how something unprinted is spelled alone, and what
    that is; ``texts`` are the models by name.
    """
    refused = [name for name, answer in accepted.items() if answer is False]
    known = [name for name, answer in accepted.items() if answer]
    found: dict[str, str] = {}
    for construct, pattern in CONSTRUCTS.items():
        having = [name for name in refused if pattern.search(texts[name])]
        if having and not any(pattern.search(texts[name]) for name in known):
            told = f"the text prints no {construct}, and no model with one was accepted"
            found |= {name: told for name in having if name not in found}
    return found
