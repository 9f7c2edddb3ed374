"""Values of each type wherever a value is given: as a constant, a default, or of a parameter (9.2.2.7, 9.2.6.1, 9.2.9.2).

Every operator adds a type of its own and one value of it, the greatest that the type has, or one that it has not.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

from lxml import etree

from ucm_cts.adapters.contract.metamodel.contracts import FLOAT_KINDS, INTEGER_RANGES
from ucm_cts.harness.toolchains.corpus.declarations import path, spare
from ucm_cts.harness.toolchains.operators.aspects import definition_of
from ucm_cts.harness.toolchains.operators.modules import module_of
from ucm_cts.harness.toolchains.operators.operator import breaks, family


class Typed(NamedTuple):
    """A type: its tag and attributes, a value that it has and values that it has not, each with a name."""

    tag: str
    attributes: dict[str, str]
    fits: str
    beyond: dict[str, str]


class Place(NamedTuple):
    """Where a value is given: ``put`` adds one of the type with that name, or returns False where it cannot."""

    at: str
    called: str
    accepts: str
    refuses: str
    put: Callable[[etree._Element, str, str], bool]


def _types() -> Iterator[tuple[str, Typed]]:
    for kind, (least, most) in INTEGER_RANGES.items():
        beyond = {"above": str(most + 1), "below": str(least - 1), "no_number": "many", "a_truth": "TRUE"}
        yield kind, Typed("PrimitiveInteger", {"kind": kind}, str(most), beyond)
    for kind in FLOAT_KINDS:
        yield kind, Typed("PrimitiveFloat", {"kind": kind}, "0.5", {"no_number": "half", "a_truth": "TRUE"})
    yield "BOOLEAN", Typed("PrimitiveBoolean", {}, "TRUE", {"no_truth": "perhaps", "a_number": "7"})


def _in_contracts(element: etree._Element) -> bool:
    return module_of(element).tag == "ContractModule"


def _constant(interface: etree._Element, type_: str, value: str) -> bool:
    module = module_of(interface)
    etree.SubElement(module, "Constant", name="valued_constant", type=type_, value=value)
    return module.tag == "ContractModule"


def _default(tag: str, **more: str) -> Callable[[etree._Element, str, str], bool]:
    def put(owner: etree._Element, type_: str, value: str) -> bool:
        owner.insert(0, etree.Element(tag, name="valued_member", type=type_, defaultValue=value, attrib=more))
        return True

    return put


def _annotation(element: etree._Element, type_: str, value: str) -> bool:
    definition = etree.SubElement(module_of(element), "AnnotationDefinition", name="valued_annotation")
    etree.SubElement(definition, "ConfigurationParameter", name="valued_parameter", type=type_)
    annotation = etree.Element("Annotation", annotationDefinition="valued_annotation")
    _value(annotation, "valued_annotation.valued_parameter", value)
    element.insert(0, annotation)
    return _in_contracts(element)


def _policy(policy: etree._Element, type_: str, value: str) -> bool:
    definition = definition_of(policy)
    if definition is None:
        return False
    etree.SubElement(definition, "ConfigurationParameter", name="valued_parameter", type=type_)
    _value(policy, f"{path(definition)}.valued_parameter", value)
    return True


def _value(owner: etree._Element, parameter: str, value: str) -> None:
    etree.SubElement(owner, "ConfigurationParameterValue", configurationParameter=parameter, value=value)


_DEFAULT = "R-9.2.2.7-01"
_PLACES = (
    Place("Interface", "constant", "R-9.2.6.1-02", "R-9.2.6.1-04", _constant),
    Place("Interface", "attribute", _DEFAULT, _DEFAULT, _default("Attribute", mode="READWRITE")),
    Place("ComponentType", "component_attribute", _DEFAULT, _DEFAULT, _default("Attribute", mode="READ")),
    Place("AnnotationDefinition", "annotation_parameter", _DEFAULT, _DEFAULT, _default("ConfigurationParameter")),
    Place("TechnicalPolicyDefinition", "policy_parameter", _DEFAULT, _DEFAULT, _default("ConfigurationParameter")),
    Place("ConnectorDefinition", "connector_parameter", _DEFAULT, _DEFAULT, _default("ConfigurationParameter")),
    Place("Interface", "value_of_an_annotation", "R-9.2.9.2-03", "R-9.2.9.2-03", _annotation),
    Place("ComponentTechnicalPolicy", "value_of_a_policy", "R-9.2.9.2-03", "R-9.2.9.2-03", _policy),
    Place("ComponentPortTechnicalPolicy", "value_of_a_port_policy", "R-9.2.9.2-03", "R-9.2.9.2-03", _policy),
)


def _register(place: Place, kind: str, typed: Typed, how: str, value: str) -> None:
    def change(element: etree._Element) -> bool:
        type_ = _new_type(element, typed)
        return bool(type_) and place.put(element, type_, value)

    said = place.called.replace("_", " ")
    because = f"A {said} of {kind} may be {value}" if how == "fits" else f"A {said} of {kind} is {value}"
    requirement = place.accepts if how == "fits" else place.refuses
    names = f"{place.called}_{kind.lower()}_{how}", f"values_{how}"
    family(requirement, place.at, names, because, change, how != "fits")


def _new_type(element: etree._Element, typed: Typed) -> str:
    """The name of a new type, in the module around ``element`` or in one of its own."""
    if not _in_contracts(element):
        return spare(element, typed.tag, **typed.attributes)
    etree.SubElement(module_of(element), typed.tag, {"name": "valued_type", **typed.attributes})
    return "valued_type"


_ANNOTATED = ("Attribute", "Constant", "Enumeration", "Method", "Structure", "StructureField", "Union", "UnionCase")


@breaks("R-9.2.9.2-03", at=_ANNOTATED)
def annotated_beyond(element: etree._Element) -> bool:
    """The value of its annotation is more than the parameter's type holds."""
    etree.SubElement(module_of(element), "PrimitiveInteger", name="valued_type", kind="UBYTE")
    return _annotation(element, "valued_type", "256")


for _place in _PLACES:
    for _kind, _typed in _types():
        for _how, _value_ in {"fits": _typed.fits, **_typed.beyond}.items():
            _register(_place, _kind, _typed, _how, _value_)
