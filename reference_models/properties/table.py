"""The table of all properties, by the moment at which they are checked."""

from __future__ import annotations

from typing import get_args

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.reference_models.model.executions import Caller
from ucm_cts.reference_models.model.operation import DECLARED_ERRORS
from ucm_cts.reference_models.properties import (  # noqa: F401 - importing these registers all properties
    clause_10_1_1,
    clause_10_1_2,
    clause_10_1_2_bursts,
    clause_10_1_3,
    clause_10_1_3_2,
    clause_10_1_4_1,
    clause_10_1_4_2,
    clause_10_1_5,
    clause_10_1_6,
    clause_10_1_6_phases,
    clause_11_2_1,
    clause_11_2_1_2,
    clause_11_2_2,
    clause_11_2_3,
    clause_11_2_3_calls,
    declared_choices,
)
from ucm_cts.reference_models.properties.declaration import PROPERTIES, Bound, Feature, checked_at

__all__ = ["PROPERTIES", "PropertyTable", "features_of"]


class PropertyTable:
    """The properties that apply to scenarios with these ``features``, by moment."""

    def __init__(self, features: frozenset[Feature]) -> None:
        interacting = "interactions" in features
        self.ended = {op: checked_at("ended", op, features) for op in DECLARED_ERRORS}
        self.entered = {hook: checked_at("entered", hook, features) for hook in get_args(s.Hook)}
        self.unclear = {hook: checked_at("unclear", hook, features) for hook in get_args(s.Hook)}
        self.called: dict[Caller, tuple[Bound, ...]] = {
            who: checked_at("called", who, features) for who in get_args(Caller)
        }
        self.answered = checked_at("answered", "exchange", features)
        self.replied = checked_at("replied", "exchange", features)
        self.noted = checked_at("noted", "siblings", features)
        self.began = checked_at("began") if interacting else ()
        self.over = checked_at("over") if interacting else ()
        self.served = checked_at("served") if interacting else ()
        self.waited = checked_at("waited") if interacting else ()
        self.linked = checked_at("linked") if interacting else ()
        self.delivered = checked_at("delivered") if interacting else ()
        self.completed = checked_at("completed") if interacting else ()
        self.told = checked_at("told") if interacting else ()
        self.closed = checked_at("closed") if interacting else ()


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
