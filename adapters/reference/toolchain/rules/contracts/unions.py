"""Rules about unions: the selector, and which case is active for which of its values (9.2.4.5, 9.2.4.6)."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel.contracts import Alias, Enumeration, Union
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.reference.toolchain.checking import Complaint, rule
from ucm_cts.adapters.reference.toolchain.rules.contracts.actual_types import DATA_TYPES, actual_type


@rule("R-9.2.4.5-03", Union)
def selectors_have_names(union: Union, _scope: Scope) -> Iterator[Complaint]:
    """A selector is declared by its name."""
    if not union.selector_name:
        yield union, f"the selector of union {union.name} has an empty name; give it one"


@rule("R-9.2.4.5-04", Union)
def selector_types_exist(union: Union, scope: Scope) -> Iterator[Complaint]:
    """What is named as the selector's type is a declared data type."""
    if scope.find(union.selector_type, *DATA_TYPES) is None:
        yield union, f"the selector of union {union.name} has the type '{union.selector_type}', which is not declared"


@rule("R-9.2.4.5-05", Union)
def selectors_are_enumerations(union: Union, scope: Scope) -> Iterator[Complaint]:
    """No other discrete type tells cases apart."""
    found = actual_type(union.selector_type, scope)
    if found is not None and not isinstance(found.element, Enumeration):
        yield union, f"the selector of union {union.name} is of {union.selector_type}, which is no enumeration"


@rule("R-9.2.4.5-05", Union, under="selector-aliases=refused")
def selectors_are_no_aliases(union: Union, scope: Scope) -> Iterator[Complaint]:
    """The selector's type is the enumeration itself."""
    found = scope.find(union.selector_type, *DATA_TYPES)
    if found is not None and isinstance(found.element, Alias) and _selector(union, scope) is not None:
        yield union, f"the selector of union {union.name} is of the alias {union.selector_type}; name the enumeration"


@rule("R-9.2.4.6-03", Union)
def cases_have_selector_values(union: Union, _scope: Scope) -> Iterator[Complaint]:
    """Every case but the default says when it is active."""
    for case in union.cases:
        if not case.selector_values and not case.default_case:
            yield case, f"case {case.name} of union {union.name} has no selector value; give it one"


@rule("R-9.2.4.6-04", Union)
def selector_values_are_enumerators(union: Union, scope: Scope) -> Iterator[Complaint]:
    """A selector value is an enumerator of the selector."""
    enumeration = _selector(union, scope)
    if enumeration is None:
        return
    known = {enumerator.name for enumerator in enumeration.enumerators}
    for case in union.cases:
        for value in case.selector_values:
            if value.enumerator not in known:
                yield value, f"{enumeration.name} has no enumerator '{value.enumerator}'; name one that it has"


@rule("R-9.2.4.6-05", Union, under="repeated-selector-values=refused")
def selector_values_have_one_case(union: Union, _scope: Scope) -> Iterator[Complaint]:
    """For each value one case is active."""
    taken: dict[str, int] = {}
    for number, case in enumerate(union.cases):
        for value in case.selector_values:
            owner = taken.setdefault(value.enumerator, number)
            if owner != number:
                yield value, f"two cases of union {union.name} have the selector value {value.enumerator}; keep one"


@rule("R-9.2.4.6-08", Union)
def one_case_is_the_default(union: Union, _scope: Scope) -> Iterator[Complaint]:
    """The default is one case, or none."""
    for second in [case for case in union.cases if case.default_case][1:]:
        yield second, f"case {second.name} is a second default of union {union.name}; keep one"


def _selector(union: Union, scope: Scope) -> Enumeration | None:
    found = actual_type(union.selector_type, scope)
    return found.element if found is not None and isinstance(found.element, Enumeration) else None
