"""The frameworks not made for UCM: their habits (adapters/integrations/*/habits.yaml), and whether GStreamer is installed."""

from __future__ import annotations

import importlib
import subprocess
import sys
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import pytest
import yaml
from files import ROOT

from ucm_cts.harness.report.published import PublishedResult, read_published

PAGE = (ROOT / "docs" / "real-frameworks.md").read_text()


class Habit(NamedTuple):
    """What a framework does by nature, and the verdict and the reading that this must produce."""

    habit: str
    requirement: str
    verdict: str
    reading: str = ""


def results() -> dict[str, PublishedResult]:
    """The published results, by product and version."""
    return {f"{result.product} {result.version}": result for result in read_published(ROOT / "results")}


FILES = [yaml.safe_load(file.read_text()) for file in ROOT.glob("adapters/integrations/*/habits.yaml")]
HABITS = {file["product"]: [Habit(**habit) for habit in file["habits"]] for file in FILES}
"""The habits, by product and version."""


def check(habits: list[Habit], failing: set[str], readings: Mapping[str, Sequence[str]]) -> None:
    assert failing == {habit.requirement for habit in habits if habit.verdict == "fail"}
    for habit in habits:
        option, _, reading = habit.reading.partition(" = ")
        assert not reading or reading in readings.get(option, ()), habit


_ADAPTER = "ucm_cts.adapters.integrations.gstreamer.adapter"
_ASK = """
import sys, gi
gi.require_version("Gst", "1.0")
from gi.repository import Gst
print(*sys.version_info[:2], sep=".")
"""


def gstreamer_adapter() -> Any:
    """The module ``ucm_cts.adapters.integrations.gstreamer.adapter``. Skips the test where GStreamer is not installed."""
    if _version_of_the_system() == f"{sys.version_info.major}.{sys.version_info.minor}":
        return importlib.import_module(_ADAPTER)
    return pytest.importorskip(_ADAPTER, exc_type=ImportError)


def _version_of_the_system() -> str:
    """The version of Python for which the system has GStreamer, empty if it has not."""
    try:
        asked = subprocess.run(["/usr/bin/python3", "-c", _ASK], capture_output=True, text=True, check=False)
    except OSError:
        return ""
    return asked.stdout.strip()
