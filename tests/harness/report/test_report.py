"""The contents of reports, checked on a made-up run with realistic traces and hostile texts."""

from __future__ import annotations

import io
import json
import re
from pathlib import Path
from typing import Any

import jsonschema
import msgspec
import pytest
from lxml import etree, html
from made_up_run import (
    CATALOGUE,
    DECISIONS,
    TABLE,
    TRANSITIONS,
    crash,
    lost_call,
    missing,
    refused_stop,
    results,
    sample,
    wrong_error,
)
from rich.console import Console

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.catalogue.specification import load_specification
from ucm_cts.harness.purposes.scripts import read_scripts, to_scenario
from ucm_cts.harness.report import json_report, order
from ucm_cts.harness.report.diagrams import transitions
from ucm_cts.harness.report.out_folder import MANIFEST
from ucm_cts.harness.report.scope import scope_of
from ucm_cts.harness.report.summary import summary
from ucm_cts.harness.report.write import write_report
from ucm_cts.harness.results.foreign import LONGEST, LONGEST_STACKS, clean, clean_report, one_line
from ucm_cts.harness.results.tally import ended_early
from ucm_cts.harness.results.values import Incident, RequirementResult


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("report")
    write_report(sample(), CATALOGUE, TABLE, DECISIONS, folder)
    return folder


