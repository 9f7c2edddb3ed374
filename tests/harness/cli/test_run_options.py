"""Options of ``ucm-cts run`` that choose, order and list: -k, --failed-first, --all; progress off a terminal."""

from __future__ import annotations

import io
import json
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from threading import Event
from typing import Any

import msgspec
import pytest
from command_line import report_of, ucm_cts
from made_up_run import crash, lost_call, missing, sample
from rich.console import Console

from ucm_cts.harness.cli import terminal
from ucm_cts.harness.execution.campaign import Campaign, Checked
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.purposes.selection import asked_by, load_purposes, select
from ucm_cts.harness.report.summary import summary
from ucm_cts.harness.results.incident_causes import DistinctIncidents
from ucm_cts.harness.results.tally import of_selection
from ucm_cts.harness.results.values import RequirementResult

pytestmark = pytest.mark.usefixtures("here")

FAILING, FAILED = "subjects:stops_in_startup_order", "R-11.2.2.1-13"


# -k


def verdicts(folder: Path) -> dict[str, str]:
    return {entry["id"]: entry["verdict"] for entry in report_of(folder)["requirements"]}


def test_selection_has_a_verdict_of_its_own(here: Path) -> None:
    outcome = ucm_cts("run", "reference-py", "-k", FAILED, "--out", "out")
    assert (outcome.status, outcome.err) == (0, "")
    assert f"✓ CONFORMANT  UCM-CTS reference framework (Python) 1, profile container, only -k {FAILED}" in outcome.out
    assert verdicts(here / "out")[FAILED] == "pass"
    assert set(verdicts(here / "out").values()) == {"pass"}
    assert f"-k {FAILED}" in (here / "out" / "report.html").read_text()
    refused = ucm_cts("results", "out", "--out", "published")
    assert (refused.status, "of a selection (-k)" in refused.err) == (2, True)


def test_selection_that_shows_a_failure_fails(here: Path) -> None:
    outcome = ucm_cts("run", FAILING, "-k", FAILED, "--out", "out")
    assert outcome.status == 1
    assert verdicts(here / "out")[FAILED] == "fail"


def test_only_what_was_asked_for_is_inconclusive() -> None:
    whole = sample(incidents=())
    kept = [result for result in whole.requirements if result.verdict == "pass"]
    asked, not_asked = (RequirementResult(f"R-11.9-{n}", "11.9", "t", "inconclusive", 0) for n in (10, 11))
    report = of_selection(sample(requirements=(*kept, asked, not_asked), incidents=()), "x", {asked.id})
    assert report.requirements == (*kept, asked)
    assert (report.verdict, report.selection) == ("inconclusive", "x")
    assert of_selection(report, "x", {kept[0].id}).verdict == "conformant"


def test_expression_asks_for_what_it_names() -> None:
    purposes = load_purposes("container")
    assert asked_by(select(purposes, FAILED.lower()), FAILED.lower()) == {FAILED}
    (one,) = [purpose for purpose in purposes if purpose.id == "stop-during-a-call"]
    assert asked_by([one], "stop-during-a-call") == {*one.requirements}
    by_clause = asked_by(select(purposes, "12.10"), "12.10")
    assert {id_ for id_ in by_clause if id_.startswith("R-12.10-")} >= {"R-12.10-09", "R-12.10-15"}


# --failed-first


