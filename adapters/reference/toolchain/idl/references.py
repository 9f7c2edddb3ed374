"""What a declaration of a model refers to, and so needs before it in IDL."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import Element, Named
from ucm_cts.adapters.contract.metamodel.contracts import Constant, DataType, Exception_, Interface
from ucm_cts.adapters.contract.metamodel.interactions import PortType
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, lineage
from ucm_cts.adapters.contract.metamodel.spelling import SPELLINGS, fields_towards

Reference = tuple[Declared, bool]
"""What is referred to, and whether that must be declared in full before."""

_REFERENCES = ("type", "selector_type", "exception", "actual_type", "index_type")
"""Fields that refer to data types, interfaces and exceptions."""

_BASES = ("interface", "refines")
"""Fields that refer to what is inherited."""

_KINDS = (DataType, Interface, Exception_, mc.ComponentType)
_BASE_KINDS = (Interface, mc.ComponentType)

_REFERRING = tuple(cls for cls in SPELLINGS if not {*_REFERENCES, *_BASES}.isdisjoint(cls.__struct_fields__))


def references(element: Named, scope: Scope) -> list[Reference]:
    """What ``element`` refers to, each once, in the order of the first reference to it."""
    found: dict[tuple[int, bool], Reference] = {}
    for one in _references(element, scope):
        found.setdefault((id(one[0].element), one[1]), one)
    return list(found.values())


def _references(element: Named, scope: Scope) -> Iterator[Reference]:
    for reference, is_base in _written(element):
        declared = scope.find_one_of(reference, _BASE_KINDS if is_base else _KINDS)
        if declared is not None:
            yield declared, is_base or not isinstance(declared.element, Interface)
    if isinstance(element, Constant):
        yield from _constants(element.value, scope)
    if isinstance(element, mc.ComponentType):
        specs = (spec.type for port in element.ports for spec in port.specs if isinstance(spec, mc.PortTypeSpec))
        yield from _elements(scope.find(type_, PortType) for type_ in dict.fromkeys(specs))
    if isinstance(element, mc.ComponentTechnicalPolicy):
        definition = scope.find(element.technical_policy_definition, TechnicalPolicyDefinition)
        yield from _elements(lineage(definition) if definition is not None else [])


class _Plan(NamedTuple):
    """Where elements of one class have references: in their fields, and in the elements that further fields hold."""

    references: tuple[str, ...]
    bases: tuple[str, ...]
    deeper: tuple[str, ...]


@functools.cache
def _plan(cls: type[Element]) -> _Plan:
    own = cls.__struct_fields__
    return _Plan(
        tuple(field for field in _REFERENCES if field in own),
        tuple(field for field in _BASES if field in own),
        fields_towards(cls, _REFERRING),
    )


def _written(element: Element) -> dict[tuple[str, bool], None]:
    """The references in ``element`` and in what it holds, each once in their order, and whether they name what is inherited."""
    found: dict[tuple[str, bool], None] = {}
    waiting = [element]
    while waiting:
        part = waiting.pop()
        plan = _plan(type(part))
        for field in plan.references:
            reference = getattr(part, field)
            if reference:
                found[reference, False] = None
        bases = (getattr(part, field) for field in plan.bases)
        base = next(filter(None, bases), None) if plan.bases else None
        if base is not None:
            found[base, True] = None
        for field in reversed(plan.deeper):
            waiting.extend(reversed(getattr(part, field)))
    return found


def _constants(value: str, scope: Scope) -> Iterator[Reference]:
    words = "".join(c if c.isalnum() or c in "_:" else " " for c in value).split()
    for word in words:
        found = scope.find(word, Constant)
        if found is not None:
            yield found, True


def _elements(owners: Iterable[Declared | None]) -> Iterator[Reference]:
    """The interfaces of port elements, which getters return."""
    for owner in owners:
        if owner is not None and isinstance(owner.element, (PortType, TechnicalPolicyDefinition)):
            for one in owner.element.port_elements:
                found = owner.scope.find(one.interface, Interface)
                if found is not None:
                    yield found, False
