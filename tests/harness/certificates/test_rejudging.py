"""A run that is judged again from its record has the same report."""

from __future__ import annotations

import dataclasses
import json
import subprocess
import sys
from typing import Any

import msgspec
import pytest
import subjects
from judged_runs import (
    MUTANTS,
    Run,
    answers,
    edit,
    is_same,
    later,
    run_of,
)
from recorded_runs import plan_of, recorded, some_purposes
from statements import EXTENSIONS

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.certificates.rejudging import RunPlan, judge_again, without_clock
from ucm_cts.harness.execution import campaign
from ucm_cts.harness.execution import record as r
from ucm_cts.harness.execution.campaign import BUSY
from ucm_cts.harness.execution.clock_gaps import ClockGaps
from ucm_cts.harness.execution.confirmation import OF_THE_MACHINE
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.statement.applicability import purposes_for


def test_a_record_is_judged_like_the_run(conformant: Run) -> None:
    is_same(conformant)
    assert {r.Answered, r.Repeated, r.InSeries} <= kinds(conformant)
    assert conformant.report.effort.measures["scenarios drawn at random"] == 20


def test_a_reader_finds_every_scenario_and_its_whole_trace(conformant: Run) -> None:
    performed = list(conformant.record.performed())
    events = sum(len(trace) for entry, trace in performed if isinstance(entry, r.Answered))
    assert events == conformant.report.events
    for entry, trace in performed:
        scenario = json.loads(conformant.record.scenario(entry))
        steps = {event.step for event in trace if hasattr(event, "step")}
        assert steps <= set(range(len(scenario["steps"])))
    times = [event.t for _, trace in performed for event in trace[:1]]
    assert times == sorted(times)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("adapter", "words", "more"),
    [
        (f"{MUTANTS}:leaves_its_watchdog", ("R-11.2.2.2-07",), {}),
        ("hostile.failing:CrashesInRemove", (), {"incident_seconds": 3.0}),
        ("hostile.failing:HangsInStop", (), {"seconds": 0.5, "incident_seconds": 3.0}),
        (
            "hostile.failing:LeavesCallsWaiting",
            ("later use/removal of the server",),
            {"seconds": 1.0, "incident_seconds": 5.0},
        ),
        ("hostile.failing:AddsNothing", (), {}),
        ("hostile.failing:TakesMemoryInStop", (), {"memory": 250, "incident_seconds": 3.0}),
    ],
)
@pytest.mark.usefixtures("here")
def test_what_fails_crashes_or_hangs_is_judged_like_the_run(
    adapter: str, words: tuple[str, ...], more: dict[str, Any]
) -> None:
    run = run_of(adapter, *words, every=10**6 if words else 25, **more)
    shown = any(result.findings for result in run.report.requirements)
    assert shown or run.report.incidents or run.report.warnings
    is_same(run)


def of_one_purpose(adapter: str, name: str, profile: str = "core") -> Run:
    """A run in this process, of the first scenario of a test purpose of ``profile``, with a log that can be read.

    Of the extensions all are claimed.
    """
    default = default_statement()
    statement = msgspec.structs.replace(
        default,
        readings=default.readings | {"trace-sink": "hook"},
        capabilities=default.capabilities | dict.fromkeys(EXTENSIONS if profile == "extensions" else (), True),
    )
    plan = RunPlan(profile, 5, statement)
    (whole,) = (one for one in purposes_for(statement, profile) if one.id == name)
    purpose = dataclasses.replace(whole, scenarios=whole.scenarios[:1])
    return Run(plan, (purpose,), *recorded(adapter, plan, (purpose,), in_process=True))


def kinds(run: Run) -> set[type]:
    return {type(entry) for entry in run.record.entries}


@pytest.mark.parametrize(("slips", "verdict"), [(1, "inconclusive"), (1000, "fail")])
def test_second_looks_decide_when_a_run_is_judged_again(slips: int, verdict: str) -> None:
    subjects.Slips.left = slips
    run = of_one_purpose("subjects:Slipping", "same-connection-twice")
    assert {one.verdict for one in run.report.requirements if one.id == "R-11.2.1.2-06"} == {verdict}
    assert {r.Repeated} <= kinds(run)
    is_same(run)
    entries = tuple(entry for entry in run.record.entries if not isinstance(entry, r.Repeated))
    without = run.judged(msgspec.structs.replace(run.record, entries=entries))
    assert any("second look" in problem for problem in without.problems)


