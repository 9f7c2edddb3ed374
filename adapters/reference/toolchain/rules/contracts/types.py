"""Rules about complex and resizable types: what they must contain, how large they are, and that they come to an end (9.2.4, 9.2.5)."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.common import Named
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope
from ucm_cts.adapters.reference.toolchain.checking import Complaint, FindComplaints, rule
from ucm_cts.adapters.reference.toolchain.rules.circles import circle, circle_complaint
from ucm_cts.adapters.reference.toolchain.rules.contracts.actual_types import DATA_TYPES, actual_type
from ucm_cts.adapters.reference.toolchain.rules.contracts.references import index_kind

_HAVE_ONE: tuple[tuple[str, str, type[Named], str, str], ...] = (
    ("structures_have_fields", "R-9.2.4.3-02", c.Structure, "fields", "field"),
    ("unions_have_cases", "R-9.2.4.5-02", c.Union, "cases", "case"),
    ("enumerations_have_enumerators", "R-9.2.4.7-02", c.Enumeration, "enumerators", "enumerator"),
    ("arrays_have_dimensions", "R-9.2.4.9-02", c.Array, "dimensions", "dimension"),
)
"""The rules that a type has at least one member: name, requirement, kind, field, and what messages call a member."""


def _has_one(name: str, field: str, what: str) -> FindComplaints:
    """The rule that a type has at least one ``what`` in ``field``."""

    def complaints(owner: Named, _scope: Scope) -> Iterator[Complaint]:
        if not getattr(owner, field):
            yield owner, f"{type(owner).__name__.lower()} {owner.name} has no {what}; give it one"

    complaints.__name__ = name
    return complaints


for _name, _requirement, _kind, _field, _what in _HAVE_ONE:
    rule(_requirement, _kind)(_has_one(_name, _field, _what))


@rule("R-9.2.4.2-03", Model)
def aliases_lead_to_other_types(_model: Model, root: Scope) -> Iterator[Complaint]:
    """An alias that leads back to itself names nothing."""
    yield from circle_complaint(circle(root, [c.Alias], _renamed), "names")


@rule("R-9.2.4.3-06", Model)
def structures_are_finite(_model: Model, root: Scope) -> Iterator[Complaint]:
    """No structure's value contains a value of the same structure."""
    if not _all_are_finite(root):
        yield from circle_complaint(circle(root, [c.Structure], _structures_in), "contains")


@rule("R-9.2.4.9-01", Model)
def arrays_are_finite(_model: Model, root: Scope) -> Iterator[Complaint]:
    """No array is an element of itself."""
    if not _all_are_finite(root):
        yield from circle_complaint(circle(root, [c.Array], _elements), "contains")


@rule("R-9.2.4.3-06", Model, under="recursive-types=refused", also=("R-9.2.4.6-01",))
def sequences_and_unions_are_finite(_model: Model, root: Scope) -> Iterator[Complaint]:
    """Neither does a type contain itself where a shorter value would do."""
    if _all_are_finite(root):
        return
    plain = circle(root, [c.Structure], _structures_in) or circle(root, [c.Array], _elements)
    if not plain:
        yield from circle_complaint(
            circle(root, [c.Sequence], _sequences_in) or circle(root, [c.Union], _unions_in), "contains"
        )


def _all_are_finite(root: Scope) -> bool:
    """Whether no type contains itself; if so, no rule needs to search for circles."""
    kinds = (c.Structure, c.Array, c.Sequence, c.Union)
    return root.remembered(
        "all are finite",
        lambda: not circle(root, kinds, lambda d: _parts(d, kinds)),
    )


def _renamed(declared: Declared) -> Iterator[Declared]:
    if isinstance(declared.element, c.Alias):
        found = declared.scope.find(declared.element.type, *DATA_TYPES)
        if found is not None and isinstance(found.element, c.Alias):
            yield found


def _parts(declared: Declared, classes: tuple[type[Named], ...]) -> Iterator[Declared]:
    """What the values of ``declared`` consist of, directly, if it is one of ``classes``."""
    element = declared.element
    if not isinstance(element, classes):
        return
    references: Iterator[str] = iter(())
    if isinstance(element, c.Structure):
        references = iter({field.type: None for field in element.fields})
    elif isinstance(element, c.Union):
        references = (case.type for case in element.cases)
    elif isinstance(element, c.Array | c.Sequence):
        references = iter((element.type,))
    for reference in references:
        found = actual_type(reference, declared.scope)
        if found is not None:
            yield found


def _through(declared: Declared, wanted: type[Named], between: tuple[type[Named], ...]) -> Iterator[Declared]:
    """The ``wanted`` types that values of ``declared`` contain, directly or inside of values of types ``between``."""
    seen: set[int] = set()
    waiting = list(_parts(declared, (wanted,)))
    while waiting:
        found = waiting.pop()
        if id(found.element) in seen:
            continue
        seen.add(id(found.element))
        if isinstance(found.element, wanted):
            yield found
        else:
            waiting.extend(_parts(found, between))


