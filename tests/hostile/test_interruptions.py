"""Interruptions at any time, and again: what was measured is reported, the report says so, and nothing is left running."""

from __future__ import annotations

import json
import os
import select
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from command_line import report_of, ucm_cts, within
from lxml import etree

from ucm_cts.harness.cli.terminal import ENDING, Interrupts, ends_like_interrupts

SIGNALS = list(ENDING)
WAITS_AT = """
import os, threading
from pathlib import Path
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter

class Waits(ReferenceAdapter):
    'Stops for ever when as many runtimes as the file "until" says have been made, and writes to a pipe then.'

    def create_runtime(self, implementations):
        made = Path("made")
        count = made.stat().st_size if made.exists() else 0
        with made.open("a") as file:
            file.write("x")
        if Path("until").exists() and count >= int(Path("until").read_text()):
            Path("calls").write_text("waiting")
            threading.Event().wait()
        return super().create_runtime(implementations)
"""
SELECTION = ("-k", "R-11.2.2.1-13 or R-11.2.3-11")


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    within(tmp_path, monkeypatch)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    (tmp_path / "waiting.py").write_text(WAITS_AT)
    os.mkfifo(tmp_path / "calls")
    return tmp_path


@pytest.fixture
def calls(here: Path) -> Iterator[int]:
    pipe = os.open(here / "calls", os.O_RDWR)
    yield pipe
    os.close(pipe)


def interrupted(calls: int, first: signal.Signals, *options: str, again: int = 0) -> tuple[int, str, str, list[str]]:
    """Exit status, outputs and the children of a run that gets the signal once the framework waits, and ``again`` so often."""
    run = "run", "waiting:Waits", "--no-sandbox", "--timeout", "60", "--out", "out", *options
    command = ["env", "--default-signal", sys.executable, "-m", "ucm_cts", *run]  # a job in the background ignores some
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert select.select([calls], [], [], 60)[0], "the framework was never called"
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        process.send_signal(first)
        for number in range(again):
            process.send_signal(SIGNALS[number % len(SIGNALS)])
        out, err = process.communicate(timeout=60)
    return process.returncode, out, err, children


@pytest.mark.parametrize(
    ("first", "again"), [*((first, 0) for first in SIGNALS[:4]), *((first, 8) for first in (SIGNALS[0], SIGNALS[-1]))]
)
def test_interrupted_run_says_so_in_all_three_reports(
    here: Path, calls: int, first: signal.Signals, again: int
) -> None:
    (here / "until").write_text("3")
    status, out, err, children = interrupted(calls, first, *SELECTION, again=again)
    assert (status, err) == (1, "")
    assert "interrupted: the report holds what was measured so far" in out
    assert not [child for child in children if Path(f"/proc/{child}").exists()]
    report = report_of(here / "out")
    assert report["verdict"] == "inconclusive"
    assert report["incomplete"].startswith("interrupted after ")
    assert report["incomplete"] in (here / "out" / "report.html").read_text()
    (case,) = [c for c in etree.parse(here / "out" / "junit.xml").iter("testcase") if c.get("classname") == "ucm.run"]
    assert case.find("error").get("message") == report["incomplete"]


def test_reports_of_interrupted_runs_are_not_compared_nor_published(here: Path, calls: int) -> None:
    (here / "until").write_text("3")
    interrupted(calls, signal.SIGINT, *SELECTION)
    for command in ["compare", "out/report.json", "out/report.json"], ["results", "out", "--out", "published"]:
        outcome = ucm_cts(*command)
        assert (outcome.status, len(outcome.err.splitlines())) == (2, 1)
        assert "incomplete (interrupted after " in outcome.err


