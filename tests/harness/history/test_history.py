"""``ucm-cts history``: what it keeps and shows, and that nothing foreign is written to and nothing measured is lost."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import duckdb
import msgspec
import pytest
from command_line import Outcome, ucm_cts
from made_up_run import HOSTILE
from report_entries import FINDING, report, requirement

from ucm_cts.harness.history import store
from ucm_cts.harness.history.store import append, read
from ucm_cts.harness.history.trends import trends
from ucm_cts.harness.report.json_report import ReportEntry, RequirementEntry

ONE, TWO = "R-11.2.2.1-01", "R-11.2.2.1-13"


def run(day: int, one: Any = "pass", two: Any = "pass", **changed: Any) -> ReportEntry:
    entries = [one if isinstance(one, RequirementEntry) else requirement(ONE, one), requirement(TWO, two)]
    made = {
        "version": f"1.{day}",
        "started": f"2026-03-{day:02}T12:00:00+00:00",
        "seconds": 10.0,
        "seconds_by_clause": {},
    }
    return report("Acme", *entries, **{**made, **changed})


def save(folder: Path, *reports: ReportEntry) -> Path:
    for number, content in enumerate(reports):
        (folder / str(number)).mkdir(parents=True)
        (folder / str(number) / "report.json").write_bytes(msgspec.json.encode(content))
    return folder


def refused(outcome: Outcome) -> str:
    assert (outcome.status, outcome.out, outcome.err.count("\n")) == (2, "", 1), outcome
    assert outcome.err.startswith("ucm-cts: ")
    return outcome.err


def test_runs_are_appended_once_and_shown_in_the_order_of_time(here: Path) -> None:
    reports = save(here / "reports", run(3, two="fail"), run(1), run(2))
    first = ucm_cts("history", reports)
    assert (first.status, first.err) == (0, "")
    said = first.out.splitlines()
    assert said[:2] == ["3 runs appended to ucm-cts-history.duckdb, 0 known", "Acme, profile container: 3 runs"]
    assert [line.split()[:6] for line in said[2:5]] == [
        ["2026-03-01", "12:00", "1.1", "✓", "conformant:", "✓"],
        ["2026-03-02", "12:00", "1.2", "✓", "conformant:", "✓"],
        ["2026-03-03", "12:00", "1.3", "✗", "not", "conformant:"],
    ]
    assert f"✗ {TWO}  fail: first bad version 1.3 (2026-03-03), last good 1.2 (2026-03-02)  Title of {TWO}" in first.out
    again = ucm_cts("history", reports)
    assert again.out.splitlines()[0] == "0 runs appended to ucm-cts-history.duckdb, 3 known"
    shown = ucm_cts("history")
    assert shown.out.splitlines() == said[1:]
    (trend,) = json.loads(ucm_cts("history", "--json").out)
    assert [entry["version"] for entry in trend["runs"]] == ["1.1", "1.2", "1.3"]
    assert trend["counts"][2] == {"pass": 1, "fail": 1}


def trend_of(path: Path, *reports: ReportEntry) -> Any:
    append(path / "history.duckdb", reports)
    (trend,) = trends(read(path / "history.duckdb"))
    return trend


@pytest.mark.parametrize(
    ("verdicts", "since", "last_good", "flips"),
    [
        (["pass", "fail", "fail"], "1.2", "1.1", 1),
        (["pass", "fail", "inconclusive"], "1.2", "1.1", 2),
        (["fail", "pass", "fail"], "1.3", "1.2", 2),
        (["fail", "fail", "fail"], "1.1", None, 0),
        (["pass", "not applicable", "fail"], "1.3", "1.1", 1),
    ],
)
def test_first_bad_version(verdicts: list[str], since: str, last_good: str | None, flips: int, tmp_path: Path) -> None:
    (broken,) = trend_of(tmp_path, *(run(day, verdict) for day, verdict in enumerate(verdicts, 1))).broken
    assert broken.requirement == ONE
    assert (broken.since.version, broken.last_good and broken.last_good.version) == (since, last_good)
    assert broken.flips == flips


def test_known_failures_and_recommendations(tmp_path: Path) -> None:
    known = msgspec.structs.replace(requirement(ONE, "fail"), findings=(msgspec.structs.replace(FINDING, waived="7"),))
    (broken,) = trend_of(tmp_path, run(1), run(2, known)).broken
    assert broken.known
    recommended = msgspec.structs.replace(requirement(ONE, "fail"), level="should", decides=False)
    assert not trend_of(tmp_path, run(3, recommended)).broken


def test_cost_is_compared_with_the_median_of_the_runs_before(tmp_path: Path) -> None:
    costs = [{"11": 1.0, "12": 2.0, "13": 0.1}, {"11": 1.2, "12": 2.0}, {"11": 9.0, "12": 2.1, "13": 0.5}]
    reports = [run(day, seconds=day * 10.0, seconds_by_clause=cost) for day, cost in enumerate(costs, 1)]
    trend = trend_of(tmp_path, *reports)
    assert trend.before == 15.0
    assert [(cost.clause, cost.seconds, cost.before) for cost in trend.dearer] == [("11", 9.0, 1.1)]


def test_times_of_other_zones_are_put_in_order(tmp_path: Path) -> None:
    early, late = run(1, started="2026-03-01T12:00:00+05:00"), run(2, started="2026-03-01T08:00:00+00:00")
    assert [entry.version for entry in trend_of(tmp_path, late, early).runs] == ["1.1", "1.2"]


def test_parts_of_runs_are_left_out(here: Path) -> None:
    partial = run(1, selection="R-11")
    stopped = run(2, incomplete="interrupted", verdict="inconclusive")
    outcome = ucm_cts("history", save(here / "reports", partial, stopped, run(3)))
    assert outcome.out.count("is left out: it is of a part of a run") == 2
    assert "1 run appended to" in outcome.out


def test_several_commands_may_append_at_once(here: Path) -> None:
    processes = []
    for day in range(1, 7):
        folder = save(here / f"reports-{day}", run(day))
        command = [sys.executable, "-m", "ucm_cts", "history", str(folder), "--json"]
        processes.append(subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True))
    assert [(process.communicate()[1], process.returncode) for process in processes] == [("", 0)] * 6
    assert len(read(here / "ucm-cts-history.duckdb").runs) == 6


def test_a_file_that_stays_in_use_is_told_in_one_line(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    reports = save(here / "reports", run(1))
    ucm_cts("history", reports)
    script = (
        "import duckdb, sys; c = duckdb.connect('ucm-cts-history.duckdb'); print('open', flush=True); sys.stdin.read()"
    )
    holder = subprocess.Popen([sys.executable, "-c", script], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert holder.stdout is not None
    assert holder.stdout.readline() == "open\n"
    monkeypatch.setattr(store, "PATIENCE", 0.2)
    try:
        assert "lock" in refused(ucm_cts("history", reports))
    finally:
        holder.communicate("")


def other_tables(path: Path) -> None:
    with duckdb.connect(str(path)) as connection:
        connection.execute("CREATE TABLE invoices (n INTEGER)")


def views_instead_of_tables(path: Path) -> None:
    with duckdb.connect(str(path)) as connection:
        connection.execute("CREATE TABLE ucm_cts_history AS SELECT 1 AS version")
        for name in ("runs", "results", "clauses"):
            connection.execute(f"CREATE VIEW {name} AS SELECT * FROM read_text('/etc/passwd')")


def other_columns(path: Path) -> None:
    with duckdb.connect(str(path)) as connection:
        connection.execute("CREATE TABLE ucm_cts_history AS SELECT 1 AS version")
        for name in ("runs", "results", "clauses"):
            connection.execute(f"CREATE TABLE {name} (id VARCHAR, run VARCHAR)")


def other_version(path: Path) -> None:
    append(path, [run(1)])
    with duckdb.connect(str(path)) as connection:
        connection.execute("UPDATE ucm_cts_history SET version = 9")


def made_up_verdict(path: Path) -> None:
    append(path, [run(1)])
    with duckdb.connect(str(path)) as connection:
        connection.execute("UPDATE runs SET verdict = 'splendid'")


def flipped_bytes(path: Path) -> None:
    append(path, [run(1)])
    content = bytearray(path.read_bytes())
    for place in range(12288, len(content), 4096):
        content[place + 100] ^= 0xFF
    path.write_bytes(content)


def cut_off(path: Path) -> None:
    append(path, [run(1)])
    path.write_bytes(path.read_bytes()[:5000])


MISTAKEN = {
    "other tables": (other_tables, "is a database of something else"),
    "views": (views_instead_of_tables, "is a database of something else"),
    "other columns": (other_columns, "cannot be"),
    "other version": (other_version, "is a history of version 9, and this ucm-cts has 1"),
    "flipped bytes": (flipped_bytes, "cannot be"),
    "cut off": (cut_off, "cannot be"),
    "text": (lambda path: path.write_text("my notes"), "cannot be"),
    "empty": (lambda path: path.write_bytes(b""), "cannot be"),
    "folder": (lambda path: path.mkdir(), "is no file"),
    "pipe": (lambda path: os.mkfifo(path), "is no file"),
    "loop": (lambda path: path.symlink_to(path), "cannot be opened"),
    "link to nowhere": (lambda path: path.symlink_to("nowhere"), "is no file"),
}


@pytest.mark.parametrize("kind", MISTAKEN)
def test_other_files_are_refused_in_one_line_and_stay_as_they_are(kind: str, here: Path) -> None:
    make, problem = MISTAKEN[kind]
    make(here / "file")  # type: ignore[no-untyped-call]
    before = (here / "file").read_bytes() if (here / "file").is_file() else None
    reports = save(here / "reports", run(2))
    assert problem in refused(ucm_cts("history", reports, "--database", "file"))
    assert problem in refused(ucm_cts("history", "--database", "file"))
    assert before is None or (here / "file").read_bytes() == before
    assert {path.name for path in here.iterdir()} == {"file", "reports"}


def test_a_damaged_row_is_told_in_one_line(here: Path) -> None:
    made_up_verdict(here / "file")
    assert "is damaged: Invalid enum value 'splendid'" in refused(ucm_cts("history", "--database", "file"))


@pytest.mark.parametrize(
    ("changed", "problem"),
    [
        ({"started": "yesterday"}, "started 'yesterday', which is no time"),
        ({"scenarios": 2**64 - 1}, "cannot be written"),
    ],
)
def test_a_report_that_cannot_be_kept_keeps_the_history_as_it_was(changed: Any, problem: str, here: Path) -> None:
    ucm_cts("history", save(here / "good", run(1)))
    bad = save(here / "bad", run(2), run(3, **changed))
    assert problem in refused(ucm_cts("history", bad))
    assert [entry.version for entry in read(here / "ucm-cts-history.duckdb").runs] == ["1.1"]


def test_other_wrong_use_is_refused_in_one_line(here: Path) -> None:
    assert "there is no history 'ucm-cts-history.duckdb'" in refused(ucm_cts("history"))
    (here / "empty").mkdir()
    assert "there is no report.json in 'empty'" in refused(ucm_cts("history", "empty"))
    reports = save(here / "reports", run(1))
    missing = refused(ucm_cts("history", reports, "--database", "no/such/folder/file"))
    assert "there is no folder 'no/such/folder' for the history" in missing
    assert not (here / "ucm-cts-history.duckdb").exists()


def test_hostile_texts_stay_text(here: Path) -> None:
    evil = (HOSTILE * 20).replace("\ud800", "") + "\n'); DROP TABLE runs; --"
    entry = msgspec.structs.replace(requirement(ONE, "fail"), title=evil, clause=evil)
    made = msgspec.structs.replace(run(1, entry, seconds_by_clause={evil: 1.0}), product=evil, version=evil)
    for _ in range(2):
        outcome = ucm_cts("history", *([save(here / "reports", made)] if not (here / "reports").exists() else []))
        assert outcome.status == 0
        assert not {"\x1b", "\x00", "\u202e"} & set(outcome.out)
        assert all(len(line) < 300 for line in outcome.out.splitlines())
