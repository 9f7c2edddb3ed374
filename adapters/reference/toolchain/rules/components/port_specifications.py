"""Rules of 9.5.3.4 to 9.5.3.7: ports by role and by port type, and what stands for items and abstract types."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel import interactions as mi
from ucm_cts.adapters.contract.metamodel.components import InteractionItemBinding, PortRoleSpec, PortTypeSpec
from ucm_cts.adapters.contract.metamodel.contracts import AbstractInterface, Interface
from ucm_cts.adapters.contract.metamodel.names import MEMBER, Declared, Scope, lineage, member_of
from ucm_cts.adapters.reference.toolchain.checking import Complaint, rule
from ucm_cts.adapters.reference.toolchain.rules.components import bindings
from ucm_cts.adapters.reference.toolchain.rules.components.bindings import ABSTRACT, TYPES


def _bound(spec: PortTypeSpec) -> tuple[object, ...]:
    """The references of a port by port type, which are all that its rules look at."""
    return (spec.type, *((one.abstract_type, one.actual_type) for one in spec.bindings))


@rule("R-9.5.3.4-01", PortRoleSpec)
def names_a_role(spec: PortRoleSpec, scope: Scope) -> Iterator[Complaint]:
    """The role of a port is one that a pattern has."""
    if scope.member(spec.role, mi.InteractionPattern, "roles") is None:
        yield spec, f"'{spec.role}' is no role; say pattern.role"


@rule("R-9.5.3.4-02", PortRoleSpec, under="partial-role-bindings=refused")
def items_of_the_role_are_bound(spec: PortRoleSpec, scope: Scope) -> Iterator[Complaint]:
    """Each item that the role involves has an actual type, or none has."""
    if not spec.bindings:
        return
    role = scope.member(spec.role, mi.InteractionPattern, "roles")
    pattern = _pattern(spec, scope)
    if role is None or pattern is None:
        return
    assert isinstance(role.element, mi.InteractionRole)
    bound = {id(_item(binding, spec, scope)) for binding in spec.bindings}
    for involved in role.element.involved_items:
        item = member_of(pattern, "items", involved.item)
        if item is not None and id(item.element) not in bound:
            yield spec, f"nothing stands for item {involved.item} of {spec.role}; add an InteractionItemBinding"


@rule("R-9.5.3.5-01", PortRoleSpec)
def bound_items_are_of_the_pattern(spec: PortRoleSpec, scope: Scope) -> Iterator[Complaint]:
    """What is bound is an item of the pattern that has the role."""
    pattern = _pattern(spec, scope)
    if pattern is None:
        return
    own = {id(item) for ancestor in lineage(pattern) for item in getattr(ancestor.element, "items", ())}
    for binding in spec.bindings:
        item = _item(binding, spec, scope)
        if item is None:
            yield binding, f"'{binding.item}' is no item; say pattern.item"
        elif id(item) not in own:
            yield binding, f"{binding.item} is no item of {pattern.element.name}; choose one of those"


@rule("R-9.5.3.5-02", InteractionItemBinding)
def items_stand_for_types(binding: InteractionItemBinding, scope: Scope) -> Iterator[Complaint]:
    """The actual type of an item is a type that is there."""
    if scope.find(binding.actual_type, *TYPES) is None:
        yield binding, f"'{binding.actual_type}' is no data type or interface; declare it"


@rule("R-9.5.3.5-03", InteractionItemBinding, under="abstract-actual-types=refused")
def items_stand_for_concrete_types(binding: InteractionItemBinding, scope: Scope) -> Iterator[Complaint]:
    """The actual type of an item is not abstract."""
    actual = scope.find(binding.actual_type, *TYPES)
    if actual is not None and isinstance(actual.element, ABSTRACT):
        yield binding, f"{binding.actual_type} is abstract; bind {binding.item} to a concrete type"


@rule("R-9.5.3.5-04", PortRoleSpec)
def actual_types_have_the_nature_of_their_item(spec: PortRoleSpec, scope: Scope) -> Iterator[Complaint]:
    """Data items stand for data types, interface items for interfaces."""
    for binding in spec.bindings:
        item, actual = _item(binding, spec, scope), scope.find(binding.actual_type, *TYPES)
        if item is None or actual is None:
            continue
        nature = "INTERFACE" if isinstance(actual.element, Interface | AbstractInterface) else "DATA"
        if item.nature != nature:
            yield (
                binding,
                f"item {item.name} is of nature {item.nature}, {binding.actual_type} is not; bind another type",
            )


@rule("R-9.5.3.5-05", PortRoleSpec, under="repeated-item-bindings=refused")
def items_have_one_actual_type(spec: PortRoleSpec, scope: Scope) -> Iterator[Complaint]:
    """No item stands for two types."""
    seen: dict[int, Declared] = {}
    for binding in spec.bindings:
        item, actual = _item(binding, spec, scope), scope.find(binding.actual_type, *TYPES)
        if item is None or actual is None:
            continue
        if seen.setdefault(id(item), actual).element is not actual.element:
            yield binding, f"item {item.name} is bound to {seen[id(item)].path} already; keep one of both"


@rule("R-9.5.3.6-01", PortTypeSpec, judged_by=_bound)
def names_a_port_type(spec: PortTypeSpec, scope: Scope) -> Iterator[Complaint]:
    """The type of a port is a port type that is there."""
    if scope.find(spec.type, mi.PortType) is None:
        yield spec, f"'{spec.type}' is no port type; declare it"


@rule("R-9.5.3.6-02", PortTypeSpec, under="missing-type-bindings=check", judged_by=_bound)
def abstract_types_of_ports_are_bound(spec: PortTypeSpec, scope: Scope) -> Iterator[Complaint]:
    """Something stands for each abstract type of the port type."""
    return bindings.not_bound(spec, spec.bindings, scope, _api(spec, scope))


@rule("R-9.5.3.7-01", PortTypeSpec, judged_by=_bound)
def ports_bind_abstract_types(spec: PortTypeSpec, scope: Scope) -> Iterator[Complaint]:
    """What is bound is an abstract type."""
    return bindings.no_abstract_type(spec.bindings, scope)


@rule("R-9.5.3.7-02", PortTypeSpec, under="unused-bindings=refused", judged_by=_bound)
def ports_bind_what_they_use(spec: PortTypeSpec, scope: Scope) -> Iterator[Complaint]:
    """What is bound is an abstract type that the port type uses."""
    return bindings.not_used(spec.bindings, scope, _api(spec, scope))


@rule("R-9.5.3.7-03", PortTypeSpec, judged_by=_bound)
def ports_bind_to_types(spec: PortTypeSpec, scope: Scope) -> Iterator[Complaint]:
    """What stands for an abstract type is a type."""
    return bindings.no_actual_type(spec.bindings, scope)


@rule("R-9.5.3.7-03", PortTypeSpec, under="abstract-actual-types=refused", judged_by=_bound)
def ports_bind_to_concrete_types(spec: PortTypeSpec, scope: Scope) -> Iterator[Complaint]:
    """What stands for an abstract type is not abstract."""
    return bindings.still_abstract(spec.bindings, scope)


@rule("R-9.5.3.7-04", PortTypeSpec, judged_by=_bound)
def ports_bind_to_types_of_the_same_kind(spec: PortTypeSpec, scope: Scope) -> Iterator[Complaint]:
    """Data types stand for data types, interfaces for interfaces."""
    return bindings.of_another_kind(spec.bindings, scope)


@rule("R-9.5.3.7-05", PortTypeSpec, judged_by=_bound)
def ports_bind_to_one_type(spec: PortTypeSpec, scope: Scope) -> Iterator[Complaint]:
    """No abstract type stands for two types."""
    return bindings.bound_twice(spec.bindings, scope)


def _api(spec: PortTypeSpec, scope: Scope) -> tuple[Declared, ...]:
    found = scope.find(spec.type, mi.PortType)
    return (found,) if found is not None else ()


def _pattern(spec: PortRoleSpec, scope: Scope) -> Declared | None:
    """The pattern by which the role is named."""
    return scope.find(spec.role.rpartition(MEMBER)[0], mi.InteractionPattern)


def _item(binding: InteractionItemBinding, spec: PortRoleSpec, scope: Scope) -> mi.InteractionItem | None:
    """The item that is bound, by its full name or, within the role's pattern, by its bare one."""
    if MEMBER in binding.item:
        found = scope.member(binding.item, mi.InteractionPattern, "items")
    else:
        pattern = _pattern(spec, scope)
        found = member_of(pattern, "items", binding.item) if pattern is not None else None
    return found.element if found is not None and isinstance(found.element, mi.InteractionItem) else None
