"""A finding that depends on time counts only if the machine did not stand still and the finding is shown twice.

Lateness that is shown once, on a busy machine, does not count.
"""

from __future__ import annotations

import os
import threading
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec
import pytest
import subjects
from command_line import within

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Call, Trace
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution import campaign, clock_gaps
from ucm_cts.harness.execution import confirmation as module
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.clock_gaps import ClockGaps, processor_pressure
from ucm_cts.harness.execution.confirmation import Confirmation
from ucm_cts.harness.execution.driver import Answer, Circumstances, Driver
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.results.values import Report, RequirementResult
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.monitor import Monitor
from ucm_cts.reference_models.properties import clause_10_3_2_end as numbers

pytestmark = pytest.mark.slow

MILLISECOND = 1_000_000


def trace(first: int, last: int) -> Trace:
    """From one millisecond to the other."""
    return Call(n=1, t=first * MILLISECOND, thread=0, step=0), Call(n=2, t=last * MILLISECOND, thread=0, step=1)


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
        assert gaps.longest(trace(0, 60)) == 0
        assert gaps.longest(trace(50, 200)) == 750
        assert gaps.longest(trace(300, 400)) == 750
        assert gaps.longest(trace(860, 1000)) == 0
        assert gaps.longest(()) == 0


def test_gap_that_has_not_ended_counts() -> None:
    clock = Clock()
    with ClockGaps(clock) as gaps:
        clock.pass_on_to(10)
    clock.now = 600
    assert gaps.longest(trace(0, 500)) == 590


def test_contention_is_what_threads_waited_while_a_trace_came_about() -> None:
    clock, waited = Clock(), [0]
    with ClockGaps(clock, lambda: waited[0]) as gaps:
        for now, waited[0] in ((20, 5), (40, 5), (60, 17), (80, 30)):
            clock.pass_on_to(now)
        assert gaps.contended(trace(20, 40)) == 0
        assert gaps.contended(trace(45, 58)) == 12
        assert gaps.contended(trace(45, 55)) == 10
        assert gaps.contended(trace(25, 79)) == 25
        assert gaps.contended(()) == 0
        waited[0] = 90
        assert gaps.contended(trace(75, 200)) == 73
        waited[0] = 9000
        assert gaps.contended(trace(75, 200)) == 125


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

TIMED = Finding("R-10.1.4.2-26", "log_recorded", "none", "a record", "there was none")
LATE = Finding("R-10.3.2-26", "timers_expire_in_time", "late", "in time", "late", late_by=400 * MILLISECOND)
EARLY = Finding("R-10.3.2-25", "timers_never_early", "early", "in time", "early")
MISSING = Finding("R-10.3.2-21", "timers_expire_in_time", "never", "in time", "never")
LASTING = Finding("R-10.1.4.2-51", "log_severity_kept", "info", "info", "debug")
ANSWER = Answer("a", Scenario({}, ()), Scenario({}, (), patience=100), trace(0, 10))


class MadeUp:
    """A driver, a monitor and a watch in one: the second run finds ``second``, and the machine stood still for ``gaps``.

    Further runs find what is in ``further``. Threads waited ``waited`` milliseconds for a processor.
    """

    def __init__(self, second: list[Finding], *gaps: int, waited: int = 0) -> None:
        self.second, self.gaps, self.waited = second, list(gaps), waited
        self.further: list[list[Finding]] = []
        self.patience: list[float] = []
        self.measures = Counter[str]()
        self.isolation = "process"
        self.exercises = {LATE.requirement: 1}

    @property
    def findings(self) -> list[Finding]:
        place = len(self.patience) - 2
        return self.further[place] if 0 <= place < len(self.further) else self.second

    def again(self, name: str, scenario: Scenario, circumstances: Circumstances) -> Answer:
        self.patience.append(circumstances.patience)
        return Answer(name, scenario, scenario, trace(20, 30))

    def judge(self, scenario: Scenario, events: Trace) -> Any:
        return self

    def longest(self, events: Trace) -> int:
        return self.gaps.pop(0) if self.gaps else 0

    def contended(self, events: Trace) -> int:
        return self.waited

    def confirmation(self) -> Confirmation:
        return Confirmation(self, self, self, self.measures)  # type: ignore[arg-type]


