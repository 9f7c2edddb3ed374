"""Random scenarios of 10.3 to 10.5 are scenarios that hosts accept, differ, and do not fail a conformant framework."""

from __future__ import annotations

import random

import pytest

from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.exploring.extension_writer import WRITTEN_PARTS, extension_scenario
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.statement.applicability import needs_of
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

DRAWN = 25


@pytest.mark.parametrize("part", WRITTEN_PARTS)
def test_drawn_scenarios_do_not_fail_the_reference_framework(part: str) -> None:
    """They are as many different ones, and show more than half of what is required of the part."""
    monitor = Monitor(load_life_cycle(), Ics({"freeze-scope": "reader"}))
    scenarios = [extension_scenario(part, random.Random(f"{part} {n}").choice) for n in range(DRAWN)]
    assert len({repr(one.steps) for one in scenarios}) >= DRAWN * 0.8
    assert all(part in needs_of(one) for one in scenarios)
    kept: set[str] = set()
    with Driver(locate("reference-py", virtual_time=True), 1) as driver:
        for answer in driver.run(("drawn", one) for one in scenarios):
            assert answer.incident is None
            verdicts = monitor.judge(answer.disguised, answer.trace)
            assert verdicts.findings == []
            kept |= verdicts.exercises.keys()
    shown = {
        "request-response": ("R-10.4.1", 15),
        "shared-data": ("R-10.4.2", 15),
        "index-timers": ("R-10.3.2", 15),
        "object-timers": ("R-10.3.1", 12),
    }
    clause, least = shown.get(part, ("R-10.5", 4))
    assert sum(one.startswith(clause) for one in kept) >= least
