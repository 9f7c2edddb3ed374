"""``ucm-cts compare --baseline OLD NEW``: which change is told of each requirement, what counts, and what is refused."""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import Any

import msgspec
import pytest
from command_line import Outcome, ucm_cts
from forging import intact, made_report
from lxml import etree
from made_up_run import HOSTILE
from report_entries import FINDING, report, requirement, save

from ucm_cts.harness.report.baseline import MEANINGS, changes
from ucm_cts.harness.report.baseline_formats import github_annotations
from ucm_cts.harness.report.comparison import Column
from ucm_cts.harness.report.json_report import IncidentEntry, RequirementEntry

EARLIER, LATER = "2026-01-01T00:00:00+00:00", "2026-02-01T00:00:00+00:00"
FOREIGN = "R-99.9-0"
"""Ids of requirements that this suite does not ask."""


def known(id_: str) -> RequirementEntry:
    entry = requirement(id_, "fail")
    return msgspec.structs.replace(entry, findings=(msgspec.structs.replace(FINDING, waived="ticket 7"),))


def flipping(id_: str) -> RequirementEntry:
    unstable = msgspec.structs.replace(FINDING, unstable="another run did not show it")
    return msgspec.structs.replace(requirement(id_, "inconclusive"), findings=(unstable,))


def recommended(id_: str, verdict: Any) -> RequirementEntry:
    return msgspec.structs.replace(requirement(id_, verdict), level="should", decides=False)


def run(*entries: RequirementEntry, **changed: Any) -> Any:
    """A report with ``entries``; -k selected them, as they are not all of the profile."""
    return report("Acme", *entries, **{"selection": "R-99", "started": EARLIER, **changed})


def change_of(before: RequirementEntry | None, after: RequirementEntry | None) -> str:
    """What became of the requirement that the two are of, in whole reports of a profile that this suite does not have."""
    other = requirement("R-99.8-01", "pass")
    both = [
        report("Acme", other, *([entry] if entry is not None else []), started=started, selection="", profile="other")
        for entry, started in ((before, EARLIER), (after, LATER))
    ]
    baseline = changes(*(Column(Path("report.json"), entry) for entry in both))
    (found,) = [d.change for d in baseline.differences if d.id != "R-99.8-01"]
    return found


ID = f"{FOREIGN}1"
PASS, FAIL, OPEN = (requirement(ID, verdict) for verdict in ("pass", "fail", "inconclusive"))
CRASH = (IncidentEntry("crash", "signal 11", "", True, "scenario", "failures/incident-1.json"),)
LEFT_OUT, LOST = (msgspec.structs.replace(OPEN, verdict=verdict) for verdict in ("not applicable", "error"))


@pytest.mark.parametrize(
    ("before", "after", "change"),
    [
        (PASS, PASS, "same"),
        (FAIL, PASS, "fixed"),
        (OPEN, PASS, "fixed"),
        (PASS, FAIL, "regressed"),
        (PASS, OPEN, "regressed"),
        (PASS, LOST, "regressed"),
        (OPEN, FAIL, "regressed"),
        (LOST, FAIL, "regressed"),
        (known(ID), FAIL, "still"),
        (FAIL, FAIL, "still"),
        (FAIL, OPEN, "still"),
        (PASS, known(ID), "known"),
        (FAIL, known(ID), "known"),
        (PASS, flipping(ID), "unstable"),
        (flipping(ID), PASS, "unstable"),
        (flipping(ID), flipping(ID), "still"),
        (None, PASS, "new"),
        (None, FAIL, "new"),
        (LEFT_OUT, FAIL, "new"),
        (PASS, None, "gone"),
        (PASS, LEFT_OUT, "gone"),
        (LEFT_OUT, LEFT_OUT, "same"),
    ],
)
def test_change_of_a_requirement(before: RequirementEntry | None, after: RequirementEntry | None, change: str) -> None:
    assert change_of(before, after) == change


def test_all_changes_are_explained_and_tried() -> None:
    tried = {mark.args[1][n][2] for mark in test_change_of_a_requirement.pytestmark for n in range(len(mark.args[1]))}
    assert tried == set(MEANINGS)


def compared(folder: Path, old: Any, new: Any, *options: str | Path) -> Outcome:
    before, after = save(folder, old, new)
    return ucm_cts("compare", "--baseline", before, after, *options)


