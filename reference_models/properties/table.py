"""The table of properties by moment, as far as a scenario uses what they are about."""

from __future__ import annotations

from collections.abc import Callable
from typing import get_args

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.reference_models.model.executions import Caller
from ucm_cts.reference_models.properties import (
    bursts,
    callbacks,
    claims,
    clock,
    dependencies,
    execution,
    interactions,
    message_phases,
    messages,
    operations,
    policies,
    return_codes,
    services,
    stress,
    trace,
    values,
)
from ucm_cts.reference_models.properties.declaration import PROPERTIES, Feature, checks

_MODULES = (
    operations,
    dependencies,
    interactions,
    callbacks,
    claims,
    execution,
    policies,
    stress,
    messages,
    message_phases,
    return_codes,
    services,
    clock,
    trace,
    bursts,
    values,
)
"""Importing these registers all properties; those of one moment are checked in this order."""

_PLACES = {module.__name__: number for number, module in enumerate(_MODULES)}
for _name in sorted(PROPERTIES, key=lambda name: _PLACES[PROPERTIES[name].check.__module__]):
    PROPERTIES[_name] = PROPERTIES.pop(_name)

__all__ = ["PROPERTIES", "PropertyTable", "features_of"]

Check = Callable[..., None]


class PropertyTable:
    """The checks of the properties that apply to scenarios with these ``features``, by moment."""

    def __init__(self, features: frozenset[Feature]) -> None:
        interacting = "interactions" in features
        self.ended = {op: checks("ended", op, features) for op in operations.DECLARED}
        self.entered = {hook: checks("entered", hook, features) for hook in get_args(s.Hook)}
        self.called: dict[Caller, tuple[Check, ...]] = {
            who: checks("called", who, features) for who in get_args(Caller)
        }
        self.answered = checks("answered", "exchange", features)
        self.replied = checks("replied", "exchange", features)
        self.noted = checks("noted", "siblings", features)
        self.began = checks("began") if interacting else ()
        self.over = checks("over") if interacting else ()
        self.served = checks("served") if interacting else ()
        self.waited = checks("waited") if interacting else ()
        self.linked = checks("linked") if interacting else ()
        self.delivered = checks("delivered") if interacting else ()
        self.completed = checks("completed") if interacting else ()
        self.told = checks("told") if interacting else ()
        self.closed = checks("closed") if interacting else ()


def features_of(scenario: s.Scenario) -> frozenset[Feature]:
    """The features that a scenario uses."""
    features: set[Feature] = set()
    if scenario.interfaces:
        features.add("interactions")
    for declaration in scenario.components.values():
        if declaration.policies:
            features.update(("policies", "interactions"))
        if declaration.fragment:
            features.add("fragments")
        if declaration.attributes:
            features.add("attributes")
    return frozenset(features)
