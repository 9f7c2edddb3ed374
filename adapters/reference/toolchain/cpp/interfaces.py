"""Interfaces as abstract classes (13.5, 13.6, 13.8), those with abstract types once for each binding of these."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Sequence

from ucm_cts.adapters.contract.metamodel import contracts
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope
from ucm_cts.adapters.reference.toolchain.cpp.names import identifier, instance, namespace, qualified
from ucm_cts.adapters.reference.toolchain.cpp.types import ABSTRACT, DATA, INTERFACES, Standard, find, is_by_value
from ucm_cts.adapters.reference.toolchain.reaching import Reaching

Bindings = tuple[tuple[str, Declared], ...]
"""The paths of abstract types and what stands for each, in the order of the model."""

PREFIX = "Abstract_"


def resolve(reference: str, scope: Scope, bindings: Bindings) -> Declared:
    """The data type or interface that ``reference`` means under ``bindings``."""
    found = find(reference, scope, *DATA, *INTERFACES)
    if isinstance(found.element, ABSTRACT):
        return next((actual for path, actual in bindings if path == found.path), found)
    return found


def base_interfaces(interface: Declared) -> list[Declared]:
    """The interfaces that ``interface`` inherits directly."""
    assert isinstance(interface.element, contracts.Interface)
    return [find(i.interface, interface.scope, contracts.Interface) for i in interface.element.inherited_interfaces]


def family(interface: Declared) -> list[Declared]:
    """``interface`` after all that it inherits, each once."""
    found: list[Declared] = []
    for base in base_interfaces(interface):
        known = {one.path for one in found}
        found += [one for one in family(base) if one.path not in known]
    return [*found, interface]


def mentioned(interface: contracts.Interface) -> list[str]:
    """The references to types in the signatures of ``interface``."""
    parameters = [p.type for m in interface.methods for p in m.parameters]
    return [*(a.type for a in interface.attributes), *parameters]


def _used(interface: Declared) -> Iterator[Declared]:
    """What ``interface`` inherits, and what its own signatures name."""
    if isinstance(interface.element, contracts.Interface):
        yield from base_interfaces(interface)
        for reference in dict.fromkeys(mentioned(interface.element)):
            yield find(reference, interface.scope, *DATA, *INTERFACES)


def _abstract_path(declared: Declared) -> str:
    return declared.path if isinstance(declared.element, ABSTRACT) else ""


def _abstract_in(interface: Declared) -> frozenset[str]:
    """The paths of the abstract types that ``interface`` uses, in its own signatures and in those of what it inherits and uses."""
    reaching = interface.scope.root.remembered(
        "abstract types in interfaces", functools.partial(Reaching, _used, _abstract_path)
    )
    return reaching.marks(interface)


def needed(interface: Declared, bindings: Bindings) -> Bindings:
    """Those of ``bindings`` that ``interface`` depends on."""
    if not bindings:
        return ()
    used = _abstract_in(interface)
    return tuple((path, actual) for path, actual in bindings if path in used)


def is_complete(interface: Declared, bindings: Bindings) -> bool:
    """Whether ``bindings`` leave no abstract type in ``interface``."""
    if isinstance(interface.element, contracts.AbstractInterface):
        return False
    return _abstract_in(interface) <= {path for path, _ in bindings}


def class_name(interface: Declared, bindings: Bindings) -> str:
    """The abstract class of ``interface`` under ``bindings``, without what is around it."""
    bound = "".join("_" + "_".join(namespace(actual.path)) for _, actual in needed(interface, bindings))
    return f"{PREFIX}{identifier(interface.element.name)}{bound}"


def qualified_class(interface: Declared, bindings: Bindings) -> str:
    """The abstract class of ``interface`` under ``bindings``, from the root."""
    return "".join(f"::{part}" for part in (*namespace(interface.scope.path), class_name(interface, bindings)))


def reference_to(interface: Declared, bindings: Bindings, standard: Standard) -> str:
    """What refers to an ``interface`` (13.6.2)."""
    return instance(standard.shared_ptr, qualified_class(interface, bindings))


def value_type(found: Declared, bindings: Bindings, standard: Standard) -> str:
    """What results of the type are returned as."""
    if isinstance(found.element, contracts.Interface):
        return reference_to(found, bindings, standard)
    return qualified(found)


def passed(found: Declared, direction: str, bindings: Bindings, standard: Standard) -> str:
    """How a parameter is passed (13.6.1, 13.6.2)."""
    type_ = value_type(found, bindings, standard)
    if direction != "IN":
        return f"{type_}&"
    plain = isinstance(found.element, contracts.Interface) or is_by_value(found)
    return type_ if plain else f"const {type_}&"


def accessors(
    attributes: Sequence[contracts.Attribute], scope: Scope, bindings: Bindings, standard: Standard
) -> Iterator[str]:
    """The functions of attributes (13.5)."""
    for attribute in attributes:
        found, name = resolve(attribute.type, scope, bindings), identifier(attribute.name)
        yield f"    virtual {value_type(found, bindings, standard)} {name}() = 0;"
        if attribute.mode != "READ":
            yield f"    virtual void {name}({passed(found, 'IN', bindings, standard)} value) = 0;"


def _operation(method: contracts.Method, scope: Scope, bindings: Bindings, standard: Standard) -> str:
    result, taken = "void", []
    for parameter in method.parameters:
        found = resolve(parameter.type, scope, bindings)
        if parameter.direction == "RETURN":
            result = value_type(found, bindings, standard)
        else:
            spelled = passed(found, parameter.direction, bindings, standard)
            taken.append(f"{spelled} {identifier(parameter.name)}")
    return f"    virtual {result} {identifier(method.name)}({', '.join(taken)}) = 0;"


def interface_definition(interface: Declared, bindings: Bindings, of_port_element: bool, standard: Standard) -> str:
    """The abstract class of ``interface`` inside its namespace; ``of_port_element`` if a port element has it."""
    element, scope = interface.element, interface.scope
    assert isinstance(element, contracts.Interface)
    name = class_name(interface, bindings)
    bases = [qualified_class(base, bindings) for base in base_interfaces(interface)]
    bases += ["::ucm::PortElementObject"] * of_port_element
    inherited = " : " + ", ".join(f"public virtual {base}" for base in bases) if bases else ""
    lines = [f"class {name}{inherited} {{", "  public:", f"    virtual ~{name}() {{}}"]
    lines += accessors(element.attributes, scope, bindings, standard)
    lines += [_operation(method, scope, bindings, standard) for method in element.methods]
    return "\n".join([*lines, "};"]) + "\n"
