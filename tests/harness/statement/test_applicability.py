"""The requirements and scenarios that a statement selects."""

from __future__ import annotations

import pytest
from statements import CORE_REQUIREMENTS, EVERYTHING, EXTENSIONS, PARTS, REQUIREMENTS, UNASKED, stating

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.harness.catalogue.requirements import load_capabilities, load_options, load_requirements
from ucm_cts.harness.models.core_models import CHECKS
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.statement.applicability import lacking_claims, needs_of, purposes_for, why_not

pytestmark = pytest.mark.usefixtures("here")


def test_needs_name_existing_capabilities_and_readings() -> None:
    known = {f"{option}={value}" for option, values in load_options().items() for value in values} | {
        *PARTS,
        *EXTENSIONS,
    }
    for need in load_capabilities().needs:
        assert {*need.needs, *need.one_of} <= known
        for pattern in need.requirements:
            assert any(need in load_capabilities().of(r.id) for r in load_requirements()), pattern
    always = {r.id for r in CORE_REQUIREMENTS if not load_capabilities().of(r.id)}
    assert always == {
        *("R-10-02", "R-10.1-01", "R-10.1-02", "R-10.1-03", "R-10.1.1-02", "R-10.1.1-05", "R-10.1.1-06"),
        *(f"R-10.1.2-0{n}" for n in range(3, 9)),
    }


def test_everything_applies_if_everything_is_claimed() -> None:
    everything = stating(dict.fromkeys((*EXTENSIONS, *UNASKED), True), readings={"pending-value": "per-writer"})
    assert [r.id for r in load_requirements() if why_not(r, everything)] == []
    assert lacking_claims(everything, "core") == {}
    readings = tuple(f"{option}={value}" for option, value in EVERYTHING.items())
    assert len(purposes_for(everything, "core")) == len(load_purposes("core", *readings))
    reduced, whole = purposes_for(default_statement(), "container"), load_purposes("container")
    assert {p.id: p.scenarios for p in reduced} == {p.id: p.scenarios for p in whole}


@pytest.mark.parametrize("profile", ["container", "core", "extensions"])
def test_every_requirement_is_asked_for_early(profile: str) -> None:
    purposes = purposes_for(default_statement(), profile)
    asked = {requirement for purpose in purposes for requirement in purpose.requirements}
    scenarios, met = 0, set[str]()
    for purpose in purposes:
        if met == asked:
            break
        scenarios += len(purpose.scenarios)
        met.update(purpose.requirements)
    assert scenarios < sum(len(purpose.scenarios) for purpose in purposes) / 8


def test_without_test_operations_only_their_requirements_are_left() -> None:
    default = default_statement()
    of_declared = (
        *("R-9.4.3.2-06", "R-9.2.7.4-04", "R-11.2.3-18"),
        *("R-10.1.3-02", "R-10.1.3.2-20", "R-10.1.6.1-07"),
    )
    unmet = {r.id: why_not(r, default) for r in CORE_REQUIREMENTS if why_not(r, default)}
    assert {r: unmet.pop(r, ("", ""))[0] for r in of_declared} == dict.fromkeys(  # type: ignore[index]
        of_declared, "not applicable"
    )
    assert {verdict for verdict, _ in filter(None, unmet.values())} == {"inconclusive"}
    assert lacking_claims(default, "core").keys() <= unmet.keys()
    steps = [step for p in purposes_for(default, "core") for _, scenario in p.scenarios for step in scenario.steps]
    assert not [step for step in steps if isinstance(step, s.Break | s.ReadLog)]
    exercised = {r for p in purposes_for(default, "core") for r in p.requirements}
    behavioural = {r.id for r in CORE_REQUIREMENTS if not set(r.rules) <= CHECKS.keys() and r.id not in of_declared}
    assert behavioural - exercised - unmet.keys() <= behavioural - {
        r for p in load_purposes("core") for r in p.requirements
    }


@pytest.mark.parametrize("part", PARTS)
def test_scenarios_of_a_part_that_is_left_out_are_not_run(part: str) -> None:
    without = stating({part: False})
    for purpose in purposes_for(without, "core"):
        assert part not in {need for _, scenario in purpose.scenarios for need in needs_of(scenario)}, purpose.id
        if purpose.draw is not None:
            drawn = purpose.draw(1, without.readings)
            assert [name for name, _ in drawn] == [name for name, _ in purpose.scenarios]
    gone = {r.id for r in CORE_REQUIREMENTS if why_not(r, without)}
    assert gone
    assert {why_not(REQUIREMENTS[r], without)[0] for r in gone} == {"not applicable"}  # type: ignore[index]


def test_readings_may_make_requirements_not_apply() -> None:
    narrow = stating(readings={"log-message": "narrow-255", "port-trace-parameters": "none"})
    gone = {r.id for r in CORE_REQUIREMENTS if why_not(r, narrow)}
    assert gone == {"R-10.1.4.2-47", *(f"R-10.1.4.2-{n}" for n in range(31, 36))}
    built_in = stating(readings={"core-models": "built-in"})
    of_models = {r.id for r in CORE_REQUIREMENTS if set(r.rules) <= CHECKS.keys()}
    assert {r.id for r in CORE_REQUIREMENTS if why_not(r, built_in)} == of_models


@pytest.mark.parametrize(
    ("transport", "connector", "verdict"),
    [
        ("impossible", "hook", None),
        ("impossible", "impossible", "not applicable"),
        ("impossible", "none", "inconclusive"),
    ],
)
def test_what_cannot_fail_need_not_be_broken(transport: str, connector: str, verdict: str | None) -> None:
    stated = stating(readings={"transport-fault": transport, "connector-fault": connector})
    verdicts = {r: (why_not(REQUIREMENTS[r], stated) or (None,))[0] for r in ("R-10.1.2-01", "R-10.1.2-12")}
    assert verdicts == {"R-10.1.2-01": verdict, "R-10.1.2-12": "not applicable"}


def test_patience_is_the_vendors() -> None:
    hasty = stating(ixit=default_statement().ixit | {"patience": 500.0})
    usual = {name: scenario for p in purposes_for(stating(), "core") for name, scenario in p.scenarios}
    for purpose in purposes_for(hasty, "core"):
        for name, scenario in purpose.scenarios:
            assert scenario.patience == round(usual[name].patience / 4)
