"""Rules of 9.5.2.3 to 9.5.3.2: the types of implementations, what component types refine, and their ports."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, lineage
from ucm_cts.adapters.reference.toolchain.checking import Complaint, rule
from ucm_cts.adapters.reference.toolchain.rules.circles import circle, circle_complaint
from ucm_cts.adapters.reference.toolchain.rules.inheritance import parents


def _number_of_specs(port: mc.Port) -> int:
    return len(port.specs)


@rule("R-9.5.2.3-03", mc.AtomicComponentImplementation, mc.CompositeComponentImplementation)
def implements_a_component_type(
    implementation: mc.AtomicComponentImplementation | mc.CompositeComponentImplementation, scope: Scope
) -> Iterator[Complaint]:
    """The type of an implementation is a component type that is there."""
    if scope.find(implementation.type, mc.ComponentType) is None:
        yield (
            implementation,
            f"{implementation.name} implements '{implementation.type}', which is no component type; declare it",
        )


@rule("R-9.5.3.1-04", mc.ComponentType)
def refines_a_component_type(component: mc.ComponentType, scope: Scope) -> Iterator[Complaint]:
    """What a type refines is a component type that is there."""
    if component.refines and scope.find(component.refines, mc.ComponentType) is None:
        yield (
            component,
            f"component type {component.name} refines '{component.refines}', which is no component type; declare it",
        )


@rule("R-9.5.3.1-11", Model)
def types_do_not_refine_themselves(_model: Model, root: Scope) -> Iterator[Complaint]:
    """Refining comes to an end."""
    yield from circle_complaint(
        circle(root, [mc.ComponentType], parents), "refines", "component type ", "let it refine another one"
    )


@rule("R-9.5.3.1-08", mc.ComponentType)
def ports_do_not_clash_with_inherited_ones(component: mc.ComponentType, scope: Scope) -> Iterator[Complaint]:
    """A port with the name of an inherited one refines that one."""
    inherited: dict[str, list[mc.Port]] = {}
    for ancestor in _ancestors(component, scope):
        for theirs in _type(ancestor).ports:
            inherited.setdefault(theirs.name, []).append(theirs)
    for port in component.ports:
        same_name = inherited.get(port.name, ())
        refined = scope.member(port.refines_port, mc.ComponentType, "ports") if port.refines_port else None
        if same_name and not any(refined is not None and refined.element is one for one in same_name):
            yield (
                port,
                f"{component.name} inherits a port {port.name} already; rename this one or let it refine that one",
            )


@rule("R-9.5.3.1-09", mc.ComponentType)
def attributes_do_not_clash_with_inherited_ones(component: mc.ComponentType, scope: Scope) -> Iterator[Complaint]:
    """A type has the attributes of its ancestors already."""
    if not component.attributes:
        return
    inherited = {theirs.name for ancestor in _ancestors(component, scope) for theirs in _type(ancestor).attributes}
    for attribute in component.attributes:
        if attribute.name in inherited:
            yield attribute, f"{component.name} inherits an attribute {attribute.name} already; rename this one"


@rule("R-9.5.3.2-01", mc.Port, judged_by=_number_of_specs)
def port_is_specified(port: mc.Port, _scope: Scope) -> Iterator[Complaint]:
    """A port has a specification."""
    if not port.specs:
        yield port, f"port {port.name} has no specification; add a PortTypeSpec or a PortRoleSpec"


@rule("R-9.5.3.2-02", mc.Port, judged_by=_number_of_specs)
def port_is_specified_once(port: mc.Port, _scope: Scope) -> Iterator[Complaint]:
    """A port has no second specification."""
    for again in port.specs[1:]:
        yield again, f"port {port.name} has a specification already; keep one of them"


@rule("R-9.5.3.2-04", mc.ComponentType)
def refined_ports_are_inherited(component: mc.ComponentType, scope: Scope) -> Iterator[Complaint]:
    """The port that a port refines belongs to an ancestor of its type."""
    if not any(port.refines_port for port in component.ports):
        return
    inherited = {id(theirs) for ancestor in _ancestors(component, scope) for theirs in _type(ancestor).ports}
    for port in component.ports:
        if not port.refines_port:
            continue
        refined = scope.member(port.refines_port, mc.ComponentType, "ports")
        if refined is None:
            yield port, f"port {port.name} refines '{port.refines_port}', which is no port; say type.port"
        elif id(refined.element) not in inherited:
            yield (
                port,
                f"port {port.name} refines {port.refines_port}, which {component.name} does not inherit; choose another",
            )


def _ancestors(component: mc.ComponentType, scope: Scope) -> list[Declared]:
    return lineage(Declared(component, scope))[1:] if component.refines else []


def _type(declared: Declared) -> mc.ComponentType:
    assert isinstance(declared.element, mc.ComponentType)
    return declared.element