def _structures_in(declared: Declared) -> Iterator[Declared]:
    return _through(declared, c.Structure, (c.Array,))


def _elements(declared: Declared) -> Iterator[Declared]:
    return _through(declared, c.Array, ())


def _sequences_in(declared: Declared) -> Iterator[Declared]:
    return _through(declared, c.Sequence, (c.Structure, c.Array, c.Union))


def _unions_in(declared: Declared) -> Iterator[Declared]:
    return _through(declared, c.Union, (c.Structure, c.Array))


@rule("R-9.2.4.8-03", c.Enumeration)
def index_values_are_in_range(enumeration: c.Enumeration, scope: Scope) -> Iterator[Complaint]:
    """An index value lies in the range of the enumeration's integer kind."""
    kind = index_kind(enumeration.index_type, scope)
    if kind is None:
        return
    least, most = c.INTEGER_RANGES[kind]
    for enumerator in enumeration.enumerators:
        if enumerator.value is not None and not least <= enumerator.value <= most:
            yield (
                enumerator,
                f"{enumerator.name} has the value {enumerator.value}, but {kind} holds {least} to {most}",
            )


@rule("R-9.2.4.8-04", c.Enumeration, under="equal-index-values=refused")
def index_values_differ(enumeration: c.Enumeration, _scope: Scope) -> Iterator[Complaint]:
    """The value tells enumerators apart."""
    seen: set[int] = set()
    for enumerator in enumeration.enumerators:
        if enumerator.value is None:
            continue
        if enumerator.value in seen:
            yield enumerator, f"{enumerator.name} has the value {enumerator.value} of an earlier one; give it another"
        seen.add(enumerator.value)


@rule("R-9.2.4.11-03", c.Array, also=("R-9.2.4.9-04",))
def sizes_are_in_range(array: c.Array, scope: Scope) -> Iterator[Complaint]:
    """A dimension's size lies in the range of its integer kind."""
    for dimension in array.dimensions:
        kind = index_kind(dimension.index_type, scope)
        if kind is not None and dimension.size is not None and dimension.size > c.INTEGER_RANGES[kind][1]:
            yield (
                dimension,
                f"array {array.name} has the size {dimension.size}, but {kind} ends at {c.INTEGER_RANGES[kind][1]}",
            )


@rule("R-9.2.4.11-04", c.Array)
def sizes_are_not_negative(array: c.Array, _scope: Scope) -> Iterator[Complaint]:
    """Indices run from 0 to one less than the size."""
    for dimension in array.dimensions:
        if dimension.size is not None and dimension.size < 0:
            yield dimension, f"array {array.name} has the size {dimension.size}; make it positive"


@rule("R-9.2.4.11-04", c.Array, under="empty-arrays=refused")
def arrays_are_not_empty(array: c.Array, _scope: Scope) -> Iterator[Complaint]:
    """An array has an element."""
    for dimension in array.dimensions:
        if dimension.size == 0:
            yield dimension, f"array {array.name} has the size 0; make it positive"


Resizable = c.StringType | c.NativeType | c.Sequence


@rule("R-9.2.5.1-03", c.StringType, c.NativeType, c.Sequence, under="negative-max-size=refused")
def greatest_sizes_are_not_negative(resizable: Resizable, _scope: Scope) -> Iterator[Complaint]:
    """Only -1 stands for no greatest size."""
    if resizable.max_size is not None and resizable.max_size < c.UNBOUNDED:
        yield resizable, f"{resizable.name} has the greatest size {resizable.max_size}; say -1 if there is none"


@rule("R-9.2.5.1-03", c.StringType, c.NativeType, c.Sequence, under="zero-max-size=refused")
def greatest_sizes_are_not_zero(resizable: Resizable, _scope: Scope) -> Iterator[Complaint]:
    """What can hold nothing is of no use."""
    if resizable.max_size == 0:
        yield resizable, f"{resizable.name} has the greatest size 0; say -1 if there is none"


@rule("R-9.2.5.4-03", c.Sequence, under="sequence-sizes=checked")
def sequences_fit_their_index(sequence: c.Sequence, scope: Scope) -> Iterator[Complaint]:
    """A sequence's greatest size lies in the range of its integer kind, as an array's size does."""
    kind = index_kind(sequence.index_type, scope)
    if kind is not None and sequence.max_size is not None and sequence.max_size > c.INTEGER_RANGES[kind][1]:
        yield (
            sequence,
            f"{sequence.name} has the greatest size {sequence.max_size}, but {kind} ends at {c.INTEGER_RANGES[kind][1]}",
        )