def test_finding_that_does_not_depend_on_time_is_not_run_again() -> None:
    run = MadeUp([], 900)
    assert run.confirmation().separate(ANSWER, [LASTING]) == ([LASTING], [])
    assert run.patience == []


def test_finding_that_is_shown_again_is_confirmed_once() -> None:
    run = MadeUp([TIMED])
    confirmation = run.confirmation()
    for _ in range(2):
        assert confirmation.separate(ANSWER, [LASTING, TIMED]) == ([LASTING, TIMED], [])
    assert run.patience == [5]


def test_unconfirmed_failure_is_unstable() -> None:
    run = MadeUp([])
    confirmation = run.confirmation()
    confirmed, unconfirmed = confirmation.separate(ANSWER, [TIMED, LASTING])
    assert confirmed == [LASTING]
    reason = "unstable: seen once, and not when the same scenario was run again with 5 times the patience"
    assert [(one.finding, one.reason) for one in unconfirmed] == [(TIMED, reason)]
    assert unconfirmed[0].steady == Answer("a", ANSWER.scenario, ANSWER.scenario, trace(20, 30))
    for _ in range(5):
        assert confirmation.separate(ANSWER, [TIMED])[0] == []
    assert len(run.patience) == module.MOST_ATTEMPTS


@pytest.mark.parametrize("gaps", [(700, 0), (0, 700, 700, 700), (300, 200, 200, 700)])
def test_gap_is_the_reason(gaps: tuple[int, ...]) -> None:
    run = MadeUp([] if gaps[0] else [TIMED], *gaps)
    (one,) = run.confirmation().separate(ANSWER, [TIMED])[1]
    assert one.finding is TIMED
    assert one.reason == "the machine stood still for 700 ms when it was to be seen"


def test_finding_that_is_shown_again_without_a_gap_is_confirmed() -> None:
    assert MadeUp([TIMED], 700, 0).confirmation().separate(ANSWER, [TIMED]) == ([TIMED], [])


def test_second_look_is_taken_again_if_the_machine_stood_still() -> None:
    run = MadeUp([TIMED], 0, 700, 700, 0)
    assert run.confirmation().separate(ANSWER, [TIMED]) == ([TIMED], [])
    assert run.patience == [5, 5, 5]


def test_lateness_is_looked_for_again_where_the_machine_did_not_stand_still() -> None:
    run = MadeUp([], 400, 0, 300, 0)
    run.further = [[LATE], [], [], []]
    assert run.confirmation().separate(ANSWER, [LATE]) == ([], [])
    assert run.patience == [5, 1, 1, 1, 1]


@pytest.mark.parametrize(("gap", "waited"), [(0, 400), (400, 0)])
def test_lateness_on_a_busy_machine_that_is_not_shown_again_does_not_count(gap: int, waited: int) -> None:
    run = MadeUp([], gap, 0, waited=waited)
    run.further = [[], [LASTING], []]
    assert run.confirmation().separate(ANSWER, [LATE, LASTING]) == ([LASTING], [])
    assert run.patience == [5, 1, 1, 1]
    assert run.measures == {module.OF_THE_MACHINE: 1}


