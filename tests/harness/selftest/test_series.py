"""Series: repeated runs in one table."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from ucm_cts.harness.selftest import series
from ucm_cts.harness.selftest.series import SeriesRun, markdown


def report_on(name: str, verdict: str = "conformant", **verdicts: str) -> SeriesRun:
    reasons = {"R-2": "unstable: seen once"} if verdict == "inconclusive" else {}
    return SeriesRun(name, verdict, {"R-1": "pass", "R-2": "pass"} | verdicts, reasons, 0, 1.5, {})


def run(monkeypatch: pytest.MonkeyPatch, runs: list[SeriesRun], *options: str) -> tuple[int, str]:
    waiting = iter(runs)
    monkeypatch.setattr(series, "one_run", lambda *asked: next(waiting))
    done = CliRunner().invoke(series.main, ["reference-py", "--runs", str(len(runs)), *options])
    return done.exit_code, done.output


def test_steady_series_succeeds(monkeypatch: pytest.MonkeyPatch) -> None:
    status, output = run(monkeypatch, [report_on("1"), report_on("2")])
    assert status == 0
    assert output.count("none") == 2


def test_changed_verdict_is_reported_and_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    flipped = {"R-2": "inconclusive"}
    status, output = run(monkeypatch, [report_on("1"), report_on("2", "inconclusive", **flipped)])
    assert status == 1
    assert "2: R-2 inconclusive: unstable: seen once" in output


def test_same_failure_each_time_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    status, _ = run(monkeypatch, [report_on(name, "not conformant", **{"R-1": "fail"}) for name in "12"])
    assert status == 1


def test_page_has_a_row_for_runs_that_came_out_alike(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    page = tmp_path / "series.md"
    runs = [report_on("1"), report_on("2"), report_on("3", **{"R-2": "fail"})]
    run(monkeypatch, runs, "--out", str(page))
    assert page.read_text() == markdown("reference-py, profile core, 3 runs", runs)
    assert page.read_text().splitlines()[-2:] == [
        "| conformant | 2 | 0 | 0 | 0 | 0 | none | 2 | 1; 2 |",
        "| conformant | 1 | 1 | 0 | 0 | 0 | R-2 | 1 | 3 |",
    ]
