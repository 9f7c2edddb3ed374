"""Tool chains that name inherited members, and compare what ports are for, otherwise than the reference one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel import interactions as mi
from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import Element, Named
from ucm_cts.adapters.contract.metamodel.components import CompositeComponentImplementation as Composite
from ucm_cts.adapters.contract.metamodel.names import MEMBER, Scope
from ucm_cts.adapters.mutants.toolchain.checking import without
from ucm_cts.adapters.mutants.toolchain.registry import replacing_rule, variant
from ucm_cts.adapters.reference.toolchain.checking import Complaint, Rule
from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.adapters.reference.toolchain.rules.components.part_ports import Specified, port_of, port_of_end, specified

Reference = tuple[str, type[Named], str]
"""What is written, what may own the member, and the field that holds it."""


def _references(element: Any) -> Iterator[Reference]:
    """All that ``element`` says as owner.member."""
    if isinstance(element, mi.ConnectorPort):
        yield element.port_role, mi.InteractionPattern, "roles"
    elif isinstance(element, mi.ItemBinding):
        yield element.interaction_item, mi.InteractionPattern, "items"
    elif isinstance(element, mc.PortRoleSpec):
        yield element.role, mi.InteractionPattern, "roles"
        yield from ((binding.item, mi.InteractionPattern, "items") for binding in element.bindings)
    elif isinstance(element, mc.ComponentTechnicalPolicy):
        for value in element.configuration_values:
            yield value.configuration_parameter, TechnicalPolicyDefinition, "configuration_parameters"
    if isinstance(element, mc.ComponentPortTechnicalPolicy):
        yield from ((port.name, mc.ComponentType, "ports") for port in element.managed_ports)


_SAY_MEMBERS = (
    mi.ConnectorPort,
    mi.ItemBinding,
    mc.PortRoleSpec,
    mc.ComponentTechnicalPolicy,
    mc.ComponentPortTechnicalPolicy,
)


def naming_by_owner(program: Program) -> Program:
    """``program``, but members are known by the name of the element that declares them only."""

    def complaints(element: Element, scope: Scope) -> Iterator[Complaint]:
        for reference, kind, field in _references(element):
            name, _, member = reference.rpartition(MEMBER)
            owner = scope.find(name, kind) if name else None
            if owner is not None and all(one.name != member for one in getattr(owner.element, field)):
                yield element, f"{name} does not declare {member} itself; name the declaring element"

    known = Rule("members_are_named_by_their_owner", "", _SAY_MEMBERS, complaints)
    return replace(program, rules={**program.rules, known.name: known})


@variant()
def members_have_their_owner_s_name(program: Program) -> Program:
    """Knows members by the name of the element that declares them, as all printed ones are, without declaring it."""
    return naming_by_owner(program)


@variant(declares=("inherited-member-names=owner",))
def inherited_members_have_their_owner_s_name(program: Program) -> Program:
    """Knows members by the name of the element that declares them, and declares it."""
    return naming_by_owner(program)


def naming_by_heir(program: Program) -> Program:
    """``program``, but roles and items of a connector are known by the name of its own pattern only."""

    def complaints(connector: mi.ConnectorDefinition, scope: Scope) -> Iterator[Complaint]:
        pattern = scope.find(connector.pattern, mi.InteractionPattern)
        for part in (*connector.ports, *connector.item_bindings):
            for reference, kind, _ in _references(part):
                named = scope.find(reference.rpartition(MEMBER)[0], kind)
                if pattern is not None and named is not None and named.element is not pattern.element:
                    yield part, f"{reference} is no member of {connector.pattern}; name it by that"

    known = Rule("members_are_named_by_the_pattern", "", (mi.ConnectorDefinition,), complaints)
    return replace(program, rules={**program.rules, known.name: known})


@variant(declares=("inherited-member-names=heir",))
def inherited_members_have_their_heir_s_name(program: Program) -> Program:
    """Knows roles and items of a connector by the name of its own pattern only, and declares it."""
    return naming_by_heir(program)


@variant()
def port_types_are_what_they_hold(program: Program) -> Program:
    """Takes port types that hold the same for the same, and does not compare the bindings of delegated ports."""
    program = replacing_rule(program, "connectors_have_the_apis_of_their_ends", _connectors_fit)
    program = replacing_rule(program, "delegated_ports_have_one_specification", _delegations_fit)
    return without(program, "delegated_ports_bind_alike")


def _shape(port_type: Element) -> list[tuple[str, str, str]]:
    elements = getattr(port_type, "port_elements", ())
    return sorted((e.name, e.interface.rpartition("::")[2], str(e.kind)) for e in elements)


def _connectors_fit(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    for connection in composite.connections:
        connector = scope.find(connection.definition, mi.ConnectorDefinition)
        if connector is None:
            continue
        assert isinstance(connector.element, mi.ConnectorDefinition)
        found = (connector.scope.find(port.api, mi.PortType) for port in connector.element.ports if port.api)
        apis = [_shape(api.element) for api in found if api is not None]
        for end in connection.ends:
            port = port_of_end(composite, end, scope)
            meaning = specified(port) if port is not None else None
            if meaning is not None and meaning.kind is mc.PortTypeSpec and _shape(meaning.target) not in apis:
                yield end, f"{connection.definition} has no port that holds the same as {end.part}.{end.port}"


def _delegations_fit(composite: Composite, scope: Scope) -> Iterator[Complaint]:
    own = scope.find(composite.type, mc.ComponentType)
    for delegation in composite.delegations:
        outer = port_of(own, delegation.port) if own is not None else None
        for end in delegation.ends:
            inner = port_of_end(composite, end, scope)
            both = [specified(port) for port in (outer, inner) if port is not None]
            if len(both) == 2 and both[0] is not None and both[1] is not None and not _alike(both[0], both[1]):
                yield delegation, f"{delegation.port} and {end.part}.{end.port} are not specified alike"


def _alike(outer: Specified, inner: Specified) -> bool:
    if outer.kind is mc.PortTypeSpec and inner.kind is mc.PortTypeSpec:
        return _shape(outer.target) == _shape(inner.target)
    return outer.same_target(inner)
