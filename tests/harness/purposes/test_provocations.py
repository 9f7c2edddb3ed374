"""Provocations by dimension: which cells there are, and whether their scenarios lead where they are to lead."""

from __future__ import annotations

import itertools

import pytest

from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Performance
from ucm_cts.adapters.sdk.python.recorder import Recorder
from ucm_cts.harness.purposes.provocations.application import Application
from ucm_cts.harness.purposes.provocations.covering import chosen_cells, printed
from ucm_cts.harness.purposes.provocations.dimensions import COVERING, Cell, load_cells, load_dimensions

pytestmark = pytest.mark.fast

REFUSED_BY_THE_REFERENCE = ("on_init by add_component after start",)
"""Entrances that the reference framework closes: it refuses to add components to a started container."""


def test_the_cells_are_those_that_the_dimensions_give() -> None:
    assert printed(chosen_cells(load_dimensions())) == COVERING.read_text(encoding="utf-8")


def test_each_combination_of_three_values_has_a_scenario_or_a_reason() -> None:
    dimensions = load_dimensions()
    cells = [cell for cell in load_cells() if cell.entrance.hook]
    values = (
        dimensions.entrances,
        dimensions.actions,
        dimensions.aftermaths,
        dimensions.places,
        dimensions.positions,
        dimensions.kinds,
    )
    possible = [cell for cell in itertools.starmap(Cell, itertools.product(*values)) if not dimensions.why_empty(cell)]
    for fields in itertools.combinations(Cell.__struct_fields__, 3):
        wanted = {tuple(getattr(cell, field) for field in fields) for cell in possible}
        assert {tuple(getattr(cell, field) for field in fields) for cell in cells} == wanted


@pytest.mark.parametrize("entrance", sorted({c.entrance.name for c in load_cells() if c.entrance.hook}))
def test_the_body_acts_where_it_is_to_act(entrance: str) -> None:
    for cell in load_cells():
        if cell.entrance.name != entrance or entrance in REFUSED_BY_THE_REFERENCE:
            continue
        events, stuck = Performance(ReferenceAdapter(), Application(cell).scenario(), Recorder(None)).run()
        assert not stuck
        assert any(isinstance(e, t.Enter) and e.component == "subject" and e.hook == cell.entrance.hook for e in events)
        assert not any(isinstance(e, t.Timeout) for e in events), cell.name