@pytest.fixture(scope="module")
def source(out: Path) -> str:
    return (out / "report.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def page(source: str) -> Any:
    return html.document_fromstring(source)


# The page


def test_the_page_needs_nothing_from_outside(source: str, page: Any) -> None:
    assert not page.xpath("//link | //img | //iframe | //object | //embed | //script[@src] | //*[@src]")
    assert all(link.startswith("#") for link in page.xpath("//@href"))
    assert not re.search(r"url\(|@import|https?:", source)
    assert "default-src 'none'" in page.xpath("//meta[@http-equiv]/@content")[0]


def test_hostile_text_stays_text(source: str, page: Any) -> None:
    assert len(page.xpath("//script")) == 1
    assert len(re.findall(r"</script", source)) == 1
    assert not page.xpath("//*[@onerror]")
    assert "{{ 7*7 }}" in page.xpath("string(//h1)")
    assert page.xpath("//dd[contains(., '<img src=x onerror=alert(2)>')]")
    assert not re.search("[\x00-\x08\x0b-\x1f\x7f\u202e\ud800-\udfff]", source)


def test_the_verdict_comes_before_the_fixes(page: Any) -> None:
    text = page.text_content()
    marks = [
        "Not conformant",
        "What to fix first",
        "Incidents",
        "Life cycle",
        "Provocations",
        "Requirements",
        "Not testable from the outside",
        "Statement (ICS and IXIT)",
        "This run",
    ]
    assert text.index(marks[0]) < text.index(marks[1])
    assert [heading.text_content() for heading in page.xpath("//main//h2")] == marks[1:]
    fixes = page.xpath("//ol[@class='fix']/li/a/@href")
    assert fixes[:2] == ["#incident-1", "#incident-2"]
    assert fixes[2:] == ["#R-11.2.2.1-12", "#R-11.2.1.2-06", "#R-12.10-15", "#R-11.1.3-01"]  # the most often met first


def test_what_explains_most_is_fixed_first() -> None:
    rare, often = results()[2], results()[1]
    found = msgspec.structs.replace(rare.findings[0], explains=("R-11.2.2.1-12", "R-11.2.1.2-06"))
    leading = msgspec.structs.replace(rare, findings=(found,))
    lost = msgspec.structs.replace(crash(), occurrences=2, requirements=("R-11.2.2.1-12", "R-12.10-15"))
    many = msgspec.structs.replace(crash("another"), occurrences=700, requirements=("R-12.10-15",))
    fixes = order.to_fix(sample(requirements=(often, leading), incidents=(many, lost)))
    assert [fix.incident if fix.result is None else fix.result.id for fix in fixes] == [1, 0, rare.id, often.id]


def test_each_failure_has_both_diagrams_the_scenario_and_the_command(page: Any) -> None:
    for result in results():
        sections = page.xpath(f"//tbody[@id='{result.id}']//section")
        assert len(sections) == len(result.findings)
        for section in sections:
            assert len(section.xpath(".//svg")) == 2
            assert section.xpath(".//svg//*[contains(@class, 'expected')]")
            assert section.xpath(".//svg//*[contains(@class, 'offending')]")
            assert "ucm-cts replay failures/" in section.text_content()
            assert "steps:" in section.text_content()


def test_every_link_leads_somewhere(page: Any) -> None:
    names = page.xpath("//@id")
    assert len(names) == len(set(names))
    known = {entry.id for entry in CATALOGUE}
    for link in page.xpath("//@href"):
        # rows of this test's table name requirements that its small catalogue does not have
        assert link[1:] in names or link[1:] not in known


def test_requirements_say_meaning_decision_waiver_and_reason(page: Any) -> None:
    text = page.xpath("//tbody[@id='R-11.2.2.1-12']")[0].text_content()
    assert "Each receives it once." in text
    assert "What was begun may end." in text
    assert "known, ticket 12" in page.xpath("//tbody[@id='R-11.2.1.2-06']")[0].text_content()
    assert "No scenario started a container twice." in page.xpath("//tbody[@id='R-11.2.3-15']")[0].text_content()
    assert "Describes an architecture." in page.xpath("//section[@id='untestable']")[0].text_content()


def test_keyboard_dark_mode_print_and_reading_without_scripts(source: str, page: Any) -> None:
    assert "prefers-color-scheme: dark" in source
    assert "@media print" in source
    assert ":focus-visible" in source
    assert page.xpath("//a[@class='skip']")
    assert page.xpath("//dialog[@id='help']//kbd[text()='/']")
    # the filter is useless without its script, so the script brings it; everything else is there from the start
    assert page.xpath("//div[@class='filter']/@hidden") == [""]
    assert not page.xpath("//main//*[@hidden and not(@class='filter')]")
    assert all(table.xpath(".//thead//th[@scope='col']") for table in page.xpath("//table"))
    assert all(svg.get("role") == "img" and svg.get("aria-label") for svg in page.xpath("//svg"))


@pytest.mark.parametrize("mode", [0, 1], ids=["light", "dark"])
def test_colours_have_the_contrast_that_reading_needs(source: str, mode: int) -> None:
    roots = re.findall(r":root \{(.*?)\}", source, re.DOTALL)
    colours = dict(re.findall(r"--([a-z-]+): (#[0-9a-f]{6})", roots[mode]))
    pairs = [(name, f"{name}-bg") for name in ("pass", "fail", "inc", "err", "na")]
    pairs += [
        (name, back) for name in ("ink", "quiet", "link", "pass", "fail", "inc") for back in ("bg", "card", "sunk")
    ]
    assert {pair: ratio for pair in pairs if (ratio := contrast(colours[pair[0]], colours[pair[1]])) < 4.5} == {}


def contrast(one: str, other: str) -> float:
    """The contrast ratio of WCAG 2."""

    def luminance(colour: str) -> float:
        parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
        red, green, blue = (p / 12.92 if p <= 0.03928 else ((p + 0.055) / 1.055) ** 2.4 for p in parts)
        return 0.2126 * red + 0.7152 * green + 0.0722 * blue

    high, low = sorted((luminance(one), luminance(other)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def test_fifty_failures_stay_below_two_megabytes(tmp_path: Path) -> None:
    failures = tuple(
        RequirementResult(
            f"R-11.9-{i:02}", "11.9", f"Made up {i}", "fail", 9, (lost_call(80), refused_stop(), missing())
        )
        for i in range(50)
    )
    incidents = tuple(crash(stacks="at some place\n" * 100_000) for _ in range(30))
    write_report(sample(requirements=failures, incidents=incidents), CATALOGUE, TABLE, {}, tmp_path)
    assert (tmp_path / "report.html").stat().st_size < 2_000_000
    assert "R-11.9-49" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_a_conformant_report_says_so_and_has_nothing_to_fix(tmp_path: Path) -> None:
    kept = tuple(msgspec.structs.replace(result, verdict="pass", findings=()) for result in results())
    write_report(sample(verdict="conformant", requirements=kept, incidents=()), CATALOGUE, TABLE, {}, tmp_path)
    page = html.document_fromstring((tmp_path / "report.html").read_bytes().decode())
    assert page.xpath("string(//p[@class='word'])") == "Conformant"
    assert not page.xpath("//section[@id='fix' or @id='incidents']")


# The life cycle


def test_transitions_get_the_verdict_of_their_rows(page: Any) -> None:
    found = {
        (t.state, t.next, t.operation): t for t in transitions.transitions(transitions.rows_seen(TABLE, TRANSITIONS))
    }
    assert found["absent", "configured", "add_component"].verdict == "pass"
    assert found["ready", "configured", "stop"].verdict == "fail"
    assert found["ready", "ready", "start"].verdict == "inconclusive"
    assert found["ready", "ready", "remove_component"].verdict == "pass"
    assert not found["ready", "absent", "remove_component"].chosen
    words = {
        t.getparent().get("href"): t.text_content()
        for t in page.xpath("//svg[@class='lc']//text[starts-with(@class, 'op')]")
    }
    assert words["#lc-stop-ready"].startswith("✗ stop")


def test_choices_name_observed_readings() -> None:
    found = {choice.option: choice for choice in transitions.choices(transitions.rows_seen(TABLE, TRANSITIONS))}
    assert found["remove-while-ready"].permitted == ("cascade", "refuse")
    assert found["remove-while-ready"].observed == ("refuse",)
    assert found["double-start"].observed == ()


def test_the_table_lists_every_row_with_counts(page: Any) -> None:
    rows = page.xpath("//table[@class='heat']//li[@id]")
    assert len(rows) == len(TABLE.rows)
    assert "31 of 200 broken" in page.xpath("string(//td[@id='lc-stop-ready'])")
    assert "never" in page.xpath("string(//td[@id='lc-start-ready'])")


# JUnit, JSON, saved scenarios, terminal

JUNIT = """
<grammar xmlns="http://relaxng.org/ns/structure/1.0" datatypeLibrary="http://www.w3.org/2001/XMLSchema-datatypes">
  <start><element name="testsuites"><ref name="counts"/><attribute name="time"/>
    <oneOrMore><element name="testsuite"><ref name="counts"/><attribute name="timestamp"/><attribute name="time"/>
      <element name="properties"><ref name="property"/></element>
      <oneOrMore><element name="testcase">
        <attribute name="classname"/><attribute name="name"/><attribute name="time"/>
        <optional><element name="properties"><oneOrMore>
          <ref name="property"/>
        </oneOrMore></element></optional>
        <optional><choice>
          <element name="failure"><ref name="reported"/></element>
          <element name="error"><ref name="reported"/></element>
          <element name="skipped"><attribute name="message"/></element>
        </choice></optional>
        <optional><element name="system-out"><text/></element></optional>
      </element></oneOrMore>
    </element></oneOrMore>
  </element></start>
  <define name="counts"><attribute name="name"/>
    <attribute name="tests"><data type="integer"/></attribute>
    <attribute name="failures"><data type="integer"/></attribute>
    <attribute name="errors"><data type="integer"/></attribute>
    <attribute name="skipped"><data type="integer"/></attribute>
  </define>
  <define name="property"><element name="property"><attribute name="name"/><attribute name="value"/></element></define>
  <define name="reported"><attribute name="message"/><attribute name="type"/><text/></define>
</grammar>
"""


def test_junit_is_valid_and_no_undecided_requirement_looks_green(out: Path) -> None:
    document = etree.parse(out / "junit.xml")
    schema = etree.RelaxNG(etree.fromstring(JUNIT))
    assert schema.validate(document), schema.error_log
    cases: dict[str, Any] = {case.get("name", "").split()[0]: case for case in document.iter("testcase")}
    assert cases["R-11.2.2.1-01"].find("system-out") is not None
    assert cases["R-11.2.3-15"].find("failure").get("type") == "inconclusive"
    assert cases["R-11.2.3-91"].find("error") is not None
    assert cases["R-11.2.3-90"].find("skipped").get("message") == "not applicable: Declared so by the vendor."
    assert "Describes an architecture." in cases["R-11-01"].find("skipped").get("message")
    assert cases["crash"].find("error").get("type") == "crash"
    assert document.getroot().get("failures") == "4"
    assert document.getroot().get("errors") == "3"
    known = cases["R-11.2.1.2-06"]
    assert known.find("skipped").get("message") == "known failure: known, ticket 12"
    assert properties(known)["known-failure"] == "known, ticket 12"
    assert properties(known)["requirement"] == "R-11.2.1.2-06"
    assert properties(cases["R-11.2.2.1-12"])["verdict"] == "fail"
    assert cases["R-11.2.2.1-01"].get("time") == "1.250"


def properties(case: Any) -> dict[str, str]:
    return {entry.get("name"): entry.get("value") for entry in case.iter("property")}


def test_incomplete_run_says_so_in_all_three_reports(tmp_path: Path) -> None:
    kept = tuple(msgspec.structs.replace(result, verdict="pass", findings=()) for result in results())
    whole = sample(verdict="conformant", requirements=kept, incidents=())
    early = ended_early(whole, "interrupted after 3 of 70 test purposes")
    assert early.verdict == "inconclusive"
    write_report(early, CATALOGUE, TABLE, {}, tmp_path)
    page = html.document_fromstring((tmp_path / "report.html").read_bytes().decode())
    assert "Incomplete: interrupted after 3 of 70" in " ".join(page.xpath("string(//div[@role='status'])").split())
    document = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    assert (document["verdict"], document["incomplete"]) == ("inconclusive", early.incomplete)
    (error,) = etree.parse(tmp_path / "junit.xml").iter("error")
    assert (error.get("type"), error.get("message")) == ("incomplete", early.incomplete)
    assert ended_early(sample(), "interrupted").verdict == "not conformant", "what failed has failed"


def test_junit_failures_read_well_in_a_log(out: Path) -> None:
    document = etree.parse(out / "junit.xml")
    text = next(f.text or "" for f in document.iter("system-out") if "R-11.2.1.2-06" in (f.text or ""))
    for words in (
        "R-11.2.1.2-06 on_remove comes last (clause 11.2.1.2)",
        "expected: stop calls on_shutdown of every started component before it returns.",
        "observed: stop returned, and provider had not received on_shutdown.",
        "ucm-cts replay failures/R-11.2.1.2-06.json",
        "missing: on_shutdown()",
        "✓",
    ):
        assert words in text


def test_json_follows_its_schema_and_its_order_of_keys(out: Path) -> None:
    document = json.loads((out / "report.json").read_text(encoding="utf-8"))
    jsonschema.validate(document, json_report.schema())
    assert list(document) == [
        *(
            "schema_version",
            "product",
            "version",
            "profile",
            "verdict",
            "scope",
            "requirements",
            "incidents",
            "transitions",
            "adapter",
        ),
        *("suite_version", "seed", "started", "seconds", "scenarios", "events", "statement", "readings"),
        *("measures", "seconds_by_clause", "runs", "incomplete", "selection", "isolation"),
        *("adapter_file", "warnings", "provoked"),
    ]
    failed = {entry["id"]: entry for entry in document["requirements"]}["R-11.1.3-01"]
    keys = [
        "id",
        "clause",
        "title",
        "level",
        "verdict",
        "exercised",
        "reason",
        "findings",
        "caused_by",
        "decides",
        "derived",
    ]
    assert list(failed) == [*keys, "seconds"]
    finding = failed["findings"][0]
    assert finding["replay"] == "failures/R-11.1.3-01.json"
    assert [event["kind"] for event in finding["events"]] == ["reply"]


def test_the_verdict_says_what_it_is_about_everywhere(out: Path, page: Any) -> None:
    text = scope_of(clean_report(sample()), CATALOGUE).text
    numbers = re.search(r"profile container: (\d+) requirements asked, (\d+) not applicable, (\d+) not testable$", text)
    assert numbers, text
    assert text.startswith(f"{load_specification().name}, ")
    document = json.loads((out / "report.json").read_text(encoding="utf-8"))
    verdicts = [entry["verdict"] for entry in document["requirements"]]
    left_out = verdicts.count("not applicable")
    untestable = sum(bool(requirement.untestable) for requirement in CATALOGUE)
    assert [int(n) for n in numbers.groups()] == [len(verdicts) - left_out, left_out, untestable]
    assert document["scope"] == {
        "specification": msgspec.to_builtins(load_specification()),
        "profile": "container",
        "asked": len(verdicts) - left_out,
        "not_applicable": left_out,
        "not_testable": untestable,
    }
    assert text in page.xpath("string(//*[contains(@class, 'verdict')]//*[contains(@class, 'scope')])")
    junit = etree.parse(out / "junit.xml")
    assert {p.get("value") for p in junit.iterfind("testsuite/properties/property[@name='scope']")} == {text}


def test_the_terminal_says_the_scope_of_a_selection() -> None:
    """What cannot be tested is counted among what -k selects only."""
    whole, part = (
        scope_of(msgspec.structs.replace(sample(), selection=expression)) for expression in ("", "R-11.2.2.1-")
    )
    untestable = [r for r in load_requirements() if r.profile == "container" and r.untestable]
    assert whole.not_testable == len(untestable)
    assert part.not_testable == sum(r.id.startswith("R-11.2.2.1-") for r in untestable)
    printed = io.StringIO()
    Console(file=printed, width=400).print(summary(clean_report(sample())))
    assert whole.text in printed.getvalue()


def test_the_schema_in_the_tree_is_that_of_the_types() -> None:
    assert Path(json_report.__file__).with_name(json_report.SCHEMA_FILE).read_bytes() == json_report.schema_bytes()


def test_saved_failures_are_whole_scenarios_the_shortest_first(out: Path) -> None:
    names = {path.name for path in (out / "failures").iterdir()}
    assert names == {
        *("R-11.1.3-01.json", "R-11.2.1.2-06.json", "R-11.2.2.1-12.json", "R-11.2.2.1-12-2.json", "R-12.10-15.json"),
        *("incident-1.json", "incident-2.json"),
    }
    for failed in (lost_call(80), wrong_error()):
        saved = json.loads((out / "failures" / f"{failed.finding.requirement}.json").read_text(encoding="utf-8"))
        assert saved.pop("scenario") == failed.execution.name
        assert saved.pop("exercises") == [failed.finding.requirement]
        assert msgspec.convert(saved, Scenario) == failed.execution.scenario
    for path in (out / "failures").iterdir():
        assert [to_scenario(script) for script in read_scripts(path)]


def test_a_second_report_replaces_the_first_and_leaves_no_litter(tmp_path: Path) -> None:
    write_report(sample(), CATALOGUE, TABLE, DECISIONS, tmp_path)
    write_report(sample(requirements=(), incidents=()), CATALOGUE, TABLE, DECISIONS, tmp_path)
    assert {path.name for path in tmp_path.rglob("*")} == {
        *("report.html", "report.json", "junit.xml", "failures", MANIFEST)
    }


def test_names_of_files_cannot_leave_the_folder(tmp_path: Path) -> None:
    odd = RequirementResult("../../etc/passwd", "1", "t", "fail", 1, (wrong_error(),))
    write_report(sample(requirements=(odd,), incidents=()), CATALOGUE, TABLE, {}, tmp_path / "out")
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_the_summary_is_plain_without_a_terminal_and_short() -> None:
    plain = io.StringIO()
    Console(file=plain, width=90).print(summary(clean_report(sample()), Path("somewhere")))
    lines = plain.getvalue().splitlines()
    assert "\x1b" not in plain.getvalue()
    assert lines[0].startswith("✗ NOT CONFORMANT")
    at = next(i for i, line in enumerate(lines) if "R-12.10-15" in line)
    assert lines[at + 1].strip().startswith("expected  remove_component of an unknown id ends with NOT_FOUND.")
    assert lines[at + 2].strip().startswith("observed  It ended with an exception")
    assert lines[at + 3] == ""
    assert any(line.startswith("⚡ crash  signal 11") for line in lines)
    assert "somewhere/report.html" in lines[-1].replace("\\", "/")


@pytest.mark.parametrize(
    ("printed", "told"),
    [
        (
            "Traceback (most recent call last):\n  File ...\nZeroDivisionError: division by zero\n",
            ": ZeroDivisionError",
        ),
        ("terminate called\n  what():  no such port\n", ": what(): no such port"),
        ("Exception: lost\n\tat org.acme.Main.main(Main.java:3)\n", ": Exception: lost"),
        ("", ""),
    ],
)
def test_the_summary_ends_with_what_a_host_said_last(printed: str, told: str) -> None:
    item = sample().incidents[0]
    died = msgspec.structs.replace(item, incident=Incident("exit", "exit status 1", printed))
    shown = io.StringIO()
    Console(file=shown, width=160).print(summary(clean_report(sample(incidents=(died,))), None))
    line = next(line for line in shown.getvalue().splitlines() if line.startswith("⚡"))
    before, _, after = line.partition(told) if told else (line, "", "")
    assert before.startswith("⚡ exit  exit status 1")
    assert ": " not in before
    assert not told or line != before, line
    assert "\tat" not in after


# Foreign text


def test_foreign_text_is_bounded_with_a_note_and_loses_nothing_silently() -> None:
    assert clean("a\x00b\x1b[0m\ud800\u202ec") == "a\u2400b\u241b[0m\ufffd\ufffdc"
    assert clean("x" * 10_000_000) == "x" * LONGEST + f" [{10_000_000 - LONGEST} more characters left out]"
    assert clean("a\r\nb\tc") == "a\nb\tc"
    assert one_line("a\n  b" * 100, 20) == "a ba ba ba ba ba ba…"
    report = clean_report(sample(incidents=(crash(stacks="y" * 100_000),)))
    assert LONGEST_STACKS < len(report.incidents[0].incident.stacks) < LONGEST_STACKS + 100


def test_clauses_are_ordered_as_in_a_table_of_contents() -> None:
    clauses = ["12.10", "11.2.10", "11.2.2.1", "11", "11.2.2"]
    assert sorted(clauses, key=order.clause_key) == ["11", "11.2.2", "11.2.2.1", "11.2.10", "12.10"]
