"""A framework that crashes or hangs: all other scenarios still run in time, and slowness is no failure."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from pathlib import Path

import msgspec
import pytest
from command_line import report_of, ucm_cts

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Call, Return, Skip
from ucm_cts.harness.execution.calls_apart import with_calls_apart
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.scripts import overlaps
from ucm_cts.harness.purposes.selection import load_purposes, select
from ucm_cts.harness.results.incidents import IncidentTime, finding_of_incident
from ucm_cts.harness.results.values import Incident
from ucm_cts.harness.statement.applicability import purposes_for
from ucm_cts.harness.statement.files import stated_by

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("here")]

STARTS = Scenario({}, (s.Start(),))
STOPS = Scenario({}, (s.Start(), s.Stop()))
LISTS = Scenario({}, (s.GetComponents(),))
REMOVES_NOTHING = Scenario({}, (s.RemoveContainer("nil"),))
REMOVES = Scenario({}, (s.CreateContainer("c"), s.RemoveContainer("c"), s.Start()))
CRASH = Incident("crash", "SIGSEGV")


def kinds(adapter: str, limits: Limits, *scenarios: Scenario) -> list[str]:
    with Driver(locate(f"hostile.failing:{adapter}"), seed=1, limits=limits) as driver:
        answers = list(driver.run((f"{n}", scenario) for n, scenario in enumerate(scenarios)))
    assert [answer.name for answer in answers] == [f"{n}" for n in range(len(scenarios))]
    return [answer.incident.kind if answer.incident else "" for answer in answers]


def test_slow_framework_is_never_taken_for_one_that_hangs() -> None:
    limits = Limits(seconds=2)
    scenarios = [REMOVES_NOTHING, STARTS, REMOVES_NOTHING, REMOVES, REMOVES_NOTHING, STARTS]
    assert kinds("IsSlow", limits, *scenarios) == ["hang", "", "hang", "", "hang", ""]


def test_framework_that_is_slow_and_goes_on_does_not_hang() -> None:
    """It takes longer than a scenario may, and another run shows that it goes on."""
    boxes = [s.CreateContainer(f"box{n}") for n in range(4)]
    slow = Scenario({}, (*boxes, *(s.Start(f"box{n}") for n in range(4))))
    with Driver(locate("hostile.failing:IsSlow"), 1, Limits(seconds=0.8)) as driver:
        (answer,) = driver.run([("slow", slow)])
        assert answer.incident is None
        assert [event for event in answer.trace if isinstance(event, Return)][-1].step == len(slow.steps) - 1


def test_long_hangs_are_left_out_and_all_else_is_tried() -> None:
    found = kinds("HangsInStop", Limits(seconds=1, incident_seconds=5), *[LISTS, STOPS, STARTS] * 40)
    assert {*found[0::3], *found[2::3]} == {""}, "no stop, no trouble"
    hangs = found[1::3].count("hang")
    assert 2 <= hangs <= 6
    assert found[1::3] == ["hang"] * hangs + ["untried"] * (40 - hangs)


def test_a_source_without_end_is_answered_even_if_nothing_of_it_can_be_tried() -> None:
    drawn = itertools.count()

    def endless() -> Iterator[tuple[str, Scenario]]:
        for number in drawn:
            assert number < 1000, "more than any host takes"
            yield f"{number}", STARTS if number < 2 else STOPS

    limits = Limits(seconds=1, incident_seconds=0)
    with Driver(locate("hostile.failing:HangsInStop"), seed=1, limits=limits) as driver:
        answers = list(itertools.islice(driver.run(endless()), 200))
    assert [answer.name for answer in answers] == [f"{n}" for n in range(200)]
    found = [answer.incident.kind if answer.incident else "" for answer in answers]
    assert found == ["", "", "hang", *["untried"] * 197]


def test_requirements_without_time_for_incidents_are_inconclusive() -> None:
    options = ["-k", "stop", "--incident-time", "0", "--timeout", "2", "--out", "out"]
    outcome = ucm_cts("run", "hostile.failing:HangsInStop", *options)
    assert outcome.status == 1
    assert "scenarios not tried: stop had met a hang before" in " ".join(outcome.out.split())
    report = report_of(Path("out"))
    verdicts = {r["id"]: r for r in report["requirements"]}
    assert "error" not in {r["verdict"] for r in verdicts.values()}
    assert verdicts["R-12.10-10"]["verdict"] == "fail", "stop does not end"
    (hang, untried) = report["incidents"]
    assert (hang["kind"], untried["kind"]) == ("hang", "untried")
    asked = sum(len(p.scenarios) for p in select(load_purposes("container"), "stop"))
    left_out = int(untried["detail"].split()[0])
    assert 0 < left_out == asked - report["scenarios"], "what was not tried is not counted"
    reasons = [r["reason"] for r in verdicts.values() if r["verdict"] == "inconclusive"]
    assert any("were not tried: stop had met a hang before" in reason for reason in reasons)


def test_crash_in_a_common_operation_leaves_every_scenario_its_try() -> None:
    cases = [case for purpose in load_purposes("container") for case in purpose.scenarios][::3]
    with Driver(locate("hostile.failing:CrashesInRemove"), seed=1) as driver:
        answers = list(driver.run(cases))
    for answer in answers:
        removes = any(isinstance(step, s.RemoveComponent) for step in answer.scenario.steps)
        assert answer.incident is None or (answer.incident.kind == "crash" and removes)
    assert sum(answer.incident is not None for answer in answers) > 50
    assert sum(bool(answer.incident and answer.trace) for answer in answers) > 10, "many are run again"


def test_time_is_for_all_incidents_together() -> None:
    incident_time = IncidentTime(10)
    call = (Call(1, 0, 0, 0),)
    incident_time.spend(9, STOPS, CRASH, call)
    assert incident_time.not_tried(STARTS) is None
    incident_time.spend(1, STOPS, CRASH, call)
    assert incident_time.not_tried(STARTS)
    assert incident_time.not_tried(LISTS) is None, "nothing is known against get_components"
    incident_time.spend(1, LISTS, CRASH, ())
    assert incident_time.not_tried(LISTS), "the operation to leave out is not known"


def test_confirmations_are_for_incidents_that_are_not_explained() -> None:
    incident_time = IncidentTime(10)
    incident_time.spend_confirming(5)
    for _ in range(2):
        assert incident_time.is_worth_confirming(STARTS, "crash")
        incident_time.spend(1, STARTS, CRASH, (Call(1, 0, 0, 0),))
    assert not incident_time.is_worth_confirming(STOPS, "crash")
    assert incident_time.is_worth_confirming(STOPS, "hang")
    assert incident_time.is_worth_confirming(LISTS, "crash")


@pytest.mark.parametrize("connector", [s.SERVICE_CONNECTOR, s.MESSAGE_CONNECTOR])
def test_connector_that_is_not_offered_is_not_asked_for_again(connector: str) -> None:
    incident_time = IncidentTime(60)
    asked = {kind: Scenario({}, (s.Link(kind, "any", "link"),)) for kind in (s.SERVICE_CONNECTOR, s.MESSAGE_CONNECTOR)}  # type: ignore[arg-type]
    assert incident_time.not_tried(asked[connector]) is None
    incident_time.note_skips(asked[connector], (Call(1, 0, 0, 0), Skip(2, 0, 0, 0, "link")))
    refused = incident_time.not_tried(asked[connector])
    assert refused is not None
    assert connector in refused.detail
    assert [incident_time.not_tried(other) for kind, other in asked.items() if kind != connector] == [None]
    assert incident_time.not_tried(STARTS) is None


def test_threads_that_never_come_back_fail_the_requirement_that_forbids_it() -> None:
    statement = stated_by(None, "reference-py")
    statement = msgspec.structs.replace(statement, ixit={**statement.ixit, "patience": 200})
    some = [p for p in purposes_for(statement, "core") if "R-10.1.3.2-17" in p.requirements][:3]
    assert some
    with Driver(locate("ucm_cts.adapters.mutants.python:forgets_who_waits"), seed=1) as driver:
        campaign = Campaign(driver, "core", (), statement)
        for _ in campaign.check(some):
            pass
        report = campaign.report()
    assert {item.incident.kind for item in report.incidents} == {"hang"}
    (result,) = (r for r in report.requirements if r.id == "R-10.1.3.2-17")
    assert (result.verdict, report.verdict) == ("fail", "not conformant")
    assert result.exercised > 0
    assert result.findings[0].finding.rule != "declared_errors"


ONE = {"server": s.Declaration(provides=("in",))}
SERVES = (s.AddComponent("server"), s.GetPortElement("server", "in", "api"), s.Start(), s.Invoke("api", 1), s.Stop())
CALLS_THE_REMOVED = Scenario(ONE, (*SERVES, s.RemoveComponent("server"), s.Invoke("api", 2), s.GetComponents()))
LOSES = Scenario(ONE, (s.AddComponent("server", bind="other"), *SERVES))


def test_what_waits_for_ever_and_may_is_left_waiting_and_the_rest_of_its_scenario_is_run() -> None:
    with Driver(locate("hostile.failing:LosesCallsBesides"), seed=1, limits=Limits(seconds=1)) as driver:
        first, *others, lost, last = driver.run(
            [("open", CALLS_THE_REMOVED), *[("open", CALLS_THE_REMOVED)] * 20, ("lost", LOSES), ("plain", LISTS)]
        )
        warnings = driver.warnings
    for answer in (first, *others):
        assert answer.incident is None
        listed = next(n for n, step in enumerate(answer.scenario.steps) if isinstance(step, s.GetComponents))
        assert [e.value for e in answer.trace if isinstance(e, Return) and e.step == listed] == [()]
    assert lost.scenario == LOSES, "calls that must come back get all of their time"
    assert lost.incident is not None
    assert lost.incident.kind == "hang"
    finding = finding_of_incident(driver.revealed(lost))
    assert finding is not None
    assert finding.requirement == "R-11.2.3-03"
    assert last.incident is None
    assert any("in 21 scenarios calls of what is removed" in warning for warning in warnings)


def test_calls_that_may_wait_cost_no_verdict() -> None:
    purposes = [one for one in load_purposes("container") if one.id == "later use/removal of the server"]
    with Driver(locate("hostile.failing:LeavesCallsWaiting"), seed=1, limits=Limits(seconds=1)) as driver:
        campaign = Campaign(driver, "container")
        for _ in campaign.check(purposes):
            pass
        report = campaign.report()
    assert report.incidents == ()
    assert report.scenarios == sum(len(purpose.scenarios) for purpose in purposes)
    assert {result.verdict for result in report.requirements} == {"pass", "inconclusive"}
    assert report.warnings


def test_calls_apart_change_no_verdict() -> None:
    """Each call of a scenario's own thread gets a thread of its own, and is waited for."""
    apart = with_calls_apart(CALLS_THE_REMOVED)
    assert (
        [step.thread for step in apart.steps if isinstance(step, s.Invoke)]
        == ["caller1", "caller2"]
        == [*apart.may_stay]
    )
    assert not any(overlaps(apart.steps))
    assert with_calls_apart(apart) == apart
    assert with_calls_apart(STOPS) is STOPS
