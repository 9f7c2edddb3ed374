"""Which rules look at what: all of them, in one order, as far as a scenario has something for them to look at."""

from __future__ import annotations

from collections.abc import Callable
from typing import get_args

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.reference_models.model.executions import Caller
from ucm_cts.reference_models.properties import (
    bursts as rules_bursts,
)
from ucm_cts.reference_models.properties import (
    callbacks as rules_callbacks,
)
from ucm_cts.reference_models.properties import (
    claims as rules_claims,
)
from ucm_cts.reference_models.properties import (
    clock as rules_clock,
)
from ucm_cts.reference_models.properties import (
    dependencies as rules_dependencies,
)
from ucm_cts.reference_models.properties import (
    execution as rules_execution,
)
from ucm_cts.reference_models.properties import (
    interactions as rules_interactions,
)
from ucm_cts.reference_models.properties import (
    message_phases as rules_message_phases,
)
from ucm_cts.reference_models.properties import (
    messages as rules_messages,
)
from ucm_cts.reference_models.properties import (
    operations as rules_operations,
)
from ucm_cts.reference_models.properties import (
    policies as rules_policies,
)
from ucm_cts.reference_models.properties import (
    return_codes as rules_return_codes,
)
from ucm_cts.reference_models.properties import (
    services as rules_services,
)
from ucm_cts.reference_models.properties import (
    stress as rules_stress,
)
from ucm_cts.reference_models.properties import (
    trace as rules_trace,
)
from ucm_cts.reference_models.properties import (
    values as rules_values,
)
from ucm_cts.reference_models.verdicts import Where, checks, in_order_of

RULE_MODULES = (
    rules_operations,
    rules_dependencies,
    rules_interactions,
    rules_callbacks,
    rules_claims,
    rules_execution,
    rules_policies,
    rules_stress,
    rules_messages,
    rules_message_phases,
    rules_return_codes,
    rules_services,
    rules_clock,
    rules_trace,
    rules_bursts,
    rules_values,
)
"""Importing these registers all rules; rules of one moment look in this order."""

in_order_of(module.__name__ for module in RULE_MODULES)


Check = Callable[..., None]


class Watch:
    """The checks that have something to look at in scenarios where so much is ``followed``, by moment."""

    def __init__(self, followed: frozenset[Where]) -> None:
        self.ended = {op: checks("ended", op, followed) for op in rules_operations.DECLARED}
        self.entered = {hook: checks("entered", hook, followed) for hook in get_args(s.Hook)}
        self.called: dict[Caller, tuple[Check, ...]] = {
            who: checks("called", who, followed) for who in get_args(Caller)
        }
        self.answered = checks("answered", "exchange", followed)
        self.replied = checks("replied", "exchange", followed)
        self.noted = checks("noted", "siblings", followed)
        self.began = checks("began")
        self.over = checks("over")
        self.served = checks("served")
        self.waited = checks("waited")
        self.linked = checks("linked")
        self.delivered = checks("delivered")
        self.completed = checks("completed")
        self.told = checks("told")
        self.closed = checks("closed")


def followed_in(scenario: s.Scenario) -> frozenset[Where]:
    """What is to be followed in a scenario."""
    followed: set[Where] = set()
    if scenario.interfaces:
        followed.add("interactions")
    for declaration in scenario.components.values():
        if declaration.policies:
            followed.update(("policies", "interactions"))
        if declaration.fragment:
            followed.add("fragments")
        if declaration.attributes:
            followed.add("attributes")
    return frozenset(followed)
