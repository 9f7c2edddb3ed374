"""Tools that die oddly, nest folders without end or leave processes behind: nothing of them is left, and the harness goes on."""

from __future__ import annotations

import sys
import time
from contextlib import suppress
from pathlib import Path

import psutil
import pytest

from ucm_cts.harness.toolchains.commands import bounded
from ucm_cts.harness.toolchains.commands.description import Command, ToolChain
from ucm_cts.harness.toolchains.commands.processing import CommandLine, Response

NESTS = """
for _ in range(1100):
    os.mkdir("d")
    os.chdir("d")
"""

LEAVES_A_DAEMON = """
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        for stream in (0, 1, 2):
            os.close(stream)
        open(os.path.join(out, "up"), "w").close()
        time.sleep(600)
    os._exit(0)
while not os.path.exists(os.path.join(out, "up")):
    time.sleep(0.01)
"""


@pytest.fixture
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where folders of runs are made."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(bounded.tempfile, "tempdir", str(folder))
    return folder


def made_by(script: str, then: str = "") -> Response:
    """What becomes of a model by a generator that runs ``script`` in its folder and ``then`` with ``out``, its folder for files."""
    program = f"import os, signal, sys, time\nout = sys.argv[2]\n{then}\n{script}"
    command = Command((sys.executable, "-c", program, "{model}", "{out}"))
    return CommandLine(ToolChain("p", "1", idl=command)).process("idl", "question", "<Model/>")


@pytest.mark.parametrize(("number", "reported"), [("signal.SIGRTMIN + 3", "SIGRTMIN+3"), ("signal.SIGKILL", "SIGKILL")])
def test_any_signal_has_a_name(number: str, reported: str) -> None:
    made = made_by(f"os.kill(os.getpid(), {number})")
    assert made.processed.incident is not None
    assert made.processed.incident.kind == "crash"
    assert made.processed.incident.detail == f"killed by {reported}"


def test_folders_without_end_are_neither_read_nor_left(temporary: Path) -> None:
    wrote = "open(os.path.join(out, 'a.idl'), 'w').write('module m { };')\nos.chdir(out)"
    assert made_by(NESTS, wrote).files == {"a.idl": "module m { };"}
    assert not list(temporary.iterdir())


def test_links_are_not_followed(tmp_path: Path) -> None:
    (tmp_path / "a.idl").write_text("module m { };")
    replaced = f"os.rmdir(out)\nos.symlink({str(tmp_path)!r}, out)"
    linked = f"os.symlink({str(tmp_path / 'a.idl')!r}, os.path.join(out, 'b.idl'))"
    assert made_by("", replaced).files == {}
    assert made_by("", linked).files == {}


def test_a_daemon_of_a_session_of_its_own_is_ended(tmp_path: Path) -> None:
    mark = f"# {tmp_path}"  # part of its command line
    assert made_by(f"{mark}\n{LEAVES_A_DAEMON}").accepted
    while _running(mark):  # the system takes a moment to end it
        time.sleep(0.01)


def _running(mark: str) -> list[int]:
    """The processes that have ``mark`` in their command line, seen from outside any sandbox."""
    found = []
    for process in psutil.process_iter():
        with suppress(psutil.Error):
            if process.status() != psutil.STATUS_ZOMBIE and mark in " ".join(process.cmdline()):
                found.append(process.pid)
    return found


def test_a_run_has_the_environment_that_it_is_given(tmp_path: Path) -> None:
    limits = ToolChain("p", "1", seconds=10.0)
    script = [sys.executable, "-c", "import os; print(os.environ.get('A'), os.environ.get('HOME'))"]
    assert bounded.run(script, tmp_path, limits, environment={"A": "b"}).output == "b None\n"
