"""Tool chains that read the open places of 9.4 and 9.5 otherwise than the reference one, and say so."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel.aspects import TechnicalAspect
from ucm_cts.adapters.contract.metamodel.components import ComponentPortTechnicalPolicy
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.mutants.toolchain.checking import without
from ucm_cts.adapters.mutants.toolchain.registry import replacing_rule, variant
from ucm_cts.adapters.reference.toolchain.checking import Complaint
from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.adapters.reference.toolchain.rules.components.policy_use import aspect_of, uses


@variant(
    declares=(
        "missing-policies=check",
        "missing-type-bindings=check",
        "role-minimum=check",
        "connected-types=check",
        "partial-role-bindings=refused",
        "unused-bindings=refused",
        "abstract-actual-types=refused",
        "one-sided-policy-links=refused",
        "delegated-and-connected=refused",
        "double-delegation=refused",
        "delegation-bindings=same",
        "policies-on-ports-counted=with-the-component",
        "repeated-parameter-values=refused",
    )
)
def components_are_complete(program: Program) -> Program:
    """Refuses whatever is missing or superfluous, as the reference tool chain does."""
    return program


@variant(
    declares=(
        "missing-policies=later",
        "missing-type-bindings=later",
        "role-minimum=later",
        "connected-types=later",
        "partial-role-bindings=accepted",
    )
)
def components_may_be_sketches(program: Program) -> Program:
    """Lets early designs leave out policies, bindings and ends, and looks at what fits later."""
    return without(
        program,
        "has_the_one_policy",
        "has_at_least_one_policy",
        "abstract_types_of_ports_are_bound",
        "abstract_types_of_policies_are_bound",
        "roles_are_played_often_enough",
        "connected_ports_bind_alike",
        "items_of_the_role_are_bound",
    )


@variant(declares=("unused-bindings=accepted", "abstract-actual-types=accepted"))
def bindings_may_be_anything(program: Program) -> Program:
    """Lets abstract types be bound that are not used, and items and abstract types to abstract types."""
    return without(
        program,
        "ports_bind_what_they_use",
        "policies_bind_what_they_use",
        "ports_bind_to_concrete_types",
        "items_stand_for_concrete_types",
        "policies_bind_to_concrete_types",
    )


@variant(declares=("one-sided-policy-links=accepted",))
def policies_are_named_once(program: Program) -> Program:
    """Takes it for enough that an implementation names its policy, or the policy the implementation."""
    return without(program, "implementations_and_policies_name_each_other")


@variant(declares=("delegated-and-connected=accepted", "double-delegation=accepted"))
def ports_serve_several_ends(program: Program) -> Program:
    """Lets an inner port be connected and delegated, and an external one be delegated twice."""
    return without(program, "ports_are_delegated_once", "delegated_ports_are_not_connected")


def _counting_apart(program: Program) -> Program:
    def look(_model: Model, root: Scope) -> Iterator[Complaint]:
        for use in uses(root):
            for policies in use.of_aspects().values():
                aspect = aspect_of(policies[0])
                on_component = [p for p in policies if not isinstance(p.element, ComponentPortTechnicalPolicy)]
                assert aspect is not None
                assert isinstance(aspect.element, TechnicalAspect)
                if aspect.element.multiplicity == "exactlyOne" and len(on_component) > 1:
                    yield use.implementation, f"{use.implementation.name} has two policies of {aspect.element.name}"

    return replacing_rule(program, "has_the_one_policy_only", look)


@variant()
def policies_of_ports_are_other_policies(program: Program) -> Program:
    """Counts the policies on a component and those on its ports apart, and says nothing of it."""
    return _counting_apart(program)


@variant(declares=("policies-on-ports-counted=apart",))
def policies_of_ports_are_said_to_be_other_policies(program: Program) -> Program:
    """The same, and says so."""
    return _counting_apart(program)


@variant()
def items_may_stand_for_abstract_types(program: Program) -> Program:
    """Lets the items of a port's role stand for abstract types, and says nothing of it."""
    return without(program, "items_stand_for_concrete_types")
