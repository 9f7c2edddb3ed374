"""Rules about values: constants and defaults follow the syntax of IDL constants and fit their types (9.2.2.6, 9.2.2.7, 9.2.6)."""

from __future__ import annotations

from collections.abc import Iterator
from operator import attrgetter

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.reference.toolchain.checking import Complaint, rule
from ucm_cts.adapters.reference.toolchain.rules.contracts.constant_syntax import NotAConstant
from ucm_cts.adapters.reference.toolchain.rules.contracts.constant_values import NoValueOfType, fit

_FITTING = (
    *(f"R-9.2.3.2-{number:02}" for number in range(3, 11)),
    "R-9.1.4.4-05",
    "R-9.2.2.6-02",
    "R-9.2.4.2-02",
    "R-9.2.6.1-03",
)
"""Requirements that say of some types, or of names in values, what 9.2.6.1 says of all."""


@rule("R-9.2.2.6-01", c.Constant, c.ConfigurationParameterValue, also=("R-9.2.6.1-01",))
def values_are_given(valued: c.Constant | c.ConfigurationParameterValue, _scope: Scope) -> Iterator[Complaint]:
    """A value is more than nothing."""
    if not valued.value:
        yield valued, "a value is empty; give one"


@rule("R-9.2.6.1-03", c.Constant, also=("R-9.2.2.6-02", "R-9.2.3.3-04"))
def constants_follow_the_grammar(constant: c.Constant, scope: Scope) -> Iterator[Complaint]:
    """The value is what IDL writes for a constant."""
    try:
        if constant.value:
            fit(constant.value, constant.type, scope)
    except NotAConstant as error:
        yield constant, f"constant {constant.name} has the value {constant.value[:80]}: {error}; write it as in IDL"
    except NoValueOfType:
        pass


@rule("R-9.2.6.1-04", c.Constant, also=_FITTING)
def constants_are_values_of_their_types(constant: c.Constant, scope: Scope) -> Iterator[Complaint]:
    """The value is one that the type has."""
    try:
        fit(constant.value, constant.type, scope)
    except NoValueOfType as error:
        yield constant, f"constant {constant.name} of type {constant.type} is {constant.value[:80]}: {error}"
    except NotAConstant:
        pass


@rule("R-9.2.2.7-01", c.ConfigurationParameter, c.Attribute, judged_by=attrgetter("type", "default_value"))
def defaults_are_values_of_their_types(
    owner: c.ConfigurationParameter | c.Attribute, scope: Scope
) -> Iterator[Complaint]:
    """A default value is written like any value, and is one that the type has."""
    if not owner.default_value:
        return
    try:
        fit(owner.default_value, owner.type, scope)
    except (NotAConstant, NoValueOfType) as error:
        yield owner, f"the default of {owner.name} of type {owner.type} is {owner.default_value[:80]}: {error}"
