"""Random exploration: what it finds, what every run draws, and how it ends."""

from __future__ import annotations

import io
import json
import os
import select
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import msgspec
import pytest
from command_line import ucm_cts
from explorations import MENDED, REFERENCE, REQUIREMENT, SUBJECT, exploration
from hypothesis.database import InMemoryExampleDatabase
from rich.console import Console

from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.exploring.exploration import IN_VAIN, Exploration
from ucm_cts.harness.exploring.in_runs import exploration_in, remember_in
from ucm_cts.harness.exploring.memory import Memory
from ucm_cts.harness.exploring.printing import found_text
from ucm_cts.harness.hosting.locate import locate

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("here")]

WAITED = "calls of what is removed or not started waited for ever"


def remembered_files(database: Path) -> list[Path]:
    return [path for path in database.rglob("*") if path.is_file() and b"scenario" in path.read_bytes()]


def test_a_failure_is_reported_once_with_its_shortest_scenario(found: Path) -> None:
    reported = exploration(found)
    (failure,) = reported["failures"]
    assert (failure["requirement"], failure["clause"]) == (REQUIREMENT, "11.2.2.1")
    assert failure["steps"] == ["add_component", "add_component", "start", "stop"]
    assert failure["expected"] != failure["observed"]
    assert reported["incidents"] == []
    assert reported["known"] == []
    assert 0 < reported["rows_visited"] <= reported["rows"] == len(load_life_cycle().rows)
    assert [path.name for path in (found / "failures").iterdir()] == [f"{REQUIREMENT}.json"]


def test_the_saved_scenario_replays(found: Path) -> None:
    (failure,) = exploration(found)["failures"]
    wrong = ucm_cts("replay", found / failure["file"], SUBJECT)
    assert (wrong.status, "1 finding" in wrong.out) == (1, True)
    assert ucm_cts("replay", found / failure["file"], REFERENCE).status == 0
    assert failure["replay"] == f"ucm-cts replay failures/{REQUIREMENT}.json {SUBJECT}"


def first_failing(seed: int) -> tuple[int, list[bytes]]:
    """How many scenarios it took, and the first few of them."""
    memory = Memory(InMemoryExampleDatabase(), "", "container")
    with Driver(locate(SUBJECT, in_process=True), seed) as driver:
        exploring = Exploration(Campaign(driver, "container"), driver.seed, memory)
        drawn = [
            msgspec.json.encode(purpose.scenarios) for purpose, _ in zip(exploring._purposes(), range(5), strict=False)
        ]
        return next(far.scenarios for far in exploring.explore() if far.failures), drawn


def test_a_failure_is_remembered_as_soon_as_it_is_seen() -> None:
    database = InMemoryExampleDatabase()
    with Driver(locate(SUBJECT, in_process=True), 5) as driver:
        exploring = Exploration(Campaign(driver, "container"), 5, Memory(database, "", "container"))
        for far in exploring.explore():
            if far.failures:
                break
    (kept,) = Memory(database, "", "container").recall()
    assert kept.requirement == REQUIREMENT


def test_a_seed_repeats_everything() -> None:
    number, drawn = first_failing(5)
    assert number <= 50
    assert first_failing(5) == (number, drawn)
    assert first_failing(6)[1] != drawn


def test_conformant_frameworks_are_not_failed(here: Path) -> None:
    for profile in "container", "core":
        arguments = REFERENCE, "--budget", "60scenarios", "--profile", profile, "--seed", "3", "--out", profile
        outcome = ucm_cts("explore", *arguments)
        assert (outcome.status, outcome.err) == (0, "")
        assert "✓ nothing found" in outcome.out
        reported = exploration(here / profile)
        assert reported["scenarios"] == 60
        assert reported["failures"] == reported["incidents"] == []


