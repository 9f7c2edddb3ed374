"""Component types and atomic implementations as abstract classes that component bodies implement (13.7)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ucm_cts.adapters.contract.metamodel import components, contracts, interactions
from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, lineage
from ucm_cts.adapters.reference.toolchain.cpp import interfaces
from ucm_cts.adapters.reference.toolchain.cpp.names import identifier, instance
from ucm_cts.adapters.reference.toolchain.cpp.types import DATA, INTERFACES, Standard, find


@dataclass(frozen=True)
class Used:
    """A port element of a port or of a technical policy of a component, and the interface that it has there.

    ``called`` is the name of the port or policy and the element's, joined; ``name`` is the same as a part of identifiers.
    ``interface`` is None if no binding says which.
    """

    called: str
    name: str
    kind: str
    of_policy: bool
    interface: Declared | None
    bindings: interfaces.Bindings


def bindings_of(bound: tuple[components.AbstractTypeBinding, ...], scope: Scope) -> interfaces.Bindings:
    """What ``bound`` says where ``scope`` is."""
    kinds = (*DATA, *INTERFACES)
    return tuple((find(b.abstract_type, scope, *kinds).path, find(b.actual_type, scope, *kinds)) for b in bound)


def element_interface(
    element: interactions.PortElement, scope: Scope, bindings: interfaces.Bindings
) -> Declared | None:
    """The interface of ``element`` under ``bindings``; None if it stays abstract."""
    found = find(element.interface, scope, *INTERFACES)
    if isinstance(found.element, contracts.AbstractInterface):
        return next((actual for path, actual in bindings if path == found.path), None)
    return found


def _uses(
    owner: str,
    elements: tuple[interactions.PortElement, ...],
    scope: Scope,
    bound: interfaces.Bindings,
    of_policy: bool,
) -> Iterator[Used]:
    for element in elements:
        called = f"{owner}_{element.name}"
        interface = element_interface(element, scope, bound)
        yield Used(called, called.replace("-", "_"), element.kind, of_policy, interface, bound)


def ports_used(component_type: Declared) -> Iterator[Used]:
    """The port elements of all ports with an API, inherited ones first."""
    for ancestor in reversed(lineage(component_type)):
        assert isinstance(ancestor.element, components.ComponentType)
        for port in ancestor.element.ports:
            for spec in port.specs:
                if isinstance(spec, components.PortTypeSpec):
                    found = find(spec.type, ancestor.scope, interactions.PortType)
                    assert isinstance(found.element, interactions.PortType)
                    bound = bindings_of(spec.bindings, ancestor.scope)
                    yield from _uses(port.name, found.element.port_elements, found.scope, bound, False)


def policies_used(implementation: Declared) -> Iterator[Used]:
    """The port elements of the technical policies of ``implementation``."""
    assert isinstance(implementation.element, components.AtomicComponentImplementation)
    for named in implementation.element.policies:
        policy = find(named.name, implementation.scope, components.ComponentTechnicalPolicy)
        assert isinstance(policy.element, components.ComponentTechnicalPolicy)
        bound = bindings_of(policy.element.bindings, policy.scope)
        definition = find(policy.element.technical_policy_definition, policy.scope, TechnicalPolicyDefinition)
        for ancestor in reversed(lineage(definition)):
            assert isinstance(ancestor.element, TechnicalPolicyDefinition)
            yield from _uses(policy.element.name, ancestor.element.port_elements, ancestor.scope, bound, True)


@dataclass(frozen=True)
class Body:
    """All that the abstract class of an implementation is made of."""

    declared: Declared
    component_type: Declared
    used: tuple[Used, ...]

    @property
    def required(self) -> Iterator[Used]:
        """What the component is connected to when it starts."""
        return (u for u in self.used if u.kind == "REQUIRED" and u.interface is not None)


def body_of(implementation: Declared) -> Body:
    """What ``implementation`` maps to, together with its type."""
    assert isinstance(implementation.element, components.AtomicComponentImplementation)
    type_ = find(implementation.element.type, implementation.scope, components.ComponentType)
    return Body(implementation, type_, (*ports_used(type_), *policies_used(implementation)))


def connection(used: Used, standard: Standard) -> str:
    """The type that the connection of a required port element has a name of its own for."""
    assert used.interface is not None
    return instance("::ucm::PortConnection", interfaces.qualified_class(used.interface, used.bindings))


def _getters(body: Body, standard: Standard) -> Iterator[str]:
    for used in body.used:
        if used.kind == "PROVIDED" and used.interface is not None:
            tp = "tp_" if used.of_policy else ""
            yield f"    virtual {interfaces.reference_to(used.interface, used.bindings, standard)} get_{tp}{used.name}() = 0;"


def _attributes(body: Body, standard: Standard) -> Iterator[str]:
    for ancestor in reversed(lineage(body.component_type)):
        assert isinstance(ancestor.element, components.ComponentType)
        yield from interfaces.accessors(ancestor.element.attributes, ancestor.scope, (), standard)


def body_definition(body: Body, own_names: frozenset[str], standard: Standard) -> str:
    """The abstract class inside its namespace; ``own_names`` are the connection types that mean something else elsewhere in
    the namespace and stand in the class.
    """
    name = f"{interfaces.PREFIX}{identifier(body.declared.element.name)}"
    typedefs = {
        f"{u.name}_Connection": f"typedef {connection(u, standard)} {u.name}_Connection;" for u in body.required
    }
    taken = ", ".join(f"const {u.name}_Connection& {identifier(u.name)}" for u in body.required)
    lines = [text for alias, text in typedefs.items() if alias not in own_names]
    lines += [f"class {name} {{", "  public:"]
    lines += [f"    {text}" for alias, text in typedefs.items() if alias in own_names]
    lines += [
        f"    virtual ~{name}() {{}}",
        "    virtual void on_init() = 0;",
        f"    virtual void on_startup({taken}) = 0;",
        "    virtual void on_shutdown() = 0;",
        "    virtual void on_remove() = 0;",
        *_attributes(body, standard),
        *_getters(body, standard),
    ]
    return "\n".join([*lines, "};"]) + "\n"


def clashing_names(bodies: list[Body], standard: Standard) -> frozenset[str]:
    """The connection types that mean different things in the ``bodies`` of one namespace."""
    meant: dict[str, set[str]] = {}
    for body in bodies:
        for used in body.required:
            meant.setdefault(f"{used.name}_Connection", set()).add(connection(used, standard))
    return frozenset(name for name, types in meant.items() if len(types) > 1)
