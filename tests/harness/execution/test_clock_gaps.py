"""A finding that depends on time counts only if the machine did not stand still and the finding is shown twice.

Lateness that is shown once, on a busy machine, does not count.
"""

from __future__ import annotations

import os
import threading
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec
import pytest
import subjects
from command_line import within
from made_up_run import lasting

from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution import campaign, clock_gaps
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.clock_gaps import ClockGaps, processor_pressure
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.results.values import Report, RequirementResult
from ucm_cts.reference_models.monitor import Monitor
from ucm_cts.reference_models.properties import clause_10_3_2_end as numbers

pytestmark = pytest.mark.slow

MILLISECOND = 1_000_000


class Clock:
    """Tells times that are set, in milliseconds, and lets the watch see each of them."""

    def __init__(self) -> None:
        self.now = 0
        self.seen = threading.Semaphore(0)

    def __call__(self) -> int:
        self.seen.release()
        return self.now * MILLISECOND

    def pass_on_to(self, now: int) -> None:
        self.now = now
        while self.seen.acquire(blocking=False):
            pass
        for _ in range(2):
            assert self.seen.acquire(timeout=10)


def test_gap_is_noted_and_found_by_the_traces_it_met() -> None:
    clock = Clock()
    with ClockGaps(clock) as gaps:
        for now in (20, 100, 850, 870):
            clock.pass_on_to(now)
        assert gaps.longest(lasting(0, 60)) == 0
        assert gaps.longest(lasting(50, 200)) == 750
        assert gaps.longest(lasting(300, 400)) == 750
        assert gaps.longest(lasting(860, 1000)) == 0
        assert gaps.longest(()) == 0


def test_gap_that_has_not_ended_counts() -> None:
    clock = Clock()
    with ClockGaps(clock) as gaps:
        clock.pass_on_to(10)
    clock.now = 600
    assert gaps.longest(lasting(0, 500)) == 590


def test_contention_is_what_threads_waited_while_a_trace_came_about() -> None:
    clock, waited = Clock(), [0]
    with ClockGaps(clock, lambda: waited[0]) as gaps:
        for now, waited[0] in ((20, 5), (40, 5), (60, 17), (80, 30)):
            clock.pass_on_to(now)
        assert gaps.contended(lasting(20, 40)) == 0
        assert gaps.contended(lasting(45, 58)) == 12
        assert gaps.contended(lasting(45, 55)) == 10
        assert gaps.contended(lasting(25, 79)) == 25
        assert gaps.contended(()) == 0
        waited[0] = 90
        assert gaps.contended(lasting(75, 200)) == 73
        waited[0] = 9000
        assert gaps.contended(lasting(75, 200)) == 125


