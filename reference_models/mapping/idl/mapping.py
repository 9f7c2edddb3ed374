"""From a model to what clause 12 expects of its IDL: each thing with the requirement that asks for it and the element it is of."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.aspects import NonfunctionalAspectModule, TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import Element, Named
from ucm_cts.adapters.contract.metamodel.interactions import (
    ConnectorDefinition,
    InteractionModule,
    InteractionPattern,
    PortType,
)
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Names, Scope, each_element
from ucm_cts.reference_models.mapping.idl import expectations as exp
from ucm_cts.reference_models.mapping.idl.components import (
    PORT_ELEMENT_OBJECT,
    component_facts,
    implementation_facts,
    port_element_interfaces,
)
from ucm_cts.reference_models.mapping.idl.data_types import constant_facts, data_type_facts, is_mapped, meaning_of
from ucm_cts.reference_models.mapping.idl.equivalents import equivalent_facts
from ucm_cts.reference_models.mapping.idl.interfaces import exception_facts, interface_facts
from ucm_cts.reference_models.mapping.idl.subjects import Subject, path_in, path_of
from ucm_cts.reference_models.mapping.idl.templates import ABSTRACT, Templates, abstract

MODULE_REQUIREMENTS: dict[type[Element], str] = {
    mc.ComponentModule: "R-12.7-02",
    c.ContractModule: "R-12.7-03",
    InteractionModule: "R-12.7-04",
    NonfunctionalAspectModule: "R-12.7-05",
}
"""Which requirement asks for a module; R-12.7-06 for those that gather others."""

MAPPED = (c.DataType, c.Constant, c.Exception_, c.Interface, mc.ComponentType, mc.AtomicComponentImplementation)
"""What becomes a declaration other than a module."""


def expected_idl(model: Model) -> exp.ExpectedIdl:
    """All that clause 12 expects of the IDL of ``model``, a legal one; what an illegal one leaves open is left out."""
    names = Names(model)
    types, unmapped = {}, set()
    abstract_types: dict[exp.Path, exp.Abstract] = {}
    for element, scope in each_element(model, names):
        if isinstance(element, c.DataType):
            meaning = meaning_of(Declared(element, scope))
            if meaning is not None:
                types[path_in(scope, element.name)] = meaning
            if not is_mapped(element):
                unmapped.add(path_in(scope, element.name))
        elif isinstance(element, ABSTRACT):
            abstract_types[path_in(scope, element.name)] = abstract(element)
    return exp.ExpectedIdl(tuple(_facts(model, names)), types, abstract_types, frozenset(unmapped))


def _facts(model: Model, names: Names) -> Iterator[exp.Expected]:
    templates = Templates(names)
    bodies = _bodies(model, names)
    seen: set[tuple[exp.Path, type[Element]]] = set()
    for element, scope in each_element(model, names):
        if not isinstance(element, Named):
            continue
        subject = Subject(element, scope)
        yield from equivalent_facts(subject)
        match element:
            case c.DataType():
                yield from data_type_facts(subject)
            case c.Constant():
                yield from constant_facts(subject)
            case c.Exception_():
                yield from exception_facts(subject)
            case c.Interface():
                yield from interface_facts(subject)
            case mc.ComponentType():
                yield from component_facts(subject, bodies.get(subject.path, ()), templates)
            case mc.AtomicComponentImplementation():
                yield from implementation_facts(subject, names, templates)
            case _ if type(element) in _UNMAPPED:
                yield from _unmapped(subject)
            case _ if isinstance(element, MODULES) and (subject.path, type(element)) not in seen:
                seen.add((subject.path, type(element)))
                yield from _module(subject, names, templates)
    for interface, strict in port_element_interfaces(names):
        yield exp.Declares(**interface.about("R-12.8.3-01"), kind="interface")
        if strict:
            yield exp.Inherits(**interface.about("R-12.8.3-02"), base=PORT_ELEMENT_OBJECT)


def _bodies(model: Model, names: Names) -> dict[exp.Path, list[Subject]]:
    """The atomic implementations of each component type."""
    found: dict[exp.Path, list[Subject]] = {}
    for element, scope in each_element(model, names):
        if isinstance(element, mc.AtomicComponentImplementation):
            type_ = scope.find(element.type, mc.ComponentType)
            if type_ is not None:
                found.setdefault(path_of(type_), []).append(Subject(element, scope))
    return found


def _module(subject: Subject, names: Names, templates: Templates) -> Iterator[exp.Expected]:
    """A module without anything to declare cannot be written in IDL, so it is not needed (interpretation idl-empty-modules)."""
    module = subject.element
    assert isinstance(module, MODULES)
    requirement = MODULE_REQUIREMENTS.get(type(module), "R-12.7-06")
    scope = names.inside(module)
    yield exp.Declares(**subject.about(requirement), kind="module", needed=_has_declarations(scope))
    required, allowed = templates.parameters(module)
    own = tuple(path for path in required if path[:-1] == subject.path)
    used = tuple(path for path in required if path not in own)
    if required:
        yield exp.Templated(**subject.about("R-12.7-08"), required=own, allowed=allowed)
    yield exp.Templated(**subject.about("R-12.7-12"), required=used, allowed=allowed)
    for path in required:
        keyword = abstract(_abstract_at(path, names)).keyword
        yield exp.Parametrized(**subject.about("R-12.7-09"), parameter=path)
        requirement = "R-12.7-10" if keyword == "interface" else "R-12.7-11"
        yield exp.Parametrized(**subject.about(requirement), parameter=path, keyword=keyword)


def _abstract_at(path: exp.Path, names: Names) -> Named:
    found = names.root.find("::".join(("", *path)), *ABSTRACT)
    assert found is not None
    return found.element


def _has_declarations(scope: Scope) -> bool:
    members = [one.element for several in scope.members.values() for one in several]
    if any(isinstance(one, MAPPED) for one in members):
        return True
    return any(_has_declarations(inner) for several in scope.modules.values() for inner in several)


_UNMAPPED: dict[type[Named], str] = {
    ConnectorDefinition: "R-12.9-02",
    PortType: "R-12.9-05",
    InteractionPattern: "R-9.3.3.7-01",
    TechnicalPolicyDefinition: "R-9.4.1-07",
    mc.CompositeComponentImplementation: "R-9.5.5.9-01",
}
"""What no declaration is made of, and which requirement says so."""


def _unmapped(subject: Subject) -> Iterator[exp.Expected]:
    """Some classes have no mapping; a name that something else of the module has says nothing."""
    element, scope = subject
    if any(isinstance(one.element, (*MAPPED, *MODULES)) for one in scope.members[element.name]):
        return
    yield exp.Undeclared(**subject.about(_UNMAPPED[type(element)]))
    if isinstance(element, ConnectorDefinition):
        for port in element.ports:
            yield exp.Undeclared(**subject.about("R-12.9-03", port))
    if isinstance(element, (ConnectorDefinition, TechnicalPolicyDefinition)):
        for parameter in element.configuration_parameters:
            yield exp.Undeclared(**subject.about("R-9.1.2-02", parameter))
