"""Verdicts of runs under a statement: parts left out, false claims, and core models."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from types import SimpleNamespace

import pytest
from command_line import report_of
from lxml import etree
from statements import ADAPTER, stating

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.cli.pytest_suite import _undecided
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.models.core_models import CORE
from ucm_cts.harness.report.write import save_report
from ucm_cts.harness.results.statement import Statement, default_statement
from ucm_cts.harness.results.values import Report
from ucm_cts.harness.statement.applicability import purposes_for
from ucm_cts.harness.statement.files import read_statement

pytestmark = pytest.mark.usefixtures("here")


def run(statement: Statement, *requirements: str, adapter: str = ADAPTER) -> Report:
    """A report for profile core, of those purposes that are to exercise ``requirements``."""
    chosen = [p for p in purposes_for(statement, "core") if {*p.requirements} & {*requirements}]
    with Driver(locate(adapter, in_process=True), 1) as driver:
        campaign = Campaign(driver, "core", (), statement)
        list(campaign.check(chosen))
        list(campaign.shorten())
        return campaign.report()


@pytest.mark.parametrize(
    ("adapter", "declared", "verdict"),
    [
        ("ucm_cts.adapters.mutants.python:starts_all_at_a_time", "at-once", "not applicable"),
        ("ucm_cts.adapters.mutants.python:starts_all_at_a_time", "one-by-one", "fail"),
        ("ucm_cts.adapters.mutants.python:starts_all_at_a_time", "observed", "inconclusive"),
        (ADAPTER, "at-once", "fail"),
        (ADAPTER, "one-by-one", "pass"),
        (ADAPTER, "observed", "pass"),
    ],
)
def test_simultaneous_start_has_no_order_to_reverse(adapter: str, declared: str, verdict: str) -> None:
    hasty = default_statement().ixit | {"patience": 100.0}
    statement = stating(readings={"start-order": declared}, ixit=hasty)
    chosen = [p for p in purposes_for(statement, "container") if "R-11.2.2.1-13" in p.requirements]
    with Driver(locate(adapter, in_process=True), 1) as driver:
        campaign = Campaign(driver, "container", (), statement)
        list(campaign.check(chosen))
        assert verdicts(campaign.report(), ["R-11.2.2.1-13"]) == {"R-11.2.2.1-13": verdict}


def verdicts(report: Report, of: Iterable[str] = ()) -> dict[str, str]:
    return {r.id: r.verdict for r in report.requirements if r.id in of or not of}


def test_a_part_left_out_is_a_failure_of_the_core_and_the_rest_of_it_does_not_apply(here: Path) -> None:
    report = run(stating({"clock": False}, source="ics.toml"), "R-10.1.3.2-15", "R-10.1.4.1-08")
    wanted = ("R-10.1-01", "R-10.1.4.1-08", "R-10.1.3.2-15")
    assert verdicts(report, wanted) == dict(zip(wanted, ("fail", "not applicable", "pass"), strict=True))
    assert report.verdict == "not conformant"
    results = {r.id: r for r in report.requirements}
    assert results["R-10.1.4.1-08"].reason == "ics.toml says clock = false"
    (failed,) = results["R-10.1-01"].findings
    assert failed.execution is None
    assert failed.finding.observed == "the vendor's statement (ics.toml) leaves out clock"
    save_report(report, here / "out")
    document = report_of(here / "out")
    assert document["statement"]["capabilities"]["clock"] is False
    (entry,) = [r for r in document["requirements"] if r["id"] == "R-10.1-01"]
    assert (entry["findings"][0]["replay"], entry["findings"][0]["scenario"]) == ("", "")
    assert {path.name for path in (here / "out" / "failures").iterdir()} == {"ics.toml"}
    page = etree.HTML((here / "out" / "report.html").read_text())
    cells = {row[0][0].text: row[1].text for row in page.xpath("//section[@id='statement']//tr") if len(row[0])}
    assert (cells["clock"], cells["port_trace"], cells["trace-sink"]) == ("no", "yes", "hook")
    (reported,) = page.xpath("//tbody[@id='R-10.1-01']//section")
    assert not reported.xpath(".//svg")
    assert "Replay" not in "".join(reported.itertext())
    junit = etree.parse(here / "out" / "junit.xml")
    assert junit.xpath("//testcase[starts-with(@name, 'R-10.1-01')]/failure/@message") == [failed.finding.observed]
    assert junit.xpath("//testcase[starts-with(@name, 'R-10.1.4.1-08')]/skipped/@message") == [
        "not applicable: ics.toml says clock = false"
    ]
    again = read_statement(here / "out" / "failures" / "ics.toml")
    assert again.capabilities == report.statement.capabilities


def test_requirement_without_scenario_is_not_green_in_pytest() -> None:
    without = stating({"clock": False})
    everything = SimpleNamespace(checked=purposes_for(without, "core"), statement=without, known=())
    (line,) = [line for line in _undecided(everything, run(without)) if line.startswith("fail ")]  # type: ignore[arg-type]
    assert line.startswith("fail R-10.1-01: expected ")
    everything.checked = ()
    assert _undecided(everything, run(without)) == []  # type: ignore[arg-type]


def test_core_is_claimed_and_there() -> None:
    assert verdicts(run(stating(), "R-10.1.5.1-09"), ["R-10.1-01"]) == {"R-10.1-01": "pass"}


def test_claimed_operation_that_is_not_offered_is_a_false_claim() -> None:
    report = run(stating(), "R-10.1.5.1-09", adapter="subjects:has_no_services")
    assert verdicts(report, ["R-10.1-01"]) == {"R-10.1-01": "fail"}
    honest = run(stating({s.SERVICE_CONNECTOR: False}), "R-10.1.5.1-09", adapter="subjects:has_no_services")
    assert verdicts(honest, ["R-10.1-01", "R-10.1.5.1-09"]) == {"R-10.1-01": "fail", "R-10.1.5.1-09": "not applicable"}


def test_models_give_verdicts(here: Path) -> None:
    models = here / "models"
    models.mkdir()
    for path in CORE.glob("*.xml"):
        (models / path.name).write_text(path.read_text().replace('name="ok" value="0"', 'name="ok" value="7"'))
    (models / "container_services.xml").unlink()
    report = run(stating(models=("models",), folder=str(here), source="ics.toml"))
    results = {r.id: r for r in report.requirements}
    (failed,) = results["R-10.1.2-05"].findings
    assert (results["R-10.1.2-05"].verdict, failed.finding.rule) == ("fail", "core_declarations")
    assert failed.finding.observed == "value 7 (return_codes.xml:10)"
    assert results["R-10.1.2-06"].verdict == "pass"
    assert results["R-10.1.2-06"].exercised == 1
    assert results["R-10.1.4.2-20"].verdict == "inconclusive"
    assert results["R-10.1.4.2-20"].reason == "models: what should contain it is missing"
    assert report.readings["comm-ecode-index"] == ("declared-type",)
    save_report(report, here / "out")
    assert "return_codes.xml:10" in (here / "out" / "report.html").read_text()


def test_unusable_models_are_reported_before_the_run(here: Path) -> None:
    for models, problem in ((("none.xml",), "none.xml: cannot be read"), (("bad.xml",), "bad.xml:1: is not XML")):
        (here / "bad.xml").write_text("<a>")
        with pytest.raises(DocumentError, match=problem):
            run(stating(models=models, folder=str(here)))


def test_optional_parts_of_models_do_not_apply(here: Path) -> None:
    for path in CORE.glob("*.xml"):
        text = re.sub(r'<PrimitiveInteger name="log_severity_enumerator_t"[^>]*>', "", path.read_text())
        (here / path.name).write_text(text)
    (result,) = [r for r in run(stating(models=(".",), folder=str(here))).requirements if r.id == "R-10.1.4.2-45"]
    assert (result.verdict, result.exercised) == ("not applicable", 0)
    assert "it may be missing, and it is" in result.reason


def test_without_models_their_requirements_are_open(here: Path) -> None:
    (result,) = [r for r in run(stating()).requirements if r.id == "R-10.1.2-05"]
    assert (result.verdict, result.reason) == ("inconclusive", "models: there is no model to look at")
