"""Component types and implementations as IDL interfaces, with getters for what they provide (12.8)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.contracts import AbstractInterface, Interface
from ucm_cts.adapters.contract.metamodel.interactions import PortElement, PortType
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Model, Module
from ucm_cts.adapters.contract.metamodel.names import Declared, Names, Scope, each_element, lineage
from ucm_cts.adapters.reference.toolchain.idl.names import ABSTRACT, TYPES, Templates, absolute, identifier
from ucm_cts.adapters.reference.toolchain.idl.types import Lines, attribute, block, inherits

COMPONENT_OBJECT = "::ComponentObject"
PORT_ELEMENT_OBJECT = "::PortElementObject"

Bound = Mapping[str, Declared]
"""What stands for abstract types, by their paths."""


class Components:
    """Makes interfaces of component types and implementations. ``_modules`` are all modules by their paths."""

    def __init__(self, model: Model, names: Names, templates: Templates) -> None:
        self._templates = templates
        self._modules: dict[str, list[Module]] = {}
        self._given: dict[str, list[Declared]] = {}
        self._managed: dict[str, list[Declared]] = {}
        for element, scope in each_element(model, names, *MODULES, mc.ComponentTechnicalPolicy):
            if isinstance(element, MODULES):
                self._modules.setdefault(names.inside(element).path, []).append(element)
            if isinstance(element, mc.ComponentTechnicalPolicy):
                for one in element.managed_components:
                    found = scope.find(one.name, mc.AtomicComponentImplementation)
                    if found is not None:
                        self._managed.setdefault(found.path, []).append(Declared(element, scope))

    def component_type(self, element: mc.ComponentType, scope: Scope) -> Lines:
        """The equivalent interface, after the template instances that its getters need."""
        before, lines = Lines(), Lines()
        for one in element.attributes:
            lines += attribute(one, scope)
        base = scope.find(element.refines, mc.ComponentType) if element.refines else None
        inherited = self._inherited(base) if base is not None else set()
        for port in element.ports:
            for name, result, instances in self.getters(element.name, port, scope):
                if name not in inherited:
                    before += instances
                    lines.append(f"{result} {name}();")
        bases = [absolute(base)] if base is not None else []
        return [*before, *block(f"interface {identifier(element.name)}{inherits(bases)}", lines)]

    def _inherited(self, base: Declared) -> set[str]:
        found = set()
        for ancestor in lineage(base):
            assert isinstance(ancestor.element, mc.ComponentType)
            for port in ancestor.element.ports:
                found |= {name for name, _, _ in self.getters(ancestor.element.name, port, ancestor.scope)}
        return found

    def getters(self, owner: str, port: mc.Port, scope: Scope) -> list[tuple[str, str, Lines]]:
        """For each element that a port provides: the getter's name, its result, and the template instances that needs."""
        found = []
        for spec in port.specs:
            type_ = scope.find(spec.type, PortType) if isinstance(spec, mc.PortTypeSpec) else None
            if type_ is None or not isinstance(spec, mc.PortTypeSpec):
                continue
            assert isinstance(type_.element, PortType)
            bound = bindings(spec.bindings, scope)
            for element in type_.element.port_elements:
                if element.kind == "PROVIDED":
                    label = f"{owner}_{port.name}_{element.name}"
                    result, instances = self.result(element, type_.scope, bound, label)
                    found.append((plain(f"get_{port.name}_{element.name}"), result, instances))
        return found

    def result(self, element: PortElement, scope: Scope, bound: Bound, label: str) -> tuple[str, Lines]:
        """The interface of a port element once bound, and the template instances that lead to it, called after ``label``."""
        found = scope.find(element.interface, Interface, AbstractInterface)
        assert found is not None
        if isinstance(found.element, AbstractInterface):
            return absolute(bound[found.path]), []
        prefix, instances, path = "", Lines(), ""
        for part in found.scope.path.split("::")[1:]:
            path += f"::{part}"
            given = self._parameters(path)
            prefix += f"::{identifier(part)}"
            if given:
                name = plain(f"{label}_{part}")
                instances.append(f"module {prefix}<{', '.join(_argument(one, bound) for one in given)}> {name};")
                prefix = name
        return f"{prefix}::{identifier(found.element.name)}", instances

    def _parameters(self, path: str) -> list[Declared]:
        """The template parameters of the modules of this ``path``."""
        given = self._given.get(path)
        if given is None:
            given = [one for module in self._modules[path] for one in self._templates.parameters(module)]
            self._given[path] = given
        return given

    def body(self, element: mc.AtomicComponentImplementation, scope: Scope) -> Lines:
        """The body interface, after the template instances that its getters need."""
        type_ = scope.find(element.type, mc.ComponentType)
        assert type_ is not None
        before, lines = Lines(), Lines()
        for policy, around in self.policies(element, scope):
            assert isinstance(policy, mc.ComponentTechnicalPolicy)
            definition = around.find(policy.technical_policy_definition, TechnicalPolicyDefinition)
            for ancestor in lineage(definition) if definition is not None else []:
                assert isinstance(ancestor.element, TechnicalPolicyDefinition)
                for one in ancestor.element.port_elements:
                    if one.kind == "PROVIDED":
                        label = f"{element.name}_{policy.name}_{one.name}"
                        result, instances = self.result(one, ancestor.scope, bindings(policy.bindings, around), label)
                        before += instances
                        lines.append(f"{result} {plain(f'get_tp_{policy.name}_{one.name}')}();")
        bases = [absolute(type_), COMPONENT_OBJECT]
        return [*before, *block(f"interface {plain(element.name + '_Body')}{inherits(bases)}", lines)]

    def policies(self, element: mc.AtomicComponentImplementation, scope: Scope) -> list[Declared]:
        """The component policies of an implementation, each once; those of ports are no business of the body's."""
        named = (scope.find(one.name, mc.ComponentTechnicalPolicy) for one in element.policies)
        found = {one.path: one for one in named if one is not None}
        found.update({one.path: one for one in self._managed.get(Declared(element, scope).path, [])})
        return [one for one in found.values() if not isinstance(one.element, mc.ComponentPortTechnicalPolicy)]


def plain(name: str) -> str:
    """A composed name, which no keyword equals."""
    return name.replace("-", "_")


def _argument(given: Declared, bound: Bound) -> str:
    if given.path in bound:
        return absolute(bound[given.path])
    return PORT_ELEMENT_OBJECT if isinstance(given.element, AbstractInterface) else "octet"


def bindings(declared: Sequence[mc.AbstractTypeBinding], scope: Scope) -> Bound:
    """What stands for abstract types, by their paths."""
    pairs = ((scope.find(one.abstract_type, *ABSTRACT), scope.find(one.actual_type, *TYPES)) for one in declared)
    return {a.path: b for a, b in pairs if a is not None and b is not None}


def port_element_interfaces(model: Model, names: Names) -> set[str]:
    """The paths of all interfaces that port elements use, be it in place of abstract ones."""
    found = set()
    for element, scope in each_element(model, names, PortType, TechnicalPolicyDefinition, mc.AbstractTypeBinding):
        if isinstance(element, (PortType, TechnicalPolicyDefinition)):
            interfaces = (scope.find(one.interface, Interface) for one in element.port_elements)
            found |= {one.path for one in interfaces if one is not None}
        if isinstance(element, mc.AbstractTypeBinding):
            actual = scope.find(element.actual_type, Interface)
            found |= {actual.path} if actual is not None else set()
    return found
