"""Rules about what refers to types: there is one, it is declared, and it is of the right sort (9.2.1, 9.2.2, 9.2.4.1)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from operator import attrgetter
from typing import get_args

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.common import Named
from ucm_cts.adapters.contract.metamodel.interactions import ItemBinding
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.reference.toolchain.checking import TYPE, Complaint, rule
from ucm_cts.adapters.reference.toolchain.rules.contracts.actual_types import DATA_TYPES, TypedInContracts, actual_type

Typed = TypedInContracts | c.ExceptionField | c.ConfigurationParameter
TYPED = get_args(Typed)
"""What refers to a data type (9.2.2.4)."""

OF_ONE_CLASS = ("R-9.2.4.2-01", "R-9.2.4.4-01", "R-9.2.4.6-01", "R-9.2.4.9-01", "R-9.2.5.4-01")
"""Requirements that say of one class of ``TYPED`` what 9.2.2.4 says of all."""

_INDEX = attrgetter("index_type")
_INTERFACES = (c.Interface, c.AbstractInterface)
_TYPES = (*DATA_TYPES, *_INTERFACES)


@rule("R-9.2.2.4-02", *TYPED, also=("R-9.1.4.4-05", "R-9.2.4.3-04"), judged_by=TYPE)
def data_types_are_named(typed: Typed, _scope: Scope) -> Iterable[Complaint]:
    """A reference is more than nothing."""
    return [(typed, f"{typed.name} has an empty type; name a data type")] if not typed.type else ()


@rule(
    "R-9.2.2.4-03",
    *TYPED,
    also=("R-9.1.4.4-05", "R-9.2.1-07", "R-9.2.6.1-01", *OF_ONE_CLASS),
    judged_by=TYPE,
)
def data_types_exist(typed: Typed, scope: Scope) -> Iterable[Complaint]:
    """What is named as a type is declared."""
    if not typed.type or _is_data_type(typed, scope) or _means(typed.type, scope):
        return ()
    return [(typed, f"{typed.name} has the type '{typed.type}', which is not declared; declare it")]


@rule("R-9.2.2.4-04", *TYPED, also=OF_ONE_CLASS, judged_by=TYPE)
def interfaces_are_no_data_types(typed: Typed, scope: Scope) -> Iterable[Complaint]:
    """Where a data type is asked for an interface will not do."""
    if _is_data_type(typed, scope) or scope.find(typed.type, *_INTERFACES) is None:
        return ()
    return [(typed, f"{typed.name} has the type {typed.type}, which is an interface; name a data type")]


@rule("R-9.2.1-07", *TYPED, judged_by=TYPE)
def other_declarations_are_no_types(typed: Typed, scope: Scope) -> Iterable[Complaint]:
    """Only data types and interfaces are types."""
    if _is_data_type(typed, scope) or scope.find(typed.type, *_INTERFACES) is not None:
        return ()
    if not _means(typed.type, scope):
        return ()
    return [(typed, f"{typed.name} has the type {typed.type}, which is no type at all; name a data type")]


@rule("R-9.2.1-08", ItemBinding)
def items_are_bound_to_no_constants(binding: ItemBinding, scope: Scope) -> Iterator[Complaint]:
    """Neither constants nor exceptions can be carried."""
    if scope.find(binding.connector_item, *DATA_TYPES, *_INTERFACES) is not None:
        return
    if scope.find(binding.connector_item, c.Constant, c.Exception_) is not None:
        yield binding, f"{binding.connector_item} is no type, so no interaction can carry it; bind the item to a type"


@rule("R-9.2.2.5-01", c.Parameter, c.Attribute, judged_by=TYPE)
def types_exist(typed: c.Parameter | c.Attribute, scope: Scope) -> Iterable[Complaint]:
    """What is named as a type is declared."""
    if _is_type(typed, scope) or _means(typed.type, scope):
        return ()
    return [(typed, f"{typed.name} has the type '{typed.type}', which is not declared; declare it")]


@rule("R-9.2.2.5-02", c.Parameter, c.Attribute, judged_by=TYPE)
def types_are_types(typed: c.Parameter | c.Attribute, scope: Scope) -> Iterable[Complaint]:
    """A parameter's type is a data type or an interface."""
    if _is_type(typed, scope) or not _means(typed.type, scope):
        return ()
    return [(typed, f"{typed.name} has the type {typed.type}, which is no type at all; name one")]


@rule("R-9.2.4.1-02", c.Enumeration, c.ArrayDimension, c.Sequence, also=("R-9.2.4.7-03",), judged_by=_INDEX)
def index_types_exist(indexed: c.Enumeration | c.ArrayDimension | c.Sequence, scope: Scope) -> Iterator[Complaint]:
    """An index type is a kind of integer, or the name of a declared integer type."""
    if indexed.index_type not in c.INTEGER_RANGES and not _means(indexed.index_type, scope):
        known = ", ".join(c.INTEGER_RANGES)
        yield indexed, f"the index type '{indexed.index_type}' is no integer; name one of {known}"


@rule("R-9.2.4.1-03", c.Enumeration, c.ArrayDimension, c.Sequence, also=("R-9.2.4.7-03",), judged_by=_INDEX)
def named_index_types_are_integers(
    indexed: c.Enumeration | c.ArrayDimension | c.Sequence, scope: Scope
) -> Iterator[Complaint]:
    """Where a declaration is named as an index type it is an integer type."""
    if index_kind(indexed.index_type, scope) is None and _means(indexed.index_type, scope):
        yield indexed, f"the index type {indexed.index_type} is declared, but is no integer type; name one that is"


def index_kind(index_type: str, scope: Scope) -> str | None:
    """The kind of integer that ``index_type`` is, or names; None if it is none."""
    if index_type in c.INTEGER_RANGES:
        return index_type
    found = actual_type(index_type, scope)
    return found.element.kind if found is not None and isinstance(found.element, c.PrimitiveInteger) else None


def _is_data_type(typed: Typed, scope: Scope) -> bool:
    return scope.find_one_of(typed.type, DATA_TYPES) is not None


def _is_type(typed: c.Parameter | c.Attribute, scope: Scope) -> bool:
    return scope.find_one_of(typed.type, _TYPES) is not None


def _means(reference: str, scope: Scope) -> bool:
    return bool(reference) and scope.find(reference, Named) is not None
