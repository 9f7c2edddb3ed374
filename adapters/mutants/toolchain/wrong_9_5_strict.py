"""Tool chains that refuse what 9.4 and 9.5 allow: near misses of the rules on definitions, types, ports, policies and composites."""

from __future__ import annotations

from collections import Counter

from ucm_cts.adapters.contract.metamodel.aspects import NonfunctionalAspectModule, TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import Named
from ucm_cts.adapters.contract.metamodel.components import (
    AtomicComponentImplementation,
    ComponentModule,
    ComponentPortTechnicalPolicy,
    ComponentTechnicalPolicy,
    ComponentType,
    CompositeComponentImplementation,
)
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, lineage
from ucm_cts.adapters.mutants.toolchain.registry import breaks
from ucm_cts.adapters.mutants.toolchain.strictness import refusing
from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.adapters.reference.toolchain.rules.components.part_ports import COMPONENTS, part_called

Composite = CompositeComponentImplementation


@breaks("R-9.4.3.2-12", task="check")
def elements_of_strangers_clash(program: Program) -> Program:
    """Takes port elements of one name in unrelated definitions of a module with extensions for an error."""
    return refusing(program, NonfunctionalAspectModule, lambda module, _: _shared(module, "port_elements"))


@breaks("R-9.4.3.2-13", task="check")
def parameters_of_strangers_clash(program: Program) -> Program:
    """Takes parameters of one name in unrelated definitions of a module with extensions for an error."""
    return refusing(program, NonfunctionalAspectModule, lambda module, _: _shared(module, "configuration_parameters"))


def _shared(module: NonfunctionalAspectModule, field: str) -> bool:
    names = Counter(one.name for definition in module.policy_definitions for one in getattr(definition, field))
    return any(d.extends for d in module.policy_definitions) and max(names.values(), default=0) > 1


@breaks("R-9.4.3.2-15", task="check", also=("R-9.5.4.2-10",))
def on_both_is_on_ports(program: Program) -> Program:
    """Takes a policy on components that could be on ports for an error."""

    def for_both(policy: ComponentTechnicalPolicy, scope: Scope) -> bool:
        definition = scope.find(policy.technical_policy_definition, TechnicalPolicyDefinition)
        on_ports = isinstance(policy, ComponentPortTechnicalPolicy)
        return not on_ports and getattr(definition and definition.element, "applicability", "") == "onBoth"

    return refusing(program, ComponentTechnicalPolicy, for_both)


@breaks("R-9.5.1-03", task="check")
def one_implementation_a_type(program: Program) -> Program:
    """Takes implementations of one type in two languages and in parts for an error."""

    def again(module: ComponentModule, _: object) -> bool:
        atomic = [one for one in module.implementations if isinstance(one, AtomicComponentImplementation)]
        whole = {one.type for one in module.implementations if isinstance(one, Composite)}
        return any(a.type == b.type in whole and a.language != b.language for a in atomic for b in atomic)

    return refusing(program, ComponentModule, again)


@breaks("R-9.5.3.1-08", task="check", also=("R-9.5.3.2-05",))
def inherited_names_are_taken(program: Program) -> Program:
    """Takes a port that is called like the inherited one it refines for an error."""

    def same(component: ComponentType, _: object) -> bool:
        return any(port.refines_port.rpartition(".")[2] == port.name for port in component.ports if port.refines_port)

    return refusing(program, ComponentType, same)


@breaks("R-9.5.3.1-09", task="check")
def attributes_of_strangers_clash(program: Program) -> Program:
    """Takes attributes of one name in unrelated types of a module with refinements for an error."""

    def shared(module: ComponentModule, _: object) -> bool:
        names = Counter(attribute.name for one in module.component_types for attribute in one.attributes)
        return any(one.refines for one in module.component_types) and max(names.values(), default=0) > 1

    return refusing(program, ComponentModule, shared)


