"""Tool chains that are wrong about ends and delegations: names for types, heirs for ancestors; and about bindings of roles."""

from __future__ import annotations

from typing import Any

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel.interactions import InteractionPattern
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, lineage
from ucm_cts.adapters.mutants.toolchain.checking import complains_only_where, refuses, refusing
from ucm_cts.adapters.mutants.toolchain.registry import breaks
from ucm_cts.adapters.reference.toolchain.rules.components.part_ports import component_type, part_called, port_of

Composite = mc.CompositeComponentImplementation


@complains_only_where("delegated_ports_have_one_specification", "R-9.5.5.6-04")
def delegations_by_the_port_s_name(delegation: Any, _composite: Any, _scope: Scope) -> bool:
    """Takes a delegation between ports of one name, whatever they are."""
    return all(end.port != delegation.port for end in delegation.ends)


@complains_only_where("delegated_ports_have_one_specification", "R-9.5.5.6-04")
def delegations_by_the_type_s_name(delegation: Any, composite: Any, scope: Scope) -> bool:
    """Takes a delegation between ports whose port types or roles have one name, whatever they hold."""
    own = scope.find(composite.type, mc.ComponentType)
    for end in delegation.ends:
        part = part_called(composite, end.part, scope)
        owner = component_type(part.instance_of, scope) if part is not None else None
        if _last_name(own, delegation.port) != _last_name(owner, end.port):
            return True
    return False


def _last_name(owner: Declared | None, port_name: str) -> str:
    port = port_of(owner, port_name) if owner is not None else None
    specs = getattr(port.element, "specs", ()) if port is not None else ()
    names = [getattr(spec, "type", "") or getattr(spec, "role", "") for spec in specs]
    return "".join(names).replace(".", "::").rpartition("::")[2]


def _is_of_a_heir(reference: str, port: str, scope: Scope) -> bool:
    """Whether a component type that refines the one of ``reference`` has ``port``."""
    wanted = component_type(reference, scope)
    waiting, types = [scope.root], []
    while waiting:
        around = waiting.pop()
        types += [d for same in around.members.values() for d in same if isinstance(d.element, mc.ComponentType)]
        waiting += [inner for modules in around.modules.values() for inner in modules]
    heirs = [one for one in types if wanted is not None and any(a.element is wanted.element for a in lineage(one)[1:])]
    return any(port_of(heir, port) is not None for heir in heirs)


@complains_only_where("ends_are_at_ports_of_their_part", "R-9.5.5.5-02")
def ends_at_ports_of_heirs(end: Any, composite: Any, scope: Scope) -> bool:
    """Takes an end at a port of a type that refines the part's."""
    part = part_called(composite, end.part, scope)
    return part is None or not _is_of_a_heir(part.instance_of, end.port, scope)


@complains_only_where("delegated_ports_are_the_composites", "R-9.5.5.6-01")
def delegations_of_ports_of_heirs(delegation: Any, composite: Any, scope: Scope) -> bool:
    """Takes a delegation of a port of a type that refines the composite's."""
    return not _is_of_a_heir(composite.type, delegation.port, scope)


@refuses("R-9.5.5.5-02", also=("R-9.5.3.1-05",))
def ends_at_own_ports_only(composite: Composite, scope: Scope) -> bool:
    """Takes an end at an inherited port for an error."""
    ends = [end for connection in composite.connections for end in connection.ends]
    return any(_is_inherited(composite, end, scope) for end in ends)


@refuses("R-9.5.5.6-03", also=("R-9.5.3.1-05",))
def delegations_to_own_ports_only(composite: Composite, scope: Scope) -> bool:
    """Takes a delegation to an inherited port of a part for an error."""
    return any(_is_inherited(composite, end, scope) for d in composite.delegations for end in d.ends)


def _is_inherited(composite: Composite, end: mc.ConnectionEnd, scope: Scope) -> bool:
    part = part_called(composite, end.part, scope)
    owner = component_type(part.instance_of, scope) if part is not None else None
    return owner is not None and all(port.name != end.port for port in getattr(owner.element, "ports", ()))


@refuses("R-9.5.3.4-02", also=("R-9.5.3.4-01",))
def roles_want_their_items(spec: mc.PortRoleSpec, scope: Scope) -> bool:
    """Takes a role specification without any binding for an error if the role involves items."""
    role = scope.member(spec.role, InteractionPattern, "roles")
    return not spec.bindings and bool(getattr(role and role.element, "involved_items", ()))


@complains_only_where("names_are_not_empty", "R-9.1.4.1-01")
def ends_need_no_names(named: Any, _element: Any, _scope: Scope) -> bool:
    """Takes ends of connections without a name."""
    return not isinstance(named, mc.ConnectionEnd)


@complains_only_where("manages_some_component", "R-9.5.4.2-01")
def port_policies_manage_nothing(policy: Any, _element: Any, _scope: Scope) -> bool:
    """Takes policies on ports that manage no component."""
    return not isinstance(policy, mc.ComponentPortTechnicalPolicy)


@breaks("R-9.5.5.4-07")
@refusing
def connections_have_ends(connection: mc.Connection, _: Scope) -> bool:
    """Takes a connection without ends for an error."""
    return not connection.ends
