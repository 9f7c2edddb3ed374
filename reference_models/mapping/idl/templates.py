"""Which modules become templates, and with which parameters (12.7)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import Element, Named, children
from ucm_cts.adapters.contract.metamodel.contracts import (
    AbstractDataType,
    AbstractInterface,
    Alias,
    Array,
    Constant,
    Exception_,
    Interface,
    Sequence,
    Structure,
    Union,
)
from ucm_cts.adapters.contract.metamodel.interactions import ConnectorDefinition, PortType
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Module
from ucm_cts.adapters.contract.metamodel.names import Declared, Names, Scope
from ucm_cts.reference_models.mapping.idl.expectations import Abstract, Path
from ucm_cts.reference_models.mapping.idl.subjects import INTERFACES, TYPES, path_of

ABSTRACT = (AbstractDataType, AbstractInterface)


class Parameters(NamedTuple):
    """Of a module: the abstract types that must be its template parameters, and all those that may."""

    required: tuple[Path, ...]
    allowed: tuple[Path, ...]


class Templates:
    """Finds the abstract types that elements of a model use."""

    def __init__(self, names: Names) -> None:
        self._names = names
        self._all: dict[Path, frozenset[Path]] = {}

    def parameters(self, module: Module) -> Parameters:
        """The template parameters of ``module``: those that it declares or uses itself are required, those that it uses in any
        roundabout way, or that stand in a module inside it, are allowed (interpretation idl-template-propagation).
        """
        scope = self._names.inside(module)
        required: dict[Path, None] = {}
        allowed: dict[Path, None] = {}
        for element in children(module):
            if isinstance(element, MODULES):
                allowed.update(dict.fromkeys(self.parameters(element).allowed))
            elif isinstance(element, Named):
                declared = Declared(element, scope)
                if isinstance(element, ABSTRACT):
                    required[path_of(declared)] = None
                direct = [path_of(one) for one in referenced(declared) if isinstance(one.element, ABSTRACT)]
                (allowed if isinstance(element, ConnectorDefinition) else required).update(dict.fromkeys(direct))
                allowed.update(dict.fromkeys(sorted(self.used_by(declared))))
        return Parameters(tuple(required), tuple(required | allowed))

    def used_by(self, declared: Declared) -> frozenset[Path]:
        """The abstract types that ``declared`` uses, itself or in what it uses."""
        path = (*path_of(declared), type(declared.element).__name__)
        if path not in self._all:
            found, waiting, met = set[Path](), [declared], set[Path]()
            while waiting:
                current = waiting.pop()
                here = (*path_of(current), type(current.element).__name__)
                if here in met:
                    continue
                met.add(here)
                if here in self._all:
                    found |= self._all[here]
                    continue
                if isinstance(current.element, ABSTRACT):
                    found.add(path_of(current))
                waiting.extend(referenced(current))
            if not found:  # neither does any of those that it uses
                self._all.update(dict.fromkeys(met, frozenset()))
            self._all[path] = frozenset(found)
        return self._all[path]


def abstract(element: Element) -> Abstract:
    """The template parameter that stands for an abstract type."""
    assert isinstance(element, ABSTRACT)
    return Abstract("interface" if isinstance(element, AbstractInterface) else "typename", element.name)


def referenced(declared: Declared) -> Iterator[Declared]:
    """The types, exceptions and port types that ``declared`` refers to directly."""
    element, scope = declared
    for reference, kinds in _references(element, scope):
        found = scope.find(reference, *kinds) if reference else None
        if found is not None:
            yield found


def _references(element: Named, scope: Scope) -> Iterator[tuple[str, tuple[type[Named], ...]]]:
    match element:
        case Alias() | Array() | Sequence() | Constant():
            yield element.type, TYPES
        case Structure() | Exception_():
            yield from ((field.type, TYPES) for field in element.fields)
        case Union():
            yield from ((reference, TYPES) for reference in (element.selector_type, *(c.type for c in element.cases)))
        case Interface():
            yield from ((one.interface, INTERFACES) for one in element.inherited_interfaces)
            yield from ((attribute.type, TYPES) for attribute in element.attributes)
            for method in element.methods:
                yield from ((parameter.type, TYPES) for parameter in method.parameters)
                yield from ((raised.exception, (Exception_,)) for raised in method.raised_exceptions)
        case PortType() | TechnicalPolicyDefinition():
            yield from ((one.interface, INTERFACES) for one in element.port_elements)
        case ConnectorDefinition():
            yield from ((binding.connector_item, TYPES) for binding in element.item_bindings)
            yield from ((port.api, (PortType,)) for port in element.ports)
