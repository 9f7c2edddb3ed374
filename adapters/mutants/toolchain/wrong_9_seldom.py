"""Tool chains that look at the usual places only: the first of several, short circles, some types, modules that are not nested."""

from __future__ import annotations

from typing import Any

from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.components import ComponentPortTechnicalPolicy, ComponentType
from ucm_cts.adapters.contract.metamodel.contracts import INTEGER_RANGES, Alias, PrimitiveFloat
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.mutants.toolchain.registry import Holds, breaks, complaining_where, named
from ucm_cts.adapters.reference.toolchain.rules.contracts.actual_types import actual_type


def _seldom(name: str, lie: str, requirement: str, rule: str, holds: Holds, *also: str) -> None:
    """Register a mutant in which the complaints of ``rule`` count only where ``holds``."""
    derive = named(lambda program: complaining_where(program, rule, holds), name, lie)
    breaks(requirement, also=also)(derive)


_CIRCLES = (
    ("aliases_lead_to_other_types", "names", "R-9.2.4.2-03"),
    ("structures_are_finite", "contains", "R-9.2.4.3-06"),
    ("arrays_are_finite", "contains", "R-9.2.4.9-01"),
    ("interfaces_do_not_inherit_from_themselves", "inherits from", "R-9.2.7.1-05"),
    ("patterns_do_not_extend_themselves", "extends", "R-9.3.3.2-06"),
    ("definitions_do_not_extend_themselves", "extends", "R-9.4.3.2-14"),
    ("types_do_not_refine_themselves", "refines", "R-9.5.3.1-11"),
    ("composites_do_not_contain_themselves", "contains", "R-9.5.5.3-04"),
)


def _is_short(verb: str) -> Holds:
    return lambda _wrong, _element, _scope, message: message.count(f" {verb} ") < 4


for _rule, _verb, _requirement in _CIRCLES:
    _seldom(f"short_circles_{_rule}", "Sees circles of up to three.", _requirement, _rule, _is_short(_verb))


def _is_not_of(kind: str) -> Holds:
    def holds(wrong: Any, _element: Element, scope: Scope, _message: str) -> bool:
        found = actual_type(wrong.type, scope)
        return not (found is not None and getattr(found.element, "kind", None) == kind)

    return holds


def _says_nothing_of(words: str) -> Holds:
    return lambda _wrong, _element, _scope, message: words not in message


for _kind in INTEGER_RANGES:
    _lie = f"Minds defaults of all types but {_kind}."
    _seldom(
        f"any_default_of_{_kind.lower()}",
        _lie,
        "R-9.2.2.7-01",
        "defaults_are_values_of_their_types",
        _is_not_of(_kind),
        "R-9.2.2.6-02",
    )
    _lie = f"Minds values of parameters of all types but {_kind}."
    _seldom(
        f"any_value_of_{_kind.lower()}",
        _lie,
        "R-9.2.9.2-03",
        "values_fit_their_parameters",
        _says_nothing_of(f"{_kind} holds"),
    )


def _is_no(kind: type[Element]) -> Holds:
    def holds(wrong: Any, _element: Element, scope: Scope, _message: str) -> bool:
        found = actual_type(wrong.type, scope)
        return not (found is not None and isinstance(found.element, kind))

    return holds


_DEFAULTS = "defaults_are_values_of_their_types"
_seldom("any_default_of_floats", "Does not look at floats.", "R-9.2.2.7-01", _DEFAULTS, _is_no(PrimitiveFloat))
_seldom(
    "any_default_by_alias",
    "Does not follow aliases.",
    "R-9.2.2.7-01",
    _DEFAULTS,
    lambda wrong, _element, scope, _message: scope.find(wrong.type, Alias) is None,
)
_seldom(
    "any_default_of_components",
    "Does not look at the attributes of component types.",
    "R-9.2.2.7-01",
    _DEFAULTS,
    lambda _wrong, _element, scope, _message: not scope.path.startswith("::comp"),
)
_seldom(
    "booleans_have_any_value",
    "Takes any literal for a truth value.",
    "R-9.2.9.2-03",
    "values_fit_their_parameters",
    _says_nothing_of("neither TRUE"),
)


def _is_among_the_first(members: str) -> Holds:
    return lambda wrong, element, _scope, _message: wrong in getattr(element, members)[:2]


_FIRST_TWO = (
    ("ports_differ", "ports", "R-9.1.4.1-02"),
    ("parts_differ", "parts", "R-9.1.4.1-02"),
    ("index_values_are_in_range", "enumerators", "R-9.2.4.8-03"),
    ("sizes_are_in_range", "dimensions", "R-9.2.4.11-03"),
)

for _rule, _members, _requirement in _FIRST_TWO:
    _seldom(
        f"first_two_{_members}",
        f"Looks at the first two {_members} only.",
        _requirement,
        _rule,
        _is_among_the_first(_members),
    )

_seldom(
    "neighbouring_defaults",
    "Sees a second default case right after the first case only.",
    "R-9.2.4.6-08",
    "one_case_is_the_default",
    lambda wrong, union, _scope, _message: wrong is union.cases[1],
)
_seldom(
    "attributes_of_components_of_one_name",
    "Does not look at the attributes of component types.",
    "R-9.1.4.1-02",
    "attributes_differ",
    lambda _wrong, owner, _scope, _message: not isinstance(owner, ComponentType),
)
_seldom(
    "first_exception_only",
    "Looks at the first exception that a method raises.",
    "R-9.2.7.2-03",
    "raises_exceptions",
    lambda wrong, method, _scope, _message: wrong is method.raised_exceptions[0],
)


def _is_not_nested(_wrong: Any, _element: Any, scope: Scope, _message: str) -> bool:
    return scope.path.count("::") < 2


_seldom(
    "outermost_connectors_only",
    "Does not look at connectors in modules of modules.",
    "R-9.3.4-01",
    "refines_a_pattern",
    _is_not_nested,
)
_seldom(
    "outermost_definitions_only",
    "Does not look at policy definitions in modules of modules.",
    "R-9.4.3.2-03",
    "specifies_an_aspect",
    _is_not_nested,
)


_seldom(
    "binds_only_in_policies_on_components",
    "Looks at the bindings of policies on components, not on ports.",
    "R-9.5.4.2-11",
    "policies_bind_abstract_types",
    lambda _wrong, policy, _scope, _message: not isinstance(policy, ComponentPortTechnicalPolicy),
)