def test_a_regression_ends_with_status_1_and_names_both_runs_in_their_order(tmp_path: Path) -> None:
    old = run(PASS, requirement(f"{FOREIGN}2", "fail"), version="1.0")
    new = run(FAIL, requirement(f"{FOREIGN}2", "pass"), version="1.1", started=LATER)
    outcome = compared(tmp_path, old, new)
    assert (outcome.status, outcome.err) == (1, "")
    said = outcome.out.splitlines()
    assert said[0] == "Acme, profile container"
    assert said[1].startswith(f"  baseline  1.0, ✗ not conformant, run {EARLIER}: ")
    assert said[2].startswith(f"  now       1.1, ✗ not conformant, run {LATER}: ")
    assert any(line.startswith(f"    {ID}  pass -> fail  Title of {ID}: that") for line in said)
    assert any(line.startswith(f"    {FOREIGN}2  fail -> pass") for line in said)
    assert said[-1] == "  REGRESSED"
    back = compared(tmp_path, new, old)
    assert "warning: the baseline is the later run" in back.out
    assert f"{FOREIGN}2  pass -> fail" in back.out


@pytest.mark.parametrize(
    ("old", "new", "status"),
    [
        (run(PASS), run(PASS), 0),
        (run(FAIL), run(FAIL), 0),
        (run(FAIL), run(PASS), 0),
        (run(PASS, requirement(f"{FOREIGN}2", "pass")), run(known(ID), requirement(f"{FOREIGN}2", "pass")), 0),
        (run(PASS), run(PASS, incidents=CRASH, verdict="inconclusive"), 1),
        (
            run(PASS, recommended(f"{FOREIGN}2", "pass")),
            run(PASS, recommended(f"{FOREIGN}2", "fail"), verdict="conformant"),
            0,
        ),
    ],
)
def test_exit_status(old: Any, new: Any, status: int, tmp_path: Path) -> None:
    assert compared(tmp_path, old, new).status == status


def test_a_report_that_was_cut_down_has_regressed(tmp_path: Path) -> None:
    """One passed requirement of 98 is no good news: the others are asked by the suite and missing."""
    entries = [requirement("R-11.2.2.1-01", "pass"), requirement("R-11.2.2.1-13", "pass")]
    whole, cut = (report("Acme", *some, selection="") for some in (entries, entries[:1]))
    outcome = compared(tmp_path, whole, cut)
    assert outcome.status == 1
    assert "R-11.2.2.1-13  pass -> not in the report" in outcome.out


def test_what_k_left_out_is_neither_gone_nor_new(tmp_path: Path) -> None:
    two = run(PASS, requirement(f"{FOREIGN}2", "pass"), selection="")
    one = run(PASS)
    assert "gone" not in compared(tmp_path, two, one).out
    assert "new" not in compared(tmp_path, one, two).out
    assert "this report has only what -k R-99 selected" in compared(tmp_path, two, one).out


def test_folders_are_paired_by_product_and_profile(tmp_path: Path) -> None:
    for place, verdict in (("old", "pass"), ("new", "fail")):
        for profile in ("container", "core"):
            entry = requirement(ID, verdict if profile == "core" else "pass")  # type: ignore[arg-type]
            (file,) = save(tmp_path, run(entry, profile=profile))
            shutil.move(file.parent, tmp_path / place / profile)
    outcome = ucm_cts("compare", "--baseline", tmp_path / "old", tmp_path / "new")
    assert outcome.status == 1
    assert [line for line in outcome.out.splitlines() if not line.startswith(" ")] == [
        "Acme, profile container",
        "Acme, profile core",
    ]
    assert outcome.out.count("REGRESSED") == 1
    again = ucm_cts("compare", "--baseline", tmp_path / "old", tmp_path / "new" / "container")
    assert again.status == 0


def test_junit_and_annotations_for_a_ci(tmp_path: Path) -> None:
    old = run(PASS, requirement(f"{FOREIGN}2", "fail"), requirement(f"{FOREIGN}3", "fail"))
    new = run(FAIL, requirement(f"{FOREIGN}2", "pass"), known(f"{FOREIGN}3"))
    outcome = compared(tmp_path, old, new, "--junit", tmp_path / "junit.xml", "--annotations")
    assert f"::error title={ID} regressed::{ID} pass -> fail" in outcome.out
    cases = {
        case.get("name"): [child.tag for child in case] for case in etree.parse(tmp_path / "junit.xml").iter("testcase")
    }
    assert cases == {
        "verdict of the whole": [],
        f"{ID} Title of {ID}": ["failure"],
        f"{FOREIGN}2 Title of {FOREIGN}2": [],
        f"{FOREIGN}3 Title of {FOREIGN}3": ["skipped"],
    }


