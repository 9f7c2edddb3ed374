"""Tool chains that treat the standard property of 10.2 wrongly when they check models."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.components import (
    AtomicComponentImplementation,
    ComponentType,
    CompositeComponentImplementation,
)
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.mutants.toolchain.checking import When, refusing, without
from ucm_cts.adapters.mutants.toolchain.documentation import (
    PARAMETERS,
    PROPERTIES,
    carried,
    documentation,
    is_property,
    texts_of,
)
from ucm_cts.adapters.mutants.toolchain.registry import Derive, breaks, complaining_where, named
from ucm_cts.adapters.reference.toolchain.checking import Complaint, Rule
from ucm_cts.adapters.reference.toolchain.program import Program

OPTIONAL, REQUIRED = (f"property-values={value}" for value in ("optional", "required"))
NAMES = "values_name_parameters"
"""The rule that names of parameters are those of the definition."""


def refuses(requirement: str, *declares: str) -> Callable[[When], Derive]:
    """Register a condition as the mutant that refuses each element for which it holds, and claims the standard properties."""
    return lambda when: breaks(requirement, declares=declares, claims=PROPERTIES)(refusing(when))


# R-10.2-10: who carries it


@refuses("R-10.2-10")
def no_property_on_types(component: ComponentType, _: Scope) -> object:
    """Knows the property of implementations only."""
    return carried(component)


@refuses("R-10.2-10")
def no_property_on_bodies(component: AtomicComponentImplementation, _: Scope) -> object:
    """Knows no property of atomic implementations."""
    return carried(component)


@refuses("R-10.2-10")
def no_property_on_composites(component: CompositeComponentImplementation, _: Scope) -> object:
    """Knows no property of composites."""
    return carried(component)


@refuses("R-10.2-10")
def one_property_a_model(model: Model, _: Scope) -> object:
    """Takes a second documented component for an error."""
    return len(list(documentation(model))) > 1


@refuses("R-10.2-10")
def no_components_alike(model: Model, _: Scope) -> object:
    """Takes two components with the same documentation for an error."""
    said = [sorted(texts.items()) for _, texts in documentation(model)]
    return any(one in said[number + 1 :] for number, one in enumerate(said))


@refuses("R-10.2-10")
def three_values_at_most(annotation: c.Annotation, _: Scope) -> object:
    """Has no room for the fourth value."""
    return len(texts_of(annotation)) > 3


@refuses("R-10.2-10")
def values_in_declared_order(annotation: c.Annotation, _: Scope) -> object:
    """Takes values in another order than that of the parameters for an error."""
    found = [name for name in texts_of(annotation) if name in PARAMETERS]
    return found != sorted(found, key=PARAMETERS.index)


@refuses("R-10.2-10")
def property_before_its_use(model: Model, _: Scope) -> object:
    """Takes a property that is declared after its use for an error."""
    names = [module.name for module in model.modules]
    return "standard_properties" in names[1:] and any(documentation(model))


# R-10.2-11: four parameters


def hears_only(holds: Callable[[c.ConfigurationParameterValue, c.Annotation], object]) -> Derive:
    """Register a condition as the mutant in which unknown parameters of the property count only where it holds."""

    def derive(program: Program) -> Program:
        def counts(wrong: Any, annotation: Any, _scope: Scope, _message: str) -> bool:
            return not is_property(annotation) or bool(holds(wrong, annotation))

        return complaining_where(program, NAMES, counts)

    return breaks("R-10.2-11", claims=PROPERTIES)(named(derive, holds.__name__, holds.__doc__))


def _name(value: c.ConfigurationParameterValue) -> str:
    return value.configuration_parameter.rpartition(".")[2]


@hears_only
def fifth_values(value: c.ConfigurationParameterValue, _: c.Annotation) -> object:
    """Accepts a value for a parameter that the property does not have."""
    return _name(value).lower() in PARAMETERS


@hears_only
def names_in_any_case(value: c.ConfigurationParameterValue, _: c.Annotation) -> object:
    """Does not tell upper case from lower case in the names of the parameters."""
    return _name(value).lower() not in PARAMETERS


@hears_only
def vendors_in_any_case(value: c.ConfigurationParameterValue, _: c.Annotation) -> object:
    """Does not tell upper case from lower case in the name of one parameter."""
    return _name(value).lower() != "vendor"


@hears_only
def capitals_at_the_beginning(value: c.ConfigurationParameterValue, _: c.Annotation) -> object:
    """Accepts names of parameters that begin with a capital letter."""
    return _name(value) not in [name.capitalize() for name in PARAMETERS]


@hears_only
def looks_at_four_values(value: c.ConfigurationParameterValue, annotation: c.Annotation) -> object:
    """Looks at the first four values of the property, and at no other."""
    return value in annotation.configuration_values[:4]


@hears_only
def looks_at_the_last_value(value: c.ConfigurationParameterValue, annotation: c.Annotation) -> object:
    """Looks at the last value of the property, and at no other."""
    return value is annotation.configuration_values[-1]


@breaks("R-10.2-11", claims=PROPERTIES)
def composites_have_any_parameter(program: Program) -> Program:
    """Checks the names of parameters on component types and atomic implementations, and not on composites."""
    known = program.rules[NAMES]

    def complaints(element: Element, scope: Scope) -> Iterator[Complaint]:
        for annotation in getattr(element, "annotations", ()):
            if not (isinstance(element, CompositeComponentImplementation) and is_property(annotation)):
                yield from known.complaints(annotation, scope)

    rule = Rule("names_of_most", known.requirement, (c.Annotable,), complaints)
    program = without(program, NAMES)
    return replace(program, rules={**program.rules, rule.name: rule})


def lacking(annotation: c.Annotation, *names: str) -> bool:
    """Whether ``annotation`` is the property and lacks a value for one of the parameters ``names``."""
    return is_property(annotation) and not texts_of(annotation).keys() >= set(names)


@refuses("R-10.2-11", REQUIRED)
def vendor_may_be_missing(annotation: c.Annotation, _: Scope) -> bool:
    """Says that all values are required, and does not ask for the vendor."""
    return lacking(annotation, "description", "category", "version")


@refuses("R-10.2-11", REQUIRED)
def one_value_is_enough(annotation: c.Annotation, _: Scope) -> bool:
    """Says that all values are required, and asks for one."""
    return is_property(annotation) and not texts_of(annotation)


@refuses("R-10.2-11", OPTIONAL)
def description_is_required(annotation: c.Annotation, _: Scope) -> bool:
    """Says that values are optional, and asks for a description."""
    return lacking(annotation, "description")


@refuses("R-10.2-11", OPTIONAL)
def some_value_is_required(annotation: c.Annotation, _: Scope) -> bool:
    """Says that values are optional, and asks for one at least."""
    return is_property(annotation) and not texts_of(annotation)


# R-10.2-12: texts of any length


def _texts(annotation: c.Annotation) -> list[str]:
    """The texts of the property without their quotes."""
    return [text.removeprefix('"').removesuffix('"') for text in texts_of(annotation).values()]


@refuses("R-10.2-12")
def no_empty_texts(annotation: c.Annotation, _: Scope) -> bool:
    """Takes an empty text for a value that is missing."""
    return "" in _texts(annotation)


@refuses("R-10.2-12")
def texts_of_255_characters(annotation: c.Annotation, _: Scope) -> bool:
    """Has room for 255 characters."""
    return any(len(text) > 255 for text in _texts(annotation))


@refuses("R-10.2-12")
def texts_of_8192_characters(annotation: c.Annotation, _: Scope) -> bool:
    """Has room for 8,192 characters."""
    return any(len(text) > 8192 for text in _texts(annotation))


@refuses("R-10.2-12")
def short_versions(annotation: c.Annotation, _: Scope) -> bool:
    """Has room for 32 characters of a version."""
    return len(texts_of(annotation).get("version", "")) > 32


@refuses("R-10.2-12")
def some_vendor(annotation: c.Annotation, _: Scope) -> bool:
    """Asks for a vendor that is not empty."""
    return texts_of(annotation).get("vendor") == '""'


@refuses("R-10.2-12")
def short_texts_on_composites(component: CompositeComponentImplementation, _: Scope) -> bool:
    """Has room for 1,024 characters about a composite."""
    return any(len(text) > 1024 for text in carried(component).values())
