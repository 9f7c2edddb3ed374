"""Rules of 9.5.4.1 and of 9.4.3.1 as far as implementations keep them: languages, and how many policies of an aspect."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel.aspects import NonfunctionalAspectModule, TechnicalAspect
from ucm_cts.adapters.contract.metamodel.components import AtomicComponentImplementation, ComponentTechnicalPolicy
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.reference.toolchain.checking import Complaint, rule
from ucm_cts.adapters.reference.toolchain.rules.circles import declared_in
from ucm_cts.adapters.reference.toolchain.rules.components.policy_use import uses


@rule("R-9.5.4.1-02", Model)
def languages_are_listed(_model: Model, root: Scope) -> Iterator[Complaint]:
    """The language of an implementation is one that some module lists."""
    listed = {
        language.name
        for module in declared_in(root, NonfunctionalAspectModule)
        for languages in getattr(module.element, "supported_languages", ())
        for language in languages.languages
    }
    for declared in declared_in(root, AtomicComponentImplementation):
        language = getattr(declared.element, "language", "")
        if language not in listed:
            known = ", ".join(sorted(listed)) or "none"
            yield (
                declared.element,
                f"implementation {declared.element.name} is in '{language}', which no module lists; listed is {known}",
            )


@rule("R-9.5.4.1-04", AtomicComponentImplementation)
def policies_are_there(implementation: AtomicComponentImplementation, scope: Scope) -> Iterator[Complaint]:
    """What an implementation names as a policy is one."""
    for policy in implementation.policies:
        if scope.find(policy.name, ComponentTechnicalPolicy) is None:
            yield (
                policy,
                f"implementation {implementation.name} has '{policy.name}', which is no component technical policy; declare it",
            )


@rule("R-9.4.1-03", Model, under="missing-policies=check")
def has_the_one_policy(_model: Model, root: Scope) -> Iterator[Complaint]:
    """An aspect that wants exactly one policy has one."""
    yield from _too_few(root, "exactlyOne")


@rule("R-9.4.3.1-06", Model, under="missing-policies=check")
def has_at_least_one_policy(_model: Model, root: Scope) -> Iterator[Complaint]:
    """An aspect that wants at least one policy has one."""
    yield from _too_few(root, "atLeastOne")


@rule("R-9.4.1-04", Model)
def has_the_one_policy_only(_model: Model, root: Scope) -> Iterator[Complaint]:
    """An aspect that wants exactly one policy has no second one."""
    yield from _too_many(root, "exactlyOne")


@rule("R-9.4.3.1-05", Model)
def has_at_most_one_policy(_model: Model, root: Scope) -> Iterator[Complaint]:
    """An aspect that wants at most one policy has no second one."""
    yield from _too_many(root, "atMostOne")


def _too_few(root: Scope, multiplicity: str) -> Iterator[Complaint]:
    aspects = _aspects(root, multiplicity)
    for use in uses(root) if aspects else ():
        has = use.of_aspects()
        for identity, aspect in aspects.items():
            if identity not in has:
                name = use.implementation.name
                yield use.implementation, f"implementation {name} has no policy of aspect {aspect.name}; give it one"


def _too_many(root: Scope, multiplicity: str) -> Iterator[Complaint]:
    aspects = _aspects(root, multiplicity)
    for use in uses(root) if aspects else ():
        for identity, policies in use.of_aspects().items():
            if identity in aspects and len(policies) > 1:
                name, names = use.implementation.name, ", ".join(policy.element.name for policy in policies)
                yield (
                    use.implementation,
                    f"implementation {name} has {names}, all of aspect {aspects[identity].name}; keep one of them",
                )


def _aspects(root: Scope, multiplicity: str) -> dict[int, TechnicalAspect]:
    return {
        id(declared.element): declared.element
        for declared in declared_in(root, TechnicalAspect)
        if isinstance(declared.element, TechnicalAspect) and declared.element.multiplicity == multiplicity
    }