def test_a_hostile_report_adds_no_annotation() -> None:
    evil = f"{HOSTILE}\n::error::made up, title=x::y%0A::warning::z".replace("\ud800", "")
    entry = requirement(ID, "fail", evil)
    columns = [Column(Path("r"), run(one)) for one in (PASS, msgspec.structs.replace(entry, title=evil))]
    said = list(github_annotations(changes(*columns)))
    assert len(said) == 2  # one of the requirement, one of the whole
    assert all("\n" not in line and line.startswith("::error title=") for line in said)
    assert "%0A" not in said[0].replace("%250A", "")


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        (run(PASS), report("Other", PASS), "is of Other, profile container, and the baseline has no report of that"),
        (run(PASS), run(PASS, profile="core"), "is of Acme, profile core, and the baseline has no report of that"),
        (run(PASS), run(PASS, incomplete="interrupted", verdict="inconclusive"), "its run is incomplete"),
        (run(PASS), run(requirement(f"{FOREIGN}2", "pass")), "has no requirement in common with its baseline"),
    ],
)
def test_what_cannot_be_compared_is_refused_in_one_line(old: Any, new: Any, problem: str, tmp_path: Path) -> None:
    outcome = compared(tmp_path, old, new)
    assert (outcome.status, outcome.out, outcome.err.count("\n")) == (2, "", 1)
    assert problem in outcome.err


def test_other_wrong_use_is_refused_in_one_line(tmp_path: Path) -> None:
    one, two = save(tmp_path, run(PASS), run(PASS, version="2"))
    (tmp_path / "empty").mkdir()
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    for arguments, problem in (
        (("--baseline", one), "no REPORT is named to compare with the baseline"),
        (("--baseline", one, tmp_path / "empty"), "there is no report.json in"),
        (("--baseline", tmp_path, two), "are both of Acme, profile container; name one of them"),
        (("--baseline", tmp_path / "none", two), "cannot be read"),
        (("--baseline", one, "x" * 300), "cannot be read"),
        (("--baseline", pipe, two), "is no plain file"),
        ((one, two, "--junit", tmp_path / "junit.xml"), "--junit takes --baseline OLD"),
        ((one, two, "--annotations"), "--annotations takes --baseline OLD"),
        (("--baseline", one, two, "--junit", tmp_path / "0" / "report.json"), "is there, and no run wrote it"),
        (("--baseline", one, two, "--junit", tmp_path / "0" / "report.json" / "x"), "cannot be written"),
    ):
        outcome = ucm_cts("compare", *arguments)
        assert (outcome.status, outcome.out, outcome.err.count("\n")) == (2, "", 1), arguments
        assert problem in outcome.err


def test_the_page_is_written_if_it_is_asked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    compared(tmp_path, run(PASS), run(FAIL))
    assert not list(tmp_path.glob("*.html"))
    compared(tmp_path, run(PASS), run(FAIL), "--out", tmp_path / "page.html")
    assert ID in (tmp_path / "page.html").read_text()


def test_certificates_are_taken_with_a_word_that_they_were_not_verified(tmp_path: Path) -> None:
    old, new = tmp_path / "old.ucmcert", tmp_path / "folder" / "new.ucmcert"
    new.parent.mkdir()
    old.write_bytes(intact())
    new.write_bytes(intact("failing"))
    outcome = ucm_cts("compare", "--baseline", old, new.parent, "--out", tmp_path / "page.html")
    assert (outcome.status, outcome.err) == (1, "")
    assert outcome.out.count("was taken as it is; to know that it stands: ucm-cts verify FILE --trust KEYS") == 2
    broken = made_report().requirements[0].id
    assert f"    {broken}  pass -> fail" in outcome.out
    assert broken in (tmp_path / "page.html").read_text()


@pytest.mark.parametrize("content", [b"", b"no zip", intact()[:-40], intact().replace(b'"pass"', b'"fail"', 1)])
def test_a_damaged_certificate_is_refused_in_one_line(content: bytes, tmp_path: Path) -> None:
    (tmp_path / "old.ucmcert").write_bytes(intact())
    (tmp_path / "new.ucmcert").write_bytes(content)
    outcome = ucm_cts("compare", "--baseline", tmp_path / "old.ucmcert", tmp_path / "new.ucmcert")
    assert (outcome.status, outcome.out, outcome.err.count("\n")) == (2, "", 1)
    assert outcome.err.startswith(f"ucm-cts: {tmp_path / 'new.ucmcert'}: ")
