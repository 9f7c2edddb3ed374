"""What is wrong with the text of a finding."""

from __future__ import annotations

import pytest

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Scenario
from ucm_cts.harness.selftest.wording import Wording
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.naming import Namer

SCENARIO = Scenario(
    {"client": Declaration(("in.api",))},
    (s.AddComponent("client"), s.AddComponent("ghost"), s.GetPortElement("client", "in.api", "entry")),
)


@pytest.mark.parametrize(
    ("expected", "observed", "wrong"),
    [
        ("add_component(ghost) ends with UCM_ERROR", "it returned", ""),
        ("client gets true", "it got false", ""),
        ("entry leads to it", "it did not", ""),
        ("in.api is entered", "it was not", ""),
        ("client gets true", "client gets true", "observed what was expected"),
        ("", "client got it", "does not say what was expected"),
        ("client gets 1", "it got True", "says 'True'"),
        ("client gets 1", "it got None", "says 'None'"),
        (
            "it returns",
            "it raised in ghosts",
            "names no instance, implementation, port, connection, container or reference",
        ),
    ],
)
def test_what_is_wrong_is_said(expected: str, observed: str, wrong: str) -> None:
    assert Wording(SCENARIO).problem(Finding("R-12.10-21", "outcomes", "c", expected, observed, ())) == wrong


def test_an_implementation_of_nobody_is_a_name_already() -> None:
    finding = Finding("R-12.10-21", "outcomes", "c", "add_component(ghost) ends with UCM_ERROR", "it returned", (), 1)
    assert Namer(SCENARIO, ()).named(finding) == finding
