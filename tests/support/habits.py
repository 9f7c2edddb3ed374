"""The habits of frameworks not made for UCM, as docs/real-frameworks.md tells of them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from folders import ROOT

from ucm_cts.harness.report.published import PublishedResult, read_published

PAGE = (ROOT / "docs" / "real-frameworks.md").read_text()
_ROW = re.compile(r"(?m)^\| (.+?) \| (R-[\d.]+-\d+) \| (pass|fail) \|(.*)\|$")


class Habit(NamedTuple):
    """What a framework does by nature, and the verdict and the reading that this has to come out as."""

    habit: str
    requirement: str
    verdict: str
    reading: str


def told() -> dict[str, list[Habit]]:
    """The habits, by product and version."""
    parts = re.split(r"(?m)^## (.+)$", PAGE)
    tables = {
        product: [Habit(*map(str.strip, row)) for row in _ROW.findall(text)]
        for product, text in zip(parts[1::2], parts[2::2], strict=True)
    }
    return {product: habits for product, habits in tables.items() if habits}


def results() -> dict[str, PublishedResult]:
    """The published results, by product and version."""
    return {f"{result.product} {result.version}": result for result in read_published(ROOT / "results")}


HABITS = told()


def check(habits: list[Habit], failing: set[str], readings: Mapping[str, Sequence[str]]) -> None:
    assert failing == {habit.requirement for habit in habits if habit.verdict == "fail"}
    for habit in habits:
        option, _, reading = habit.reading.partition(" = ")
        assert not reading or reading in readings.get(option, ()), habit
