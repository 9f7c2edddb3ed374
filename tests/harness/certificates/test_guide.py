"""docs/certificates.md: every command in it runs, in its order, in one folder."""

from __future__ import annotations

import re
import shlex
import shutil
from pathlib import Path

import pytest
from command_line import ucm_cts
from files import ROOT

from ucm_cts.harness.certificates.keys import trust_in

GUIDE = (ROOT / "docs" / "certificates.md").read_text()
DELTA = "--suite newer"


@pytest.mark.slow
def test_every_command_of_the_guide_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    commands = [line for block in re.findall(r"(?ms)^```console\n(.*?)^```$", GUIDE) for line in block.splitlines()]
    assert len(commands) > 12
    for command in commands:
        program, *arguments = shlex.split(command)
        if program == "mkdir":
            Path(arguments[0]).mkdir()
        elif program == "cp":
            shutil.copy(arguments[0], arguments[1])
        else:
            assert program == "ucm-cts"
            few = ("--explore", "0s") if arguments[0] == "certify" else ()
            outcome = ucm_cts(*arguments, *few)
            assert outcome.status == 0, (command, outcome)
            assert DELTA not in command or outcome.out.startswith("STANDS "), "it is of this suite"


def test_the_trust_file_of_the_guide_is_one(tmp_path: Path) -> None:
    (text,) = re.findall(r"(?ms)^<!-- file: keys/trust.toml -->\n```toml\n(.*?)^```$", GUIDE)
    assert ucm_cts("key", "acme", "--out", tmp_path).status == 0
    (tmp_path / "acme.pem").unlink()
    (tmp_path / "trust.toml").write_text(text)
    (key,) = trust_in(tmp_path).keys.values()
    assert key.vouches_for("UCM-CTS reference framework (Python)")
    assert not key.vouches_for("Other")


def test_each_word_of_a_problem_is_explained() -> None:
    folder = ROOT / "harness" / "certificates"
    words = set()
    for path in folder.glob("*.py"):
        words |= set(re.findall(r"(?:Problem|unreadable)\(\s*\"([a-z ]+)\"", path.read_text()))
    explained = set(re.findall(r"`([a-z ]+)`", GUIDE.partition("## What goes wrong")[2]))
    assert words - {"unknown"} <= explained
