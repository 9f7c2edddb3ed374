"""``ucm-cts compare``: reports of all products are shown side by side; other files are refused."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec
import pytest
from command_line import Outcome, ucm_cts
from lxml import html
from made_up_run import HOSTILE
from report_entries import report, requirement, save

from ucm_cts.harness.report import comparison
from ucm_cts.harness.report.comparison import compare
from ucm_cts.harness.report.comparison_page import to_html

LEFT = report(
    "Left",
    requirement("R-11.10-01", "pass"),
    requirement("R-11.2.3-01", "fail", "it was seen <here>"),
    requirement("R-11.2.3-02", "fail"),
    requirement("R-12.10-01", "pass"),
    readings={"late-add": ("refuse",), "double-start": ("noop",)},
)
RIGHT = report(
    "Right",
    requirement("R-11.2.3-01", "inconclusive"),
    requirement("R-11.2.3-02", "fail"),
    requirement("R-12.10-01", "pass"),
    readings={"late-add": ("deferred",)},
)


def test_rows_are_in_the_order_of_clauses_and_mark_requirements_not_asked(tmp_path: Path) -> None:
    both = compare(save(tmp_path, LEFT, RIGHT))
    reported = [(row.id, *(cell and cell.verdict for cell in row.cells)) for row in both.rows]
    assert reported == [
        ("R-11.2.3-01", "fail", "inconclusive"),
        ("R-11.2.3-02", "fail", "fail"),
        ("R-11.10-01", "pass", None),
        ("R-12.10-01", "pass", "pass"),
    ]
    assert [row.id for row in both.rows if row.differs] == ["R-11.2.3-01"]
    assert [row.id for row in both.rows if row.is_kept] == ["R-11.10-01", "R-12.10-01"]
    assert [row.id for row in both.shared] == ["R-11.2.3-01", "R-11.2.3-02", "R-12.10-01"]
    assert {option.name: option.differs for option in both.options} == {"double-start": False, "late-add": True}


def test_the_page_shows_verdicts_and_differences(tmp_path: Path) -> None:
    save(tmp_path, LEFT, RIGHT)
    page_file = tmp_path / "new" / "page.html"
    outcome = ucm_cts("compare", *sorted(tmp_path.glob("*/report.json")), "--out", page_file)
    assert outcome.status == 0
    lines = outcome.out.splitlines()
    assert lines[:2] == ["Left 1: 2 fail, 2 pass", "Right 1: 1 fail, 1 inconclusive, 1 pass"]
    assert lines[2] == f"3 requirements are asked of all; on 1 they differ. {page_file} shows it"
    page = html.parse(page_file).getroot()
    assert "3 requirements asked of all: 1 kept by all, 1 on which they differ, 1 broken by all" in page.text_content()
    clauses = [[cell.text_content().split() for cell in row] for row in page.xpath("//*[@id='clauses']//tbody/tr[td]")]
    assert clauses == [
        [["11.2.3"], ["✗", "0", "of", "2"], ["✗", "0", "of", "2"]],
        [["12.10"], ["✓", "1", "of", "1"], ["✓", "1", "of", "1"]],
        [["11.10"], ["✓", "1", "of", "1"], ["not", "asked"]],
    ]
    (row,) = page.xpath("//*[@id='R-11.2.3-01']")
    assert [cell.text_content().split() for cell in row.xpath("td")] == [
        ["✗", "fail", "it", "was", "seen", "<here>", "(3", "times)"],
        ["?", "inconclusive"],
    ]
    assert row.xpath("td//a/@href") == [f"../{n}/report.html#R-11.2.3-01" for n in (0, 1)]
    assert [row.xpath("string(.//code)") for row in page.xpath("//*[@id='kept']//tr[td]")] == [
        "R-11.10-01",
        "R-12.10-01",
    ]


def test_links_have_targets(tmp_path: Path) -> None:
    files = save(tmp_path, LEFT, RIGHT)
    files[0].with_name("report.html").unlink()
    links = html.document_fromstring(to_html(compare(files), tmp_path)).xpath("//@href")
    assert {link.partition("#")[0] for link in links} == {"", "1/report.html"}


def test_a_report_may_be_compared_with_itself_and_with_one_of_another_suite(tmp_path: Path) -> None:
    page = to_html(compare(save(tmp_path, LEFT, LEFT)), tmp_path)
    assert "0 on which they differ" in page
    assert "different versions" not in page
    other = report("Other", requirement("R-12.10-01", "pass"), suite_version="9")
    assert "different versions" in to_html(compare(save(tmp_path, LEFT, other)), tmp_path)


def test_reports_that_say_nothing_together_are_refused(tmp_path: Path) -> None:
    early = report("Early", requirement("R-12.10-01", "pass"), verdict="inconclusive", incomplete="interrupted")
    files = save(tmp_path, LEFT, RIGHT, early)
    outcome = ucm_cts("compare", *files)
    assert (outcome.status, outcome.out) == (2, "")
    assert f"'{files[2]}' cannot be compared: its run is incomplete (interrupted)" in outcome.err
    files = save(tmp_path, LEFT, RIGHT, report("Other", requirement("R-9.1-01", "pass"), profile="pim"))
    outcome = ucm_cts("compare", *files)
    assert (outcome.status, len(outcome.err.splitlines())) == (2, 1)
    assert f"'{files[2]}' (profile pim) has no requirement in common with the others" in outcome.err


def test_hostile_text_stays_text(tmp_path: Path) -> None:
    evil = HOSTILE.replace("\ud800", "")
    wrong = msgspec.structs.replace(requirement("R-11.2.3-01", "fail", evil), title=evil, clause=evil, reason=evil)
    many = {
        "product": evil,
        "version": evil * 900,
        "profile": evil,
        "adapter": evil,
        "started": evil,
        "suite_version": evil,
    }
    source = to_html(compare(save(tmp_path, LEFT, report("", wrong, **many, readings={evil: (evil,)}))), tmp_path)
    page = html.document_fromstring(source)
    assert not page.xpath("//script | //img | //link | //*[@onerror] | //*[@src]")
    assert page.xpath("//td[contains(., '<img src=x onerror=alert(2)>') and contains(., '{{ 7*7 }}')]")
    assert not re.search("[\x00-\x08\x0b-\x1f\x7f\u202e\ud800-\udfff]", source)
    assert not re.search(r"url\(|@import|https?:", source)
    assert "default-src 'none'" in page.xpath("//meta[@http-equiv]/@content")[0]
    assert len(source) < 100_000


def edited(edit: Callable[[dict[str, Any]], object]) -> bytes:
    """The left report after ``edit``, on many lines."""
    content = json.loads(msgspec.json.encode(LEFT))
    edit(content)
    return json.dumps(content, indent=2).encode()


def first(content: dict[str, Any]) -> dict[str, Any]:
    entry: dict[str, Any] = content["requirements"][0]
    return entry


BROKEN: dict[str, tuple[bytes, str]] = {
    "empty": (b"", "is no report"),
    "not JSON": (b"product: Left\n", "is no report"),
    "cut off": (edited(lambda _: None)[:-20], "is no report"),
    "not UTF-8": (b'{"product": "\xff"}', "is not UTF-8"),
    "nested": (b'{"product":' + b"[" * 100_000, "Expected `str`, got `array`"),
    "nested where values are skipped": (
        edited(lambda c: c).replace(b'"findings": []', b'"findings": ' + b"[" * 9999, 1),
        "Expected",
    ),
    "a list": (b"[]", "Expected `object`, got `array`"),
    "field missing": (edited(lambda c: first(c).pop("title")), r":\d+: .*missing required field `title`"),
    "field too many": (edited(lambda c: first(c).update(colour="red")), r":\d+: .*unknown field `colour`"),
    "wrong type": (edited(lambda c: first(c).update(exercised="7")), r":\d+: Expected `int`, got `str`"),
    "unknown verdict": (edited(lambda c: first(c).update(verdict="passed")), r":\d+: .*'passed'"),
    "infinite": (edited(lambda c: c.update(seconds=float("inf"))), "is no report"),
    "twice": (edited(lambda c: c["requirements"].append(first(c))), "holds R-11.10-01 twice"),
    "no requirement": (edited(lambda c: first(c).update(id="<b>")), "'<b>' is no requirement"),
    "pass for nothing": (edited(lambda c: first(c).update(exercised=0)), "is 'pass' and was never exercised"),
    "fail for nothing": (edited(lambda c: first(c).update(verdict="fail")), "is 'fail', against its findings"),
    "failure hidden": (
        edited(lambda c: c["requirements"][1].update(verdict="pass")),
        "is 'pass', against its findings",
    ),
    "not all asked": (edited(lambda c: c["requirements"].pop(0)), "4 requirements asked, .*against its requirements"),
    "another profile": (edited(lambda c: c.update(profile="core")), "profile container: .*against its requirements"),
    "older": (
        edited(lambda c: c.pop("schema_version")),
        "has no schema version .*and this one reads version 2; make it again",
    ),
    "newer": (
        edited(lambda c: c.update(schema_version=3, new=1)),
        "has schema version 3 .*reads version 2; update ucm-cts",
    ),
    "verdict hidden": (edited(lambda c: c.update(verdict="conformant")), "says 'conformant', but what it holds is"),
}


def refused(outcome: Outcome) -> str:
    assert outcome.status == 2
    assert outcome.out == ""
    assert outcome.err.startswith("ucm-cts: ")
    assert outcome.err.count("\n") == 1
    return outcome.err


@pytest.mark.parametrize("kind", BROKEN)
def test_other_files_than_reports_are_refused_in_one_line(kind: str, tmp_path: Path) -> None:
    content, problem = BROKEN[kind]
    good, bad = save(tmp_path, RIGHT, LEFT)
    bad.write_bytes(content)
    reported = refused(ucm_cts("compare", good, bad, "--out", tmp_path / "page.html"))
    assert reported.startswith(f"ucm-cts: {bad}:")
    assert re.search(problem, reported), reported
    assert len(reported) < 900
    assert not (tmp_path / "page.html").exists()


def test_the_unbroken_report_is_taken(tmp_path: Path) -> None:
    good, same = save(tmp_path, RIGHT, LEFT)
    same.write_bytes(edited(lambda _: None))
    assert len(compare([good, same]).columns) == 2


def test_other_mistakes_give_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    files = save(tmp_path, LEFT, RIGHT)
    page = tmp_path / "page.html"
    for number in (0, 1, 13):
        assert "name 2 to 12 files" in refused(ucm_cts("compare", *files[:1] * number, "--out", page))
    assert "cannot be read" in refused(ucm_cts("compare", files[0], tmp_path / "none.json", "--out", page))
    (tmp_path / "file").write_text("")
    assert "cannot be written" in refused(ucm_cts("compare", *files, "--out", tmp_path / "file" / "page.html"))
    monkeypatch.setattr(comparison, "LARGEST", 100)
    assert "is larger than 100 bytes" in refused(ucm_cts("compare", *files, "--out", page))