def test_interrupted_series_goes_on_where_it_stopped(here: Path, calls: int) -> None:
    assert ucm_cts("run", "waiting:Waits", "--no-sandbox", *SELECTION, "--seed", "5", "--out", "whole").status == 0
    per_run = (here / "made").stat().st_size
    (here / "made").unlink()
    (here / "until").write_text(str(2 * per_run + per_run // 2))
    status, _, err, _ = interrupted(calls, signal.SIGTERM, *SELECTION, "--seed", "5", "--repeat", "4")
    assert (status, err) == (1, "")
    report = report_of(here / "out")
    assert report["runs"] == 2
    assert report["incomplete"].startswith("interrupted after ")
    assert report["incomplete"].endswith(" of run 3")
    assert {path.name for path in (here / "out" / "runs").iterdir()} == {"part.json", "run-1.json", "run-2.json"}
    (here / "until").unlink()
    (here / "made").unlink()
    again = ("run", "waiting:Waits", "--no-sandbox", "--out", "out", "--timeout", "60", "--repeat", "4", "--resume")
    for options, problem in (
        (["-k", "R-11.2.2.1-13"], "were of another suite, adapter, statement, selection or limits"),
        ([*SELECTION, "--memory", "2000"], "were of another suite, adapter, statement, selection or limits"),
        ([*SELECTION, "--seed", "6"], "began with seed 5; leave out --seed, or --resume"),
    ):
        outcome = ucm_cts(*again, *options)
        assert (outcome.status, len(outcome.err.splitlines())) == (2, 1)
        assert problem in outcome.err
    assert not (here / "made").exists(), "nothing was run"
    outcome = ucm_cts(*again, *SELECTION)
    assert (outcome.status, outcome.err) == (0, "")
    assert "2 of 4 runs had ended before, and " in outcome.out
    assert per_run < (here / "made").stat().st_size < 2 * per_run, "what was done of the third run is not done again"
    report = report_of(here / "out")
    assert (report["runs"], report["seed"], report["verdict"], report["incomplete"]) == (4, 5, "conformant", "")
    assert not (here / "out" / "runs").exists(), "what is complete needs no checkpoint"


def test_series_of_another_product_is_not_resumed(here: Path, calls: int) -> None:
    (here / "waiting.py").write_text(WAITS_AT + "    product = 'One'\n")
    ucm_cts("run", "waiting:Waits", "--no-sandbox", *SELECTION, "--out", "whole")
    (here / "until").write_text(str((here / "made").stat().st_size + 1))
    (here / "made").unlink()
    interrupted(calls, signal.SIGINT, *SELECTION, "--repeat", "2")
    (here / "until").unlink()
    (here / "waiting.py").write_text(WAITS_AT + "    product = 'Another'\n")
    before = json.loads((here / "out" / "runs" / "run-1.json").read_text())
    outcome = ucm_cts(
        "run",
        "waiting:Waits",
        "--no-sandbox",
        *SELECTION,
        "--timeout",
        "60",
        "--repeat",
        "2",
        "--out",
        "out",
        "--resume",
    )
    assert outcome.status == 2
    assert "are of another product, 'Another 1'; leave out --resume" in outcome.err
    assert json.loads((here / "out" / "runs" / "run-1.json").read_text()) == before


def test_interrupted_pytest_session_says_so_in_its_report(here: Path, calls: int) -> None:
    (here / "until").write_text("1")
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-p",
        "no:cacheprovider",
        "-p",
        "no:xdist",
        "--pyargs",
        "ucm_cts.suite",
    ]
    options = [
        "--iut",
        "waiting:Waits",
        "--iut-no-sandbox",
        "-k",
        "whole-life or many-members",
        "--iut-out",
        "out",
        "--iut-timeout",
        "60",
    ]
    with subprocess.Popen([*command, *options], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert select.select([calls], [], [], 60)[0], "the framework was never called"
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
    assert process.returncode == pytest.ExitCode.INTERRUPTED, out + err
    report = report_of(here / "out")
    assert report["verdict"] == "inconclusive"
    assert report["incomplete"].startswith("interrupted after ")


def test_interrupted_run_on_a_tool_chain_says_so(here: Path, calls: int) -> None:
    command = json.dumps(["sh", "-c", f"echo asked > {here}/calls; exec sleep 1", "{model}"])
    (here / "slow.toml").write_text(f'product = "slow"\nversion = "1"\n[check]\ncommand = {command}\n')
    run = [sys.executable, "-m", "ucm_cts", "run", "--toolchain", "slow.toml", "--profile", "pim", "--out", "out"]
    with subprocess.Popen(run, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert select.select([calls], [], [], 60)[0], "the tool was never called"
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGTERM)
        out, err = process.communicate(timeout=60)
    assert (process.returncode, err) == (1, "")
    assert "interrupted: the report holds what was measured so far" in out
    report = report_of(here / "out")
    assert report["incomplete"].startswith("interrupted after ")
    assert report["verdict"] != "conformant"


@pytest.fixture
def handlers() -> Iterator[None]:
    before = {number: signal.getsignal(number) for number in SIGNALS}
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.mark.usefixtures("handlers")
def test_only_the_first_request_interrupts_and_none_while_held() -> None:
    def ask(number: signal.Signals) -> None:
        os.kill(os.getpid(), number)

    with ends_like_interrupts() as interrupts:
        with interrupts.held():
            ask(signal.SIGINT)
        assert interrupts.came
        ask(signal.SIGTERM)
        ask(signal.SIGINT)
    assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN, "nothing ends what is left to be printed"
    for number in SIGNALS:
        signal.signal(number, signal.default_int_handler)
    with ends_like_interrupts() as interrupts:
        with pytest.raises(KeyboardInterrupt):
            ask(signal.SIGHUP)
        ask(signal.SIGINT)
    assert interrupts.came


@pytest.mark.usefixtures("handlers")
def test_without_a_request_all_is_as_before() -> None:
    before = {number: signal.getsignal(number) for number in SIGNALS}
    with ends_like_interrupts() as interrupts:
        assert isinstance(interrupts, Interrupts)
    assert {number: signal.getsignal(number) for number in SIGNALS} == before
