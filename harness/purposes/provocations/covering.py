"""Chooses the cells of ``suite/provocations.yaml`` that have scenarios, by covering arrays; run it after each change of that file:

python -m ucm_cts.harness.purposes.provocations.covering > suite/provocations_covering.json
"""

from __future__ import annotations

import json
from collections.abc import Sequence

from covertable import make

from ucm_cts.harness.purposes.provocations.dimensions import (
    NOTHING,
    Dimensions,
    Entrance,
    Excluded,
    NamedAction,
    load_dimensions,
)

OF_ACTIONS, OF_REFUSALS = 3, 2
"""Every possible combination of so many values, each of another dimension, is in some cell."""

Chosen = dict[str, dict[str, list[list[str]]]]
"""By entrance and action: aftermath, place, position and kind of each cell."""


def chosen_cells(dimensions: Dimensions) -> Chosen:
    """The cells that have scenarios: always the same ones for the same dimensions."""
    refusals = [e for e in dimensions.entrances_and_refusals().values() if e.hook is None]
    return {
        **_covering(dimensions, dimensions.entrances, dimensions.actions, OF_ACTIONS),
        **_covering(dimensions, refusals, (NOTHING,), OF_REFUSALS),
    }


def _covering(
    dimensions: Dimensions, entrances: Sequence[Entrance], actions: Sequence[NamedAction], strength: int
) -> Chosen:
    others = {
        "aftermath": dimensions.aftermaths,
        "place": dimensions.places,
        "position": dimensions.positions,
        "kind": dimensions.kinds,
    }
    rows = make(
        {"entrance": [e.name for e in entrances], "action": [a.name for a in actions], **others},
        strength=strength,
        constraints=[_constraint(excluded, entrances) for excluded in dimensions.excluded],
    )
    chosen: Chosen = {}
    for row in sorted(rows, key=lambda row: list(row.values())):
        cells = chosen.setdefault(row["entrance"], {}).setdefault(row["action"], [])
        cells.append([row[dimension] for dimension in others])
    return chosen


def _constraint(excluded: Excluded, entrances: Sequence[Entrance]) -> dict[str, object]:
    """``excluded`` as the library reads it."""
    limits: dict[str, Sequence[str]] = {
        "action": excluded.actions,
        "aftermath": excluded.aftermaths,
        "place": excluded.places,
        "kind": excluded.kinds,
    }
    limits = {dimension: values for dimension, values in limits.items() if values}
    if excluded.hooks or excluded.by:
        limits["entrance"] = [e.name for e in entrances if excluded.holds_at(e)]
    conditions = [{"operator": "in", "left": name, "values": list(values)} for name, values in limits.items()]
    return {"operator": "not", "condition": {"operator": "and", "conditions": conditions}}


def printed(chosen: Chosen) -> str:
    """As ``suite/provocations_covering.json`` has it: a line for each entrance and action."""
    parts = []
    for entrance, by_action in chosen.items():
        lines = [f"  {json.dumps(action)}: {json.dumps(cells)}" for action, cells in by_action.items()]
        parts.append(f"{json.dumps(entrance)}: {{\n" + ",\n".join(lines) + "\n }")
    return "{\n " + ",\n ".join(parts) + "\n}\n"


if __name__ == "__main__":
    print(printed(chosen_cells(load_dimensions())), end="")
