"""Frameworks not made for UCM: each habit has the verdict and reading that its file says, and no more fails."""

from __future__ import annotations

import re

import pytest
from files import ROOT
from pipeline import Product
from real_frameworks import HABITS, PAGE, check, gstreamer_adapter, results

from ucm_cts.adapters.contract.adapter import Adapter

pytestmark = pytest.mark.native


def check_here(adapter: type[Adapter]) -> None:
    (habits,) = (habits for name, habits in HABITS.items() if name.rpartition(" ")[0] == adapter.product)
    product = Product(adapter)
    check(habits, set(product.failing), product.readings)


def test_the_page_names_each_product_and_counts_its_habits() -> None:
    assert {"GStreamer 1.22.0", "iPOPO 3.2.4", "Fractal Julia 2.5.2"} <= set(HABITS)
    assert set(re.findall(r"(?m)^## (.+)$", PAGE)) == set(HABITS)
    assert {int(n) for n in re.findall(r"\[(\d+)\]\(\S+habits\.yaml\)", PAGE)} == {len(h) for h in HABITS.values()}


@pytest.mark.parametrize("name", HABITS)
def test_the_published_result_shows_it(name: str) -> None:
    result = results()[name]
    verdicts = {entry.id: entry.verdict for entry in result.requirements}
    failing = {requirement for requirement, verdict in verdicts.items() if verdict == "fail"}
    check(HABITS[name], failing, result.readings)
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
