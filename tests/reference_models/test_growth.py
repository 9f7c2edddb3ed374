"""An event costs no more beside many components, containers or restarts than beside few: no work is done for each of them."""

from __future__ import annotations

import functools
import sys
from collections.abc import Callable
from types import FrameType
from typing import Any

import pytest

from ucm_cts.harness.bench.many_parts import SHAPES, scenario_of, trace_of
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.reference_models.monitor import Monitor

FEW, MANY = 20, 200
MORE = 1.02
"""A search of all parts for each operation adds more than this, although there are 200 only."""


def lines_run(work: Callable[[], object]) -> int:
    """How many lines of Python ``work`` runs, each turn of a loop or comprehension included."""
    run = 0

    def count(frame: FrameType, event: str, argument: Any) -> Any:
        nonlocal run
        run += event == "line"
        return count

    before = sys.gettrace()
    sys.settrace(count)
    try:
        work()
    finally:
        sys.settrace(before)
    return run


@pytest.mark.parametrize("shape", SHAPES)
def test_an_event_costs_the_same_beside_many_others(shape: str) -> None:
    monitor = Monitor(load_life_cycle())
    judging, believing = [], []
    for size in (FEW, MANY):
        scenario = scenario_of(shape, size, "core")
        trace = trace_of(scenario)
        assert not monitor.judge(scenario, trace).findings  # what is worked out once is known now
        judging.append(lines_run(functools.partial(monitor.judge, scenario, trace)) / len(trace))
        believing.append(lines_run(functools.partial(contradiction, scenario, trace)) / len(trace))
    assert judging[1] <= MORE * judging[0]
    assert believing[1] <= MORE * believing[0]
