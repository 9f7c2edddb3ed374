"""Rules about names: everything that can have one has one, and it is the only one of its kind there (9.1.4)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from operator import attrgetter

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.aspects import ProgrammingLanguages, TechnicalAspect, TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import Element, Named
from ucm_cts.adapters.contract.metamodel.interactions import ConnectorDefinition, InteractionPattern, PortType
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Model, Module
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.reference.toolchain.checking import Complaint, FindComplaints, has_name, rule

_NEED_NO_NAME = (mc.PortDelegation,)
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


@rule("R-9.1.4.1-01", Named, judged_by=has_name)
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


@rule("R-9.2.4.3-03", c.StructureField, judged_by=has_name)
def fields_have_names(field: c.StructureField, _scope: Scope) -> Iterator[Complaint]:
    """A field must have an identifier."""
    if not field.name:
        yield field, "a structure's field has an empty name; give it one"


@rule("R-9.2.4.6-01", c.UnionCase, judged_by=has_name)
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


Owners = tuple[type[Element], ...]

_MEMBERS: tuple[tuple[str, str, Owners, dict[str, str]], ...] = (
    ("fields_differ", "R-9.2.4.3-05", (c.Structure,), {"fields": "fields of structure"}),
    ("cases_differ", "R-9.2.4.6-02", (c.Union,), {"cases": "cases of union"}),
    ("enumerators_differ", "R-9.2.4.8-04", (c.Enumeration,), {"enumerators": "enumerators of"}),
    (
        "configuration_parameters_differ",
        "R-9.1.4.1-02",
        (c.AnnotationDefinition, ConnectorDefinition, TechnicalPolicyDefinition),
        {"configuration_parameters": "configuration parameters of"},
    ),
    ("exception_fields_differ", "R-9.1.4.1-02", (c.Exception_,), {"fields": "fields of exception"}),
    ("attributes_differ", "R-9.1.4.1-02", (c.Interface, mc.ComponentType), {"attributes": "attributes of"}),
    ("parameters_differ", "R-9.1.4.1-02", (c.Method,), {"parameters": "parameters of method"}),
    (
        "roles_and_items_differ",
        "R-9.1.4.1-02",
        (InteractionPattern,),
        {"roles": "roles of pattern", "items": "items of pattern"},
    ),
    ("connector_ports_differ", "R-9.1.4.1-02", (ConnectorDefinition,), {"ports": "ports of connector"}),
    (
        "port_elements_differ",
        "R-9.1.4.1-02",
        (PortType, TechnicalPolicyDefinition),
        {"port_elements": "port elements of"},
    ),
    ("ports_differ", "R-9.1.4.1-02", (mc.ComponentType,), {"ports": "ports of component type"}),
    (
        "parts_differ",
        "R-9.1.4.1-02",
        (mc.CompositeComponentImplementation,),
        {"parts": "parts of", "connections": "connections of"},
    ),
    ("ends_differ", "R-9.1.4.1-02", (mc.Connection,), {"ends": "ends of connection"}),
    ("languages_differ", "R-9.1.4.1-02", (ProgrammingLanguages,), {"languages": "programming languages"}),
)
"""The rules that names of members differ: name, requirement, owners, and what messages call the members of each field."""


def _differ(name: str, fields: dict[str, str]) -> FindComplaints:
    """The rule that no two members in one of ``fields`` have the same name."""

    members = [attrgetter(field) for field in fields]

    def complaints(owner: Element, _scope: Scope) -> Iterable[Complaint]:
        for held in members:
            if _repeats(held(owner)):
                break
        else:
            return ()
        return [one for field, what in fields.items() for one in repeated(getattr(owner, field), _called(what, owner))]

    complaints.__name__ = name
    return complaints


for _name, _requirement, _owners, _fields in _MEMBERS:
    rule(_requirement, *_owners)(_differ(_name, _fields))


def _called(what: str, owner: Element) -> str:
    return f"{what} {getattr(owner, 'name', '')}".rstrip()


def _repeats(elements: Sequence[Named]) -> bool:
    return len(elements) > 1 and len(set(map(_NAME, elements))) < len(elements)


_NAME = attrgetter("name")


def repeated(elements: Iterable[Named], what: str) -> Iterator[tuple[Element, str]]:
    """A complaint for each of ``elements`` whose name an earlier one has."""
    seen: set[str] = set()
    for element in elements:
        if element.name and element.name in seen:
            yield element, f"two {what} are called {element.name}; rename one of them"
        seen.add(element.name)
