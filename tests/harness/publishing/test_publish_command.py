"""``ucm-cts publish``: what it writes, leaves alone, remembers and refuses."""

from __future__ import annotations

import hashlib
import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any

import msgspec
import pytest
from certified import VERIFIER, put, report, verified
from command_line import Outcome, ucm_cts
from files import ROOT
from lxml import html

from ucm_cts.harness.catalogue.profiles import TOOLCHAIN_PROFILES
from ucm_cts.harness.certificates.problems import Problem
from ucm_cts.harness.cli import publish_command
from ucm_cts.harness.cli.commands import cli
from ucm_cts.harness.publishing.pages import site_files


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with two certificates that stand and two that do not, and the verifier that believes them."""
    monkeypatch.setattr(publish_command, "verifying_command", lambda trust, *options: VERIFIER)
    (tmp_path / "keys").mkdir()
    (tmp_path / "keys" / "acme.pub").write_text("key")
    put(tmp_path / "certificates", "one", verified())
    put(tmp_path / "certificates", "two", verified(report(version="1.1")))
    put(tmp_path / "certificates", "bad", verified(report(version="9"), problems=(Problem("digest", "wrong"),)))
    put(tmp_path / "certificates", "worse", b"complain")
    return tmp_path


def publish(folder: Path, *options: str) -> Outcome:
    return ucm_cts("publish", folder / "certificates", "--out", folder / "site", "--trust", folder / "keys", *options)


def content(folder: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in sorted((folder / "site").rglob("*")) if path.is_file()}


def test_the_site_is_made_and_what_does_not_stand_is_told(folder: Path) -> None:
    done = publish(folder)
    assert (done.status, done.err) == (0, "")
    assert "bad.ucmcert does not stand: digest: wrong" in done.out
    assert "worse.ucmcert does not stand: verification: verification ended with exit status 1: ucm-cts:" in done.out
    assert "2 of 4 certificates stand" in done.out
    first = content(folder)
    assert len([path for path in first if path.parent.name == "certificates" and path.suffix == ".html"]) == 2
    assert publish(folder).status == 0
    assert content(folder) == first


def test_the_archives_that_stand_are_in_the_site_and_the_page_says_how_to_verify_them(folder: Path) -> None:
    publish(folder)
    offered = {path.read_bytes() for path in (folder / "site" / "certificates").glob("*.ucmcert")}
    assert offered == {(folder / "certificates" / f"{name}.ucmcert").read_bytes() for name in ("one", "two")}
    for path in (folder / "site" / "certificates").glob("*.html"):
        tree = html.document_fromstring(path.read_text())
        (link,) = tree.xpath("//*[@id='verify']//a[@download]")
        assert hashlib.sha256((path.parent / link.get("href")).read_bytes()).hexdigest() == path.stem
        command = shlex.split(tree.xpath("string(//*[@id='verify']//*[@class='command'])").strip())
        assert command == ["ucm-cts", "verify", link.get("download"), "--trust", "keys"]


def test_an_archive_that_changes_while_the_site_is_made_stops_it(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def made(*arguments: Any) -> dict[str, bytes]:
        put(folder / "certificates", "one", b"changed")
        return site_files(*arguments)

    monkeypatch.setattr(publish_command, "site_files", made)
    done = publish(folder)
    assert (done.status, done.err.count("\n")) == (2, 1)
    assert "it was changed meanwhile" in done.err
    assert not content(folder)


def test_results_are_written_as_by_the_command_of_that_name(folder: Path) -> None:
    asked = report(verdicts={"R-11.2.2.1-13": "fail"}, observed="It stopped first what it started first.")
    put(folder / "certificates", "three", verified(asked))
    put(folder / "certificates", "other rules", verified(report("Borealis"), judged_by="0.2.0"))
    put(folder / "certificates", "newest", verified(report(), issued="2031-09-01T00:00:00+00:00"))
    assert publish(folder, "--results", str(folder / "results")).status == 0
    (folder / "report.json").write_bytes(msgspec.json.encode(report()))
    (folder / "again" / "1.1").mkdir(parents=True)
    (folder / "again" / "1.1" / "report.json").write_bytes(msgspec.json.encode(report(version="1.1")))
    done = ucm_cts("results", folder / "report.json", folder / "again", "--out", folder / "expected")
    assert done.status == 0
    found, expected = (
        {path.relative_to(place): path.read_bytes() for path in place.rglob("*") if path.is_file()}
        for place in (folder / "results", folder / "expected")
    )
    assert found == expected
    assert len(found) == 5


def test_results_have_one_place_for_a_product_whoever_signed(folder: Path) -> None:
    put(folder / "certificates", "forged", verified(signers=("mallory",)))
    done = publish(folder, "--results", str(folder / "results"))
    assert (done.status, done.err.count("\n")) == (2, 1)
    assert "acme and mallory signed certificates of Acme UCM 1.0, profile container" in done.err
    assert not content(folder)
    assert not (folder / "results").exists()


def test_what_a_site_no_longer_has_is_removed_and_nothing_else(folder: Path) -> None:
    publish(folder)
    (folder / "site" / "CNAME").write_text("example.org")
    (folder / "certificates" / "two.ucmcert").unlink()
    assert publish(folder).status == 0
    pages = [path for path in content(folder) if path.parent.name == "certificates" and path.suffix == ".html"]
    assert len(pages) == 1
    assert (folder / "site" / "CNAME").read_text() == "example.org"


@pytest.mark.parametrize("taken", ["index.html", "badges/mine.svg", "products"])
def test_a_folder_whose_names_are_taken_is_refused(folder: Path, taken: str) -> None:
    path = folder / "site" / taken
    path.parent.mkdir(parents=True)
    path.write_text("mine")
    done = publish(folder)
    assert done.status == 2
    assert taken in done.err
    assert list(content(folder)) == [path]


def test_what_is_remembered_is_not_verified_again(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = str(folder / "kept")
    assert publish(folder, "--remember", kept).status == 0
    first = content(folder)
    monkeypatch.setattr(publish_command, "verifying_command", lambda trust, *options: ("false",))
    assert "2 of 4 certificates stand" in publish(folder, "--remember", kept).out
    assert {p: b for p, b in content(folder).items() if p.parent.name == "certificates"} == {
        p: b for p, b in first.items() if p.parent.name == "certificates"
    }
    assert "0 of 4 certificates stand" in publish(folder).out


def test_the_address_of_the_site_is_in_the_badges_and_the_feed(folder: Path) -> None:
    assert publish(folder, "--url", "https://example.org/ucm").status == 0
    (page,) = (folder / "site" / "products").glob("*.html")
    assert "](https://example.org/ucm/badges/acme-ucm-" in page.read_text()
    assert 'href="https://example.org/ucm/feed.atom"' in (folder / "site" / "feed.atom").read_text()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--url", "javascript:alert(1)"), "is no address of a site"),
        (("--url", 'https://x/"><b>'), "is no address of a site"),
        (("--trust", "nowhere"), "there are no keys at 'nowhere'"),
        (("--auditor", "nowhere"), "there are no keys at 'nowhere'"),
    ],
)
def test_wrong_use_is_one_line(folder: Path, options: tuple[str, ...], message: str) -> None:
    done = publish(folder, *options)
    assert (done.status, done.err.count("\n")) == (2, 1)
    assert message in done.err
    assert not (folder / "site").exists()


def test_a_folder_that_is_not_there_is_refused(tmp_path: Path) -> None:
    done = ucm_cts("publish", tmp_path / "no", "--out", tmp_path / "site", "--trust", tmp_path)
    assert (done.status, "there is no folder" in done.err) == (2, True)


def test_tox_makes_certificates_of_all_bundled_products() -> None:
    (block,) = re.findall(r"(?ms)^\[testenv:certificates\]\n(.*?)^\[", (ROOT / "tox.ini").read_text())
    made, archives = [], []
    for line in re.findall(r"(?m)^    -? ?(ucm-cts .+)$", block):
        name, *arguments = shlex.split(
            line.replace("{posargs}", "").replace("{/}", "/").replace("{tox_root}", str(ROOT))
        )[1:]
        context = cli.commands[name].make_context(name, arguments)
        if name == "certify":
            product = Path(context.params["adapter"] or context.params["toolchain"]).stem
            made.append((product, context.params["profile"]))
            archives.append(context.params["out"].stem)
    assert made == [
        ("reference-cpp", "core"), ("reference-py", "core"), ("ipopo", "container"), ("gstreamer", "container"),
        ("julia-adapter", "container"), *(("toolchain", profile) for profile in TOOLCHAIN_PROFILES),
    ]  # fmt: skip
    assert "ignore_errors = true" in block, "one that fails must not keep the others from being made"
    last = block.strip().splitlines()[-1].replace("{tox_root}", "top").replace("{/}", "/")
    assert shlex.split(last)[3:] == ["top/reports/certified/index.json", *archives]


@pytest.mark.parametrize(("left_out", "status"), [("", 0), ("one", 1)])
def test_tox_fails_if_a_certificate_is_missing(folder: Path, left_out: str, status: int) -> None:
    (folder / "certificates" / f"{left_out}.ucmcert").unlink(missing_ok=True)
    publish(folder)
    (check,) = re.findall(r"(?m)^    (python -c .*index\.json) ", (ROOT / "tox.ini").read_text())
    code = shlex.split(check)[2]
    done = subprocess.run(
        [sys.executable, "-c", code, folder / "site" / "index.json", "one", "two"],
        check=False,
        capture_output=True,
        text=True,
    )
    assert (done.returncode, done.stderr.strip()) == (
        status,
        f"no certificate stands of {left_out}" if left_out else "",
    )
