"""What 12.6 makes of interfaces and exceptions, and what the operations of an interface are once abstract types are bound."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope
from ucm_cts.reference_models.mapping.idl import expectations as exp
from ucm_cts.reference_models.mapping.idl.declarations import Basic, Type
from ucm_cts.reference_models.mapping.idl.subjects import DATA_TYPES, TYPES, Bound, Subject, named, path_of, type_named

VOID = Basic("void")

UNKNOWN = Basic("")
"""The model does not say which type; any will do."""

DIRECTIONS = {"IN": "in", "OUT": "out", "INOUT": "inout"}


def exception_facts(subject: Subject) -> Iterator[exp.Expected]:
    """All that is expected of an exception."""
    exception = subject.element
    assert isinstance(exception, c.Exception_)
    yield exp.Declares(**subject.about("R-12.6-01"), kind="exception")
    yield exp.Lists(**subject.about("R-12.6-02"), names=tuple(field.name for field in exception.fields))
    for field in exception.fields:
        type_ = type_named(field.type, subject.scope, DATA_TYPES)
        if type_ is not None:
            yield exp.Means(**subject.about("R-12.6-02", field), type=type_)


def interface_facts(subject: Subject) -> Iterator[exp.Expected]:
    """All that is expected of an interface, except what being one of a port element adds."""
    interface = subject.element
    assert isinstance(interface, c.Interface)
    yield exp.Declares(**subject.about("R-12.6-03"), kind="interface")
    for inherited in interface.inherited_interfaces:
        base = subject.scope.find(inherited.interface, c.Interface)
        if base is not None:
            yield exp.Inherits(**subject.about("R-12.6-09"), base=path_of(base))
    for method in interface.methods:
        yield from _method(subject, method)
    yield exp.Only(
        **subject.about("R-12.6-04"),
        kind="operation",
        names=tuple(method.name for method in interface.methods),
        tolerated=tuple(
            attribute.name for attribute in interface.attributes
        ),  # they stand for access methods (9.2.7.1)
        ancestors=tuple(path_of(one) for one in with_ancestors(Declared(interface, subject.scope)))[1:],
    )
    for attribute in interface.attributes:
        yield from attribute_facts(subject, attribute, "R-12.6-10", needed=False)


def result_of(method: c.Method) -> c.Parameter | None:
    """The parameter that is returned, if there is one; its place among the others does not matter."""
    return next((p for p in method.parameters if p.direction == "RETURN"), None)


def arguments_of(method: c.Method) -> tuple[c.Parameter, ...]:
    """The parameters that are not returned."""
    return tuple(p for p in method.parameters if p.direction in DIRECTIONS)


def _method(subject: Subject, method: c.Method) -> Iterator[exp.Expected]:
    scope = subject.scope
    yield exp.Declares(**subject.about("R-12.6-04", method), kind="operation")
    arguments = arguments_of(method)
    taken = tuple((DIRECTIONS[p.direction], p.name) for p in arguments)
    yield exp.Takes(**subject.about("R-12.6-05", method), parameters=taken)
    for position, parameter in enumerate(arguments):
        type_ = type_named(parameter.type, scope)
        if type_ is not None:
            about = subject.about("R-12.6-06", method, parameter)
            yield exp.TakesType(**about, position=position, parameters=taken, type=type_)
    result = result_of(method)
    type_ = type_named(result.type, scope) if result is not None else VOID
    if type_ is not None:
        yield exp.Means(**subject.about("R-12.6-07", method), type=type_)
    raised = [scope.find(one.exception, c.Exception_) for one in method.raised_exceptions]
    exceptions = tuple(path_of(one) for one in raised if one is not None)
    if len(exceptions) == len(raised):
        yield exp.Raises(**subject.about("R-12.6-08", method), exceptions=exceptions)


def attribute_facts(
    subject: Subject, attribute: c.Attribute, requirement: str, needed: bool = True
) -> Iterator[exp.Expected]:
    """What is expected of an attribute; those of interfaces are not ``needed`` (interpretation idl-interface-attributes)."""
    component = requirement.startswith("R-12.8.1")
    yield exp.Declares(**subject.about(requirement, attribute), kind="attribute", needed=needed)
    type_ = type_named(attribute.type, subject.scope)
    if type_ is None:
        return
    yield exp.Means(**subject.about("R-12.8.1-03" if component else requirement, attribute), type=type_)
    readonly = attribute.mode == "READ"  # one without mode can be written (interpretation attribute-mode)
    yield exp.Access(**subject.about("R-12.8.1-04" if component else requirement, attribute), readonly=readonly)
    if attribute.default_value is not None:
        yield exp.Defaulted(**subject.about("R-12.4.1.3-03", attribute), type=type_, value=attribute.default_value)


def all_methods(interface: Declared) -> Iterator[tuple[c.Method, Scope]]:
    """The methods of an interface and of all that it inherits, each with the scope of its references."""
    for element, scope in with_ancestors(interface):
        assert isinstance(element, c.Interface)
        yield from ((method, scope) for method in element.methods)


def with_ancestors(interface: Declared) -> Iterator[Declared]:
    """An interface and all that it inherits, directly or not, each once."""
    waiting, met = [interface], set[exp.Path]()
    while waiting:
        current = waiting.pop(0)
        element, scope = current
        if path_of(current) in met or not isinstance(element, c.Interface):
            continue
        met.add(path_of(current))
        yield current
        found = (scope.find(one.interface, c.Interface) for one in element.inherited_interfaces)
        waiting.extend(one for one in found if one is not None)


def signatures(interface: Declared, bound: Bound, is_open: Callable[[Declared], bool]) -> tuple[exp.Signature, ...]:
    """The operations of ``interface``, inherited ones too, with ``bound`` types in place of abstract ones.

    A type that ``is_open`` has abstract types inside, which leaves open what it is once they are bound.
    """

    def type_of(parameter: c.Parameter, scope: Scope) -> Type:
        return _bound_type(parameter.type, scope, bound, is_open)

    def signature(method: c.Method, scope: Scope) -> exp.Signature:
        result = result_of(method)
        arguments = ((DIRECTIONS[p.direction], p.name, type_of(p, scope)) for p in arguments_of(method))
        return exp.Signature(method.name, type_of(result, scope) if result is not None else VOID, tuple(arguments))

    return tuple(signature(method, scope) for method, scope in all_methods(interface))


def bound_attributes(
    interface: Declared, bound: Bound, is_open: Callable[[Declared], bool]
) -> tuple[tuple[str, Type], ...]:
    """The attributes of ``interface``, inherited ones too, each with its type as in ``signatures``."""
    return tuple(
        (attribute.name, _bound_type(attribute.type, one.scope, bound, is_open))
        for one in with_ancestors(interface)
        if isinstance(one.element, c.Interface)
        for attribute in one.element.attributes
    )


def _bound_type(name: str, scope: Scope, bound: Bound, is_open: Callable[[Declared], bool]) -> Type:
    found = scope.find(name, *TYPES)
    if found is None or (is_open(found) and path_of(found) not in bound):
        return UNKNOWN
    return bound.get(path_of(found), named(path_of(found)))
