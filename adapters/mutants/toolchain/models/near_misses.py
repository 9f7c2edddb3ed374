"""Tool chains that refuse what 9.4 and 9.5 allow: near misses of the rules on definitions, types, ports, policies and composites."""

from __future__ import annotations

from collections import Counter

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel.aspects import NonfunctionalAspectModule, TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import Named
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, lineage
from ucm_cts.adapters.mutants.toolchain.checking import refuses
from ucm_cts.adapters.reference.toolchain.rules.components.part_ports import COMPONENTS, part_called

Composite = mc.CompositeComponentImplementation


@refuses("R-9.4.3.2-12")
def elements_of_strangers_clash(module: NonfunctionalAspectModule, _: Scope) -> object:
    """Takes port elements of one name in unrelated definitions of a module with extensions for an error."""
    return _shared(module, "port_elements")


@refuses("R-9.4.3.2-13")
def parameters_of_strangers_clash(module: NonfunctionalAspectModule, _: Scope) -> object:
    """Takes parameters of one name in unrelated definitions of a module with extensions for an error."""
    return _shared(module, "configuration_parameters")


def _shared(module: NonfunctionalAspectModule, field: str) -> bool:
    names = Counter(one.name for definition in module.policy_definitions for one in getattr(definition, field))
    return any(d.extends for d in module.policy_definitions) and max(names.values(), default=0) > 1


@refuses("R-9.4.3.2-15", also=("R-9.5.4.2-10",))
def on_both_is_on_ports(policy: mc.ComponentTechnicalPolicy, scope: Scope) -> bool:
    """Takes a policy on components that could be on ports for an error."""
    definition = scope.find(policy.technical_policy_definition, TechnicalPolicyDefinition)
    on_ports = isinstance(policy, mc.ComponentPortTechnicalPolicy)
    return not on_ports and getattr(definition and definition.element, "applicability", "") == "onBoth"


@refuses("R-9.5.1-03")
def one_implementation_a_type(module: mc.ComponentModule, _: Scope) -> bool:
    """Takes implementations of one type in two languages and in parts for an error."""
    atomic = [one for one in module.implementations if isinstance(one, mc.AtomicComponentImplementation)]
    whole = {one.type for one in module.implementations if isinstance(one, Composite)}
    return any(a.type == b.type in whole and a.language != b.language for a in atomic for b in atomic)


@refuses("R-9.5.3.1-08", also=("R-9.5.3.2-05",))
def inherited_names_are_taken(component: mc.ComponentType, _: Scope) -> bool:
    """Takes a port that is called like the inherited one it refines for an error."""
    return any(port.refines_port.rpartition(".")[2] == port.name for port in component.ports if port.refines_port)


@refuses("R-9.5.3.1-09")
def attributes_of_strangers_clash(module: mc.ComponentModule, _: Scope) -> bool:
    """Takes attributes of one name in unrelated types of a module with refinements for an error."""
    names = Counter(attribute.name for one in module.component_types for attribute in one.attributes)
    return any(one.refines for one in module.component_types) and max(names.values(), default=0) > 1


@refuses("R-9.5.3.2-03", also=("R-9.3.3.1-01", "R-9.5.5.6-04", "R-9.5.5.8-01"))
def ports_of_one_sort(component: mc.ComponentType, _: Scope) -> bool:
    """Takes a component type with ports by role and by type for an error if they are two."""
    return len(component.ports) == 2 and len({type(spec) for port in component.ports for spec in port.specs}) > 1


@refuses("R-9.5.3.2-04", also=("R-9.5.3.1-08",))
def refined_ports_are_near(component: mc.ComponentType, scope: Scope) -> bool:
    """Takes a port that refines one of an ancestor's ancestor for an error."""
    far_ones = lineage(Declared(component, scope))[2:]
    theirs = {id(port) for one in far_ones for port in getattr(one.element, "ports", ())}
    found = (scope.member(port.refines_port, mc.ComponentType, "ports") for port in component.ports)
    return any(port is not None and id(port.element) in theirs for port in found)


@refuses("R-9.5.4.3-04", also=("R-9.5.3.1-05",), declares=("inherited-member-names=heir",))
def inherited_ports_are_not_managed(policy: mc.ComponentPortTechnicalPolicy, scope: Scope) -> bool:
    """Takes a policy on an inherited port for an error."""
    for managed in policy.managed_ports:
        owner, _, name = managed.name.rpartition(".")
        found = scope.find(owner, mc.ComponentType)
        if found is not None and all(port.name != name for port in getattr(found.element, "ports", ())):
            return True
    return False


@refuses("R-9.5.5.3-02", also=("R-9.5.5.3-04",))
def parts_differ(composite: Composite, scope: Scope) -> bool:
    """Takes two parts of one composite component for an error."""
    names = Counter(part.instance_of for part in composite.parts)
    return any(
        number > 1 and (found := scope.find(name, *COMPONENTS)) is not None and isinstance(found.element, Composite)
        for name, number in names.items()
    )


@refuses("R-9.5.5.3-04")
def parts_by_two_ways(model: Model, root: Scope) -> bool:
    """Takes a composite that contains another one by two ways for an error."""
    del model
    composites = [d for s in _scopes(root) for same in s.members.values() for d in same if _is_composite(d.element)]
    return any(_reached_twice(one) for one in composites)


def _scopes(root: Scope) -> list[Scope]:
    return [root, *(inner for modules in root.modules.values() for scope in modules for inner in _scopes(scope))]


def _is_composite(element: Named) -> bool:
    return isinstance(element, Composite)


def _reached_twice(composite: Declared) -> bool:
    """Whether a part of a part is a part, too."""
    direct = {id(one.element): one for one in _inside(composite)}
    return any(id(inner.element) in direct for one in direct.values() for inner in _inside(one))


def _inside(composite: Declared) -> list[Declared]:
    found = (composite.scope.find(part.instance_of, Composite) for part in getattr(composite.element, "parts", ()))
    return [one for one in found if one is not None]


@refuses("R-9.5.5.5-02", also=("R-9.5.5.4-04",))
def composites_have_no_ports(composite: Composite, scope: Scope) -> bool:
    """Takes a connection that ends at a part that is a composite for an error."""
    ends = [end for connection in composite.connections for end in connection.ends]
    parts = [part_called(composite, end.part, scope) for end in ends]
    return any(part is not None and scope.find(part.instance_of, Composite) is not None for part in parts)


@refuses("R-9.5.5.6-04", also=("R-9.5.5.6-05",))
def delegated_ports_share_a_name(composite: Composite, scope: Scope) -> bool:
    """Takes a delegation between ports by role with different names for an error."""
    own = scope.find(composite.type, mc.ComponentType)
    roles = {p.name for p in getattr(own and own.element, "ports", ()) for s in p.specs if hasattr(s, "role")}
    return len(roles) == 1 and any(
        delegation.port in roles and end.port != delegation.port and not composite.connections
        for delegation in composite.delegations
        for end in delegation.ends
    )
