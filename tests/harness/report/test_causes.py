"""Failures that may follow from another one are listed with it, and fail all the same."""

from __future__ import annotations

import msgspec
from made_up_run import Tape, sample
from rich.console import Console

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.scenario import Declaration, Scenario
from ucm_cts.harness.catalogue.requirements import Requirement, load_life_cycle
from ucm_cts.harness.report.order import to_fix
from ucm_cts.harness.report.summary import summary
from ucm_cts.harness.results.tally import Tally
from ucm_cts.harness.results.values import RequirementResult
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.monitor import Monitor

ADD, LIST = "R-11.2.2.1-01", "R-11.2.2.1-14"
SERVER = {"server": Declaration(provides=("in",)), "other": Declaration()}


def found(*steps: s.Step, story: Tape) -> dict[str, str]:
    """The requirements that fail, each with its cause."""
    findings = Monitor(load_life_cycle()).judge(Scenario(SERVER, steps), story.trace()).findings
    return {finding.requirement: finding.caused_by for finding in findings}


def test_a_wrong_list_after_a_refused_addition_follows_from_it() -> None:
    story = Tape()
    story.put(t.Call, step=0)
    story.put(t.Raise, step=0, error="UCM_ERROR")
    story.step(1, (5,))
    assert found(s.AddComponent("server"), s.GetComponents(), story=story)[ADD] == ""
    assert set(found(s.AddComponent("server"), s.GetComponents(), story=story).values()) == {"", ADD}


def test_findings_about_different_containers_are_apart() -> None:
    story = Tape()
    story.step(0)
    story.put(t.Call, step=1)
    story.put(t.Raise, step=1, error="UCM_ERROR")
    story.step(2, (5,))
    steps = s.CreateContainer("box"), s.AddComponent("server", container="box"), s.GetComponents()
    assert found(*steps, story=story) == {ADD: "", LIST: ""}


def test_one_failure_of_its_own_is_enough_to_stand_alone() -> None:
    own = Finding(LIST, "membership", "lacks", "a", "b")
    followed = msgspec.structs.replace(own, caused_by=ADD)
    catalogue = [Requirement(LIST, "11.2.2.1", "t", "shall", "m", "o")]
    for findings, cause in (([followed], ADD), ([followed, own], ""), ([own, followed], "")):
        tally = Tally()
        for finding in findings:
            tally.add_failure(finding, None)
        (result,) = tally.results(catalogue, ())
        assert (result.verdict, result.caused_by) == ("fail", cause)


def result(name: str, caused_by: str = "") -> RequirementResult:
    return RequirementResult(name, "11", name, "fail", 1, caused_by=caused_by)


def test_followers_are_listed_with_their_cause() -> None:
    failed = [result(ADD), result(LIST, ADD), result("R-11.2.3-03", "R-11.1.1-01")]
    fixes = to_fix(sample(requirements=tuple(failed), incidents=()))
    assert [(fix.result and fix.result.id, [f.id for f in fix.followers]) for fix in fixes] == [
        (ADD, [LIST]),
        ("R-11.2.3-03", []),
    ]
    console = Console(width=120)
    with console.capture() as printed:
        console.print(summary(sample(requirements=tuple(failed))))
    assert f"with it   {LIST}, which may follow from it" in printed.get()
