"""``ucm-cts explain``: clauses, operations, cells of provocation, and what names nothing."""

from __future__ import annotations

from typing import get_args

import pytest
from command_line import ucm_cts

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.harness.catalogue.requirements import load_capabilities, load_requirements, requirements_of
from ucm_cts.harness.cli.explained import Topic, cells_of, found
from ucm_cts.harness.models.core_models import CHECKS
from ucm_cts.harness.purposes.provocations.dimensions import load_cells, load_dimensions
from ucm_cts.reference_models.properties.clause_11_2_2 import DECLARED


@pytest.mark.parametrize("clause", ["10.1.3", "11.2", "9", "12.10", "10.1.3.2"])
def test_a_clause_lists_its_requirements_with_their_levels_a_line_each(clause: str) -> None:
    outcome = ucm_cts("explain", clause)
    assert (outcome.status, outcome.err) == (0, "")
    heading, columns, *lines = outcome.out.splitlines()
    assert (heading, columns.split()) == (f"clause {clause}", ["requirement", "clause", "level", "title"])
    within = [r for r in load_requirements() if f"{r.clause}.".startswith(f"{clause}.")]
    assert within
    assert len(lines) == len(within)
    for line, requirement in zip(lines, within, strict=True):
        assert line.split()[:2] == [requirement.id, requirement.clause]
        assert f" {requirement.force} " in line
        assert requirement.title in line


@pytest.mark.parametrize("operation", DECLARED)
def test_an_operation_has_the_requirement_about_its_end_and_scenarios(operation: str) -> None:
    topic = found(operation)
    assert isinstance(topic, Topic)
    assert DECLARED[operation] in {r.id for r in topic.requirements}
    assert topic.purposes


@pytest.mark.parametrize(
    "operation",
    [
        *get_args(s.Hook),
        *(c.id for c in load_capabilities().capabilities),
        *sorted(s.STANDARD_METHODS),
        "attach",
        "break",
    ],
)
def test_callbacks_parts_and_methods_can_be_asked_for(operation: str) -> None:
    topic = found(operation)
    assert isinstance(topic, Topic)
    assert topic.requirements
    by_scenarios = [r for r in topic.requirements if set(r.rules) - CHECKS.keys()]  # models show the rest
    assert topic.purposes or not any(r in requirements_of("extensions") for r in by_scenarios)


def test_an_operation_names_what_concerns_it_and_nothing_else() -> None:
    outcome = ucm_cts("explain", "on_disconnect")
    assert (outcome.status, outcome.err) == (0, "")
    ids = [line.split()[0] for line in outcome.out.splitlines() if line.startswith("R-")]
    assert {"R-11.2.1.3-05", "R-11.2.1.3-06", "R-12.10-08"} <= {*ids}
    assert not {"R-11.2.1.3-02", "R-12.10-09"}.intersection(ids)
    assert "  provocation/...: " in outcome.out


@pytest.mark.parametrize(
    ("topic", "message"),
    [
        ("remove_componnt", "no requirement, clause or operation 'remove_componnt'; near it: remove_component"),
        ("10.1.33", "no requirement, clause or operation '10.1.33'; near it: 10.1.3"),
        ("R-11.2.2.1-133", "no requirement 'R-11.2.2.1-133'; near it: R-11.2.2.1-13"),
        ("\nx" * 5000, "no requirement, clause or operation '"),
        (" ", "no requirement, clause or operation"),
    ],
)
def test_what_names_nothing_is_one_clear_line(topic: str, message: str) -> None:
    outcome = ucm_cts("explain", topic)
    assert (outcome.status, outcome.out, outcome.err.count("\n")) == (2, "", 1)
    assert message in outcome.err
    assert len(outcome.err) < 300


def test_cells_of_provocation_are_named_and_empty_ones_have_a_reason() -> None:
    dimensions = load_dimensions()
    concerned = {id_ for entrance in dimensions.entrances_and_refusals().values() for id_ in entrance.exercises}
    reasons = [excluded.reason for excluded in dimensions.excluded]
    for requirement in concerned:
        for line in cells_of(requirement):
            entrance, _, rest = line.partition(": ")
            if rest.startswith("none.") or "; not " in rest:
                assert any(reason in rest for reason in reasons), line
            else:
                assert not rest or "each of" in rest, line
            assert rest or entrance.rstrip(":") in dimensions.entrances_and_refusals()
    assert cells_of("R-10.1.4.2-04") == []


def test_a_requirement_shows_its_cells_and_the_number_of_scenarios() -> None:
    text = ucm_cts("explain", "R-12.10-05").out
    raised = [
        cell
        for cell in load_cells()
        if (cell.entrance.name, cell.action.name) == ("on_remove by remove_component after stop", "raises")
    ]
    each = f"each of {len(load_dimensions().aftermaths)} aft"
    assert f"  on_remove by remove_component after stop:\n    raises: {len(raised)} scenarios, {each}" in text
    assert "calls its peer: none. A body has its references from on_startup to on_shutdown only.\n" in text
    assert "What was refused cannot be undone." in text
    assert "provocation/" not in text.partition("Cells of provocation")[0]
