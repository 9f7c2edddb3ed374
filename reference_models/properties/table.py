"""The table of all properties, by the moment at which they are checked."""

from __future__ import annotations

from typing import get_args

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.reference_models.model.execution_policies import extended_policy
from ucm_cts.reference_models.model.executions import Caller
from ucm_cts.reference_models.model.operation import DECLARED_ERRORS
from ucm_cts.reference_models.model.service_policies import has_timers
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
    clause_10_3,
    clause_10_3_1,
    clause_10_3_1_triggers,
    clause_10_3_2,
    clause_10_3_2_end,
    clause_10_3_end,
    clause_10_3_expiry,
    clause_10_3_times,
    clause_10_4,
    clause_10_4_1,
    clause_10_4_1_2,
    clause_10_4_1_2_responses,
    clause_10_4_2,
    clause_10_4_2_2,
    clause_10_4_2_2_notifications,
    clause_10_5_1,
    clause_10_5_2,
    clause_10_5_2_invocations,
    clause_10_5_2_runs,
    clause_11_2_1,
    clause_11_2_1_2,
    clause_11_2_2,
    clause_11_2_2_at_once,
    clause_11_2_3,
    clause_11_2_3_after_failures,
    clause_11_2_3_calls,
    clause_11_2_3_interfaces,
    declared_choices,
    handed_over,
)
from ucm_cts.reference_models.properties.declaration import PROPERTIES, Bound, Feature, Moment, checked_at

__all__ = ["PROPERTIES", "PropertyTable", "features_of"]


class PropertyTable:
    """The properties that apply to scenarios with these ``features``.

    ``at``: by moment.
    ``ended``, ``unsettled``: by operation.
    ``ended_after_removal``: those of ``ended`` that are checked for removed containers.
    ``entered``, ``unclear``: by hook.
    ``called``: by caller.
    """

    def __init__(self, features: frozenset[Feature]) -> None:
        hooks: tuple[s.Hook, ...] = get_args(s.Hook)
        callers: tuple[Caller, ...] = get_args(Caller)
        self.at: dict[Moment, tuple[Bound, ...]] = {m: checked_at(m, features) for m in get_args(Moment)}
        self.ended = {op: checked_at("ended", features, op) for op in DECLARED_ERRORS}
        self.ended_after_removal = {
            op: tuple((evaluate, one) for evaluate, one in bound if one.even_after_removal)
            for op, bound in self.ended.items()
        }
        self.unsettled = {op: checked_at("unsettled", features, op) for op in DECLARED_ERRORS}
        self.entered = {hook: checked_at("entered", features, hook) for hook in hooks}
        self.unclear = {hook: checked_at("unclear", features, hook) for hook in hooks}
        self.called = {who: checked_at("called", features, who) for who in callers}


def features_of(scenario: s.Scenario) -> frozenset[Feature]:
    """The features that a scenario uses."""
    features: set[Feature] = set()
    if scenario.interfaces:
        features.add("interactions")
    if scenario.types:
        features.add("extended")
    for declaration in scenario.components.values():
        if declaration.policies:
            features.update(("policies", "interactions"))
        if extended_policy(declaration) is not None:
            features.add("paced")
        if has_timers(declaration):
            features.add("timers")
        if declaration.fragment:
            features.add("fragments")
        if declaration.attributes or declaration.defaults:
            features.add("attributes")
    return frozenset(features)
