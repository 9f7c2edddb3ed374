"""Rules of 9.4: nonfunctional aspect modules, technical aspects and policy definitions."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel.aspects import (
    NonfunctionalAspectModule,
    ProgrammingLanguages,
    TechnicalAspect,
    TechnicalPolicyDefinition,
)
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.reference.toolchain.checking import Complaint, rule
from ucm_cts.adapters.reference.toolchain.rules.circles import circle, circle_complaint
from ucm_cts.adapters.reference.toolchain.rules.inheritance import parents, redefined


@rule("R-9.4.2.1-04", NonfunctionalAspectModule)
def lists_languages_once(module: NonfunctionalAspectModule, _scope: Scope) -> Iterator[Complaint]:
    """A module has one list of languages or none."""
    for again in module.supported_languages[1:]:
        yield again, f"module {module.name} lists programming languages already; put these into the first list"


@rule("R-9.4.4.1-01", ProgrammingLanguages)
def lists_some_language(languages: ProgrammingLanguages, _scope: Scope) -> Iterator[Complaint]:
    """A list of languages is not empty."""
    if not languages.languages:
        yield languages, "the list of programming languages is empty; name one or leave it out"


@rule("R-9.4.3.2-03", TechnicalPolicyDefinition)
def specifies_an_aspect(definition: TechnicalPolicyDefinition, scope: Scope) -> Iterator[Complaint]:
    """What a definition specifies is an aspect that is there."""
    if scope.find(definition.technical_aspect, TechnicalAspect) is None:
        yield (
            definition,
            f"policy {definition.name} is of '{definition.technical_aspect}', which is no technical aspect; declare it",
        )


@rule("R-9.4.3.2-09", TechnicalPolicyDefinition)
def extends_a_definition(definition: TechnicalPolicyDefinition, scope: Scope) -> Iterator[Complaint]:
    """What a definition extends is a definition that is there."""
    if definition.extends and scope.find(definition.extends, TechnicalPolicyDefinition) is None:
        yield (
            definition,
            f"policy {definition.name} extends '{definition.extends}', which is no policy definition; declare it",
        )


@rule("R-9.4.3.2-14", Model)
def definitions_do_not_extend_themselves(_model: Model, root: Scope) -> Iterator[Complaint]:
    """Extending comes to an end."""
    yield from circle_complaint(
        circle(root, [TechnicalPolicyDefinition], parents), "extends", "policy ", "let it extend another one"
    )


@rule("R-9.4.3.2-12", TechnicalPolicyDefinition)
def port_elements_are_not_redefined(definition: TechnicalPolicyDefinition, scope: Scope) -> Iterator[Complaint]:
    """A definition has the port elements of its ancestors already."""
    yield from redefined(definition, scope, "port_elements", "port element")


@rule("R-9.4.3.2-13", TechnicalPolicyDefinition)
def parameters_are_not_redefined(definition: TechnicalPolicyDefinition, scope: Scope) -> Iterator[Complaint]:
    """A definition has the parameters of its ancestors already."""
    yield from redefined(definition, scope, "configuration_parameters", "parameter")