def test_a_system_that_does_not_tell_has_no_contention(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(clock_gaps, "_PRESSURE", tmp_path / "cpu")
    assert processor_pressure() == 0
    (tmp_path / "cpu").write_text("some avg10=0.00 avg60=1.00 avg300=2.00 total=1234567\nfull avg10=0.00 total=9000\n")
    assert processor_pressure() == 1234
    (tmp_path / "cpu").write_text("nothing of the kind\n")
    assert processor_pressure() == 0


def test_thread_measures_from_start_to_close() -> None:
    def measuring() -> int:
        return sum(thread.name == "clock gaps" for thread in threading.enumerate())

    before = measuring()
    gaps = ClockGaps()
    assert measuring() == before
    with gaps:
        assert measuring() == before + 1
    assert measuring() == before


# made-up runs


@pytest.mark.parametrize(
    ("came", "late"), [([150, 550, 750], 0), ([150, 430, 550, 750], 30), ([150, 430, 690, 750], 90), ([150], 0)]
)
def test_a_callback_that_did_not_come_is_not_told_as_late(
    came: list[int], late: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(numbers, "_times_after", lambda runtime, timer, new: timer)
    due: Any = [(100, 200), (300, 400), (500, 600), (700, 800)]
    old: Any = []
    assert numbers._late_by(old, (old, due), due, came) == late


@pytest.mark.usefixtures("here")
@pytest.mark.parametrize("name", ["several/a number in use", "several/a periodic number in use"])
def test_a_number_in_use_whose_callback_is_late_is_told_as_late(name: str) -> None:
    (purpose,) = (p for p in load_purposes("extensions") if p.id == "index timers/several")
    with Driver(locate("subjects:DawdlingOnce", virtual_time=True), seed=5) as driver:
        (answer,) = driver.run([(name, dict(purpose.scenarios)[name])])
    monitor = Monitor(load_life_cycle(), READABLE.ics)
    found = monitor.judge(answer.disguised, answer.trace).findings
    assert [(finding.rule, finding.cause) for finding in found] == [("number_in_use", "late")]


# whole runs


READABLE = msgspec.structs.replace(default_statement(), readings=default_statement().readings | {"trace-sink": "hook"})


def report_of(forgotten: int) -> Report:
    (purpose,) = (p for p in load_purposes("core") if p.id == "log-of-several-components")
    subjects.Forgets.left = forgotten
    with Driver(locate("subjects:Forgetful", True), seed=5) as driver:
        run = Campaign(driver, "core", (), READABLE)
        for _ in run.check([_impatient(purpose)]):
            pass
        return run.report()


def _impatient(purpose: TestPurpose) -> TestPurpose:
    shorter = tuple((name, msgspec.structs.replace(asked, patience=100)) for name, asked in purpose.scenarios)
    return replace(purpose, scenarios=shorter)


@pytest.mark.parametrize(
    ("forgotten", "verdict", "why"),
    [(0, "pass", ""), (1, "inconclusive", "unstable: seen once"), (1000, "fail", "")],
)
def test_failure_must_be_shown_again(forgotten: int, verdict: str, why: str) -> None:
    (result,) = (r for r in report_of(forgotten).requirements if r.id == "R-10.1.4.2-26")
    assert result.verdict == verdict
    assert result.reason.startswith(why)
    assert bool(result.reason) == (verdict == "inconclusive")


def test_verdict_is_inconclusive_if_the_machine_stood_still(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ClockGaps, "longest", lambda gaps, events: 800)
    (result,) = (r for r in report_of(1000).requirements if r.id == "R-10.1.4.2-26")
    assert (result.verdict, result.reason) == (
        "inconclusive",
        "the machine stood still for 800 ms when it was to be seen",
    )


# confirmations in whole runs


def looked_at_again(
    adapter: str, purpose_id: str, in_process: bool, requirement: str, times: int = 1
) -> RequirementResult:
    (purpose,) = (p for p in load_purposes("core") if p.id == purpose_id)
    with Driver(locate(f"subjects:{adapter}", in_process), seed=5) as driver:
        run = Campaign(driver, "core", (), READABLE)
        for _ in run.check([_impatient(purpose)] * times):
            pass
        run.confirm()
        for _ in run.shorten():
            pass
        (result,) = (r for r in run.report().requirements if r.id == requirement)
    return result


@pytest.mark.parametrize(("slips", "verdict"), [(1, "inconclusive"), (1000, "fail")])
def test_failure_that_is_not_shown_again_is_unstable_and_both_traces_are_kept(slips: int, verdict: str) -> None:
    subjects.Slips.left = slips
    result = looked_at_again("Slipping", "same-connection-twice", True, "R-11.2.1.2-06")
    assert result.verdict == verdict
    (failed, *_) = result.findings
    assert failed.execution is not None
    if verdict == "inconclusive":
        assert result.reason == failed.unstable == "unstable: seen, and not when the same scenario was run 4 times more"
        assert failed.steady is not None
        assert len(failed.steady.trace) > len(failed.execution.trace)


@pytest.mark.parametrize(
    ("times", "slips", "verdict"),
    [(2, 4, "inconclusive"), (2, 1000, "fail"), (9, 27, "inconclusive"), (10, 30, "fail")],
)
def test_failure_that_was_seen_less_than_ten_times_is_confirmed_too(times: int, slips: int, verdict: str) -> None:
    subjects.Slips.left = slips
    result = looked_at_again("Slipping", "same-connection-twice", True, "R-11.2.1.2-06", times)
    assert result.verdict == verdict
    assert result.findings[0].occurrences == times
    assert bool(result.findings[0].steady) == (verdict == "inconclusive")


def test_failures_without_time_for_confirmation_stand_and_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(campaign, "SECONDS_FOR_CONFIRMATION", -1)
    subjects.Slips.left = 1
    (purpose,) = (p for p in load_purposes("core") if p.id == "same-connection-twice")
    with Driver(locate("subjects:Slipping", True), seed=5) as driver:
        run = Campaign(driver, "core", (), READABLE)
        for _ in run.check([_impatient(purpose)]):
            pass
        run.confirm()
        report = run.report()
    assert {r.verdict for r in report.requirements if r.id == "R-11.2.1.2-06"} == {"fail"}
    assert report.effort.measures["failures that were not run again"] == 1


@pytest.mark.skipif(len(os.sched_getaffinity(0)) < 2, reason="one core is all there is")
def test_pass_that_depends_on_the_schedule_is_unstable(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    within(tmp_path, monkeypatch)
    result = looked_at_again("MissingOnOneCore", "log-of-several-components", False, "R-10.1.4.2-26")
    assert result.verdict == "inconclusive"
    assert result.reason == "unstable: kept, but not with all threads on one core and more patience"
    (failed,) = result.findings
    assert failed.execution is not None
    assert failed.steady is not None
    assert len(failed.steady.trace) >= len(failed.execution.trace)
