"""Tool chains that read the open places of 9.4 and 9.5 otherwise than the reference one, and declare it."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel.aspects import TechnicalAspect
from ucm_cts.adapters.contract.metamodel.components import ComponentPortTechnicalPolicy
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.mutants.toolchain.registry import replacing_rule, variant
from ucm_cts.adapters.reference.toolchain.checking import Complaint
from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.adapters.reference.toolchain.rules.components.policy_use import aspect_of, uses


def _counting_apart(program: Program) -> Program:
    def complaints(_model: Model, root: Scope) -> Iterator[Complaint]:
        for use in uses(root):
            for policies in use.of_aspects().values():
                aspect = aspect_of(policies[0])
                on_component = [p for p in policies if not isinstance(p.element, ComponentPortTechnicalPolicy)]
                assert aspect is not None
                assert isinstance(aspect.element, TechnicalAspect)
                if aspect.element.multiplicity == "exactlyOne" and len(on_component) > 1:
                    yield use.implementation, f"{use.implementation.name} has two policies of {aspect.element.name}"

    return replacing_rule(program, "has_the_one_policy_only", complaints)


@variant()
def policies_of_ports_are_other_policies(program: Program) -> Program:
    """Counts the policies on a component and those on its ports apart without declaring it."""
    return _counting_apart(program)


@variant(declares=("policies-on-ports-counted=apart",))
def policies_of_ports_are_said_to_be_other_policies(program: Program) -> Program:
    """Counts the policies on a component and those on its ports apart, and declares it."""
    return _counting_apart(program)
