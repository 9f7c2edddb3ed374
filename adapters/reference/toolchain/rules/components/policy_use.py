"""The policies of an implementation, by its own declaration and by theirs (9.5.4.1, 9.5.4.2)."""

from __future__ import annotations

import functools
from collections.abc import Iterator
from dataclasses import dataclass, field

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel.aspects import TechnicalAspect, TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope
from ucm_cts.adapters.reference.toolchain.rules.circles import declared_in


@dataclass
class Use:
    """An implementation, the policies that it names, and those that name it; both by the identity of the policy."""

    implementation: mc.AtomicComponentImplementation
    named: dict[int, Declared] = field(default_factory=dict)
    naming: dict[int, Declared] = field(default_factory=dict)

    def of_aspects(self) -> dict[int, list[Declared]]:
        """The policies of both sides, by the identity of their aspect."""
        found: dict[int, list[Declared]] = {}
        for policy in (self.named | self.naming).values():
            aspect = aspect_of(policy)
            if aspect is not None:
                found.setdefault(id(aspect.element), []).append(policy)
        return found


def aspect_of(policy: Declared) -> Declared | None:
    """The technical aspect of a policy's definition, if both are there."""
    assert isinstance(policy.element, mc.ComponentTechnicalPolicy)
    definition = policy.scope.find(policy.element.technical_policy_definition, TechnicalPolicyDefinition)
    if definition is None:
        return None
    assert isinstance(definition.element, TechnicalPolicyDefinition)
    return definition.scope.find(definition.element.technical_aspect, TechnicalAspect)


def uses(root: Scope) -> tuple[Use, ...]:
    """All atomic implementations below ``root`` with their policies."""
    return root.remembered("uses of policies", functools.partial(_uses, root))


def _uses(root: Scope) -> tuple[Use, ...]:
    found: dict[int, Use] = {}
    for declared in declared_in(root, mc.AtomicComponentImplementation):
        implementation = declared.element
        assert isinstance(implementation, mc.AtomicComponentImplementation)
        use = found[id(implementation)] = Use(implementation)
        for reference in implementation.policies:
            policy = declared.scope.find(reference.name, mc.ComponentTechnicalPolicy)
            if policy is not None:
                use.named[id(policy.element)] = policy
    for policy in policies(root):
        assert isinstance(policy.element, mc.ComponentTechnicalPolicy)
        for managed in policy.element.managed_components:
            target = policy.scope.find(managed.name, mc.AtomicComponentImplementation)
            if target is not None:
                found[id(target.element)].naming[id(policy.element)] = policy
    return tuple(found.values())


def policies(root: Scope) -> Iterator[Declared]:
    """All policies below ``root``, on components and on ports."""
    yield from declared_in(root, mc.ComponentTechnicalPolicy)
    yield from declared_in(root, mc.ComponentPortTechnicalPolicy)
