"""Edits of the standard property of 10.2 where a model has it: the names, the number, the order and the texts of its values."""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping

from lxml import etree

from ucm_cts.harness.toolchains.corpus.documentation import PARAMETERS, PART, PROPERTY, value_of
from ucm_cts.harness.toolchains.operators.modules import module_of
from ucm_cts.harness.toolchains.operators.operator import breaks, keeps

OPTIONAL, REQUIRED = (f"property-values={value}" for value in ("optional", "required"))
BARE = "text-values=bare"

LONG = "0123456789" * 1_000
"""A text of 10,000 characters."""

_OTHER_CASE = ("Description", "CATEGORY", "versioN", "venDor")
"""The names of the parameters, with letters of the other case."""

_TEXTS: Mapping[str, tuple[str, tuple[str, ...]]] = {
    "is_empty": ('""', ()),
    "is_long": (f'"{LONG}"', ()),
    "is_bare": ("without quotes", (BARE,)),
    "is_bare_and_empty": ("", (BARE,)),
    "is_bare_and_long": (LONG, (BARE,)),
}
"""Values that the parameters may have, and the readings under which they may."""


def _is_property(annotation: etree._Element) -> bool:
    return annotation.get("annotationDefinition") == PROPERTY


@keeps("R-10.2-10", at="Annotation", under=(PART,))
def property_in_another_order(annotation: etree._Element) -> bool:
    """Values may stand in any order."""
    annotation.extend(list(reversed(annotation)))
    return _is_property(annotation)


@keeps("R-10.2-10", at="Annotation", under=(PART,))
def property_like_that_of_others(annotation: etree._Element) -> bool:
    """Several components may have the same values."""
    carrier = annotation.getparent()
    if carrier is None or not _is_property(annotation):
        return False
    module_of(carrier).append(etree.Element("ComponentType", name="documented_alike"))
    module_of(carrier)[-1].append(copy.deepcopy(annotation))
    return True


@keeps("R-10.2-10", at="AnnotationDefinition", under=(PART,))
def property_declared_last(definition: etree._Element) -> bool:
    """The property may be declared after its use."""
    module = module_of(definition)
    root = module.getparent()
    if root is None or module.get("name") != "standard_properties":
        return False
    root.append(module)
    return True


@breaks("R-10.2-11", at="Annotation", under=(PART,))
def property_with_a_fifth_value(annotation: etree._Element) -> bool:
    """The property has no such parameter."""
    annotation.append(_stranger())
    return _is_property(annotation)


@breaks("R-10.2-11", at="Annotation", under=(PART,))
def property_that_begins_with_a_fifth_value(annotation: etree._Element) -> bool:
    """The property has no such parameter."""
    annotation.insert(0, _stranger())
    return _is_property(annotation)


def _stranger() -> etree._Element:
    attributes = {"configurationParameter": f"{PROPERTY}.author", "value": '"Somebody"'}
    return etree.Element("ConfigurationParameterValue", attributes)


def _without_values(annotation: etree._Element) -> bool:
    for value in annotation.findall("ConfigurationParameterValue"):
        annotation.remove(value)
    return _is_property(annotation)


def _without(parameter: str) -> Callable[[etree._Element], bool]:
    def change(annotation: etree._Element) -> bool:
        value = value_of(annotation, parameter)
        if value is not None:
            annotation.remove(value)
        return value is not None

    return change


def _setting(parameter: str, attribute: str, text: str) -> Callable[[etree._Element], bool]:
    def change(annotation: etree._Element) -> bool:
        value = value_of(annotation, parameter)
        if value is not None:
            value.set(attribute, text)
        return value is not None

    return change


def _named(change: Callable[[etree._Element], bool], name: str, because: str) -> Callable[[etree._Element], bool]:
    def renamed(annotation: etree._Element) -> bool:
        return change(annotation)

    renamed.__name__, renamed.__doc__ = name, because
    return renamed


def _register_missing(what: str, change: Callable[[etree._Element], bool]) -> None:
    """Who says that values are optional accepts a property that lacks some, who says that they are required refuses it."""
    lacking = _named(change, f"property_may_lack_{what}", "It is declared that values are optional")
    keeps("R-10.2-11", "Annotation", (PART, OPTIONAL))(lacking)
    lacking = _named(change, f"property_lacks_{what}", f"It is declared that values are required, and it lacks {what}")
    breaks("R-10.2-11", "Annotation", (PART, REQUIRED))(lacking)


_register_missing("all_values", _without_values)
for _parameter, _miswritten in zip(PARAMETERS, _OTHER_CASE, strict=True):
    _register_missing(_parameter, _without(_parameter))
    breaks("R-10.2-11", "Annotation", (PART,))(
        _named(
            _setting(_parameter, "configurationParameter", f"{PROPERTY}.{_miswritten}"),
            f"property_sets_{_parameter}_in_another_case",
            f"The parameter is called {_parameter}, and not {_miswritten}",
        )
    )
    for _how, (_text, _under) in _TEXTS.items():
        keeps("R-10.2-12", "Annotation", (PART, *_under))(
            _named(_setting(_parameter, "value", _text), f"{_parameter}_{_how}", f"The {_parameter} may be any text")
        )