def test_shorter_scenarios_are_shown_and_must_show_their_failure() -> None:
    subjects.Slips.left = 1000
    run = of_one_purpose("subjects:Slipping", "same-connection-twice")
    number, shorter = next((n, e) for n, e in enumerate(run.record.entries) if isinstance(e, r.Shorter))
    for changes, problem in (
        ({"cause": ("R-11.2.1.2-01", "x", "y")}, "no failure of this run"),
        ({"name": "mine"}, "is not named"),
        ({"plain": Scenario({}, ())}, "is not the scenario"),
        ({"words": {}}, "does not show"),
        ({"events": shorter.events[:-2], "times": shorter.times[:-2]}, "cannot be true"),
    ):
        entries = list(run.record.entries)
        edit(entries, number, **changes)
        again = run.judged(msgspec.structs.replace(run.record, entries=tuple(entries)))
        assert any(problem in one for one in again.problems) or changes == {"words": {}}, (changes, again.problems)


def test_failures_that_were_not_looked_at_again_for_want_of_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(campaign, "SECONDS_FOR_CONFIRMATION", 0.0)
    subjects.Slips.left = 1000
    run = of_one_purpose("subjects:Slipping", "same-connection-twice")
    assert run.report.effort.measures["failures that were not run again"] >= 1
    assert r.UsedUp in kinds(run)
    is_same(run)
    monkeypatch.setattr(campaign, "SECONDS_FOR_CONFIRMATION", 60.0)
    assert any("cannot have been used up" in problem for problem in run.judged().problems)


def test_moments_at_which_the_machine_stood_still_are_recorded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ClockGaps, "longest", lambda gaps, events: 800)
    subjects.Forgets.left = 1000
    run = of_one_purpose("subjects:Forgetful", "log-of-several-components")
    reasons = {one.reason for one in run.report.requirements if one.id == "R-10.1.4.2-26"}
    assert reasons == {"the machine stood still for 800 ms when it was to be seen"}
    assert r.Stood in kinds(run)
    is_same(run)
    assert any("the machine stood still" in one for one in run.judged().unshown)


@pytest.mark.parametrize(("waited", "verdict"), [(450, "pass"), (399, "inconclusive")])
def test_lateness_that_was_the_machines_does_not_count_when_a_run_is_judged_again(
    waited: int, verdict: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ClockGaps, "contended", lambda gaps, events: waited)
    subjects.Dawdles.left = 1
    run = of_one_purpose("subjects:Dawdling", "index timers/sporadic", "extensions")
    assert {one.verdict for one in run.report.requirements if one.id == "R-10.3.2-26"} == {verdict}
    assert run.report.effort.measures.get(OF_THE_MACHINE, 0) == (verdict == "pass")
    assert (BUSY in run.report.warnings) == (verdict == "pass")
    assert r.Contended in kinds(run)
    is_same(run)
    assert any("too few processors" in one for one in run.judged().unshown)
    entries = (
        msgspec.structs.replace(entry, milliseconds=10**6) if isinstance(entry, r.Contended) else entry
        for entry in run.record.entries
    )
    forged = run.judged(msgspec.structs.replace(run.record, entries=tuple(entries)))
    assert any("cannot have waited" in problem for problem in forged.problems)


def test_a_gap_in_the_first_of_several_looks_is_judged_again(monkeypatch: pytest.MonkeyPatch) -> None:
    stood = iter([800])
    monkeypatch.setattr(ClockGaps, "longest", lambda gaps, events: next(stood, 0))
    subjects.Dawdles.left = 1
    run = of_one_purpose("subjects:Dawdling", "index timers/sporadic", "extensions")
    assert {one.verdict for one in run.report.requirements if one.id == "R-10.3.2-26"} == {"pass"}
    monkeypatch.undo()
    is_same(run)


@pytest.mark.usefixtures("here")
def test_a_remote_host_is_judged_by_its_own_clock(tmp_path: Any) -> None:
    module = "ucm_cts.adapters.sdk.python.host"
    subject = "ucm_cts.adapters.reference.python.adapter:ReferenceAdapter"
    command = [sys.executable, "-m", module, subject, "--listen", f"unix:{tmp_path / 'socket'}"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            assert server.stdout is not None
            address = server.stdout.readline().removeprefix("listening on ").strip()
            run = run_of(address, every=60)
        finally:
            server.terminate()
    assert run.record.heading.isolation == "remote"
    is_same(run)
    entries = list(run.record.entries)
    later(entries, answers(entries)[0], -(10**10))
    again = run.judged(msgspec.structs.replace(run.record, entries=tuple(entries)))
    assert any("before the end" in problem for problem in again.problems), again.problems


def test_profile_core_is_judged_again() -> None:
    is_same(run_of("reference-py", profile="core", every=40, drawn=10))


@pytest.mark.slow
def test_a_whole_run_of_a_profile_is_judged_again() -> None:
    plan = plan_of("reference-py", drawn=50)
    purposes = some_purposes(plan, every=1)
    report, record = recorded("reference-py", plan, purposes)
    again = judge_again(record, plan)
    assert again.problems == ()
    assert without_clock(again.report) == without_clock(report)
    assert report.verdict == "conformant"
