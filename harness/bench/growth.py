"""Measures whether judging an event costs more in large scenarios than in small ones."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import NamedTuple

from rich.table import Table

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.harness.bench.many_parts import SHAPES, scenario_of, trace_of
from ucm_cts.harness.bench.measuring import empty_table, limit, medians
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.reference_models.monitor import Monitor

SIZES = (10, 1000)

TIMES = 1.5
"""The limit of what an event costs in the largest scenario, as a multiple of what it costs in the smallest one."""

_ROUNDS = 3
_EVENTS = 10_000
"""Small scenarios are judged so often that there are so many events."""


class Growth(NamedTuple):
    """What judging one event costs by the number of parts, in microseconds, and ``believing`` it, which are the integrity checks."""

    shape: str
    profile: str
    judging: dict[int, float]
    believing: dict[int, float]


def of_all_shapes() -> Iterator[Growth]:
    """Measure scenarios of each shape and size, without and with policies of profile core."""
    for profile in ("container", "core"):
        for shape in SHAPES:
            yield _of(shape, profile)


def _of(shape: str, profile: str) -> Growth:
    monitor = Monitor(load_life_cycle())
    scenarios = {size: scenario_of(shape, size, profile) for size in SIZES}
    traced = {size: (scenario, trace_of(scenario)) for size, scenario in scenarios.items()}

    def judge(scenario: Scenario, trace: Trace) -> None:
        assert not monitor.judge(scenario, trace).findings

    def believe(scenario: Scenario, trace: Trace) -> None:
        assert contradiction(scenario, trace) is None

    cases = {
        f"{what} {size}": lambda act=act, one=one: _an_event(act, *one)
        for what, act in (("judge", judge), ("believe", believe))
        for size, one in traced.items()
    }
    costs = medians(cases, _ROUNDS)  # type: ignore[arg-type]
    judging, believing = ({size: costs[f"{what} {size}"] for size in SIZES} for what in ("judge", "believe"))
    return Growth(shape, profile, judging, believing)


def _an_event(act: Callable[[Scenario, Trace], None], scenario: Scenario, trace: Trace) -> float:
    """Microseconds of processor time."""
    times = max(1, _EVENTS // len(trace))
    began = time.process_time()
    for _ in range(times):
        act(scenario, trace)
    return (time.process_time() - began) / times / len(trace) * 1e6


def table() -> Table:
    """The costs side by side."""
    numbers = " parts|".join(f"{size:,}" for size in SIZES)
    shown = empty_table("Checking large scenarios, µs an event", f"|profile|{numbers} parts|×|integrity|×|at most")
    for one in of_all_shapes():
        grown = [costs[SIZES[-1]] / costs[SIZES[0]] for costs in (one.judging, one.believing)]
        shown.add_row(
            one.shape,
            one.profile,
            *(f"{one.judging[size]:.1f}" for size in SIZES),
            f"{grown[0]:.1f}",
            f"{one.believing[SIZES[-1]]:.1f}",
            f"{grown[1]:.1f}",
            limit(TIMES, *grown),
        )
    return shown
