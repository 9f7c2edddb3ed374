"""A judged trace leaves nothing behind that only the garbage collector finds: a run judges thousands."""

from __future__ import annotations

import gc

from ucm_cts.adapters.contract.messages import Run, Traced, encode, from_host_decoder
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.purposes.selection import plain_purposes
from ucm_cts.reference_models.monitor import Monitor


def test_judging_leaves_no_circles_of_references() -> None:
    monitor, engine, decoder = Monitor(load_life_cycle()), Engine(ReferenceAdapter), from_host_decoder()
    traces = []
    for purpose in plain_purposes("core")[::7]:
        for _, scenario in purpose.scenarios[:1]:
            if not any(step.ends_with in ("paused", "stressed", "counted") or step.thread for step in scenario.steps):
                answer = decoder.decode(engine.answer(encode(Run(0, scenario))))
                assert isinstance(answer, Traced)
                traces.append((scenario, answer.events))
    gc.collect()
    gc.disable()
    try:
        for scenario, trace in traces:
            monitor.judge(scenario, trace)
        assert gc.collect() == 0
    finally:
        gc.enable()
    assert len(traces) > 20