def test_what_failed_in_the_last_run_comes_first(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    order: list[tuple[str, ...]] = []
    check = Campaign.check

    def watched(campaign: Campaign, purposes: Iterable[TestPurpose]) -> Iterator[Checked]:
        order[:] = [purpose.requirements for purpose in purposes]
        return check(campaign, purposes)

    monkeypatch.setattr(Campaign, "check", watched)
    selection = ("-k", "R-12.10-15 or R-11.2.2.1-13", "--out", "out")
    outcome = ucm_cts("run", FAILING, *selection, "--failed-first")
    assert "--failed-first changes nothing: out/report.json: cannot be read" in outcome.out
    usual = list(order)
    ucm_cts("run", FAILING, *selection, "--failed-first")
    assert sorted(order) == sorted(usual)
    with_it = sum(FAILED in requirements for requirements in usual)
    assert not all(FAILED in requirements for requirements in usual[:with_it])
    assert all(FAILED in requirements for requirements in order[:with_it])


# what the terminal shows


def many() -> Any:
    failures = tuple(
        RequirementResult(f"R-11.9-{number:02}", "11.9", "Long title " * 20, "fail", 9, (lost_call(), missing()))
        for number in range(50)
    )
    undecided = RequirementResult("R-11.9-99", "11.9", "Undecided", "inconclusive", 0, reason="nobody asked")
    incidents = tuple(crash(f"kind {chr(97 + number)}") for number in range(20))
    return sample(requirements=(*failures, undecided), incidents=incidents, product="Fancy")


def printed(width: int, **options: bool) -> str:
    plain = io.StringIO()
    console = Console(file=plain, width=width)
    console.print(summary(many(), Path("out"), **options), soft_wrap=any(options.values()))
    return plain.getvalue()


def test_terminal_gets_the_beginning_and_files_get_everything() -> None:
    short = printed(90)
    assert short.count("✗ R-11.9-") == 12
    assert "and 38 more failed requirements (--all lists them)" in short
    assert "and 8 more incidents (--all lists them)" in short
    assert max(map(len, short.splitlines())) <= 90
    whole = printed(90, whole=True)
    assert (whole.count("✗ R-11.9-"), whole.count("⚡ crash")) == (50, 20)
    assert "more failed" not in whole
    assert "Long title Long title Long title Long title Long title Long title Long title Long title" in whole
    assert whole.count("  observed  ") == 50
    everything = printed(90, everything=True)
    assert everything.count("  observed  ") == 100, "each cause"
    assert "? R-11.9-99  Undecided: nobody asked" in everything


def test_incidents_stand_before_failures() -> None:
    text = printed(90)
    assert text.index("⚡ crash") < text.index("✗ R-11.9-")


def test_all_is_an_option(here: Path) -> None:
    outcome = ucm_cts("run", FAILING, "-k", FAILED, "--out", "out", "--all")
    assert outcome.status == 1
    assert f"✗ {FAILED}" in outcome.out


def test_progress_off_a_terminal_is_a_line_now_and_then(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(terminal, "LINE_EVERY", 0.001)
    printed_twice, estimated = Event(), Event()

    class Sink(io.StringIO):
        def write(self, text: str) -> int:
            written = super().write(text)
            if self.getvalue().count("\n") > 1:
                printed_twice.set()
            if re.search(r" s: [45] of 70, about \d+ s more, 2 failing", self.getvalue()):
                estimated.set()
            return written

    sink = Sink()
    monkeypatch.setattr("sys.stdout", sink)
    with terminal.progress_of(terminal.Output()) as progress:
        task = progress.add_task("2 failing, [some] scenario", total=70, completed=3)
        assert printed_twice.wait(60)
        assert all(line.endswith(" s: 3 of 70, 2 failing, [some] scenario") for line in sink.getvalue().splitlines())
        progress.advance(task)
        progress.advance(task)
        assert estimated.wait(60)


# incidents


def test_seven_hundred_incidents_of_one_cause_are_one_with_one_file(here: Path) -> None:
    distinct = DistinctIncidents()
    for number in range(700):
        distinct.add(crash(f"signal 11 at 0x7f{number:06x}").execution, ("R-12.10-09", f"R-11.9-{number % 3:02}"))
    (one,) = distinct.reports
    assert one.occurrences == 700
    assert one.requirements == ("R-11.9-00", "R-11.9-01", "R-11.9-02", "R-12.10-09")
    again = DistinctIncidents()
    for _ in range(2):
        again.add_report(one)
    assert [(item.occurrences, item.requirements) for item in again.reports] == [(1400, one.requirements)]


def test_one_crash_in_many_scenarios_leaves_few_files(here: Path) -> None:
    ucm_cts("run", "subjects:Crashing", "-k", "11.2.2.1", "--incident-time", "2", "--out", "out")
    report = report_of(here / "out")
    crashes = [incident for incident in report["incidents"] if incident["kind"] == "crash"]
    assert len(crashes) == 1
    assert crashes[0]["occurrences"] > 1
    assert "R-11.2.2.1-13" in crashes[0]["requirements"]
    assert len(list((here / "out" / "failures").iterdir())) <= 4
    assert json.loads((here / "out" / crashes[0]["replay"]).read_text())["steps"]


def test_findings_say_what_they_explain(here: Path) -> None:
    found = msgspec.structs.replace(lost_call(), explains=("R-1-01",))
    result = RequirementResult("R-11.1.3-01", "11.1.3", "t", "fail", 1, (found,))
    plain = io.StringIO()
    Console(file=plain, width=90).print(summary(sample(requirements=(result,), incidents=())))
    assert "explains R-1-01" in plain.getvalue()
