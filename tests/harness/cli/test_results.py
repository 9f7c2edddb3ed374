"""``ucm-cts results``: what is published of reports is the same in every run, and the pages follow from it."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest
from command_line import ucm_cts
from files import ROOT
from made_up_run import CATALOGUE, HOSTILE, sample

from ucm_cts.harness.cli.results_command import pages
from ucm_cts.harness.report.json_report import ReportEntry, StatementEntry, to_json
from ucm_cts.harness.report.published import PublishedResult, published, read_published
from ucm_cts.harness.report.published import to_json as to_result
from ucm_cts.harness.report.published_pages import product_page
from ucm_cts.harness.results.foreign import clean_report
from ucm_cts.harness.selftest.kill_record import read_record
from ucm_cts.harness.selftest.matrix import CheatResult, Kill, Matrix, MutantResult, VariantResult

REPORT = msgspec.json.decode(to_json(clean_report(sample()), CATALOGUE), type=ReportEntry)
KILL = Kill("R-11.2.3-01", "restart", "rule", "this", "that", (1,), True, 1)
MATRIX = Matrix(
    "0.1.0",
    1,
    3.5,
    ("R-11.2.3-01", "R-11.2.3-02"),
    (
        MutantResult("right", "It lies.", "11.2.3", ("R-11.2.3-01",), (), (KILL,), (), 3, 0.5),
        MutantResult("lives", "It lies, too.", "11.2.3", ("R-11.2.3-02",), (), (KILL,), (), 3, 0.5),
    ),
    (VariantResult("fine", (), (), 3, 0.5),),
    False,
    (CheatResult("sly", "It cheats.", ("R-11.2.3-01",), (), False, 0.5),),
    is_all=True,
)


def another_run(report: ReportEntry) -> ReportEntry:
    """The same product and verdicts, with everything else as another run could have it."""
    requirements = [
        msgspec.structs.replace(
            r,
            exercised=r.exercised + 5,
            findings=tuple(
                msgspec.structs.replace(f, occurrences=f.occurrences + 1, events=(), replay="elsewhere.json")
                for f in reversed(r.findings)
            ),
        )
        for r in reversed(report.requirements)
    ]
    return msgspec.structs.replace(
        report,
        requirements=tuple(requirements),
        incidents=tuple(reversed(report.incidents)),
        readings=dict(reversed(report.readings.items())),
        adapter="/home/somebody/adapter",
        seed=report.seed + 1,
        started="2031-01-01T00:00:00+00:00",
        seconds=report.seconds * 2,
        scenarios=1,
        events=1,
        measures={"calls": 7},
        seconds_by_clause={},
        runs=3,
    )


def save(folder: Path, report: ReportEntry = REPORT) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "report.json").write_bytes(msgspec.json.encode(report))
    return folder / "report.json"


def test_another_run_of_a_product_gives_the_same_bytes() -> None:
    assert to_result(published(REPORT)) == to_result(published(another_run(REPORT)))


def test_no_verdict_and_no_failure_is_lost() -> None:
    result = msgspec.json.decode(to_result(published(REPORT)), type=PublishedResult)
    assert result == published(REPORT)
    assert {(r.id, r.level, r.verdict) for r in result.requirements} == {
        (r.id, r.level, r.verdict) for r in REPORT.requirements
    }
    assert {(f.requirement, f.clause, f.expected, f.observed, f.scenario) for f in result.failures} == {
        (r.id, r.clause, f.expected, f.observed, f.scenario) for r in REPORT.requirements for f in r.findings
    }
    assert result.failures
    assert len(result.incidents) == len(REPORT.incidents) > 0


def test_a_result_says_of_a_statement_what_concerns_its_profile() -> None:
    stated = StatementEntry(
        "ics.toml",
        REPORT.product,
        REPORT.version,
        (REPORT.profile, "cpp03"),
        {"clock": True, "index-timers": False},
        {"unknown-names": "not-found", "second-connect": "observed", "cpp-byte": "char"},
        {"patience": 50.0},
        (),
    )
    result = published(msgspec.structs.replace(REPORT, profile="core", statement=stated))
    assert result.statement == msgspec.structs.replace(
        stated, capabilities={"clock": True}, readings={"unknown-names": "not-found", "second-connect": "observed"}
    )
    page = product_page([result])
    assert "| unknown-names | not-found |" in page
    assert "second-connect" not in page
    of_code = published(msgspec.structs.replace(REPORT, profile="cpp03", statement=stated)).statement
    assert of_code
    assert (of_code.capabilities, of_code.readings, of_code.ixit) == ({}, {"cpp-byte": "char"}, {})


def test_a_changed_verdict_changes_its_line_only() -> None:
    first = next(r for r in REPORT.requirements if r.verdict == "pass")
    others = tuple(r for r in REPORT.requirements if r is not first)
    changed = msgspec.structs.replace(REPORT, requirements=(*others, msgspec.structs.replace(first, verdict="error")))
    before, after = (to_result(published(report)).splitlines() for report in (REPORT, changed))
    assert [first.id.encode() in line for line in set(after) - set(before)] == [True]
    assert len(before) == len(after)


def test_the_command_keeps_reports_and_matrices_of_folders(tmp_path: Path) -> None:
    save(tmp_path / "reports" / "one")
    (tmp_path / "reports" / "matrix.json").write_bytes(msgspec.json.encode(MATRIX))
    done = ucm_cts("results", tmp_path / "reports", "--out", tmp_path / "out")
    assert (done.status, done.err) == (0, "")
    out = tmp_path / "out"
    folder = published(REPORT).folder
    assert {str(path.relative_to(out)) for path in out.rglob("*") if path.is_file()} == {
        "README.md", "detection/frameworks.jsonl", f"{folder}/README.md", f"{folder}/{REPORT.profile}.json"
    }  # fmt: skip
    kept = {path: path.read_bytes() for path in out.rglob("*.*") if path.is_file()}
    save(tmp_path / "again", another_run(REPORT))
    assert ucm_cts("results", tmp_path / "again", "--out", out).status == 0
    assert {path: path.read_bytes() for path in kept} == kept


def test_a_kill_record_has_a_line_a_subject(tmp_path: Path) -> None:
    (tmp_path / "matrix.json").write_bytes(msgspec.json.encode(MATRIX))
    assert ucm_cts("results", tmp_path / "matrix.json", "--out", tmp_path / "out").status == 0
    record = read_record(tmp_path / "out" / "detection" / "frameworks.jsonl")
    assert (record.self_test.testable, record.self_test.unproved) == (2, ("R-11.2.3-02",))
    lives, right = record.mutants
    assert (right.killed, right.requirements, right.missed, right.spills) == (True, ("R-11.2.3-01",), (), ())
    assert (lives.killed, lives.missed, lives.spills) == (False, ("R-11.2.3-02",), ())
    assert lives.further == ("R-11.2.3-01",)
    assert [variant.spared for variant in record.variants] == [True]
    assert [(cheat.found_out, cheat.requirements) for cheat in record.cheats] == [(False, ("R-11.2.3-01",))]
    assert not record.is_proved
    assert "| frameworks | 1 of 2 | 1 of 2 | 1 of 1 | 0 of 1 |" in (tmp_path / "out" / "README.md").read_text()


def test_hostile_texts_stay_in_their_cells(tmp_path: Path) -> None:
    save(tmp_path, msgspec.structs.replace(REPORT, product=f"{HOSTILE[:40]} | ../..", version="1|2"))
    assert ucm_cts("results", tmp_path, "--out", tmp_path / "out").status == 0
    (page,) = (tmp_path / "out").glob("*/README.md")
    text = page.read_text() + "\n" + (tmp_path / "out" / "README.md").read_text()
    assert "<script" not in text
    tables = [block for block in text.split("\n\n") if block.startswith("|")]
    for block in tables:
        assert len({line.replace("\\|", "").count("|") for line in block.splitlines()}) == 1


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("report.json", "{}", "report.json:1: "),
        ("matrix.json", "{}", "is no kill matrix"),
        ("matrix.json", msgspec.json.encode(msgspec.structs.replace(MATRIX, is_all=False)).decode(), "of a part of"),
        ("other.json", "{}", "there is neither report.json nor matrix.json in"),
    ],
)
def test_incomplete_result_is_refused(tmp_path: Path, name: str, content: str, message: str) -> None:
    (tmp_path / name).write_text(content)
    done = ucm_cts("results", tmp_path, "--out", tmp_path / "out")
    assert done.status == 2
    assert message in done.err
    assert not list(tmp_path.glob("out/*"))


def test_published_pages_are_those_of_the_published_files() -> None:
    folder = ROOT / "results"
    assert {path: path.read_text() for path in folder.rglob("README.md")} == pages(folder)


def test_published_files_are_as_the_command_writes_them() -> None:
    results = read_published(ROOT / "results")
    assert len(results) >= 8
    for result in results:
        path = ROOT / "results" / result.folder / f"{result.profile}.json"
        assert path.read_bytes() == to_result(result)


def test_published_results_are_small() -> None:
    assert sum(path.stat().st_size for path in (ROOT / "results").rglob("*") if path.is_file()) < 600_000
