"""The ports of a composite's parts, and what specifications say: which API or role, and which types stand for what is abstract."""

from __future__ import annotations

import functools
from collections.abc import Hashable, Mapping
from typing import NamedTuple

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.interactions import InteractionPattern, PortType
from ucm_cts.adapters.contract.metamodel.names import MEMBER, Declared, Scope, lineage, member_of

COMPONENTS = (mc.ComponentType, mc.AtomicComponentImplementation, mc.CompositeComponentImplementation)
"""What a part may be an instance of (9.5.2.2)."""


class Specified(NamedTuple):
    """What a port's specification means: ``target`` is its port type or its role, ``bound`` has the actual types by the
    identity of the item or abstract type that they stand for.
    """

    kind: type[mc.PortTypeSpec | mc.PortRoleSpec]
    target: Element
    bound: dict[int, Declared]

    def same_target(self, other: Specified) -> bool:
        """Whether both have the same port type, or both the same role."""
        return self.kind is other.kind and self.target is other.target

    def same_bindings(self, other: Specified) -> bool:
        """Whether the same stands for the same in both."""
        mine = {identity: id(actual.element) for identity, actual in self.bound.items()}
        return mine == {identity: id(actual.element) for identity, actual in other.bound.items()}


def part_called(composite: mc.CompositeComponentImplementation, name: str, scope: Scope) -> mc.AssemblyPart | None:
    """The part of this name of a composite that stands in ``scope``; None if there is none."""
    return scope.remembered_last("parts", id(composite), functools.partial(_parts, composite)).get(name)


def _parts(composite: mc.CompositeComponentImplementation) -> dict[str, mc.AssemblyPart]:
    return {part.name: part for part in reversed(composite.parts)}


def component_type(reference: str, scope: Scope) -> Declared | None:
    """The component type of the component that ``reference`` means; None if one of both is not there."""
    component = scope.find(reference, *COMPONENTS)
    if component is None or isinstance(component.element, mc.ComponentType):
        return component
    return component.scope.find(getattr(component.element, "type", ""), mc.ComponentType)


def port_of_end(composite: mc.CompositeComponentImplementation, end: mc.ConnectionEnd, scope: Scope) -> Declared | None:
    """The port that ``end`` of a connection of ``composite`` names; None if that, its part or its type is not there."""
    part = part_called(composite, end.part, scope)
    return ports_of_component(part.instance_of, scope).get(end.port) if part is not None else None


def ports_of_component(reference: str, scope: Scope) -> Mapping[str, Declared]:
    """The ports of the component that ``reference`` means, by their names; none if it is not there."""
    return scope.remembered(("ports of", reference), functools.partial(_ports_of_component, reference, scope))


def _ports_of_component(reference: str, scope: Scope) -> Mapping[str, Declared]:
    owner = component_type(reference, scope)
    return _ports_by_name(owner) if owner is not None else {}


def meanings_of_component(reference: str, scope: Scope) -> Mapping[str, Specified]:
    """What the ports of the component that ``reference`` means are specified as, by their names; only those that are."""
    return scope.remembered(("meanings of", reference), functools.partial(_meanings_of_component, reference, scope))


def _meanings_of_component(reference: str, scope: Scope) -> Mapping[str, Specified]:
    ports = ports_of_component(reference, scope).items()
    return {name: meaning for name, port in ports if (meaning := specified(port)) is not None}


def port_of(owner: Declared, name: str) -> Declared | None:
    """The port of a component type, its own or inherited, by its name."""
    return _ports_by_name(owner).get(name)


def _ports_by_name(owner: Declared) -> Mapping[str, Declared]:
    return owner.scope.remembered(("ports", id(owner.element)), functools.partial(_ports, owner))


def _ports(owner: Declared) -> dict[str, Declared]:
    """The ports of a component type by their names; those of nearer ancestors win, and of two the first."""
    return {
        port.name: Declared(port, ancestor.scope)
        for ancestor in reversed(lineage(owner))
        for port in reversed(getattr(ancestor.element, "ports", ()))
    }


def specified(port: Declared) -> Specified | None:
    """What the specification of ``port`` means; None if it has not just one or names nothing that is there."""
    assert isinstance(port.element, mc.Port)
    specs, scope = port.element.specs, port.scope
    if len(specs) != 1:
        return None
    spec = specs[0]
    key: Hashable  # ports with the same references share what these mean
    if isinstance(spec, mc.PortTypeSpec):
        key = (mc.PortTypeSpec, spec.type, *((one.abstract_type, one.actual_type) for one in spec.bindings))
        return scope.remembered(key, functools.partial(_by_type, spec, scope))
    key = (mc.PortRoleSpec, spec.role, *((one.item, one.actual_type) for one in spec.bindings))
    return scope.remembered(key, functools.partial(_by_role, spec, scope))


_TYPES = (c.DataType, c.Interface, c.AbstractDataType, c.AbstractInterface)


def _by_type(spec: mc.PortTypeSpec, scope: Scope) -> Specified | None:
    port_type = scope.find(spec.type, PortType)
    if port_type is None:
        return None
    bound: dict[int, Declared] = {}
    for binding in spec.bindings:
        abstract = scope.find(binding.abstract_type, c.AbstractDataType, c.AbstractInterface)
        actual = scope.find(binding.actual_type, *_TYPES)
        if abstract is not None and actual is not None:
            bound[id(abstract.element)] = actual
    return Specified(mc.PortTypeSpec, port_type.element, bound)


def _by_role(spec: mc.PortRoleSpec, scope: Scope) -> Specified | None:
    role = scope.member(spec.role, InteractionPattern, "roles")
    pattern = scope.find(spec.role.rpartition(MEMBER)[0], InteractionPattern)
    if role is None or pattern is None:
        return None
    bound: dict[int, Declared] = {}
    for binding in spec.bindings:
        item = (
            scope.member(binding.item, InteractionPattern, "items")
            if MEMBER in binding.item
            else member_of(pattern, "items", binding.item)
        )
        actual = scope.find(binding.actual_type, *_TYPES)
        if item is not None and actual is not None:
            bound[id(item.element)] = actual
    return Specified(mc.PortRoleSpec, role.element, bound)
