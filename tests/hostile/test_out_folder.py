"""What is not of a run is never touched in --out: foreign files, links, manifests that lie, folders in use."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from command_line import Outcome, report_of, ucm_cts, within
from made_up_run import CATALOGUE, DECISIONS, TABLE, sample

from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.out_folder import MANIFEST, OutFolder
from ucm_cts.harness.report.write import keep_report, report_folder, write_report

SECRET = "not yours"
REPORT = {"report.html", "report.json", "junit.xml", "failures", MANIFEST}


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    within(tmp_path, monkeypatch)
    return tmp_path


@pytest.fixture
def foreign(here: Path) -> Path:
    """A folder of somebody else, with names that a report has as well."""
    folder = here / "foreign"
    (folder / "failures").mkdir(parents=True)
    for name in ("report.html", "report.json", "notes.txt", "R-11.2.3-11.json", "failures/R-11.2.3-11.json", MANIFEST):
        (folder / name).write_text(SECRET)
    return folder


def is_untouched(folder: Path) -> bool:
    files = [path for path in folder.rglob("*") if path.is_file()]
    return len(files) == 6 and all(path.read_text() == SECRET for path in files)


def save(out: Path) -> None:
    write_report(sample(), CATALOGUE, TABLE, DECISIONS, out)


def test_foreign_files_stay_beside_a_report(here: Path) -> None:
    out = here / "out"
    (out / "failures" / "deep").mkdir(parents=True)
    own = [out / "notes.txt", out / "failures/notes.json", out / "failures/mine.xml", out / "failures/deep/R-1.json"]
    for path in own:
        path.write_text(SECRET)
    save(out)
    write_report(sample(requirements=(), incidents=()), CATALOGUE, TABLE, DECISIONS, out)
    assert all(path.read_text() == SECRET for path in own)
    assert {path.name for path in out.iterdir()} == {*REPORT, "notes.txt"}
    assert {path.name for path in (out / "failures").iterdir()} == {"notes.json", "mine.xml", "deep"}


@pytest.mark.parametrize(
    "name", ["report.html", "report.json", "junit.xml", MANIFEST, "failures/R-11.2.3-11.json", "failures/ics.toml"]
)
def test_name_that_is_taken_is_refused_before_the_run(here: Path, name: str) -> None:
    path = here / "out" / name
    path.parent.mkdir(parents=True)
    path.write_text(SECRET)
    outcome = ucm_cts("run", "subjects:Crashing", "--out", "out")
    assert (outcome.status, outcome.out, len(outcome.err.splitlines())) == (2, "", 1)
    assert f"'out/{name}' is " in outcome.err
    assert "choose another --out" in outcome.err
    assert path.read_text() == SECRET
    assert [one for one in (here / "out").rglob("*") if one.is_file()] == [path]


def test_file_that_was_changed_after_a_run_is_not_the_runs(here: Path) -> None:
    save(here / "out")
    scenario = here / "out" / "failures" / "R-12.10-15.json"
    scenario.write_text(SECRET)
    with pytest.raises(WrongUse, match=r"R-12.10-15.json' was changed after a run wrote it"):
        save(here / "out")
    assert scenario.read_text() == SECRET
    scenario.unlink()
    save(here / "out")
    assert scenario.read_text() != SECRET


def linked_failures(out: Path, foreign: Path) -> None:
    out.mkdir()
    (out / "failures").symlink_to(foreign)


def linked_file(out: Path, foreign: Path) -> None:
    out.mkdir()
    (out / "report.html").symlink_to(foreign / "report.html")


def linked_manifest(out: Path, foreign: Path) -> None:
    out.mkdir()
    (out / MANIFEST).symlink_to(foreign / MANIFEST)


def linked_to_nothing(out: Path, foreign: Path) -> None:
    out.mkdir()
    (out / "report.json").symlink_to(foreign / "not-there")


def linked_folder(out: Path, foreign: Path) -> None:
    out.symlink_to(foreign)


def linked_saved_scenario(out: Path, foreign: Path) -> None:
    save(out)
    (out / "failures" / "R-12.10-15.json").unlink()
    (out / "failures" / "R-12.10-15.json").symlink_to(foreign / "R-11.2.3-11.json")


@pytest.mark.parametrize(
    "make", [linked_failures, linked_file, linked_manifest, linked_to_nothing, linked_folder, linked_saved_scenario]
)
def test_links_are_refused_and_not_followed(here: Path, foreign: Path, make: Callable[[Path, Path], None]) -> None:
    make(here / "out", foreign)
    with pytest.raises(WrongUse, match="is a link"):
        save(here / "out")
    assert is_untouched(foreign)


def test_link_above_the_folder_is_the_users_own(here: Path) -> None:
    (here / "real").mkdir()
    (here / "link").symlink_to(here / "real")
    save(here / "link" / "out")
    assert (here / "real" / "out" / "report.html").is_file()


@pytest.mark.parametrize("kind", ["fifo", "folder"])
def test_name_taken_by_what_is_no_file(here: Path, kind: str) -> None:
    (here / "out").mkdir()
    path = here / "out" / "report.json"
    os.mkfifo(path) if kind == "fifo" else path.mkdir()
    with pytest.raises(WrongUse, match=r"report\.json' is no file"):
        save(here / "out")


@pytest.mark.parametrize("content", ["", "[]", '{"files": 3}', "[" * 100_000, "\x00"])
def test_manifest_that_is_none_is_refused(here: Path, content: str) -> None:
    (here / "out").mkdir()
    (here / "out" / MANIFEST).write_text(content)
    with pytest.raises(WrongUse, match="no manifest of a run"):
        save(here / "out")
    assert (here / "out" / MANIFEST).read_text() == content


def test_manifest_cannot_claim_what_is_outside(here: Path, foreign: Path) -> None:
    out = here / "out"
    save(out)
    empty = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"
    victims = [foreign / "empty", out / "empty", out / "failures" / "notes"]
    for path in victims:
        path.write_text("")
    claimed = ["../foreign/empty", str(foreign / "empty"), "empty", "failures/notes", "failures/../empty"]
    text = (out / MANIFEST).read_text()
    lines = "".join(f'"{name}": "{empty}",\n' for name in claimed)
    (out / MANIFEST).write_text(text.replace('"files": {', '"files": {' + lines))
    write_report(sample(requirements=(), incidents=()), CATALOGUE, TABLE, DECISIONS, out)
    assert all(path.is_file() for path in victims)


def test_second_run_into_a_folder_in_use_gets_a_line(here: Path) -> None:
    with report_folder(here / "out"):
        outcome = ucm_cts("run", "subjects:Crashing", "--out", "out")
    assert outcome.status == 2
    assert outcome.err == "ucm-cts: another run writes to 'out'; wait for its end, or choose another --out\n"
    assert not (here / "out").exists(), "nothing was written"


def test_run_that_never_begins_leaves_no_folder(here: Path) -> None:
    assert ucm_cts("run", "subjects:Nobody", "--out", "new/out").status == 2
    assert not (here / "new" / "out").exists()
    (here / "mine").mkdir()
    assert ucm_cts("run", "subjects:Nobody", "--out", "mine").status == 2
    assert (here / "mine").is_dir()


@pytest.mark.parametrize("out", ["/proc/ucm-cts", "/sys/ucm-cts/out", "file", "file/out", "x" * 300])
def test_folder_that_cannot_be_is_told_before_the_run(here: Path, out: str) -> None:
    (here / "file").write_text(SECRET)
    outcome = ucm_cts("run", "subjects:Crashing", "--out", out)
    assert (outcome.status, outcome.out) == (2, "")
    assert (here / "file").read_text() == SECRET


def test_write_error_leaves_the_old_report_whole(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = here / "out"
    save(out)
    before = {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}
    with report_folder(out) as folder, monkeypatch.context() as patch:
        real = os.fdopen

        def full(handle: int, mode: str = "r") -> object:
            file = real(handle, mode)
            if "w" in mode:
                file.close()
                raise OSError(28, "No space left on device")
            return file

        patch.setattr("ucm_cts.harness.report.out_folder.os.fdopen", full)
        saved = keep_report(sample(product="Later"), folder)
    assert saved.problem == f"'{out}': No space left on device"
    assert saved.place is not None
    assert saved.place.parent == here, "beside it"
    assert report_of(saved.place)["product"] == "Later"
    assert {path: path.read_bytes() for path in out.rglob("*") if path.is_file()} == before


def test_run_without_any_space_prints_what_it_measured(here: Path) -> None:
    limited = "import resource, sys; resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)); sys.argv = ['ucm-cts', *sys.argv[1:]]; "
    program = limited + "from ucm_cts.__main__ import main; main()"
    command = [sys.executable, "-B", "-c", program, "run", "reference-py", "-k", "R-11.2.2.1-13", "--out", "out"]
    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", check=False)
    assert done.returncode == 3
    assert "✓ CONFORMANT" in done.stdout
    assert "File too large; no folder took it, and this summary is all that is left" in done.stderr
    assert len(done.stderr.splitlines()) == 1
    assert [path.name for path in here.iterdir()] in ([], ["out"])


ATTACKER = """
import os, shutil
from pathlib import Path
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter

