"""Rules of 9.2.7 and 9.2.8: interfaces, methods, exceptions and abstract types."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import get_args

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope
from ucm_cts.adapters.reference.toolchain.checking import TYPE, Complaint, rule
from ucm_cts.adapters.reference.toolchain.rules.circles import circle, circle_complaint
from ucm_cts.adapters.reference.toolchain.rules.contracts.actual_types import TypedInContracts

_DATA_TYPES = (c.DataType, c.AbstractDataType)
_EXCEPTIONS = (c.Exception_,)


@rule("R-9.2.7-11", c.Method)
def at_most_one_return_value(method: c.Method, _scope: Scope) -> Iterable[Complaint]:
    """A method returns one thing."""
    returned = [p for p in method.parameters if p.direction == "RETURN"]
    return [
        (
            parameter,
            f"parameter {parameter.name} is a second RETURN of method {method.name}; give it another direction",
        )
        for parameter in returned[1:]
    ]


@rule("R-9.2.7.1-02", c.Interface)
def inherits_from_interfaces(interface: c.Interface, scope: Scope) -> Iterator[Complaint]:
    """What is inherited is an interface that is there."""
    for inherited in interface.inherited_interfaces:
        if scope.find(inherited.interface, c.Interface, c.AbstractInterface) is None:
            yield (
                inherited,
                f"interface {interface.name} inherits from '{inherited.interface}', which is no interface; declare it",
            )


@rule("R-9.2.7.1-05", Model)
def interfaces_do_not_inherit_from_themselves(model: Model, root: Scope) -> Iterator[Complaint]:
    """Inheriting comes to an end."""
    yield from circle_complaint(
        circle(root, [c.Interface], parents), "inherits from", "interface ", "let it inherit from others only"
    )


def parents(declared: Declared) -> Iterator[Declared]:
    """The interfaces that an interface names as its ancestors, as far as they are there."""
    if isinstance(declared.element, c.Interface):
        for inherited in declared.element.inherited_interfaces:
            found = declared.scope.find(inherited.interface, c.Interface)
            if found is not None:
                yield found


def ancestors(declared: Declared) -> Iterator[Declared]:
    """All interfaces that an interface inherits from, directly or not, each once, without itself."""
    seen = {id(declared.element)}
    waiting = [declared]
    while waiting:
        for parent in parents(waiting.pop()):
            if id(parent.element) not in seen:
                seen.add(id(parent.element))
                waiting.append(parent)
                yield parent


@rule("R-9.2.7.1-04", c.Interface, under="inherited-names=refused")
def inherited_names_differ(interface: c.Interface, scope: Scope) -> Iterator[Complaint]:
    """One name does not stand for two things of an interface and its ancestors."""
    if not interface.inherited_interfaces:
        return
    known = {member.name: interface.name for member in _members(interface)}
    for ancestor in ancestors(Declared(interface, scope)):
        assert isinstance(ancestor.element, c.Interface)
        for member in _members(ancestor.element):
            other = known.setdefault(member.name, ancestor.element.name)
            if other != ancestor.element.name:
                yield (
                    interface,
                    f"interface {interface.name} has {member.name} from {other} and from {ancestor.element.name}; "
                    "rename one of them",
                )


def _members(interface: c.Interface) -> Iterator[c.Method | c.Attribute]:
    yield from interface.methods
    yield from interface.attributes


@rule("R-9.2.7.2-02", c.Interface)
def methods_are_not_repeated(interface: c.Interface, _scope: Scope) -> Iterator[Complaint]:
    """Two methods differ in their names or in their parameters."""
    if _names_differ(interface):
        return
    seen: set[tuple[object, ...]] = set()
    for method in interface.methods:
        signature = _signature(method)
        if signature in seen:
            yield method, f"interface {interface.name} has method {method.name} twice; take one of them out"
        seen.add(signature)


@rule("R-9.2.7.2-02", c.Interface, under="method-overloading=refused")
def methods_differ_in_name(interface: c.Interface, _scope: Scope) -> Iterator[Complaint]:
    """No mapping to IDL can tell two methods of one name apart."""
    if _names_differ(interface):
        return
    seen: dict[str, tuple[object, ...]] = {}
    for method in interface.methods:
        signature = _signature(method)
        if seen.setdefault(method.name, signature) != signature:
            yield method, f"interface {interface.name} has several methods {method.name}; give them names of their own"


def _names_differ(interface: c.Interface) -> bool:
    """Whether no two methods have the same name, so that their parameters do not matter."""
    return len({method.name for method in interface.methods}) == len(interface.methods)


def _signature(method: c.Method) -> tuple[object, ...]:
    return (method.name, *((p.name, p.direction, p.type) for p in method.parameters))


@rule("R-9.2.7.2-03", c.Method)
def raises_exceptions(method: c.Method, scope: Scope) -> Iterable[Complaint]:
    """What a method raises is an exception that is there."""
    return [
        (raised, f"method {method.name} raises '{raised.exception}', which is no exception; declare it")
        for raised in method.raised_exceptions
        if scope.find_one_of(raised.exception, _EXCEPTIONS) is None
    ]


@rule("R-9.2.8-03", *get_args(TypedInContracts), under="abstract-types-elsewhere=refused", judged_by=TYPE)
def abstract_types_serve_interfaces_only(typed: TypedInContracts, scope: Scope) -> Iterable[Complaint]:
    """Nothing would ever bind an abstract type inside another type or a constant."""
    found = scope.find_one_of(typed.type, _DATA_TYPES)
    if found is None or not isinstance(found.element, c.AbstractDataType):
        return ()
    return [(typed, f"{typed.name} is of the abstract type {typed.type}; give it an actual one")]
