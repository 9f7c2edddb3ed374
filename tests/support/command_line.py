"""Runs the command line as its console entry point does, in this process: what a user types, sees and gets back."""

from __future__ import annotations

import contextlib
import io
import json
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from unittest import mock

import pytest
from files import SUPPORT

from ucm_cts.__main__ import main


@dataclass(frozen=True)
class Outcome:
    """Exit status and everything printed."""

    status: int
    out: str
    err: str


def ucm_cts(*arguments: str | Path) -> Outcome:
    """``ucm-cts arguments...``, without a terminal. Nothing that goes wrong may show a traceback."""
    out, err = io.StringIO(), io.StringIO()
    status = None
    with (
        mock.patch.object(sys, "argv", ["ucm-cts", *map(str, arguments)]),
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(err),
    ):
        try:
            main()
        except SystemExit as end:
            status = end.code
    outcome = Outcome(status if isinstance(status, int) else 0, out.getvalue(), err.getvalue())
    assert "Traceback" not in outcome.out + outcome.err, outcome
    return outcome


def report_of(folder: Path) -> dict[str, Any]:
    """``report.json`` of a run."""
    report: dict[str, Any] = json.loads((folder / "report.json").read_text())
    return report


def blameless(report: dict[str, Any]) -> set[str]:
    """The failing requirements, none of them the adapter's fault."""
    assert report["verdict"] == "not conformant"
    assert not report["incidents"]
    assert "error" not in {r["verdict"] for r in report["requirements"]}
    return {r["id"] for r in report["requirements"] if r["verdict"] == "fail"}


def within(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Work in ``folder``, with the adapters of tests/support/subjects.py within reach of hosts."""
    monkeypatch.chdir(folder)
    monkeypatch.setenv("PYTHONPATH", str(SUPPORT))