@pytest.mark.parametrize(
    ("findings", "further", "waited"),
    [
        ([LATE], [], 399),
        ([msgspec.structs.replace(LATE, late_by=MILLISECOND)], [], 99),
        ([EARLY], [], 5000),
        ([MISSING], [], 5000),
        ([LATE, EARLY], [], 5000),
        ([LATE], [[msgspec.structs.replace(LATE, late_by=0)]], 5000),
        ([LATE], [[LATE], [], [LATE], [], [LATE]], 5000),
    ],
)
def test_other_findings_on_a_busy_machine_are_unstable(
    findings: list[Finding], further: list[list[Finding]], waited: int
) -> None:
    run = MadeUp([], waited=waited)
    run.further = further
    confirmed, unconfirmed = run.confirmation().separate(ANSWER, findings)
    assert confirmed == []
    assert [one.finding for one in unconfirmed] == findings
    assert not run.measures
    assert len(run.patience) == 1 + len(further)


@pytest.mark.parametrize("further", [[[LATE]], [[], [], [LATE]], [[LATE], [], [LATE]]])
def test_lateness_may_be_shown_again_while_the_machine_is_busy(further: list[list[Finding]]) -> None:
    run = MadeUp([], waited=5000)
    run.further = further
    assert run.confirmation().separate(ANSWER, [LATE]) == ([], [])
    assert len(run.patience) == 1 + len([one for one in further if one]) + module.FURTHER_OF_LATE


def test_lateness_on_a_busy_machine_is_not_excused_often() -> None:
    run = MadeUp([], waited=5000)
    confirmation = run.confirmation()
    told = [len(confirmation.separate(ANSWER, [LATE])[1]) for _ in range(6)]
    assert told == [0] * module.MOST_ATTEMPTS + [1] * 3
    fresh = msgspec.structs.replace(LATE, cause="late, too")
    assert confirmation.separate(ANSWER, [LATE, fresh])[1] != []


def test_lateness_is_not_excused_by_another_machine_or_by_a_run_without_it() -> None:
    remote, bare = MadeUp([], waited=5000), MadeUp([], waited=5000)
    remote.isolation = "remote"
    bare.exercises = {}
    for run in (remote, bare):
        assert [one.finding for one in run.confirmation().separate(ANSWER, [LATE])[1]] == [LATE]


@pytest.mark.parametrize(("waited", "runs"), [(0, 1), (5000, 1 + module.FURTHER_OF_LATE)])
def test_lateness_that_is_shown_each_time_counts(waited: int, runs: int) -> None:
    run = MadeUp([LATE], waited=waited)
    assert run.confirmation().separate(ANSWER, [LATE]) == ([LATE], [])
    assert len(run.patience) == runs


@pytest.mark.parametrize("busy", [0, 1, 2])
def test_lateness_that_is_shown_twice_on_a_busy_machine_and_not_each_time_does_not_count(busy: int) -> None:
    run = MadeUp([LATE], waited=5000)
    run.further = [*[[LATE]] * busy, *[[]] * 9]
    assert run.confirmation().separate(ANSWER, [LATE]) == ([], [])
    run = MadeUp([LATE], waited=5000)
    run.further = [*[[LATE]] * busy, [], *[[LATE]] * 9]
    (one,) = run.confirmation().separate(ANSWER, [LATE])[1]
    assert one.reason == "unstable: late on a busy machine, and not each time"


def test_what_comes_too_early_or_not_at_all_counts_on_a_busy_machine() -> None:
    for finding in (EARLY, MISSING):
        assert MadeUp([finding], waited=5000).confirmation().separate(ANSWER, [finding]) == ([finding], [])


def test_shorter_scenarios_do_not_count_if_the_machine_stood_still() -> None:
    assert MadeUp([], 700, 700).confirmation().outside_gaps(ANSWER, [TIMED, LASTING]) == [LASTING]
    assert MadeUp([]).confirmation().outside_gaps(ANSWER, [TIMED, LASTING]) == [TIMED, LASTING]


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


@pytest.mark.parametrize("name", ["several/a number in use", "several/a periodic number in use"])
def test_a_number_in_use_whose_callback_is_late_is_told_as_late(name: str) -> None:
    (purpose,) = (p for p in load_purposes("extensions") if p.id == "index timers/several")
    subjects.Dawdles.left = 1
    with Driver(locate("subjects:Dawdling", True), seed=5) as driver:
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