@breaks(
    "R-9.5.3.2-03",
    task="check",
    also=(
        "R-9.3.3.1-01",
        "R-9.5.5.8-01",
    ),
)
def ports_of_one_sort(program: Program) -> Program:
    """Takes a component type with ports by role and by type for an error if they are two."""

    def mixed(component: ComponentType, _: object) -> bool:
        return len(component.ports) == 2 and len({type(spec) for port in component.ports for spec in port.specs}) > 1

    return refusing(program, ComponentType, mixed)


@breaks("R-9.5.3.2-04", task="check", also=("R-9.5.3.1-08",))
def refined_ports_are_near(program: Program) -> Program:
    """Takes a port that refines one of an ancestor's ancestor for an error."""

    def far(component: ComponentType, scope: Scope) -> bool:
        far_ones = lineage(Declared(component, scope))[2:]
        theirs = {id(port) for one in far_ones for port in getattr(one.element, "ports", ())}
        found = (scope.member(port.refines_port, ComponentType, "ports") for port in component.ports)
        return any(port is not None and id(port.element) in theirs for port in found)

    return refusing(program, ComponentType, far)


@breaks("R-9.5.4.3-04", task="check", also=("R-9.5.3.1-05",), declares=("inherited-member-names=heir",))
def inherited_ports_are_not_managed(program: Program) -> Program:
    """Takes a policy on an inherited port for an error."""

    def inherited(policy: ComponentPortTechnicalPolicy, scope: Scope) -> bool:
        for managed in policy.managed_ports:
            owner, _, name = managed.name.rpartition(".")
            found = scope.find(owner, ComponentType)
            if found is not None and all(port.name != name for port in getattr(found.element, "ports", ())):
                return True
        return False

    return refusing(program, ComponentPortTechnicalPolicy, inherited)


@breaks("R-9.5.5.3-02", task="check", also=("R-9.5.5.3-04",))
def parts_differ(program: Program) -> Program:
    """Takes two parts of one composite component for an error."""

    def twice(composite: Composite, scope: Scope) -> bool:
        names = Counter(part.instance_of for part in composite.parts)
        return any(
            number > 1 and (found := scope.find(name, *COMPONENTS)) is not None and isinstance(found.element, Composite)
            for name, number in names.items()
        )

    return refusing(program, Composite, twice)


@breaks("R-9.5.5.3-04", task="check")
def parts_by_two_ways(program: Program) -> Program:
    """Takes a composite that contains another one by two ways for an error."""

    def ways(model: Model, root: Scope) -> bool:
        del model
        composites = [d for s in _scopes(root) for same in s.members.values() for d in same if _is_composite(d.element)]
        return any(_reached_twice(one) for one in composites)

    return refusing(program, Model, ways)


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


@breaks("R-9.5.5.5-02", task="check", also=("R-9.5.5.4-04",))
def composites_have_no_ports(program: Program) -> Program:
    """Takes a connection that ends at a part that is a composite for an error."""

    def at_composite(composite: Composite, scope: Scope) -> bool:
        ends = [end for connection in composite.connections for end in connection.ends]
        parts = [part_called(composite, end.part, scope) for end in ends]
        return any(part is not None and scope.find(part.instance_of, Composite) is not None for part in parts)

    return refusing(program, Composite, at_composite)


@breaks("R-9.5.5.6-04", task="check", also=("R-9.5.5.6-05",))
def delegated_ports_share_a_name(program: Program) -> Program:
    """Takes a delegation between ports by role with different names for an error."""

    def renamed(composite: Composite, scope: Scope) -> bool:
        own = scope.find(composite.type, ComponentType)
        roles = {p.name for p in getattr(own and own.element, "ports", ()) for s in p.specs if hasattr(s, "role")}
        return len(roles) == 1 and any(
            delegation.port in roles and end.port != delegation.port and not composite.connections
            for delegation in composite.delegations
            for end in delegation.ends
        )

    return refusing(program, Composite, renamed)