def test_calls_may_wait_for_a_start_that_never_comes(here: Path) -> None:
    variant = "ucm_cts.adapters.mutants.python:calls_wait_for_the_start"
    arguments = "--budget", "12scenarios", "--seed", "4", "--timeout", "0.5", "--out", "out"
    outcome = ucm_cts("explore", variant, *arguments)
    assert (outcome.status, outcome.err) == (0, "")
    assert WAITED in " ".join(outcome.out.split())
    assert exploration(here / "out")["incidents"] == []
    assert remembered_files(here / "out" / "examples") == []


def test_crashes_are_failures_and_do_not_end_it(here: Path) -> None:
    outcome = ucm_cts("explore", "subjects:Crashing", "--budget", "40scenarios", "--seed", "2", "--out", "out")
    assert (outcome.status, outcome.err) == (1, "")
    reported = exploration(here / "out")
    assert {mishap["kind"] for mishap in reported["incidents"]} <= {"crash", "untried"}
    (crash,) = (failure for failure in reported["failures"] if failure["cause"] == "start crash")
    assert crash["steps"] == ["add_component", "start", "start"]
    assert ucm_cts("replay", here / "out" / crash["file"], "subjects:Crashing").status == 1


@pytest.mark.parametrize("adapter", ["DiesInAdd", "DiesAtOnce", "HangsInAdd"])
def test_it_ends_when_nothing_can_be_tried_any_more(adapter: str) -> None:
    limits = Limits(seconds=0.2, incident_seconds=0.1)
    with Driver(locate(f"hostile.failing:{adapter}"), 1, limits) as driver:
        memory = Memory(InMemoryExampleDatabase(), "", "container")
        campaign = Campaign(driver, "container")
        *_, far = Exploration(campaign, driver.seed, memory).explore()
        report = campaign.report()
    met, left_out = report.incidents
    assert far.failures == 1
    assert met.incident.kind == ("hang" if adapter == "HangsInAdd" else "exit")
    assert far.scenarios == report.scenarios + left_out.occurrences
    console = Console(file=io.StringIO(), width=200)
    with console.capture() as reported:
        console.print(found_text(report, far, Path("out")))
    assert f"in {far.scenarios} scenarios ({left_out.occurrences} not tried)" in reported.get()
    assert left_out.incident.kind == "untried"
    assert left_out.occurrences >= IN_VAIN


def test_incidents_are_reported_once_remembered_and_tried_first(here: Path) -> None:
    arguments = "--seed", "1", "--database", "kept", "--budget"
    subject = "hostile.failing:DiesAtOnce"
    first = ucm_cts("explore", subject, *arguments, "4scenarios", "--out", "first")
    assert (first.status, first.err) == (1, "")
    assert "seen  in 'explored 1'  exit: exit status 7" in first.out
    assert "✗ 0 causes of failure, 1 of incidents" in first.out
    assert "⚡ exit  4 times  failures/incident-1.json  exit status 7" in first.out
    (mishap,) = exploration(here / "first")["incidents"]
    assert (mishap["kind"], mishap["operation"], mishap["occurrences"]) == ("exit", "", 4)
    assert [path.name for path in (here / "first" / "failures").iterdir()] == ["incident-1.json"]
    assert len(remembered_files(here / "kept")) == 1
    again = ucm_cts("explore", subject, *arguments, "1scenarios", "--out", "again")
    assert "still there      exit  exit status 7" in again.out
    assert exploration(here / "again")["known"][0]["still_there"] is True
    assert len(remembered_files(here / "kept")) == 1
    mended = ucm_cts("explore", REFERENCE, *arguments, "1scenarios", "--out", "mended")
    assert (mended.status, mended.err) == (0, "")
    assert "no longer shown  exit  exit status 7" in mended.out
    assert exploration(here / "mended")["known"] == [
        {"requirement": "", "kind": "exit", "cause": "exit status #", "still_there": False}
    ]
    assert remembered_files(here / "kept") == []


