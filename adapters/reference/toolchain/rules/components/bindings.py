"""What stands for abstract types in port specifications and policies (9.5.3.7), and what is wrong with it."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Iterator

from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.components import AbstractTypeBinding
from ucm_cts.adapters.contract.metamodel.contracts import AbstractDataType, AbstractInterface, DataType, Interface
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope
from ucm_cts.adapters.reference.toolchain.checking import Complaint
from ucm_cts.adapters.reference.toolchain.rules.handling import handled

ABSTRACT = (AbstractDataType, AbstractInterface)
TYPES = (DataType, Interface, *ABSTRACT)

Bindings = Iterable[AbstractTypeBinding]


def no_abstract_type(bindings: Bindings, scope: Scope) -> Iterator[Complaint]:
    """Those that bind something that is not abstract."""
    for binding in bindings:
        if scope.find(binding.abstract_type, *ABSTRACT) is None:
            yield binding, f"'{binding.abstract_type}' is no abstract type; bind one that the API uses"


def no_actual_type(bindings: Bindings, scope: Scope) -> Iterator[Complaint]:
    """Those that bind to something that is no type."""
    for binding in bindings:
        if scope.find(binding.actual_type, *TYPES) is None:
            yield binding, f"'{binding.actual_type}' is no data type or interface; declare it"


def still_abstract(bindings: Bindings, scope: Scope) -> Iterator[Complaint]:
    """Those that bind to an abstract type."""
    for binding in bindings:
        actual = scope.find(binding.actual_type, *TYPES)
        if actual is not None and isinstance(actual.element, ABSTRACT):
            yield binding, f"{binding.actual_type} is abstract itself; bind {binding.abstract_type} to a concrete type"


def of_another_kind(bindings: Bindings, scope: Scope) -> Iterator[Complaint]:
    """Those that bind an interface to a data type or the other way round."""
    for binding in bindings:
        abstract, actual = scope.find(binding.abstract_type, *ABSTRACT), scope.find(binding.actual_type, *TYPES)
        if abstract is None or actual is None:
            continue
        interface = isinstance(abstract.element, AbstractInterface)
        if interface != isinstance(actual.element, Interface | AbstractInterface):
            wanted = "an interface" if interface else "a data type"
            yield (
                binding,
                f"{binding.abstract_type} stands for {wanted}, {binding.actual_type} is none; bind another one",
            )


def bound_twice(bindings: Bindings, scope: Scope) -> Iterator[Complaint]:
    """Those that bind to one type what is bound to another one."""
    seen: dict[int, Declared] = {}
    for binding in bindings:
        abstract, actual = scope.find(binding.abstract_type, *ABSTRACT), scope.find(binding.actual_type, *TYPES)
        if abstract is None or actual is None:
            continue
        if seen.setdefault(id(abstract.element), actual).element is not actual.element:
            yield (
                binding,
                f"{binding.abstract_type} is bound to {seen[id(abstract.element)].path} already; keep one of both",
            )


def not_used(bindings: Bindings, scope: Scope, apis: Iterable[Declared]) -> Iterator[Complaint]:
    """Those that bind an abstract type that ``apis`` have nothing to do with."""
    used = _abstract_types(apis)
    for binding in bindings:
        abstract = scope.find(binding.abstract_type, *ABSTRACT)
        if abstract is not None and id(abstract.element) not in used:
            yield binding, f"the API does not use {binding.abstract_type}; take the binding out"


def not_bound(owner: Element, bindings: Bindings, scope: Scope, apis: Iterable[Declared]) -> Iterator[Complaint]:
    """The ``owner`` of the bindings, once for each abstract type that ``apis`` use and nothing stands for."""
    bound = {id(found.element) for b in bindings if (found := scope.find(b.abstract_type, *ABSTRACT)) is not None}
    for identity, abstract in _abstract_types(apis).items():
        if identity not in bound:
            yield owner, f"the API uses {abstract.path}, and nothing stands for it; add an AbstractTypeBinding"


def _abstract_types(apis: Iterable[Declared]) -> dict[int, Declared]:
    found: dict[int, Declared] = {}
    for api in apis:
        found |= api.scope.remembered(("abstract types", id(api.element)), functools.partial(_abstract_types_of, api))
    return found


def _abstract_types_of(api: Declared) -> dict[int, Declared]:
    return {id(one.element): one for one in handled(api) if isinstance(one.element, ABSTRACT)}
