"""docs/publication.md: its commands run as printed, and the files are there; nothing is made up here."""

from __future__ import annotations

import re
import shlex
import shutil
from pathlib import Path

import pytest
from command_line import ucm_cts
from files import ROOT

GUIDE = (ROOT / "docs" / "publication.md").read_text()


@pytest.mark.slow
def test_every_command_of_the_guide_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (block,) = re.findall(r"(?ms)^```console\n(.*?)^```$", GUIDE)
    (remembering,) = re.findall(r"(?m)^    (ucm-cts publish .*)$", GUIDE)
    for command in [*block.splitlines(), remembering, remembering]:
        program, *arguments = shlex.split(command)
        if program == "mkdir":
            for name in arguments:
                Path(name).mkdir()
        elif program == "cp":
            shutil.copy(arguments[0], arguments[1])
        else:
            few = ("--explore", "0s") if arguments[0] == "certify" else ()
            outcome = ucm_cts(*arguments, *few)
            assert outcome.status == 0, (command, outcome)
    assert "1 of 1 certificates stand" in outcome.out
    for names in re.findall(r"(?m)^\| (`[^|]+`) \| ", GUIDE.partition("## ")[0]):
        for name in re.findall(r"`([^`]+)`", names):
            assert name == "site" or any((tmp_path / "site").glob(name)), name
    (page,) = (tmp_path / "site" / "certificates").glob("*.html")
    assert "rests on the signer's word" in page.read_text().replace("&#39;", "'")
    changed = tmp_path / "certificates" / "acme.ucmcert"
    changed.write_bytes(changed.read_bytes()[:-100])
    (tmp_path / "verified.cache").chmod(0o600)
    outcome = ucm_cts(*shlex.split(remembering)[1:])
    assert (outcome.status, "0 of 1 certificates stand" in outcome.out) == (0, True)
    assert not list((tmp_path / "site" / "certificates").glob("*.html"))
    assert "acme.ucmcert" in (tmp_path / "site" / "index.html").read_text()
