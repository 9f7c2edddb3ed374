"""Long scenarios are judged in bounded memory, and faults at their end are found."""

from __future__ import annotations

import tracemalloc
from collections.abc import Iterable, Iterator

import msgspec
import pytest

from ucm_cts.adapters.contract.trace import Enter, Event, Reply
from ucm_cts.harness.bench.long_life import LongLife
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.reference_models.monitor import Monitor

MEGABYTE = 2**20


def late(events: Iterable[Event], at: int, **changed: object) -> Iterator[Event]:
    """The events, of which the first ``Reply``, or start with dependencies, after ``at`` differs."""
    done = False
    for event in events:
        fits = isinstance(event, Reply) if "value" in changed else isinstance(event, Enter) and bool(event.dependencies)
        if event.n > at and fits and not done:
            done = True
            event = msgspec.structs.replace(event, **changed)
        yield event
    assert done


@pytest.mark.parametrize(("rounds", "calls"), [(800, 1), (26, 100)], ids=["many connections", "many calls"])
def test_memory_does_not_grow_with_events(rounds: int, calls: int) -> None:
    life = LongLife(rounds, calls)
    scenario, monitor = life.scenario(), Monitor(load_life_cycle())
    monitor.judge(scenario, LongLife(2, calls).events())
    tracemalloc.start()
    try:
        verdicts = monitor.judge(scenario, life.events())
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert len(life) > 20_000
    assert not verdicts.findings
    assert verdicts.exercises["R-11.1.3-01"] == rounds * calls
    assert peak < MEGABYTE // 4, peak


def test_whether_it_can_be_true_takes_little_memory() -> None:
    life = LongLife(25, 100)
    scenario = life.scenario()
    tracemalloc.start()
    try:
        assert contradiction(scenario, life.events()) is None
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 2 * MEGABYTE, peak


def test_fault_after_many_rounds_is_found() -> None:
    life = LongLife(300, 2)
    scenario, monitor = life.scenario(), Monitor(load_life_cycle())
    answered = monitor.judge(scenario, late(life.events(), len(life) - 100, value=77))
    assert {f.requirement for f in answered.findings} == {"R-11.1.3-01"}
    unconnected = monitor.judge(scenario, late(life.events(), len(life) - 100, dependencies=()))
    assert {f.requirement for f in unconnected.findings} == {"R-11.2.3-10"}
