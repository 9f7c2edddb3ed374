"""The standard property of 10.2 in models: how it is written, and one model without it, with it and with other values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lxml import etree

from ucm_cts.harness.catalogue.requirements import SUITE

PART = "properties"
"""The capability of those who are asked."""

PROPERTY = "::standard_properties::component_description_prop"
PARAMETERS = ("description", "category", "version", "vendor")
"""What the property sets, in the order of their declarations."""

CARRIERS = ("ComponentType", "AtomicComponentImplementation", "CompositeComponentImplementation")
"""The elements that carry it (interpretation property-carriers)."""

DOCUMENTATION = "R-10.2-13", "properties_only_document"
"""What a generator breaks that makes something else of documented components, and the rule that finds it."""

DOCUMENTED = "composite_example"
"""The legal model whose components are documented."""

WITHOUT = f"undocumented_{DOCUMENTED}"

_TEXTS: Mapping[str, Sequence[str]] = {
    WITHOUT: (),
    f"documented_{DOCUMENTED}": ("Makes numbers", "sources", "1.0", "Number makers"),
    f"redocumented_{DOCUMENTED}": (
        "Ends a comment: */ struct surprise { long number; }; /* and opens one",
        "internal, deprecated, abstract",
        "2.0; // see C:\\\\numbers\\\\",
        "",
    ),
}
"""By the names of the models: the values of the parameters. The third has what ends a comment, or goes on with it in the next line, if
it is copied into one as it is.
"""


def documented_models(plain: str) -> Mapping[str, str]:
    """The models that code is generated from for 10.2, by name, made of the model ``plain``."""
    return {name: _documented(plain, texts) for name, texts in _TEXTS.items()}


def _documented(text: str, texts: Sequence[str]) -> str:
    """The model ``text`` with the property's declaration, and on each carrier the property with these ``texts`` if there are any."""
    root = etree.fromstring(text.encode())
    root.insert(0, etree.parse(SUITE / "models" / "legal" / "standard_properties.xml").getroot())
    for carrier in root.iter(*CARRIERS):
        if texts:
            carrier.insert(0, _property(texts))
    return etree.tostring(root, encoding="unicode")


def _property(texts: Sequence[str]) -> etree._Element:
    """The property with a value for each parameter: a text in quotes (interpretation property-values)."""
    made = etree.Element("Annotation", annotationDefinition=PROPERTY)
    for parameter, text in zip(PARAMETERS, texts, strict=True):
        attributes = {"configurationParameter": f"{PROPERTY}.{parameter}", "value": f'"{text}"'}
        etree.SubElement(made, "ConfigurationParameterValue", attributes)
    return made


def value_of(annotation: etree._Element, parameter: str) -> etree._Element | None:
    """What gives ``parameter`` its value in ``annotation``; None if nothing does, or ``annotation`` is no such property."""
    if annotation.get("annotationDefinition") != PROPERTY:
        return None
    return annotation.find(f"ConfigurationParameterValue[@configurationParameter='{PROPERTY}.{parameter}']")
