"""Frameworks not made for UCM: each habit that docs/real-frameworks.md tells of comes out as it says, and no more fails."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from gstreamer_here import gstreamer_adapter
from pipeline import Product

from ucm_cts.adapters.contract.adapter import Adapter

ROOT = Path(__file__).parent.parent
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


def check_here(adapter: type[Adapter]) -> None:
    (habits,) = (habits for name, habits in HABITS.items() if name.rpartition(" ")[0] == adapter.product)
    product = Product(adapter)
    check(habits, set(product.failing), product.readings)


def test_each_row_is_read() -> None:
    assert {"GStreamer 1.22.0", "iPOPO 3.2.4", "Fractal Julia 2.5.2"} <= set(HABITS)
    assert sum(map(len, HABITS.values())) == len(re.findall(r"(?m)^\| .*R-\d", PAGE))


@pytest.mark.parametrize("name", HABITS)
def test_the_published_report_shows_it(name: str) -> None:
    report = published()[name]
    verdicts = {result["id"]: result["verdict"] for result in report["requirements"]}
    failing = {requirement for requirement, verdict in verdicts.items() if verdict == "fail"}
    check(HABITS[name], failing, report["readings"])
    for habit in HABITS[name]:
        assert verdicts[habit.requirement] == habit.verdict, habit


def test_the_test_command_brings_gstreamer() -> None:
    """So that the next test is not skipped where it counts."""
    (packages,) = re.findall(r"(?m)^ +apt-get install (.*gstreamer.*)$", PAGE)
    commands = re.findall(r"(?m)^apt-get update .*$", (ROOT / "README.md").read_text())
    assert [packages in command for command in commands if command.endswith("pipx run tox")] == [True]


def test_gstreamer_shows_it_here() -> None:
    check_here(gstreamer_adapter().GStreamerAdapter)


def test_ipopo_shows_it_here() -> None:
    pytest.importorskip("pelix")
    from ucm_cts.adapters.integrations.ipopo.adapter import IpopoAdapter

    check_here(IpopoAdapter)
