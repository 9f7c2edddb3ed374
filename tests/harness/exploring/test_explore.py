"""Exploration draws scenarios, shortens failures, reports each once, remembers it and tries it first next time."""

from __future__ import annotations

import io
import json
import os
import random
import select
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import msgspec
import pytest
from command_line import ucm_cts, within
from hypothesis.database import DirectoryBasedExampleDatabase, InMemoryExampleDatabase
from rich.console import Console

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.campaign import WAITED, Campaign
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.exploring.changing import LONGEST, changed
from ucm_cts.harness.exploring.core_writer import CoreWriter
from ucm_cts.harness.exploring.exploration import IN_VAIN, Exploration
from ucm_cts.harness.exploring.memory import Memory, Remembered
from ucm_cts.harness.exploring.novelty import Guide
from ucm_cts.harness.exploring.predicted_coverage import transitions
from ucm_cts.harness.exploring.printing import found_text
from ucm_cts.harness.exploring.writer import Writer
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.scripts import Script, problems, to_scenario
from ucm_cts.harness.results.incident_causes import DistinctIncidents, cause_of_incident
from ucm_cts.harness.results.incidents import may_wait
from ucm_cts.harness.results.values import Execution, Incident, IncidentKind

pytestmark = pytest.mark.slow

SUBJECT, REQUIREMENT = "subjects:stops_in_startup_order", "R-11.2.2.1-13"
MENDED = "subjects:Mended"
REFERENCE = "ucm_cts.adapters.reference.python.adapter:ReferenceAdapter"


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    within(tmp_path, monkeypatch)
    return tmp_path


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of an exploration that has found the one defect of its subject."""
    folder = tmp_path_factory.mktemp("found")
    with pytest.MonkeyPatch.context() as patch:
        within(folder, patch)
        outcome = ucm_cts("explore", SUBJECT, "--budget", "60scenarios", "--seed", "1", "--out", folder / "out")
    assert (outcome.status, outcome.err) == (1, "")
    assert f"✗ {REQUIREMENT}" in outcome.out
    assert "ucm-cts replay " in outcome.out
    return folder / "out"


def remembered_files(database: Path) -> list[Path]:
    return [path for path in database.rglob("*") if path.is_file() and b"scenario" in path.read_bytes()]


def exploration(folder: Path) -> Any:
    return json.loads((folder / "exploration.json").read_text())


# what it finds


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
    assert "scenarios hung in calls that may wait for a component to be started: no failure" in " ".join(
        outcome.out.split()
    )
    assert {mishap["kind"] for mishap in exploration(here / "out")["incidents"]} == {"hang"}
    assert remembered_files(here / "out" / "examples") == []


BODY = 1, 1, 0, "one", 1
STARTED = (t.Create(*BODY), t.Enter(*BODY, "on_startup"), t.Exit(*BODY, "on_startup"))
STOPPED = (*STARTED, t.Enter(*BODY, "on_shutdown"))
INVOKED = t.Call(1, 1, 0, 0)
ASKED = t.Request(*BODY, "out.api", 1)


@pytest.mark.parametrize(
    ("trace", "may"),
    [
        ((t.Create(*BODY), INVOKED), True),
        ((*STARTED, INVOKED), False),
        ((*STOPPED, INVOKED), True),
        ((t.Create(*BODY), INVOKED, t.Return(1, 1, 0, 0)), False),
        ((*STARTED[:2], ASKED), True),
        ((*STARTED[:2], ASKED, t.Reply(*BODY, "out.api", 1)), False),
        ((*STARTED, ASKED), False),
        ((), False),
    ],
)
def test_traces_that_may_wait(trace: t.Trace, may: bool) -> None:
    assert may_wait(Scenario({}, (s.Invoke("one", 1),)), trace) == may


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


def test_failures_hidden_by_incidents_stay_remembered() -> None:
    database = InMemoryExampleDatabase()
    failure = remember(database, "product")
    memory = Memory(database, "product", "container")
    for adapter, seconds in (("DiesInAdd", 60.0), ("DiesInAdd", 0.0), ("DiesAtOnce", 60.0)):
        with Driver(locate(f"hostile.failing:{adapter}"), 1, Limits(incident_seconds=seconds)) as driver:
            (replayed,) = Exploration(Campaign(driver, "container"), 1, memory).replay()
        assert (replayed.remembered, replayed.fate) == (failure, "unknown")
        assert memory.recall() == [failure]


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


def test_a_call_that_waits_for_a_start_is_no_incident_of_a_run() -> None:
    variant = "ucm_cts.adapters.mutants.python:calls_wait_for_the_start"
    limits = Limits(0.5)
    with Driver(locate(variant), 4, limits) as driver:
        campaign = Campaign(driver, "container")
        exploring = Exploration(campaign, 4, None, may_wait=True)
        assert [far.failures for far, _ in zip(exploring.explore(), range(12), strict=False)] == [0] * 12
        report = campaign.report()
    assert report.incidents == ()
    assert report.effort.measures[WAITED] > 0


# which incidents are the same


def incident(
    kind: IncidentKind, detail: str, *trace: t.Event, names: tuple[str, ...] = (), steps: int = 1
) -> Execution:
    scenario = Scenario({name: s.Declaration() for name in names}, (s.Start(),) * steps)
    return Execution("drawn", scenario, trace, Incident(kind, detail))


CALLED = t.Call(1, 1, 0, 0)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (incident("crash", "SIGSEGV"), incident("crash", "SIGABRT")),
        (incident("crash", "SIGSEGV"), incident("exit", "SIGSEGV")),
        (incident("crash", "SIGSEGV", CALLED), incident("crash", "SIGSEGV")),
        (incident("refused", "no bolts\nat 1"), incident("refused", "no nuts\nat 1")),
    ],
)
def test_incidents_with_different_causes(one: Execution, other: Execution) -> None:
    assert cause_of_incident(one) != cause_of_incident(other)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (incident("hang", "no answer within 0.5 s", CALLED), incident("hang", "no answer within 12 s", CALLED)),
        (incident("refused", "at 0x7f00aa"), incident("refused", "at 0x11")),
        (incident("refused", "id 3f2a9c0e-11aa"), incident("refused", "id 77777777-eeee")),
        (incident("refused", "bolts\nline 1"), incident("refused", "bolts\nline 2 and more")),
        (incident("refused", "bob is odd", names=("bob",)), incident("refused", "ann is odd", names=("ann",))),
        (incident("hang", "never came back: worker1, worker2"), incident("hang", "never came back: worker6")),
    ],
)
def test_incidents_with_one_cause(one: Execution, other: Execution) -> None:
    assert cause_of_incident(one) == cause_of_incident(other)


def test_the_shortest_scenario_of_each_cause_of_incidents_is_kept() -> None:
    unknown = incident("crash", "SIGSEGV")
    known = [incident("crash", "SIGSEGV", CALLED, steps=steps) for steps in (5, 3, 4)]
    odd = msgspec.structs.replace(unknown, incident=Incident("crash", "SIGSEGV", reproduced=False))
    distinct = DistinctIncidents()
    for execution in unknown, *known, unknown, odd, incident("hang", "no answer"):
        distinct.add(execution)
    assert [(report.execution, report.occurrences) for report in distinct.reports] == [
        (known[1], 5),
        (odd, 1),
        (incident("hang", "no answer"), 1),
    ]


def test_calls_that_may_wait_are_another_cause() -> None:
    scenario = Scenario({}, (s.Invoke("one", 1),))
    hang = Execution("drawn", scenario, (*STARTED, INVOKED), Incident("hang", "no answer"))
    waits = msgspec.structs.replace(hang, trace=(*STOPPED, INVOKED))
    assert cause_of_incident(hang)[:3] == cause_of_incident(waits)[:3]
    assert cause_of_incident(hang) != cause_of_incident(waits)


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


# what it remembers


def test_remembered_failures_are_tried_first(found: Path, here: Path) -> None:
    shutil.copytree(found / "examples", "examples")
    arguments = "--budget", "1scenarios", "--seed", "1", "--database", "examples", "--out"
    again = ucm_cts("explore", SUBJECT, *arguments, "again")
    assert (again.status, again.err) == (1, "")
    assert f"still there      {REQUIREMENT}" in again.out
    assert exploration(here / "again")["scenarios"] == 1
    (failure,) = exploration(here / "again")["failures"]
    assert failure["steps"] == ["add_component", "add_component", "start", "stop"]
    mended = ucm_cts("explore", MENDED, *arguments, "mended")
    assert (mended.status, mended.err) == (0, "")
    assert f"no longer shown  {REQUIREMENT}" in mended.out
    assert exploration(here / "mended")["known"][0]["still_there"] is False
    once_more = ucm_cts("explore", MENDED, *arguments, "once more")
    assert exploration(here / "once more")["known"] == []
    assert REQUIREMENT not in once_more.out


def test_shared_databases_are_read_and_not_written(found: Path) -> None:
    shutil.copytree(found / "examples", "shared")
    before = {path: path.read_bytes() for path in Path("shared").rglob("*") if path.is_file()}
    databases = "--database", "own", "--database", "readonly:shared", "--budget", "1scenarios", "--out", "out"
    outcome = ucm_cts("explore", SUBJECT, *databases)
    assert "still there" in outcome.out
    assert any(path.is_file() for path in Path("own").rglob("*"))
    assert "no longer shown" in ucm_cts("explore", MENDED, *databases).out
    assert {path: path.read_bytes() for path in Path("shared").rglob("*") if path.is_file()} == before


def test_any_database_of_hypothesis_can_be_plugged_in(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(here))
    (here / "our_database.py").write_text(
        "from hypothesis.database import InMemoryExampleDatabase\ndatabase = InMemoryExampleDatabase()\n"
    )
    arguments = "--database", "our_database:database", "--seed", "1", "--out", "out", "--budget"
    assert ucm_cts("explore", SUBJECT, *arguments, "60scenarios").status == 1
    assert "still there" in ucm_cts("explore", SUBJECT, *arguments, "1scenarios").out


def remember(database: Any, product: str, steps: int = 0) -> Remembered:
    twice = s.AddComponent("one"), s.AddComponent("two"), s.Start(), s.Stop(), *([s.GetComponents()] * steps)
    scenario = Scenario({"one": s.Declaration(), "two": s.Declaration()}, twice)
    failure = Remembered(REQUIREMENT, "rule", "order", "it did not", scenario)
    Memory(database, product, "container").remember(failure)
    return failure


def test_one_scenario_is_kept_for_each_cause() -> None:
    database = InMemoryExampleDatabase()
    memory = Memory(database, "product", "container")
    remember(database, "product", 3)
    short = remember(database, "product", 0)
    assert memory.recall() == [short]
    remember(database, "product", 3)
    assert len(memory.recall()) == 1
    assert Memory(database, "product", "core").recall() == []
    assert Memory(database, "another", "container").recall() == []
    memory.forget(short.identity)
    assert memory.recall() == []


def test_unreadable_remembered_failures_are_reported_and_kept(here: Path) -> None:
    remember(DirectoryBasedExampleDatabase("kept"), "stops_in_startup_order")
    (entry,) = (p for p in Path("kept").rglob("*") if p.is_file() and b"add_component" in p.read_bytes())
    entry.write_bytes(b"{")
    outcome = ucm_cts("explore", MENDED, "--database", "kept", "--budget", "1scenarios", "--out", "out")
    assert (outcome.status, outcome.err) == (0, "")
    assert "1 remembered failures cannot be read by this version and are left alone" in outcome.out
    assert entry.read_bytes() == b"{"


@pytest.mark.parametrize(
    ("arguments", "reported"),
    [
        (
            ("--budget", "soon"),
            "'soon' is no budget; write a time or a number of scenarios: 60s, 5m, 2h, 500scenarios.",
        ),
        (("--budget", "0s"), "'0s' is no budget"),
        (("--budget", "60"), "'60' is no budget"),
        (("--budget", "1.5scenarios"), "'1.5scenarios' is no budget"),
        (("--database", "file"), "failures cannot be kept in 'file': File exists"),
        (("--database", ""), "'' names no database; a database is a folder, readonly:folder, or package.module:NAME"),
        (("--database", "readonly:"), "'readonly:' names no database"),
        (("--database", "readonly:nowhere"), "there is no folder 'nowhere' to read failures from"),
        (("--database", "nowhere:database"), "the database 'nowhere:database' cannot be loaded: ModuleNotFoundError"),
        (("--database", "json:loads"), "'json:loads' is a function and no hypothesis ExampleDatabase"),
        (("--out", "file/out"), "the report cannot be written to 'file/out'"),
        (("--profile", "nonsense"), "'nonsense' is not one of"),
    ],
)
def test_wrong_use_gives_one_line(here: Path, arguments: tuple[str, str], reported: str) -> None:
    (here / "file").write_text("")
    outcome = ucm_cts("explore", REFERENCE, *arguments)
    assert outcome.status == 2
    assert reported in outcome.err.replace("\n", " ")


# what it draws


def drawn(seed: int, number: int) -> list[Scenario]:
    """Scenarios, each new, or one of those before it changed."""
    choose = random.Random(seed)
    scenarios: list[Scenario] = []
    for index in range(number):
        if index % 3 == 0:
            scenarios.append(Writer(choose.choice).scenario())
        elif index % 10 == 1:
            scenarios.append(CoreWriter(choose.choice).scenario())
        else:
            known = choose.choice([scenario for scenario in scenarios if not scenario.interfaces])
            scenarios.append(changed(known, choose.choice))
    return scenarios


def test_drawn_scenarios_can_be_saved_read_and_predicted() -> None:
    scenarios = drawn(1, 300)
    table = load_life_cycle()
    for scenario in scenarios:
        script = msgspec.convert({"scenario": "drawn", **msgspec.to_builtins(scenario)}, Script)
        assert to_scenario(script) == scenario
        assert problems(script) == []
        assert bool(transitions(table, scenario)) == bool(scenario.steps)
    assert len({msgspec.json.encode(scenario) for scenario in scenarios}) > 250
    assert max(len(scenario.steps) for scenario in scenarios) > LONGEST // 2


def test_transitions_follow_the_model() -> None:
    one = s.AddComponent("one"), s.Start(), s.Stop()
    scenario = Scenario({"one": s.Declaration()}, one)
    found = transitions(load_life_cycle(), scenario)
    assert ("then", "configured/start/", "ready/stop/started") in found or any(
        "configured/start" in before and "ready/stop" in after for _, before, after in (t for t in found if len(t) == 3)
    )
    assert transitions(load_life_cycle(), msgspec.structs.replace(scenario, steps=one[:2])) < found


def test_rare_transitions_are_preferred() -> None:
    usual = Scenario({"one": s.Declaration()}, (s.AddComponent("one"), s.Start(), s.Stop()))
    rare = Scenario({"one": s.Declaration()}, (s.AddComponent("one"), s.Start(), s.RemoveComponent("one")))
    guide = Guide(load_life_cycle())
    guide.choose([usual])
    assert guide.choose([usual, rare]) is rare
    assert guide.choose([usual]) is usual
