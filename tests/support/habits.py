"""The habits of frameworks not made for UCM: adapters/integrations/*/habits.yaml."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import yaml
from folders import ROOT

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
