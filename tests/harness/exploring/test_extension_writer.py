"""Random scenarios of 10.4 are scenarios that hosts accept, differ, and do not fail a conformant framework."""

from __future__ import annotations

import random

import pytest
from performing import answer

from ucm_cts.adapters.contract.messages import Traced
from ucm_cts.adapters.contract.scenario import Link
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.exploring.extension_writer import WRITTEN_PARTS, extension_scenario
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

DRAWN = 25


@pytest.mark.parametrize("part", WRITTEN_PARTS)
def test_drawn_scenarios_do_not_fail_the_reference_framework(part: str) -> None:
    """They are as many different ones, and show more than half of what is required of the part."""
    monitor = Monitor(load_life_cycle(), Ics({"freeze-scope": "reader"}))
    scenarios = [extension_scenario(part, random.Random(f"{part} {n}").choice) for n in range(DRAWN)]
    assert len({repr(one.steps) for one in scenarios}) >= DRAWN * 0.8
    assert all(any(isinstance(step, Link) and step.claim == part for step in one.steps) for one in scenarios)
    kept: set[str] = set()
    for scenario in (Disguise(1, ReferenceAdapter.port_element_name).scenario(one) for one in scenarios):
        reply = answer(scenario)
        assert isinstance(reply, Traced)
        assert contradiction(scenario, reply.events, reply.stuck) is None
        judged = monitor.judge(scenario, reply.events)
        assert judged.findings == []
        kept |= judged.exercises.keys()
    clause = {"request-response": "R-10.4.1", "shared-data": "R-10.4.2"}[part]
    assert sum(one.startswith(clause) for one in kept) >= 15
