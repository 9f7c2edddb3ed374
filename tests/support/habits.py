"""The habits of frameworks not made for UCM, as docs/real-frameworks.md tells of them."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from folders import ROOT

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


def published() -> dict[str, dict[str, Any]]:
    """The reports under results/, by product and version."""
    reports = [json.loads(file.read_text()) for file in ROOT.glob("results/*/report.json")]
    return {f"{report['product']} {report['version']}": report for report in reports}


HABITS = told()


def check(habits: list[Habit], failing: set[str], readings: Mapping[str, Any]) -> None:
    assert failing == {habit.requirement for habit in habits if habit.verdict == "fail"}
    for habit in habits:
        option, _, reading = habit.reading.partition(" = ")
        assert not reading or reading in readings.get(option, ()), habit
