"""Test purposes of provocations: one for each entrance and action, and one for each refused operation."""

from __future__ import annotations

from collections.abc import Iterable

from ucm_cts.harness.purposes.provocations.application import Application
from ucm_cts.harness.purposes.provocations.dimensions import Cell, load_cells
from ucm_cts.harness.purposes.scripts import TestPurpose


def provocation_purposes() -> list[TestPurpose]:
    """All provocations of the suite."""
    cells = load_cells()
    return [
        *_purposes("provocation", "A body {action} in {entrance}.", [c for c in cells if c.entrance.hook]),
        *_purposes("refusal", "It is refused that {entrance}.", [c for c in cells if not c.entrance.hook]),
    ]


def _purposes(family: str, text: str, cells: Iterable[Cell]) -> list[TestPurpose]:
    by_purpose: dict[tuple[str, str], list[Cell]] = {}
    for cell in cells:
        by_purpose.setdefault((cell.entrance.name, cell.action.name), []).append(cell)
    purposes = []
    for (entrance, action), some in by_purpose.items():
        name = f"{family}/{entrance}" + (f"/{action}" if some[0].entrance.hook else "")
        exercises = some[0].entrance.exercises
        scenarios = tuple((f"{name}/{cell.name}", Application(cell).scenario()) for cell in some)
        described = text.format(action=action, entrance=entrance)
        purposes.append(TestPurpose(name, exercises[0].split("-")[1], described, exercises, scenarios))
    return purposes
