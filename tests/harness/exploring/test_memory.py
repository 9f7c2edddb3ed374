"""Remembered failures: tried first, kept, and read from other databases."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest
from command_line import ucm_cts
from explorations import MENDED, REFERENCE, REQUIREMENT, SUBJECT, exploration
from hypothesis.database import DirectoryBasedExampleDatabase, InMemoryExampleDatabase

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.exploring.exploration import Exploration
from ucm_cts.harness.exploring.memory import Memory, Remembered
from ucm_cts.harness.hosting.locate import locate

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("here")]


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


def test_failures_hidden_by_incidents_stay_remembered() -> None:
    database = InMemoryExampleDatabase()
    failure = remember(database, "product")
    memory = Memory(database, "product", "container")
    for adapter, seconds in (("DiesInAdd", 60.0), ("DiesInAdd", 0.0), ("DiesAtOnce", 60.0)):
        with Driver(locate(f"hostile.failing:{adapter}"), 1, Limits(incident_seconds=seconds)) as driver:
            (replayed,) = Exploration(Campaign(driver, "container"), 1, memory).replay()
        assert (replayed.remembered, replayed.fate) == (failure, "unknown")
        assert memory.recall() == [failure]