class Attacker(ReferenceAdapter):
    def create_runtime(self, implementations):
        out, foreign = Path(os.environ["REPORT"]), Path(os.environ["FOREIGN"])
        if not Path("done").exists():
            Path("done").touch()
            {what}
        return super().create_runtime(implementations)
"""
ATTACKS = {
    "removes the folder": "shutil.rmtree(out)",
    "puts a link in its place": "shutil.rmtree(out); out.symlink_to(foreign)",
    "puts another folder in its place": "shutil.rmtree(out); shutil.copytree(foreign, out)",
    "links the failures": "(out / 'failures').symlink_to(foreign)",
    "links the page": "(out / 'report.html').symlink_to(foreign / 'report.html')",
    "links the manifest": f"(out / '{MANIFEST}').symlink_to(foreign / '{MANIFEST}')",
    "takes a name": "(out / 'junit.xml').mkdir()",
    "is first": "shutil.copy(foreign / 'report.json', out)",
}


@pytest.mark.parametrize("what", ATTACKS.values(), ids=ATTACKS.keys())
def test_attack_during_the_run_harms_nobody_and_loses_nothing(
    here: Path, foreign: Path, monkeypatch: pytest.MonkeyPatch, what: str
) -> None:
    monkeypatch.setenv("PYTHONPATH", str(here))
    monkeypatch.setenv("REPORT", str(here / "out"))
    monkeypatch.setenv("FOREIGN", str(foreign))
    (here / "attacking.py").write_text(ATTACKER.format(what=what))
    outcome = ucm_cts("run", "attacking:Attacker", "-k", "R-11.2.2.1-13", "--out", "out", "--no-sandbox")
    assert is_untouched(foreign)
    assert "✓ CONFORMANT" in outcome.out
    assert len(outcome.err.splitlines()) == (outcome.status == 3)
    kept = [path.parent for path in here.glob("out*/junit.xml") if path.is_file()]
    assert [report_of(folder)["verdict"] for folder in kept] == ["conformant"]
    assert (kept == [here / "out"]) == (outcome.status == 0)


def test_names_that_a_command_does_not_write_are_refused(here: Path) -> None:
    with OutFolder(here / "out", ["a*", "below/b*"]) as folder:
        for name in ("b", "../a", "below/../a", "a/a", "below/deep/b", "/a"):
            with pytest.raises(ValueError, match="none of the files"):
                folder.save({name: b""})
        folder.save({"a": b"1", "below/b": b"2"})
        folder.save({"a1": b"3"}, ["a*"])
        assert folder.read("*") == {"a1": b"3"}
        assert folder.read("below/*") == {"below/b": b"2"}


def compared(page: Path) -> Outcome:
    out = page.parent / "runs"
    save(out)
    return ucm_cts("compare", out / "report.json", out / "report.json", "--out", page)


@pytest.mark.parametrize("name", ["page.html", "page[1]*?.html"])
def test_compare_replaces_its_own_page_only(here: Path, name: str) -> None:
    page = here / name
    others = here / "pageX.html"
    others.write_text(SECRET)
    assert compared(page).status == compared(page).status == 0
    page.write_text(SECRET)
    refused = compared(page)
    assert (refused.status, page.read_text(), others.read_text()) == (2, SECRET, SECRET)
    assert f"'{page}' was changed after a run wrote it; move it away, or choose another --out" in refused.err


@pytest.mark.parametrize(
    ("make", "why"),
    [
        (lambda page: page.write_text(SECRET), "is there, and no run wrote it; move it away"),
        (lambda page: page.symlink_to(page.parent / "elsewhere.html"), "is a link; move it away"),
        (lambda page: page.mkdir(), "is a directory"),
    ],
    ids=["foreign file", "link", "folder"],
)
def test_compare_replaces_nothing_foreign(here: Path, make: Callable[[Path], None], why: str) -> None:
    make(here / "page.html")
    refused = compared(here / "page.html")
    assert (refused.status, why in refused.err, "Traceback" in refused.err) == (2, True, False)
    assert not (here / "elsewhere.html").exists()


def test_page_of_compare_and_report_share_a_folder(here: Path) -> None:
    save(here / "runs")
    outcome = ucm_cts("compare", *["runs/report.json"] * 2, "--out", "runs/page.html")
    assert outcome.status == 0, outcome.err
    save(here / "runs")
    assert {path.name for path in (here / "runs").iterdir()} == {*REPORT, "page.html"}
