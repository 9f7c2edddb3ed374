"""The scenarios that exploration draws."""

from __future__ import annotations

import random

import msgspec
import pytest

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.exploring.changing import LONGEST, changed
from ucm_cts.harness.exploring.core_writer import CoreWriter
from ucm_cts.harness.exploring.novelty import Guide
from ucm_cts.harness.exploring.predicted_coverage import transitions
from ucm_cts.harness.exploring.writer import Writer
from ucm_cts.harness.purposes.scripts import Script, problems, to_scenario
from ucm_cts.reference_models.model.row_selection import RowSelection

pytestmark = pytest.mark.slow


def drawn(seed: int, number: int) -> list[Scenario]:
    """Scenarios, each new, or one of those before it changed."""
    choose = random.Random(seed)
    scenarios: list[Scenario] = []
    for index in range(number):
        if index % 3 == 0:
            scenarios.append(Writer(choose.choice).scenario())
        elif index % 10 == 1:
            scenarios.append(CoreWriter(choose.choice).scenario())
        else:
            known = choose.choice([scenario for scenario in scenarios if not scenario.interfaces])
            scenarios.append(changed(known, choose.choice))
    return scenarios


def test_drawn_scenarios_can_be_saved_read_and_predicted() -> None:
    scenarios = drawn(1, 300)
    rows = RowSelection(load_life_cycle())
    for scenario in scenarios:
        script = msgspec.convert({"scenario": "drawn", **msgspec.to_builtins(scenario)}, Script)
        assert to_scenario(script) == scenario
        assert problems(script) == []
        assert bool(transitions(rows, scenario)) == bool(scenario.steps)
    assert len({msgspec.json.encode(scenario) for scenario in scenarios}) > 250
    assert max(len(scenario.steps) for scenario in scenarios) > LONGEST // 2


def test_transitions_follow_the_model() -> None:
    one = s.AddComponent("one"), s.Start(), s.Stop()
    scenario = Scenario({"one": s.Declaration()}, one)
    found = transitions(RowSelection(load_life_cycle()), scenario)
    assert ("then", "configured/start/", "ready/stop/started") in found or any(
        "configured/start" in before and "ready/stop" in after for _, before, after in (t for t in found if len(t) == 3)
    )
    assert transitions(RowSelection(load_life_cycle()), msgspec.structs.replace(scenario, steps=one[:2])) < found


def test_rare_transitions_are_preferred() -> None:
    usual = Scenario({"one": s.Declaration()}, (s.AddComponent("one"), s.Start(), s.Stop()))
    rare = Scenario({"one": s.Declaration()}, (s.AddComponent("one"), s.Start(), s.RemoveComponent("one")))
    guide = Guide(load_life_cycle())
    guide.choose([usual])
    assert guide.choose([usual, rare]) is rare
    assert guide.choose([usual]) is usual
