"""Recommendations do not decide the verdict, and reports say so; derived requirements give their reason."""

from __future__ import annotations

import json
from pathlib import Path

import msgspec
import pytest
from lxml import etree
from made_up_run import TABLE, sample, wrong_error
from rich.console import Console

from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.cli.explanation import explanation
from ucm_cts.harness.report.comparison import read_report
from ucm_cts.harness.report.summary import summary
from ucm_cts.harness.report.write import write_report
from ucm_cts.harness.results.known_failures import succeeded
from ucm_cts.harness.results.tally import overall
from ucm_cts.harness.results.values import FrameworkReport, RequirementResult, Verdict

NAME = "R-11.2.3-12"


@pytest.fixture
def advised() -> FrameworkReport:
    """A run in which nothing failed but a recommendation."""
    requirements = (
        RequirementResult("R-11.2.2.1-01", "11.2.2.1", "add_component makes an instance", "pass", 9),
        RequirementResult(NAME, "11.2.3", "In this order", "fail", 9, (wrong_error(),), level="should"),
    )
    return sample(requirements=requirements, incidents=(), verdict=overall(requirements, ()))


@pytest.mark.parametrize("verdict", ["fail", "inconclusive", "error"])
def test_recommendations_do_not_decide(verdict: Verdict) -> None:
    kept = RequirementResult("R-1-1", "1", "", "pass", 1)
    advice = RequirementResult("R-1-2", "1", "", verdict, 1, level="should")
    assert overall([kept, advice], ()) == "conformant"
    assert overall([kept, msgspec.structs.replace(advice, level="shall")], ()) != "conformant"
    assert overall([advice], ()) == "inconclusive", "nothing that decides was asked"


def test_each_report_names_a_recommendation_that_was_not_followed(advised: FrameworkReport, tmp_path: Path) -> None:
    assert (advised.verdict, succeeded(advised)) == ("conformant", True)
    write_report(advised, load_requirements(), TABLE, {}, tmp_path)
    console = Console(record=True, width=200)
    console.print(summary(advised))
    printed = console.export_text()
    assert "CONFORMANT" in printed
    assert f"~ {NAME}" in printed
    page = (tmp_path / "report.html").read_text()
    assert "Recommendations not followed" in page
    assert "What to fix first" not in page
    (entry,) = [e for e in json.loads((tmp_path / "report.json").read_text())["requirements"] if e["id"] == NAME]
    assert (entry["verdict"], entry["level"], entry["decides"]) == ("fail", "should", False)
    junit = etree.parse(tmp_path / "junit.xml").getroot()
    assert junit.get("failures") == "0"
    (case,) = junit.xpath(f"//testcase[starts-with(@name, '{NAME}')]")
    assert case.find("skipped").get("message").startswith("recommendation not followed")
    assert read_report(tmp_path / "report.json").verdict == "conformant"


def test_explanations_give_the_reason_of_what_is_derived() -> None:
    console = Console(record=True, width=200)
    console.print(explanation("R-11.2.3-14"), explanation(NAME))
    printed = console.export_text()
    assert "shall, derived" in printed
    assert "Derived: " in printed
    assert "Recommendation: " in printed
