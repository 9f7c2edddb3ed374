"""Interfaces and their members as abstract classes (13.5, 13.6)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ucm_cts.adapters.contract.metamodel import contracts
from ucm_cts.adapters.contract.metamodel.common import Named as NamedElement
from ucm_cts.adapters.contract.metamodel.names import Declared
from ucm_cts.reference_models.mapping.cpp import claims
from ucm_cts.reference_models.mapping.cpp.classes import Abstract, Class, Forms, Method, Named, Parameter, Sample
from ucm_cts.reference_models.mapping.cpp.context import (
    ABSTRACT,
    DATA,
    INTERFACES,
    LARGE,
    OBSERVED,
    Context,
    actual,
    expect,
    footprint,
    plain,
    spelled,
)
from ucm_cts.reference_models.mapping.cpp.data_types import is_abstract
from ucm_cts.reference_models.mapping.cpp.expected import Expected

Bindings = tuple[tuple[str, Declared], ...]
"""Paths of abstract types, and what stands for each."""

PRIMITIVES = (
    contracts.PrimitiveInteger,
    contracts.PrimitiveFloat,
    contracts.PrimitiveChar,
    contracts.PrimitiveBoolean,
)
_EVERYTHING = 1000


class Unsayable(Exception):
    """The text does not say how this is spelled in C++."""


def interface_class(interface: Declared) -> str:
    """The abstract class of an interface that needs no bindings."""
    return spelled(interface, "Abstract_")


def bound(reference: str, declared: Declared, bindings: Bindings) -> Declared:
    """The data type or interface that ``reference`` means where ``declared`` stands. Raises ``Unsayable``."""
    found = declared.scope.find(reference, *DATA, *INTERFACES)
    if found is not None and isinstance(found.element, ABSTRACT):
        found = next((actual for path, actual in bindings if path == found.path), None)
    if found is None or isinstance(found.element, ABSTRACT):
        raise Unsayable(reference)
    return found


def ancestry(interface: Declared) -> list[Declared]:
    """``interface`` and all that it inherits from, each once, ancestors first."""
    found: dict[str, Declared] = {}
    waiting = [interface]
    while waiting and len(found) < _EVERYTHING:
        current = waiting.pop()
        found.pop(current.path, None)
        found[current.path] = current
        waiting.extend(bases(current))
    return list(reversed(found.values()))


def bases(interface: Declared) -> list[Declared]:
    """The interfaces that ``interface`` names as inherited."""
    assert isinstance(interface.element, contracts.Interface)
    named = (interface.scope.find(i.interface, contracts.Interface) for i in interface.element.inherited_interfaces)
    return [base for base in named if base is not None and base.path != interface.path]


def single_line(interface: Declared) -> list[Declared]:
    """``interface`` and what it inherits from, up to one that inherits from several: their functions may be ambiguous."""
    found = [interface]
    while len(inherited := bases(found[-1])) == 1 and len(found) < _EVERYTHING:
        found.append(inherited[0])
    return found


def depends_on_bindings(interface: Declared) -> bool:
    """Whether there is an abstract type in the signatures of ``interface`` or of what it inherits."""
    for each in ancestry(interface):
        assert isinstance(each.element, contracts.Interface)
        methods = (p.type for m in each.element.methods for p in m.parameters)
        for reference in (*(a.type for a in each.element.attributes), *methods):
            found = each.scope.find(reference, *DATA, *INTERFACES)
            if found is not None and (isinstance(found.element, ABSTRACT) or _is_abstract(found)):
                return True
    return False


def _is_abstract(found: Declared) -> bool:
    return not isinstance(found.element, contracts.Interface) and is_abstract(found)


class Members:
    """The functions that attributes and methods become."""

    def __init__(self, context: Context) -> None:
        self._context = context

    def value(self, found: Declared) -> Sample:
        """Values of a data type, or references to an interface."""
        if isinstance(found.element, contracts.Interface):
            if depends_on_bindings(found) or not self._context.is_sayable(found.path):
                raise Unsayable(found.path)
            type_ = self._context.reference(interface_class(found))
            return Sample(type_, f"{type_}()", f"{type_}()", False)
        if not self._context.is_sayable(found.path) or is_abstract(found) or footprint(found) > LARGE:
            raise Unsayable(found.path)
        return self._context.sample(found)

    def given(self, found: Declared) -> tuple[str, ...]:
        """How an IN parameter is passed."""
        type_ = self.value(found).type
        constant = f"const {type_}&"
        if isinstance(found.element, contracts.Interface):
            match self._context.reading("cpp-interface-parameters"):
                case "value":
                    return (type_,)
                case "const-reference":
                    return (constant,)
            return (type_, constant)
        if isinstance(found.element, PRIMITIVES):
            return (type_,)
        if isinstance(actual(found).element, (*PRIMITIVES, contracts.Enumeration)):
            return (type_, constant)
        return (constant,)

    def accessor(self, attribute: contracts.Attribute, declared: Declared, bindings: Bindings) -> Method:
        """Returns the attribute's value."""
        self._say(attribute)
        value = self.value(bound(attribute.type, declared, bindings))
        reading = self._context.reading("cpp-accessors")
        constant = (False, True) if reading == OBSERVED else (reading == "const",)
        return Method(plain(attribute.name), value, (), constant)

    def mutator(self, attribute: contracts.Attribute, declared: Declared, bindings: Bindings) -> Method | None:
        """Sets the attribute; 13.5 does not say how the value is passed. None if it is read-only."""
        self._say(attribute)
        if attribute.mode == "READ":
            return None
        sample = self.value(bound(attribute.type, declared, bindings))
        taken = Parameter((sample.type, f"const {sample.type}&"), sample, False)
        return Method(plain(attribute.name), None, (taken,))

    def method(self, method: contracts.Method, declared: Declared, bindings: Bindings) -> Method:
        """The function of a method."""
        self._say(method)
        result: Sample | None = None
        parameters: list[Parameter] = []
        for parameter in method.parameters:
            found = bound(parameter.type, declared, bindings)
            sample = self.value(found)
            if parameter.direction == "RETURN":
                result = sample
            elif parameter.direction == "IN":
                parameters.append(Parameter(self.given(found), sample, False))
            else:
                parameters.append(Parameter((f"{sample.type}&",), sample, True))
        return Method(plain(method.name), result, tuple(parameters))

    def _say(self, member: NamedElement) -> None:
        if not self._context.is_sayable(member.name):
            raise Unsayable(member.name)

    def of_attributes(
        self, attributes: Sequence[contracts.Attribute], declared: Declared, bindings: Bindings
    ) -> Iterator[Method]:
        """All functions of ``attributes``, which stand where ``declared`` does."""
        for attribute in attributes:
            yield self.accessor(attribute, declared, bindings)
            mutator = self.mutator(attribute, declared, bindings)
            if mutator is not None:
                yield mutator

    def of_interface(self, interface: Declared, bindings: Bindings) -> tuple[Method, ...]:
        """All functions of ``interface``, those that it inherits included. Raises ``Unsayable``."""
        found: list[Method] = []
        for each in ancestry(interface):
            assert isinstance(each.element, contracts.Interface)
            found += self.of_attributes(each.element.attributes, each, bindings)
            found += (self.method(m, each, bindings) for m in each.element.methods)
        return tuple(dict.fromkeys(found))


