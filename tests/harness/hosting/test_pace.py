"""A slow product gets more time for a scenario; one that is not, or not known, gets the usual time."""

from __future__ import annotations

import math

import pytest

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Opened, Trace
from ucm_cts.adapters.sdk.python.workers import FAREWELL
from ucm_cts.harness.hosting.pace import KNOWN_BY, LONGER, MOST_MORE, SLOW, Pace, waits

TEN_STEPS = Scenario({}, (s.Start(),) * 10)


def lasting(seconds: float) -> Trace:
    return Opened(1, 5, 0, "g"), Opened(2, 5 + round(seconds * 1e9), 0, "g")


def paced(*seconds_a_step: float, scenario: Scenario = TEN_STEPS, at_most: float = math.inf) -> Pace:
    pace = Pace()
    for seconds in seconds_a_step:
        pace.note(scenario, lasting(10 * seconds), at_most)
    return pace


def test_pace_is_not_known_by_few_scenarios() -> None:
    pace = paced(*[1.0] * (KNOWN_BY - 1))
    assert not pace.is_slow
    assert pace.more_for(40) == 0


def test_slow_product_gets_time_for_each_step_but_not_for_ever() -> None:
    pace = paced(*[0.05] * KNOWN_BY)
    assert pace.is_slow
    assert pace.more_for(10) == pytest.approx(10 * 0.05 * LONGER)
    assert pace.more_for(2_000) == pytest.approx(2_000 * 0.05 * LONGER)
    assert pace.more_for(1_000_000_000) > MOST_MORE  # 20 ms for each step that is one too many
    assert paced(*[1e6] * KNOWN_BY).more_for(10) == MOST_MORE


def test_host_cannot_say_that_it_took_longer_than_it_did() -> None:
    assert not paced(*[3600.0] * KNOWN_BY, at_most=0.001).is_slow


def test_single_slow_scenarios_do_not_count_and_the_last_ones_do() -> None:
    assert not paced(*[9.0] * (KNOWN_BY // 2), *[0.0001] * KNOWN_BY).is_slow
    assert not paced(*[0.0001] * (KNOWN_BY - KNOWN_BY // 2), *[9.0] * (KNOWN_BY // 2)).is_slow
    assert paced(*[0.0001] * KNOWN_BY, *[2 * SLOW] * KNOWN_BY).is_slow


def test_nothing_is_learnt_of_scenarios_that_wait_or_have_no_trace() -> None:
    assert not paced(*[9.0] * KNOWN_BY, scenario=Scenario({}, (s.Pause(10),))).is_known
    pace = Pace()
    pace.note(TEN_STEPS, (), 9)
    assert not pace.is_known


def test_workers_have_time_to_end() -> None:
    on_a_thread = Scenario({}, (s.Start(thread="w"),), patience=20)
    assert waits(on_a_thread) == FAREWELL
    assert waits(Scenario({}, (s.Start(thread="w"),), patience=2000)) == 2
