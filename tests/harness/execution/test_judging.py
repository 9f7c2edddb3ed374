"""A judge beside the run finds the same as one in it, in the same order, whatever happens to its process."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace

import psutil
import pytest

from ucm_cts.harness.execution import judging
from ucm_cts.harness.execution.driver import Answer, Driver
from ucm_cts.harness.execution.judging import A_BATCH, Judge, SideJudge
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.selection import load_purposes, select
from ucm_cts.harness.results.values import Incident
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.verdicts import Verdicts

LOST = Incident("crash", "it was lost")
ORPHAN = """
import multiprocessing
from ucm_cts.harness.execution.judging import SideJudge
from ucm_cts.reference_models.model.ics import Ics
with SideJudge(Ics()):
    print(multiprocessing.active_children()[0].pid, flush=True)
    input()
"""


@pytest.fixture(scope="module", params=["reference-py", "ucm_cts.adapters.mutants.python:starts_what_was_removed"])
def answers(request: pytest.FixtureRequest) -> list[Answer]:
    purposes = select(load_purposes("container"), "11.2.2.1 or restart")
    cases = [case for purpose in purposes for case in purpose.scenarios]
    with Driver(locate(request.param), 1) as driver:
        known = list(driver.run(cases))
    assert len(known) > 3 * A_BATCH
    return [replace(one, incident=LOST) if number % 20 == 7 else one for number, one in enumerate(known)]


def seen(verdicts: Verdicts | None) -> object:
    if verdicts is None:
        return None
    rows = {name: (one.exercised, one.violated, one.readings) for name, one in verdicts.rows.items()}
    return verdicts.exercises, verdicts.findings, rows, verdicts.readings, verdicts.measures


def test_verdicts_and_order_are_the_same(answers: list[Answer]) -> None:
    here = list(Judge(Ics()).judged(answers))
    with SideJudge(Ics()) as judge:
        aside = list(judge.judged(answers, at_once=False))
    assert [answer for answer, _ in aside] == answers
    assert [seen(verdicts) for _, verdicts in aside] == [seen(verdicts) for _, verdicts in here]
    assert [verdicts is None for _, verdicts in aside] == [answer.incident is not None for answer in answers]


def test_judged_at_once_where_that_is_wanted(answers: list[Answer]) -> None:
    taken = iter(answers)
    with SideJudge(Ics()) as judge:
        first, _ = next(judge.judged(taken))
    assert first is answers[0]
    assert next(taken) is answers[1]


def test_few_answers_are_not_kept_back(answers: list[Answer], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(judging, "SOON", 0)
    taken = iter(answers)
    with SideJudge(Ics()) as judge:
        first, _ = next(judge.judged(taken, at_once=False))
    assert first is answers[0]
    assert next(taken) is answers[1]


@pytest.mark.parametrize("after", [0, 5, A_BATCH, 2 * A_BATCH + 5])
def test_interrupt_comes_after_what_was_answered(answers: list[Answer], after: int) -> None:
    def interrupted() -> Iterator[Answer]:
        yield from answers[:after]
        raise KeyboardInterrupt

    taken: list[Answer] = []
    with SideJudge(Ics()) as judge, pytest.raises(KeyboardInterrupt):
        taken.extend(answer for answer, _ in judge.judged(interrupted(), at_once=False))
    assert taken == answers[:after]


@pytest.mark.parametrize("after", [0, A_BATCH, 2 * A_BATCH])
def test_killed_process_loses_nothing(answers: list[Answer], after: int, children: Callable[[], set[int]]) -> None:
    def killing() -> Iterator[Answer]:
        for number, answer in enumerate(answers):
            if number == after:
                for child in children():
                    os.kill(child, signal.SIGKILL)
            yield answer

    with SideJudge(Ics()) as judge:
        aside = list(judge.judged(killing(), at_once=False))
    assert [seen(verdicts) for _, verdicts in aside] == [seen(v) for _, v in Judge(Ics()).judged(answers)]


@pytest.fixture
def children() -> Callable[[], set[int]]:
    """The processes that the test has started."""
    before = {one.pid for one in psutil.Process().children()}
    return lambda: {one.pid for one in psutil.Process().children()} - before


def test_process_ends_with_the_one_that_it_is_a_fork_of() -> None:
    command = [sys.executable, "-c", ORPHAN]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as run:
        assert run.stdout is not None
        child = psutil.Process(int(run.stdout.readline()))
        run.kill()
    psutil.wait_procs([child], timeout=60)
    assert not child.is_running() or child.status() == psutil.STATUS_ZOMBIE
