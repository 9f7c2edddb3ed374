"""What 12.8 makes of component types, implementations, ports and technical policies."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.contracts import Interface
from ucm_cts.adapters.contract.metamodel.interactions import PortElement, PortType
from ucm_cts.adapters.contract.metamodel.names import Declared, Names, Scope, lineage
from ucm_cts.reference_models.mapping.idl import expectations as exp
from ucm_cts.reference_models.mapping.idl.declarations import Type
from ucm_cts.reference_models.mapping.idl.interfaces import attribute_facts, bound_attributes, signatures
from ucm_cts.reference_models.mapping.idl.subjects import INTERFACES, TYPES, Bound, Subject, named, path_in, path_of
from ucm_cts.reference_models.mapping.idl.templates import ABSTRACT, Templates

BODY = "_Body"
COMPONENT_OBJECT = ("ComponentObject",)
PORT_ELEMENT_OBJECT = ("PortElementObject",)
OF_CONTAINERS = ("FragmentObject", "Container", "ContainerManager")
"""Interfaces of 12.10 that no body of a plain component has to implement."""


ASPECTS_OF_PORTS = {"presence": "R-12.8.4-04", "arguments": "R-12.8.4-05", "result": "R-12.8.4-06"}
ASPECTS_OF_POLICIES = {"presence": "R-12.8.5-02", "arguments": "R-12.8.5-04", "result": "R-12.8.5-05"}


class Used(NamedTuple):
    """The interface of a port element as a component sees it: its declaration, and what stands for abstract types."""

    interface: Declared
    bound: Bound


def component_facts(subject: Subject, bodies: Sequence[Subject], templates: Templates) -> Iterator[exp.Expected]:
    """All that is expected of a component type; ``bodies`` are its implementations, where getters may be found, too."""
    component = subject.element
    assert isinstance(component, mc.ComponentType)
    yield exp.Declares(**subject.about("R-12.8.1-01"), kind="interface")
    for attribute in component.attributes:
        yield from attribute_facts(subject, attribute, "R-12.8.1-02")
    names = tuple(attribute.name for attribute in component.attributes)
    ancestors = tuple(path_of(one) for one in lineage(Declared(component, subject.scope)))[1:]
    yield exp.Only(**subject.about("R-12.8.1-02"), kind="attribute", names=names, ancestors=ancestors)
    getters = tuple(
        f"get_{port.name}{rest}" for port, _ in ports_of(Declared(component, subject.scope)) for rest in ("", "_*")
    )
    yield exp.Only(
        **subject.about("R-12.8.1-06"),
        kind="operation",
        names=(),
        patterns=(*getters, "get_tp_*"),  # another expectation says which must be there
        ancestors=ancestors,
    )
    base = subject.scope.find(component.refines, mc.ComponentType) if component.refines else None
    if base is not None:
        yield exp.Inherits(**subject.about("R-12.8.1-05"), base=path_of(base))
    for port, scope in ports_of(Declared(component, subject.scope)):
        yield from _port(subject, port, scope, bodies, templates)


def ports_of(component: Declared) -> list[tuple[mc.Port, Scope]]:
    """The ports of a component type, inherited ones too, without those that another one of the same name refines."""
    found: dict[str, tuple[mc.Port, Scope]] = {}
    for element, scope in lineage(component):
        assert isinstance(element, mc.ComponentType)
        for port in element.ports:
            found.setdefault(port.name, (port, scope))
    return list(found.values())


def body_path(implementation: Subject) -> exp.Path:
    """Where the body interface of an implementation stands."""
    return path_in(implementation.scope, implementation.element.name + BODY)


def _port(
    subject: Subject, port: mc.Port, scope: Scope, bodies: Sequence[Subject], templates: Templates
) -> Iterator[exp.Expected]:
    holders = [(body_path(body), subject.path, True) for body in bodies] or [(subject.path, exp.Path(), False)]
    specs = [spec for spec in port.specs if isinstance(spec, mc.PortTypeSpec)]
    if not specs:
        for path, _, _ in holders:
            yield exp.NoGetter(
                **subject.about("R-12.8.4-02", port, path=path), names=(f"get_{port.name}", f"get_{port.name}_*")
            )
        return
    for spec in specs:
        found = scope.find(spec.type, PortType)
        if found is None:
            continue
        assert isinstance(found.element, PortType)
        bound = bindings(spec.bindings, scope)
        for element in found.element.port_elements:
            name = f"get_{port.name}_{element.name}"
            for path, otherwise, needed in holders:
                if element.kind == "REQUIRED":
                    yield exp.NoGetter(**subject.about("R-12.8.4-07", port, path=path), names=(name,))
                elif element.kind == "PROVIDED":
                    yield from _getters(
                        subject,
                        (port, path, otherwise, needed),
                        (name,),
                        used_interface(element, found.scope, bound),
                        templates,
                        ASPECTS_OF_PORTS,
                    )


def bindings(declared: Sequence[mc.AbstractTypeBinding], scope: Scope) -> Bound:
    """What stands for abstract types, of those bindings that the model gives sense to."""
    pairs = ((scope.find(one.abstract_type, *ABSTRACT), scope.find(one.actual_type, *TYPES)) for one in declared)
    return {path_of(a): named(path_of(b)) for a, b in pairs if a is not None and b is not None}


def used_interface(element: PortElement, scope: Scope, bound: Bound) -> Used | None:
    """The interface that ``element`` provides or requires once ``bound``; None if the model does not say."""
    found = scope.find(element.interface, *INTERFACES)
    if found is None:
        return None
    if isinstance(found.element, Interface):
        return Used(found, bound)
    actual = bound.get(path_of(found))
    name = getattr(actual, "name", "")
    concrete = scope.root.find(name, Interface) if name else None
    return Used(concrete, bound) if concrete is not None else None


def _getters(
    subject: Subject,
    place: tuple[mc.Port | mc.ComponentTechnicalPolicy, exp.Path, exp.Path, bool],
    names: tuple[str, ...],
    used: Used | None,
    templates: Templates,
    aspects: dict[str, str],
) -> Iterator[exp.Expected]:
    inner, path, otherwise, needed = place
    for aspect, requirement in aspects.items():
        if aspect == "result" and used is None:
            continue
        yield exp.Getter(
            **subject.about(requirement, inner, path=path),
            aspect=aspect,
            names=names,
            returns=_returned(used),
            bound=_bound(used, templates),
            otherwise=otherwise,
            needed=needed,
        )


def _returned(used: Used | None) -> Type:
    return named(path_of(used.interface)) if used is not None else named(())


def _bound(used: Used | None, templates: Templates) -> exp.BoundInterface | None:
    """What an interface with abstract types has when they are bound; None if it has no abstract types."""
    if used is None or not templates.used_by(used.interface):
        return None

    def is_open(one: Declared) -> bool:
        return bool(templates.used_by(one))

    return exp.BoundInterface(
        signatures(used.interface, used.bound, is_open), bound_attributes(used.interface, used.bound, is_open)
    )


def implementation_facts(subject: Subject, names: Names, templates: Templates) -> Iterator[exp.Expected]:
    """All that is expected of an atomic implementation, except the getters of its ports."""
    implementation = subject.element
    assert isinstance(implementation, mc.AtomicComponentImplementation)
    path = body_path(subject)
    yield exp.Declares(**subject.about("R-12.8.2-01", path=path), kind="interface")
    type_ = subject.scope.find(implementation.type, mc.ComponentType)
    if type_ is not None:
        yield exp.Inherits(**subject.about("R-12.8.2-02", path=path), base=path_of(type_))
    yield exp.Inherits(**subject.about("R-12.8.2-03", path=path), base=COMPONENT_OBJECT)
    yield exp.InheritsNone(**subject.about("R-12.8.2-03", path=path), bases=OF_CONTAINERS)
    for policy, both in policies_of(subject, names):
        yield from _policy(subject, policy, path, both, templates)
        yield from _without_parameters(subject, policy, path)
        if type_ is not None and not any(port.name.startswith("tp") for port, _ in ports_of(type_)):
            yield from _without_getters(subject, policy, path_of(type_))


def _without_getters(subject: Subject, declared: Declared, path: exp.Path) -> Iterator[exp.Expected]:
    """The getters of a policy belong to the body: the interface at ``path`` is that of all bodies of a component type.

    Names of port getters do not look like theirs there.
    """
    policy, scope = declared
    assert isinstance(policy, mc.ComponentTechnicalPolicy)
    definition = scope.find(policy.technical_policy_definition, TechnicalPolicyDefinition)
    for ancestor in lineage(definition) if definition is not None else []:
        for element in getattr(ancestor.element, "port_elements", ()):
            if definition is not None and element.kind == "PROVIDED":
                names = policy_getter_names(policy.name, definition.element.name, element.name)
                yield exp.NoMember(**subject.about("R-12.8.2-04", policy, path=path), names=names)


def _without_parameters(subject: Subject, declared: Declared, path: exp.Path) -> Iterator[exp.Expected]:
    """No member of the body is called like a configuration parameter of a policy, unless the model has another reason for it."""
    policy, scope = declared
    assert isinstance(policy, mc.ComponentTechnicalPolicy)
    definition = scope.find(policy.technical_policy_definition, TechnicalPolicyDefinition)
    for ancestor in lineage(definition) if definition is not None else []:
        for parameter in getattr(ancestor.element, "configuration_parameters", ()):
            given = [parameter.name, *(f"{verb}_{parameter.name}" for verb in ("get", "set"))]
            names = (*given, f"get_tp_{policy.name}_{parameter.name}")
            yield exp.NoMember(**subject.about("R-9.1.2-02", policy, path=path), names=names)


def policies_of(subject: Subject, names: Names) -> Iterator[tuple[Declared, bool]]:
    """The component policies that an implementation names or is managed by, and whether it is both."""
    implementation = subject.element
    assert isinstance(implementation, mc.AtomicComponentImplementation)
    found = (subject.scope.find(one.name, mc.ComponentTechnicalPolicy) for one in implementation.policies)
    mine = {path_of(one): one for one in found if one is not None}
    managing = {path_of(one): one for one in _managing(names).get(subject.path, ())}
    for path, declared in (mine | managing).items():
        if not isinstance(declared.element, mc.ComponentPortTechnicalPolicy):
            yield declared, path in mine and path in managing


def _managing(names: Names) -> Mapping[exp.Path, Sequence[Declared]]:
    """The policies that say that they manage an implementation, by its path."""
    return names.root.remembered("managing policies", lambda: _found_managing(names.root))


def _found_managing(root: Scope) -> dict[exp.Path, list[Declared]]:
    found: dict[exp.Path, list[Declared]] = {}
    for declared in every(root, mc.ComponentTechnicalPolicy):
        policy = declared.element
        assert isinstance(policy, mc.ComponentTechnicalPolicy)
        managed = (declared.scope.find(one.name, mc.AtomicComponentImplementation) for one in policy.managed_components)
        for path in dict.fromkeys(path_of(one) for one in managed if one is not None):
            found.setdefault(path, []).append(declared)
    return found


def every(scope: Scope, kind: type[mc.ComponentTechnicalPolicy]) -> Iterator[Declared]:
    """All elements of ``kind`` in ``scope`` and in the modules inside it."""
    for declared in (one for members in scope.members.values() for one in members):
        if isinstance(declared.element, kind):
            yield declared
    for inner in (one for modules in scope.modules.values() for one in modules):
        yield from every(inner, kind)


def _policy(
    subject: Subject, declared: Declared, path: exp.Path, both: bool, templates: Templates
) -> Iterator[exp.Expected]:
    policy, scope = declared
    assert isinstance(policy, mc.ComponentTechnicalPolicy)
    definition = scope.find(policy.technical_policy_definition, TechnicalPolicyDefinition)
    if definition is None:
        return
    bound = bindings(policy.bindings, scope)
    for ancestor in lineage(definition):
        assert isinstance(ancestor.element, TechnicalPolicyDefinition)
        for element in ancestor.element.port_elements:
            names = policy_getter_names(policy.name, definition.element.name, element.name)
            if element.kind == "REQUIRED":
                yield exp.NoGetter(**subject.about("R-12.8.5-03", policy, path=path), names=names)
            elif element.kind == "PROVIDED":
                used = used_interface(element, ancestor.scope, bound)
                place = (policy, path, exp.Path(), both)
                yield from _getters(subject, place, names, used, templates, ASPECTS_OF_POLICIES)


def policy_getter_names(policy: str, definition: str, element: str) -> tuple[str, ...]:
    """What the getter may be called, by the readings of idl-policy-getters: instance, definition, component-and-instance."""
    return f"get_tp_{policy}_{element}", f"get_tp_{definition}_{element}", f"get_tp_*{policy}_{element}"


def port_element_interfaces(names: Names) -> Iterator[tuple[Subject, bool]]:
    """The interfaces of port elements, each with whether it must be a PortElementObject: those that a policy definition only
    provides need not (interpretation policy-interfaces).
    """
    found: dict[exp.Path, tuple[Subject, bool]] = {}
    for declared in _everything(names.root):
        element, scope = declared
        elements = element.port_elements if isinstance(element, (PortType, TechnicalPolicyDefinition)) else ()
        for one in elements:
            interface = scope.find(one.interface, Interface)
            if interface is not None:
                strict = isinstance(element, PortType) or one.kind == "REQUIRED"
                _note(found, interface, strict)
        if isinstance(element, (mc.ComponentType, mc.ComponentTechnicalPolicy)):
            for used in _bound_interfaces(declared):
                _note(found, used, isinstance(element, mc.ComponentType))
    yield from found.values()


def _note(found: dict[exp.Path, tuple[Subject, bool]], interface: Declared, strict: bool) -> None:
    path = path_of(interface)
    found[path] = (Subject(*interface), strict or (path in found and found[path][1]))


def _bound_interfaces(declared: Declared) -> Iterator[Declared]:
    """The interfaces that stand for abstract ones in port elements of a component type's ports or of a policy."""
    element, scope = declared
    if isinstance(element, mc.ComponentTechnicalPolicy):
        definition = scope.find(element.technical_policy_definition, TechnicalPolicyDefinition)
        sources = [(one, element.bindings) for one in lineage(definition)] if definition is not None else []
    else:
        assert isinstance(element, mc.ComponentType)
        specs = [spec for port in element.ports for spec in port.specs if isinstance(spec, mc.PortTypeSpec)]
        typed = ((scope.find(spec.type, PortType), spec.bindings) for spec in specs)
        sources = [(found, given) for found, given in typed if found is not None]
    for source, given in sources:
        assert isinstance(source.element, (PortType, TechnicalPolicyDefinition))
        for one in source.element.port_elements:
            used = used_interface(one, source.scope, bindings(given, scope))
            if used is not None:
                yield used.interface


def _everything(scope: Scope) -> Iterator[Declared]:
    for members in scope.members.values():
        yield from members
    for inner in (one for modules in scope.modules.values() for one in modules):
        yield from _everything(inner)
