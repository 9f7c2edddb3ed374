"""The standard property of 10.2 in a model: what wrong tool chains, and conformant variants, look at."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.common import walk
from ucm_cts.adapters.contract.metamodel.components import (
    AtomicComponentImplementation,
    ComponentType,
    CompositeComponentImplementation,
)
from ucm_cts.adapters.contract.metamodel.modules import Model

PROPERTIES = ("properties",)
"""What a tool chain claims that is asked about the property."""

PROPERTY = "::standard_properties::component_description_prop"
PARAMETERS = ("description", "category", "version", "vendor")

Carrier = ComponentType | AtomicComponentImplementation | CompositeComponentImplementation


def is_property(annotation: c.Annotation) -> bool:
    """Whether ``annotation`` is the standard property."""
    return annotation.annotation_definition == PROPERTY


def texts_of(annotation: c.Annotation) -> dict[str, str]:
    """By the names of parameters: the values of the property ``annotation``, as the model has them; empty for another annotation."""
    if not is_property(annotation):
        return {}
    return {v.configuration_parameter.rpartition(".")[2]: v.value or "" for v in annotation.configuration_values}


def carried(carrier: Carrier) -> dict[str, str]:
    """The values of the property on ``carrier``."""
    return {name: text for annotation in carrier.annotations for name, text in texts_of(annotation).items()}


def documentation(model: Model) -> Iterator[tuple[Carrier, dict[str, str]]]:
    """Each documented component of ``model``, with the values of its property."""
    for element in (element for module in model.modules for element in walk(module)):
        if isinstance(element, Carrier):
            texts = carried(element)
            if texts:
                yield element, texts