def test_nonsense_answers_are_one_cause_however_many(here: Path) -> None:
    arguments = "--budget", "30scenarios", "--seed", "1", "--out", "out"
    assert ucm_cts("explore", "hostile.failing:AddsNothing", *arguments).status == 1
    (mishap,) = exploration(here / "out")["incidents"]
    assert mishap["kind"] == "refused"
    assert mishap["occurrences"] > 20
    replay = ucm_cts("replay", here / "out" / mishap["file"], "hostile.failing:AddsNothing")
    assert (replay.status, "refused" in replay.out) == (1, True)
    assert len(remembered_files(here / "out" / "examples")) == 1


# what a run draws


def measures(folder: Path) -> Any:
    return json.loads((folder / "report.json").read_text())["measures"]


DRAWN = "scenarios drawn at random"


def test_every_run_of_a_whole_profile_draws_scenarios() -> None:
    for options, drawn in (("--explore", "7scenarios"), 7), (("--explore", "0s"), None), (("-k", "12.10"), None):
        assert ucm_cts("run", MENDED, *options, "--seed", "1", "--out", "out").err == ""
        assert measures(Path("out")).get(DRAWN) == drawn
    wrong = ucm_cts("run", MENDED, "--explore", "often")
    assert (wrong.status, "'often' is no budget" in wrong.err) == (2, True)


def test_what_a_run_has_drawn_is_tried_again_by_the_next_one(found: Path) -> None:
    shutil.copytree(found / "examples", "out/examples")
    arguments = "--explore", "1scenarios", "--seed", "1", "--out", "out"
    wrong = ucm_cts("run", SUBJECT, *arguments)
    assert (wrong.status, f"✗ {REQUIREMENT}" in wrong.out) == (1, True)
    before = remembered_files(Path("out/examples"))
    assert before
    assert ucm_cts("run", MENDED, *arguments).status == 0
    assert remembered_files(Path("out/examples")) == []


def test_what_only_a_drawn_scenario_shows_is_remembered_when_it_has_been_shortened(tmp_path: Path) -> None:
    with Driver(locate(SUBJECT), 1) as driver:
        campaign = Campaign(driver, "container")
        exploration = exploration_in(tmp_path, campaign, 1)
        for far in exploration.explore():
            if far.failures:
                break
        failures = exploration.failures
        assert {finding.requirement for finding, _ in failures if finding is not None} == {REQUIREMENT}
        assert list(campaign.shorten())
        report = campaign.report()
    assert remember_in(tmp_path, report) == ""
    assert len(remembered_files(tmp_path / "examples")) == 1


def test_a_call_that_waits_for_a_start_is_no_incident_of_a_run() -> None:
    variant = "ucm_cts.adapters.mutants.python:calls_wait_for_the_start"
    limits = Limits(0.5)
    with Driver(locate(variant), 4, limits) as driver:
        campaign = Campaign(driver, "container")
        exploring = Exploration(campaign, 4, None)
        assert [far.failures for far, _ in zip(exploring.explore(), range(12), strict=False)] == [0] * 12
        report = campaign.report()
    assert report.incidents == ()
    assert any(WAITED in warning for warning in report.warnings)


# how it ends


def test_an_interrupt_keeps_the_failures_found(here: Path) -> None:
    os.mkfifo(here / "calls")
    calls = os.open(here / "calls", os.O_RDWR)
    environment = {**os.environ, "CALL_RECORD": str(here / "calls")}
    command = [sys.executable, "-m", "ucm_cts", "explore", "subjects:Waiting", "--budget", "2h", "--timeout", "600"]
    with subprocess.Popen(
        [*command, "--out", "out"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment
    ) as process:
        assert select.select([calls], [], [], 60)[0], "it never started"
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
    os.close(calls)
    assert (process.returncode, err) == (1, "")
    assert "interrupted: what was found so far is kept" in out
    assert exploration(here / "out")["scenarios"] >= 0
