"""Tool chains that are wrong about interfaces, exceptions, abstract types or annotations (9.2.7 to 9.2.9)."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel import contracts as mk
from ucm_cts.adapters.contract.metamodel.common import children
from ucm_cts.adapters.contract.metamodel.components import AbstractTypeBinding, ComponentModule
from ucm_cts.adapters.contract.metamodel.interactions import ConnectorDefinition, InteractionModule
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.mutants.toolchain.checking import refuses


@refuses(
    "R-9.2.7-01",
    also=("R-9.3.4-05", "R-9.4.3.2-02", "R-9.4.3.2-12", "R-9.5.3.7-03", "R-9.5.3.7-05", "R-9.5.5.4-08", "R-9.5.5.6-05"),
)
def one_interface_a_module(model: Model, _: Scope) -> bool:
    """Takes a model of two interfaces for an error where neither has anything inside."""
    inside = [one for module in model.modules for one in children(module)]
    return [type(one) for one in inside] == [mk.Interface, mk.Interface] and not any(map(tuple, map(children, inside)))


@refuses("R-9.2.7-09", also=("R-9.4.3.2-02",))
def methods_have_parameters(method: mk.Method, _: Scope) -> bool:
    """Takes a method of several IN parameters for an error."""
    return len([p for p in method.parameters if p.direction == "IN"]) > 2


@refuses("R-9.2.7-14")
def no_diamonds(interface: mk.Interface, scope: Scope) -> bool:
    """Takes an ancestor that is reached by two ways for an error."""
    ways = [set(_lineage(i.interface, scope)) for i in interface.inherited_interfaces]
    return sum(map(len, ways)) > len(set().union(*ways))


def _lineage(name: str, scope: Scope, depth: int = 20) -> Iterator[str]:
    yield name
    found = _named(name, scope) if depth else None
    for inherited in found.inherited_interfaces if found is not None else ():
        yield from _lineage(inherited.interface, scope, depth - 1)


@refuses("R-9.2.7.1-01")
def no_mutual_interfaces(interface: mk.Interface, scope: Scope) -> bool:
    """Takes it for a circle that two interfaces know each other, or one itself, by way of a parameter."""
    return any(interface.name in _taken(_named(t, scope)) for t in _taken(interface))


def _taken(interface: mk.Interface | None) -> set[str]:
    methods = interface.methods if interface is not None else ()
    return {parameter.type for method in methods for parameter in method.parameters}


def _named(name: str, scope: Scope) -> mk.Interface | None:
    found = scope.find(name, mk.Interface)
    return found.element if found is not None and isinstance(found.element, mk.Interface) else None


@refuses("R-9.2.7.3-01", also=("R-9.2.2.5-02",))
def parameters_do_something(parameter: mk.Parameter, scope: Scope) -> bool:
    """Takes a parameter that is an interface without methods for an error."""
    found = scope.find(parameter.type, mk.Interface)
    return found is not None and not any(children(found.element))


@refuses("R-9.2.8-01")
def abstract_types_are_used(module: mk.ContractModule, _: Scope) -> bool:
    """Takes a module of more than two abstract types and nothing else for an error."""
    inside = tuple(children(module))
    return len(inside) > 2 and all(isinstance(one, mk.AbstractDataType | mk.AbstractInterface) for one in inside)


@refuses("R-9.2.8.2-01", also=("R-9-01", "R-9.3.5.2-02"))
def abstract_interfaces_are_required(module: InteractionModule, scope: Scope) -> bool:
    """Takes a port type that provides an abstract interface for an error in a module without patterns."""
    abstract = {i.name for c in module.contract_modules for i in c.interfaces if isinstance(i, mk.AbstractInterface)}
    elements = [e for port_type in module.port_types for e in port_type.port_elements if not module.patterns]
    return any(e.kind == "PROVIDED" and e.interface.rpartition("::")[2] in abstract for e in elements)


@refuses("R-9.2.8-04")
def actual_types_are_named_from_the_root(b: AbstractTypeBinding, _: Scope) -> object:
    """Takes a binding of an abstract type for an error if the actual one is named by a relative path."""
    return "::" in b.actual_type.lstrip(":") and b.actual_type[0] != ":"


@refuses("R-9.2.9-01", also=("R-9.3.1-11",))
def connectors_are_not_configured_by_enumerations(connector: ConnectorDefinition, scope: Scope) -> bool:
    """Takes a configuration parameter of a connector for an error if it is an enumeration."""
    return any(scope.find(p.type, mk.Enumeration) for p in connector.configuration_parameters)


@refuses("R-9.2.9-02")
def components_and_their_interfaces_are_not_both_annotated(module: ComponentModule, _: Scope) -> bool:
    """Takes the annotation of a component type for an error if an interface beside it has one, too."""
    interfaces = [i for c in module.contract_modules for i in c.interfaces if isinstance(i, mk.Interface)]
    return any(i.annotations for i in interfaces) and any(t.annotations for t in module.component_types)
