"""Rules of 9.3.3 and 9.3.5: interaction patterns, their roles and items, and port types."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.contracts import AbstractInterface, Interface
from ucm_cts.adapters.contract.metamodel.interactions import InteractionPattern, InteractionRole, PortType
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, member_of
from ucm_cts.adapters.reference.toolchain.checking import Complaint, rule
from ucm_cts.adapters.reference.toolchain.rules.circles import circle, circle_complaint
from ucm_cts.adapters.reference.toolchain.rules.inheritance import parents, redefined

ANY_NUMBER = -1
"""An upper multiplicity that is no limit."""


@rule("R-9.3.3.2-03", InteractionPattern)
def extends_a_pattern(pattern: InteractionPattern, scope: Scope) -> Iterator[Complaint]:
    """What a pattern extends is a pattern that is there."""
    if pattern.extends and scope.find(pattern.extends, InteractionPattern) is None:
        yield pattern, f"pattern {pattern.name} extends '{pattern.extends}', which is no pattern; declare it"


@rule("R-9.3.3.2-06", Model)
def patterns_do_not_extend_themselves(model: Model, root: Scope) -> Iterator[Complaint]:
    """Extending comes to an end."""
    yield from circle_complaint(
        circle(root, [InteractionPattern], parents), "extends", "pattern ", "let it extend another one"
    )


@rule("R-9.3.3.2-05", InteractionPattern)
def roles_are_not_redefined(pattern: InteractionPattern, scope: Scope) -> Iterator[Complaint]:
    """A pattern has the roles of its ancestors already."""
    yield from redefined(pattern, scope, "roles", "role")


@rule("R-9.3.3.2-07", InteractionPattern, under="item-redefinition=refused")
def items_are_not_redefined(pattern: InteractionPattern, scope: Scope) -> Iterator[Complaint]:
    """A pattern has the items of its ancestors already."""
    yield from redefined(pattern, scope, "items", "item")


@rule("R-9.3.3.4-04", InteractionRole)
def multiplicities_are_a_range(role: InteractionRole, _scope: Scope) -> Iterator[Complaint]:
    """Not more at least than at most."""
    lower, upper = role.lower_multiplicity, role.upper_multiplicity
    if lower is not None and upper is not None and 0 <= upper < lower:
        yield role, f"role {role.name} is for at least {lower} and at most {upper}; exchange them"


@rule("R-9.3.3.4-04", InteractionRole, under="negative-multiplicities=refused")
def multiplicities_are_not_negative(role: InteractionRole, _scope: Scope) -> Iterator[Complaint]:
    """At least none, and at most any number."""
    lower, upper = role.lower_multiplicity, role.upper_multiplicity
    if lower is not None and lower < 0:
        yield role, f"role {role.name} has the lower multiplicity {lower}; begin with 0"
    if upper is not None and upper < ANY_NUMBER:
        yield role, f"role {role.name} has the upper multiplicity {upper}; say {ANY_NUMBER} for any number"


@rule("R-9.3.3.4-06", InteractionPattern)
def roles_involve_items_of_the_pattern(pattern: InteractionPattern, scope: Scope) -> Iterator[Complaint]:
    """What a role involves is an item of its pattern or of an ancestor."""
    for role in pattern.roles:
        for involved in role.involved_items:
            if member_of(Declared(pattern, scope), "items", involved.item) is None:
                yield (
                    involved,
                    f"role {role.name} involves '{involved.item}', which is no item of {pattern.name}; declare it there",
                )


@rule("R-9.3.5.2-02", PortType, TechnicalPolicyDefinition)
def port_elements_have_interfaces(api: PortType | TechnicalPolicyDefinition, scope: Scope) -> Iterator[Complaint]:
    """What a port element provides or requires is an interface that is there."""
    for element in api.port_elements:
        if scope.find(element.interface, Interface, AbstractInterface) is None:
            yield (
                element,
                f"port element {element.name} of {api.name} has '{element.interface}', which is no interface; declare it",
            )
