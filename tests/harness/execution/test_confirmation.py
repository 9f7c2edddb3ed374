"""A finding that depends on time is looked at again: when it counts, on a machine that stands still or is busy, too."""

from __future__ import annotations

from collections import Counter
from typing import Any

import msgspec
import pytest
from made_up_run import lasting

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.harness.execution import confirmation as module
from ucm_cts.harness.execution.confirmation import Confirmation
from ucm_cts.harness.execution.driver import Answer, Circumstances
from ucm_cts.reference_models.findings import Finding

MILLISECOND = 1_000_000


TIMED = Finding("R-10.1.4.2-26", "log_recorded", "none", "a record", "there was none")
LATE = Finding("R-10.3.2-26", "timers_expire_in_time", "late", "in time", "late", late_by=400 * MILLISECOND)
EARLY = Finding("R-10.3.2-25", "timers_never_early", "early", "in time", "early")
MISSING = Finding("R-10.3.2-21", "timers_expire_in_time", "never", "in time", "never")
LASTING = Finding("R-10.1.4.2-51", "log_severity_kept", "info", "info", "debug")
ANSWER = Answer("a", Scenario({}, ()), Scenario({}, (), patience=100), lasting(0, 10))


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
        return Answer(name, scenario, scenario, lasting(20, 30))

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
    assert unconfirmed[0].steady == Answer("a", ANSWER.scenario, ANSWER.scenario, lasting(20, 30))
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
