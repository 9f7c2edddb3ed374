"""``ucm-cts publish``: what it writes, leaves alone, remembers and refuses."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from certified import VERIFIER, put, report, verified
from command_line import Outcome, ucm_cts
from files import ROOT

from ucm_cts.harness.catalogue.profiles import TOOLCHAIN_PROFILES
from ucm_cts.harness.certificates.problems import Problem
from ucm_cts.harness.cli import publish_command
from ucm_cts.harness.cli.commands import cli


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
    made = []
    for line in re.findall(r"(?m)^    -? ?(ucm-cts .+)$", block):
        name, *arguments = shlex.split(
            line.replace("{posargs}", "").replace("{/}", "/").replace("{tox_root}", str(ROOT))
        )[1:]
        context = cli.commands[name].make_context(name, arguments)
        if name == "certify":
            made.append(
                (Path(context.params["adapter"] or context.params["toolchain"]).stem, context.params["profile"])
            )
    assert made == [
        ("reference-cpp", "core"), ("reference-py", "core"), ("ipopo", "container"), ("gstreamer", "container"),
        ("julia-adapter", "container"), *(("toolchain", profile) for profile in TOOLCHAIN_PROFILES),
    ]  # fmt: skip
