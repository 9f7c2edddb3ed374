"""Predicted coverage: the transitions of the life-cycle model that a scenario takes if the framework is conformant.

The reference model carries the scenario out itself, so that thousands can be compared before one is sent.
"""

from __future__ import annotations

from itertools import pairwise
from typing import get_args

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Scenario, Step
from ucm_cts.reference_models.model.prediction import Prediction
from ucm_cts.reference_models.model.row_selection import RowSelection

Transition = tuple[str, ...]
"""Rows of the life-cycle table: one after the other for one instance, or all rows of one operation together."""

_CALLS = get_args(s.ContainerCall)


def transitions(rows: RowSelection, scenario: Scenario) -> frozenset[Transition]:
    """The transitions that ``scenario`` takes, and steps for connectors by what comes before and after them."""
    prediction = Prediction(rows, scenario.components)
    latest: dict[int, str] = {}
    found: set[Transition] = set()
    for step in scenario.steps:
        if not isinstance(step, _CALLS):
            continue
        ongoing = prediction.perform(step)
        found.add(("together", *sorted({row.id for _, row in ongoing.roles})))
        for member, row in ongoing.roles:
            found.add(("then", latest.get(id(member), ""), row.id))
            if member is not None:
                latest[id(member)] = row.id
    for before, after in pairwise(scenario.steps):
        if not all(isinstance(step, (*_CALLS, s.Invoke)) for step in (before, after)):
            found.add(("steps", _name_of(before), _name_of(after)))
    return frozenset(found)


def _name_of(step: Step) -> str:
    return f"{s.operation(step)} {getattr(step, 'role', '')}"
