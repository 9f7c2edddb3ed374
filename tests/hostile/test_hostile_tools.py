"""Tools of a tool chain that take what is not theirs: each gets its one clear line, no answer is lost, nothing is left."""

from __future__ import annotations

import errno
import os
import re
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from aftermath import nothing_left  # noqa: F401 - a fixture
from command_line import report_of, ucm_cts, within

from ucm_cts.harness.toolchains.commands import bounded
from ucm_cts.harness.toolchains.commands.description import Command, ToolChain
from ucm_cts.harness.toolchains.commands.processing import CommandLine, Response

pytestmark = pytest.mark.usefixtures("nothing_left")

MODELS = [(f"model {number}", "<Model/>") for number in range(3)]
TOOL = """
import os, signal, sys, time
model, out = sys.argv[1:]
seldom = "model 1" in open(model).read()
"""


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    within(tmp_path, monkeypatch)
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(bounded.tempfile, "tempdir", str(folder))
    monkeypatch.setattr(bounded, "MOST_BYTES", 4 << 20)
    monkeypatch.setattr(bounded, "MOST_FILES", 500)
    return tmp_path


def made_by(script: str, **limits: float) -> list[Response]:
    """What becomes of three models by a generator that runs ``script`` for the second one."""
    attack = "\n".join(f"    {line}" for line in script.splitlines())
    command = Command((sys.executable, "-S", "-c", f"{TOOL}if seldom:\n{attack}", "{model}", "{out}"))
    tools = CommandLine(ToolChain("p", "1", idl=command, **limits))  # type: ignore[arg-type]
    return tools.process_all("idl", [(name, f"<Model><!-- {name} --></Model>") for name, _ in MODELS])


def line_of(response: Response) -> str:
    incident = response.processed.incident
    return f"{incident.kind}: {incident.detail}" if incident else f"accepted: {response.accepted}"


TOOLS: dict[str, tuple[str, str]] = {
    "floods its output": ("while True: os.write(1, b'x' * 65536)", "flood: more than 16 MiB of output"),
    "floods its errors": ("while True: os.write(2, b'x\\n' * 32768)", "flood: more than 16 MiB of output"),
    "fills the disk with a file": (
        "file = open(os.path.join(out, 'a.idl'), 'wb')\nwhile True: file.write(b'x' * 65536)",
        "flood: more than 4 MiB of files",
    ),
    "fills the disk beside its folder": (
        "file = open('a', 'wb')\nwhile True: file.write(b'x' * 65536)",
        "flood: more than 4 MiB of files",
    ),
    "fills the disk with files": (
        "for n in range(9): open(os.path.join(out, str(n)), 'wb').write(b'x' * (1 << 20))\nsignal.pause()",
        "flood: more than 4 MiB of files",
    ),
    "fills the disk and is done": (
        "for n in range(9): open(os.path.join(out, str(n)), 'wb').write(b'x' * (1 << 20))",
        "flood: more than 4 MiB of files",
    ),
    "writes very many files": (
        "for n in range(600): open(os.path.join(out, str(n)), 'wb')\nsignal.pause()",
        "flood: more than 500 files",
    ),
    "nests very many folders": (
        "os.chdir(out)\nfor n in range(600): os.mkdir('d') or os.chdir('d')\nsignal.pause()",
        "flood: more than 500 files",
    ),
    "dies of a long file": (
        "signal.signal(signal.SIGXFSZ, signal.SIG_DFL)\nos.kill(os.getpid(), signal.SIGXFSZ)",
        "flood: more than 4 MiB of files",
    ),
    "writes a file with holes": ("os.truncate(os.open(os.path.join(out, 'a'), 65), 1 << 20)", "accepted: True"),
    "stands still": ("os.kill(os.getpid(), signal.SIGSTOP)", "hang: no end after 0.7 s"),
    "leaves a fork": ("if os.fork() == 0: signal.pause()", "accepted: True"),
    "leaves a session": ("if os.fork() == 0: os.setsid() or signal.pause()", "accepted: True"),
    "closes its streams": ("os.closerange(0, 3)\nos._exit(0)", "accepted: True"),
    "kills its group": ("os.killpg(0, signal.SIGTERM)", "crash: killed by SIGTERM"),
    "makes its folder unreadable": ("os.mkdir(out + '/d')\nos.chmod(out, 0)", "accepted: True"),
    "removes its folder": ("os.rmdir(out)\nos.unlink(model)", "accepted: True"),
    "replaces its folder by a pipe": ("os.rmdir(out)\nos.mkfifo(out)", "accepted: True"),
    "writes a pipe": ("os.mkfifo(os.path.join(out, 'a.idl'))", "accepted: True"),
}


@pytest.mark.parametrize(("script", "line"), TOOLS.values(), ids=TOOLS)
def test_tool_gets_one_line_and_costs_no_other_answer(here: Path, script: str, line: str) -> None:
    limits = {"seconds": 0.7} if "SIGSTOP" in script else {"seconds": 30}
    before, attacked, after = made_by(script, **limits)
    assert line_of(attacked) == line
    assert [line_of(other) for other in (before, after)] == ["accepted: True"] * 2
    assert not list((here / "temporary").iterdir())


def test_full_disk_is_named(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bounded.shutil, "disk_usage", lambda path: SimpleNamespace(free=0))
    made = {line_of(one) for one in made_by("pass")}
    assert made == {f"unreachable: no room is left in {here / 'temporary'}; free some, or set TMPDIR to another folder"}


def test_model_that_cannot_be_written_loses_no_other_answer(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write = Path.write_text

    def fail(path: Path, text: str, **options: str) -> int:
        if "model 1" in text:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return write(path, text, **options)

    monkeypatch.setattr(Path, "write_text", fail)
    assert [line_of(one) for one in made_by("pass")] == [
        "accepted: True",
        "unreachable: the model cannot be written: No space left on device",
        "accepted: True",
    ]


def test_requirements_say_that_a_tool_gave_no_answers(here: Path) -> None:
    (here / "t.toml").write_text(
        'product = "p"\nversion = "1"\n[idl]\ncommand = ["sh", "-c", "head -c 17000000 /dev/zero; : {model}", "{out}"]\n'
    )
    outcome = ucm_cts("run", "--toolchain", "t.toml", "--profile", "idl", "-k", "R-12", "--out", "out")
    assert (outcome.status, outcome.err) == (1, "")
    reasons = {r["reason"] for r in report_of(here / "out")["requirements"] if r["verdict"] == "inconclusive"}
    lost = r"\d+ of \d+ models got no answer \(flood: more than 16 MiB of output\)"
    assert all(re.search(rf"{lost}|no answer: flood: more than 16 MiB of output", reason) for reason in reasons)
    assert any(re.search(lost, reason) for reason in reasons)


@pytest.mark.parametrize("expression", [r"^(?P<file>(([a-z.])+.)+[A-Z])+:(?P<line>\d+)", r"^(?P<line>(\w+\s?)*):\d+$"])
def test_expression_that_others_never_end_is_searched_at_once(here: Path, expression: str) -> None:
    command = Command((sys.executable, "-S", "-c", "print('a' * 5000 + '!')", "{model}"), diagnostic=expression)
    (response,) = CommandLine(ToolChain("p", "1", check=command, seconds=30)).process_all("check", MODELS[:1])
    assert line_of(response) == "accepted: True"