class Interfaces:
    """What the interfaces of a model are implemented by, and what is expected of their classes."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self.members = Members(context)
        self.abstract: dict[tuple[str, tuple[Method, ...]], Abstract] = {}
        self._keys: dict[tuple[str, ...], str] = {}

    def key(self, interface: Declared, bindings: Bindings) -> str:
        """The key of what implements ``interface``. Raises ``Unsayable``."""
        bound_to = (actual.path for _, actual in bindings) if depends_on_bindings(interface) else ()
        use = (interface.path, *bound_to)
        if use not in self._keys:
            self._keys[use] = self._found_key(interface, bindings)
        return self._keys[use]

    def _found_key(self, interface: Declared, bindings: Bindings) -> str:
        methods = self.members.of_interface(interface, bindings)
        at = (interface.path, methods)  # ports that bind alike what it uses have one class, whatever else they bind
        if at not in self.abstract:
            element = interface.element
            assert isinstance(element, contracts.Interface)
            own = len(list(self.members.of_attributes(element.attributes, interface, bindings))) + len(element.methods)
            key = f"interface_{len(self.abstract)}"
            self.abstract[at] = Abstract(key, methods, inherited=max(0, len(methods) - own))
        return self.abstract[at].key

    def expected(self) -> Iterator[Expected]:
        """What is expected of all interfaces that need no bindings."""
        for declared in self._context.declared:
            if isinstance(declared.element, contracts.Interface) and self._context.is_sayable(declared.path):
                try:
                    if not depends_on_bindings(declared):
                        yield from list(self._interface(declared))
                except Unsayable:
                    continue

    def _interface(self, declared: Declared) -> Iterator[Expected]:
        key = self.key(declared, ())
        owner = Named(interface_class(declared))
        methods = self.members.of_interface(declared, ())
        assert isinstance(declared.element, contracts.Interface)
        yield expect("R-13.6-02", declared, claims.Declares(owner.name))
        yield expect("R-13.3-02", declared, claims.Declares(owner.name))
        if methods:
            yield expect("R-13.6-01", declared, claims.IsAbstract(owner))
        for base in bases(declared):
            if self._context.is_sayable(base.path):
                yield expect("R-13.6-05", declared, claims.Derives(owner, interface_class(base)))
        yield expect("R-13-03", declared, claims.NotCorba(owner))
        yield expect("R-13.6-04", declared, claims.NothingElse(owner, tuple(m.name for m in methods)))
        yield expect("R-13.6-03", declared, claims.Implemented(owner, key))
        for attribute in declared.element.attributes:
            yield from self._attribute(attribute, declared, owner, key)
        for method in declared.element.methods:
            yield from self.method_expected(method, declared, owner, key, ())

    def _attribute(
        self, attribute: contracts.Attribute, declared: Declared, owner: Class, key: str
    ) -> Iterator[Expected]:
        names = ("R-13.5-02", "R-13.5-03", "R-13.5-04", "R-13.5-05")
        for requirement, claim in self.attribute_claims(attribute, declared, owner, key, names):
            yield expect(requirement, declared, claim, attribute)

    def attribute_claims(
        self,
        attribute: contracts.Attribute,
        declared: Declared,
        owner: Class,
        key: str,
        requirements: tuple[str, str, str, str],
    ) -> Iterator[tuple[str, claims.Claim]]:
        """What is claimed of an attribute's functions; ``requirements`` are those of its accessor, its mutator, of both being
        pure virtual, and of the mutator not being there.
        """
        reading, writing, pure, read_only = requirements
        accessor = self.members.accessor(attribute, declared, ())
        mutator = self.members.mutator(attribute, declared, ())
        assert accessor.result is not None
        type_ = accessor.result.type
        read = Forms((type_,), ((),), accessor.constant)
        yield reading, claims.Arity(owner, accessor.name, 0, read)
        yield reading, claims.Passed(owner, accessor.name, 0, 0, (type_,), read)
        yield pure, claims.Pure(owner, key, accessor.name, 0)
        if mutator is None:
            yield read_only, claims.NoMutator(owner, accessor.name, type_)
            return
        written = Forms(("void",), tuple(mutator.signatures()))
        yield writing, claims.Arity(owner, accessor.name, 1, written)
        yield writing, claims.Passed(owner, accessor.name, 1, 1, mutator.parameters[0].types, written)
        yield pure, claims.Pure(owner, key, accessor.name, 1)

    def method_expected(
        self, method: contracts.Method, declared: Declared, owner: Class, key: str, bindings: Bindings
    ) -> Iterator[Expected]:
        """What is expected of the function of ``method``, which stands where ``declared`` does. Raises ``Unsayable``."""
        found = self.members.method(method, declared, bindings)
        count = len(found.parameters)
        forms = Forms((found.result.type if found.result is not None else "void",), tuple(found.signatures()))
        yield expect("R-13.6.1-01", declared, claims.Pure(owner, key, found.name, count), method)
        yield expect("R-13.6.1-02", declared, claims.Arity(owner, found.name, count, forms), method)
        position = 0
        for parameter in method.parameters:
            if parameter.direction != "RETURN":
                position += 1
                type_ = bound(parameter.type, declared, bindings)
                taken = found.parameters[position - 1]
                claim = claims.Passed(owner, found.name, count, position, taken.types, forms)
                yield expect(_requirement(type_, parameter.direction), declared, claim, parameter)
                yield from self._reference(type_, declared, claim, parameter)
        returned = next((p for p in method.parameters if p.direction == "RETURN"), None)
        claim = claims.Passed(owner, found.name, count, 0, forms.results, forms)
        if returned is None:
            yield expect("R-13.6.1-06", declared, claim, method)
        else:
            type_ = bound(returned.type, declared, bindings)
            yield expect(_requirement(type_, "RETURN"), declared, claim, returned)
            yield from self._reference(type_, declared, claim, returned)

    def _reference(
        self, type_: Declared, declared: Declared, claim: claims.Passed, parameter: contracts.Parameter
    ) -> Iterator[Expected]:
        """That a reference to an interface is a shared pointer, however that is passed."""
        if not isinstance(type_.element, contracts.Interface):
            return
        reference = self._context.reference(interface_class(type_))
        types = (reference, f"const {reference}&", f"{reference}&")
        somehow = claims.Passed(claim.owner, claim.method, claim.parameters, claim.position, types, claim.forms)
        yield expect("R-13.6.2-01" if self._context.modern else "R-13.10.3-01", declared, somehow, parameter)
        if not self._context.modern:
            yield expect("R-13.10.3-02", declared, claims.Works("shared_ptr", (interface_class(type_),)), parameter)


def _requirement(type_: Declared, direction: str) -> str:
    of_interface = isinstance(type_.element, contracts.Interface)
    if direction == "RETURN":
        return "R-13.6.2-04" if of_interface else "R-13.6.1-06"
    if direction != "IN":
        return "R-13.6.2-03" if of_interface else "R-13.6.1-03"
    if of_interface:
        return "R-13.6.2-02"
    return "R-13.6.1-04" if isinstance(type_.element, PRIMITIVES) else "R-13.6.1-05"
