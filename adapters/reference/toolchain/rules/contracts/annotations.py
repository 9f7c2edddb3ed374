"""Rules of 9.2.9: annotations and the values that they set."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope
from ucm_cts.adapters.reference.toolchain.checking import Complaint, rule
from ucm_cts.adapters.reference.toolchain.rules.contracts.constant_syntax import NotAConstant
from ucm_cts.adapters.reference.toolchain.rules.contracts.constant_values import NoValueOfType, fit


@rule("R-9.2.9.4-01", c.Annotation)
def has_a_definition(annotation: c.Annotation, scope: Scope) -> Iterator[Complaint]:
    """What an annotation refers to is an annotation definition that is there."""
    if scope.find(annotation.annotation_definition, c.AnnotationDefinition) is None:
        yield (
            annotation,
            f"'{annotation.annotation_definition}' is no annotation definition; declare it or name another one",
        )


@rule("R-9.2.9.2-01", c.Annotation)
def values_name_parameters(annotation: c.Annotation, scope: Scope) -> Iterator[Complaint]:
    """What gets a value in an annotation is a parameter that is there."""
    for value in annotation.configuration_values:
        if _parameter(value, scope) is None:
            yield value, f"'{value.configuration_parameter}' is no configuration parameter; say definition.parameter"


@rule("R-9.2.9.4-02", c.Annotation)
def sets_parameters_of_its_definition(annotation: c.Annotation, scope: Scope) -> Iterator[Complaint]:
    """The parameters are those of the annotation's own definition."""
    definition = scope.find(annotation.annotation_definition, c.AnnotationDefinition)
    if definition is None:
        return
    assert isinstance(definition.element, c.AnnotationDefinition)
    own = {id(parameter) for parameter in definition.element.configuration_parameters}
    for value in annotation.configuration_values:
        parameter = _parameter(value, scope)
        if parameter is not None and id(parameter.element) not in own:
            yield (
                value,
                f"{value.configuration_parameter} is no parameter of {definition.element.name}; set one of its own",
            )


@rule("R-9.2.9.4-03", c.Annotation, under="repeated-parameter-values=refused")
def sets_parameters_once(annotation: c.Annotation, scope: Scope) -> Iterator[Complaint]:
    """A parameter has one value."""
    seen: set[int] = set()
    for value in annotation.configuration_values:
        parameter = _parameter(value, scope)
        if parameter is not None and id(parameter.element) in seen:
            yield value, f"{value.configuration_parameter} gets a second value; take one of them out"
        if parameter is not None:
            seen.add(id(parameter.element))


@rule("R-9.2.9.2-03", c.ConfigurationParameterValue)
def values_fit_their_parameters(value: c.ConfigurationParameterValue, scope: Scope) -> Iterator[Complaint]:
    """The value is one that the parameter's type has, of an annotation's parameter and of a policy's."""
    parameter = _parameter(value, scope) or scope.member(
        value.configuration_parameter, TechnicalPolicyDefinition, "configuration_parameters"
    )
    if parameter is None or not value.value:
        return
    assert isinstance(parameter.element, c.ConfigurationParameter)
    try:
        fit(value.value, parameter.element.type, parameter.scope)
    except (NotAConstant, NoValueOfType) as error:
        yield value, f"the value of {value.configuration_parameter} is {value.value[:80]}: {error}"


def _parameter(value: c.ConfigurationParameterValue, scope: Scope) -> Declared | None:
    return scope.member(value.configuration_parameter, c.AnnotationDefinition, "configuration_parameters")
