"""Rules about names: everything that can have one has one, and it is the only one of its kind there (9.1.4)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.aspects import TechnicalAspect, TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import Element, Named
from ucm_cts.adapters.contract.metamodel.interactions import ConnectorDefinition, InteractionPattern, PortType
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Model, Module
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.reference.toolchain.checking import Complaint, rule

_NEED_NO_NAME = (mc.ConnectionEnd, mc.PortDelegation)
_HAVE_RULES_OF_THEIR_OWN = (*MODULES, c.StructureField, c.UnionCase)

_KINDS: tuple[tuple[str, tuple[type[Named], ...]], ...] = (
    ("data types", (c.DataType, c.AbstractDataType)),
    ("constants", (c.Constant,)),
    ("exceptions", (c.Exception_,)),
    ("interfaces", (c.Interface, c.AbstractInterface)),
    ("annotation definitions", (c.AnnotationDefinition,)),
    ("patterns", (InteractionPattern,)),
    ("connectors", (ConnectorDefinition,)),
    ("port types", (PortType,)),
    ("technical aspects", (TechnicalAspect,)),
    ("technical policy definitions", (TechnicalPolicyDefinition,)),
    ("component types", (mc.ComponentType,)),
    ("implementations", (mc.AtomicComponentImplementation, mc.CompositeComponentImplementation)),
    ("technical policies", (mc.ComponentTechnicalPolicy,)),
)
"""What a module declares, by the fields that hold it: names differ within one of them."""


@rule("R-9.1.4.1-01", Named)
def names_are_not_empty(named: Named, _scope: Scope) -> Iterable[Complaint]:
    """An identifier identifies, so it has at least one character."""
    if named.name or isinstance(named, _NEED_NO_NAME + _HAVE_RULES_OF_THEIR_OWN):
        return ()
    return [(named, f"{type(named).__name__.rstrip('_')} has an empty name; give it one")]


@rule("R-9.1.4.4-01", *MODULES)
def modules_have_names(module: Module, _scope: Scope) -> Iterator[Complaint]:
    """Paths lead through modules by their names."""
    if not module.name:
        yield module, "a module has an empty name; give it one"


@rule("R-9.2.4.3-03", c.StructureField)
def fields_have_names(field: c.StructureField, _scope: Scope) -> Iterator[Complaint]:
    """A field must have an identifier."""
    if not field.name:
        yield field, "a structure's field has an empty name; give it one"


@rule("R-9.2.4.6-01", c.UnionCase)
def cases_have_names(case: c.UnionCase, _scope: Scope) -> Iterator[Complaint]:
    """A case contains a name."""
    if not case.name:
        yield case, "a union's case has an empty name; give it one"


@rule("R-9.1.4.1-02", Model)
def declarations_of_one_kind_differ(_model: Model, root: Scope) -> Iterator[Complaint]:
    """References could not tell two declarations of one kind and name apart."""
    waiting = [root]
    while waiting:
        scope = waiting.pop()
        for same_name in scope.members.values():
            if len(same_name) > 1:
                elements = [declared.element for declared in same_name if declared.element.name]
                for kind, classes in _KINDS:
                    for second in [e for e in elements if isinstance(e, classes)][1:]:
                        yield second, f"two {kind} of {scope.path or 'the model'} are called {second.name}; rename one"
        for modules in scope.modules.values():
            waiting.extend(modules)


@rule("R-9.2.4.3-05", c.Structure)
def fields_differ(structure: c.Structure, _scope: Scope) -> Iterator[Complaint]:
    """The identifier tells the fields of a structure apart."""
    yield from repeated(structure.fields, f"fields of structure {structure.name}")


@rule("R-9.2.4.6-02", c.Union)
def cases_differ(union: c.Union, _scope: Scope) -> Iterator[Complaint]:
    """The identifier tells the cases of a union apart."""
    yield from repeated(union.cases, f"cases of union {union.name}")


@rule("R-9.2.4.8-04", c.Enumeration)
def enumerators_differ(enumeration: c.Enumeration, _scope: Scope) -> Iterator[Complaint]:
    """An enumerator is a literal of its own."""
    yield from repeated(enumeration.enumerators, f"enumerators of {enumeration.name}")


@rule("R-9.1.4.1-02", c.AnnotationDefinition, ConnectorDefinition, TechnicalPolicyDefinition)
def configuration_parameters_differ(
    owner: c.AnnotationDefinition | ConnectorDefinition | TechnicalPolicyDefinition, _scope: Scope
) -> Iterator[Complaint]:
    """A value could not tell two parameters of one name apart."""
    yield from repeated(owner.configuration_parameters, f"configuration parameters of {owner.name}")


@rule("R-9.1.4.1-02", c.Exception_)
def exception_fields_differ(exception: c.Exception_, _scope: Scope) -> Iterator[Complaint]:
    """The identifier tells the fields of an exception apart."""
    yield from repeated(exception.fields, f"fields of exception {exception.name}")


@rule("R-9.1.4.1-02", c.Interface, mc.ComponentType)
def attributes_differ(owner: c.Interface | mc.ComponentType, _scope: Scope) -> Iterator[Complaint]:
    """The identifier tells the attributes of one owner apart."""
    yield from repeated(owner.attributes, f"attributes of {owner.name}")


@rule("R-9.1.4.1-02", c.Method)
def parameters_differ(method: c.Method, _scope: Scope) -> Iterator[Complaint]:
    """The identifier tells the parameters of a method apart."""
    yield from repeated(method.parameters, f"parameters of method {method.name}")


@rule("R-9.1.4.1-02", InteractionPattern)
def roles_and_items_differ(pattern: InteractionPattern, _scope: Scope) -> Iterator[Complaint]:
    """Connectors could not tell two roles, or two items, of one name apart."""
    yield from repeated(pattern.roles, f"roles of pattern {pattern.name}")
    yield from repeated(pattern.items, f"items of pattern {pattern.name}")


@rule("R-9.1.4.1-02", ConnectorDefinition)
def connector_ports_differ(connector: ConnectorDefinition, _scope: Scope) -> Iterator[Complaint]:
    """The identifier tells the ports of a connector apart."""
    yield from repeated(connector.ports, f"ports of connector {connector.name}")


@rule("R-9.1.4.1-02", PortType, TechnicalPolicyDefinition)
def port_elements_differ(owner: PortType | TechnicalPolicyDefinition, _scope: Scope) -> Iterator[Complaint]:
    """Code could not tell two port elements of one name apart."""
    yield from repeated(owner.port_elements, f"port elements of {owner.name}")


@rule("R-9.1.4.1-02", mc.ComponentType)
def ports_differ(component_type: mc.ComponentType, _scope: Scope) -> Iterator[Complaint]:
    """Connections could not tell two ports of one name apart."""
    yield from repeated(component_type.ports, f"ports of component type {component_type.name}")


@rule("R-9.1.4.1-02", mc.CompositeComponentImplementation)
def parts_differ(composite: mc.CompositeComponentImplementation, _scope: Scope) -> Iterator[Complaint]:
    """Connections could not tell two parts of one name apart."""
    yield from repeated(composite.parts, f"parts of {composite.name}")


def repeated(elements: Iterable[Named], what: str) -> Iterator[tuple[Element, str]]:
    """A complaint for each of ``elements`` whose name an earlier one has."""
    seen: set[str] = set()
    for element in elements:
        if element.name and element.name in seen:
            yield element, f"two {what} are called {element.name}; rename one of them"
        seen.add(element.name)
